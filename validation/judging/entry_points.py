"""Models that installed packages offer under names of their own, by entry points; each is imported only when named."""

from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from tempfile import TemporaryDirectory

GROUP = "mdr_validation.models"
ENTRY = "entry point "
"""How the name of a file begins that imports what an installed package offers: no module is called so."""


def installed() -> dict[str, EntryPoint]:
    """By their names. Nothing is imported."""
    return {one.name: one for one in sorted(entry_points(group=GROUP), key=lambda one: one.name)}


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
    one = installed()[str(model)]
    with TemporaryDirectory() as folder:
        path = Path(folder, f"{ENTRY}{one.name!r} ({one.value})".replace("/", " "))
        path.write_text(f"from {one.module} import {one.attr or '*'}\n", encoding="utf-8")
        yield path
