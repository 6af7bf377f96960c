"""Files of measured heights: an array of numpy or a table of text, with the keys of a scene that say how to read it."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from mdr.checks import count
from validation.scenes.height_arrays import KeyOfArchiveError, array_of, array_of_archive, is_archive
from validation.scenes.height_tables import table_of_numbers
from validation.scenes.input_files import check_regular
from validation.scenes.measured import MeasuredHeights
from validation.scenes.measured_surface import as_asked, metres_of
from validation.scenes.printable import printable, shortened
from validation.scenes.reader import LENGTH, Reader, nonblank_text, table, without_unit

FloatArray = NDArray[np.float64]

MOST_BYTES, MOST_VALUES = 2**28, 2**24
"""Of a file; 4096 x 4096 heights of sixteen characters."""
ARRAYS = (".npy", ".npz")
"""How the names of numpy's files end."""


@dataclass(frozen=True, kw_only=True)
class HeightFileForm:
    """What a scene says about a file beside its name: the lines above the numbers, the array of an archive."""

    name: str
    skip: int | None = None
    key: str | None = None

    def check(self, path: Path) -> None:
        """Raises ValueError for a key that the kind of file has no use for."""
        is_array = path.suffix.lower() in ARRAYS
        if self.skip is not None and is_array:
            raise ValueError(f"{self.name}.skip must be left out of a file of numpy, got {printable(path.name)}")
        if self.key is not None and not is_array:
            raise ValueError(f"{self.name}.key must be left out but for an .npz, got {printable(path.name)}")


def heights_of(name: str, given: object, *, folder: Path) -> MeasuredHeights:
    """Of a table in a scene file: the file beside it, how to read it, spacing and unit, and what to do to the heights.

    Heights that are already there are those.
    """
    if isinstance(given, MeasuredHeights):
        return given
    readers: dict[str, Reader] = {
        "file": nonblank_text,
        "spacing": _spacing,
        "unit": unit_of,
        "skip": partial(without_unit, partial(count, least=0)),
        "key": nonblank_text,
        "crop": _yes_or_no,
        "fill": _yes_or_no,
    }
    found = table(readers, ("unit", "skip", "key", "crop", "fill"), name, given)
    form = HeightFileForm(name=name, skip=found.get("skip"), key=found.get("key"))
    height = read_heights(f"{name}.file", folder / found["file"], form) * found.get("unit", 1.0)
    wishes = {key: found.get(key, False) for key in ("crop", "fill")}
    try:
        return as_asked(height, found["spacing"], **wishes, asked_by="fill = true")
    except ValueError as problem:
        raise ValueError(f"{name}: {problem}") from None


def read_heights(name: str, path: Path, form: HeightFileForm | None = None) -> FloatArray:
    """Rows are lines across the track, x along the first axis. NaN stays.

    form: what the scene says about the file; None where it can say nothing. Raises OSError for a file that cannot be
    read, ValueError for one that is no table of real numbers, no regular file, or larger than `MOST_BYTES` or
    `MOST_VALUES`.
    """
    size = check_regular(name, path, most=MOST_BYTES)
    if form:
        form.check(path)
    try:
        with path.open("rb") as file:
            values = _values(file, path, size, form)
    except OSError as problem:
        raise OSError(f"{name} {printable(path)} cannot be read: {problem.strerror or problem}") from None
    except KeyOfArchiveError as problem:
        raise ValueError(f"{form.name if form else name}.key {problem}, of {printable(path)}") from None
    except ValueError as problem:
        raise ValueError(f"{name} {printable(path)} must hold a table of numbers, got: {printable(problem)}") from None
    if values.size > MOST_VALUES:
        raise ValueError(f"{name} {printable(path)} must hold at most {MOST_VALUES} heights, got {values.size}")
    if values.dtype.kind not in "fiu":
        raise ValueError(f"{name} {printable(path)} must hold real numbers, got {values.dtype}")
    return np.asarray(values, dtype=np.float64)


def _values(file: IO[bytes], path: Path, size: int, form: HeightFileForm | None) -> NDArray[np.generic]:
    if path.suffix.lower() not in ARRAYS:
        return table_of_numbers(file, skip=None if form is None else form.skip or 0)
    if not is_archive(file):
        if form and form.key is not None:
            raise ValueError(f"one array without a name, for which {form.name}.key has no use")
        return array_of(file, size)
    if form is None:
        raise ValueError("an archive, .npz; one array of it can be saved by numpy.save")
    return array_of_archive(file, form.key, most=MOST_BYTES)


def unit_of(name: str, given: object) -> float:
    """How many metres one of a unit of heights is."""
    try:
        return metres_of(name, given)
    except ValueError as problem:
        raise ValueError(f'{problem}, as: unit = "um"') from None


def _spacing(name: str, given: object) -> tuple[float, float]:
    """One distance of points for both axes, or two."""
    if not isinstance(given, list):
        both: float = LENGTH(name, given)
        return both, both
    if len(given) != 2:
        raise ValueError(f'{name} must be a length or two, as ["1 um", "2 um"] along x and y, got {shortened(given)}')
    return LENGTH(f"{name}[0]", given[0]), LENGTH(f"{name}[1]", given[1])


def _yes_or_no(name: str, given: object) -> bool:
    if not isinstance(given, bool):
        raise ValueError(f"{name} must be true or false, got {shortened(given)}, as: {name.rpartition('.')[2]} = true")
    return given
