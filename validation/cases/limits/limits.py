"""Where each method fails: a sweep through each limit, the threshold that is predicted, what the software says."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from validation.cases.limits import isotropy, linear_filter, periodic_waves, pressed_springs, spheres, time_stepping
from validation.cases.limits.solver import SCENES, SOLVERS, Grid, Row, press_grid, without_an_answer
from validation.cases.limits.sweep import Limit, Sweep
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rough_punch import PunchRoughness

HALF_SPACE_LIMITS: tuple[Limit, ...] = (
    periodic_waves.WAVES,
    spheres.CELLS,
    spheres.IMAGES,
    spheres.EDGE,
    spheres.STRIP,
    periodic_waves.FULL,
    periodic_waves.HUGE,
    spheres.SPIKE,
)
LIMITS: tuple[Limit, ...] = (
    pressed_springs.AREA,
    pressed_springs.GAP,
    isotropy.LEVEL,
    isotropy.ANISOTROPY,
    linear_filter.LINEAR,
    linear_filter.FILTER_3D,
    linear_filter.SPACING,
    pressed_springs.ASPERITY,
    time_stepping.STEP,
    time_stepping.EULER,
    time_stepping.KUTTA,
    time_stepping.LIFT,
    *HALF_SPACE_LIMITS,
)


@dataclass(frozen=True, kw_only=True)
class Limits:
    """How finely each limit is swept.

    cells: on a side of rough punches; surfaces, profiles: realisations; length: of a rolled strip, over a, at
    strip_cells to a contact radius; track: length of a track on springs, over a; resolved: surfaces on grids of
    different cells; grids: cells on a side, for iterations; judged: cells of the grid on which the residual is judged;
    tolerances: of that, falling; wheels: that lift off; seed: zero or positive.
    """

    cells: int = 64
    surfaces: int = 4
    profiles: int = 100
    length: float = 16.0
    strip_cells: int = 8
    track: float = 256.0
    resolved: int = 2
    grids: tuple[int, ...] = (32, 64, 128, 256)
    judged: int = 64
    tolerances: tuple[float, ...] = tuple(10.0**-i for i in range(1, 11))
    wheels: int = 4
    seed: int = 147

    def problems(self) -> list[Any]:
        """One for each solve, the longest first."""
        punches, profiles = self._roughness(self.cells // 4), self._roughness(16)
        return [
            linear_filter.StripHeights(length=self.length, cells=self.strip_cells, seed=self.seed),
            pressed_springs.Punches(
                roughness=punches, cells=self.cells, surfaces=self.surfaces, profiles=self.profiles
            ),
            periodic_waves.RoughGrids(roughness=self._roughness(8), surfaces=self.resolved),
            spheres.Spheres(),
            periodic_waves.WaveUnderLoad(),
            isotropy.Octaves(seed=self.seed),
            isotropy.Anisotropy(seed=self.seed),
            linear_filter.TrackHeights(length=self.track, seed=self.seed),
            linear_filter.CoarserSprings(seed=self.seed),
            pressed_springs.Asperities(roughness=profiles, profiles=self.profiles),
            time_stepping.HigherTracks(wheels=self.wheels, seed=self.seed),
            time_stepping.TimeSteps(),
        ]

    def _roughness(self, last: int) -> PunchRoughness:
        return PunchRoughness(hurst=isotropy.HURST, waves=(1, last), seed=self.seed)

    def iterated_grids(self) -> list[Grid]:
        return [
            Grid(scene=scene, solver=solver, cells=n, tolerances=(1e-8,), seed=self.seed)
            for scene in SCENES
            for solver in SOLVERS
            for n in self.grids
        ]

    def judged_grids(self) -> list[Grid]:
        """Each scene on one grid, to each residual."""
        return [
            Grid(scene=scene, solver=solver, cells=self.judged, tolerances=self.tolerances, seed=self.seed, true=True)
            for scene in SCENES
            for solver in SOLVERS
        ]


@dataclass(frozen=True)
class LimitsResult:
    """Sweeps in the order of `LIMITS`; everything that their solves found, by name; grids with their outcomes."""

    case: Limits
    sweeps: tuple[Sweep, ...]
    found: Outcome
    iterated: list[tuple[Grid, Outcome]]
    judged: list[tuple[Grid, Outcome]]
    unanswered: list[Row]
    unconverged: tuple[str, ...]


def sweep_through(problem: Any) -> Outcome:
    """For the engine, whose solves are functions."""
    outcome: Outcome = problem.sweep()
    return outcome


def run(case: Limits, engine: Engine = SERIAL) -> LimitsResult:
    """Sweep through every limit, solve every grid, and try input without an answer."""
    problems = case.problems()
    outcomes = engine.map(sweep_through, problems)
    groups = {"iterated": case.iterated_grids(), "judged": case.judged_grids()}
    solved = engine.map_groups(press_grid, groups)
    iterated, judged = (list(zip(grids, solved[name], strict=True)) for name, grids in groups.items())
    found = {name: values for outcome in outcomes for name, values in outcome.items()}
    failed = [(type(p).__name__, o.get("failed", np.zeros(1))) for p, o in zip(problems, outcomes, strict=True)]
    return LimitsResult(
        case=case,
        sweeps=tuple(Sweep.of(limit, found) for limit in LIMITS),
        found=found,
        iterated=iterated,
        judged=judged,
        unanswered=without_an_answer(),
        unconverged=(
            *(f"{name}: {count:g}" for name, count in failed if np.any(count)),
            *(
                f"{grid.scene}, {grid.cells}² cells, {grid.solver} to {tolerance:g}"
                for grid, outcome in (*iterated, *judged)
                for tolerance, failed_ in zip(grid.tolerances, outcome["failed"], strict=True)
                if failed_
            ),
        ),
    )
