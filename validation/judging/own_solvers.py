"""Contact solvers of a file in the race of solvers."""

import math
import runpy
import sys
from collections.abc import Collection
from functools import cache, partial
from pathlib import Path

import numpy as np

from validation.benchmarks.discrete import ContactProblem
from validation.benchmarks.peers import TIGHTER, ColdSolve, Field, PeerSolver
from validation.judging.registry import Offered
from validation.judging.worker import OthersError, offered_in


@cache
def _solvers_in(file: str) -> list[Offered]:
    found = [one for one in offered_in(Path(file)) if one.kind == "contact_solver"]
    if not found:
        raise OthersError(f"{Path(file).name}: no function has the decorator @contact_solver")
    return found


def solvers_in(file: str, taken: Collection[str]) -> list[PeerSolver]:
    """Contact solvers of a file for the race, by names that are not taken. Raises OthersError where it has none."""
    return [_own(one, file, f"{one.name}, own" if one.name in taken else one.name) for one in _solvers_in(file)]


def _own(offered: Offered, file: str, name: str) -> PeerSolver:
    served, by_force = tuple(kind for kind in ("free", "periodic") if offered.options[kind]), "force" in offered.asks
    mode, prepare = "by force" if by_force else "by approach", partial(of_file, file, offered.name)
    cells = float(offered.options["cells"])
    return PeerSolver(name, "", mode, prepare, TIGHTER, served, by_force, file, cells=cells)


def of_file(file: str, name: str, problem: ContactProblem, tolerance: float) -> ColdSolve:
    """A solver of somebody's own, in the process that times it."""
    (solver,) = (one for one in _loaded(file) if one.name == name)
    gap = problem.gap.copy()
    gap.flags.writeable = False
    other = "approach" if "force" in solver.asks else "force"
    given = {**vars(problem), "gap": gap, "tolerance": tolerance, other: None}
    asked = {argument: given[argument] for argument in solver.asks}

    def solve() -> tuple[Field, float]:
        return np.array(solver(**asked), dtype=float), math.nan

    return solve


@cache
def _loaded(file: str) -> tuple[Offered, ...]:
    sys.path.insert(0, str(Path(file).resolve().parent))
    return tuple(one for one in runpy.run_path(file).values() if isinstance(one, Offered))
