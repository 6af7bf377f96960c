"""The words of an answer, which change with the verdicts of its numbers."""

import math
from collections.abc import Callable, Sequence
from itertools import chain

from validation.analysis.evidence import Number, Verdict
from validation.analysis.statistics import DECIBEL
from validation.report.answers.cells import Enough, RangeCell, ends, runs, span

Printed = Callable[[float], str]
"""From the difference of a number in decibels to a text with its unit."""


def per_cent(decibels: float) -> str:
    """Of an amplitude: -12 %."""
    return f"{round(100 * math.expm1(decibels / DECIBEL)) + 0:+d} %"


def times(decibels: float) -> str:
    """Of an amplitude: 0.53 times, 350 times."""
    return f"{float(f'{math.exp(decibels / DECIBEL):.2g}'):g} times"


def in_decibels(decibels: float) -> str:
    return f"{round(decibels, 1) + 0.0:+.3g} dB"


def from_to(low: float, high: float, printed: Printed) -> str:
    """ "-13 to -11 %": the unit once."""
    first, last = printed(low), printed(high)
    return last if first == last else f"{first.split(' ')[0]} to {last}"


def first_word(cells: Sequence[RangeCell]) -> str:
    """The whole strip in a word."""
    found = {cell.enough for cell in cells}
    if found == {Enough.YES}:
        return "Yes"
    if Enough.YES in found:
        return "In part"
    if found == {Enough.NO}:
        return "No"
    return "Open" if found == {Enough.OPEN} else "No or open"


def sentence(cells: Sequence[RangeCell], axis: str, printed: Printed) -> str:
    """Where it is enough, where not, where open; each with the numbers that say so."""
    words = {Enough.YES: "enough", Enough.NO: "not enough", Enough.OPEN: "open"}
    clauses = []
    for enough, word in words.items():
        if pieces := runs(cells, enough):
            where = " and ".join(span(piece, axis) for piece in pieces)
            numbers = [number for cell in chain(*pieces) for number in cell.numbers]
            clauses.append(f"{word} {where} ({_found(enough, numbers, printed)})")
    text = "; ".join(clauses)
    return f"{text[0].upper()}{text[1:]}."


def _found(enough: Enough, numbers: Sequence[Number], printed: Printed) -> str:
    if enough is Enough.YES:
        return f"all intervals within {_intervals(numbers, printed)}"
    if enough is Enough.NO:
        differing = [number for number in numbers if number.verdict is Verdict.DIFFER]
        count = f"{len(differing)} of {len(numbers)} numbers differ" if len(numbers) > 1 else "it differs"
        return f"{count}: {_by_quantity(differing, printed)}"
    undecided = [number for number in numbers if number.verdict is Verdict.UNDECIDED]
    return f"intervals from {_intervals(undecided, printed)}" if undecided else "some numbers are missing"


def _by_quantity(numbers: Sequence[Number], printed: Printed) -> str:
    """The least and the largest, below and above the reference; apart where there are several quantities."""
    quantities = list(dict.fromkeys(number.quantity for number in numbers))
    found = []
    for quantity in quantities:
        values = [number.difference for number in numbers if number.quantity == quantity]
        sides = [[value for value in values if value < 0], [value for value in values if value >= 0]]
        name = f"{quantity} " if len(quantities) > 1 else ""
        found.append(name + " and ".join(from_to(min(side), max(side), printed) for side in sides if side))
    return ", ".join(found)


def _intervals(numbers: Sequence[Number], printed: Printed) -> str:
    low = min(number.difference - number.uncertainty for number in numbers)
    high = max(number.difference + number.uncertainty for number in numbers)
    return from_to(low, high, printed)


def measured(cells: Sequence[RangeCell], axis: str, series: Sequence[str]) -> str:
    """The whole range, and the conditions of its numbers: outside nothing is known."""
    places = [cell.place for cell in cells]
    numbers = [number for cell in cells for number in cell.numbers]
    parts = [] if isinstance(places[0], str) else [_from_to(axis, places)]
    for name in series:
        found = list(dict.fromkeys(number.where[name] for number in numbers if name in number.where))
        if found:
            named = all(isinstance(place, str) for place in found)
            parts.append(", ".join(map(str, found)) if named else _from_to(name, found))
    return ", ".join(parts)


def _from_to(name: str, places: Sequence[object]) -> str:
    both = [end for place in places if not isinstance(place, str) for end in ends(place)]  # type: ignore[arg-type]
    low, high = min(both), max(both)
    return f"{name} = {low:.2g}" if low == high else f"{name} = {low:.2g} to {high:.2g}"
