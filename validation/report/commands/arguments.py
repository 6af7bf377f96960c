"""What several commands have: arguments, and how they ended."""

import argparse
import errno
import os
import stat
from collections.abc import Callable, Collection, Mapping
from enum import IntEnum
from pathlib import Path
from tempfile import TemporaryFile


class Exit(IntEnum):
    """Exit status of the command."""

    MET = 0
    CRITERION_FAILED = 1
    BAD_INPUT = 2
    NOT_CONVERGED = 3
    UNFINISHED = 4
    FAULT = 70
    INTERRUPTED = 130
    TERMINATED = 143


LEAST_MOST, TO_A_CORE = 16, 4
"""Processes that may be asked for: so many in all, or to a core. Each takes some 200 MB, and more are not faster."""


def add_profile(command: argparse.ArgumentParser) -> None:
    sizes = ("quick", "full")
    command.add_argument("--profile", choices=sizes, default="quick", help="size of the problems (default: quick)")


def add_workers(command: argparse.ArgumentParser, what: str = "number of processes") -> None:
    help_text = f"{what} (default: one per core)"
    cores = os.cpu_count() or 1
    number = at_least(1, max(LEAST_MOST, TO_A_CORE * cores))
    command.add_argument("--workers", type=number, default=cores, metavar="N", help=help_text)


def add_options(command: argparse.ArgumentParser, *options: tuple[str, str, Callable[[str], object], str]) -> None:
    """Each with the name of its value, what reads that, and what it is for; without a default."""
    for name, value, reads, what in options:
        command.add_argument(name, metavar=value, type=reads, help=what)


def not_beside(arguments: argparse.Namespace, other: str, *options: str) -> None:
    """Raises ValueError for an option that was given beside another, or in a case, that has no use for it."""
    if idle := [name for name in options if name in getattr(arguments, "given", ())]:
        raise ValueError(f"{' and '.join(idle)} must be left out {other}, where nothing goes by it")


def at_least(least: int, most: int | None = None) -> Callable[[str], int]:
    """Whole numbers from a least one on, up to a largest one."""

    def number(word: str) -> int:
        try:
            value = int(word)
        except ValueError:
            raise argparse.ArgumentTypeError(f"must be a whole number, got {word!r}") from None
        if value < least:
            raise argparse.ArgumentTypeError(f"must be at least {least}, got {value}")
        if most is not None and value > most:
            raise argparse.ArgumentTypeError(f"must be at most {most}, got {value}")
        return value

    return number


def comma_separated(valid: Collection[str]) -> Callable[[str], tuple[str, ...]]:
    """Names with commas between them, each once."""

    def names(word: str) -> tuple[str, ...]:
        chosen = tuple(dict.fromkeys(name.strip() for name in word.split(",")))
        if unknown := [name for name in chosen if name not in valid]:
            raise argparse.ArgumentTypeError(f"must be of {', '.join(valid)}, got {', '.join(map(repr, unknown))}")
        return chosen

    return names


FOLDERS, FILES = ("out", "report", "store"), ("json", "csv", "cnossos", "figure")
"""Options that name a place."""
FIGURES = (".svg", ".png", ".pdf")


def check_places(arguments: argparse.Namespace, read: Mapping[Path, str]) -> None:
    """Raises ValueError where a result would replace what is read, or another result, or where it cannot be written.

    read: files, each with what it is to the command.
    """
    folders = {Path(path): f"is --{name}" for name in FOLDERS if (path := getattr(arguments, name, None)) is not None}
    for folder, which in folders.items():
        if reason := _refusal(folder):
            raise ValueError(f"{which[3:]} must be a folder that can be written, got {folder}: {reason}")
    taken = {os.path.realpath(file): which for file, which in read.items()}
    for name in FILES:
        path = getattr(arguments, name, None)
        if path is None:
            continue
        if name == "figure" and path.suffix not in FIGURES:
            raise ValueError(f"--figure must end in {', '.join(FIGURES)}, got {path}")
        if path.parent == Path("/dev"):
            continue
        of = (folder for folder in ("out", "report") if _is_in(path, getattr(arguments, folder, None)))
        inside = next((f"is in the folder of --{folder}" for folder in of), "")
        is_folder = "is a folder" if stat.S_ISDIR(_mode(path)) else ""
        if by := folders.get(path) or taken.get(os.path.realpath(path)) or is_folder or inside:
            raise ValueError(f"--{name} must be a file of its own, got {path}, which {by}")
        if reason := _refusal_of_file(path):
            raise ValueError(f"--{name} must be a file in a folder that can be written, got {path}: {reason}")
        taken[os.path.realpath(path)] = f"--{name} writes"


def _refusal_of_file(path: Path) -> str:
    """Why it cannot be written; nothing where it can, and of a pipe, into which is written as it stands."""
    mode = _mode(path)
    if mode and not stat.S_ISREG(mode):
        return ""
    if mode and not os.access(path, os.W_OK):
        return os.strerror(errno.EACCES)
    return _refusal(path.parent) or _too_long(path)


def _mode(path: Path) -> int:
    """Zero where nothing is there."""
    try:
        return path.stat().st_mode
    except OSError:
        return 0


def _is_in(path: Path, folder: Path | None) -> bool:
    """Whether a file would lie in a folder that is replaced whole."""
    return folder is not None and Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def _refusal(folder: Path) -> str:
    """Why it can be neither made nor written into; nothing where it can."""
    near = _nearest(folder)
    if not near.is_dir():
        return os.strerror(errno.ENOTDIR)
    if not os.access(near, os.W_OK | os.X_OK):
        return os.strerror(errno.EACCES)
    try:
        # rights alone do not say so: a file system may be read-only, or none of files
        TemporaryFile(dir=near).close()
    except OSError as error:
        return error.strerror or str(error)
    return _too_long(folder)


def _nearest(path: Path) -> Path:
    """It, or the folder nearest to it that is there."""
    return next(place for place in (path, *path.parents) if os.path.lexists(place))


def _too_long(path: Path) -> str:
    """Whether a part of it that is not there yet is longer than a name may be."""
    near = _nearest(path)
    if near == path:  # also a link that leads to nothing
        return ""
    most = os.pathconf(near, "PC_NAME_MAX")
    is_long = any(len(os.fsencode(part)) > most for part in path.relative_to(near).parts)
    return os.strerror(errno.ENAMETOOLONG) if is_long else ""
