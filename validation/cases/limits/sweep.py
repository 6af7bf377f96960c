"""A limit of a method, and a sweep through it: the error, the threshold that is predicted, what the software says."""

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

import bem3d
import mdr
from validation.engine.engine import Outcome

FloatArray = NDArray[np.float64]
Point = tuple[float, str]
"""The error at one value of the parameter, and the message of the software, empty where it gives none."""
T = TypeVar("T")
REFUSALS = (ValueError, ArithmeticError, bem3d.ConvergenceError)


@dataclass(frozen=True, kw_only=True)
class Limit:
    """What is swept and measured, and where it must fail.

    name: of the sweep; method: that fails; title: in a few words; parameter, error: what is changed and what is
    measured, with units; reference: what the error is measured against; condition: of the threshold; failing_side: of
    it; tolerance: of the error, above zero; factor: above one, within which the threshold is predicted; derived:
    whether the threshold follows from theory alone and must be met, or is an estimate; warned: whether the software
    must warn or refuse past it, and nowhere else.
    """

    name: str
    method: str
    title: str
    parameter: str
    error: str
    reference: str
    condition: str
    failing_side: Literal["above", "below"]
    tolerance: float
    factor: float
    derived: bool = False
    warned: bool = False


@dataclass(frozen=True, eq=False)
class Sweep:
    """A limit, swept: values of its parameter, ascending; the error at each, infinite where there is no answer; the
    threshold by its condition; the message of the software at each value, empty where it gives none.
    """

    limit: Limit
    values: FloatArray
    error: FloatArray
    predicted_threshold: float
    messages: tuple[str, ...]

    @classmethod
    def of(cls, limit: Limit, outcome: Outcome) -> "Sweep":
        """The sweep of that name in the outcome of a solve."""
        parts = ("values", "error", "threshold", "messages")
        values, error, threshold, messages = (outcome[f"{limit.name} {part}"] for part in parts)
        return cls(limit, values, error, float(threshold), tuple(str(message) for message in messages))

    @property
    def past_threshold(self) -> NDArray[np.bool_]:
        """Values on the failing side, further from the threshold than the factor."""
        threshold, factor = self.predicted_threshold, self.limit.factor
        if self.limit.failing_side == "above":
            return np.asarray(self.values > threshold * factor)
        return np.asarray(self.values < threshold / factor)

    @property
    def before_threshold(self) -> NDArray[np.bool_]:
        """Values on the other side, further from the threshold than the factor."""
        threshold, factor = self.predicted_threshold, self.limit.factor
        if self.limit.failing_side == "above":
            return np.asarray(self.values < threshold / factor)
        return np.asarray(self.values > threshold * factor)

    @property
    def warned(self) -> NDArray[np.bool_]:
        return np.array([bool(message) for message in self.messages])

    @property
    def predicted(self) -> bool:
        """Whether the error exceeds its tolerance everywhere past the threshold, and nowhere before it."""
        failed, good = self.error[self.past_threshold], self.error[self.before_threshold]
        tolerance = self.limit.tolerance
        return bool(failed.size and good.size and (failed > tolerance).all() and (good <= tolerance).all())

    @property
    def refused(self) -> bool:
        """Whether there is no answer anywhere past the threshold, so that no error is seen there."""
        return not np.isfinite(self.error[self.past_threshold]).any()

    @property
    def share_of_correct_warnings(self) -> float:
        """Of the values past the threshold and before it: where a message was given, and where there was none."""
        return float(np.concatenate([self.warned[self.past_threshold], ~self.warned[self.before_threshold]]).mean())

    @property
    def verdict(self) -> str:
        """Whether a user was warned."""
        warned, early = self.warned[self.past_threshold], self.warned[self.before_threshold]
        if warned.size and warned.all() and not early.any():
            return "warned"
        if not warned.any():
            return "not warned"
        return f"warned at {np.count_nonzero(warned)} of {warned.size}" + (", too early" if early.any() else "")

    @property
    def crossing(self) -> tuple[float, float] | None:
        """Where the error passes its tolerance, on a logarithmic scale, and half of the step it lies in, in octaves.

        From the good side on, for the last time; None where it does not.
        """
        order = slice(None) if self.limit.failing_side == "above" else slice(None, None, -1)
        values, error = np.log2(self.values[order]), self.error[order]
        good = np.flatnonzero(error <= self.limit.tolerance)
        if not good.size or good[-1] == error.size - 1:
            return None
        last = slice(int(good[-1]), int(good[-1]) + 2)
        (x, y), (low, high) = values[last], np.maximum(error[last], 1e-3 * self.limit.tolerance)
        part = math.log(self.limit.tolerance / low) / math.log(high / low) if math.isfinite(high) else 0.5
        return float(2 ** (x + part * (y - x))), abs(float(y - x)) / 2

    @property
    def extreme_errors(self) -> tuple[float, float]:
        """The largest error before the threshold and the smallest past it; NaN where the sweep has none."""
        good, failed = self.error[self.before_threshold], self.error[self.past_threshold]
        return float(good.max()) if good.size else math.nan, float(failed.min()) if failed.size else math.nan

    @property
    def first_message(self) -> str:
        """The message nearest to the threshold on its failing side, empty where there is none."""
        given = [m for m, past in zip(self.messages, self.past_threshold, strict=True) if m and past]
        return (given[-1] if self.limit.failing_side == "below" else given[0]) if given else ""


def swept(limit: Limit, values: ArrayLike, points: Sequence[Point], threshold: float) -> Outcome:
    """The outcome of a solve that has swept a limit, in ascending order of its parameter."""
    x = np.asarray(values, dtype=np.float64)
    order = np.argsort(x)
    return {
        f"{limit.name} values": x[order],
        f"{limit.name} error": np.array([points[i][0] for i in order], dtype=np.float64),
        f"{limit.name} threshold": np.array(float(threshold)),
        # a stored outcome keeps words as well as numbers
        f"{limit.name} messages": cast(FloatArray, np.array([points[i][1] for i in order], dtype=np.str_)),
    }


def call_and_record_warnings(call: Callable[[], T]) -> tuple[T | None, str]:
    """The answer of a call, None where it refuses, and its message: its warnings, or the reason of its refusal.

    Warnings about units are left out: sweeps of spikes and pits give them on either side of a threshold.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            answer = call()
        except REFUSALS as error:
            return None, f"{type(error).__name__}: {error}"
    given = [w for w in caught if not issubclass(w.category, (mdr.SpringUnitsWarning, bem3d.UnitsWarning))]
    return answer, "; ".join(f"{w.category.__name__}: {getattr(w.message, 'detail', w.message)}" for w in given)
