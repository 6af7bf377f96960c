"""Arrays of numpy in files of others, .npy and .npz: nothing is allocated before it is known to be there."""

import difflib
import struct
import zipfile
import zlib
from tokenize import TokenError
from typing import IO

import numpy as np
from numpy.typing import NDArray

from validation.scenes.printable import printable, quoted, shortened

ARCHIVE = b"PK"
"""How an .npz begins."""
MOST_KEYS = 12
"""Of an archive that are named in a sentence."""


class KeyOfArchiveError(ValueError):
    """No array of an archive is asked for, or one that it does not have: what follows the name of the key."""


def is_archive(file: IO[bytes]) -> bool:
    """Whether a file is an .npz, whatever its name."""
    found = file.read(len(ARCHIVE)) == ARCHIVE
    file.seek(0)
    return found


def array_of_archive(file: IO[bytes], key: str | None, *, most: int) -> NDArray[np.generic]:
    """One array of an .npz. most: bytes that it may have. Raises KeyOfArchiveError, or ValueError for other faults."""
    try:
        with zipfile.ZipFile(file) as archive:
            members = {one.filename.removesuffix(".npy"): one for one in archive.infolist() if not one.is_dir()}
            if key not in members:
                raise KeyOfArchiveError(_about_keys(key, list(members)))
            size = members[key].file_size
            if size > most:
                raise ValueError(f"an array of {size} bytes, more than {most}")
            with archive.open(members[key]) as member:
                return array_of(member, size)
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, struct.error) as problem:
        raise ValueError(f"an archive that cannot be read, {printable(problem)}") from None


def _about_keys(key: str | None, keys: list[str]) -> str:
    if not keys:
        return "is of no use, the archive is empty"
    shown = ", ".join(quoted(one) for one in keys[:MOST_KEYS])
    more = f" and {len(keys) - MOST_KEYS} more" if len(keys) > MOST_KEYS else ""
    meant = difflib.get_close_matches(key or "heights", keys, 1, cutoff=0.3) or keys[:1]
    wrong = "is missing" if key is None else f"must be in the archive, got {quoted(key)}"
    return f"{wrong}, the archive has {shown}{more}, as: key = {quoted(meant[0])}"


def array_of(file: IO[bytes], size: int) -> NDArray[np.generic]:
    """Of an .npy, once its header is known to promise no more than the file holds."""
    if not size:
        raise ValueError("an empty file")
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
    return shape, dtype
