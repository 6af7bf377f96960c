"""Results of finished solves on disk; a file that is not exactly as it was written is ignored."""

import hashlib
import io
import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from validation.engine.files import is_plain, is_there, read_plain, write_whole

FloatArray = NDArray[np.float64]
Outcome = dict[str, FloatArray]

FORMAT = 2
"""Format 1 had no list of its arrays."""
LABEL = "stored"
"""The entry of an archive that holds its key and lists its arrays."""
SEAL = hashlib.sha256().digest_size


def place_of(folder: Path, module: str, solve: str, key: str) -> Path:
    """Where a result belongs. module, solve: names for its file; key: everything that determines it."""
    return folder / f"{module.rpartition('.')[2]}-{solve}-{hashlib.sha256(key.encode()).hexdigest()[:24]}.npz"


def load(path: Path, key: str) -> Outcome | None:
    """The result that was stored under this key, or None where no intact one is there.

    Raises ValueError for a link or a folder in its place.
    """
    if is_there(path) and not is_plain(path):
        raise ValueError(f"a stored result must be a plain file, got {path}: move that away")
    try:
        contents = read_plain(path)
        archive, seal = contents[:-SEAL], contents[-SEAL:]
        if hashlib.sha256(archive).digest() != seal:
            return None
        with np.load(io.BytesIO(archive), allow_pickle=False) as entries:
            arrays = {name: entries[name] for name in entries.files}
        label = json.loads(str(arrays.pop(LABEL)))
    # a valid seal may have been put behind any bytes
    except Exception:
        return None
    return arrays if label == {"format": FORMAT, "key": key, "arrays": _array_types(arrays)} else None


def save(path: Path, key: str, outcome: Outcome) -> None:
    """Store a result, whole or not at all. Raises OSError, which names the place."""
    arrays = {name: np.asarray(value) for name, value in outcome.items()}
    label = json.dumps({"format": FORMAT, "key": key, "arrays": _array_types(arrays)}, sort_keys=True)
    archive = io.BytesIO()
    np.savez(archive, **{LABEL: np.array(label), **arrays})  # type: ignore[arg-type]  # stubs take a name for a flag
    contents = archive.getvalue()
    # readers of archives ignore a seal at the end
    write_whole(path, contents + hashlib.sha256(contents).digest())


def forget(stored: Mapping[Path, str]) -> None:
    """Remove the results at these places, each by its key, and nothing else that is there."""
    for path, key in stored.items():
        if is_plain(path) and load(path, key) is not None:
            path.unlink()


def _array_types(arrays: Outcome) -> dict[str, list[object]]:
    """Data type and shape of each array, as the label of an archive has them."""
    return {name: [array.dtype.str, list(array.shape)] for name, array in arrays.items()}
