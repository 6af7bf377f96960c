"""Speed against accuracy of a wheel that rolls over isotropic roughness: rms and spectrum of its force.

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
from validation.benchmarks.work_precision.exact_problem import MOST_ITERATIONS
from validation.benchmarks.work_precision.grids import Refined
from validation.benchmarks.work_precision.measurement import (
    CLOSED,
    FED,
    FILTER_1D,
    FILTER_3D,
    MDR,
    PLAIN,
    Answers,
    Configuration,
    Draw,
    FloatArray,
    Quantity,
    SolveResult,
    TimedSolve,
)
from validation.simulation.rolling_strip import HERTZ, Strip, Tracks, crop_to_reach
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, self_affine
from validation.theory import rolling as rolling_theory

SMOOTH = {"radius": 1.0, "modulus": 1.0, "approach": 1.0}
WARM = 40
"""Positions before the clock runs: frames that find their size, plans."""
WINDOW = 3
"""Contact radii of the window on which the textbook's iteration solves each position."""


def log_rms(answers: Answers) -> FloatArray:
    """ln of the root mean square, over that of linear theory on the same surfaces, times what this has in the mean."""
    variance, linear, exact = (answers[name].mean(axis=0) for name in ("variance", "linear variance", "mean variance"))
    return np.asarray(np.log(np.atleast_1d(variance / linear * exact)) / 2)


def log_levels(answers: Answers) -> FloatArray:
    """The same of the level in each band, which is a power."""
    level, linear, mean = (answers[name].mean(axis=0) for name in ("level", "linear level", "mean level"))
    with np.errstate(divide="ignore"):
        return np.asarray(np.log(level / linear * mean))


@dataclass(frozen=True, kw_only=True)
class RollingProblem(Refined):
    """A wheel over self-affine roughness, q a from 1 to `last`, at a fixed approach.

    hurst; height: h_rms / d; last: q a of the shortest wave; length, width: of periodic strips over a; strips, tracks:
    realisations; filtered: cells for the linear filter; springs: to a contact radius; seed: zero or positive.
    """

    hurst: float = 0.7
    height: float = 0.1
    last: float = 10.0
    length: int = 24
    width: int = 16
    strips: int = 3
    tracks: int = 20
    cells: tuple[int, ...] = (3, 4, 6, 12)
    plain: tuple[int, ...] = (4,)
    filtered: tuple[int, ...] = (4, 6)
    springs: tuple[int, ...] = (3, 4, 8, 16, 32)
    fixed: int = 6
    per: ClassVar[str] = "to a radius"
    seed: int = 151

    @property
    def name(self) -> str:
        """For tables and figures."""
        return "rolling force"

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """Of the force at a place of an endless track."""
        names = ("variance", "linear variance", "mean variance"), ("level", "linear level", "mean level")
        return (
            Quantity(name="rms", log=log_rms, needs=names[0]),
            Quantity(name="spectrum", log=log_levels, needs=names[1], decibel=True),
        )

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        """Of the surfaces, for unit height."""
        return self_affine(self.hurst, 1.0, self.last)

    @property
    def bands(self) -> Bands:
        """One-third octaves within the band of the roughness."""
        return Bands.around(np.pi, 1.0, self.last).on(self.length)

    def strip(self, realisation: int, cells: int) -> Strip:
        """The same on every grid."""
        return Strip(
            spectrum=self.spectrum,
            height=self.height,
            realisation=realisation,
            length=float(self.length),
            width=float(self.width),
            cells=cells,
            tolerance=self.tight,
            seed=self.seed,
        )

    def track(self, input_spectrum: InputSpectrum, springs: int, realisation: int) -> FloatArray:
        """For springs."""
        tracks = Tracks(
            spectrum=self.spectrum,
            input_spectrum=input_spectrum,
            height=self.height,
            realisations=self.tracks,
            length=float(self.length),
            springs=springs,
            bands=self.bands,
            seed=self.seed,
        )
        return tracks.track(realisation)

    def attempts(self) -> tuple[Configuration, ...]:
        """Linear theory three times, springs fed twice, plain and fast boundary elements."""
        along: dict[str, Any] = {
            "knob": "# springs to a radius",
            "realisations": self.tracks,
            "paired": False,
            "scene": self,
        }
        return (
            RollingLinearSpectrum(line=CLOSED, knob="linear theory", value=1.0, paired=False, scene=self),
            *(OnTrack(line=line, value=n, **along) for line in (FILTER_1D, MDR, FED) for n in self.springs),
            *(
                RollingFiltered(
                    line=FILTER_3D, knob="# cells to a radius", value=n, realisations=self.strips, scene=self
                )
                for n in self.filtered
            ),
            *self.grids(),
        )

    def on_grid(self, **settings: Any) -> "OnStrip":
        """Boundary elements."""
        return OnStrip(realisations=self.strips, scene=self, **settings)

    def read(self, force: FloatArray, linear: FloatArray, mean: Answers, spacing: float, visits: float) -> SolveResult:
        """Variance and levels of a force, and of the linear one on the same surface; over the force of Hertz."""
        return SolveResult(
            {
                "variance": np.array(force.var()),
                "level": levels(waves(force, spacing=spacing), self.bands),
                "linear variance": np.array(linear.var()),
                "linear level": levels(waves(linear, spacing=spacing), self.bands),
                **mean,
            },
            visits,
        )

    def alone(self, variance: float, level: FloatArray, visits: float) -> SolveResult:
        """What has no surface of its own, or many tracks."""
        one, ones = np.ones(()), np.ones(level.size)
        found = {"variance": np.array(variance), "linear variance": one, "mean variance": one}
        return SolveResult({**found, "level": level, "linear level": ones, "mean level": ones}, visits)

    def mean(self, surface: FloatArray, spacing: float) -> Answers:
        """Variance at a place and levels of the linear force, in the mean over all phases of these waves."""
        nx, ny = surface.shape
        qx, qy = (2 * np.pi * np.fft.fftfreq(n, spacing) for n in (nx, ny))
        response = rolling_theory.response(np.hypot(qx[:, np.newaxis], qy), contact_radius=1.0, modulus=1.0)
        power = (np.abs(response * np.fft.fft2(surface, norm="forward") / HERTZ) ** 2).sum(axis=1)
        along = slice(1, (nx - 1) // 2 + 1)
        level = self.bands.sums(qx[along], power[along]).real
        return {"mean variance": np.array(power.sum()), "mean level": level}


@dataclass(frozen=True, kw_only=True)
class RollingLinearSpectrum(Configuration):
    """Linear theory in closed form: the variance at a place, and C_F along the track at the waves of a strip."""

    scene: RollingProblem

    def prepare(self) -> Draw:
        """Nothing to do."""
        scene = self.scene
        seen = [0]

        def c2d(q: FloatArray) -> FloatArray:
            seen[0] += q.size
            return np.asarray(scene.height**2 * scene.spectrum.c2d(q))

        settings = {"edges": scene.spectrum.edges, "contact_radius": 1.0, "modulus": 1.0}
        dq = 2 * np.pi / scene.length
        q = dq * np.arange(1, int(scene.bands.edges[-1] / dq) + 1)

        def solve() -> tuple[float, FloatArray]:
            seen[0] = 0
            variance = rolling_theory.force_variance(c2d, **settings)  # type: ignore[arg-type]
            return variance, dq * rolling_theory.force_spectrum_3d(q, c2d, **settings)  # type: ignore[arg-type]

        def read(found: tuple[float, FloatArray]) -> SolveResult:
            level = scene.bands.sums(q, found[1]).real
            return scene.alone(found[0] / HERTZ**2, level / HERTZ**2, seen[0])

        return lambda _: TimedSolve(solve, read)


@dataclass(frozen=True, kw_only=True)
class OnTrack(Configuration):
    """Springs along a track of their own, one-sided or the filter (14.11) on them."""

    scene: RollingProblem

    def prepare(self) -> Draw:
        """Refuses waves that springs do not resolve."""
        scene, springs = self.scene, round(self.value)
        input_spectrum: InputSpectrum = "rolling" if self.line == FED else "geike"
        contact = "linear" if self.line == FILTER_1D else "one-sided"
        scene.track(input_spectrum, springs, 0)

        def draw(realisation: int) -> TimedSolve:
            track = scene.track(input_spectrum, springs, realisation)
            solve = partial(mdr.roll, track, spacing=1 / springs, contact=contact, **SMOOTH)  # type: ignore[arg-type]

            def read(found: mdr.RollingTrack) -> SolveResult:
                force = found.force / HERTZ
                # sums of neighbours cost as much as two looks at each spring
                visits = float(found.examined.sum()) + 2 * track.size
                level = levels(waves(force, spacing=1 / springs), scene.bands)
                return scene.alone(float(force.var()), level, visits)

            return TimedSolve(solve, read)

        return draw


@dataclass(frozen=True, kw_only=True)
class RollingFiltered(Configuration):
    """Linear theory on the same surface: each wave by its response."""

    scene: RollingProblem

    def prepare(self) -> Draw:
        """Nothing to do."""
        scene, cells = self.scene, round(self.value)

        def draw(realisation: int) -> TimedSolve:
            surface = scene.strip(realisation, cells).surface()
            mean = scene.mean(surface, 1 / cells)

            def read(force: FloatArray) -> SolveResult:
                return scene.read(force / HERTZ, force / HERTZ, mean, 1 / cells, surface.size)

            return TimedSolve(partial(rolling_theory.linear_force, surface, spacing=1 / cells, **SMOOTH), read)

        return draw


@dataclass(frozen=True, kw_only=True)
class OnStrip(Configuration):
    """Boundary elements, position by position: fast ones each from the two before, plain ones each cold."""

    scene: RollingProblem
    cells: int
    tolerance: float

    def prepare(self) -> Draw:
        """Refuses waves that cells do not resolve."""
        scene, spacing = self.scene, 1 / self.cells

        def draw(realisation: int) -> TimedSolve:
            surface = scene.strip(realisation, self.cells).surface()
            linear = rolling_theory.linear_force(surface, spacing=spacing, **SMOOTH) / HERTZ
            mean = scene.mean(surface, spacing)
            roll = (_plain if self.line == PLAIN else _fast)(surface, self.cells, self.tolerance)

            def read(found: tuple[FloatArray, float]) -> SolveResult:
                return scene.read(found[0] / HERTZ, linear, mean, spacing, found[1])

            return TimedSolve(roll, read)

        draw(0)
        return draw


def _fast(surface: FloatArray, cells: int, tolerance: float) -> Callable[[], tuple[FloatArray, float]]:
    """Force, and applications times the cells of a square around the smooth contact.

    Frames and their plans belong to the strip: they are made by rolling over its beginning.
    """
    height = crop_to_reach(surface, 1 / cells)
    track = bem3d.Track(height=height, spacing=1 / cells, radius=1.0, modulus=1.0)

    def roll(positions: int) -> tuple[FloatArray, float]:
        wheel = bem3d.RollingContact(track, tolerance=tolerance)
        along = [wheel.press(position, SMOOTH["approach"]) for position in range(positions)]
        lost = sum(not contact.converged for contact in along)
        if lost:
            raise RuntimeError(f"{lost} of {positions} positions did not converge")
        visits = sum(contact.operator_applications for contact in along) * (2 * cells) ** 2
        return np.array([contact.force for contact in along]), float(visits)

    roll(min(WARM, len(height)))
    return lambda: roll(len(height))


def _plain(surface: FloatArray, cells: int, tolerance: float) -> Callable[[], tuple[FloatArray, float]]:
    """The same by one cold solve of the textbook's a position, on a window that moves with the wheel."""
    n, spacing = 2 * math.ceil(WINDOW * cells / 2), 1 / cells
    first = (surface.shape[1] - n) // 2
    height = surface[:, first : first + n]
    half_space = bem3d.HalfSpace(shape=(n, n), spacing=spacing, modulus=1.0)
    ahead = np.arange(n) - n // 2
    # the wheel stands over a cell along the track, and in the middle of the strip across it
    x, y = ahead * spacing, (np.arange(n) + first - (surface.shape[1] - 1) / 2) * spacing
    sphere = (x[:, np.newaxis] ** 2 + y**2) / 2

    def roll() -> tuple[FloatArray, float]:
        force, visits = np.empty(len(surface)), 0.0
        for position in range(len(surface)):
            gap = sphere - height.take(ahead + position, axis=0, mode="wrap")
            contact = bem3d.solve_polonsky_keer(
                half_space, gap, approach=1.0, tolerance=tolerance, max_iterations=MOST_ITERATIONS
            )
            force[position] = contact.force
            visits += contact.operator_applications * n**2
        return force, visits

    half_space.displacement(sphere)
    return roll
