"""What a function of others answers: finite numbers of the right shape, or what is wrong with them."""

import math
import mmap
import os
import time
import traceback
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from validation.judging.arguments import as_argument, changed, classes_of, copy_of, restored
from validation.judging.entry_points import ENTRY
from validation.judging.refusals import homes_of, is_own, is_refusal
from validation.judging.registry import KINDS, Failed, FloatArray, Offered, OfferedError, Shape

SHOWN = 160
"""Characters of what was printed or raised."""
NOT_THEIRS = (Path(__file__).parent, Path())
"""Folders of files of ours, and of what is no file, as <frozen importlib>."""
FORKED = mmap.mmap(-1, 1)
"""Of this process and all that it forks: not zero where one of those came back from a function."""


class Reply(NamedTuple):
    """value: or what is wrong; warned: the first warning; seconds: that the function took."""

    value: FloatArray | Failed
    warned: str = ""
    seconds: float = math.nan


def called(offered: Offered, arguments: Mapping[str, Any], file: Path | None = None) -> Reply:
    """What a function says to these arguments. file: that offers it, where it is known.

    A process that the function forks, and that comes back from it, is ended: it must answer nobody.
    """
    process = os.getpid()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        begin = time.perf_counter()
        try:
            value = _value(offered, arguments, file)
        finally:
            if os.getpid() != process:
                FORKED[0] = 1
                os._exit(0)
        seconds = time.perf_counter() - begin
    return Reply(value, on_one_line(caught[0].message) if caught else "", seconds)


def has_forked() -> bool:
    """Whether a process that a function forked came back from it, since this was asked last."""
    before, FORKED[0] = FORKED[0], 0
    return before != 0


def _value(offered: Offered, arguments: Mapping[str, Any], file: Path | None) -> FloatArray | Failed:
    """The value, finite and of the right shape, or what is wrong. Arguments are copies, compared afterwards."""
    given = {name: arguments[name] for name in offered.asks if name in arguments}
    lent, classes = {name: copy_of(value) for name, value in given.items()}, classes_of(given)
    try:
        with np.errstate(all="ignore"):
            value = offered.function(**{name: as_argument(part) for name, part in lent.items()})
    except (Exception, SystemExit) as error:
        is_refused = is_refusal(error, offered.function, file)
        return Failed(f"raised {raised(error, homes=homes_of(offered.function, file))}", refused=is_refused)
    finally:
        class_changed = restored(classes)
    if name := changed(given, lent) or class_changed:
        return Failed(f"changed {name}, which is not its own")
    return number(value, KINDS[offered.kind].shapes(given))


def number(value: Any, shapes: tuple[Shape, ...]) -> FloatArray | Failed:
    """Real numbers of one of these shapes, or what is wrong with the value."""
    if value is None:
        return Failed("returned nothing")
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiu" or np.ma.is_masked(value):
            what = (
                "complex numbers" if array.dtype.kind == "c" else "masked values" if array.dtype.kind in "fiu" else ""
            )
            return Failed(f"returned {what or type(value).__name__}, must be real numbers")
        if array.shape not in shapes:
            wanted = " or ".join(str(shape) if shape else "one number" for shape in shapes)
            return Failed(f"returned shape {array.shape}, must be {wanted}")
        numbers = array.astype(np.float64)
    except (TypeError, ValueError):
        return Failed("returned rows of different lengths")
    # an object may do anything when it is asked for its numbers
    except Exception as error:
        return Failed(f"returned {type(value).__name__}, whose numbers cannot be read: {raised(error)}")
    if broken := int(np.count_nonzero(~np.isfinite(numbers))):
        return Failed("returned NaN or infinity" + (f", {broken} of {numbers.size} values" if numbers.ndim else ""))
    return numbers


def on_one_line(said: object) -> str:
    """The first of it; nothing of what cannot say it."""
    try:
        words = " ".join(str(said).split())
    # an exception of somebody else's has a text of somebody else's
    except Exception:
        return ""
    return words if len(words) <= SHOWN else f"{words[:SHOWN]}..."


def raised(error: BaseException, path: Path | None = None, homes: tuple[str, ...] = ()) -> str:
    """Its name, its words, and the last line of the file, or of any, that it went through.

    Of a decorator the line comes first, before names that are listed. homes: files of a function, whose last line is
    taken rather than one of a library.
    """
    said = on_one_line(error)
    lines = [(Path(frame.filename), frame.lineno) for frame in traceback.extract_tb(error.__traceback__)]
    mine = [(file, line) for file, line in lines if file.parent not in NOT_THEIRS and not file.name.startswith(ENTRY)]
    if path and not path.name.startswith(ENTRY):
        mine = [(file, line) for file, line in mine if file.is_relative_to(path.parent)]
    mine = [(file, line) for file, line in mine if is_own(str(file), homes)] or mine
    where = f"line {mine[-1][1]} of {mine[-1][0].name}" if mine else ""
    if isinstance(error, OfferedError):
        return f"{where}: {said}" if where else said
    return f"{type(error).__name__}{f': {said}' if said else ''}{where and f', {where}'}"
