"""A limit of a method, and a sweep through it: the error, the border that was predicted, what the software says."""

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
T = TypeVar("T")
REFUSALS = (ValueError, ArithmeticError, bem3d.ConvergenceError)


@dataclass(frozen=True, kw_only=True)
class Limit:
    """What is swept and measured, and where it must fail.

    name: of the sweep; method: that fails; title: in a few words; knob, error: what is changed, and what comes of it,
    with units; against: what is better; condition: of the border; failing: its bad side; tolerance: of the error, above
    zero; factor: above one, within which the border is predicted; derived: whether the border follows from theory alone
    and must be met, or is an estimate; warned: whether the software must speak beyond it, and nowhere else.
    """

    name: str
    method: str
    title: str
    knob: str
    error: str
    against: str
    condition: str
    failing: Literal["above", "below"]
    tolerance: float
    factor: float
    derived: bool = False
    warned: bool = False


@dataclass(frozen=True, eq=False)
class Sweep:
    """A limit, swept: values of the knob, ascending, the error at each, infinite where there is no answer, the border
    of its condition, and what the software said at each value, nothing where it was silent.
    """

    limit: Limit
    knob: FloatArray
    error: FloatArray
    border: float
    said: tuple[str, ...]

    @classmethod
    def of(cls, limit: Limit, outcome: Outcome) -> "Sweep":
        """The sweep of that name in what a solve has found."""
        knob, error, border, said = (outcome[f"{limit.name} {part}"] for part in ("knob", "error", "border", "said"))
        return cls(limit, knob, error, float(border), tuple(str(words) for words in said))

    @property
    def beyond(self) -> NDArray[np.bool_]:
        """Values on the failing side, further from the border than the factor."""
        factor = self.limit.factor
        if self.limit.failing == "above":
            return np.asarray(self.knob > self.border * factor)
        return np.asarray(self.knob < self.border / factor)

    @property
    def within(self) -> NDArray[np.bool_]:
        """Values on the good side, further from the border than the factor."""
        factor = self.limit.factor
        if self.limit.failing == "above":
            return np.asarray(self.knob < self.border / factor)
        return np.asarray(self.knob > self.border * factor)

    @property
    def spoke(self) -> NDArray[np.bool_]:
        """Where the software warned or refused."""
        return np.array([bool(words) for words in self.said])

    @property
    def predicted(self) -> bool:
        """Whether the error is past its tolerance everywhere beyond the border, and nowhere on the good side."""
        failed, good = self.error[self.beyond], self.error[self.within]
        tolerance = self.limit.tolerance
        return bool(failed.size and good.size and (failed > tolerance).all() and (good <= tolerance).all())

    @property
    def refused(self) -> bool:
        """Whether there is no answer anywhere beyond the border, so that no error is seen there."""
        return not np.isfinite(self.error[self.beyond]).any()

    @property
    def told(self) -> float:
        """The part of the values beyond the border, and of those on the good side, where it spoke and was silent."""
        return float(np.concatenate([self.spoke[self.beyond], ~self.spoke[self.within]]).mean())

    @property
    def verdict(self) -> str:
        """Whether a user was told."""
        spoke, early = self.spoke[self.beyond], self.spoke[self.within]
        if spoke.size and spoke.all() and not early.any():
            return "told"
        if not spoke.any():
            return "not told"
        return f"told at {np.count_nonzero(spoke)} of {spoke.size}" + (", too early" if early.any() else "")

    @property
    def crossing(self) -> tuple[float, float] | None:
        """Where the error passes its tolerance, on a logarithmic scale, and half of the step it lies in, in octaves.

        Going from the good side on, for the last time; None where it does not.
        """
        order = slice(None) if self.limit.failing == "above" else slice(None, None, -1)
        knob, error = np.log2(self.knob[order]), self.error[order]
        good = np.flatnonzero(error <= self.limit.tolerance)
        if not good.size or good[-1] == error.size - 1:
            return None
        last = slice(int(good[-1]), int(good[-1]) + 2)
        (x, y), (low, high) = knob[last], np.maximum(error[last], 1e-3 * self.limit.tolerance)
        part = math.log(self.limit.tolerance / low) / math.log(high / low) if math.isfinite(high) else 0.5
        return float(2 ** (x + part * (y - x))), abs(float(y - x)) / 2

    def at_the_ends(self) -> tuple[float, float]:
        """The largest error on the good side and the smallest beyond the border; NaN where the sweep has none."""
        good, failed = self.error[self.within], self.error[self.beyond]
        return float(good.max()) if good.size else math.nan, float(failed.min()) if failed.size else math.nan

    @property
    def sentence(self) -> str:
        """The first thing that was said beyond the border, or nothing."""
        spoken = [words for words, beyond in zip(self.said, self.beyond, strict=True) if words and beyond]
        return (spoken[-1] if self.limit.failing == "below" else spoken[0]) if spoken else ""


def swept(name: str, knob: ArrayLike, error: ArrayLike, border: float, said: Sequence[str]) -> Outcome:
    """What a solve has found of a limit, in ascending order of the knob."""
    order = np.argsort(np.asarray(knob, dtype=np.float64))
    return {
        f"{name} knob": np.asarray(knob, dtype=np.float64)[order],
        f"{name} error": np.asarray(error, dtype=np.float64)[order],
        f"{name} border": np.array(float(border)),
        # a stored outcome keeps words as well as numbers
        f"{name} said": cast(FloatArray, np.array([said[i] for i in order], dtype=np.str_)),
    }


def call_and_record_warnings(call: Callable[[], T]) -> tuple[T | None, str]:
    """What a call answers, None where it refuses, and what it says: its warnings, or the reason of its refusal.

    Whether units are right is asked of spikes and pits on either side of a limit, and is no word about it.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            answer = call()
        except REFUSALS as error:
            return None, f"{type(error).__name__}: {error}"
    said = [w for w in caught if not issubclass(w.category, (mdr.SpringUnitsWarning, bem3d.UnitsWarning))]
    return answer, "; ".join(f"{w.category.__name__}: {w.message}" for w in said)
