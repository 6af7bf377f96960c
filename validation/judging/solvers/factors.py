"""Causes with a number of their own that is one for all problems: of the modulus, of the load, of the pressure."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from validation.judging.registry import FloatArray
from validation.judging.solvers.causes import JudgedContact

NEAR = 0.02
"""A factor that is so near another is that."""
CLOSE = 30.0
"""Residuals that may be left under another force."""
NO_ANSWER = 0.5
"""What is left where a pressure is no answer; that of none is one."""
FEW = 8
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
    if u.size <= FEW or not np.abs(u).max() > 0:
        return math.nan
    unit = np.abs(u).max()
    (approach, factor), *_ = np.linalg.lstsq(np.stack([np.ones(u.size), -u / unit], axis=1), gap, rcond=None)
    holds = np.abs(gap + factor * u / unit - approach).max() < NEAR * np.ptp(gap)
    return float(factor / unit) if holds else math.nan


def _of_force(wrong: Contacts, asked: Contacts) -> Parts:
    """Answers under another force."""

    def under(contact: JudgedContact, factor: float) -> float:
        own = replace(contact.problem, force=contact.problem.force_of(contact.pressure))
        near = max(NEAR * min(abs(factor - 1), 1), contact.residual)
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
        if any(abs(factor - 1) > NEAR for factor in factors):
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
        met = abs(_shift(contact) - shift) <= max(NEAR * abs(shift), 10 * contact.residual * contact.problem.overlap)
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


def _common(numbers: Numbers, apart: float = NEAR) -> float:
    """The number that more than half are to a fiftieth; zero where it is one to `apart`, or there is none."""
    finite = sorted(number for number in numbers if math.isfinite(number))
    if not finite:
        return 0.0
    # the middle of those with most others near them
    most = max(finite, key=lambda one: sum(abs(other - one) <= NEAR * abs(one) for other in finite))
    alike = [one for one in finite if abs(one - most) <= NEAR * abs(most)]
    middle = alike[len(alike) // 2]
    return middle if len(alike) > len(finite) / 2 and abs(middle - 1) > apart else 0.0
