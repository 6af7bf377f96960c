"""Files with tables of numbers, which a scene names: texts, arrays of numpy, and what instruments write."""

import codecs
import contextlib
import difflib
import io
import math
import struct
import warnings
import zipfile
import zlib
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from tokenize import TokenError
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from mdr.checks import count, finite
from validation.analysis.escapes import printable, quoted, shortened
from validation.analysis.statistics import FloatArray
from validation.scenes.bundled import check_regular
from validation.scenes.measured_heights import real_numbers
from validation.scenes.number_table import MOST_VALUES, NumberTable, TableForm, mask_sentinels, table_of_text
from validation.scenes.reader import Reader, nonblank_text, without_unit
from validation.scenes.text_dialect import NoTextError
from validation.scenes.units import LENGTHS, in_unit, metres_of

SHEET = 'a spreadsheet: save its sheet as "CSV UTF-8", with the numbers alone below one line of names'
BY_PYTHON = 'a file of {kind}: numpy.savetxt("heights.txt", {loaded}) writes its array as a text'
HDF5 = BY_PYTHON.format(kind="HDF5", loaded='h5py.File("{name}")["heights"][:]')
MATLAB = "a file of MATLAB: writematrix(heights, 'heights.csv') writes its array as a text there"
TABLES = "a table of Apache {kind}: pandas.{read}(...).to_csv(...) writes it as a text"
INSTRUMENT = "a file of an instrument: its software exports heights as a text, as XYZ or CSV"
ENDINGS = {
    ".xlsx": SHEET,
    ".xlsm": SHEET,
    ".xlsb": SHEET,
    ".xls": SHEET,
    ".ods": SHEET,
    ".numbers": SHEET,
    ".h5": HDF5,
    ".hdf5": HDF5,
    ".hdf": HDF5,
    ".mat": MATLAB,
    ".parquet": TABLES.format(kind="Parquet", read="read_parquet"),
    ".feather": TABLES.format(kind="Arrow", read="read_feather"),
    ".tdms": BY_PYTHON.format(kind="LabVIEW", loaded='nptdms.TdmsFile("{name}")'),
    ".mf4": BY_PYTHON.format(kind="ASAM MDF", loaded='asammdf.MDF("{name}")'),
    ".pkl": BY_PYTHON.format(kind="pickle, which can run any program and is not opened,", loaded="of your own program"),
    ".al3d": INSTRUMENT,
    ".sur": INSTRUMENT,
    ".pro": INSTRUMENT,
    ".spm": INSTRUMENT,
    ".pdf": "a document, in which numbers are pictures: the file that it was made from has them",
    ".zip": "an archive: unpack it, and name the file in it",
    ".gz": "an archive: unpack it, and name the file in it",
}
"""What a file is, by how its name ends, and how it is exported."""
BEGINNINGS = (
    (b"PK\x03\x04", "a spreadsheet or another archive: a sheet is saved as CSV, other archives are unpacked"),
    (b"\x89HDF\r\n\x1a\n", HDF5),
    (b"\xd0\xcf\x11\xe0", SHEET),
    (b"MATLAB 5.0 MAT-file", MATLAB),
    (b"PAR1", TABLES.format(kind="Parquet", read="read_parquet")),
    (b"%PDF", ENDINGS[".pdf"]),
    (b"\x1f\x8b", ENDINGS[".gz"]),
)
"""What a file is, by its first bytes, and how it is exported."""
LONGEST_MARK = max(len(mark) for mark, _ in BEGINNINGS)


def how_to_export(path: Path, beginning: bytes) -> str:
    """What a file is and how it is exported, in words; empty of a format that is not among these."""
    words = next((words for mark, words in BEGINNINGS if beginning.startswith(mark)), "")
    return ENDINGS.get(path.suffix.lower(), words).replace("{name}", "FILE" + path.suffix.lower())


MOST_BYTES = 2**28
"""Largest size of a file: 4096 x 4096 heights of sixteen characters."""
ARRAYS, ARCHIVE = (".npy", ".npz"), b"PK"
"""How the names of numpy's files end, and how an .npz begins."""
MOST_KEYS = 12
"""Keys of an archive that a sentence names."""
TEXTS = (".sdf",)
"""How the names of files of instruments end that are texts, but no tables; all others are told from texts by bytes."""
MISSING = (
    'the format of an instrument must be read by SurfaceTopography, which is not installed: pip install "mdr-validation'
    '[topography]", or export a table of numbers as text'
)
PLAIN = TableForm()


class KeyOfArchiveError(ValueError):
    """No array of an archive is asked for, or one that it does not have: what follows the name of the key."""


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
                return _read_text(file, path, form)
            values = _read_array(file, size, form.key, room)
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
    table = NumberTable(values=np.asarray(values, dtype=np.float64))
    return mask_sentinels(table, form.nodata).chosen(form.columns) if values.ndim == 2 and values.size else table


def read_scene_table(name: str, entries: dict[str, Any], folder: Path, *, key: str = "") -> tuple[Path, NumberTable]:
    """Path and numbers of the file that a table of a scene names; its entries about the file are removed.

    name: of the table; entries: of the table; folder: of the scene; key: of the file, where it is no key of that table.
    """
    path = folder / entries.pop("file")
    form = TableForm(**{setting: entries.pop(setting) for setting in FORM if setting in entries})
    return path, read_table(key or f"{name}.file", path, form)


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


def _read_text(file: IO[bytes], path: Path, form: TableForm) -> NumberTable:
    """The table of a text or of a file of an instrument, which most of them write in bytes that no text has."""
    if path.suffix.lower() not in TEXTS:
        try:
            return table_of_text(file, form)
        except NoTextError:
            file.seek(0)
            exported = how_to_export(path, file.read(LONGEST_MARK))
            of_text = form.of_text or form.columns
            if of_text and not exported:
                raise
            # some files of these formats are read in spite of that
            with contextlib.suppress(*([ValueError] if exported else [])):
                if not of_text:
                    return mask_sentinels(_read_topography(path), form.nodata)
            must = "must be a text, an array of numpy or heights of an instrument"
            raise ValueError(f"the file {must}, got {exported}") from None
    return mask_sentinels(_read_topography(path), form.nodata)


# Arrays of numpy: nothing is allocated before it is known to be there


def _read_array(file: IO[bytes], size: int, key: str | None, room: str) -> NDArray[np.generic]:
    """The array of an .npy, or that of a key of an .npz; the first bytes decide, not the name of the file."""
    is_archive = file.read(len(ARCHIVE)) == ARCHIVE
    file.seek(0)
    if not is_archive:
        if key is not None:
            raise ValueError(f"one array without a name, for which {room}.key has no use")
        return _read_npy(file, size)
    try:
        with zipfile.ZipFile(file) as archive:
            members = {info.filename.removesuffix(".npy"): info for info in archive.infolist() if not info.is_dir()}
            if key not in members:
                raise KeyOfArchiveError(_key_sentence(key, list(members)))
            size = members[key].file_size
            if size > MOST_BYTES:
                raise ValueError(f"an array of {size} bytes, more than {MOST_BYTES}")
            with archive.open(members[key]) as member:
                return _read_npy(member, size)
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, struct.error) as problem:
        raise ValueError(f"an archive that cannot be read, {printable(problem)}") from None


def _key_sentence(key: str | None, keys: list[str]) -> str:
    """Why a key selects no array of an archive, and the keys that it has; follows the name of the key."""
    if not keys:
        return "is of no use, the archive is empty"
    shown = ", ".join(quoted(name) for name in keys[:MOST_KEYS])
    more = f" and {len(keys) - MOST_KEYS} more" if len(keys) > MOST_KEYS else ""
    meant = difflib.get_close_matches(key or "heights", keys, 1, cutoff=0.3) or keys[:1]
    wrong = "is missing" if key is None else f"must be in the archive, got {quoted(key)}"
    return f"{wrong}, the archive has {shown}{more}, as: key = {quoted(meant[0])}"


def _read_npy(file: IO[bytes], size: int) -> NDArray[np.generic]:
    """The array of an .npy, allocated after its header is found to promise no more than the file holds."""
    if not size:
        raise ValueError("an empty file")
    try:
        version = np.lib.format.read_magic(file)
    except ValueError:
        raise ValueError("a file that does not begin as arrays of numpy do") from None
    if version not in ((1, 0), (2, 0), (3, 0)):
        raise ValueError(f"an .npy of the unknown version {version}")
    # that of version 3 differs in names alone
    header = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
    try:
        shape, _, dtype = header(file)
    except (ValueError, TypeError, SyntaxError, TokenError, RecursionError, MemoryError):
        # whatever a parser of Python meets in a text that is none
        raise ValueError("a header that cannot be read") from None
    if dtype.hasobject:
        raise ValueError("objects in place of numbers")
    left = size - file.tell()
    if min(shape, default=0) < 0 or math.prod(shape) * dtype.itemsize > left:
        raise ValueError(f"a header of {shortened(shape)} values of {dtype.itemsize} bytes, and {left} bytes")
    file.seek(0)
    return np.asarray(np.lib.format.read_array(file, allow_pickle=False))


# Files of instruments, which SurfaceTopography reads where it is installed: the extra `topography`


@contextlib.contextmanager
def _silent() -> Iterator[None]:
    """Suppress output and warnings: some readers print what stands in a file that they cannot read."""
    with (
        contextlib.redirect_stdout(io.StringIO()),
        contextlib.redirect_stderr(io.StringIO()),
        warnings.catch_warnings(action="ignore"),
    ):
        yield


@_silent()
def _read_topography(path: Path) -> NumberTable:
    """Heights of the file of an instrument, with its spacing and unit as far as it has them.

    Raises ValueError where SurfaceTopography is missing or cannot read the file; the sentence shows nothing of it.
    """
    try:
        from SurfaceTopography.IO import open_topography
    except ImportError:
        raise ValueError(MISSING) from None
    try:
        with open_topography(str(path)) as reader:
            channel = reader.default_channel
            sizes = {} if channel.physical_sizes is not None else {"physical_sizes": channel.nb_grid_pts}
            topography = reader.topography(**sizes)
            heights = real_numbers(topography.heights())
    except Exception as problem:  # whatever a reader of forty formats meets in a file of none
        raise ValueError(
            f"the file must have a format that SurfaceTopography reads, got {type(problem).__name__} from it"
        ) from None
    if not topography.is_uniform:
        raise ValueError("points must be equally far apart, got a line of points that are not: resample it")
    spacing = (
        None if sizes else tuple(float(s) / n for s, n in zip(topography.physical_sizes, heights.shape, strict=True))
    )
    return NumberTable(
        values=heights if heights.ndim == 2 else heights[:, None],
        unit=str(topography.unit or ""),
        spacing=spacing,
        notes=(f"SurfaceTopography read it as {type(reader).__name__.removesuffix('Reader')}",),
    )


# Keys of a scene


def _read_columns(name: str, value: object) -> tuple[str | int, ...]:
    """Names or numbers of columns, of one value or a list."""
    columns = value if isinstance(value, list) else [value]
    if not columns or not all(isinstance(column, str | int) and not isinstance(column, bool) for column in columns):
        raise ValueError(f'{name} must be names or numbers of columns, as ["x", "z"] or [1, 3], got {shortened(value)}')
    return tuple(columns)


def _read_nodata(name: str, value: object) -> tuple[str | float, ...]:
    """Numbers and texts of cells without data, of one value or a list."""
    entries = value if isinstance(value, list) else [value]
    return tuple(entry if isinstance(entry, str) else without_unit(finite, name, entry) for entry in entries)


def _read_decimal(name: str, value: object) -> str:
    """Check a decimal sign, a point or a comma."""
    if value not in (".", ","):
        raise ValueError(f'{name} must be "." or ",", got {shortened(value)}')
    return str(value)


def _read_encoding(name: str, value: object) -> str:
    """Check the name of a text encoding that Python has."""
    try:
        "".encode(codecs.lookup(nonblank_text(name, value)).name)
    except LookupError:
        raise ValueError(f'{name} must be an encoding, as "latin-1" or "utf-16", got {shortened(value)}') from None
    return str(value)


FORM: dict[str, Reader] = {
    "skip": partial(without_unit, partial(count, least=0)),
    "columns": _read_columns,
    "decimal": _read_decimal,
    "encoding": _read_encoding,
    "nodata": _read_nodata,
    "key": nonblank_text,
}
"""How each value about a file is read, as of a `TableForm`."""
