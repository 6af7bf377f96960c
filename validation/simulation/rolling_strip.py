"""A wheel rolled over roughness, by boundary elements and by springs, beside linear theory: isotropic, or in ridges.

Units: contact radius a = 1 of the smooth wheel, approach d = 1, E* = 1; so R = 1, and the force of Hertz is 4/3. Levels
of linear theory are over the square of that, for h_rms = 1. Read backwards, its filters give the roughness, int C_1D dq
over each band, of levels of the force: Geike's, half of the mean square height of its waves.
"""

import math
import warnings
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, partial
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

import bem3d
import mdr
from validation.analysis.spectra import Bands, levels, waves
from validation.engine.engine import Engine, FloatArray, Outcome
from validation.engine.realisations import FEWEST, NotConvergedError, random_generator
from validation.simulation.surface import draw_surface, draw_track, middle_of
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, TrackSpectrum
from validation.theory.rolling import (
    Spectrum,
    force_spectrum_1d,
    force_spectrum_3d,
    linear_force,
    mean_force_spectrum_1d,
)

K = TypeVar("K", bound=Hashable)

HERTZ, STIFFNESS = 4 / 3, 2.0
"""Force and stiffness 2 E* a of the smooth wheel."""
SMOOTH: dict[str, Any] = {"radius": 1.0, "modulus": 1.0, "approach": 1.0}
TRACKS, STRIPS = 1, 2
"""Keys of random numbers: the roughness of both methods."""
POINTS = 48
"""Points of the midpoint rule in each band."""
ROUNDING = 1e-300
"""Where (14.12) is zero, its level is rounding's, which is no reference."""


@dataclass(frozen=True, kw_only=True)
class RoughStrip:
    """A rough strip under the wheel, the scene of both methods: a surface on any grid, and tracks of springs for it.

    spectrum; height: rms, over d; length, width: of the periodic surface that is drawn, over a, of which the wheel
    rolls along the middle; seed: zero or positive.
    """

    spectrum: PiecewisePowerLaw
    height: float
    length: float
    width: float
    seed: int

    def surface(self, cells: int, realisation: int) -> FloatArray:
        """Heights at the centres of all cells, so many to a contact radius; the same surface on every grid."""
        sides = self.length * cells, self.width * cells
        for name, side in zip(("length", "width"), sides, strict=True):
            if abs(side - round(side)) > 1e-9 * side:
                raise ValueError(f"{name} must be a whole number of cells, got {side:g}")
        unit = draw_surface(
            self.spectrum.c2d,
            shape=(round(sides[0]), round(sides[1])),
            spacing=1 / cells,
            rng=random_generator(self.seed, STRIPS, realisation),
            rms=1.0,
        )
        return np.asarray(self.height * unit)

    def track(self, input_spectrum: InputSpectrum, springs: int, realisation: int) -> FloatArray:
        """Heights of so many springs to a contact radius."""
        rng, points = random_generator(self.seed, TRACKS, realisation), round(self.length * springs)
        unit = draw_track(self.spectrum, input_spectrum, length=self.length, points=points, rng=rng, rms=1.0)
        return np.asarray(self.height * unit)

    def strips(self, cells: int, tolerance: float, count: int) -> list["Strip"]:
        """The first so many realisations on a grid."""
        return [Strip(scene=self, realisation=i, cells=cells, tolerance=tolerance) for i in range(count)]


@dataclass(frozen=True, kw_only=True)
class Strip:
    """One realisation, rolled over at d = 1 by boundary elements. cells: to a contact radius; tolerance: residual."""

    scene: RoughStrip
    realisation: int
    cells: int
    tolerance: float

    def surface(self) -> FloatArray:
        return self.scene.surface(self.cells, self.realisation)


@dataclass(frozen=True, kw_only=True)
class Tracks:
    """The first so many tracks, rolled over at d = 1 on springs, so many to a contact radius. bands: of the levels."""

    scene: RoughStrip
    input_spectrum: InputSpectrum
    realisations: int
    springs: int
    bands: Bands

    def heights(self) -> list[FloatArray]:
        return [self.scene.track(self.input_spectrum, self.springs, i) for i in range(self.realisations)]


def roll_strip(strip: Strip) -> Outcome:
    """Force over that of Hertz at each cell: boundary elements, and linear theory on the same surface.

    failed: positions that did not converge, whose force is NaN.
    """
    surface, spacing = strip.surface(), 1 / strip.cells
    linear = linear_force(surface, spacing=spacing, **SMOOTH)
    rolling = bem3d.roll(
        crop_to_reach(surface, spacing), spacing=spacing, tolerance=strip.tolerance, raise_on_failure=False, **SMOOTH
    )
    return {
        "force": rolling.force / HERTZ,
        "linear": linear / HERTZ,
        "failed": np.array(float(np.count_nonzero(~rolling.converged))),
    }


def roll_strips(groups: Mapping[K, Sequence[Strip]], engine: Engine) -> tuple[dict[K, list[Outcome]], tuple[str, ...]]:
    """Outcomes of each group, and a line for each strip with positions that did not converge.

    Raises NotConvergedError where fewer than three strips of a group have converged everywhere.
    """
    outcomes = engine.map_groups(roll_strip, groups)
    unconverged = tuple(
        f"strip {s.realisation}, h/d = {s.scene.height:g}, {s.cells} cells to a radius: {int(o['failed'])} positions, "
        f"{s.scene.spectrum}"
        for key, strips in groups.items()
        for s, o in zip(strips, outcomes[key], strict=True)
        if o["failed"]
    )
    for key, strip_outcomes in outcomes.items():
        converged = sum(not outcome["failed"] for outcome in strip_outcomes)
        if converged < FEWEST:
            raise NotConvergedError(f"{converged} strips of {key} converged, {FEWEST} are needed", unconverged)
    return outcomes, unconverged


def crop_to_reach(surface: FloatArray, spacing: float) -> FloatArray:
    """The middle of a surface: no wider than the cells that can overlap with the wheel, wherever it stands."""
    return middle_of(surface, math.sqrt(2 * (1 + max(float(surface.max()), 0.0))), spacing)


def roll_tracks(tracks: Tracks) -> Outcome:
    """One-sided springs and the linear filter on the same tracks: their `levels_beside_linear`.

    wavenumber, spectrum: C_F itself of one-sided springs, the mean of all tracks.
    """
    spacing = 1 / tracks.springs
    force, linear = np.empty((2, tracks.realisations, round(tracks.scene.length * tracks.springs)))
    for i, height in enumerate(tracks.heights()):
        roll = partial(mdr.roll, height, spacing=spacing, **SMOOTH)
        with warnings.catch_warnings():
            # the range of the filter is under test
            warnings.simplefilter("ignore", mdr.LinearityWarning)
            force[i], linear[i] = roll().force / HERTZ, roll(contact="linear").force / HERTZ
    narrow = waves(force, spacing=spacing)
    in_bands = narrow.q < tracks.bands.edges[-1]
    return {
        **levels_beside_linear(force, linear, spacing, tracks.bands),
        "wavenumber": narrow.q[in_bands],
        "spectrum": narrow.spectrum.mean(axis=0)[in_bands],
    }


def strip_levels(outcomes: list[Outcome], spacing: float, bands: Bands) -> Outcome:
    """`levels_beside_linear` of strips; NaN in rows of strips with a position that did not converge."""
    force, linear = (np.array([outcome[name] for outcome in outcomes]) for name in ("force", "linear"))
    return levels_beside_linear(force, linear, spacing, bands)


def levels_beside_linear(force: FloatArray, linear: FloatArray, spacing: float, bands: Bands) -> Outcome:
    """Forces beside those of linear theory on the same roughness, one row a realisation, over the force of Hertz.

    level, linear level: int C_F dq over each band, (realisations, bands); mean, variance of the force, linear variance:
    (realisations,).
    """
    return {
        "level": levels(waves(force, spacing=spacing), bands),
        "linear level": levels(waves(linear, spacing=spacing), bands),
        "mean": force.mean(axis=1),
        "variance": force.var(axis=1),
        "linear variance": linear.var(axis=1),
    }


def roll_loaded_strip(strip: Strip) -> Outcome:
    """Boundary elements under a constant load: k = dF/dd at a constant contact area, over 2 E* a; failed: positions."""
    track = bem3d.Track(
        height=np.ascontiguousarray(crop_to_reach(strip.surface(), 1 / strip.cells)),
        spacing=1 / strip.cells,
        radius=1.0,
        modulus=1.0,
    )
    wheel = bem3d.RollingContact(track, tolerance=strip.tolerance)
    stiffness = np.array([tangent_stiffness(wheel, position) for position in range(len(track.height))]) / STIFFNESS
    return {"stiffness": stiffness, "failed": np.array(float(np.isnan(stiffness).sum()))}


def tangent_stiffness(wheel: bem3d.RollingContact, position: int) -> float:
    """dF/dd of the contact under the load of Hertz over one cell of the track; NaN where it does not converge."""
    if not wheel.carry(position, HERTZ).converged:
        return math.nan
    _, _, pressure = wheel.pressure()
    body = half_space(pressure.shape, wheel.track.spacing)
    return bem3d.solve_fixed_area(body, pressure > 0, tolerance=1e-3).stiffness


@cache
def half_space(shape: tuple[int, int], spacing: float) -> bem3d.HalfSpace:
    """A half-space with E* = 1, made once a shape: frames along a track have few."""
    return bem3d.HalfSpace(shape=shape, spacing=spacing, modulus=1.0)


def roll_loaded_tracks(tracks: Tracks) -> Outcome:
    """One-sided springs: `stiffness_moments` along each track."""
    spacing = 1 / tracks.springs
    with warnings.catch_warnings():
        # the smooth contact has springs enough, which is what the warning is about
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        rolled = [mdr.roll(h, spacing=spacing, radius=1.0, modulus=1.0, force=HERTZ) for h in tracks.heights()]
    return stiffness_moments(np.array([track.stiffness for track in rolled]) / STIFFNESS)


def stiffness_moments(stiffness: FloatArray) -> Outcome:
    """Mean and variance along each track, the last axis."""
    return {"mean": np.asarray(stiffness.mean(axis=-1)), "variance": np.asarray(stiffness.var(axis=-1))}


@cache
def level_1d(spectrum: PiecewisePowerLaw, rule: InputSpectrum, bands: Bands) -> FloatArray:
    """int C_F dq over each band of springs with that input spectrum, (14.12)."""
    c1d = TrackSpectrum(spectrum, rule)
    return over_bands(lambda q: force_spectrum_1d(q, c1d, contact_radius=1.0, modulus=1.0), bands) / HERTZ**2


@cache
def level_3d(spectrum: PiecewisePowerLaw, bands: Bands) -> FloatArray:
    """int C_F dq over each band of the half-space, `force_3d`."""
    return over_bands(lambda q: force_3d(q, spectrum), bands) / HERTZ**2


def force_3d(q: FloatArray, spectrum: PiecewisePowerLaw) -> FloatArray:
    """C_F of the half-space, a = E* = 1, over the mean square height."""
    return force_spectrum_3d(q, spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0)


def over_bands(spectrum: Spectrum, bands: Bands) -> FloatArray:
    """int C dq over each band, by the midpoint rule."""
    edges = np.array(bands.edges)
    q = edges[:-1, np.newaxis] + np.diff(edges)[:, np.newaxis] * ((np.arange(POINTS) + 0.5) / POINTS)
    return np.asarray(spectrum(q).mean(axis=1) * np.diff(edges))


ASSUMED = 3.0
"""Exponent of C_2D within a one-third octave, which a measured force does not tell; the true one is 2 H + 2."""


def by_mean_filter(bands: Bands, levels: FloatArray) -> FloatArray:
    """(14.14): C_1D = q^2 C_F / (2 E*^2), by the mean of the filter over a band."""
    passed = over_bands(lambda q: mean_force_spectrum_1d(q, flat, modulus=1.0), bands) / HERTZ**2
    return np.asarray(levels * over_bands(flat, bands) / passed)


def by_filter_3d(bands: Bands, levels: FloatArray) -> FloatArray:
    """The heights of all bands, none negative, that have these levels, each met as well as all others, however small.

    A wave s of the surface has a part of its force in each band below s.
    """
    return np.asarray(nnls(filter_3d(bands) / levels[:, np.newaxis], np.ones(levels.size))[0])


def flat(q: FloatArray) -> FloatArray:
    """C_1D = pi q C_2D within a band, times any constant."""
    return np.asarray(q ** (1 - ASSUMED))


@cache
def filter_3d(bands: Bands) -> FloatArray:
    """Level of the force in each band (rows) of int C_1D dq = 1 in each band (columns): zero above the waves' own."""
    edges = zip(bands.edges, bands.edges[1:], strict=False)
    # a piece of unit height has int C_1D dq = 1/2 over positive q
    pieces = [PiecewisePowerLaw(edges=pair, exponents=(ASSUMED,)) for pair in edges]
    return np.stack([2 * level_3d(piece, bands) for piece in pieces], axis=1)


BEM, FILTER, FULL, SPRINGS = "bem3d", "(14.11)", "springs, full contact", "springs, one-sided"
CONTACT: dict[str, mdr.rolling.Contact] = {FILTER: "linear", FULL: "full", SPRINGS: "one-sided"}


@dataclass(frozen=True, kw_only=True)
class SuperposedRidges:
    """Many waves at once, with amplitudes as 1/q, so that the force is as large by every wave; a = d = E* = 1.

    length: of the track over a, the longest wave; shortest: q a of the last; height: rms, over d; seed.
    """

    length: int
    shortest: float
    height: float
    seed: int

    @cached_property
    def wavenumbers(self) -> FloatArray:
        """q a of all waves of the track, up to the shortest."""
        count = int(self.shortest * self.length / (2 * np.pi))
        return np.asarray(2 * np.pi / self.length * np.arange(1, count + 1))

    def heights(self, points: int) -> FloatArray:
        """The heights of the ridges at so many equidistant points of the track, (points,)."""
        q = self.wavenumbers
        x = self.length / points * np.arange(points)
        phase = 2 * np.pi * random_generator(self.seed).random(q.size)
        unit = np.cos(np.outer(x, q) + phase) @ (1 / q)
        return np.asarray(self.height * unit / math.sqrt(np.sum(0.5 / q**2)))

    def response(self, up: FloatArray, down: FloatArray, height: FloatArray) -> NDArray[np.complex128]:
        """The transfer function from height to force, (waves,); (up - down) / 2 has no even orders of the height."""
        waves = slice(1, self.wavenumbers.size + 1)
        return np.asarray(np.fft.rfft((up - down) / 2)[waves] / np.fft.rfft(height)[waves])


@dataclass(frozen=True, kw_only=True)
class RidgesTrack:
    """One track, rolled by one method, at the prescribed approach or at the force that belongs to it.

    cells: or springs, to a contact radius; tolerance: residual of boundary elements.
    """

    ridges: SuperposedRidges
    method: str
    cells: float
    prescribed: str = "approach"
    tolerance: float = 1e-10


def roll_over(track: RidgesTrack) -> Outcome:
    """Response to each wave over 2 E* a, real and imaginary part, of the force, or of the approach under a force."""
    ridges, by_approach = track.ridges, track.prescribed == "approach"
    points = round(ridges.length * track.cells)
    height = ridges.heights(points)
    settings: dict[str, Any] = {
        "spacing": ridges.length / points,
        "radius": 1.0,
        "modulus": 1.0,
        **({"approach": 1.0} if by_approach else {"force": 4 / 3}),
    }
    runs = [_roll(track, sign * height, settings) for sign in (1, -1)]
    up, down = (run.force if by_approach else run.approach for run in runs)
    response = ridges.response(up, down, height) / 2
    failed = sum(np.count_nonzero(~run.converged) for run in runs if isinstance(run, bem3d.Rolling))
    return {"response": np.stack([response.real, response.imag]), "failed": np.array(float(failed))}


def _roll(track: RidgesTrack, height: FloatArray, settings: dict[str, Any]) -> bem3d.Rolling | mdr.RollingTrack:
    """The ridges rolled over by the method of the track: on springs, or by boundary elements on a strip of them."""
    if track.method != BEM:
        return mdr.roll(height, contact=CONTACT[track.method], **settings)
    width = 2 * math.ceil(1.45 / settings["spacing"])
    strip = np.repeat(height[:, np.newaxis], width, axis=1)
    return bem3d.roll(strip, tolerance=track.tolerance, raise_on_failure=False, **settings)
