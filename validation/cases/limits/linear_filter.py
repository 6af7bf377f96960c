"""Limits of a rough track: of the linear filter on springs and on the half-space, and of the spacing of springs."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

import mdr
from validation.cases.limits.isotropy import HURST, decibel
from validation.cases.limits.sweep import Limit, Point, call_and_record_warnings, swept
from validation.engine.engine import Outcome
from validation.engine.random_numbers import random_generator
from validation.simulation.free_vibration import WHEEL
from validation.simulation.rolling_strip import RoughStrip, Strip, roll_strip
from validation.simulation.spring_tracks import FINE, STRIDES, RoughTrack, coarsen
from validation.simulation.track_spectrum import TrackSpectrum, self_affine
from validation.theory.rolling import force_variance

UNIT_TRACK = 2
"""The spawn key of a track of unit height."""

LINEAR = Limit(
    name="linear",
    method="MDR, linear filter",
    title="rough track",
    parameter="height h_rms / d",
    error="force, over its fluctuation",
    reference="one-sided springs on the same track",
    condition="h / d = 2 c tolerance, c = rms dF / (E* a h): second-order effect of the moving ends of the contact",
    failing_side="above",
    tolerance=0.1,
    factor=2.0,
    derived=True,
    warned=True,
)
FILTER_3D = Limit(
    name="linear in 3D",
    method="linear theory, 3D",
    title="rough strip",
    parameter="height h_rms / d",
    error="force, over its fluctuation",
    reference="boundary elements on the same strip",
    condition=(
        "√(π/8) g a / d = tolerance, g = √2 h' the rms gradient: the part out of contact by Persson, weighted with the "
        "pressure of a flat punch"
    ),
    failing_side="above",
    tolerance=0.2,
    factor=3.0,
)
SPACING = Limit(
    name="spacing",
    method="MDR",
    title="springs too far apart",
    parameter="springs to the shortest wave",
    error="last one-third octave [dB]",
    reference=f"{FINE} springs to the shortest wave",
    condition="4 springs: z / sin z = 0.91 dB at z = π/4",
    failing_side="below",
    tolerance=1.0,
    factor=1.75,
    derived=True,
    warned=True,
)


@dataclass(frozen=True, kw_only=True)
class TrackHeights:
    """One track of unit height, in units of a wheel with a = d = E* = 1, made higher and higher."""

    seed: int
    length: float
    hurst: float = HURST
    last: float = 8.0
    heights: tuple[float, ...] = (0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.45, 0.7, 1.0)
    springs: int = 32

    def sweep(self) -> Outcome:
        """The linear filter against one-sided springs: difference about its mean, over the fluctuation."""
        spectrum = self_affine(self.hurst, 1.0, self.last)
        unit = mdr.rough_profile(
            TrackSpectrum(spectrum, "geike"),
            length=self.length,
            points=round(self.length * self.springs),
            rng=random_generator(self.seed, UNIT_TRACK),
            rms=1.0,
        )

        def point(height: float) -> Point:
            spacing = 1 / self.springs
            roll = partial(mdr.roll, height * unit, spacing=spacing, radius=1.0, modulus=1.0, approach=1.0)
            linear, message = call_and_record_warnings(partial(roll, contact="linear"))
            assert linear is not None
            return float(np.std(linear.force - roll().force) / np.std(linear.force)), message

        c = math.sqrt(force_variance(spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0))
        return swept(LINEAR, self.heights, [point(height) for height in self.heights], 2 * c * LINEAR.tolerance)


@dataclass(frozen=True, kw_only=True)
class StripHeights:
    """One strip of unit height in the same units, made higher and higher."""

    seed: int
    length: float
    cells: int
    hurst: float = HURST
    last: float = 8.0
    heights: tuple[float, ...] = (0.003, 0.01, 0.02, 0.04, 0.08, 0.12, 0.18, 0.27, 0.4, 0.7)
    width: float = 12.0

    def sweep(self) -> Outcome:
        """Linear theory of the half-space against boundary elements, alike; failed: positions that did not converge."""
        spectrum = self_affine(self.hurst, 1.0, self.last)
        points: list[Point] = []
        failed = 0.0
        for height in self.heights:
            scene = RoughStrip(spectrum=spectrum, height=height, length=self.length, width=self.width, seed=self.seed)
            strip = Strip(scene=scene, realisation=0, cells=self.cells, tolerance=1e-4)
            found, message = call_and_record_warnings(partial(roll_strip, strip))
            assert found is not None
            points.append((float(np.nanstd(found["force"] - found["linear"]) / np.std(found["linear"])), message))
            failed += float(found["failed"])
        threshold = FILTER_3D.tolerance / (math.sqrt(math.pi / 8) * spectrum.gradient)
        return {**swept(FILTER_3D, self.heights, points, threshold), "failed": np.array(failed)}


@dataclass(frozen=True, kw_only=True)
class CoarserSprings:
    """Springs of many spacings on one track of little roughness: the solve of the case `wheel_stability`."""

    seed: int

    def sweep(self) -> Outcome:
        """The last one-third octave on coarser springs; messages are those of drawing such a track."""
        track = RoughTrack(rms=1e-3 * WHEEL.approach, seed=self.seed, waves=9, per_wave=FINE)
        levels = coarsen(track)["level"]
        draws = [partial(track.heights, 1, track.points // stride) for stride in STRIDES]
        messages = [call_and_record_warnings(draw)[1] for draw in draws]
        errors = [abs(decibel(level)) if level > 0 else math.inf for level in levels]
        return swept(SPACING, FINE / np.array(STRIDES), list(zip(errors, messages, strict=True)), 4.0)
