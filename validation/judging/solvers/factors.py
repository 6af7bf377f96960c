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
    if u.size <= FEW or not np.abs(u).max() > 0:
        return math.nan
    unit = np.abs(u).max()
    (approach, factor), *_ = np.linalg.lstsq(np.stack([np.ones(u.size), -u / unit], axis=1), gap, rcond=None)
    holds = np.abs(gap + factor * u / unit - approach).max() < NEAR * np.ptp(gap)
    return float(factor / unit) if holds else math.nan


def _of_force(wrong: Contacts, contacts: Contacts) -> Parts:
    """Answers under another force."""

    def under(contact: JudgedContact, factor: float) -> float:
        own = replace(contact.problem, force=contact.problem.force_of(contact.pressure))
        near = max(NEAR * min(abs(factor - 1), 1), contact.residual)
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
        if any(abs(factor - 1) > NEAR for factor in factors):
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
        met = abs(_shift(contact) - shift) <= max(NEAR * abs(shift), 10 * contact.residual * contact.problem.overlap)
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


def _common(numbers: Numbers, margin: float = NEAR) -> float:
    """The number that more than half are to a fiftieth; zero where it is one to `apart`, or there is none."""
    finite = sorted(number for number in numbers if math.isfinite(number))
    if not finite:
        return 0.0
    # the middle of those with most others near them
    most = max(finite, key=lambda number: sum(abs(neighbour - number) <= NEAR * abs(number) for neighbour in finite))
    alike = [number for number in finite if abs(number - most) <= NEAR * abs(most)]
    middle = alike[len(alike) // 2]
    return middle if len(alike) > len(finite) / 2 and abs(middle - 1) > margin else 0.0
