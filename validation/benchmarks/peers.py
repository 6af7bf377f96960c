"""The solvers that are compared: ours, the published iteration, other packages, each in its best documented mode."""

import importlib.metadata
import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import bem3d
from validation.benchmarks.discrete import ContactProblem
from validation.engine.street import objects_of_houses
from validation.simulation.method import Prepared, Resolution, Result, Solve
from validation.simulation.model import all_models
from validation.simulation.pressed import cell_applications

Field = NDArray[np.float64]


ColdSolve = Callable[[], tuple[Field, float]]
"""Pressure [Pa], and operator applications (NaN where the solver does not count them)."""
OURS = "mdr-validation"
OUR_SOLVER, PUBLISHED = "bem3d", "bem3d, Polonsky-Keer"
THREADED = ("omp", "tbb")
"""Backends of tamaas that have threads; that of its wheel, cpp, has none."""


@dataclass(frozen=True)
class PeerSolver:
    """A solver of the comparison.

    package: what it is a part of; prepare(problem, tolerance): everything that is done once for a grid, returned as a
    function that solves from a cold start; tolerances: its own, tried in this order, as parts of the residual asked
    for, until the residual is reached: rounding may leave a little more than was asked; serves: "free", "periodic"
    half-spaces; by_force: what it is given, else the approach; file: of somebody's own, which has no package; alone:
    its name with one thread; cells: the most of a grid that it serves; backend: of its compiled loops, empty where it
    does not report one.
    """

    name: str
    package: str
    mode: str
    prepare: Callable[[ContactProblem, float], ColdSolve]
    tolerances: tuple[float, ...] = (1.0, 0.5)
    serves: tuple[str, ...] = ("free", "periodic")
    by_force: bool = True
    file: str = ""
    alone: str = ""
    cells: float = math.inf
    backend: Callable[[], str] = str

    @property
    def version(self) -> str | None:
        """None where it is not installed."""
        if self.file:
            return Path(self.file).name
        try:
            return importlib.metadata.version(self.package)
        except importlib.metadata.PackageNotFoundError:
            return None

    @property
    def build(self) -> str | None:
        """Its version with the backend, None where it is not installed."""
        backend = self.backend() if self.version else ""
        return f"{self.version}, backend {backend}" if backend else self.version

    @property
    def shares_work(self) -> bool:
        """Whether it has threads: ours has, others where their backend has."""
        return self.name == OUR_SOLVER or bool(self.version and self.backend() in THREADED)


def sides(problem: ContactProblem) -> list[float]:
    """Return the two side lengths of the grid [m]."""
    return [n * d for n, d in zip(problem.gap.shape, problem.spacing, strict=True)]


def bem3d_fast(problem: ContactProblem, tolerance: float, threads: int = 1) -> ColdSolve:
    """Our solver, by force; its plans, coarser grids and windows are made beforehand, by a first solve."""
    solve = _force_controlled_solve(bem3d.solve, problem, tolerance, threads)
    solve()
    return solve


def bem3d_plain(problem: ContactProblem, tolerance: float) -> ColdSolve:
    """The iteration of Polonsky and Keer on our operator, by force."""
    return _force_controlled_solve(partial(bem3d.solve_polonsky_keer, max_iterations=5000), problem, tolerance)


def _force_controlled_solve(
    solver: Callable[..., bem3d.Contact], problem: ContactProblem, tolerance: float, threads: int = 1
) -> ColdSolve:
    """Return a solve under the problem's force; the operator and its transforms are prepared here."""
    n, m = problem.gap.shape
    half_space = bem3d.HalfSpace(
        shape=(n, m), spacing=problem.spacing, modulus=problem.modulus, periodic=problem.periodic, threads=threads
    )
    half_space.displacement(problem.gap)

    def solve() -> tuple[Field, float]:
        contact = solver(half_space, problem.gap, force=problem.force, tolerance=tolerance)
        # those of coarser grids count by their cells
        return contact.pressure, cell_applications(contact, None) / contact.pressure.size

    return solve


def tamaas_backend() -> str:
    """Return the backend of its compiled loops, as cpp or omp."""
    import tamaas as tm

    return str(tm.TamaasInfo.backend)


def tamaas(problem: ContactProblem, tolerance: float, threads: int = 1) -> ColdSolve:
    """Polonsky, Keer and Rey's solver, by mean pressure; free space by its DC-FFT operator."""
    import tamaas as tm

    class LeastError(tm.Functional):  # type: ignore[misc]  # it has no types
        """No energy: it keeps the pressure with the least error of all whose gap is computed."""

        error = math.inf

        def computeF(self, pressure: Field, gap: Field) -> float:  # noqa: N802  # its name there
            return 0.0

        def computeGradF(self, pressure: Field, gap: Field) -> None:  # noqa: N802
            if (error := float((pressure * (gap - gap.min())).sum())) < self.error:
                self.error, self.pressure = error, np.array(pressure)

    tm.set_log_level(tm.LogLevel.error)
    tm.initialize(threads)
    (n, m), (gap, force) = problem.gap.shape, equivalent_for_tamaas(problem)
    lengths = [cells * d for cells, d in zip(gap.shape, problem.spacing, strict=True)]
    model = tm.Model(tm.model_type.basic_2d, lengths, list(gap.shape))
    model.E, model.nu = problem.modulus, 0.0
    if not problem.periodic:
        # only after E is set: the operator is computed here
        tm.ModelFactory.registerNonPeriodic(model, "dcfft")
    solver = tm.PolonskyKeerRey(model, -gap, tolerance)
    if not problem.periodic:
        solver.setIntegralOperator("dcfft")
    solver.max_iter = 10_000
    mean, ramp = force / math.prod(lengths), np.linspace(1, 2, gap.size).reshape(gap.shape)

    def solve() -> tuple[Field, float]:
        with suppress(FloatingPointError):
            solver.solve(mean)
            if solver.computeError() <= tolerance:
                return np.array(model.traction)[:n, :m], math.nan
        # it has met an exact answer: the step from there is 0 / 0 or leads away, and its error is that before the step
        least = LeastError()
        solver.addFunctionalTerm(least)
        for start in (ramp, 1 / ramp):
            model.traction[:] = start
            with suppress(FloatingPointError):
                solver.solve(mean)
        return least.pressure[:n, :m], math.nan

    return solve


def equivalent_for_tamaas(problem: ContactProblem) -> tuple[Field, float]:
    """Gap and force of another contact with the same pressure, where tamaas 2.9 has no answer.

    Its periodic waves are right for an even number of cells along the first axis, which two periods have. Its error is
    over the rms height, which a flat body gets from a rim that does not touch: twice the largest displacement under an
    even pressure away, since a rigid punch sinks in less than that.
    """
    gap, force = problem.gap, problem.force
    if problem.periodic and len(gap) % 2:
        return np.tile(gap, (2, 1)), 2 * force
    if not problem.periodic and not np.ptp(gap):
        even = np.full(gap.shape, force / math.prod(sides(problem)))
        rim = gap[0, 0] + 2 * problem.half_space.displacement(even).max()
        return np.pad(gap, (0, 1), constant_values=rim), force
    return gap, force


def contact_mechanics(problem: ContactProblem, tolerance: float) -> ColdSolve:
    """ContactMechanics: conjugate gradients without restart on the dual problem, by approach."""
    from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
    from ContactMechanics.Systems import NonSmoothContactSystem
    from NuMPI.Optimization import CCGWithoutRestart
    from SurfaceTopography import Topography

    n, m = problem.gap.shape
    topography = Topography(-problem.gap, sides(problem), periodic=problem.periodic)
    if problem.periodic:
        substrate = PeriodicFFTElasticHalfSpace((n, m), problem.modulus, sides(problem), stiffness_q0=0.0)
    else:
        substrate = FreeFFTElasticHalfSpace((n, m), problem.modulus, sides(problem))
    system = NonSmoothContactSystem(substrate, topography)
    calls: list[None] = []
    evaluate = substrate.evaluate_disp

    def counted(*args: Any, **settings: Any) -> Any:
        calls.append(None)
        return evaluate(*args, **settings)

    substrate.evaluate_disp = counted
    dx, dy = problem.spacing
    # a first guess of the size of the answer: the pressure under which each cell alone would yield by its overlap
    start = np.maximum(problem.approach - problem.gap, 0.0) * (0.1 * problem.modulus * dy)
    settings = {"gtol": tolerance * problem.overlap, "maxiter": 10_000}

    def solve() -> tuple[Field, float]:
        calls.clear()
        if problem.periodic:
            result = system.dual_minimize_proxy(
                offset=problem.approach, init_force=start.copy(), solver="ccg-without-restart", **settings
            )
        else:
            objective = system.dual_objective(problem.approach, gradient=True)
            result = CCGWithoutRestart.constrained_conjugate_gradients(
                objective, system.dual_hessian_product, x0=start.copy(), **settings
            )
        if not result.success:
            raise RuntimeError(f"no success: {result.message}")
        return np.array(result.x).reshape(n, m) / (dx * dy), len(calls)

    return solve


TIGHTER = (3.0, 1.0, 0.3, 0.1, 0.03, 0.01)
SOLVERS = (
    PeerSolver(OUR_SOLVER, OURS, "solve, by force", bem3d_fast),
    PeerSolver(PUBLISHED, OURS, "solve_polonsky_keer, by force", bem3d_plain),
    PeerSolver(
        "tamaas",
        "tamaas",
        "PolonskyKeerRey, by mean pressure; free space: dcfft",
        tamaas,
        TIGHTER,
        backend=tamaas_backend,
    ),
    PeerSolver(
        "ContactMechanics",
        "ContactMechanics",
        "ccg-without-restart on the dual, by approach, the fastest of its three; stiffness_q0 = 0",
        contact_mechanics,
        TIGHTER,
        by_force=False,
    ),
)


def with_threads(threads: int) -> tuple[PeerSolver, ...]:
    """Those that share their work out among threads, of so many; none for one thread."""
    sharing = [solver for solver in SOLVERS if solver.shares_work] if threads > 1 else []
    return tuple(_solver_on_threads(solver, threads) for solver in sharing)


def _solver_on_threads(solver: PeerSolver, threads: int) -> PeerSolver:
    """Return the solver with so many threads, under a name that states their number."""
    prepare: Callable[..., ColdSolve] = solver.prepare
    name = f"{solver.name}, {threads} threads"
    return replace(solver, name=name, prepare=partial(prepare, threads=threads), alone=solver.name)


def solvers_with(file: str) -> tuple[PeerSolver, ...]:
    """All of them, and the contact solvers of a file. Raises ValueError where it offers none, or cannot be read."""
    if not file:
        return SOLVERS
    readers = objects_of_houses("solvers_of_files")
    if not readers:
        raise ValueError(f"{file}: solvers of files need the package validation.judging, which is not here")
    (solvers_in,) = readers
    return (*SOLVERS, *solvers_in(file, {solver.name for solver in SOLVERS}))


def of_others() -> tuple[PeerSolver, ...]:
    """Return the solvers of other packages."""
    return tuple(solver for solver in SOLVERS if solver.package != OURS)


def peers_installed() -> bool:
    """Whether another package is installed."""
    return any(solver.version for solver in of_others())


def all_methods() -> tuple[str, ...]:
    """Solvers with their versions, and models."""
    return (*(f"{solver.name} {solver.version}" for solver in SOLVERS), *(model.name for model in all_models()))


def by_pressure(scene: Any, resolution: Resolution, solver: PeerSolver) -> Prepared:
    """At the loosest of its tolerances; the solver is set up anew before each run, which may start from the last.

    scene: has `discrete`.
    """
    discrete = scene.discrete()
    tolerance = find_tolerance(solver, discrete, resolution.residual)

    def read(answer: tuple[Field, float]) -> Result:
        pressure, applications = answer
        left = np.array(discrete.worst(pressure, solver.by_force))
        return Result({"pressure": pressure, "residual": left}, applications * pressure.size)

    return lambda _: Solve(solver.prepare(discrete, tolerance), read, repeatable=False)


def find_tolerance(solver: PeerSolver, discrete: ContactProblem, residual: float) -> float:
    """The loosest of its own tolerances with which a solver reaches a residual. Raises RuntimeError where none does."""
    reached = math.nan
    for part in solver.tolerances:
        pressure, _ = solver.prepare(discrete, part * residual)()
        if not np.isfinite(pressure).all():
            raise RuntimeError("pressure is not finite")
        reached = discrete.worst(pressure, solver.by_force)
        if reached <= residual:
            return part * residual
    raise RuntimeError(f"residual {reached:.2g} at its tightest tolerance")
