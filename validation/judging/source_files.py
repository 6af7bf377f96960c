"""What the file of somebody else rests on: its bytes, and those of the modules and data that it has from its folder."""

import hashlib
import os
import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

GROUP = "mdr_validation.models"
ENTRY = "entry point "
"""How the name of a file begins that imports what an installed package offers: no module is called so."""


def installed() -> dict[str, EntryPoint]:
    """By their names. Nothing is imported."""
    return {entry.name: entry for entry in sorted(entry_points(group=GROUP), key=lambda entry: entry.name)}


def is_installed(model: str | Path) -> bool:
    """Whether it is the name of what an installed package offers, and no file has that name."""
    return not Path(model).is_file() and str(model) in installed()


def package_of(path: Path) -> str:
    """The module that a file of `file_of` imports; empty of any other file."""
    return path.read_text(encoding="utf-8").split()[1] if path.name.startswith(ENTRY) else ""


@contextmanager
def file_of(model: str | Path) -> Iterator[Path]:
    """The file itself; of a name that an installed package offers, and no file has, a file that imports its models."""
    if not is_installed(model):
        yield Path(model)
        return
    entry = installed()[str(model)]
    with TemporaryDirectory() as folder:
        path = Path(folder, f"{ENTRY}{entry.name!r} ({entry.value})".replace("/", " "))
        path.write_text(f"from {entry.module} import {entry.attr or '*'}\n", encoding="utf-8")
        yield path


OPENED: set[Path] = set()
"""What this process has opened for reading since it is watched."""
BEGUN = [time.time()]
"""What was written since is by the file itself, or by what it has started; a date in the future is that of data."""


def watch_opened(begun: float) -> None:
    """From now on, and until this process ends: libraries loaded by ctypes too, but nothing that C opens by itself.

    begun: when the first process of this file began: what that has written is by the file itself, too.
    """
    BEGUN[0] = begun
    sys.addaudithook(_opened)


def _opened(event: str, arguments: tuple[Any, ...]) -> None:
    reads = event == "open" and not arguments[2] & (os.O_WRONLY | os.O_TRUNC)
    if (reads or event == "ctypes.dlopen") and isinstance(arguments[0], str | bytes | os.PathLike):
        OPENED.add(Path(os.fsdecode(arguments[0])).absolute())  # the working folder may be another later


def sources_of(path: Path) -> tuple[Path, ...]:
    """The file, the modules loaded from its folder and the data read there, but for installed packages.

    Of a file that imports what an installed package offers, the modules and the data of that package.
    """
    modules = map(_file_of, list(sys.modules.values()))
    loaded = {Path(file) for file in modules if isinstance(file, str)}
    data = (file for file in list(OPENED) if file.is_file() and not BEGUN[0] <= file.stat().st_mtime <= time.time())
    folders = path.parent, path.parent.resolve()
    near = (file for file in (*loaded, *data) if any(file.is_relative_to(folder) for folder in folders))
    without = {"site-packages", "__pycache__"}
    own = {path.resolve(), *(file.resolve() for file in near if without.isdisjoint(file.parts))}
    roots = _roots_of(package_of(path))
    own |= {file.resolve() for file in (*loaded, *data) if any(file.is_relative_to(root) for root in roots)}
    return in_order(file for file in own if file.suffix != ".pyc")


def _roots_of(package: str) -> tuple[Path, ...]:
    """Folders of a package that is loaded, or the file of a module; none of one that is not."""
    module = sys.modules.get(package.partition(".")[0])
    file = getattr(module, "__file__", None)
    folders = getattr(module, "__path__", None) or ([file] if file else [])
    return tuple(Path(folder) for folder in folders)


def _file_of(module: object) -> object:
    """What stands among the modules may be no module, and do anything when it is asked."""
    try:
        return vars(module).get("__file__")
    except Exception:
        return None


def digest_of_bytes(path: Path) -> bytes:
    """Of a file; one that is gone, or that cannot be read any more, has none."""
    try:
        return hashlib.sha256(path.read_bytes() if path.is_file() else b"").digest()
    except OSError:
        return hashlib.sha256().digest()


def digest_of_all(digests: Iterable[bytes]) -> str:
    """Of several files, in their order."""
    return hashlib.sha256(b"".join(digests)).hexdigest()


def digest_of(sources: Iterable[Path]) -> str:
    """Of the bytes of these files; one that is gone has none."""
    return digest_of_all(map(digest_of_bytes, in_order(sources)))


def in_order(sources: Iterable[Path]) -> tuple[Path, ...]:
    """By their names; a file of `file_of`, whose folder is new each time, comes first."""
    return tuple(sorted(sources, key=lambda path: (not path.name.startswith(ENTRY), path)))
