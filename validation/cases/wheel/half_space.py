"""Boundary elements inside the time loop: the wheel of Fig. 14.4 in three dimensions, linear theory and springs."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from validation.analysis.series import Estimates
from validation.analysis.spectra import band_levels, one_third_octaves, record_spectra
from validation.analysis.statistics import FloatArray
from validation.case import SERIAL, Engine, Outcomes
from validation.cases.wheel.ensembles import TABLE, accelerated_by, linear_force_3d, linear_spectrum
from validation.engine.engine import Outcome
from validation.engine.realisations import FEWEST, NotConvergedError, require_realisations
from validation.scenes.rolling import RollingScene
from validation.simulation import model_names as named
from validation.simulation.track_spectrum import InputSpectrum, TrackSpectrum
from validation.simulation.wheel_on_half_space import WheelStrip, simulate_strip
from validation.simulation.wheel_on_springs import WheelEnsemble, simulate_ensemble

QUICK = replace(TABLE, ground=replace(TABLE.rail, shortest=0.8e-3)) if TABLE.rail else TABLE
STRIPS, FINER, LOOSE, TIGHT = "strips", "finer", "loose", "tight"
TIGHTER = 10
"""Ratio of two residuals whose levels differ by the error of the solver."""


@dataclass(frozen=True, kw_only=True)
class Wheel3D:
    """Wheels over isotropic surfaces with boundary elements, and springs of the same spectrum.

    scene: only its rail is rough; strips: realisations on boundary elements; periods: natural periods on each, whole,
    before a half; width: of surfaces over the longest wave; cells: to a contact radius; shared: their divisor; finer:
    strips that are rolled over on half as long cells, too; tolerance: residual of contacts; short: natural periods of
    the strip with a tighter residual; wheels: on springs; groups, batch: of these; seed: zero or more.
    """

    scene: RollingScene = QUICK
    strips: int = 4
    periods: int = 1
    width: int = 2
    cells: int = 8
    shared: int = 4
    finer: int = 3
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
            STRIPS: [replace(self.strip, realisation=i) for i in range(self.strips)],
            FINER: [replace(self.strip, realisation=i, cells=2 * self.cells) for i in range(self.finer)],
            LOOSE: [short],
            TIGHT: [replace(short, tolerance=self.tolerance / TIGHTER)],
        }

    def ensembles(self, input_spectrum: InputSpectrum) -> list[WheelEnsemble]:
        """Springs in the steady state, on tracks of a spectrum as long as the strips."""
        scene = replace(self.scene, distance=self.strip.shape[0] * self.strip.spacing)
        batches = max(self.wheels // self.batch, 1)
        count = self.wheels // batches
        ensemble = WheelEnsemble(
            scene=scene,
            count=count,
            groups=self.groups,
            track="steady-state",
            input_spectrum=input_spectrum,
            seed=self.seed,
        )
        return [replace(ensemble, first=i * count) for i in range(batches)]


def run(case: Wheel3D, engine: Engine = SERIAL) -> Outcomes:
    """Simulate all wheels. Raises NotConvergedError where fewer than three strips of the ensemble converge."""
    problems = case.strips_of()
    strips = engine.map_groups(simulate_strip, problems)
    unconverged = tuple(
        f"strip {strip.realisation}, {strip.cells} cells to a radius, residual {strip.tolerance:g}"
        for name, group in problems.items()
        for strip, outcome in zip(group, strips[name], strict=True)
        if outcome["failed"]
    )
    converged = sum(not outcome["failed"] for outcome in strips[STRIPS])
    if converged < FEWEST or any(outcome["failed"] for name in (FINER, LOOSE, TIGHT) for outcome in strips[name]):
        raise NotConvergedError(
            f"{converged} strips converged on {case.cells} cells to a radius, {FEWEST} are needed", unconverged
        )
    springs = engine.map_groups(
        simulate_ensemble, {model: case.ensembles(rule) for model, rule in INPUT_SPECTRA.items()}
    )
    counts = {model: sum(int(outcome["failed"]) for outcome in group) for model, group in springs.items()}
    if failed := [f"{count} of {case.wheels}, {model}" for model, count in counts.items() if count]:
        raise NotConvergedError("wheels on springs do not repeat their motion", failed)
    return Outcomes(case, {**strips, **springs}, unconverged)


LINEAR_3D, LINEAR_1D, BEM = named.FILTER_3D, "(14.12)", named.BEM
GEIKE, ROLLING = named.SPRINGS_GEIKE, named.SPRINGS_ROLLING
INPUT_SPECTRA: Mapping[str, InputSpectrum] = {GEIKE: "geike", ROLLING: "rolling"}
"""Of the tracks of springs."""
MODELS = (LINEAR_3D, GEIKE, ROLLING)
CONTACTS = {BEM: "bem", LINEAR_3D: "linear"}
OVER_BEM = {model: f"{model} over {BEM}" for model in MODELS}
POINTS = 40
"""Of a quadrature over a band."""


@dataclass(frozen=True)
class WheelLevels:
    """Levels of the acceleration in one-third octaves: int A df of positive frequencies, natural logarithms."""

    result: Outcomes

    @cached_property
    def converged(self) -> list[Outcome]:
        return [strip for strip in self.result[STRIPS] if not strip["failed"]]

    @cached_property
    def edges(self) -> FloatArray:
        """Of bands that hold two lines of a strip and end with the roughness."""
        scene, strip = self.result.case.scene, self.result[STRIPS][0]
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

    def of_strips(self, strips: Sequence[Outcome], contact: str) -> FloatArray:
        """Levels of each strip, (strips, bands), with Hann's window; contact: "bem" or "linear"."""
        omega, density = hann_spectra(strips, contact)
        return band_levels(omega, density.T, self.edges).T

    def spectra(self, contact: str) -> tuple[FloatArray, FloatArray]:
        """Of the strips that converged."""
        return hann_spectra(self.converged, contact)

    @cached_property
    def ratio(self) -> Estimates:
        """ln of boundary elements over the linear contact on the same strips, band by band, at zero cell size."""
        ratio = Estimates.ratios(*(self.of_strips(self.converged, contact) for contact in ("bem", "linear")))
        return ratio.extrapolate_to_zero(self.change)

    @property
    def grids(self) -> tuple[list[Outcome], list[Outcome]]:
        """Strips with their cells and with half as long ones."""
        pairs = zip(self.result[STRIPS], self.result[FINER], strict=False)
        coarse, fine = zip(*(pair for pair in pairs if not pair[0]["failed"]), strict=True)
        return list(coarse), list(fine)

    def on_grids(self, contact: str) -> list[tuple[FloatArray, FloatArray]]:
        return [hann_spectra(strips, contact) for strips in self.grids]

    @cached_property
    def change(self) -> Estimates:
        """ln of the level on half as long cells over that with the cells, on the same strips."""
        coarse, fine = (self.of_strips(strips, "bem") for strips in self.grids)
        return Estimates.ratios(fine, coarse)

    @property
    def left(self) -> Estimates:
        """What grid and solver leave of a level."""
        pairs = zip(self.change, self.solver.tolist(), strict=True)
        return Estimates(replace(change, value=abs(change.value) + solver) for change, solver in pairs)

    @cached_property
    def solver(self) -> FloatArray:
        """Change of the level of a short strip with a tighter residual; where that has no line, the largest of all."""
        loose, tight = (self.of_strips(self.result[name], "bem")[0] for name in (LOOSE, TIGHT))
        change = np.abs(np.log(loose / tight))
        finite = np.isfinite(change)
        return np.asarray(np.where(finite, change, np.max(change, initial=0.0, where=finite)))

    @cached_property
    def exact(self) -> FloatArray:
        """ln of linear theory in three dimensions."""
        bands = zip(self.edges, self.edges[1:], strict=False)
        return np.log([_integral(self._density_3d, *band) for band in bands])

    @property
    def rolling_over_exact(self) -> FloatArray:
        """ln of (14.12) on the rolling-equivalent spectrum over linear theory in three dimensions."""
        scene = self.result.case.scene
        assert scene.rail is not None  # strips refuse a smooth rail
        track = TrackSpectrum(scene.rail, "rolling", scene.contact_radius)
        bands = zip(self.edges, self.edges[1:], strict=False)
        levels = [_integral(lambda omega: linear_spectrum(scene, omega, track), *band) for band in bands]
        return np.asarray(np.log(levels) - self.exact)

    @property
    def without_zero(self) -> NDArray[np.bool_]:
        """Bands in which sin(q a) has no zero."""
        return np.asarray(np.diff(np.floor(self.edges / self.result.case.scene.oscillation_period)) == 0)

    def _density_3d(self, omega: FloatArray) -> FloatArray:
        scene = self.result.case.scene
        return accelerated_by(linear_force_3d(scene, omega / scene.rolling_speed), scene, omega)

    @cached_property
    def bem(self) -> FloatArray:
        """ln of the level of boundary elements: that of linear theory, and their ratio on the strips."""
        return np.asarray(self.exact + self.ratio.values)

    def on_springs(self, model: str) -> tuple[FloatArray, FloatArray]:
        """omega, and A with Hann's window, (groups, frequencies); model: of `INPUT_SPECTRA`."""
        batches = self.result[model]
        return batches[0]["omega"], np.concatenate([batch["hann"] for batch in batches])

    def springs(self, model: str) -> Estimates:
        """ln of their level."""
        omega, groups = self.on_springs(model)
        return Estimates.ratios(band_levels(omega, groups.T, self.edges).T, np.ones(self.centres.size))

    def over_bem(self, model: str) -> Estimates:
        """ln of a model's level over boundary elements, band by band, with the error of both samples."""
        level = Estimates.exact(self.exact) if model == LINEAR_3D else self.springs(model)
        bem = zip(self.ratio, self.bem.tolist(), strict=True)
        return level - Estimates(replace(ratio, value=value) for ratio, value in bem)


def _integral(density: Callable[[FloatArray], FloatArray], low: float, high: float) -> float:
    omega = np.linspace(low, high, POINTS)
    return float(np.trapezoid(density(omega), omega)) / (2 * math.pi)


def hann_spectra(strips: Sequence[Outcome], contact: str) -> tuple[FloatArray, FloatArray]:
    """omega, and A of the acceleration on each strip, (strips, frequencies), with Hann's window."""
    series = np.stack([strip[contact] for strip in strips], axis=1)
    record = record_spectra(series, time_step=float(strips[0]["time step"]), window="hann")
    return record.omega, record.density.T
