"""Files of measured heights: .npy or CSV, nothing allocated before it is known to be there."""

from codecs import BOM_UTF8
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from tokenize import TokenError
from typing import IO

import numpy as np
from numpy.typing import NDArray

from validation.scenes.input_files import check_regular
from validation.scenes.measured import FEWEST, MeasuredHeights
from validation.scenes.printable import printable, shortened
from validation.scenes.reader import LENGTH, Reader, nonblank_text, table
from validation.scenes.units import quantity

FloatArray = NDArray[np.float64]

MOST_BYTES, MOST_VALUES = 2**28, 2**24
"""Of a file; 4096 x 4096 heights of sixteen characters."""
MOST_LINES, LONGEST_LINE = MOST_VALUES // FEWEST, 32 * MOST_VALUES // FEWEST
"""Of a CSV of so many values; characters of a line."""
ARCHIVE = b"PK"
"""How an .npz begins."""


def heights_of(name: str, given: object, *, folder: Path) -> MeasuredHeights:
    """Of a table in a scene file: file, .npy or CSV beside it; spacing of its points; unit of its values."""
    readers: dict[str, Reader] = {"file": nonblank_text, "spacing": LENGTH, "unit": unit_of}
    found = table(readers, ("unit",), name, given)
    height = read_heights(f"{name}.file", folder / found["file"]) * found.get("unit", 1.0)
    try:
        return MeasuredHeights(height=height, spacing=(found["spacing"], found["spacing"]))
    except ValueError as problem:
        raise ValueError(f"{name}: {problem}") from None


def read_heights(name: str, path: Path) -> FloatArray:
    """Rows are lines across the track, x along the first axis.

    Raises OSError for a file that cannot be read, ValueError for one that is no table of real numbers, no regular file,
    or larger than `MOST_BYTES` or `MOST_VALUES`.
    """
    size = check_regular(name, path, most=MOST_BYTES)
    binary = path.suffix.lower() in (".npy", ".npz")
    try:
        with path.open("rb") as file:
            values = _of_array(file, size) if binary else _of_text(file)
    except OSError as problem:
        raise OSError(f"{name} {printable(path)} cannot be read: {problem.strerror or problem}") from None
    except ValueError as problem:
        raise ValueError(f"{name} {printable(path)} must hold a table of numbers, got: {printable(problem)}") from None
    if values.size > MOST_VALUES:
        raise ValueError(f"{name} {printable(path)} must hold at most {MOST_VALUES} heights, got {values.size}")
    if values.dtype.kind not in "fiu":
        raise ValueError(f"{name} {printable(path)} must hold real numbers, got {values.dtype}")
    return np.asarray(values, dtype=np.float64)


def _of_array(file: IO[bytes], size: int) -> NDArray[np.generic]:
    """Of an .npy, once its header is known to promise no more than the file holds."""
    if not size:
        raise ValueError("an empty file")
    if file.read(len(ARCHIVE)) == ARCHIVE:
        raise ValueError("an archive, .npz; one array of it can be saved by numpy.save")
    file.seek(0)
    shape, dtype = _header(file)
    if dtype.hasobject:
        raise ValueError("objects in place of numbers")
    count = 1
    for side in shape:
        count *= side
    if min(shape, default=0) < 0 or count * dtype.itemsize > size - file.tell():
        raise ValueError(
            f"a header of {shortened(shape)} values of {dtype.itemsize} bytes, and {size - file.tell()} bytes"
        )
    file.seek(0)
    return np.asarray(np.lib.format.read_array(file, allow_pickle=False))


def _header(file: IO[bytes]) -> tuple[tuple[int, ...], np.dtype[np.generic]]:
    """Shape and type of an .npy."""
    version = np.lib.format.read_magic(file)
    if version not in ((1, 0), (2, 0), (3, 0)):
        raise ValueError(f"an .npy of the unknown version {version}")
    # that of version 3 differs in names alone
    header = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
    try:
        shape, _, dtype = header(file)
    except (ValueError, TypeError, SyntaxError, TokenError, RecursionError, MemoryError) as problem:
        # whatever a parser of Python meets in a text that is none
        why = "".join(f", {line}" for line in str(problem).splitlines()[:1])
        raise ValueError(f"a header that cannot be read{why}") from None
    return shape, dtype


def _of_text(file: IO[bytes]) -> NDArray[np.generic]:
    """Of a CSV, its delimiter that of its first row."""
    lines = (line.removeprefix(BOM_UTF8) for line in _lines(file))
    first = next((line for line in lines if line.strip() and not line.startswith(b"#")), b"")
    if not first:
        raise ValueError("an empty file")
    for _ in lines:
        pass
    file.seek(0)
    delimiter = next((sign for sign in (";", ",", "\t") if sign.encode() in first), None)
    try:
        return np.loadtxt(file, delimiter=delimiter, ndmin=2, encoding="utf-8-sig")
    except ValueError as problem:
        if "number of columns changed" in str(problem):
            changed = str(problem).partition(";")[0].removeprefix("the ")
            raise ValueError(f"rows of different length, the {changed}") from None
        hint = " (a header belongs behind a #)" if "could not convert" in str(problem) else ""
        raise ValueError(f"{str(problem).splitlines()[0]}{hint}") from None


def _lines(file: IO[bytes]) -> Iterator[bytes]:
    """Of bounded number and length."""
    for number, line in enumerate(iter(partial(file.readline, LONGEST_LINE + 1), b"")):
        if number >= MOST_LINES or len(line) > LONGEST_LINE:
            raise ValueError(f"more than {MOST_LINES} lines, or one of more than {LONGEST_LINE} characters")
        yield line


def unit_of(name: str, given: object) -> float:
    """How many metres one of a unit of heights is."""
    return quantity(name, f"1 {given}", "length")
