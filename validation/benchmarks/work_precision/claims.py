"""Claims about speed against accuracy, tested by the times and errors of the charts; of a range by its worst error."""

import math
from collections.abc import Iterable, Sequence

from validation.analysis.answers import answered
from validation.analysis.evidence import JudgedClaim, Number, Role, Verdict
from validation.analysis.over_range import worst
from validation.analysis.wording import share
from validation.benchmarks.peers import SOLVERS
from validation.benchmarks.timing import ALONE
from validation.benchmarks.work_precision.pareto import Point, format_error, front
from validation.benchmarks.work_precision.problem import BEM, EXTRAPOLATED, LOOSE, MDR, MDR_ROLLING, POLONSKY_KEER

CLAIM = "Up to the error that springs reach, they are the cheapest method of every scene."
BEYOND = "Beyond the error that springs reach, boundary elements are the cheapest method of every scene."
ENOUGH = "A model without boundary elements comes within 10 %, or 1 dB, of them on every rough scene."
ORDERS = "Errors fall with the size of cells and springs as theory has it."
EQUAL = "The published iteration and ours have equal values on equal grids."
SPRINGS = (MDR, MDR_ROLLING)
ELEMENTS = (BEM, LOOSE, EXTRAPOLATED, POLONSKY_KEER, *(solver.name for solver in SOLVERS))
UP_TO, FROM = "springs", "boundary elements"
NOTCH = 1.57
"""Half of the 95 % interval of a median, over the interquartile range over sqrt(runs).

Source: McGill, Tukey, Larsen, Am. Stat. 32 (1978) 12.
"""
Groups = Sequence[Sequence[Point]]


def time_numbers(groups: Groups) -> tuple[Number, ...]:
    """Of each chart: springs along their own front, and boundary elements along what is left of the front beyond."""
    found = []
    for group in groups:
        others = [point for point in group if point.finished and not point.is_reference]
        springs = front([point for point in others if point.method in SPRINGS])
        if springs:
            rivals = [point for point in others if point.method not in SPRINGS]
            beyond = [point for point in front(others) if point.rank < springs[-1].rank]
            elements = [point for point in others if point.method in ELEMENTS]
            found.append([_time(UP_TO, s, s, _cheapest_as_close(s, rivals)) for s in springs])
            as_close = [(_cheapest_as_close(point, elements), point) for point in beyond]
            found.append([_time(FROM, point, mine, point) for mine, point in as_close if mine])
    return tuple(worst(numbers, _error_of(numbers)) for numbers in found if numbers)


def _cheapest_as_close(point: Point, others: Iterable[Point]) -> Point | None:
    close = [other for other in others if other.rank <= point.rank]
    return min(close, key=lambda other: other.seconds[1], default=None)


def _time(model: str, at: Point, mine: Point, other: Point | None) -> Number:
    """Of one over that of the other, at an error that both reach: zero where there is no other."""
    ratio = mine.seconds[1] / other.seconds[1] if other else 0.0
    half_width = ratio * math.hypot(_uncertainty(mine), _uncertainty(other)) if other and other is not mine else 0.0
    error = at.rank if at.unit == "dB" else 100 * at.rank
    return Number(
        quantity="time over that of the cheapest other method as close",
        model=model,
        where={"scene": at.scene, "quantity": at.quantity, f"error [{at.unit}]": error},
        value=ratio,
        reference=0.0,
        source=other.method if other else "no other method is as close",
        tolerance=1.0,
        reason="above one another method is cheaper",
        sample=half_width,
        role=Role.FINDING,
    )


def _uncertainty(point: Point) -> float:
    """Relative, of the median time."""
    low, median, high = point.seconds
    return NOTCH * (high - low) / median / math.sqrt(point.runs) if point.runs > 1 else ALONE


def _error_of(numbers: Sequence[Number]) -> str:
    return next(name for name in numbers[0].where if name.startswith("error"))


def claims_of(
    times: Sequence[Number], models: Sequence[Number], orders: Sequence[Number], equal: Sequence[Number]
) -> tuple[JudgedClaim, ...]:
    up_to, beyond = ([number for number in times if number.model == model] for model in (UP_TO, FROM))
    best = _best(models)
    candidates = (
        (CLAIM, up_to, _counted(up_to)),
        (BEYOND, beyond, _counted(beyond)),
        (ENOUGH, best, "; ".join(_said(number) for number in best) + "."),
        (ORDERS, orders, "; ".join(_order(number) for number in orders) + "."),
        (EQUAL, equal, f"ratios are within {max((abs(n.difference) for n in equal), default=0.0):.0e} of one."),
    )
    return tuple(answered(claim, numbers, answer) for claim, numbers, answer in candidates if numbers)


def headlines(times: Sequence[Number]) -> dict[str, str]:
    """On how many charts springs, and beyond them boundary elements, are the cheapest."""
    springs, elements = ([number for number in times if number.model == model] for model in (UP_TO, FROM))
    found = {}
    if springs:
        found["precision-summary"] = (
            f"As close as springs come, they are the cheapest on {share(springs, Verdict.AGREE)} charts"
        )
    if elements:
        found["precision"] = (
            f"Closer than springs, boundary elements are the cheapest on {share(elements, Verdict.AGREE)} charts"
        )
    return found


def _counted(times: Sequence[Number]) -> str:
    """On how many charts, and where another method is the cheapest."""
    cheapest, undecided = (sum(n.verdict is verdict for n in times) for verdict in (Verdict.AGREE, Verdict.UNDECIDED))
    dearer = [
        f"{number.where['scene']}, {number.where['quantity']}: {number.value:.3g} times the time of {number.source}"
        for number in times
        if number.verdict is Verdict.DIFFER
    ]
    faster = [1 / number.value for number in times if number.verdict is Verdict.AGREE and 0 < number.value < 1]
    by = f" (others as close take {min(faster):.3g} to {max(faster):.3g} times as long)" if faster else ""
    where = f" ({'; '.join(dearer)})" if dearer else ""
    return (
        f"they are the cheapest on {cheapest} of {len(times)} charts{by}, undecided on {undecided}, not on "
        f"{len(dearer)}{where}."
    )


def _order(number: Number) -> str:
    return f"{number.where['scene']}, {number.model}: order {number.value:.2f} beside {number.reference:g}"


def _best(models: Sequence[Number]) -> list[Number]:
    """Of each scene and quantity, the model with the smallest error."""
    found: dict[tuple[object, str], Number] = {}
    for number in models:
        key = number.where["scene"], number.quantity
        found[key] = min(found.get(key, number), number, key=lambda one: one.value + one.uncertainty)
    return list(found.values())


def _said(number: Number) -> str:
    scale = 1.0 if number.unit == "dB" else 0.01
    value, half = (format_error(scale * each, number.unit) for each in (number.value, number.uncertainty))
    return f"{number.where['scene']}, {number.quantity}: {value} ± {half} by {number.model}"
