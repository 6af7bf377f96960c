"""Heights that somebody measured: all of them known, or where it is asked for cropped, and single points filled in."""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from validation.analysis.statistics import FloatArray

BY_HAND = "cut out a part that is known, or fill them in from their neighbours"
MOST_FILLED = 0.01
"""Of the points without data: a larger part is no longer a detail of the surface."""
SQUARE = 1e-6
"""By how much both sides of a square may differ, over one of them."""


def real_numbers(height: ArrayLike) -> FloatArray:
    """Real numbers, NaN where they are masked."""
    try:
        values = np.asarray(height)
    except ValueError:
        raise ValueError("heights must be a regular array of numbers, got rows of different length") from None
    if values.dtype.kind not in "fiu":
        raise TypeError(f"heights must be real numbers, got dtype {values.dtype}")
    numbers = values.astype(np.float64)
    if isinstance(height, np.ma.MaskedArray):
        numbers[np.ma.getmaskarray(height)] = np.nan
    return numbers


def known_heights(height: ArrayLike) -> FloatArray:
    """Real numbers, all of them there. Raises ValueError for masked ones and ones that are not finite, or TypeError."""
    values = real_numbers(height)
    points_to_fill(values)
    return values


@dataclass(frozen=True, kw_only=True)
class HeightEdits:
    """What was done to measured heights: how many points were filled in, of which shape the central square was cut.

    told: what was assumed of their file, in sentences.
    """

    filled: int = 0
    share: float = 0.0
    cropped_from: tuple[int, int] | None = None
    told: tuple[str, ...] = ()

    @property
    def words(self) -> str:
        """For a description, after a list of other words."""
        cropped = f", the central square of {_shape(self.cropped_from)}" if self.cropped_from else ""
        return cropped + (f", {self._points} filled in" if self.filled else "")

    @property
    def notes(self) -> tuple[str, ...]:
        """In sentences."""
        found = [*self.told]
        if self.cropped_from:
            found.append(f"heights are the central square of {_shape(self.cropped_from)} points, as asked by crop.")
        if self.filled:
            found.append(
                f"heights had no data at {self._points}, which were filled in from their neighbours, as asked by fill: "
                "short waves are missing there, and a summit would be lost."
            )
        return tuple(found)

    @property
    def _points(self) -> str:
        return f"{self.filled} {'point' if self.filled == 1 else 'points'} ({100 * self.share:.3g} %)"


UNTOUCHED = HeightEdits()


def edited_lines(height: FloatArray, *, fill: bool, asked_by: str, missing: str = "") -> tuple[FloatArray, HeightEdits]:
    """Lines, shape (points, lines), filled in by interpolation along each if asked for, and what was done.

    missing: what stands in the cells of a file without data.
    """
    count, share = points_to_fill(height, fill=fill, asked_by=asked_by, missing=missing)
    found = np.stack([_filled_line(line) for line in height.T], axis=1) if count else height
    return found, HeightEdits(filled=count, share=share)


def without_unknown_ends(height: FloatArray) -> tuple[FloatArray, tuple[str, ...]]:
    """Lines, shape (points, lines), less the rows at both ends in which a line has no data, and a note of that."""
    known = np.flatnonzero(~np.isnan(height).any(axis=1))
    if not known.size or known.size == len(height):
        return height, ()
    first, last = int(known[0]), int(known[-1])
    ends = [f"{count} at its {end}" for count, end in ((first, "beginning"), (len(height) - 1 - last, "end")) if count]
    note = f"rows without data are left out, {' and '.join(ends)}"
    # most of a line, or one of several lines, is no end
    kept = 2 * (last + 1 - first) > len(height)
    return (height[first : last + 1], (note,) if ends else ()) if kept else (height, ())


def _filled_line(line: FloatArray) -> FloatArray:
    """Linear between known points, and about the mean slope beyond the first and the last."""
    known, at = np.isfinite(line), np.arange(line.size)
    mean = np.polynomial.Polynomial.fit(at[known], line[known], 1)(at)
    return np.asarray(mean + np.interp(at, at[known], (line - mean)[known]))


def points_to_fill(
    height: FloatArray, *, fill: bool = False, asked_by: str = "", missing: str = ""
) -> tuple[int, float]:
    """How many points have no data, and their share. asked_by: how fill is asked for, empty where nothing here does it.

    missing: what stands in the cells of a file without data.
    Raises ValueError for infinite heights, for points without data that are not to be filled in, and for `MOST_FILLED`
    of them and more.
    """
    infinite, unknown = np.isinf(height), np.isnan(height)
    if infinite.any():
        raise ValueError(
            f"heights must be finite, got {_counted(infinite, 'infinite')}: a point without data is nan, not infinite"
        )
    count, share = int(unknown.sum()), float(unknown.mean()) if height.size else 0.0
    if count and not (fill and share < MOST_FILLED):
        advice = f"fewer than 1 % can be filled in from their neighbours, as: {asked_by}" if asked_by else BY_HAND
        if asked_by and share >= MOST_FILLED:
            advice = f"cut out a part that is known; {advice}"
        found = _counted(unknown, "without data (NaN or masked)") + (f", cells with {missing}" if missing else "")
        raise ValueError(f"heights must be known everywhere, got {found}: {advice}")
    return count, share


def _counted(places: NDArray[np.bool_], what: str) -> str:
    count, first = int(places.sum()), np.argwhere(places)[0].tolist()
    return f"{count} of {places.size} ({100 * count / places.size:.3g} %) {what}, the first at {first}"


def central_square(height: FloatArray, spacing: tuple[float, float]) -> FloatArray:
    """The largest square about the middle that is a whole number of points along both sides.

    Raises ValueError where there is none of half of the shorter side.
    """
    (nx, ny), (dx, dy) = height.shape, spacing
    along = np.arange(nx, 0, -1)
    across = np.rint(along * (dx / dy)).astype(np.int64)
    fits = (across >= 1) & (across <= ny) & (np.abs(across * dy - along * dx) <= SQUARE * along * dx)
    if not fits.any() or 2 * along[fits][0] * dx < min(nx * dx, ny * dy):
        raise ValueError(
            f"crop must find a square of whole points, got {_shape(height.shape)} points, {dx:.5g} x {dy:.5g} m apart: "
            "resample the heights onto square points"
        )
    first_x, first_y = (nx - along[fits][0]) // 2, (ny - across[fits][0]) // 2
    return height[first_x : first_x + along[fits][0], first_y : first_y + across[fits][0]]


def filled_in(height: FloatArray, spacing: tuple[float, float]) -> FloatArray:
    """Points without data by harmonic interpolation about the mean plane of the others.

    At such a point the discrete Laplacian is zero, 1/dx^2 and 1/dy^2 its weights: on square cells the point is the mean
    of its four neighbours. So no point becomes a summit or a valley, and a plane stays a plane up to its edge.
    """
    unknown, index = np.isnan(height), np.arange(height.size).reshape(height.shape)
    plane = _plane(height, ~unknown)
    every, edges, weights = unknown.ravel(), [], []
    for axis, step in enumerate(spacing):
        near = np.delete(unknown, -1, axis) | np.delete(unknown, 0, axis)
        edges.append(np.stack([np.delete(index, end, axis)[near] for end in (-1, 0)]))
        weights.append(np.full(edges[-1].shape[1], (min(spacing) / step) ** 2))
    (one, other), weight = np.hstack(edges), np.hstack(weights)
    rows, columns = np.hstack([one, other, one, other]), np.hstack([one, other, other, one])
    values = np.hstack([weight, weight, -weight, -weight])
    laplacian = scipy.sparse.coo_array((values, (rows, columns)), shape=(every.size,) * 2).tocsr()[every]
    right = -laplacian @ np.where(unknown, 0.0, height - plane).ravel()
    found = height.copy()
    found[unknown] = scipy.sparse.linalg.spsolve(laplacian[:, every].tocsc(), right) + plane[unknown]
    return found


def _plane(height: FloatArray, known: NDArray[np.bool_]) -> FloatArray:
    """The plane of least squares through the known heights, everywhere."""
    x, y = (np.linspace(-1.0, 1.0, n) for n in height.shape)
    values = np.where(known, height, 0.0)
    in_x, in_y = known.sum(axis=1), known.sum(axis=0)
    moments = np.array(
        [
            [in_x.sum(), in_x @ x, in_y @ y],
            [in_x @ x, in_x @ x**2, x @ known @ y],
            [in_y @ y, x @ known @ y, in_y @ y**2],
        ]
    )
    mean, slope_x, slope_y = np.linalg.solve(moments, [values.sum(), x @ values.sum(axis=1), values.sum(axis=0) @ y])
    return np.asarray(mean + slope_x * x[:, np.newaxis] + slope_y * y)


def _shape(shape: tuple[int, ...]) -> str:
    return " x ".join(map(str, shape))
