"""Why the pressures of a wrong solver are wrong: the cause that explains most of all problems, then what it leaves."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from validation.benchmarks.discrete import ContactProblem
from validation.judging.registry import FloatArray
from validation.judging.solvers.causes import JudgedContact, causes

CLOSE = 0.02
"""A factor that is so near another is that."""
CLOSE = 30.0
"""Residuals that may be left under another force."""
NO_ANSWER = 0.5
"""What is left where a pressure is no answer; that of none is one."""
FEW_POINTS = 8
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
    exact = [name for name, known in OF_MODULUS.items() for one in (known, 1 / known) if abs(factor / one - 1) < 3e-3]
    return f" ({exact[0]}?)" if exact else ""


def numbered(wrong: Contacts, asked: Contacts) -> Parts:
    """Causes with the part of each error that they explain; the number of a cause is that of most wrong ones."""
    yield from _of_modulus(wrong, asked)
    yield from _of_approach(wrong, asked) if wrong and not wrong[0].by_force else _of_force(wrong, asked)
    yield from _of_pressure(wrong, asked)


def _of_modulus(wrong: Contacts, asked: Contacts) -> Parts:
    factors = [compliance(contact) for contact in wrong]

    def explained(contact: JudgedContact, factor: float) -> float:
        u = factor * contact.problem.half_space.displacement(contact.pressure)
        return contact.explained(contact.under(displacement=u))

    if factor := _common(factors):
        c = 1 / factor
        said = f"the answer for {c:.4g} times the modulus{named(c)}, or an operator with a factor of {factor:.4g}"
        yield said, [explained(contact, factor) for contact in asked]


def compliance(contact: JudgedContact) -> float:
    """c in gap + c u = approach on the contact, one for the right half-space; NaN where no c is found."""
    p, c = contact.pressure, contact.touching
    u, gap = contact.problem.half_space.displacement(p)[c], contact.problem.gap[c]
    if u.size <= FEW_POINTS or not np.abs(u).max() > 0:
        return math.nan
    unit = np.abs(u).max()
    (approach, factor), *_ = np.linalg.lstsq(np.stack([np.ones(u.size), -u / unit], axis=1), gap, rcond=None)
    holds = np.abs(gap + factor * u / unit - approach).max() < CLOSE * np.ptp(gap)
    return float(factor / unit) if holds else math.nan


def _of_force(wrong: Contacts, asked: Contacts) -> Parts:
    """Answers under another force."""

    def under(contact: JudgedContact, factor: float) -> float:
        own = replace(contact.problem, force=contact.problem.force_of(contact.pressure))
        near = max(CLOSE * min(abs(factor - 1), 1), contact.residual)
        met = abs(own.force / (factor * contact.problem.force) - 1) <= near
        # a force that is far off must not hide what else is left
        left = contact.under(own) if met else math.inf
        return contact.explained(left) if left <= CLOSE * contact.residual else 0.0

    ratios = [contact.problem.force_of(contact.pressure) / contact.problem.force for contact in wrong]
    area = [math.prod(contact.problem.spacing) for contact in asked]
    sides = [contact.problem.gap.size * one for contact, one in zip(asked, area, strict=True)]
    squares = [contact.problem.spacing[0] / contact.problem.spacing[1] for contact in asked]
    known: dict[str, Numbers] = {
        "the sum of the pressures for the force: the area of a cell is missing": area,
        "the mean pressure for the force: the area of the grid is missing": sides,
        "the force for the mean pressure: over the area of the grid": [1 / one for one in sides],
        "the force of all cells over their area: the area of a cell stands twice": [1 / one for one in area],
        "the area of a cell is dy^2 for dx dy: the force is not held": squares,
        "the area of a cell is dx^2 for dx dy: the force is not held": [1 / one for one in squares],
    }
    for name, factors in known.items():
        if any(abs(factor - 1) > CLOSE for factor in factors):
            yield name, [under(contact, factor) for contact, factor in zip(asked, factors, strict=True)]
    if factor := _common(ratios, 1e-3):
        said = f"the answer under another load, {factor:.4g} times the force: the force is not held"
        yield said, [under(contact, factor) for contact in asked]
    yield (
        "the answer under another load: the force is not held",
        [
            under(contact, ratio) if contact.is_right or abs(ratio - 1) > contact.residual else 0.0
            for contact, ratio in ((one, one.problem.force_of(one.pressure) / one.problem.force) for one in asked)
        ],
    )


def _of_approach(wrong: Contacts, asked: Contacts) -> Parts:
    """Answers at another approach."""

    def at(contact: JudgedContact, shift: float) -> float:
        # over the shift, which one that is guessed must meet
        met = abs(_shift(contact) - shift) <= max(CLOSE * abs(shift), 10 * contact.residual * contact.problem.overlap)
        moved = replace(contact.problem, approach=contact.problem.approach + shift)
        return contact.explained(contact.under(moved)) if met and shift != 0 else 0.0

    planes: dict[str, Numbers] = {
        "the approach counts from the first touch, not from gap = 0": [float(one.problem.gap.min()) for one in asked],
        "the approach counts from the mean plane of the gap, not from gap = 0": [
            float(one.problem.gap.mean()) for one in asked
        ],
        "the approach counts from the largest gap, not from gap = 0": [float(one.problem.gap.max()) for one in asked],
        "the sign of the approach": [-2 * one.problem.approach for one in asked],
        "half of the approach": [-one.problem.approach / 2 for one in asked],
        "twice the approach": [one.problem.approach for one in asked],
    }
    for name, shifts in planes.items():
        yield name, [at(one, shift) for one, shift in zip(asked, shifts, strict=True)]
    # of a wave q = 0 the displacement goes with the mean pressure
    periodic = [one for one in wrong if one.problem.periodic]
    with np.errstate(all="ignore"):
        slopes = [_shift(one) * one.problem.modulus / float(one.pressure.mean()) for one in periodic]
    if slope := _common(slopes, 0.0):
        shifts = [slope * float(one.pressure.mean()) / one.problem.modulus for one in asked]
        parts = [
            at(one, shift) if one.problem.periodic else float(one.is_right)
            for one, shift in zip(asked, shifts, strict=True)
        ]
        yield "the mean displacement of a periodic half-space is not zero: its wave q = 0", parts
    yield "the answer under another load, at another approach", [at(one, _shift(one)) for one in asked]


def _shift(contact: JudgedContact) -> float:
    """By which the approach of a pressure differs from that of the problem [m]."""
    p = contact.pressure
    separation = contact.problem.gap + contact.problem.half_space.displacement(p)
    return float((p * separation).sum() / p.sum()) - contact.problem.approach


def _of_pressure(wrong: Contacts, asked: Contacts) -> Parts:
    """The answer times a number."""

    def over(contact: JudgedContact, factor: float) -> float:
        left = contact.under(pressure=contact.pressure / factor)
        # no pressure at all is nearer to the answer than one that is far too high
        return contact.explained(left) if left < NO_ANSWER else 0.0

    with np.errstate(all="ignore"):
        parts = [_part(contact.pressure, contact.answer) for contact in wrong]
        area = [math.prod(contact.problem.spacing) for contact in asked]
        for name, factors in {
            "the forces of the cells for their pressures: times the area of a cell": area,
            "over the area of a cell": [1 / one for one in area],
            "over the modulus": [1 / contact.problem.modulus for contact in asked],
        }.items():
            yield name, [over(contact, factor) for contact, factor in zip(asked, factors, strict=True)]
        if factor := _common(parts, 1e-3):
            yield f"{factor:.4g} times the answer{named(factor)}", [over(contact, factor) for contact in asked]


def _part(pressure: FloatArray, answer: FloatArray) -> float:
    return float((pressure * answer).sum() / (answer**2).sum())


def _common(numbers: Numbers, apart: float = CLOSE) -> float:
    """The number that more than half are to a fiftieth; zero where it is one to `apart`, or there is none."""
    finite = sorted(number for number in numbers if math.isfinite(number))
    if not finite:
        return 0.0
    # the middle of those with most others near them
    most = max(finite, key=lambda one: sum(abs(other - one) <= CLOSE * abs(one) for other in finite))
    alike = [one for one in finite if abs(one - most) <= CLOSE * abs(most)]
    middle = alike[len(alike) // 2]
    return middle if len(alike) > len(finite) / 2 and abs(middle - 1) > apart else 0.0


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
