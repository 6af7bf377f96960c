"""Why the pressures of a wrong solver are wrong: the cause that explains most of all problems, then what it leaves."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from validation.benchmarks.discrete import ContactProblem
from validation.judging.registry import FloatArray
from validation.judging.solvers.causes import JudgedContact, causes
from validation.judging.solvers.factors import numbered

EXPLAINED, MOST, SAMPLE, FEW = 0.75, 5, 16, 2
"""Part of an error from which a cause explains it; causes that are named; wrong answers that each is sought in, and the
fewest that it must explain, of more."""
EXACTLY = 0.999
"""Part of an error that a cause does not explain by chance."""
TIGHTER = (1e-3, 1e-2)
"""Of the residual: a tolerance under which a solver is asked again."""
LOOSE = "it does not converge to the residual that it names"
Tightened = Callable[[ContactProblem, float], FloatArray | None]
BEFORE = 1e-3
"""By which a cause must explain more than one that is more specific."""
NEAR, LARGE = 0.1, 2304
"""In L2: a pressure that is near the answer; cells of a grid that takes long."""


class KindOfProblem(NamedTuple):
    """Problems that have something in common."""

    name: str
    has: Callable[[JudgedContact], bool]


def _share(contact: JudgedContact) -> float:
    return float((contact.answer > 0).mean())


KINDS_OF_PROBLEM = (
    KindOfProblem("grids of an odd number of cells", lambda one: any(n % 2 for n in one.pressure.shape)),
    KindOfProblem("grids that are odd along axis 0", lambda one: one.pressure.shape[0] % 2 == 1),
    KindOfProblem("grids that are odd along axis 1", lambda one: one.pressure.shape[1] % 2 == 1),
    KindOfProblem("grids that are odd along both axes", lambda one: all(n % 2 for n in one.pressure.shape)),
    KindOfProblem("grids of an even number of cells", lambda one: not any(n % 2 for n in one.pressure.shape)),
    KindOfProblem("cells with dx unlike dy", lambda one: not _near(*one.problem.spacing)),
    KindOfProblem("cells with dx > dy", lambda one: one.problem.spacing[0] > 1.01 * one.problem.spacing[1]),
    KindOfProblem("cells with dx < dy", lambda one: one.problem.spacing[1] > 1.01 * one.problem.spacing[0]),
    KindOfProblem("cells of 4:1", lambda one: max(_ratio(one), 1 / _ratio(one)) > 3.9),
    KindOfProblem("grids that are not square", lambda one: one.pressure.shape[0] != one.pressure.shape[1]),
    KindOfProblem("periodic half-spaces", lambda one: one.problem.periodic),
    KindOfProblem("free half-spaces", lambda one: not one.problem.periodic),
    KindOfProblem("light loads, below 2 % of contact", lambda one: _share(one) < 0.02),
    KindOfProblem("full contact", lambda one: _share(one) > 0.99),
    KindOfProblem("contacts that reach the boundary", lambda one: _reaches_boundary(one)),
    KindOfProblem("one row of cells", lambda one: min(one.pressure.shape) == 1),
    KindOfProblem("a few cells", lambda one: one.pressure.size < 100),
    KindOfProblem("more than 2304 cells", lambda one: one.pressure.size > 2304),
)
NUMBERS: Mapping[str, Callable[[JudgedContact], float]] = {
    "cells in contact": lambda one: float(np.count_nonzero(one.answer > 0)),
    "cells of the grid": lambda one: float(one.pressure.size),
}
"""What may grow until a solver goes wrong."""


def _near(a: float, b: float) -> bool:
    return abs(a / b - 1) < 0.01


def _ratio(contact: JudgedContact) -> float:
    return contact.problem.spacing[0] / contact.problem.spacing[1]


def _reaches_boundary(contact: JudgedContact) -> bool:
    p = contact.answer
    return bool(max(p[0].max(), p[-1].max(), p[:, 0].max(), p[:, -1].max()) > 0)


def diagnosed(contacts: Sequence[JudgedContact], tightened: Tightened) -> dict[JudgedContact, str]:
    """A cause in words for each that is wrong; that of most problems is the one that explains most of all errors.

    tightened: the answer of the solver under a tolerance of so many times the residual, None where it has none.
    """
    wrong = [contact for contact in contacts if not contact.is_right]
    right = [contact for contact in contacts if contact.is_right]
    if not wrong:
        return {}
    if _reaches_its_residual(wrong, tightened):
        return dict.fromkeys(wrong, f"{LOOSE}: under a tighter tolerance it does")
    found, rest = dict[JudgedContact, str](), list(wrong)
    for _ in range(MOST):
        if not rest:
            break
        # large grids take long, and have mostly the cause of small ones
        pool = [one for one in rest if one.pressure.size <= LARGE] or rest
        sample = [pool[i] for i in sorted({round(i) for i in np.linspace(0, len(pool) - 1, SAMPLE)})]
        table = explained(sample)
        scores = {name: sum(part for part in parts if part > EXPLAINED) for name, parts in table.items()}
        best = next((name for name, score in scores.items() if score >= max(scores.values()) - BEFORE), "")
        fewest = max(0.05 * len(sample), FEW if len(wrong) > FEW else 1)
        fits = [part for part in table[best] if part > EXPLAINED] if best else []
        # one problem of many may fit anything, but not exactly
        if not fits or (len(fits) < fewest and max(fits) < EXACTLY):
            break
        mine = [one for one, part in zip(rest, _parts_of(best, sample, rest), strict=True) if part > EXPLAINED]
        # what would make right answers wrong is there on some problems alone
        others = [one for one, part in zip(right, _parts_of(best, sample, right), strict=True) if part < 0.5]
        kind = kind_of(mine, others)
        found |= dict.fromkeys(mine, f"on {kind} alone: {best}" if kind else best)
        rest = [one for one in rest if one not in found]
    return found | _unexplained(rest, contacts, "" if found else kind_of(wrong, right))


def _reaches_its_residual(wrong: Sequence[JudgedContact], tightened: Tightened) -> bool:
    """Whether the smallest of the wrong answers are right under a tighter tolerance."""
    for contact in sorted(wrong, key=lambda one: one.pressure.size)[:2]:
        again = next((p for factor in TIGHTER if (p := tightened(contact.problem, factor)) is not None), None)
        if again is None or contact.under(pressure=again) > contact.residual:
            return False
    return True


def _unexplained(
    rest: Sequence[JudgedContact], contacts: Sequence[JudgedContact], kind: str
) -> dict[JudgedContact, str]:
    """What can be said of each that no cause explains."""
    single = all(np.array_equal(one.pressure, one.pressure.astype(np.float32)) for one in contacts)
    where = f"on {kind} alone: " if kind else ""
    said = {}
    for contact in rest:
        if single:
            said[contact] = f"{where}single precision: all pressures are numbers of 32 bits"
        elif contact.off < NEAR:
            said[contact] = f"{where}near the answer: {LOOSE}, rounding, or an operator that is a little off"
        else:
            said[contact] = f"{where}not the answer of any half-space that is known"
    return said


def explained(wrong: Sequence[JudgedContact]) -> dict[str, list[float]]:
    """Of each cause the parts of the errors that it explains, the more specific cause first."""
    tables = [_parts(contact) for contact in wrong]
    parts = {
        name: [mine.get(name, 0.0) for mine in tables] for name in dict.fromkeys(name for one in tables for name in one)
    }
    for name, some in numbered(wrong, wrong):
        parts[name] = [max(one, before) for one, before in zip(some, parts.get(name, [0.0] * len(wrong)), strict=True)]
    return parts


def _parts(contact: JudgedContact) -> dict[str, float]:
    found: dict[str, float] = {}
    for name, explains in causes(contact):
        found[name] = max(explains(), found.get(name, 0.0))
    return found


def _parts_of(cause: str, sample: Sequence[JudgedContact], contacts: Sequence[JudgedContact]) -> list[float]:
    """The part of each error that one cause of the sample explains; of a right answer, whether it stays so."""
    numbers = next((parts for name, parts in numbered(sample, contacts) if name == cause), None)
    if numbers is not None:
        return numbers
    # where a cause is not possible a right answer stays right
    found = [[explains() for name, explains in causes(one) if name == cause] for one in contacts]
    return [max(parts, default=float(one.is_right)) for parts, one in zip(found, contacts, strict=True)]


def kind_of(wrong: Sequence[JudgedContact], right: Sequence[JudgedContact]) -> str:
    """What all wrong ones have in common and no right one has; nothing where there is none."""
    if not wrong or not right:
        return ""
    # what all have in common tells none from another
    kinds = [kind for kind in KINDS_OF_PROBLEM if not all(map(kind.has, right))]
    for kind in kinds:
        if all(map(kind.has, wrong)) and not any(map(kind.has, right)):
            return kind.name
    for kind in kinds:
        # some may be right whatever is wrong: they are symmetric, or have one cell in contact
        if len(wrong) > FEW and all(map(kind.has, wrong)) and sum(map(kind.has, right)) <= len(wrong) / 2:
            return kind.name
    for name, of in NUMBERS.items():
        mine, others = [of(one) for one in wrong], [of(one) for one in right]
        if min(mine) > max(others) and len(mine) > 2:
            return f"more than {max(others):g} {name}"
    return ""
