"""A wheel that rolls over isotropic roughness, on the charts: rms and spectrum of its force.

Units: contact radius a = 1 of the smooth wheel, approach d = 1, E* = 1; so R = 1, and the force of Hertz is 4/3.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar

import numpy as np

import bem3d
import mdr
from validation.analysis.spectra import Bands, levels, waves
from validation.benchmarks.timing import Configuration, NamedMethod, along
from validation.benchmarks.work_precision.problem import FILTER_3D, MDR, MDR_ROLLING, ChartProblem, ChartQuantity, Grids
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import FloatArray
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.simulation.method import Prepared, Resolution, Result, Solve, Values
from validation.simulation.rolling_strip import HERTZ, RoughStrip, crop_to_reach
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, self_affine
from validation.theory import rolling as rolling_theory

SMOOTH = {"radius": 1.0, "modulus": 1.0, "approach": 1.0}
WARM = 40
"""Positions before the clock runs: frames that find their size, plans."""
GRIDS = Grids(cells=(3, 4, 6, 12), fixed=6, per="to a radius")


def log_power(values: Values, name: str) -> FloatArray:
    """ln of the mean of a power; on a surface over that of linear theory there, times what this has in the mean."""
    power = values[name].mean(axis=0)
    if f"linear {name}" in values:
        power = power / values[f"linear {name}"].mean(axis=0) * values[f"mean {name}"].mean(axis=0)
    with np.errstate(divide="ignore"):
        return np.asarray(np.log(np.atleast_1d(power)))


@dataclass(frozen=True, kw_only=True)
class RollingProblem(ChartProblem):
    """A wheel over self-affine roughness, q a from 1 to `last`, at a fixed approach.

    hurst; height: h_rms / d; last: q a of the shortest wave; length, width: of periodic strips over a; realisations:
    of strips; tracks: of springs, their own; springs: to a contact radius; seed: zero or positive.
    """

    name: ClassVar = "rolling force"
    # of the force at a place of an endless track
    quantities: ClassVar = (
        ChartQuantity(name="rms", log=lambda values: log_power(values, "variance") / 2, needs=("variance",)),
        ChartQuantity(name="spectrum", log=partial(log_power, name="level"), needs=("level",), decibel=True),
    )
    hurst: float = 0.7
    height: float = 0.1
    last: float = 10.0
    length: int = 24
    width: int = 16
    realisations: int = 3
    tracks: int = 20
    grids: Grids = GRIDS
    springs: tuple[int, ...] = (3, 4, 8, 16, 32)
    seed: int = 151

    @property
    def scene(self) -> RollingScene:
        ground = Roughness(rms=self.height, hurst=self.hurst, longest=2 * math.pi, shortest=2 * math.pi / self.last)
        return RollingScene(name=self.name, radius=1.0, load=HERTZ, modulus=1.0, ground=ground)

    @property
    def served(self) -> tuple[str, ...]:
        """Bands of models are those of an endless track, and not of strips: the rms alone."""
        return ("force-rms",)

    def of_model(self, values: Values) -> Values:
        return {"variance": (values["force-rms"] / HERTZ) ** 2}

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        """Of the surfaces, for unit height."""
        return self_affine(self.hurst, 1.0, self.last)

    @property
    def bands(self) -> Bands:
        """One-third octaves within the band of the roughness."""
        return Bands.around(np.pi, 1.0, self.last).on(self.length)

    @property
    def rough_strip(self) -> RoughStrip:
        """The same on every grid."""
        length, width = float(self.length), float(self.width)
        return RoughStrip(spectrum=self.spectrum, height=self.height, length=length, width=width, seed=self.seed)

    def configurations(self) -> tuple[Configuration, ...]:
        """Linear theory, springs with both input spectra, boundary elements."""
        own: dict[str, Any] = {"realisations": self.tracks, "paired": False}
        spectra: dict[str, InputSpectrum] = {MDR: "geike", MDR_ROLLING: "rolling"}
        by_springs = [NamedMethod(name, springs_along_tracks, (spectrum,)) for name, spectrum in spectra.items()]
        return (
            *along(NamedMethod(FILTER_3D, linear_spectrum), self, (1.0,), "linear theory", paired=False),
            *(each for by in by_springs for each in along(by, self, self.springs, "# springs to a radius", **own)),
            *self.boundary_elements(),
        )

    @property
    def method(self) -> NamedMethod:
        return NamedMethod("BEM", force_along_strips)


def linear_spectrum(scene: RollingProblem, resolution: Resolution) -> Prepared:
    """Linear theory in closed form: the variance at a place, and C_F along the track at the waves of a strip."""

    def c2d(q: FloatArray) -> FloatArray:
        return np.asarray(scene.height**2 * scene.spectrum.c2d(q))

    settings: dict[str, Any] = {"edges": scene.spectrum.edges, "contact_radius": 1.0, "modulus": 1.0}
    dq = 2 * np.pi / scene.length
    q = dq * np.arange(1, int(scene.bands.edges[-1] / dq) + 1)

    def solve() -> tuple[float, FloatArray]:
        variance = rolling_theory.force_variance(c2d, **settings)
        return variance, dq * rolling_theory.force_spectrum_3d(q, c2d, **settings)

    def read(variance_and_spectrum: tuple[float, FloatArray]) -> Result:
        variance, level = variance_and_spectrum[0], scene.bands.sums(q, variance_and_spectrum[1]).real
        return Result({"variance": np.array(variance / HERTZ**2), "level": level / HERTZ**2})

    return lambda _: Solve(solve, read)


def springs_along_tracks(scene: RollingProblem, resolution: Resolution, spectrum: InputSpectrum) -> Prepared:
    """One-sided springs. Raises ValueError for waves that they do not resolve."""
    springs = round(resolution.size)
    scene.rough_strip.track(spectrum, springs, 0)

    def draw(realisation: int) -> Solve:
        track = scene.rough_strip.track(spectrum, springs, realisation)

        def read(rolled: mdr.RollingTrack) -> Result:
            force = rolled.force / HERTZ
            level = levels(waves(force, spacing=1 / springs), scene.bands)
            return Result({"variance": np.array(force.var()), "level": level})

        return Solve(lambda: mdr.roll(track, spacing=1 / springs, radius=1.0, modulus=1.0, approach=1.0), read)

    return draw


def force_along_strips(scene: RollingProblem, resolution: Resolution) -> Prepared:
    """Boundary elements, beside that of linear theory on each strip, and its mean over all phases of these waves.

    Raises ValueError for waves that cells do not resolve.
    """
    cells = round(resolution.size)

    def variance_and_level(force: FloatArray, kind: str = "") -> Values:
        level = levels(waves(force, spacing=1 / cells), scene.bands)
        return {f"{kind}variance": np.array(force.var()), f"{kind}level": level}

    def draw(realisation: int) -> Solve:
        surface = scene.rough_strip.surface(cells, realisation)
        linear = rolling_theory.linear_force(surface, spacing=1 / cells, **SMOOTH) / HERTZ
        q, power = linear_power(surface, 1 / cells)
        ahead = slice(1, (q.size - 1) // 2 + 1)
        mean = {"mean variance": np.array(power.sum()), "mean level": scene.bands.sums(q[ahead], power[ahead]).real}
        linear_theory = {**variance_and_level(linear, "linear "), **mean}
        solve = _roll(surface, cells, resolution.residual)
        return Solve(solve, lambda force: Result({**variance_and_level(force / HERTZ), **linear_theory}))

    draw(0)
    return draw


def linear_power(surface: FloatArray, spacing: float) -> tuple[FloatArray, FloatArray]:
    """Wavenumbers along the track, and the power of the linear force over HERTZ at each, all waves across added."""
    qx, qy = (2 * np.pi * np.fft.fftfreq(n, spacing) for n in surface.shape)
    response = rolling_theory.response(np.hypot(qx[:, np.newaxis], qy), contact_radius=1.0, modulus=1.0)
    force = response * np.fft.fft2(surface, norm="forward")
    return qx.astype(np.float64), np.asarray((np.abs(force / HERTZ) ** 2).sum(axis=1))


def _roll(surface: FloatArray, cells: int, tolerance: float) -> Callable[[], FloatArray]:
    """Each position from the two before.

    Frames and their plans belong to the strip: they are made by rolling over its beginning.
    """
    height = crop_to_reach(surface, 1 / cells)
    track = bem3d.Track(height=height, spacing=1 / cells, radius=1.0, modulus=1.0)

    def roll(positions: int) -> FloatArray:
        """The force at each of the first positions, in units of the scene."""
        wheel = bem3d.RollingContact(track, tolerance=tolerance)
        contacts = [wheel.press(position, SMOOTH["approach"]) for position in range(positions)]
        failed = sum(not contact.converged for contact in contacts)
        if failed:
            raise NotConvergedError(f"{failed} of {positions} positions did not converge")
        return np.array([contact.force for contact in contacts])

    roll(min(WARM, len(height)))
    return lambda: roll(len(height))
