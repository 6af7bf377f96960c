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
    KindOfProblem("grids of an odd number of cells", lambda contact: any(n % 2 for n in contact.pressure.shape)),
    KindOfProblem("grids that are odd along axis 0", lambda contact: contact.pressure.shape[0] % 2 == 1),
    KindOfProblem("grids that are odd along axis 1", lambda contact: contact.pressure.shape[1] % 2 == 1),
    KindOfProblem("grids that are odd along both axes", lambda contact: all(n % 2 for n in contact.pressure.shape)),
    KindOfProblem("grids of an even number of cells", lambda contact: not any(n % 2 for n in contact.pressure.shape)),
    KindOfProblem("cells with dx unlike dy", lambda contact: not _near(*contact.problem.spacing)),
    KindOfProblem("cells with dx > dy", lambda contact: contact.problem.spacing[0] > 1.01 * contact.problem.spacing[1]),
    KindOfProblem("cells with dx < dy", lambda contact: contact.problem.spacing[1] > 1.01 * contact.problem.spacing[0]),
    KindOfProblem("cells of 4:1", lambda contact: max(_ratio(contact), 1 / _ratio(contact)) > 3.9),
    KindOfProblem("grids that are not square", lambda contact: contact.pressure.shape[0] != contact.pressure.shape[1]),
    KindOfProblem("periodic half-spaces", lambda contact: contact.problem.periodic),
    KindOfProblem("free half-spaces", lambda contact: not contact.problem.periodic),
    KindOfProblem("light loads, below 2 % of contact", lambda contact: _share(contact) < 0.02),
    KindOfProblem("full contact", lambda contact: _share(contact) > 0.99),
    KindOfProblem("contacts that reach the boundary", lambda contact: _reaches_boundary(contact)),
    KindOfProblem("one row of cells", lambda contact: min(contact.pressure.shape) == 1),
    KindOfProblem("a few cells", lambda contact: contact.pressure.size < 100),
    KindOfProblem("more than 2304 cells", lambda contact: contact.pressure.size > 2304),
)
NUMBERS: Mapping[str, Callable[[JudgedContact], float]] = {
    "cells in contact": lambda contact: float(np.count_nonzero(contact.answer > 0)),
    "cells of the grid": lambda contact: float(contact.pressure.size),
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
    diagnosis, rest = dict[JudgedContact, str](), list(wrong)
    for _ in range(MOST):
        if not rest:
            break
        # large grids take long, and have mostly the cause of small ones
        pool = [contact for contact in rest if contact.pressure.size <= LARGE] or rest
        sample = [pool[i] for i in sorted({round(i) for i in np.linspace(0, len(pool) - 1, SAMPLE)})]
        table = explained(sample)
        scores = {name: sum(part for part in parts if part > EXPLAINED) for name, parts in table.items()}
        best = next((name for name, score in scores.items() if score >= max(scores.values()) - BEFORE), "")
        fewest = max(0.05 * len(sample), FEW if len(wrong) > FEW else 1)
        fits = [part for part in table[best] if part > EXPLAINED] if best else []
        # one problem of many may fit anything, but not exactly
        if not fits or (len(fits) < fewest and max(fits) < EXACTLY):
            break
        matches = [
            contact for contact, part in zip(rest, _parts_of(best, sample, rest), strict=True) if part > EXPLAINED
        ]
        # what would make right answers wrong is there on some problems alone
        counterexamples = [
            contact for contact, part in zip(right, _parts_of(best, sample, right), strict=True) if part < 0.5
        ]
        kind = kind_of(matches, counterexamples)
        diagnosis |= dict.fromkeys(matches, f"on {kind} alone: {best}" if kind else best)
        rest = [contact for contact in rest if contact not in diagnosis]
    return diagnosis | _unexplained(rest, contacts, "" if diagnosis else kind_of(wrong, right))


def _reaches_its_residual(wrong: Sequence[JudgedContact], tightened: Tightened) -> bool:
    """Whether the smallest of the wrong answers are right under a tighter tolerance."""
    for contact in sorted(wrong, key=lambda candidate: candidate.pressure.size)[:2]:
        again = next((p for factor in TIGHTER if (p := tightened(contact.problem, factor)) is not None), None)
        if again is None or contact.under(pressure=again) > contact.residual:
            return False
    return True


def _unexplained(
    rest: Sequence[JudgedContact], contacts: Sequence[JudgedContact], kind: str
) -> dict[JudgedContact, str]:
    """What can be said of each that no cause explains."""
    single = all(np.array_equal(contact.pressure, contact.pressure.astype(np.float32)) for contact in contacts)
    where = f"on {kind} alone: " if kind else ""
    remarks = {}
    for contact in rest:
        if single:
            remarks[contact] = f"{where}single precision: all pressures are numbers of 32 bits"
        elif contact.off < NEAR:
            remarks[contact] = f"{where}near the answer: {LOOSE}, rounding, or an operator that is a little off"
        else:
            remarks[contact] = f"{where}not the answer of any half-space that is known"
    return remarks


def explained(wrong: Sequence[JudgedContact]) -> dict[str, list[float]]:
    """Of each cause the parts of the errors that it explains, the more specific cause first."""
    tables = [_parts(contact) for contact in wrong]
    parts = {
        name: [table.get(name, 0.0) for table in tables]
        for name in dict.fromkeys(name for table in tables for name in table)
    }
    for name, shares in numbered(wrong, wrong):
        parts[name] = [
            max(share, before) for share, before in zip(shares, parts.get(name, [0.0] * len(wrong)), strict=True)
        ]
    return parts


def _parts(contact: JudgedContact) -> dict[str, float]:
    parts: dict[str, float] = {}
    for name, explains in causes(contact):
        parts[name] = max(explains(), parts.get(name, 0.0))
    return parts


def _parts_of(cause: str, sample: Sequence[JudgedContact], contacts: Sequence[JudgedContact]) -> list[float]:
    """The part of each error that one cause of the sample explains; of a right answer, whether it stays so."""
    numbers = next((parts for name, parts in numbered(sample, contacts) if name == cause), None)
    if numbers is not None:
        return numbers
    # where a cause is not possible a right answer stays right
    table = [[explains() for name, explains in causes(contact) if name == cause] for contact in contacts]
    return [max(parts, default=float(contact.is_right)) for parts, contact in zip(table, contacts, strict=True)]


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
        of_wrong, of_right = [of(contact) for contact in wrong], [of(contact) for contact in right]
        if min(of_wrong) > max(of_right) and len(of_wrong) > 2:
            return f"more than {max(of_right):g} {name}"
    return ""
