"""Boundary elements inside the time loop: the wheel of Fig. 14.4 in three dimensions, beside everything cheaper."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from validation.analysis.series import Estimates
from validation.analysis.spectra import band_levels, one_third_octaves, record_spectra
from validation.analysis.statistics import Estimate, FloatArray
from validation.analysis.study import Outcomes
from validation.cases.wheel.features import TABLE, accelerated_by, linear_force_3d, linear_spectrum
from validation.engine.convergence import FEWEST, NotConvergedError, require_realisations
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.dynamic_wheel import WheelScene
from validation.simulation.track_spectrum import InputSpectrum
from validation.simulation.wheel_on_half_space import WheelStrip, simulate_strip
from validation.simulation.wheel_on_springs import WheelEnsemble, simulate_ensemble

QUICK = replace(TABLE, rail=replace(TABLE.rail, shortest=0.8e-3)) if TABLE.rail else TABLE
INPUT_SPECTRA: tuple[InputSpectrum, ...] = ("geike", "rolling")
FINEST, COARSER, LOOSE, TIGHT = "finest", "coarser", "loose", "tight"
TIGHTER = 10
"""Ratio of two residuals whose levels differ by the error of the solver."""


@dataclass(frozen=True, kw_only=True)
class Wheel3D:
    """Wheels over isotropic surfaces with boundary elements, and springs of the same spectrum.

    scene: only its rail is rough; strips: realisations on boundary elements; periods: natural periods on each, whole,
    before a half; width: of surfaces over the longest wave; cells: to a contact radius; shared: their divisor on all
    grids; coarse: cells of the coarser grid, for the error of the finer one, over `coarser` strips; tolerance: residual
    of contacts; short: natural periods of the strip with a tighter residual; wheels: on springs; groups, batch: of
    these; seed: zero or more.
    """

    scene: WheelScene = QUICK
    strips: int = 4
    periods: int = 1
    width: int = 2
    cells: int = 12
    shared: int = 3
    coarse: int = 9
    coarser: int = 3
    tolerance: float = 1e-4
    short: int = 0
    wheels: int = 60
    groups: int = 5
    batch: int = 100
    seed: int = 148

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips)

    @property
    def strip(self) -> WheelStrip:
        """The first wheel on boundary elements."""
        return WheelStrip(
            scene=self.scene,
            realisation=0,
            natural_periods=self.periods,
            width=self.width,
            cells=self.cells,
            shared=self.shared,
            tolerance=self.tolerance,
            seed=self.seed,
        )

    def strips_of(self) -> dict[str, list[WheelStrip]]:
        """The ensemble, some of it on a coarser grid, and a short strip at two tolerances."""
        short = replace(self.strip, natural_periods=self.short)
        return {
            FINEST: [replace(self.strip, realisation=i) for i in range(self.strips)],
            COARSER: [replace(self.strip, realisation=i, cells=self.coarse) for i in range(self.coarser)],
            LOOSE: [short],
            TIGHT: [replace(short, tolerance=self.tolerance / TIGHTER)],
        }

    def ensembles(self, rule: InputSpectrum) -> list[WheelEnsemble]:
        """Springs in the steady state, on tracks as long as the strips."""
        scene = replace(self.scene, distance=self.strip.shape[0] * self.strip.spacing)
        batches = max(self.wheels // self.batch, 1)
        count = self.wheels // batches
        one = WheelEnsemble(
            scene=scene, count=count, groups=self.groups, track="steady-state", input_spectrum=rule, seed=self.seed
        )
        return [replace(one, first=i * count) for i in range(batches)]


def run(case: Wheel3D, engine: Engine = SERIAL) -> Outcomes:
    """Simulate all wheels. Raises NotConvergedError where fewer than three strips of the ensemble converge."""
    problems = case.strips_of()
    strips = engine.map_groups(simulate_strip, problems)
    unconverged = tuple(
        f"strip {strip.realisation}, {strip.cells} cells to a radius, residual {strip.tolerance:g}"
        for name, some in problems.items()
        for strip, outcome in zip(some, strips[name], strict=True)
        if outcome["failed"]
    )
    converged = sum(not outcome["failed"] for outcome in strips[FINEST])
    if converged < FEWEST or any(outcome["failed"] for name in (COARSER, LOOSE, TIGHT) for outcome in strips[name]):
        raise NotConvergedError(
            f"{converged} strips converged on {case.cells} cells to a radius, {FEWEST} are needed", unconverged
        )
    springs = engine.map_groups(simulate_ensemble, {name: case.ensembles(name) for name in INPUT_SPECTRA})
    failed = [name for name, some in springs.items() if any(outcome["failed"] for outcome in some)]
    if failed:
        raise NotConvergedError("wheels on springs do not repeat their motion", failed)
    return Outcomes(case, {**strips, **springs}, unconverged)


LINEAR_3D, LINEAR_1D, BEM = "linear, 3D", "linear, 1D (14.12)", "bem3d"
GEIKE, ROLLING = "springs, Geike spectrum", "springs, rolling spectrum"
MODELS = (LINEAR_3D, LINEAR_1D, GEIKE, ROLLING)
ON_SPRINGS: dict[str, InputSpectrum] = {GEIKE: "geike", ROLLING: "rolling"}
CONTACTS = {BEM: "bem", LINEAR_3D: "linear"}
OVER_BEM = {model: f"{model}, over bem3d" for model in MODELS}
POINTS = 40
"""Of a quadrature over a band."""


@dataclass(frozen=True)
class WheelLevels:
    """Levels of the acceleration in one-third octaves: int A df of positive frequencies, natural logarithms."""

    result: Outcomes

    @cached_property
    def converged(self) -> list[Outcome]:
        return [strip for strip in self.result[FINEST] if not strip["failed"]]

    @cached_property
    def edges(self) -> FloatArray:
        """Of bands that hold two lines of a strip and end with the roughness."""
        scene, strip = self.result.case.scene, self.result[FINEST][0]
        line = 2 * math.pi / (strip["bem"].size * float(strip["time step"]))
        return one_third_octaves(max(2.0 * scene.eigenfrequency, 2 * line / (2 ** (1 / 3) - 1)), scene.cutoff)

    @property
    def centres(self) -> FloatArray:
        return np.asarray(np.sqrt(self.edges[1:] * self.edges[:-1]))

    @property
    def ranges(self) -> dict[str, NDArray[np.bool_]]:
        """Bands of the plateau, and of region 3 in two parts."""
        scene, edges = self.result.case.scene, self.edges
        middle = math.sqrt(scene.jump * scene.cutoff)
        low, high = edges[:-1] * (1 + 1e-9), edges[1:] * (1 - 1e-9)
        return {
            "region 2": high < 0.95 * scene.jump,
            "region 3, lower half": (low > 0.99 * scene.jump) & (high <= middle),
            "region 3, upper half": (low > middle * 0.8) & (high > middle),
        }

    def of_strips(self, strips: Sequence[Outcome], contact: str, edges: FloatArray | None = None) -> FloatArray:
        """Levels of each strip, (strips, bands), with Hann's window; contact: "bem" or "linear"."""
        omega, density = hann_spectra(strips, contact)
        return band_levels(omega, density.T, self.edges if edges is None else edges).T

    def spectra(self, contact: str) -> tuple[FloatArray, FloatArray]:
        """Of the strips that converged."""
        return hann_spectra(self.converged, contact)

    @cached_property
    def ratio(self) -> Estimates:
        """ln of boundary elements over the linear contact on the same strips, band by band."""
        return Estimates.ratios(*(self.of_strips(self.converged, contact) for contact in ("bem", "linear")))

    @cached_property
    def grid(self) -> FloatArray:
        """Error of the grid in that: to first order in the cells, three times the change from 3/4 as many."""
        case = self.result.case
        pairs = zip(self.result[FINEST], self.result[COARSER], strict=False)
        grids = zip(*((fine, coarse) for fine, coarse in pairs if not fine["failed"]), strict=True)
        fine, coarse = (
            np.log(self.of_strips(grid, "bem").mean(axis=0)) - np.log(self.of_strips(grid, "linear").mean(axis=0))
            for grid in grids
        )
        return np.asarray(np.abs(fine - coarse) / (case.cells / case.coarse - 1))

    @cached_property
    def solver(self) -> FloatArray:
        """Change of the level of a short strip with a tighter residual; zero where that has no line."""
        loose, tight = (self.of_strips(self.result[name], "bem")[0] for name in (LOOSE, TIGHT))
        change = np.abs(np.log(loose / tight))
        return np.where(np.isfinite(change), change, 0.0)

    @cached_property
    def exact(self) -> dict[str, FloatArray]:
        """ln of linear theory in three dimensions and in one; minus infinity where it has nothing."""
        scene, bands = self.result.case.scene, list(zip(self.edges, self.edges[1:], strict=False))
        in_3d = [_integral(self._density_3d, *band, POINTS) for band in bands]
        in_1d = [_integral(partial(linear_spectrum, scene), *band, 50 * POINTS) for band in bands]
        with np.errstate(divide="ignore"):
            return {LINEAR_3D: np.log(in_3d), LINEAR_1D: np.log(in_1d)}

    def _density_3d(self, omega: FloatArray) -> FloatArray:
        scene = self.result.case.scene
        return accelerated_by(linear_force_3d(scene, omega / scene.speed), scene, omega)

    @cached_property
    def bem(self) -> FloatArray:
        """ln of the level of boundary elements: that of linear theory, and their ratio on the strips."""
        return np.asarray(self.exact[LINEAR_3D] + self.ratio.values)

    def on_springs(self, model: str) -> tuple[FloatArray, FloatArray]:
        """omega, and A with Hann's window, (groups, frequencies)."""
        batches = self.result[ON_SPRINGS[model]]
        return batches[0]["omega"], np.concatenate([batch["hann"] for batch in batches])

    @cached_property
    def springs(self) -> dict[str, FloatArray]:
        spectra = {model: self.on_springs(model) for model in ON_SPRINGS}
        return {model: band_levels(omega, groups.T, self.edges).T for model, (omega, groups) in spectra.items()}

    def over_bem(self, model: str) -> Estimates:
        """ln of a model's level over boundary elements, band by band, with the error of both samples."""
        errors = np.array([one.error for one in self.ratio])
        if model in self.exact:
            values = self.exact[model]
        else:
            own = Estimates.ratios(self.springs[model], np.ones(errors.size))
            values, errors = own.values, np.hypot(errors, [one.error for one in own])
        count = len(self.converged)
        return Estimates(Estimate(float(v), float(e), count) for v, e in zip(values - self.bem, errors, strict=True))


def _integral(density: Callable[[FloatArray], FloatArray], low: float, high: float, points: int) -> float:
    omega = np.linspace(low, high, points)
    return float(np.trapezoid(density(omega), omega)) / (2 * math.pi)


def hann_spectra(strips: Sequence[Outcome], contact: str) -> tuple[FloatArray, FloatArray]:
    """omega, and A of the acceleration on each strip, (strips, frequencies), with Hann's window."""
    series = np.stack([strip[contact] for strip in strips], axis=1)
    record = record_spectra(series, time_step=float(strips[0]["time step"]), window="hann")
    return record.omega, record.density.T
