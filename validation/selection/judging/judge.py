"""What each kind of model is judged by: its judge finds answers of the model beside references, a point each."""

import math
from collections.abc import Callable, Iterator, Mapping
from itertools import chain
from pkgutil import resolve_name
from typing import Any, NamedTuple, TypeVar

from validation.analysis.judgement import FAILED, LEVEL, REFUSED, JudgedPoint, compared, not_compared
from validation.analysis.statistics import Estimate, FloatArray
from validation.engine.offered import Caller, Failed
from validation.selection.judging.references import Place, Reference

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
        return cls(one.value, one.half_width / (1.0 if unit == LEVEL else abs(one.value)))


class Finding(NamedTuple):
    """An answer, or why there is none, beside its reference. within: the tolerance of what is exact."""

    quantity: str
    known: Reference
    mine: ModelAnswer | Failed
    within: float | None = None

    def judged(self, tolerance: float) -> JudgedPoint:
        known, mine = self.known, self.mine
        if isinstance(mine, Failed):
            verdict, unit = REFUSED if mine.refused else FAILED, LEVEL if known.unit == LEVEL else "-"
            return not_compared(self.quantity, known.where, verdict, mine.reason, reference=known.value, unit=unit)
        half, within = known.grid + math.hypot(known.sample, mine.half), self.within or tolerance
        given = self.quantity, known.where, mine.value, known.value, half, within
        return compared(*given, unit=known.unit, reason=mine.reason)


def rule(
    quantity: str, where: Mapping[str, Place], value: float | Failed, grid: float = 0.0, within: float | None = None
) -> Finding:
    """What every model must follow: a number that is one."""
    mine = value if isinstance(value, Failed) else ModelAnswer(value)
    return Finding(quantity, Reference(where, 1.0, 0.0, grid), mine, within)


def points_of(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """Of a reduced model: by its judge, and past the scenes of that."""
    judge: Callable[[Caller], Iterator[Finding]] = resolve_name(f"{__package__}.{JUDGES[model.kind]}")
    sweep: Callable[[Caller], Iterator[Finding]] = resolve_name(f"{__package__}.sweeps:swept")
    yield from (one.judged(tolerance) for one in chain(judge(model), sweep(model)))


class LostError(ArithmeticError):
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


def attempted(find: Callable[[], T]) -> T | Failed:
    """What is found, or why a model that is asked for it has no answer."""
    try:
        return find()
    except LostError as error:
        return error.failed
