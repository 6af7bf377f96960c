"""Where a command may write: checked before anything is computed."""

import argparse
import errno
import os
from collections.abc import Mapping
from pathlib import Path

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
        inside = "is in the folder of --report" if _is_in(path, getattr(arguments, "report", None)) else ""
        is_folder = "is a folder" if path.is_dir() else ""
        if by := folders.get(path) or taken.get(os.path.realpath(path)) or is_folder or inside:
            raise ValueError(f"--{name} must be a file of its own, got {path}, which {by}")
        # into a pipe it is written as it stands
        if (path.is_file() or not path.exists()) and (reason := _refusal(path.parent)):
            raise ValueError(f"--{name} must be a file in a folder that can be written, got {path}: {reason}")
        taken[os.path.realpath(path)] = f"--{name} writes"


def _is_in(path: Path, folder: Path | None) -> bool:
    """Whether a file would lie in a folder that is replaced whole."""
    return folder is not None and Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def _refusal(folder: Path) -> str:
    """Why it can be neither made nor written into; nothing where it can."""
    near = next(place for place in (folder, *folder.parents) if os.path.lexists(place))
    if not near.is_dir():
        return os.strerror(errno.ENOTDIR)
    return "" if os.access(near, os.W_OK | os.X_OK) else os.strerror(errno.EACCES)
