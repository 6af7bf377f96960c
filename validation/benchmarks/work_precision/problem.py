"""The problems of the charts: quantities, configurations, references, and the measurement of all of them.

A sphere and a square punch, whose answers are known, the punch of Fig. 14.1, the same with a roll-off, and a wheel that
rolls over isotropic roughness. Units: E* = 1 and a length of what is pressed; of the wheel a = d = E* = R = 1.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, ClassVar, Literal

import numpy as np

import bem3d
import mdr
from validation.analysis.quantity import MEAN_STIFFNESS, RELATIVE_DEVIATION
from validation.analysis.spectra import Bands, levels, waves
from validation.analysis.statistics import POWER_DECIBEL
from validation.benchmarks.timing import (
    Configuration,
    NamedMethod,
    TimedProblem,
    along,
    configurations_of,
    time_in_turns,
)
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import NotConvergedError
from validation.scenes.indentation import IndentationScene
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.simulation import model_names
from validation.simulation.method import Method, Prepared, Resolution, Result, Solve, Values
from validation.simulation.model import Model
from validation.simulation.pressed import FIXED_AREA_RESIDUAL, press_on_grid, press_on_springs
from validation.simulation.rolling_strip import HERTZ, RoughStrip, crop_to_reach
from validation.simulation.rough_punch import PunchRoughness, RolledOffRoughness
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, self_affine
from validation.theory import closed_forms
from validation.theory import rolling as rolling_theory

CLOSED, FILTER_3D = model_names.CLOSED_FORM, model_names.FILTER_3D
MDR, MDR_ROLLING = model_names.SPRINGS, model_names.SPRINGS_ROLLING
BEM, LOOSE, EXTRAPOLATED = "BEM, finer cells", "BEM, looser residual", "BEM, extrapolated"
SPRINGS, ELEMENTS = (MDR, MDR_ROLLING), (BEM, LOOSE, EXTRAPOLATED)
BEM_METHOD = model_names.BEM
"""All of these as one method, whose settings they are."""
ROUNDING = 1e-12
"""What a closed form leaves open."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ChartQuantity:
    """A quantity of a problem.

    log: its natural logarithm from values, one number or one a band; needs: names of the values; order: of its error in
    the size of the cells; band: relative uncertainty of a reference that is not computed; decibel: whether errors are
    root mean squares of level differences [dB], of powers, or relative.
    """

    name: str
    log: Callable[[Values], FloatArray]
    needs: tuple[str, ...]
    order: float = 1.0
    band: float = ROUNDING
    decibel: bool = False

    def distance(self, log_ratio: FloatArray) -> float:
        """|ratio - 1|, or the root mean square of 10 lg ratio [dB]."""
        if self.decibel:
            return float(POWER_DECIBEL * np.sqrt(np.mean(log_ratio**2)))
        return float(np.abs(np.expm1(log_ratio)).max())


def mean_of(name: str, value: str = "", **settings: Any) -> ChartQuantity:
    """The mean of a value, by default that of its name."""
    value = value or name

    def log(values: Values) -> FloatArray:
        with np.errstate(divide="ignore"):  # springs that all touch have no gap
            return np.asarray(np.log(np.mean(values[value], axis=0, keepdims=True)))

    return ChartQuantity(name=name, log=log, needs=(value,), **settings)


@dataclass(frozen=True, kw_only=True)
class Grids:
    """Resolutions of boundary elements.

    cells: on a length of the problem, ascending; tight: residual on all of these; tolerances: residuals on the grid
    `fixed`, descending; per: the length.
    """

    cells: tuple[int, ...]
    fixed: int
    tight: float = 1e-5
    tolerances: tuple[float, ...] = (0.1, 1e-2, 1e-3)
    per: str = "a side"


class ChartProblem(ABC):
    """A frozen dataclass. Its reference is extrapolated from its two finest grids, unless it has a closed form.

    realisations: of boundary elements, none where the same problem is solved again and again; scene: of which models
    are found, None where there is none.
    """

    name: ClassVar[str]
    quantities: ClassVar[tuple[ChartQuantity, ...]]
    realisations: int = 0
    grids: Grids

    @property
    @abstractmethod
    def method(self) -> Method:
        """Boundary elements."""

    @abstractmethod
    def configurations(self) -> tuple[Configuration, ...]:
        """All that are timed, models that are found not among them, in the order of their parameters."""

    @property
    def scene(self) -> Any:
        return None

    @property
    def served(self) -> tuple[str, ...]:
        """Names of the values that a model may have."""
        return tuple(dict.fromkeys(name for quantity in self.quantities for name in quantity.needs))

    def of_model(self, values: Values) -> Values:
        """What a model that is found has, in the values of this problem."""
        return values

    def reference(self) -> Values | tuple[Configuration, Configuration]:
        """What is exact, or the coarse and the fine grid from which it is extrapolated."""
        coarse, fine = (self.on(n) for n in self.grids.cells[-2:])
        return coarse, fine

    def pairs(self) -> tuple[tuple[Configuration, Configuration], ...]:
        """Other grids of which one has twice the cells of the other, which are extrapolated like the reference."""
        cells = self.grids.cells
        doubled = tuple((self.on(n), self.on(2 * n)) for n in cells if 2 * n in cells)
        return tuple(pair for pair in doubled if pair != self.reference())

    def on(self, cells: int, residual: float | None = None) -> Configuration:
        """Boundary elements on one grid, to the tight residual or another one."""
        own: dict[str, Any] = {"label": BEM, "residual": self.grids.tight, "realisations": self.realisations}
        (tight,) = along(self.method, self, (cells,), f"# cells {self.grids.per}", **own)
        if residual is None:
            return tight
        parameter, resolution = f"residual #, {cells} cells {self.grids.per}", Resolution(size=cells, residual=residual)
        return replace(tight, resolution=resolution, label=LOOSE, parameter=parameter, value=residual)

    def boundary_elements(self) -> tuple[Configuration, ...]:
        """Along cells, and along the residual on one grid."""
        grids = self.grids
        return (*map(self.on, grids.cells), *(self.on(grids.fixed, residual) for residual in grids.tolerances))


def measure(timed: TimedProblem) -> Outcome:
    """All configurations of a problem in turns.

    status: "finished", or why not; setup: seconds before the clock runs; seconds i: of each run of the i-th, a
    realisation; NAME i: its values, realisations along the first axis.
    """
    timings = time_in_turns(configurations_of(timed.problem), timed)
    outcome: dict[str, Any] = {
        "status": np.array([timing.status for timing in timings]),
        "setup": np.array([timing.setup for timing in timings]),
    }
    for i, timing in enumerate(timings):
        outcome[f"seconds {i}"] = np.array(timing.seconds)
        for name in timing.results[0].values if timing.results else ():
            rows = [np.asarray(result.values[name]) for result in timing.results]
            outcome[f"{name} {i}"] = np.stack(rows) if timing.results[0].count == 1 else np.concatenate(rows)
    return outcome


def values_of(problem: ChartProblem, configuration: Configuration, outcome: Mapping[str, Any], i: int) -> Values:
    """Of the i-th configuration."""
    end = f" {i}"
    names = (name.removesuffix(end) for name in outcome if name.endswith(end) and name != f"seconds{end}")
    values = {name: outcome[name + end] for name in names}
    return problem.of_model(values) if isinstance(configuration.method, Model) else values


RESIDUALS = (0.1, 1e-2, 1e-3, 1e-4)
"""Looser than those of all other solves."""
UNIT_SPHERE = {"radius": 1.0, "modulus": 1.0}


def scalars(**numbers: float) -> Values:
    return {name: np.array(number) for name, number in numbers.items()}


class PressedProblem(ChartProblem):
    """A `PressedScene`. springs: on a length; profiles: of springs, their own, none of a smooth body; across: lengths
    on a side of the grid."""

    springs: tuple[float, ...]
    profiles: int = 0
    across: ClassVar[int] = 1

    @property
    def method(self) -> NamedMethod:
        return NamedMethod("BEM", press_on_grid)

    def configurations(self) -> tuple[Configuration, ...]:
        springs, parameter = NamedMethod(MDR, press_on_springs), f"# springs {self.grids.per}"
        own = along(springs, self, self.springs, parameter, realisations=self.profiles, paired=not self.profiles)
        return (*own, *self.boundary_elements())

    def half_space(self, cells: int) -> bem3d.HalfSpace:
        n = self.across * cells
        return bem3d.HalfSpace(shape=(n, n), spacing=1 / cells, modulus=1.0)

    def finish(self, contact: bem3d.Contact) -> bem3d.FixedContactArea | None:
        """Its contact area is solved for its stiffness, on the clock."""
        return bem3d.solve_fixed_area(contact.problem.half_space, contact.pressure > 0, tolerance=FIXED_AREA_RESIDUAL)


def closed_form(scene: "ExactProblem", resolution: Resolution) -> Prepared:
    """What is exact."""
    return lambda _: Solve(scene.exact, lambda values: Result(values))


class ExactProblem(PressedProblem):
    """A body whose answer is known, pressed by a unit approach. shape: for models."""

    shape: ClassVar[Literal["sphere", "punch"]]

    @abstractmethod
    def exact(self) -> Values:
        """By closed forms."""

    @property
    def scene(self) -> IndentationScene:
        """At about a unit approach; no model of a smooth body depends on its load but by that."""
        load = float(self.exact().get("force", self.exact()["stiffness"]))
        return IndentationScene(name=self.name, shape=self.shape, size=1.0, load=load, modulus=1.0)

    def load(self, cells: int) -> dict[str, float]:
        return {"approach": 1.0}

    def reference(self) -> Values:
        return {name: value[np.newaxis] for name, value in self.exact().items()}

    def configurations(self) -> tuple[Configuration, ...]:
        """The closed form, springs, boundary elements."""
        exact = along(NamedMethod(CLOSED, closed_form), self, (1.0,), "exact", is_reference=True)
        return (*exact, *super().configurations())


ExactGrids = partial(Grids, tight=1e-8, tolerances=RESIDUALS)
SPHERE_GRIDS = ExactGrids(cells=(4, 8, 16, 32), fixed=16, per="to a radius")


@dataclass(frozen=True, kw_only=True)
class SphereProblem(ExactProblem):
    """A rigid sphere, R = a = d = 1, on a grid of 4 a."""

    name: ClassVar = "sphere"
    shape: ClassVar = "sphere"
    quantities: ClassVar = (mean_of("force", order=2.0), mean_of("contact radius", "radius"), mean_of("stiffness"))
    across: ClassVar = 4
    grids: Grids = SPHERE_GRIDS
    springs: tuple[float, ...] = (2.4, 4.4, 8.4, 16.4, 32.4, 64.4)

    def exact(self) -> Values:
        """Hertz and Boussinesq."""
        return scalars(
            force=closed_forms.hertz_force(**UNIT_SPHERE, approach=1.0),
            radius=closed_forms.hertz_contact_radius(radius=1.0, approach=1.0),
            stiffness=closed_forms.circular_punch_stiffness(**UNIT_SPHERE),
        )

    def gap(self, cells: int, realisation: int = 0) -> FloatArray:
        """r^2 / 2R."""
        x = (np.arange(4 * cells) + 0.5) / cells - 2
        return np.asarray((x[:, np.newaxis] ** 2 + x**2) / 2)

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        assert fixed is not None
        return scalars(force=contact.force, radius=math.sqrt(contact.area / math.pi), stiffness=fixed.stiffness)

    def profile(self, springs: float, realisation: int = 0) -> tuple[FloatArray, float]:
        """x^2 / R, about 4 a long; the contact ends between springs unless a whole number of them makes a radius."""
        half = round(2 * springs)
        x = (np.arange(-half, half) + 0.5) / springs
        return -mdr.sphere_profile(x, radius=1.0), 2 * half / springs

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        """The radius is half the length of the springs in contact."""
        return scalars(force=point.force, radius=point.stiffness / 2, stiffness=point.stiffness)


PUNCH_GRIDS = ExactGrids(cells=(8, 16, 32, 64), fixed=32)


@dataclass(frozen=True, kw_only=True)
class PunchProblem(ExactProblem):
    """A rigid flat square punch of side L = 1 on a grid that just holds it."""

    name: ClassVar = "square punch"
    shape: ClassVar = "punch"
    # the reference is known to five digits: half a unit of the last is open
    quantities: ClassVar = (mean_of("stiffness", band=5e-5 / closed_forms.SQUARE_PUNCH),)
    grids: Grids = PUNCH_GRIDS
    springs: tuple[float, ...] = (4, 16, 64)

    def exact(self) -> Values:
        """1.1523 E* L."""
        return scalars(stiffness=closed_forms.square_punch_stiffness(side=1.0, modulus=1.0))

    def gap(self, cells: int, realisation: int = 0) -> FloatArray:
        return np.zeros((cells, cells))

    def finish(self, contact: bem3d.Contact) -> None:
        """All of it is in contact: its force has its stiffness."""

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        return scalars(stiffness=contact.force / contact.approach)

    def profile(self, springs: float, realisation: int = 0) -> tuple[FloatArray, float]:
        return np.zeros(round(springs)), 1.0

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        return scalars(stiffness=point.stiffness)


ROUGH_GRIDS = Grids(cells=(96, 128, 192, 256, 512), fixed=128)


def log_deviation(values: Values) -> FloatArray:
    """ln of the relative standard deviation; minus infinity of a single value."""
    k = values["stiffness"]
    deviation = k.std(ddof=1) / k.mean() if k.size > 1 else 0.0
    with np.errstate(divide="ignore"):
        return np.asarray(np.log(np.atleast_1d(deviation)))


@dataclass(frozen=True, kw_only=True)
class RoughPunchProblem(PressedProblem):
    """A square punch of side L = 1, self-affine from q_min = 2 pi / L to q_max, under Fbar = F / (E* h L).

    hurst; waves: on a side, of the shortest; force: Fbar; realisations: of surfaces; seed: zero or positive.
    """

    name: ClassVar = "fractal punch"
    quantities: ClassVar[tuple[ChartQuantity, ...]] = (
        mean_of(MEAN_STIFFNESS, "stiffness"),
        ChartQuantity(name=RELATIVE_DEVIATION, log=log_deviation, needs=("stiffness",)),
    )
    hurst: float = 0.7
    waves: int = 64
    force: float = 0.1
    realisations: int = 16
    profiles: int = 120
    grids: Grids = ROUGH_GRIDS
    springs: tuple[float, ...] = (96, 128, 256, 512, 1024)
    seed: int = 150

    @property
    def roughness(self) -> PunchRoughness:
        """The same on every grid and in both methods."""
        return PunchRoughness(hurst=self.hurst, waves=(1, self.waves), seed=self.seed)

    @property
    def scene(self) -> IndentationScene:
        """The punch, for models that know no realisation."""
        return self.roughness.scene(self.force)

    def load(self, cells: int) -> dict[str, float]:
        return {"force": self.force * self.roughness.height}

    def gap(self, cells: int, realisation: int) -> FloatArray:
        return -self.roughness.surface(cells, realisation)

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        assert fixed is not None
        return scalars(stiffness=fixed.stiffness)

    def profile(self, springs: float, realisation: int) -> tuple[FloatArray, float]:
        """Of Geike's spectrum, L_1D = L."""
        return self.roughness.profile(round(springs), realisation), 1.0

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        return scalars(stiffness=point.stiffness)


@dataclass(frozen=True, kw_only=True)
class RolledOffPunchProblem(RoughPunchProblem):
    """The punch with a plateau of its spectrum up to `roll_off` waves on a side, under 10 % contact by default."""

    name: ClassVar = "punch with a roll-off"
    quantities: ClassVar = (mean_of(MEAN_STIFFNESS, "stiffness"), mean_of("contact area", "area"), mean_of("gap"))
    waves: int = 16
    roll_off: int = 4
    force: float = 2.36
    grids: Grids = Grids(cells=(24, 32, 48, 64, 128), fixed=32)
    springs: tuple[float, ...] = (24, 32, 64, 128, 256)
    seed: int = 152

    @property
    def roughness(self) -> RolledOffRoughness:
        return RolledOffRoughness(hurst=self.hurst, waves=(1, self.waves), roll_off=self.roll_off, seed=self.seed)

    @property
    def served(self) -> tuple[str, ...]:
        return ()  # no model has a roll-off

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        """The mean gap is the mean displacement less the approach: heights have no mean."""
        gap = contact.problem.half_space.displacement(contact.pressure).mean() - contact.approach
        return {**super().read(contact, fixed), **scalars(area=contact.area, gap=gap)}

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values:
        """Of length one. Springs have no contact area."""
        return {**super().read_springs(point), **scalars(gap=point.force - point.approach)}


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
        """Octaves from the first one-third octave with waves of the roughness on, as those of the force spectrum."""
        return Bands(Bands.around(np.pi, 2 ** (-1 / 3), self.last).edges[::3]).on(self.length)

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
