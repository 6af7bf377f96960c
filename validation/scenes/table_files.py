"""Files with tables of numbers: texts, arrays of numpy, and what instruments write."""

from collections.abc import Sequence
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from validation.scenes.height_arrays import KeyOfArchiveError, array_of, array_of_archive, is_archive
from validation.scenes.input_files import check_regular
from validation.scenes.measured_surface import LENGTHS, metres_of
from validation.scenes.number_table import MOST_VALUES, NumberTable, TableForm, known_alone, table_of_text
from validation.scenes.printable import printable
from validation.scenes.text_dialect import NoTextError
from validation.scenes.topographies import TEXTS, topography_of
from validation.scenes.units import in_unit

FloatArray = NDArray[np.float64]

MOST_BYTES = 2**28
"""Of a file; 4096 x 4096 heights of sixteen characters."""
ARRAYS = (".npy", ".npz")
"""How the names of numpy's files end."""
PLAIN = TableForm()


def read_table(name: str, path: Path, form: TableForm = PLAIN) -> NumberTable:
    """The numbers of a file, rows first; NaN where there are no data.

    name: the key of a scene that has the file. Raises OSError for a file that cannot be read, ValueError for one that
    is no table of real numbers, no regular file, or larger than `MOST_BYTES` or `MOST_VALUES`; a message
    shows no more of a file than one short cell.
    """
    size = check_regular(name, path, most=MOST_BYTES)
    room = name.removesuffix(".file")
    is_array = path.suffix.lower() in ARRAYS
    if is_array and form.of_text:
        raise ValueError(f"{room}.{form.of_text[0]} must be left out of a file of numpy, got {printable(path.name)}")
    if form.key is not None and not is_array:
        raise ValueError(f"{room}.key must be left out but for an .npz, got {printable(path.name)}")
    try:
        with path.open("rb") as file:
            if not is_array:
                return _of_text(file, path, form)
            values = _array(file, size, form.key, room)
    except OSError as problem:
        raise OSError(f"{name} {printable(path)} cannot be read: {problem.strerror or problem}") from None
    except KeyOfArchiveError as problem:
        raise ValueError(f"{room}.key {problem}, of {printable(path)}") from None
    except ValueError as problem:
        must = " must hold a table of numbers, got" if is_array else ""
        raise ValueError(f"{name} {printable(path)}{must}: {printable(problem)}") from None
    if values.size > MOST_VALUES:
        raise ValueError(f"{name} {printable(path)} must hold at most {MOST_VALUES} heights, got {values.size}")
    if values.dtype.kind not in "fiu":
        raise ValueError(f"{name} {printable(path)} must hold real numbers, got {values.dtype}")
    found = NumberTable(values=np.asarray(values, dtype=np.float64))
    return known_alone(found, form.nodata).chosen(form.columns) if values.ndim == 2 and values.size else found


def _of_text(file: IO[bytes], path: Path, form: TableForm) -> NumberTable:
    """A text, or what an instrument wrote, which most of them write in bytes that no text has."""
    if path.suffix.lower() not in TEXTS:
        try:
            return table_of_text(file, form)
        except NoTextError:
            if form.of_text or form.columns:
                raise
    return known_alone(topography_of(path), form.nodata)


def heights_of_columns(table: NumberTable, places: Sequence[int], metre: float | None) -> FloatArray:
    """Columns of lengths in metres: in the unit that each names, that of all, the given one [m], or in metres.

    Raises ValueError for a column of another quantity, and for units that differ.
    """
    factors = []
    for i in places:
        unit = table.columns[i].unit or table.unit
        if unit and unit not in LENGTHS:
            lengths = [j + 1 for j, column in enumerate(table.columns) if column.unit in ("", *LENGTHS)]
            raise ValueError(
                f"columns must be lengths, got {table.names([i])}: say which to read, as: columns = {lengths or [1]}"
            )
        named = metres_of("unit", unit) if unit else None
        if named and metre and named != metre:
            raise ValueError(
                f"unit must be that of the file, {unit}, or be left out, got {in_unit(metre, 'length')}: skip leaves "
                "out a header that is wrong"
            )
        factors.append(named or metre or 1.0)
    return np.asarray(table.values[:, list(places)] * np.array(factors))


def sentence_about(path: Path, notes: Sequence[str]) -> tuple[str, ...]:
    """What was assumed of a file, for the notes of a scene."""
    return (f"{printable(path.name)}: {'; '.join(notes)}.",) if notes else ()


def _array(file: IO[bytes], size: int, key: str | None, room: str) -> NDArray[np.generic]:
    """One of numpy's, whatever the name of the file."""
    if is_archive(file):
        return array_of_archive(file, key, most=MOST_BYTES)
    if key is not None:
        raise ValueError(f"one array without a name, for which {room}.key has no use")
    return array_of(file, size)
