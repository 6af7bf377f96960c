"""What a function of others answers: finite numbers of the right shape, or what is wrong with them."""

import math
import time
import traceback
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from validation.engine.installed import ENTRY
from validation.engine.offered import KINDS, Failed, FloatArray, Offered, OfferedError

SHOWN = 160
"""Characters of what was printed or raised."""
NOT_THEIRS = (Path(__file__).parent, Path())
"""Folders of files of ours, and of what is no file, as <frozen importlib>."""


class Reply(NamedTuple):
    """value: or what is wrong; warned: the first warning; seconds: that the function took."""

    value: FloatArray | Failed
    warned: str = ""
    seconds: float = math.nan


def called(offered: Offered, arguments: Mapping[str, Any]) -> Reply:
    """What a function says to these arguments."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        begin = time.perf_counter()
        value = _value(offered, arguments)
        seconds = time.perf_counter() - begin
    return Reply(value, " ".join(str(caught[0].message).split())[:SHOWN] if caught else "", seconds)


def _value(offered: Offered, arguments: Mapping[str, Any]) -> FloatArray | Failed:
    """The value, finite and of the right shape, or what is wrong. Arrays are read-only copies, compared afterwards."""
    given = {name: arguments[name] for name in offered.asks if name in arguments}
    arrays = {name: value.copy() for name, value in given.items() if isinstance(value, np.ndarray)}
    lent = {name: value.copy() for name, value in arrays.items()}
    for value in lent.values():
        value.setflags(write=False)
    try:
        with np.errstate(all="ignore"):
            # a view of what cannot be written cannot be made writeable
            value = offered.function(**{**given, **{name: value[...] for name, value in lent.items()}})
    except (Exception, SystemExit) as error:
        return Failed(f"raised {raised(error)}", refused=_is_raised_on_purpose(error))
    if changed := [name for name, kept in arrays.items() if not np.array_equal(kept, lent[name], equal_nan=True)]:
        return Failed(f"changed {changed[0]}, which is not its own")
    return _number(value, KINDS[offered.kind].shapes(given))


def _number(value: Any, shapes: tuple[tuple[int, ...], ...]) -> FloatArray | Failed:
    if value is None:
        return Failed("returned nothing")
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiu" or np.ma.is_masked(value):
            what = (
                "complex numbers" if array.dtype.kind == "c" else "masked values" if array.dtype.kind in "fiu" else ""
            )
            return Failed(f"returned {what or type(value).__name__}, must be real numbers")
        numbers = array.astype(np.float64)
    except (TypeError, ValueError):
        return Failed("returned rows of different lengths")
    if numbers.shape not in shapes:
        wanted = " or ".join(str(shape) if shape else "one number" for shape in shapes)
        return Failed(f"returned shape {numbers.shape}, must be {wanted}")
    if broken := int(np.count_nonzero(~np.isfinite(numbers))):
        return Failed("returned NaN or infinity" + (f", {broken} of {numbers.size} values" if numbers.ndim else ""))
    return numbers


def raised(error: BaseException, path: Path | None = None) -> str:
    """Its name, its words, and the last line of the file, or of any, that it went through.

    Of a decorator the line comes first, before names that are listed.
    """
    said = " ".join(str(error).split())
    lines = [(Path(frame.filename), frame.lineno) for frame in traceback.extract_tb(error.__traceback__)]
    mine = [(file, line) for file, line in lines if file.parent not in NOT_THEIRS and not file.name.startswith(ENTRY)]
    if path and not path.name.startswith(ENTRY):
        mine = [(file, line) for file, line in mine if file.is_relative_to(path.parent)]
    where = f"line {mine[-1][1]} of {mine[-1][0].name}" if mine else ""
    said = said if len(said) <= SHOWN else f"{said[:SHOWN]}..."
    if isinstance(error, OfferedError):
        return f"{where}: {said}" if where else said
    return f"{type(error).__name__}{f': {said}' if said else ''}{where and f', {where}'}"


def _is_raised_on_purpose(error: BaseException) -> bool:
    """Whether the last line is a statement that raises."""
    frames = traceback.extract_tb(error.__traceback__)
    return bool(frames) and (frames[-1].line or "").lstrip().startswith("raise ")
