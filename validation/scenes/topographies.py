"""Files of instruments, which SurfaceTopography reads where it is installed: the extra `topography`."""

import contextlib
import io
import warnings
from collections.abc import Iterator
from pathlib import Path

from validation.scenes.known_heights import real_numbers
from validation.scenes.number_table import NumberTable

TEXTS = (".sdf",)
"""How the names of those files end that are texts, but no tables; all others are told from texts by their bytes."""
MISSING = (
    'the format of an instrument must be read by SurfaceTopography, which is not installed: pip install "mdr-validation'
    '[topography]", or export a table of numbers as text'
)


@contextlib.contextmanager
def _silent() -> Iterator[None]:
    """Some of its readers print what stands in a file that they cannot read."""
    with (
        contextlib.redirect_stdout(io.StringIO()),
        contextlib.redirect_stderr(io.StringIO()),
        warnings.catch_warnings(action="ignore"),
    ):
        yield


def topography_of(path: Path) -> NumberTable:
    """Heights of the file of an instrument, with its spacing and unit as far as it has them.

    Raises ValueError where SurfaceTopography is missing or cannot read the file; the sentence shows nothing of it.
    """
    try:
        with _silent():
            from SurfaceTopography.IO import open_topography
    except ImportError:
        raise ValueError(MISSING) from None
    try:
        with _silent(), open_topography(str(path)) as reader:
            channel = reader.default_channel
            sizes = {} if channel.physical_sizes is not None else {"physical_sizes": channel.nb_grid_pts}
            found = reader.topography(**sizes)
            heights = real_numbers(found.heights())
    except Exception as problem:  # whatever a reader of forty formats meets in a file of none
        raise ValueError(
            f"the file must have a format that SurfaceTopography reads, got {type(problem).__name__} from it"
        ) from None
    if not found.is_uniform:
        raise ValueError("points must be equally far apart, got a line of points that are not: resample it")
    known = None if sizes else tuple(float(s) / n for s, n in zip(found.physical_sizes, heights.shape, strict=True))
    return NumberTable(
        values=heights if heights.ndim == 2 else heights[:, None],
        unit=str(found.unit or ""),
        spacing=known,
        notes=(f"SurfaceTopography read it as {type(reader).__name__.removesuffix('Reader')}",),
    )
