"""What each kind of model is judged by: its judge finds answers of the model beside references, a point each."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import repeat
from pkgutil import resolve_name
from typing import Any, NamedTuple, TypeVar

from validation.analysis.statistics import Estimate, FloatArray
from validation.judging.judgement import AGAIN, FAILED, LEVEL, REFUSED, Conditions, JudgedPoint, compared, not_compared
from validation.judging.kinds.references import Reference
from validation.judging.kinds.repeats import SAME, Recorded, repeated
from validation.judging.registry import Caller, Failed

T = TypeVar("T")
JUDGES: Mapping[str, str] = {
    "stiffness_model": "stiffness:judged",
    "stiffness_of_surface": "surfaces:judged",
    "force_spectrum": "rolling:judged_spectrum",
    "rolling_model": "rolling:judged",
    "contact_filter": "filters:judged",
    "profile_spectrum": "profiles:judged",
    "contact_law": "laws:judged",
}
"""Module beside this one, and its function, by the decorator; a contact solver is judged among the benchmarks."""


class ModelAnswer(NamedTuple):
    """A number of a model. half: of the 95 % interval of its sample, over the value, of levels in decibels."""

    value: float
    half: float = 0.0
    reason: str = ""

    @classmethod
    def of(cls, one: Estimate, unit: str) -> "ModelAnswer":
        return cls(one.value, one.half_width / (1.0 if unit == LEVEL else abs(one.value) or 1.0))


Found = ModelAnswer | Failed | float


class Finding(NamedTuple):
    """An answer, or why there is none, beside its reference. within: the tolerance of what is exact."""

    known: Reference
    found: Found
    within: float | None = None

    def judged(self, tolerance: float) -> JudgedPoint:
        known, found = self.known, self.found
        if isinstance(found, Failed):
            verdict, unit = REFUSED if found.refused else FAILED, LEVEL if known.unit == LEVEL else "-"
            return not_compared(known.quantity, known.where, verdict, found.reason, reference=known.value, unit=unit)
        mine = found if isinstance(found, ModelAnswer) else ModelAnswer(float(found))
        half, within = known.grid + math.hypot(known.sample, mine.half), self.within or tolerance
        given = known.quantity, known.where, mine.value, known.value, half, within
        return compared(*given, unit=known.unit, reason=mine.reason)


def beside(known: Iterable[Reference], found: Iterable[Found | None] | Failed) -> Iterator[Finding]:
    """An answer each, or one failure for all; None is a number that the model does not have."""
    answers = repeat(found) if isinstance(found, Failed) else found
    return (Finding(row, mine) for row, mine in zip(known, answers, strict=False) if mine is not None)


def rule(quantity: str, where: Conditions, found: Found, grid: float = 0.0, within: float | None = None) -> Finding:
    """What every model must follow: a number that is one."""
    return Finding(Reference(where, 1.0, grid=grid, quantity=quantity), found, within)


def points_of(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """Of a reduced model: by its judge, at held-out points, by rules of scaling, past these scenes, and once again."""
    recorded = Recorded(model)
    for place in (JUDGES[model.kind], "held_out:judged", "scaling:judged", "sweeps:swept"):
        judge: Callable[[Caller], Iterator[Finding]] = resolve_name(f"{__package__}.{place}")
        yield from (one.judged(tolerance) for one in judge(recorded))
    calls = float(recorded.count)
    if found := repeated(recorded):
        size = found.change
        again = size if isinstance(size, Failed) else ModelAnswer(1 + size, reason=found.reason)
        yield rule(AGAIN, {"calls": calls}, again, within=SAME).judged(tolerance)


class LostError(ValueError):
    """A model has no answer. failed: why."""

    def __init__(self, failed: Failed):
        super().__init__(failed.reason)
        self.failed = failed


def asked(model: Caller, **arguments: Any) -> FloatArray:
    """The answer of a model. Raises LostError where it has none."""
    found = model.call(**arguments)
    if isinstance(found, Failed):
        raise LostError(found)
    return found


def attempted(find: Callable[..., T], *arguments: Any) -> T | Failed:
    """What is found, or why a model that is asked for it has no answer."""
    try:
        return find(*arguments)
    except LostError as error:
        return error.failed
