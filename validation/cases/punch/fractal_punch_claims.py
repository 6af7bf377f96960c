"""The claims of Fig. 14.1, the numbers that test them, and the answers."""

from collections.abc import Sequence

from validation.analysis.answers import agreeing_from_the_first, answered
from validation.analysis.evidence import JudgedClaim, Number
from validation.cases.punch.fractal_punch_decades import (
    DEVIATION,
    MARGIN,
    MARGINS,
    MEAN,
    DecadeComparison,
    numbers_of,
)
from validation.cases.punch.fractal_punch_numbers import PUBLISHED
from validation.cases.punch.fractal_punch_text import NONE_LEFT, counts, in_words, nothing_left
from validation.simulation.rough_punch import BEM

CLAIM = "MDR has the fluctuation of the stiffness of rough punches (Fig. 14.1)."
OF_MEAN = "MDR has the mean stiffness of rough punches."
CLOSER = "5 %"
"""A second margin in the answer: a difference that lies on one of them is decided by the other."""
OF_LAW = "The stiffness of a rough punch grows with the force as F^(1 / (1 + H))."


def claims(comparisons: Sequence[DecadeComparison], laws: Sequence[Number]) -> tuple[JudgedClaim, ...]:
    """The fluctuation, the mean, the exponent; only those that have numbers."""
    mean, deviation = (
        [c for c in comparisons if c.name == name and c.hurst is not None and c.number] for name in (MEAN, DEVIATION)
    )
    parts = ((CLAIM, "relative deviation", deviation), (OF_MEAN, "mean stiffness", mean))
    return (*(_judged(*part) for part in parts if part[2]), *_law(laws))


def _judged(claim: str, what: str, mine: Sequence[DecadeComparison]) -> JudgedClaim:
    """Up to the force at which one of the Hurst exponents does not agree."""
    closer = [number for c in mine if (number := c.within(MARGINS[CLOSER])) is not None]
    answer = (
        f"at its worst force of a decade, MDR is off the {what} by {_by_decade(mine)}; within {CLOSER}: "
        f"{counts(closer)}; judged within {MARGIN}."
    )
    # the faces of a punch touch all over under large forces, where springs are softer than a square
    decades = {first: numbers_of(c for c in mine if c.first == first) for first in sorted(_firsts(mine))}
    inside = agreeing_from_the_first(decades.values())
    highest = max((10 * first for first, numbers in decades.items() if numbers[0] in inside), default=0.0)
    limits = f"Fbar up to {highest:g}" if inside else ""
    return answered(claim, numbers_of(mine), answer, limits=limits, inside=inside)


def _firsts(mine: Sequence[DecadeComparison]) -> list[float]:
    return list(dict.fromkeys(c.first for c in mine))


def _by_decade(mine: Sequence[DecadeComparison]) -> str:
    """From the least to the largest of all Hurst exponents, with the verdicts."""
    found = []
    for first in _firsts(mine):
        numbers = numbers_of(c for c in mine if c.first == first)
        low, high = (_end(find(numbers, key=lambda n: n.value)) for find in (min, max))
        span = high if low == high else f"{low.removesuffix(' %')} to {high}"
        found.append(f"{span} from Fbar = {first:g} to {10 * first:g} ({counts(numbers)})")
    return ", ".join(found)


def _end(number: Number) -> str:
    return NONE_LEFT if nothing_left(number) else in_words(number.value, number.unit)


def _law(laws: Sequence[Number]) -> list[JudgedClaim]:
    of_bem = [n for n in laws if n.model == BEM]
    if not of_bem:
        return []
    off = [n.value - n.reference for n in of_bem]
    return [
        answered(
            OF_LAW,
            of_bem,
            f"boundary elements have exponents from {min(n.value for n in of_bem):.3f} to "
            f"{max(n.value for n in of_bem):.3f}, off by {min(off):+.3f} to {max(off):+.3f}: {counts(of_bem)} within "
            f"{of_bem[0].tolerance:g}; published are {PUBLISHED[0]} to {PUBLISHED[1]}.",
        )
    ]
