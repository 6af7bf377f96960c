"""Why the pressures of a wrong solver are wrong: the cause that explains most of all problems, then what it leaves."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from validation.benchmarks.discrete import ContactProblem
from validation.judging.registry import FloatArray
from validation.judging.solvers.causes import JudgedContact, causes

SAME_FACTOR = 0.02
"""A factor that is so near another is that."""
CLOSE = 30.0
"""Residuals that may be left under another force."""
NO_ANSWER = 0.5
"""What is left where a pressure is no answer; that of none is one."""
FEWEST_CELLS = 8
"""Cells of a contact from which no factor is read."""
Numbers = Sequence[float]
Contacts = Sequence[JudgedContact]
Parts = Iterator[tuple[str, list[float]]]
OF_MODULUS = {
    "E for E* at nu = 0.3": 1 - 0.3**2,
    "E for E* at nu = 1/3": 1 - 1 / 9,
    "E for E* at nu = 0.25": 1 - 0.25**2,
    "E for E* at nu = 0.4": 1 - 0.4**2,
    "E for E* at nu = 0.5": 1 - 0.5**2,
    "E for E* of two equal bodies at nu = 0.3": (1 - 0.3**2) / 2,
    "the shear modulus for E* at nu = 0.3": 2 * (1 + 0.3) / (1 - 0.3**2) / 4,
    "a factor 2": 2.0,
    "a factor 4": 4.0,
    "a factor pi": math.pi,
    "a factor 2 pi": 2 * math.pi,
    "a factor pi / 2": math.pi / 2,
    "a factor sqrt(pi)": math.sqrt(math.pi),
    "a factor 2 / sqrt(pi)": 2 / math.sqrt(math.pi),
    "a factor sqrt(2)": math.sqrt(2),
}
"""Factors of which a reader knows the origin; each may stand above or below."""


def named(factor: float) -> str:
    """Where a factor may come from: " (E for E* at nu = 0.3?)", or nothing."""
    exact = [name for name, value in OF_MODULUS.items() for c in (value, 1 / value) if abs(factor / c - 1) < 3e-3]
    return f" ({exact[0]}?)" if exact else ""


def numbered(wrong: Contacts, contacts: Contacts) -> Parts:
    """Causes with the part of each error that they explain; the number of a cause is that of most wrong ones."""
    yield from _of_modulus(wrong, contacts)
    yield from _of_approach(wrong, contacts) if wrong and not wrong[0].by_force else _of_force(wrong, contacts)
    yield from _of_pressure(wrong, contacts)


def _of_modulus(wrong: Contacts, contacts: Contacts) -> Parts:
    factors = [compliance(contact) for contact in wrong]

    def explained(contact: JudgedContact, factor: float) -> float:
        u = factor * contact.problem.half_space.displacement(contact.pressure)
        return contact.explained(contact.under(displacement=u))

    if factor := _common(factors):
        c = 1 / factor
        cause = f"the answer for {c:.4g} times the modulus{named(c)}, or an operator with a factor of {factor:.4g}"
        yield cause, [explained(contact, factor) for contact in contacts]


def compliance(contact: JudgedContact) -> float:
    """c in gap + c u = approach on the contact, one for the right half-space; NaN where no c is found."""
    p, c = contact.pressure, contact.touching
    u, gap = contact.problem.half_space.displacement(p)[c], contact.problem.gap[c]
    if u.size <= FEWEST_CELLS or not np.abs(u).max() > 0:
        return math.nan
    unit = np.abs(u).max()
    (approach, factor), *_ = np.linalg.lstsq(np.stack([np.ones(u.size), -u / unit], axis=1), gap, rcond=None)
    holds = np.abs(gap + factor * u / unit - approach).max() < SAME_FACTOR * np.ptp(gap)
    return float(factor / unit) if holds else math.nan


def _of_force(wrong: Contacts, contacts: Contacts) -> Parts:
    """Answers under another force."""

    def under(contact: JudgedContact, factor: float) -> float:
        own = replace(contact.problem, force=contact.problem.force_of(contact.pressure))
        near = max(SAME_FACTOR * min(abs(factor - 1), 1), contact.residual)
        met = abs(own.force / (factor * contact.problem.force) - 1) <= near
        # a force that is far off must not hide what else is left
        left = contact.under(own) if met else math.inf
        return contact.explained(left) if left <= CLOSE * contact.residual else 0.0

    ratios = [contact.problem.force_of(contact.pressure) / contact.problem.force for contact in wrong]
    area = [math.prod(contact.problem.spacing) for contact in contacts]
    sides = [contact.problem.gap.size * cell for contact, cell in zip(contacts, area, strict=True)]
    squares = [contact.problem.spacing[0] / contact.problem.spacing[1] for contact in contacts]
    confusions: dict[str, Numbers] = {
        "the sum of the pressures for the force: the area of a cell is missing": area,
        "the mean pressure for the force: the area of the grid is missing": sides,
        "the force for the mean pressure: over the area of the grid": [1 / side for side in sides],
        "the force of all cells over their area: the area of a cell stands twice": [1 / cell for cell in area],
        "the area of a cell is dy^2 for dx dy: the force is not held": squares,
        "the area of a cell is dx^2 for dx dy: the force is not held": [1 / square for square in squares],
    }
    for name, factors in confusions.items():
        if any(abs(factor - 1) > SAME_FACTOR for factor in factors):
            yield name, [under(contact, factor) for contact, factor in zip(contacts, factors, strict=True)]
    if factor := _common(ratios, 1e-3):
        cause = f"the answer under another load, {factor:.4g} times the force: the force is not held"
        yield cause, [under(contact, factor) for contact in contacts]
    yield (
        "the answer under another load: the force is not held",
        [
            under(contact, ratio) if contact.is_right or abs(ratio - 1) > contact.residual else 0.0
            for contact in contacts
            for ratio in [contact.problem.force_of(contact.pressure) / contact.problem.force]
        ],
    )


def _of_approach(wrong: Contacts, contacts: Contacts) -> Parts:
    """Answers at another approach."""

    def at(contact: JudgedContact, shift: float) -> float:
        # over the shift, which one that is guessed must meet
        met = abs(_shift(contact) - shift) <= max(
            SAME_FACTOR * abs(shift), 10 * contact.residual * contact.problem.overlap
        )
        moved = replace(contact.problem, approach=contact.problem.approach + shift)
        return contact.explained(contact.under(moved)) if met and shift != 0 else 0.0

    planes: dict[str, Numbers] = {
        "the approach counts from the first touch, not from gap = 0": [
            float(contact.problem.gap.min()) for contact in contacts
        ],
        "the approach counts from the mean plane of the gap, not from gap = 0": [
            float(contact.problem.gap.mean()) for contact in contacts
        ],
        "the approach counts from the largest gap, not from gap = 0": [
            float(contact.problem.gap.max()) for contact in contacts
        ],
        "the sign of the approach": [-2 * contact.problem.approach for contact in contacts],
        "half of the approach": [-contact.problem.approach / 2 for contact in contacts],
        "twice the approach": [contact.problem.approach for contact in contacts],
    }
    for name, shifts in planes.items():
        yield name, [at(contact, shift) for contact, shift in zip(contacts, shifts, strict=True)]
    # of a wave q = 0 the displacement goes with the mean pressure
    periodic = [contact for contact in wrong if contact.problem.periodic]
    with np.errstate(all="ignore"):
        slopes = [_shift(contact) * contact.problem.modulus / float(contact.pressure.mean()) for contact in periodic]
    if slope := _common(slopes, 0.0):
        shifts = [slope * float(contact.pressure.mean()) / contact.problem.modulus for contact in contacts]
        parts = [
            at(contact, shift) if contact.problem.periodic else float(contact.is_right)
            for contact, shift in zip(contacts, shifts, strict=True)
        ]
        yield "the mean displacement of a periodic half-space is not zero: its wave q = 0", parts
    yield "the answer under another load, at another approach", [at(contact, _shift(contact)) for contact in contacts]


def _shift(contact: JudgedContact) -> float:
    """By which the approach of a pressure differs from that of the problem [m]."""
    p = contact.pressure
    separation = contact.problem.gap + contact.problem.half_space.displacement(p)
    return float((p * separation).sum() / p.sum()) - contact.problem.approach


def _of_pressure(wrong: Contacts, contacts: Contacts) -> Parts:
    """The answer times a number."""

    def over(contact: JudgedContact, factor: float) -> float:
        left = contact.under(pressure=contact.pressure / factor)
        # no pressure at all is nearer to the answer than one that is far too high
        return contact.explained(left) if left < NO_ANSWER else 0.0

    with np.errstate(all="ignore"):
        parts = [_part(contact.pressure, contact.answer) for contact in wrong]
        area = [math.prod(contact.problem.spacing) for contact in contacts]
        for name, factors in {
            "the forces of the cells for their pressures: times the area of a cell": area,
            "over the area of a cell": [1 / cell for cell in area],
            "over the modulus": [1 / contact.problem.modulus for contact in contacts],
        }.items():
            yield name, [over(contact, factor) for contact, factor in zip(contacts, factors, strict=True)]
        if factor := _common(parts, 1e-3):
            yield f"{factor:.4g} times the answer{named(factor)}", [over(contact, factor) for contact in contacts]


def _part(pressure: FloatArray, answer: FloatArray) -> float:
    return float((pressure * answer).sum() / (answer**2).sum())


def _common(numbers: Numbers, margin: float = SAME_FACTOR) -> float:
    """The number that more than half are to a fiftieth; zero where it is one to `apart`, or there is none."""
    finite = sorted(number for number in numbers if math.isfinite(number))
    if not finite:
        return 0.0
    # the middle of those with most others near them
    most = max(
        finite, key=lambda number: sum(abs(neighbour - number) <= SAME_FACTOR * abs(number) for neighbour in finite)
    )
    alike = [number for number in finite if abs(number - most) <= SAME_FACTOR * abs(most)]
    middle = alike[len(alike) // 2]
    return middle if len(alike) > len(finite) / 2 and abs(middle - 1) > margin else 0.0


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
    """Of each cause the part, 0 to 1, of the error of each contact that it explains; the more specific cause first."""
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
