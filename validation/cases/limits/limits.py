"""Where each method fails: a sweep through each limit, the border that was predicted, and what the software says."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from validation.cases.limits import boundary_elements as limits_bem
from validation.cases.limits import springs as limits_mdr
from validation.cases.limits import time_stepping as limits_time
from validation.cases.limits.solver import SCENES, SOLVERS, Grid, Row, press_grid, without_an_answer
from validation.cases.limits.sweep import Limit, Sweep
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rough_punch import PunchRoughness, force_levels

LIMITS: tuple[Limit, ...] = (*limits_mdr.LIMITS, *limits_time.LIMITS, *limits_bem.LIMITS)
SOLVES: dict[type, Callable[[Any], Outcome]] = {
    limits_mdr.Punches: limits_mdr.press_punches,
    limits_mdr.Octaves: limits_mdr.compare_octaves,
    limits_mdr.Stretched: limits_mdr.stretch,
    limits_mdr.Heights: limits_mdr.make_higher,
    limits_mdr.Strips: limits_mdr.make_strips_higher,
    limits_mdr.Coarser: limits_mdr.space_out,
    limits_mdr.Asperities: limits_mdr.press_asperities,
    limits_time.TimeSteps: limits_time.step_out,
    limits_time.Hops: limits_time.hop,
    limits_bem.Resolved: limits_bem.resolve,
    limits_bem.Spheres: limits_bem.press_spheres,
    limits_bem.WaveUnderLoad: limits_bem.press_waves,
}
HURST = 0.7


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
        return [*self._on_half_space(), *self._on_springs(), *self._in_time()]

    def _on_half_space(self) -> list[Any]:
        return [
            limits_mdr.Strips(
                hurst=HURST,
                last=8.0,
                heights=(0.003, 0.01, 0.02, 0.04, 0.08, 0.12, 0.18, 0.27, 0.4, 0.7),
                length=self.length,
                width=12.0,
                cells=self.strip_cells,
                seed=self.seed,
            ),
            limits_mdr.Punches(
                roughness=PunchRoughness(hurst=HURST, waves=(1, self.cells // 4), seed=self.seed),
                cells=self.cells,
                surfaces=self.surfaces,
                profiles=self.profiles,
                points=1024,
                forces=(*force_levels((-2, 2), 2), 10**2.5),
            ),
            limits_bem.Resolved(
                roughness=PunchRoughness(hurst=HURST, waves=(1, 8), seed=self.seed),
                cells=(12, 18, 24, 32, 48, 64, 96, 128),
                finest=512,
                surfaces=self.resolved,
                force=1.5,
            ),
            limits_bem.Spheres(
                coarse=(0.5, 0.8, 1.2, 1.5, 1.8, 2.1, 2.4, 3.4, 4.8, 6.8, 9.6),
                places=8,
                periods=(4, 8, 16, 24, 32, 40, 64),
                fine=4,
                sides=(6, 10, 13, 14, 15, 16, 17, 18, 20, 24, 32),
                finer=8,
                heights=(0.01, 0.03, 0.1, 0.3, 1.0, 2.0, 4.0, 7.0, 10.0, 15.0, 30.0, 100.0, 1e3),
            ),
            limits_bem.WaveUnderLoad(
                cells=128,
                loads=(0.5, 0.8, 0.9, 0.98, 0.995, 0.999, 1.0, 1.01, 1.1, 1.5),
                huge=tuple(2 * 10.0**i for i in range(0, 17, 1)),
            ),
        ]

    def _on_springs(self) -> list[Any]:
        return [
            limits_mdr.Octaves(
                hurst=HURST,
                first=0.005,
                last=200.0,
                centres=(0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 8.0, 16.0),
                seed=self.seed,
            ),
            limits_mdr.Stretched(
                hurst=HURST,
                first=20.0,
                last=200.0,
                ratios=(1.05, 1.1, 1.2, 1.3, 1.45, 1.65, 2.0, 3.0, 5.0, 9.0),
                seed=self.seed,
            ),
            limits_mdr.Heights(
                hurst=HURST,
                last=8.0,
                heights=(0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.45, 0.7, 1.0),
                length=self.track,
                springs=32,
                seed=self.seed,
            ),
            limits_mdr.Coarser(seed=self.seed),
            limits_mdr.Asperities(
                roughness=PunchRoughness(hurst=HURST, waves=(1, 16), seed=self.seed),
                profiles=self.profiles,
                points=256,
                finer=32,
                forces=tuple(10.0 ** (-i / 2) for i in range(1, 11)),
            ),
        ]

    def _in_time(self) -> list[Any]:
        return [
            limits_time.Hops(
                heights=(0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.3, 1.8),
                wheels=self.wheels,
                waves=6,
                seed=self.seed,
            ),
            limits_time.TimeSteps(
                verlet=(1.5, 1.9, 1.99, 2.01, 2.1, 2.5, 3.0),
                euler=(0.004, 0.006, 0.009, 0.013, 0.018, 0.03, 0.1, 0.5, 1.5, 2.1),
                kutta=(0.3, 0.6, 0.9, 1.1, 1.4, 2.0, 2.6, 2.9),
                turns=3,
            ),
        ]

    def iterated(self) -> list[Grid]:
        """Each scene on each grid, by either solver."""
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
    """Sweeps in the order of `LIMITS`; what else their solves found, by name; grids with their outcomes."""

    case: Limits
    sweeps: tuple[Sweep, ...]
    more: Outcome
    iterated: list[tuple[Grid, Outcome]]
    judged: list[tuple[Grid, Outcome]]
    unanswered: list[Row]
    unconverged: tuple[str, ...]


def sweep_through(problem: Any) -> Outcome:
    """The solve of a problem, by its kind."""
    return SOLVES[type(problem)](problem)


def run(case: Limits, engine: Engine = SERIAL) -> LimitsResult:
    """Every sweep, every grid; input without an answer is asked for here."""
    problems, iterated, judged = case.problems(), case.iterated(), case.judged_grids()
    outcomes = engine.map(sweep_through, problems)
    grids = engine.map(press_grid, [*iterated, *judged])
    found = {name: values for outcome in outcomes for name, values in outcome.items()}
    lost = [f"{type(p).__name__}: {o['failed']:g}" for p, o in zip(problems, outcomes, strict=True) if _lost(o)]
    lost += [
        f"{g.scene}, {g.cells}² cells, {g.solver} to {tolerance:g}"
        for g, o in zip([*iterated, *judged], grids, strict=True)
        for tolerance, failed in zip(g.tolerances, o["failed"], strict=True)
        if failed
    ]
    return LimitsResult(
        case=case,
        sweeps=tuple(Sweep.of(limit, found) for limit in LIMITS),
        more=found,
        iterated=list(zip(iterated, grids[: len(iterated)], strict=True)),
        judged=list(zip(judged, grids[len(iterated) :], strict=True)),
        unanswered=without_an_answer(),
        unconverged=tuple(lost),
    )


def _lost(outcome: Outcome) -> bool:
    return bool(np.any(outcome.get("failed", np.zeros(1))))
