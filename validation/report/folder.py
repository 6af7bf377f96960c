"""The report folder, and how values are written in it."""

import csv
import io
import json
import math
import tempfile
from pathlib import Path

from validation.evidence import Table
from validation.files import write_whole

REALISATIONS = "realisations"
RESULTS = "results.json"


class Folder:
    """A folder that holds a report, or nothing yet.

    Made if need be. Raises ValueError for a path that is a file, a folder with something else in it, or one that
    cannot be written.
    """

    def __init__(self, path: Path):
        if path.exists() and not path.is_dir():
            raise ValueError(f"--out must be a folder, got the file {path}")
        if path.exists() and any(path.iterdir()) and not ((path / RESULTS).exists() or (path / REALISATIONS).exists()):
            raise ValueError(f"--out must be a new or empty folder or an earlier report, got {path} with other files")
        try:
            path.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryFile(dir=path):
                pass
        except OSError as error:
            raise ValueError(f"--out must be a folder that can be written, got {path}: {error.strerror}") from None
        self.path = path
        self._written: set[Path] = set()

    def write(self, name: str, contents: bytes) -> None:
        """A file of the report, whole or not at all."""
        write_whole(self.path / name, contents)
        self._written.add(self.path / name)

    def clear_old(self) -> None:
        """Remove figures and data that an earlier report left, and what a killed run had begun to write."""
        for room in ("figures", "data"):
            for file in (self.path / room).glob("*.*"):
                if file not in self._written:
                    file.unlink()
        for begun in self.path.rglob("*.part"):
            begun.unlink(missing_ok=True)


def as_json(value: object) -> bytes:
    """Readable, sorted, strict: no NaN, no infinity."""
    return (json.dumps(value, indent=1, sort_keys=True, allow_nan=False, ensure_ascii=False) + "\n").encode()


def as_csv(table: Table) -> bytes:
    """Numbers to ten digits, more than any curve shows; what is not finite is left empty."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(table.columns)
    for row in zip(*table.columns.values(), strict=True):
        writer.writerow(_cell(value) for value in row)
    return text.getvalue().encode()


def _cell(value: object) -> object:
    if not isinstance(value, float):
        return value
    return f"{value:.10g}" if math.isfinite(value) else ""
