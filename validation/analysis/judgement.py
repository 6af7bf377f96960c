"""What is said of a model from elsewhere, point by point, and over which ranges it is enough."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

AGREE, DIFFER, UNDECIDED, REFUSED, FAILED = "agree", "differ", "undecided", "refused", "failed"
VERDICTS = (AGREE, DIFFER, UNDECIDED, REFUSED, FAILED)
SMALL = 0.01
"""A deviation below it is judged by how far off it is in parts of it."""
Conditions = Mapping[str, float | str]


@dataclass(frozen=True)
class JudgedPoint:
    """One number of a model beside its reference.

    where: the conditions, by name; difference: value over reference less one, of levels value less reference [dB];
    error: its 95 % half-width in the same unit, by sample and grid of the reference and the sample of the model;
    verdict: one of `VERDICTS`, empty of a time; reason: why there is no number, or what it is judged by; decides:
    whether a solver is wrong that differs or fails here.
    """

    quantity: str
    where: Conditions
    value: float
    reference: float
    difference: float
    error: float
    verdict: str
    reason: str = ""
    unit: str = "-"
    decides: bool = False

    @property
    def place(self) -> str:
        """ "H = 0.4, Fbar = 0.1"."""
        return placed(self.where)

    @property
    def shown(self) -> str:
        """The difference with its half-width: "+12 ± 3 %", or the reason."""
        if not math.isfinite(self.difference):
            return self.reason
        return f"{in_unit(self.difference, self.unit, sign='+')} ± {in_unit(self.error, self.unit)}"


def in_unit(difference: float, unit: str, sign: str = "-") -> str:
    """ "+12 %" or "-3.1 dB"."""
    return f"{difference:{sign}.2g} dB" if unit == "dB" else f"{100 * difference:{sign}.3g} %"


def placed(where: Conditions) -> str:
    return ", ".join(f"{name} = {value:g}" if isinstance(value, float) else str(value) for name, value in where.items())


def compared(
    quantity: str,
    where: Conditions,
    value: float,
    reference: float,
    half_width: float,
    tolerance: float,
    *,
    unit: str = "-",
    reason: str = "",
    decides: bool = False,
) -> JudgedPoint:
    """By the ratio. half_width: 95 %, relative, of both together; agree or differ where the whole interval does."""
    ratio = value / reference
    return _judged(
        quantity, where, (value, reference), ratio - 1, abs(ratio) * half_width, tolerance, unit, reason, decides
    )


def compared_levels(
    quantity: str,
    where: Conditions,
    value: float,
    reference: float,
    half_width: float,
    tolerance: float,
    *,
    reason: str = "",
    decides: bool = False,
) -> JudgedPoint:
    """Levels and half-width [dB]; a tolerance t, a ratio, is 20 lg(1 + t) dB."""
    within, apart = 20 * math.log10(1 + tolerance), value - reference
    return _judged(quantity, where, (value, reference), apart, half_width, within, "dB", reason, decides)


def compared_deviations(
    quantity: str, where: Conditions, value: float, reference: float, half_width: float, tolerance: float
) -> JudgedPoint:
    """Relative deviations; below 1 % by their absolute difference, as a part of 1 %. half_width: relative."""
    if reference >= SMALL:
        return compared(quantity, where, value, reference, half_width, tolerance)
    apart, reason = (value - reference) / SMALL, "below 1 %: the absolute difference, in parts of 1 %"
    half = max(value, reference) / SMALL * half_width
    return _judged(quantity, where, (value, reference), apart, half, tolerance, "-", reason, False)


def not_compared(
    quantity: str,
    where: Conditions,
    verdict: str,
    reason: str,
    *,
    reference: float = math.nan,
    unit: str = "-",
    decides: bool = False,
) -> JudgedPoint:
    """Without a number of the model."""
    return JudgedPoint(quantity, where, math.nan, reference, math.nan, math.nan, verdict, reason, unit, decides)


def _judged(
    quantity: str,
    where: Conditions,
    pair: tuple[float, float],
    apart: float,
    half: float,
    within: float,
    unit: str,
    reason: str,
    decides: bool,
) -> JudgedPoint:
    # what is equal to rounding is equal
    near, far = abs(apart) + half <= within * (1 + 1e-9), abs(apart) - half > within * (1 + 1e-9)
    verdict = AGREE if near else DIFFER if far else UNDECIDED
    return JudgedPoint(quantity, where, *pair, apart, half, verdict, reason, unit, decides)


@dataclass(frozen=True)
class Enough:
    """Neighbouring points of one verdict: where, along the number that decides, from start to stop."""

    quantity: str
    where: Conditions
    along: str
    start: float
    stop: float
    verdict: str


Group = tuple[str, Conditions, str, Sequence[JudgedPoint]]


def is_property(group: Group) -> bool:
    """Whether it is a rule that every model must follow, as its references say, which are one."""
    return all(point.reference == 1 for point in group[3])


def groups_of(points: Iterable[JudgedPoint]) -> Iterator[Group]:
    """Quantity, conditions and the number that decides, which has most values, and the points along it, ascending."""
    of: dict[str, list[JudgedPoint]] = {}
    for point in points:
        of.setdefault(f"{point.quantity}{sorted(point.where)}", []).append(point)
    for mine in of.values():
        names = [name for name, value in mine[0].where.items() if not isinstance(value, str)]
        along = max(names, key=lambda name: len({point.where[name] for point in mine}), default="")
        curves: dict[str, list[JudgedPoint]] = {}
        for point in mine:
            curves.setdefault(placed({n: v for n, v in point.where.items() if n != along}), []).append(point)
        for curve in curves.values():
            ordered = sorted(curve, key=lambda point: float(point.where.get(along, 0.0)))
            where = {name: value for name, value in ordered[0].where.items() if name != along}
            yield ordered[0].quantity, where, along, ordered


def enough(points: Iterable[JudgedPoint]) -> list[Enough]:
    """Where a model agrees, differs, and where neither is known."""
    found = []
    for quantity, where, along, ordered in groups_of(points):
        for verdict, run in groupby(ordered, lambda point: point.verdict):
            ends = [float(point.where.get(along, math.nan)) for point in run]
            found.append(Enough(quantity, where, along, ends[0], ends[-1], verdict))
    return found


def worst(points: Iterable[JudgedPoint], count: int = 5) -> list[JudgedPoint]:
    """Those that differ most for certain, in what each unit is worth, then those without a number."""
    known = [point for point in points if point.verdict == DIFFER]

    def apart(point: JudgedPoint) -> float:
        factor = 10 ** (abs(point.difference) / 20) if point.unit == "dB" else 1 + point.difference
        return abs(math.log(max(factor, 1e-12)))

    lost = [point for point in points if point.verdict in (REFUSED, FAILED)]
    return [*sorted(known, key=apart, reverse=True), *lost][:count]


def shared(some: Sequence[JudgedPoint], points: Sequence[JudgedPoint]) -> str:
    """The condition that these have in common and not all have; nothing where there is none."""
    found = []
    for name in some[0].where if len(some) > 1 else ():
        mine = [point.where.get(name) for point in some]
        others = [point.where[name] for point in points if name in point.where]
        if len(set(mine)) == 1 and len(set(others)) > 1:
            found.append(placed({name: some[0].where[name]}))
        elif all(isinstance(value, float) for value in (*mine, *others)):
            numbers, middle = [float(value) for value in mine if value is not None], sorted(map(float, others))
            if max(numbers) < middle[len(middle) // 2]:
                found.append(f"{name} up to {max(numbers):g}")
            elif min(numbers) > middle[len(middle) // 2]:
                found.append(f"{name} from {min(numbers):g} on")
    return ", ".join(found)
