"""What each kind of model is judged by: its judge finds answers of the model beside references, a point each."""

import copy
import hashlib
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import repeat
from pkgutil import resolve_name
from typing import Any, NamedTuple, TypeVar

import numpy as np

from validation.analysis.evidence import Verdict
from validation.analysis.statistics import Estimate, FloatArray
from validation.engine.engine import identity
from validation.judging.judgement import AGAIN, LEVEL, RATIO, Conditions, JudgedNumber, judged_number, missing_number
from validation.judging.kinds.references import Reference
from validation.judging.registry import Caller, Failed, Offered

SAME, TIMES, OTHERS, MANY = 1e-4, 5, 4, 4
"""Relative change of an answer that rounding, or the residual of a solver, may leave; how often the first problem is
asked again; how many others are; different answers to one problem that only chance has."""
SMALL = 64
"""Numbers of an answer that is kept for each problem."""
TREND = 0.5
"""Of the change since the first call, that of calls one after the other, above which the answers are random."""
RANDOM, DRIFTING, CACHED = "random without rng", "its answers drift with the number of calls", "cached by identity"


class AnsweredProblem(NamedTuple):
    """Arguments of one call, and the answer to it."""

    arguments: Mapping[str, Any]
    answer: FloatArray


@dataclass
class Recorded(Caller):
    """A model whose first problem, and a few later ones, are kept. Each call has arguments of its own."""

    model: Caller
    count: int = field(default=0, init=False)
    kept: list[AnsweredProblem] = field(default_factory=list, init=False)
    answers: dict[bytes, set[bytes]] = field(default_factory=dict, init=False, repr=False)
    """Problems that have each answer, to the last bit."""
    first: dict[bytes, FloatArray] = field(default_factory=dict, init=False, repr=False)
    changed: list[tuple[bytes, FloatArray, FloatArray]] = field(default_factory=list, init=False, repr=False)
    """The first answer to each problem; problems that were asked twice, with both answers, where these differ."""

    @property
    def offered(self) -> Offered[..., Any]:  # type: ignore[override]  # is read alone
        return self.model.offered

    @property
    def warned(self) -> str:
        return self.model.warned

    def calls(self, name: str, values: Sequence[Any], arguments: Mapping[str, Any]) -> list[FloatArray | Failed]:
        digests, copies = [], []
        for number, value in enumerate(values):
            problem = {key: argument for key, argument in {**arguments, name: value}.items() if key in self.asks}
            # a generator is used up by its call
            digests.append(digest_of(problem))
            candidate = len(self.kept) <= OTHERS and self.count + number + 1 >= 4 ** len(self.kept)
            copies.append(copied(problem) if candidate else None)
        answers = self.model.calls(name, values, copied(arguments))
        for digest, problem_kept, answer in zip(digests, copies, answers, strict=True):
            self.count += 1
            if isinstance(answer, Failed):
                continue
            self.answers.setdefault(answer.tobytes(), set()).add(digest)
            before = self.first.setdefault(digest, answer) if answer.size <= SMALL else answer
            if change(before, answer) > SAME:
                self.changed.append((digest, before, answer))
            if problem_kept is not None and len(self.kept) <= OTHERS and self.count >= 4 ** len(self.kept):
                self.kept.append(AnsweredProblem(problem_kept, answer))
        return answers


def copied(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """The same values in new objects, but for arrays, which callers copy."""
    return {
        name: value if isinstance(value, np.ndarray | float | int) else copy.deepcopy(value)
        for name, value in arguments.items()
    }


def digest_of(arguments: Mapping[str, Any]) -> bytes:
    """Of the values."""
    digest = hashlib.blake2b(digest_size=16)
    for name, value in sorted(arguments.items()):
        state = value.bit_generator.state if isinstance(value, np.random.Generator) else value
        digest.update(name.encode())
        is_array = isinstance(state, np.ndarray)
        digest.update(np.ascontiguousarray(state).tobytes() if is_array else identity(state).encode())
    return digest.digest()


class Repetition(NamedTuple):
    """change: the largest of an answer, relative, or why there is none; reason: why an answer changes, in words."""

    change: float | Failed
    reason: str = ""


def repeated(model: Recorded) -> Repetition | None:
    """The first problem again, and a few others; None of a model without answers."""
    if not model.kept:
        return None
    first, *later = model.kept
    # all arguments are alive at once, so that none has the identity of another
    problems = [first, *later, *[first] * (TIMES - 1)]
    alive = [copied(problem.arguments) for problem in problems]
    again = [model.model.call(**arguments) for arguments in alive]
    if lost := next((answer for answer in again if isinstance(answer, Failed)), None):
        return Repetition(Failed(f"answered the first time, and then: {lost.reason}"))
    answers = [answer for answer in again if not isinstance(answer, Failed)]
    largest = max(change(problem.answer, answer) for problem, answer in zip(problems, answers, strict=True))
    if largest > SAME:
        return Repetition(largest, cause(model, problems, answers))
    return _answered_twice(model) if model.changed else Repetition(largest)


def _answered_twice(model: Recorded) -> Repetition:
    """Of a problem that more than one judge has set."""
    digest, before, after = max(model.changed, key=lambda row: change(row[1], row[2]))
    is_cached = any(model.answers[answer.tobytes()] - {digest} for answer in (before, after))
    reason = f"{CACHED}: it has the answer of another problem" if is_cached else f"{DRIFTING}: it has a state"
    return Repetition(change(before, after), reason)


def cause(model: Recorded, problems: Sequence[AnsweredProblem], answers: Sequence[FloatArray]) -> str:
    """Random, drifting, or cached: an answer that is that of another problem to the last bit."""
    first = problems[0].answer
    of_first = [answers[0], *answers[-(TIMES - 1) :]]
    steps = np.diff([_along(first, value) for value in (first, *of_first)])
    trend = (steps > 0).all() or (steps < 0).all()
    # what is cached has few answers to one problem
    if len({value.tobytes() for value in (first, *of_first)}) >= MANY and not trend:
        return _random(model)
    for problem, answer in zip(problems, answers, strict=True):
        if change(problem.answer, answer) > SAME:
            for value in (problem.answer, answer):
                if model.answers.get(value.tobytes(), set()) - {digest_of(problem.arguments)}:
                    return f"{CACHED}: it has the answer of another problem"
    successive = max(change(of_first[0], value) for value in of_first)
    if not trend and successive > max(SAME, TREND * change(first, of_first[0])):
        return _random(model)
    return f"{DRIFTING}: it has a state"


def _random(model: Recorded) -> str:
    if "rng" in model.asks:
        return "random beside rng: the same rng gives other draws"
    return f"{RANDOM}: the same arguments have other answers"


def _along(first: FloatArray, answer: FloatArray) -> float:
    """An answer as a part of the first one."""
    return float(np.vdot(first, answer)) / (float(np.vdot(first, first)) or 1.0)


def change(before: FloatArray, after: FloatArray) -> float:
    """Relative, of the norm."""
    size = float(np.linalg.norm(before)) or 1.0
    return float(np.linalg.norm(after - before)) / size if after.shape == before.shape else float("inf")


T = TypeVar("T")
JUDGES: Mapping[str, str] = {
    "stiffness_model": "stiffness:judged",
    "stiffness_of_surface": "stiffness:judged_surfaces",
    "force_spectrum": "rolling:judged_spectrum",
    "rolling_model": "rolling:judged",
    "contact_filter": "rolling:judged_filter",
    "profile_spectrum": "profiles:judged",
    "interface_model": "interfaces:judged",
    "contact_law": "laws:judged",
}
"""Module beside this one, and its function, by the decorator; a contact solver is judged among the benchmarks."""


class ModelAnswer(NamedTuple):
    """A number of a model. half: of the 95 % interval of its sample, over the value, of levels in decibels."""

    value: float
    half: float = 0.0
    reason: str = ""

    @classmethod
    def of(cls, estimate: Estimate, unit: str) -> "ModelAnswer":
        return cls(estimate.value, estimate.half_width / (1.0 if unit == LEVEL else abs(estimate.value) or 1.0))


Answer = ModelAnswer | Failed | float


class Finding(NamedTuple):
    """An answer, or why there is none, beside its reference. within: the tolerance of what is exact."""

    reference: Reference
    answer: Answer
    within: float | None = None

    def judged(self, tolerance: float) -> JudgedNumber:
        """The row: the grid of the reference is added to both samples, which are combined in quadrature."""
        reference, answer = self.reference, self.answer
        if isinstance(answer, Failed):
            return missing_number(
                reference.quantity,
                reference.where,
                Verdict.NOT_SERVED if answer.refused else Verdict.NO_RESULT,
                answer.reason,
                reference=reference.value,
                unit=LEVEL if reference.unit == LEVEL else RATIO,
            )
        answer = answer if isinstance(answer, ModelAnswer) else ModelAnswer(float(answer))
        return judged_number(
            reference.quantity,
            reference.where,
            answer.value,
            reference.value,
            reference.grid + math.hypot(reference.sample, answer.half),
            self.within or tolerance,
            unit=reference.unit,
            reason=answer.reason,
            grid=reference.grid,
        )


def compared(references: Iterable[Reference], answers: Iterable[Answer | None] | Failed) -> Iterator[Finding]:
    """An answer each, or one failure for all; None is a number that the model does not have."""
    each = repeat(answers) if isinstance(answers, Failed) else answers
    return (Finding(row, answer) for row, answer in zip(references, each, strict=False) if answer is not None)


def rule(quantity: str, where: Conditions, answer: Answer, grid: float = 0.0, within: float | None = None) -> Finding:
    """What every model must follow: a number that is one."""
    return Finding(Reference(where, 1.0, grid=grid, quantity=quantity), answer, within)


def points_of(model: Caller, tolerance: float) -> Iterator[JudgedNumber]:
    """Of a reduced model: by its judge, at held-out points, by rules of scaling, past these scenes, and once again."""
    recorded = Recorded(model)
    for place in (JUDGES[model.kind], "held_out_points:judged", "properties:judged_scaling", "properties:swept"):
        judge: Callable[[Caller], Iterator[Finding]] = resolve_name(f"{__package__}.{place}")
        yield from (finding.judged(tolerance) for finding in judge(recorded))
    calls = float(recorded.count)
    if repetition := repeated(recorded):
        size = repetition.change
        again = size if isinstance(size, Failed) else ModelAnswer(1 + size, reason=repetition.reason)
        yield rule(AGAIN, {"calls": calls}, again, within=SAME).judged(tolerance)


class LostError(ValueError):
    """A model has no answer. failed: why."""

    def __init__(self, failed: Failed):
        super().__init__(failed.reason)
        self.failed = failed


def answer_of(model: Caller, **arguments: Any) -> FloatArray:
    """The answer of a model. Raises LostError where it has none."""
    answer = model.call(**arguments)
    if isinstance(answer, Failed):
        raise LostError(answer)
    return answer


def attempted(find: Callable[..., T], *arguments: Any) -> T | Failed:
    """What is found, or why a model that is asked for it has no answer."""
    try:
        return find(*arguments)
    except LostError as error:
        return error.failed
