"""Boundary elements inside the time loop: the wheel of Fig. 14.4 in three dimensions, beside everything cheaper."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.simulation.wheel_on_half_space import WheelStrip, simulate_strip
from validation.simulation.wheel_on_springs import InputSpectrum, WheelEnsemble, simulate_ensemble

TABLE = load_wheel_scene("table_14_1")
QUICK = replace(TABLE, rail=replace(TABLE.rail, shortest=0.8e-3)) if TABLE.rail else TABLE
INPUT_SPECTRA: tuple[InputSpectrum, ...] = ("geike", "rolling")
FINEST, COARSER, LOOSE, TIGHT = "finest", "coarser", "loose", "tight"
ANEW = 10
"""So many times as small a residual tells what the solver leaves open."""


@dataclass(frozen=True, kw_only=True)
class Wheel3D:
    """Wheels over isotropic surfaces with boundary elements, and springs of the same spectrum.

    scene: whose rail alone is rough; strips: realisations of boundary elements; turns: whole, of the resonance, on
    each; width: of surfaces over the longest wave; cells: to a contact radius; shared: its divisor on all grids;
    coarse: cells of the grid from which the error of the finer one is told, over `coarser` strips; tolerance: residual
    of contacts; short: turns of the strip on which that is tightened; wheels: on springs; groups, batch: of these;
    seed: zero or more.
    """

    scene: WheelScene = QUICK
    strips: int = 4
    turns: int = 1
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

    def strip(self, realisation: int, cells: int, tolerance: float, turns: int) -> WheelStrip:
        """One wheel on boundary elements."""
        return WheelStrip(
            scene=self.scene,
            realisation=realisation,
            natural_periods=turns,
            width=self.width,
            cells=cells,
            shared=self.shared,
            tolerance=tolerance,
            seed=self.seed,
        )

    def strips_of(self) -> dict[str, list[WheelStrip]]:
        """The ensemble, some of it on a coarser grid, and a short strip at two tolerances."""
        return {
            FINEST: [self.strip(i, self.cells, self.tolerance, self.turns) for i in range(self.strips)],
            COARSER: [self.strip(i, self.coarse, self.tolerance, self.turns) for i in range(self.coarser)],
            LOOSE: [self.strip(0, self.cells, self.tolerance, self.short)],
            TIGHT: [self.strip(0, self.cells, self.tolerance / ANEW, self.short)],
        }

    def rides(self, input_spectrum: InputSpectrum) -> list[WheelEnsemble]:
        """Springs in the motion that repeats itself, on tracks as long as the strips."""
        along = self.strip(0, self.cells, self.tolerance, self.turns)
        scene = replace(self.scene, distance=along.shape[0] * along.spacing)
        batches = max(self.wheels // self.batch, 1)
        count = self.wheels // batches
        return [
            WheelEnsemble(
                scene=scene,
                first=i * count,
                count=count,
                groups=self.groups,
                track="steady-state",
                input_spectrum=input_spectrum,
                seed=self.seed,
            )
            for i in range(batches)
        ]


@dataclass(frozen=True)
class Result3D:
    """Outcomes of boundary elements by grid and tolerance, of springs by what they are fed."""

    case: Wheel3D
    strips: Mapping[str, list[Outcome]]
    springs: Mapping[InputSpectrum, list[Outcome]]
    unconverged: tuple[str, ...]


def run(case: Wheel3D, engine: Engine = SERIAL) -> Result3D:
    """Roll all wheels. Raises NotConvergedError where fewer than three strips of the ensemble are whole."""
    strips = case.strips_of()
    outcomes = engine.map(simulate_strip, [strip for some in strips.values() for strip in some])
    rolled = iter(outcomes)
    found = {name: [next(rolled) for _ in some] for name, some in strips.items()}
    lost = tuple(
        f"strip {strip.realisation}, {strip.cells} cells to a radius, residual {strip.tolerance:g}"
        for name, some in strips.items()
        for strip, outcome in zip(some, found[name], strict=True)
        if outcome["failed"]
    )
    whole = sum(not outcome["failed"] for outcome in found[FINEST])
    if whole < 3 or any(outcome["failed"] for name in (COARSER, LOOSE, TIGHT) for outcome in found[name]):
        raise NotConvergedError(f"{whole} strips converged on {case.cells} cells to a radius, 3 are needed", lost)
    rides = {feed: case.rides(feed) for feed in INPUT_SPECTRA}
    rode = iter(engine.map(simulate_ensemble, [ride for some in rides.values() for ride in some]))
    springs = {feed: [next(rode) for _ in some] for feed, some in rides.items()}
    astray = [feed for feed, some in springs.items() if any(outcome["failed"] for outcome in some)]
    if astray:
        raise NotConvergedError("wheels on springs do not repeat their motion", astray)
    return Result3D(case, found, springs, lost)
