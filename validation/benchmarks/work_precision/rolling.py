"""A wheel that rolls over isotropic roughness, on the charts: rms and spectrum of its force.

Units: contact radius a = 1 of the smooth wheel, approach d = 1, E* = 1; so R = 1, and the force of Hertz is 4/3.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar, Literal

import numpy as np

import bem3d
import mdr
from validation.analysis.spectra import Bands, levels, waves
from validation.benchmarks.timing import Configuration, NamedMethod
from validation.benchmarks.work_precision.problem import (
    POLONSKY_KEER,
    ChartProblem,
    CountedSpectrum,
    Found,
    Grids,
    Quantity,
    along_a_track,
    linear_power,
    log_power,
)
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import FloatArray
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.simulation.method import Prepared, Resolution, Result, Solve, Values
from validation.simulation.pressed import MOST_ITERATIONS
from validation.simulation.rolling_strip import HERTZ, RoughStrip, crop_to_reach
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, self_affine
from validation.theory import rolling as rolling_theory

SMOOTH = {"radius": 1.0, "modulus": 1.0, "approach": 1.0}
WARM = 40
"""Positions before the clock runs: frames that find their size, plans."""
WINDOW = 3
"""Contact radii of the window on which Polonsky and Keer's iteration solves each position."""
GRIDS = Grids(cells=(3, 4, 6, 12), polonsky_keer=(4,), fixed=6, per="to a radius")
Roller = Callable[[FloatArray, int, float], Callable[[], Found]]
"""Of a surface, cells to a contact radius and a residual: a function that returns force and work."""


@dataclass(frozen=True, kw_only=True)
class RollingProblem(ChartProblem):
    """A wheel over self-affine roughness, q a from 1 to `last`, at a fixed approach.

    hurst; height: h_rms / d; last: q a of the shortest wave; length, width: of periodic strips over a; realisations:
    of strips; tracks: of springs, their own; filtered: cells for the linear filter; springs: to a contact radius; seed:
    zero or positive.
    """

    name: ClassVar = "rolling force"
    # of the force at a place of an endless track
    quantities: ClassVar = (
        Quantity(name="rms", log=lambda values: log_power(values, "variance") / 2, needs=("variance",)),
        Quantity(name="spectrum", log=partial(log_power, name="level"), needs=("level",), decibel=True),
    )
    hurst: float = 0.7
    height: float = 0.1
    last: float = 10.0
    length: int = 24
    width: int = 16
    realisations: int = 3
    tracks: int = 20
    grids: Grids = GRIDS
    filtered: tuple[int, ...] = (4, 6)
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
        springs, strips = (springs_along_tracks, "linear", "one-sided"), (force_along_strips, _filtered)
        return along_a_track(self, linear_spectrum, springs, strips, self.tracks)

    @property
    def method(self) -> NamedMethod:
        return NamedMethod("BEM", force_along_strips, (_roll,))

    @property
    def published(self) -> NamedMethod:
        return NamedMethod(POLONSKY_KEER, force_along_strips, (_roll_published,))


def linear_spectrum(scene: RollingProblem, resolution: Resolution) -> Prepared:
    """Linear theory in closed form: the variance at a place, and C_F along the track at the waves of a strip."""
    c2d = CountedSpectrum(lambda q: np.asarray(scene.height**2 * scene.spectrum.c2d(q)))
    settings: dict[str, Any] = {"edges": scene.spectrum.edges, "contact_radius": 1.0, "modulus": 1.0}
    dq = 2 * np.pi / scene.length
    q = dq * np.arange(1, int(scene.bands.edges[-1] / dq) + 1)

    def solve() -> tuple[float, FloatArray]:
        c2d.nodes = 0
        variance = rolling_theory.force_variance(c2d, **settings)
        return variance, dq * rolling_theory.force_spectrum_3d(q, c2d, **settings)

    def read(found: tuple[float, FloatArray]) -> Result:
        variance, level = found[0], scene.bands.sums(q, found[1]).real
        return Result({"variance": np.array(variance / HERTZ**2), "level": level / HERTZ**2}, c2d.nodes)

    return lambda _: Solve(solve, read)


def springs_along_tracks(
    scene: RollingProblem, resolution: Resolution, spectrum: InputSpectrum, contact: Literal["one-sided", "linear"]
) -> Prepared:
    """One-sided, or the filter (14.11) on them. Raises ValueError for waves that springs do not resolve."""
    springs = round(resolution.size)
    scene.rough_strip.track(spectrum, springs, 0)

    def draw(realisation: int) -> Solve:
        track = scene.rough_strip.track(spectrum, springs, realisation)
        solve = partial(mdr.roll, track, spacing=1 / springs, contact=contact, **SMOOTH)

        def read(found: mdr.RollingTrack) -> Result:
            force = found.force / HERTZ
            # sums of neighbours cost as much as two looks at each spring
            work = float(found.examined.sum()) + 2 * track.size
            level = levels(waves(force, spacing=1 / springs), scene.bands)
            return Result({"variance": np.array(force.var()), "level": level}, work)

        return Solve(solve, read)

    return draw


def force_along_strips(scene: RollingProblem, resolution: Resolution, rolled: Roller) -> Prepared:
    """Beside that of linear theory on each strip, and its mean over all phases of these waves.

    Raises ValueError for waves that cells do not resolve.
    """
    cells = round(resolution.size)

    def variance_and_level(force: FloatArray, kind: str = "") -> Values:
        level = levels(waves(force, spacing=1 / cells), scene.bands)
        return {f"{kind}variance": np.array(force.var()), f"{kind}level": level}

    def draw(realisation: int) -> Solve:
        surface = scene.rough_strip.surface(cells, realisation)
        linear = rolling_theory.linear_force(surface, spacing=1 / cells, **SMOOTH) / HERTZ
        q, power = linear_power(surface, 1 / cells, contact_radius=1.0, modulus=1.0, load=HERTZ)
        along = slice(1, (q.size - 1) // 2 + 1)
        mean = {"mean variance": np.array(power.sum()), "mean level": scene.bands.sums(q[along], power[along]).real}
        known = {**variance_and_level(linear, "linear "), **mean}
        solve = rolled(surface, cells, resolution.residual)
        return Solve(solve, lambda found: Result({**variance_and_level(found[0] / HERTZ), **known}, found[1]))

    draw(0)
    return draw


def _filtered(surface: FloatArray, cells: int, tolerance: float) -> Callable[[], Found]:
    """Each wave by its response."""
    return lambda: (rolling_theory.linear_force(surface, spacing=1 / cells, **SMOOTH), surface.size)


def _roll(surface: FloatArray, cells: int, tolerance: float) -> Callable[[], Found]:
    """Each position from the two before; applications times the cells of a square around the smooth contact.

    Frames and their plans belong to the strip: they are made by rolling over its beginning.
    """
    height = crop_to_reach(surface, 1 / cells)
    track = bem3d.Track(height=height, spacing=1 / cells, radius=1.0, modulus=1.0)

    def roll(positions: int) -> Found:
        wheel = bem3d.RollingContact(track, tolerance=tolerance)
        along = [wheel.press(position, SMOOTH["approach"]) for position in range(positions)]
        failed = sum(not contact.converged for contact in along)
        if failed:
            raise NotConvergedError(f"{failed} of {positions} positions did not converge")
        work = sum(contact.operator_applications for contact in along) * (2 * cells) ** 2
        return np.array([contact.force for contact in along]), float(work)

    roll(min(WARM, len(height)))
    return lambda: roll(len(height))


def _roll_published(surface: FloatArray, cells: int, tolerance: float) -> Callable[[], Found]:
    """One cold solve of Polonsky and Keer's a position, on a window that moves with the wheel."""
    half_space, gap = moving_window(surface, cells)
    solve = partial(bem3d.solve_polonsky_keer, half_space, tolerance=tolerance, max_iterations=MOST_ITERATIONS)

    def roll() -> Found:
        contacts = [solve(gap(position), approach=1.0) for position in range(len(surface))]
        work = sum(contact.operator_applications * contact.pressure.size for contact in contacts)
        return np.array([contact.force for contact in contacts]), float(work)

    half_space.displacement(gap(0))
    return roll


def moving_window(surface: FloatArray, cells: int) -> tuple[bem3d.HalfSpace, Callable[[int], FloatArray]]:
    """A half-space of three contact radii that moves with the wheel, and the gap on it at each position."""
    n, spacing = 2 * math.ceil(WINDOW * cells / 2), 1 / cells
    first = (surface.shape[1] - n) // 2
    height, ahead = surface[:, first : first + n], np.arange(n) - n // 2
    # the wheel stands over a cell along the track, and in the middle of the strip across it
    x, y = ahead * spacing, (np.arange(n) + first - (surface.shape[1] - 1) / 2) * spacing
    sphere = (x[:, np.newaxis] ** 2 + y**2) / 2
    half_space = bem3d.HalfSpace(shape=(n, n), spacing=spacing, modulus=1.0)
    return half_space, lambda position: sphere - height.take(ahead + position, axis=0, mode="wrap")
