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


@contextmanager
def file_of(model: str | Path) -> Iterator[Path]:
    """The file itself; of a name that an installed package offers, and no file has, a file that imports its models."""
    if Path(model).is_file() or str(model) not in installed():
        yield Path(model)
        return
    one = installed()[str(model)]
    with TemporaryDirectory() as folder:
        path = Path(folder, f"{ENTRY}{one.name!r} ({one.value})".replace("/", " "))
        path.write_text(f"from {one.module} import {one.attr or '*'}\n", encoding="utf-8")
        yield path
