"""Boundary elements inside the time loop: the wheel of Fig. 14.4 in three dimensions, beside everything cheaper."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from validation.engine.convergence import FEWEST, NotConvergedError, require_realisations
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.simulation.wheel_on_half_space import WheelStrip, simulate_strip
from validation.simulation.wheel_on_springs import InputSpectrum, WheelEnsemble, simulate_ensemble

TABLE = load_wheel_scene("table_14_1")
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

    def ensembles(self, input_spectrum: InputSpectrum) -> list[WheelEnsemble]:
        """Springs in the steady state, on tracks as long as the strips."""
        scene = replace(self.scene, distance=self.strip.shape[0] * self.strip.spacing)
        batches = max(self.wheels // self.batch, 1)
        count = self.wheels // batches
        one = WheelEnsemble(
            scene=scene,
            count=count,
            groups=self.groups,
            track="steady-state",
            input_spectrum=input_spectrum,
            seed=self.seed,
        )
        return [replace(one, first=i * count) for i in range(batches)]


@dataclass(frozen=True)
class Result3D:
    """Outcomes of boundary elements by grid and tolerance, of springs by their input spectrum."""

    case: Wheel3D
    strips: Mapping[str, list[Outcome]]
    springs: Mapping[InputSpectrum, list[Outcome]]
    unconverged: tuple[str, ...]


def run(case: Wheel3D, engine: Engine = SERIAL) -> Result3D:
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
    return Result3D(case, strips, springs, unconverged)
