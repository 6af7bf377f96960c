"""Models that installed packages offer under names of their own, by entry points; each is imported only when named."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from tempfile import TemporaryDirectory

GROUP = "mdr_validation.models"


def installed() -> dict[str, EntryPoint]:
    """By their names. Nothing is imported."""
    return {one.name: one for one in sorted(entry_points(group=GROUP), key=lambda one: one.name)}


@contextmanager
def file_of(model: str | Path) -> Iterator[Path]:
    """The file itself; of a name that an installed package offers, and no file has, a file that imports its models."""
    if Path(model).exists() or str(model) not in installed():
        yield Path(model)
        return
    one = installed()[str(model)]
    with TemporaryDirectory() as folder:
        # a name with a space is that of no package, so the file stands before none
        path = Path(folder, f"model {re.sub(r'[^A-Za-z0-9]+', ' ', one.name)}.py")
        path.write_text(f"from {one.module} import {one.attr or '*'}\n", encoding="utf-8")
        yield path
