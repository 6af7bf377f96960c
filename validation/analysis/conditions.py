"""On which conditions a verdict depends: the values of a condition under which alone numbers have it."""

from collections.abc import Iterable, Sequence

from validation.analysis.evidence import Number, Place, Verdict, placed
from validation.analysis.over_range import worst

WORST_AT = "worst at"
"""Among the conditions of a number, and none itself: the place in a range at which it was found."""
MANY, MOST = 3, 4
"""Neighbours that are printed as a range, and values that still are a summary."""


def alone(numbers: Sequence[Number], verdict: Verdict, named: Iterable[str] = ()) -> str:
    """ "H = 1 alone", "H = 0.4 and 0.55", "H = 0.4 to 0.85": the values of conditions whose numbers have a verdict.

    numbers: of one place, those under one value of a condition judged by their worst; named: conditions that stand in
    the text anyway. One condition after the other, until all numbers under those that are named have the verdict. Empty
    where numbers under all values have it, or under none. The range over which a number is the worst is no condition.
    """
    left_out, said, one_by_one, left = {*named, WORST_AT}, [], True, list(numbers)
    for name in dict.fromkeys(name for number in numbers for name in number.where if name not in left_out):
        by_value = _by_value(name, left)
        every = list(by_value) if any(isinstance(value, str) for value in by_value) else sorted(by_value)
        having = [value for value in every if worst(by_value[value]).verdict is verdict]
        if having and len(having) < len(every) and (len(having) <= MOST or _in_a_row(having, every)):
            said.append(_values(name, having, every))
            one_by_one = one_by_one and len(having) == 1
            left = [number for value in having for number in by_value[value]]
        if all(number.verdict is verdict for number in left):
            break
    return f"{', '.join(said)}{' alone' if one_by_one else ''}" if said else ""


def _by_value(name: str, numbers: Iterable[Number]) -> dict[Place, list[Number]]:
    found: dict[Place, list[Number]] = {}
    for number in numbers:
        if not isinstance(place := number.where.get(name, ()), tuple):
            found.setdefault(place, []).append(number)
    return found


def _in_a_row(having: Sequence[Place], every: Sequence[Place]) -> bool:
    first = every.index(having[0])
    return list(having) == list(every[first : first + len(having)])


def _values(name: str, having: Sequence[Place], every: Sequence[Place]) -> str:
    *before, last = [value if isinstance(value, str) else f"{value:g}" for value in having]
    if len(having) >= MANY and _in_a_row(having, every):
        said = f"{before[0]} to {last}"
    else:
        apart = "; " if any(", " in text for text in (*before, last)) else ", "
        said = f"{apart.join(before)} and {last}" if before else last
    return said if isinstance(having[0], str) else placed(name, said)
