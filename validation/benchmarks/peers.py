"""Who runs in the race: our solver, the textbook's, and the packages of others, each in its best documented mode."""

import importlib.metadata
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import bem3d

Field = NDArray[np.float64]


@dataclass(frozen=True)
class Task:
    """A contact problem in plain values: every contestant solves this one, by approach or by force as it prefers."""

    height: Field
    spacing: float
    modulus: float
    periodic: bool
    force: float
    approach: float

    @property
    def gap(self) -> Field:
        """Undeformed separation [m]."""
        return -self.height

    @property
    def overlap(self) -> float:
        """s, by which residuals are scaled [m]."""
        return self.approach - float(self.gap.min())

    @property
    def sides(self) -> tuple[float, float]:
        """Lengths of the grid [m]."""
        return self.height.shape[0] * self.spacing, self.height.shape[1] * self.spacing

    def half_space(self) -> bem3d.HalfSpace:
        """A new one, without plans."""
        shape = self.height.shape
        return bem3d.HalfSpace(
            shape=(shape[0], shape[1]), spacing=self.spacing, modulus=self.modulus, periodic=self.periodic
        )

    def residual(self, pressure: Field) -> float:
        """The residual of this project, by approach or by force whichever is kinder, from a fresh application."""
        separation = self.gap + self.half_space().displacement(pressure)
        d = float((pressure * separation).sum() / pressure.sum())
        first = float(self.gap.min())
        by_force = bem3d.residual(pressure, separation - d, d - first)
        return min(by_force, bem3d.residual(pressure, separation - self.approach, self.overlap))


@dataclass(frozen=True)
class Run:
    """What a contestant brings home: pressure [Pa], operator applications (NaN where it does not count them)."""

    pressure: Field
    applications: float


Solve = Callable[[], Run]


@dataclass(frozen=True)
class Contestant:
    """A solver in the race.

    package: what it is a part of; prepare(task, tolerance): everything that is done once for a grid, returned as a
    function that solves from a cold start; tolerances: its own, tried in this order, as parts of the residual asked
    for, until the residual is reached.
    """

    name: str
    package: str
    mode: str
    prepare: Callable[[Task, float], Solve]
    tolerances: tuple[float, ...] = (1.0,)

    @property
    def version(self) -> str | None:
        """None where it is not installed."""
        try:
            return importlib.metadata.version(self.package)
        except importlib.metadata.PackageNotFoundError:
            return None


def bem3d_fast(task: Task, tolerance: float) -> Solve:
    """Our solver, by force; its plans, coarser grids and windows are made beforehand, by a first solve."""
    half_space = task.half_space()

    def solve() -> Run:
        contact = bem3d.solve(half_space, task.gap, force=task.force, tolerance=tolerance)
        return Run(contact.pressure, contact.operator_applications)

    solve()
    return solve


def bem3d_plain(task: Task, tolerance: float) -> Solve:
    """The textbook's iteration on our operator, by force."""
    half_space = task.half_space()
    half_space.displacement(task.gap)

    def solve() -> Run:
        contact = bem3d.solve_polonsky_keer(
            half_space, task.gap, force=task.force, tolerance=tolerance, max_iterations=5000
        )
        return Run(contact.pressure, contact.operator_applications)

    return solve


def tamaas(task: Task, tolerance: float) -> Solve:
    """Polonsky, Keer and Rey's solver, by mean pressure; free space by its DC-FFT operator."""
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    model = tm.Model(tm.model_type.basic_2d, list(task.sides), list(task.height.shape))
    model.E, model.nu = task.modulus, 0.0
    if not task.periodic:
        # only after E is set: the operator is computed here
        tm.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver = tm.PolonskyKeerRey(model, task.height.copy(), tolerance)
    if not task.periodic:
        solver.setIntegralOperator("dcfft")
    solver.max_iter = 10_000

    def solve() -> Run:
        error = solver.solve(task.force / math.prod(task.sides))
        if not error <= tolerance:
            raise RuntimeError(f"stopped at its own error {error:.3g}, asked for {tolerance:.3g}")
        return Run(np.array(model.traction), math.nan)

    return solve


def contact_mechanics(task: Task, tolerance: float) -> Solve:
    """ContactMechanics: conjugate gradients without restart on the dual problem, by approach."""
    from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
    from ContactMechanics.Systems import NonSmoothContactSystem
    from NuMPI.Optimization import CCGWithoutRestart
    from SurfaceTopography import Topography

    topography = Topography(task.height, task.sides, periodic=task.periodic)
    if task.periodic:
        substrate = PeriodicFFTElasticHalfSpace(task.height.shape, task.modulus, task.sides, stiffness_q0=0.0)
    else:
        substrate = FreeFFTElasticHalfSpace(task.height.shape, task.modulus, task.sides)
    system = NonSmoothContactSystem(substrate, topography)
    calls = _count_calls(substrate, "evaluate_disp")
    cell = task.spacing**2
    # a first guess of the size of the answer: the pressure under which each cell alone would yield by its overlap
    start = np.maximum(task.approach - task.gap, 0.0) * (0.1 * task.modulus / task.spacing * cell)
    settings = {"gtol": tolerance * task.overlap, "maxiter": 10_000}

    def solve() -> Run:
        calls.clear()
        if task.periodic:
            result = system.dual_minimize_proxy(
                offset=task.approach, init_force=start.copy(), solver="ccg-without-restart", **settings
            )
        else:
            objective = system.dual_objective(task.approach, gradient=True)
            result = CCGWithoutRestart.constrained_conjugate_gradients(
                objective, system.dual_hessian_product, x0=start.copy(), **settings
            )
        if not result.success:
            raise RuntimeError(f"no success: {result.message}")
        return Run(np.array(result.x).reshape(task.height.shape) / cell, len(calls))

    return solve


def _count_calls(thing: Any, name: str) -> list[None]:
    """A list that grows by one with each call of a method."""
    calls: list[None] = []
    method = getattr(thing, name)

    def counted(*args: Any, **settings: Any) -> Any:
        calls.append(None)
        return method(*args, **settings)

    setattr(thing, name, counted)
    return calls


TIGHTER = (3.0, 1.0, 0.3, 0.1, 0.03, 0.01)
CONTESTANTS = (
    Contestant("bem3d", "mdr-validation", "solve, by force", bem3d_fast),
    Contestant("bem3d, textbook", "mdr-validation", "solve_plain, by force", bem3d_plain),
    Contestant("tamaas", "tamaas", "PolonskyKeerRey, by mean pressure; free space: dcfft", tamaas, TIGHTER),
    Contestant(
        "ContactMechanics",
        "ContactMechanics",
        "ccg-without-restart on the dual, by approach; stiffness_q0 = 0",
        contact_mechanics,
        TIGHTER,
    ),
)


def peers_installed() -> bool:
    """Whether there is anyone to race against."""
    return any(c.version for c in CONTESTANTS if c.package != "mdr-validation")
