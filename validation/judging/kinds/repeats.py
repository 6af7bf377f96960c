"""The same problem asked again: whether a model has one answer to it, or is random, drifts, or mixes up problems."""

import copy
import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from validation.analysis.statistics import FloatArray
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
    def offered(self) -> Offered:  # type: ignore[override]  # is read alone
        return self.model.offered

    @property
    def warned(self) -> str:
        return self.model.warned

    def calls(self, name: str, values: Sequence[Any], arguments: Mapping[str, Any]) -> list[FloatArray | Failed]:
        digests, copies = [], []
        for number, value in enumerate(values):
            problem = {one: some for one, some in {**arguments, name: value}.items() if one in self.asks}
            # a generator is used up by its call
            digests.append(digest_of(problem))
            candidate = len(self.kept) <= OTHERS and self.count + number + 1 >= 4 ** len(self.kept)
            copies.append(own(problem) if candidate else None)
        found = self.model.calls(name, values, own(arguments))
        for digest, problem_kept, answer in zip(digests, copies, found, strict=True):
            self.count += 1
            if isinstance(answer, Failed):
                continue
            self.answers.setdefault(answer.tobytes(), set()).add(digest)
            before = self.first.setdefault(digest, answer) if answer.size <= SMALL else answer
            if change(before, answer) > SAME:
                self.changed.append((digest, before, answer))
            if problem_kept is not None and len(self.kept) <= OTHERS and self.count >= 4 ** len(self.kept):
                self.kept.append(AnsweredProblem(problem_kept, answer))
        return found


def own(arguments: Mapping[str, Any]) -> dict[str, Any]:
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
        digest.update(np.ascontiguousarray(state).tobytes() if isinstance(state, np.ndarray) else repr(state).encode())
    return digest.digest()


class Repetition(NamedTuple):
    """change: the largest of an answer, relative, or why there is none; reason: why an answer changes, in words."""

    change: float | Failed
    reason: str = ""


def repeated(model: Recorded) -> Repetition | None:
    """The first problem again, and a few others; None of a model without answers."""
    if not model.kept:
        return None
    first, *others = model.kept
    # all arguments are alive at once, so that none has the identity of another
    problems = [first, *others, *[first] * (TIMES - 1)]
    alive = [own(problem.arguments) for problem in problems]
    again = [model.model.call(**arguments) for arguments in alive]
    if lost := next((answer for answer in again if isinstance(answer, Failed)), None):
        return Repetition(Failed(f"answered the first time, and then: {lost.reason}"))
    answers = [answer for answer in again if not isinstance(answer, Failed)]
    largest = max(change(problem.answer, answer) for problem, answer in zip(problems, answers, strict=True))
    if largest > SAME:
        return Repetition(largest, cause(model, problems, answers))
    return _asked_twice(model) if model.changed else Repetition(largest)


def _asked_twice(model: Recorded) -> Repetition:
    """Of a problem that more than one judge has asked."""
    digest, before, after = max(model.changed, key=lambda one: change(one[1], one[2]))
    is_cached = any(model.answers[one.tobytes()] - {digest} for one in (before, after))
    reason = f"{CACHED}: it has the answer of another problem" if is_cached else f"{DRIFTING}: it has a state"
    return Repetition(change(before, after), reason)


def cause(model: Recorded, problems: Sequence[AnsweredProblem], answers: Sequence[FloatArray]) -> str:
    """Random, drifting, or cached: an answer that is that of another problem to the last bit."""
    first = problems[0].answer
    of_first = [answers[0], *answers[-(TIMES - 1) :]]
    steps = np.diff([_along(first, one) for one in (first, *of_first)])
    trend = (steps > 0).all() or (steps < 0).all()
    # what is cached has few answers to one problem
    if len({one.tobytes() for one in (first, *of_first)}) >= MANY and not trend:
        return _random(model)
    for problem, answer in zip(problems, answers, strict=True):
        if change(problem.answer, answer) > SAME:
            for one in (problem.answer, answer):
                if model.answers.get(one.tobytes(), set()) - {digest_of(problem.arguments)}:
                    return f"{CACHED}: it has the answer of another problem"
    one_after_the_other = max(change(of_first[0], one) for one in of_first)
    if not trend and one_after_the_other > max(SAME, TREND * change(first, of_first[0])):
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
