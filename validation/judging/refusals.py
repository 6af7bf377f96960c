"""Whether an exception is a refusal, which the author of a function has written, or a failure."""

import dis
import functools
import inspect
import sys
import sysconfig
from collections.abc import Callable, Iterator
from pathlib import Path
from types import CodeType, TracebackType
from typing import Any

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
