"""What the file of somebody else rests on: its bytes, and those of the modules and data that it has from its folder."""

import hashlib
import os
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from validation.engine.installed import ENTRY, package_of

OPENED: set[Path] = set()
"""What this process has opened for reading since it is watched."""
BEGUN = time.time()
"""What was written since is by the file itself, or by what it has started; a date in the future is that of data."""


def watch_opened() -> None:
    """From now on, and until this process ends: libraries loaded by ctypes too, but nothing that C opens by itself."""
    sys.addaudithook(_opened)


def _opened(event: str, arguments: tuple[Any, ...]) -> None:
    reads = event == "open" and not arguments[2] & (os.O_WRONLY | os.O_TRUNC)
    if (reads or event == "ctypes.dlopen") and isinstance(arguments[0], str | bytes | os.PathLike):
        OPENED.add(Path(os.fsdecode(arguments[0])).absolute())  # the working folder may be another later


def sources_of(path: Path) -> tuple[Path, ...]:
    """The file, the modules loaded from its folder and the data read there, but for installed packages.

    Of a file that imports what an installed package offers, the modules and the data of that package.
    """
    modules = (getattr(one, "__file__", None) for one in list(sys.modules.values()))
    loaded = {Path(file) for file in modules if isinstance(file, str)}
    data = (one for one in list(OPENED) if one.is_file() and not BEGUN <= one.stat().st_mtime <= time.time())
    folders = path.parent, path.parent.resolve()
    near = (file for file in (*loaded, *data) if any(file.is_relative_to(folder) for folder in folders))
    without = {"site-packages", "__pycache__"}
    own = {path.resolve(), *(file.resolve() for file in near if without.isdisjoint(file.parts))}
    roots = _roots_of(package_of(path))
    own |= {file.resolve() for file in (*loaded, *data) if any(file.is_relative_to(root) for root in roots)}
    return tuple(sorted(file for file in own if file.suffix != ".pyc"))


def _roots_of(package: str) -> tuple[Path, ...]:
    """Folders of a package that is loaded, or the file of a module; none of one that is not."""
    module = sys.modules.get(package.partition(".")[0])
    file = getattr(module, "__file__", None)
    folders = getattr(module, "__path__", None) or ([file] if file else [])
    return tuple(Path(folder) for folder in folders)


def digest_of(sources: Iterable[Path]) -> str:
    """Of the bytes of these files; one that is gone has none. A file of `file_of`, whose folder is new, comes first."""
    ordered = sorted(sources, key=lambda path: (not path.name.startswith(ENTRY), path))
    contents = (path.read_bytes() if path.is_file() else b"" for path in ordered)
    return hashlib.sha256(b"".join(hashlib.sha256(some).digest() for some in contents)).hexdigest()
