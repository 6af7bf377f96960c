"""What a probe hands over: the error at each value of a parameter, and what the software says there."""

import warnings
from collections.abc import Callable, Sequence
from functools import wraps
from typing import TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike

import bem3d
import mdr
from validation.engine.engine import FloatArray, Outcome

Values = tuple[float, ...]
Point = tuple[float, str]
"""The error at one value, infinite where there is no answer, and the message of the software, empty without one."""
T = TypeVar("T")
REFUSALS = (ValueError, ArithmeticError, bem3d.ConvergenceError)


def swept(
    values: ArrayLike, error: ArrayLike, messages: Sequence[str], *, measured: ArrayLike = 1.0, **also: ArrayLike
) -> Outcome:
    """The outcome of a sweep through a limit, sorted by ascending values. error: of one limit, or a row for each of
    several; measured: what predicted thresholds take from the solve; also: further columns, or numbers."""
    x = np.asarray(values, dtype=np.float64)
    order = np.argsort(x)
    return {
        "values": x[order],
        "error": np.atleast_2d(np.asarray(error, dtype=np.float64))[:, order],
        "measured": np.atleast_1d(np.asarray(measured, dtype=np.float64)),
        # a stored outcome keeps words as well as numbers
        "messages": cast(FloatArray, np.asarray(messages, dtype=np.str_)[order]),
        **{name: np.asarray(value, dtype=np.float64) for name, value in also.items()},
    }


def along(point: Callable[..., tuple[float, float, str]]) -> Callable[..., Outcome]:
    """A probe by that of one value, which gives the value to be shown, the error, and the message."""

    @wraps(point)
    def probe(values: Sequence[float], **settings: int) -> Outcome:
        return swept(*zip(*(point(value, **settings) for value in values), strict=True))

    return probe


def recorded(call: Callable[[], T]) -> tuple[T | None, str]:
    """The answer of a call, None where it refuses, and its message: its warnings, or the reason of its refusal.

    Warnings about units are left out: sweeps of spikes and pits give them on either side of a threshold.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            answer = call()
        except REFUSALS as error:
            return None, f"{type(error).__name__}: {error}"
    relevant = [w for w in caught if not issubclass(w.category, (mdr.SpringUnitsWarning, bem3d.UnitsWarning))]
    return answer, "; ".join(f"{w.category.__name__}: {getattr(w.message, 'detail', w.message)}" for w in relevant)


def answered(call: Callable[[], T]) -> tuple[T, str]:
    """Answer and message of a call that must not refuse, as of `recorded`. ArithmeticError has the reason."""
    answer, message = recorded(call)
    if answer is None:
        raise ArithmeticError(message)
    return answer, message


def message_of(call: Callable[[], object]) -> str:
    """Warnings or refusal of a call, as of `recorded`; empty without any."""
    return recorded(call)[1]
