"""What is said of a model from elsewhere, point by point, and over which ranges it is enough."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from operator import attrgetter

AGREE, DIFFER, UNDECIDED, REFUSED, FAILED = "agree", "differ", "undecided", "refused", "failed"
VERDICTS = (AGREE, DIFFER, UNDECIDED, REFUSED, FAILED)
RATIO, LEVEL, DEVIATION = "-", "dB", "over the mean"
"""Units, by which a number is compared with its reference."""
AGAIN = "the same problem again"
"""Quantity of the point that says whether a model has one answer to one problem."""
UNTRUSTED = "the answers to one problem differ"
SMALL = 0.01
"""A deviation below it is judged by how far off it is in parts of it."""
Conditions = Mapping[str, float | str]


@dataclass(frozen=True)
class JudgedPoint:
    """One number of a model beside its reference.

    where: the conditions, by name; difference: value over reference less one, of levels value less reference [dB];
    error: its 95 % half-width in the same unit, by sample and grid of the reference and the sample of the model;
    verdict: one of `VERDICTS`; reason: why there is no number, or what it is judged by; decides: whether a solver is
    wrong that differs or fails here.
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
    def shown(self) -> str:
        """The difference with its half-width: "+12 ± 3 %", or the reason."""
        if not math.isfinite(self.difference):
            return self.reason
        if not math.isfinite(self.error):
            return f"{in_unit(self.difference, self.unit, sign='+')}, of unknown error: {self.reason}"
        return f"{in_unit(self.difference, self.unit, sign='+')} ± {in_unit(self.error, self.unit)}"


def in_unit(difference: float, unit: str, sign: str = "-") -> str:
    """ "+12 %" or "-3.1 dB"."""
    return f"{difference:{sign}.2g} dB" if unit == LEVEL else f"{100 * difference:{sign}.3g} %"


def placed(where: Conditions) -> str:
    """ "H = 0.4, Fbar = 0.1"."""
    return ", ".join(f"{name} = {value:g}" if isinstance(value, float) else str(value) for name, value in where.items())


def compared(
    quantity: str,
    where: Conditions,
    value: float,
    reference: float,
    half_width: float,
    tolerance: float,
    *,
    unit: str = RATIO,
    reason: str = "",
) -> JudgedPoint:
    """By the ratio; by the difference of levels, of which a tolerance t is 20 lg(1 + t) dB; and deviations by the ratio
    from 1 % on, below by their absolute difference, as a part of 1 %.

    half_width: 95 %, over the value, or in dB, of both together; agree or differ where the whole interval does.
    """
    apart, half = value / reference - 1, abs(value / reference) * half_width
    if unit == LEVEL:
        apart, half, tolerance = value - reference, half_width, 20 * math.log10(1 + tolerance)
    elif unit == DEVIATION and reference < SMALL:
        apart, half = (value - reference) / SMALL, max(value, reference) / SMALL * half_width
        reason = reason or "below 1 %: the absolute difference, in parts of 1 %"
    verdict, shown_in = verdict_of(apart, half, tolerance), LEVEL if unit == LEVEL else RATIO
    return JudgedPoint(quantity, where, value, reference, apart, half, verdict, reason, shown_in)


def verdict_of(apart: float, half: float, within: float) -> str:
    """Whether all of an interval is near, or far; what is equal to rounding is equal."""
    near, far = abs(apart) + half <= within * (1 + 1e-9), abs(apart) - half > within * (1 + 1e-9)
    return AGREE if near else DIFFER if far else UNDECIDED


def not_compared(
    quantity: str,
    where: Conditions,
    verdict: str,
    reason: str,
    *,
    reference: float = math.nan,
    unit: str = RATIO,
    decides: bool = False,
) -> JudgedPoint:
    """Without a number of the model."""
    return JudgedPoint(quantity, where, math.nan, reference, math.nan, math.nan, verdict, reason, unit, decides)


def trusted(points: Sequence[JudgedPoint]) -> list[JudgedPoint]:
    """The same numbers; undecided, where a model has more than one answer to one problem."""
    if all(point.verdict == AGREE for point in points if point.quantity == AGAIN):
        return list(points)
    return [
        replace(point, verdict=UNDECIDED, reason=UNTRUSTED)
        if point.quantity != AGAIN and point.verdict in (AGREE, DIFFER)
        else point
        for point in points
    ]


@dataclass(frozen=True)
class Enough:
    """Neighbouring points of one verdict: where, along the number that decides, from start to stop."""

    quantity: str
    where: Conditions
    along: str
    start: float
    stop: float
    verdict: str


@dataclass(frozen=True)
class JudgedCurve:
    """Points of a quantity under equal conditions, ascending along the number that decides, which has most values."""

    quantity: str
    where: Conditions
    along: str
    points: Sequence[JudgedPoint]

    @property
    def at(self) -> list[float]:
        return [float(point.where.get(self.along, math.nan)) for point in self.points]

    @property
    def is_rule(self) -> bool:
        """Whether every model must follow it, as its references say, which are one; no result that a paper states."""
        return all(point.reference == 1 for point in self.points)

    @property
    def runs(self) -> list[list[tuple[float, JudgedPoint]]]:
        """Neighbouring points of one verdict, each with its place."""
        pairs = zip(self.at, self.points, strict=True)
        return [list(run) for _, run in groupby(pairs, lambda pair: pair[1].verdict)]

    @property
    def enough(self) -> list[Enough]:
        ends = [(*run[0], run[-1][0]) for run in self.runs]
        return [Enough(self.quantity, self.where, self.along, a, b, point.verdict) for a, point, b in ends]


def curves_of(points: Iterable[JudgedPoint]) -> list[list[JudgedCurve]]:
    """Those of each quantity."""
    of: dict[tuple[str, ...], list[JudgedPoint]] = {}
    for point in points:
        of.setdefault((point.quantity, *sorted(point.where)), []).append(point)
    found = [curve for mine in of.values() for curve in _curves(mine)]
    return [list(some) for _, some in groupby(found, attrgetter("quantity"))]


def _curves(points: Sequence[JudgedPoint]) -> Iterator[JudgedCurve]:
    names = [name for name, value in points[0].where.items() if not isinstance(value, str)]
    along = max(names, key=lambda name: len({point.where[name] for point in points}), default="")
    curves: dict[str, list[JudgedPoint]] = {}
    for point in points:
        curves.setdefault(placed({n: v for n, v in point.where.items() if n != along}), []).append(point)
    for curve in curves.values():
        ordered = sorted(curve, key=lambda point: float(point.where.get(along, 0.0)))
        where = {name: value for name, value in ordered[0].where.items() if name != along}
        yield JudgedCurve(points[0].quantity, where, along, ordered)


def enough(points: Iterable[JudgedPoint]) -> list[Enough]:
    """Where a model agrees, differs, and where neither is known."""
    return [some for curves in curves_of(points) for curve in curves for some in curve.enough]


def worst(points: Iterable[JudgedPoint], count: int = 5) -> list[JudgedPoint]:
    """Those that differ most, less their errors, in what each unit is worth; then those without a number."""

    def apart(point: JudgedPoint) -> float:
        certain = math.copysign(max(abs(point.difference) - point.error, 0.0), point.difference)
        factor = 10 ** (abs(certain) / 20) if point.unit == LEVEL else 1 + certain
        return abs(math.log(max(factor, 1e-12)))

    points = list(points)
    known = sorted((point for point in points if point.verdict == DIFFER), key=apart, reverse=True)
    return [*known, *(point for point in points if point.verdict in (REFUSED, FAILED))][:count]


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
