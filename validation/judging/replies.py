"""What a function of others answers: finite numbers of the right shape, or what is wrong with them."""

import copy
import dis
import functools
import inspect
import math
import mmap
import os
import sys
import sysconfig
import time
import traceback
import types
import warnings
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import CodeType, TracebackType
from typing import Any, NamedTuple

import numpy as np

from validation.judging.registry import KINDS, Failed, FloatArray, Offered, OfferedError, Shape
from validation.judging.source_files import ENTRY

PLAIN = (bool, int, float, complex, str, bytes, type(None), types.FunctionType, types.BuiltinFunctionType, type)
"""Values that cannot be changed, or that a copy would share."""


def copy_of(value: Any) -> Any:
    """For one call. An array cannot be written; a generator of random numbers is itself: its state is to change."""
    if isinstance(value, (np.random.Generator, *PLAIN)):
        return value
    if isinstance(value, np.ndarray):
        array = value.copy()
        array.setflags(write=False)
        return array
    try:
        return copy.deepcopy(value)
    # an object of a program may have what cannot be copied, as an open file
    except Exception:
        return value


def as_argument(lent: Any) -> Any:
    """What the function is given: of an array a view, since a view of what cannot be written stays so."""
    return lent[...] if isinstance(lent, np.ndarray) else lent


def changed(arguments: Mapping[str, Any], lent: Mapping[str, Any]) -> str:
    """The first argument whose copy is no longer equal to it; nothing where all are."""
    return next((name for name, value in arguments.items() if not _is_equal(value, lent[name], set())), "")


def classes_of(arguments: Mapping[str, Any]) -> dict[str, dict[type, dict[str, Any]]]:
    """What the classes of the arguments hold, by the name of the argument: methods may be changed there."""
    return {
        name: {of: _public(of) for of in type(value).__mro__ if of.__module__ != "builtins"}
        for name, value in arguments.items()
        if not isinstance(value, (*PLAIN, np.ndarray, np.generic, np.random.Generator))
    }


def restored(classes: Mapping[str, Mapping[type, Mapping[str, Any]]]) -> str:
    """The first argument whose class was changed since, which is put back; nothing where none was."""
    first = ""
    for name, kinds in classes.items():
        for of, before in kinds.items():
            now = _public(of)
            if now.keys() == before.keys() and all(now[key] is before[key] for key in now):
                continue
            first = first or name
            for key in now.keys() - before.keys():
                delattr(of, key)
            for key, value in before.items():
                setattr(of, key, value)
    return first


def _public(of: type) -> dict[str, Any]:
    return {name: value for name, value in vars(of).items() if not name.startswith("__") and name != "_abc_impl"}


def _is_equal(value: Any, other: Any, seen: set[tuple[int, int]]) -> bool:
    """Equal in all that it holds; attributes that are new, as of a cache, are nobody's."""
    pair = id(value), id(other)
    if value is other or pair in seen:
        return True
    seen.add(pair)
    if type(value) is not type(other):
        return False
    if isinstance(value, np.ndarray):
        return bool(value.dtype == other.dtype and np.array_equal(value, other, equal_nan=value.dtype.kind in "fc"))
    if isinstance(value, float):
        return bool(value == other or (value != value and other != other))
    if isinstance(value, dict):
        return value.keys() == other.keys() and all(_is_equal(value[key], other[key], seen) for key in value)
    if isinstance(value, list | tuple):
        return len(value) == len(other) and all(_is_equal(*parts, seen) for parts in zip(value, other, strict=True))
    parts = _parts(value), _parts(other)
    if parts[0]:
        return all(name in parts[1] and _is_equal(part, parts[1][name], seen) for name, part in parts[0].items())
    try:
        return bool(value == other) or isinstance(value, np.random.Generator) or not _compares(value)
    except Exception:
        return True


def _parts(value: Any) -> dict[str, Any]:
    """What an object holds, by name: of a method its object, of a partial its arguments."""
    if isinstance(value, functools.partial):
        return {"func": value.func, "args": value.args, "keywords": value.keywords}
    if isinstance(value, types.MethodType):
        return {"function": value.__func__, "self": value.__self__}
    slots = (name for of in type(value).__mro__ for name in _slots(of))
    return {**getattr(value, "__dict__", {}), **{name: getattr(value, name) for name in slots if hasattr(value, name)}}


def _slots(of: type) -> tuple[str, ...]:
    names = vars(of).get("__slots__", ())
    return (names,) if isinstance(names, str) else tuple(name for name in names if not name.startswith("__"))


def _compares(value: Any) -> bool:
    """Whether its class says when two are equal: else a copy never is."""
    return vars(object)["__eq__"] is not type(value).__eq__


BUGS = (
    *(AssertionError, AttributeError, BufferError, EOFError, ImportError, LookupError, MemoryError, NameError, OSError),
    *(ReferenceError, RecursionError, StopIteration, SyntaxError, SystemError, SystemExit, TypeError, UnicodeError),
    ZeroDivisionError,
)
"""Kinds of exceptions that say that something went wrong, whoever raises them."""
RAISE = dis.opmap["RAISE_VARARGS"]
ROOT = Path(__file__).resolve().parents[2]
INSTALLED = {"site-packages", "dist-packages"}
LIBRARIES = (
    *(Path(sysconfig.get_path(name)).resolve() for name in ("stdlib", "platstdlib")),
    *(ROOT / name for name in ("mdr", "bem3d", "validation")),
)
"""Folders whose files nobody's model is in, unless its own file is there as well."""


def is_refusal(error: BaseException, function: Callable[..., Any], file: Path | None = None) -> bool:
    """Whether a `raise` in the file of the function, or below its folder, raised an exception that is no bug.

    The instruction that raised it decides, not the text of its line: `int("x")` and a wrong shape in numpy raise
    ValueError as well, and are failures. A class that is defined there is on purpose, whatever it is derived from; so
    is a warning of the file's own, where warnings are errors. Code without a file, as that of `exec`, is part of what
    called it. file: that offers the function, where it is known.
    """
    steps = list(_steps(error.__traceback__))
    homes = homes_of(function, file)
    if not steps or not is_own(_place(steps, homes), homes):
        return False
    code, instruction = steps[-1]
    has_own_class = _is_defined_in(type(error), homes)
    if isinstance(error, Warning) and (type(error) is UserWarning or has_own_class):
        return True
    is_raised = code.co_code[instruction] == RAISE or _is_thrown_into(code, instruction)
    return is_raised and (has_own_class or not isinstance(error, BUGS))


def homes_of(function: Callable[..., Any], file: Path | None = None) -> tuple[str, ...]:
    """Names of the files that a function is defined in, and offered by."""
    code = getattr(_unwrapped(function), "__code__", None)
    names = (code.co_filename if isinstance(code, CodeType) else "", str(file) if file else "")
    return tuple(dict.fromkeys(filter(None, names)))


def is_own(name: str, homes: tuple[str, ...]) -> bool:
    """Whether a file is one of these, or below the folder of one and no part of a library."""
    return name in homes or any(
        _is_below(Path(name).resolve(), Path(home).resolve()) for home in homes if _is_file(home)
    )


def _is_below(file: Path, home: Path) -> bool:
    folder = home.parent
    if at := next((i for i, part in enumerate(home.parts) if part in INSTALLED), 0):
        # of an installed package all of it, and no other one
        return file.parts[: at + 2] == home.parts[: at + 2]
    if not _is_file(str(file)) or not file.is_relative_to(folder):
        return False
    of_library = any(file.is_relative_to(other) and not folder.is_relative_to(other) for other in LIBRARIES)
    return not of_library and INSTALLED.isdisjoint(file.relative_to(folder).parts)


def _is_file(name: str) -> bool:
    try:
        return Path(name).is_file()
    except (OSError, ValueError):
        return False


def _steps(trace: TracebackType | None) -> Iterator[tuple[CodeType, int]]:
    """Code and the instruction that it had come to, from the outermost on."""
    while trace is not None:
        yield trace.tb_frame.f_code, trace.tb_lasti
        trace = trace.tb_next


def _place(steps: list[tuple[CodeType, int]], homes: tuple[str, ...]) -> str:
    """The file of the last step that has one."""
    names = [code.co_filename for code, _ in steps]
    return next((name for name in reversed(names) if name in homes or _is_file(name) or name.startswith("<frozen")), "")


def _is_thrown_into(code: CodeType, instruction: int) -> bool:
    """Whether an exception was thrown into a generator that had not begun, as lambdas raise."""
    return bool(code.co_flags & inspect.CO_GENERATOR) and dis.opname[code.co_code[instruction]] in (
        *("RETURN_GENERATOR", "POP_TOP", "RESUME", "YIELD_VALUE"),
    )


def _is_defined_in(of: type, homes: tuple[str, ...]) -> bool:
    if of.__module__ == "builtins":
        return False
    module = sys.modules.get(of.__module__)
    name = getattr(module, "__file__", None)
    return is_own(name, homes) if isinstance(name, str) else of.__module__ in ("__main__", "_judged")


def _unwrapped(function: Any) -> Any:
    """The function inside of decorators, partial ones and those of numpy."""
    while True:
        inner = function.func if isinstance(function, functools.partial) else getattr(function, "pyfunc", None)
        inner = inner if inner is not None else getattr(function, "__wrapped__", None)
        if inner is None:
            return function if hasattr(function, "__code__") else vars(type(function)).get("__call__", function)
        function = inner


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


def called(offered: Offered[..., Any], arguments: Mapping[str, Any], file: Path | None = None) -> Reply:
    """What a function says to these arguments. file: that offers it, where it is known.

    A process that the function forks, and that comes back from it, is ended: it must answer nobody.
    """
    process = os.getpid()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        begin = time.perf_counter()
        try:
            value = _validated_value(offered, arguments, file)
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


def _validated_value(
    offered: Offered[..., Any], arguments: Mapping[str, Any], file: Path | None
) -> FloatArray | Failed:
    """The value, finite and of the right shape, or what is wrong. Arguments are copies, compared afterwards."""
    passed = {name: arguments[name] for name in offered.asks if name in arguments}
    lent, classes = {name: copy_of(value) for name, value in passed.items()}, classes_of(passed)
    try:
        with np.errstate(all="ignore"):
            value = offered.function(**{name: as_argument(part) for name, part in lent.items()})
    except (Exception, SystemExit) as error:
        is_refused = is_refusal(error, offered.function, file)
        return Failed(f"raised {raised(error, homes=homes_of(offered.function, file))}", refused=is_refused)
    finally:
        class_changed = restored(classes)
    if name := changed(passed, lent) or class_changed:
        return Failed(f"changed {name}, which is not its own")
    return number(value, KINDS[offered.kind].shapes(passed))


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
            expected = " or ".join(str(shape) if shape else "one number" for shape in shapes)
            return Failed(f"returned shape {array.shape}, must be {expected}")
        numbers = array.astype(np.float64)
    except (TypeError, ValueError):
        return Failed("returned rows of different lengths")
    # an object may do anything when it is asked for its numbers
    except Exception as error:
        return Failed(f"returned {type(value).__name__}, whose numbers cannot be read: {raised(error)}")
    if broken := int(np.count_nonzero(~np.isfinite(numbers))):
        return Failed("returned NaN or infinity" + (f", {broken} of {numbers.size} values" if numbers.ndim else ""))
    return numbers


def on_one_line(text: object) -> str:
    """The first of it; nothing of what cannot say it."""
    try:
        words = " ".join(str(text).split())
    # an exception of somebody else's has a text of somebody else's
    except Exception:
        return ""
    return words if len(words) <= SHOWN else f"{words[:SHOWN]}..."


def raised(error: BaseException, path: Path | None = None, homes: tuple[str, ...] = ()) -> str:
    """Its name, its words, and the last line of the file, or of any, that it went through.

    Of a decorator the line comes first, before names that are listed. homes: files of a function, whose last line is
    taken rather than one of a library.
    """
    message = on_one_line(error)
    lines = [(Path(frame.filename), frame.lineno) for frame in traceback.extract_tb(error.__traceback__)]
    own = [(file, line) for file, line in lines if file.parent not in NOT_THEIRS and not file.name.startswith(ENTRY)]
    if path and not path.name.startswith(ENTRY):
        own = [(file, line) for file, line in own if file.is_relative_to(path.parent)]
    own = [(file, line) for file, line in own if is_own(str(file), homes)] or own
    where = f"line {own[-1][1]} of {own[-1][0].name}" if own else ""
    if isinstance(error, OfferedError):
        return f"{where}: {message}" if where else message
    return f"{type(error).__name__}{f': {message}' if message else ''}{where and f', {where}'}"
