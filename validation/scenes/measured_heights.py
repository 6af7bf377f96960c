"""Measured heights: checked, levelled, and asked what Geike's rule takes for granted, isotropy and Gaussian heights."""

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar, get_args, overload

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from mdr.checks import Numbers, number_or_array, positive
from validation.analysis.spectra import Detrend
from validation.analysis.statistics import FloatArray
from validation.scenes.units import in_unit

BY_HAND = "cut out a part that is known, or fill them in from their neighbours"
MOST_FILLED = 0.01
"""Of the points without data: a larger part is no longer a detail of the surface."""
SQUARE = 1e-6
"""Largest difference of both sides of a square, over one of them."""


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


def complete_heights(height: ArrayLike) -> FloatArray:
    """Real numbers, all of them there. Raises ValueError for masked ones and ones that are not finite, or TypeError."""
    values = real_numbers(height)
    points_to_fill(values)
    return values


@dataclass(frozen=True, kw_only=True)
class HeightEdits:
    """What was done to measured heights: how many points were filled in, of which shape the central square was cut.

    assumptions: about their file, in sentences.
    """

    filled: int = 0
    share: float = 0.0
    cropped_from: tuple[int, int] | None = None
    assumptions: tuple[str, ...] = ()

    @property
    def words(self) -> str:
        """The edits as the end of a description, with a comma before each."""
        cropped = f", the central square of {_size(self.cropped_from)}" if self.cropped_from else ""
        return cropped + (f", {self._gaps} filled in" if self.filled else "")

    @property
    def notes(self) -> tuple[str, ...]:
        """The assumptions about the file, and the edits, each in a sentence."""
        notes = [*self.assumptions]
        if self.cropped_from:
            notes.append(f"heights are the central square of {_size(self.cropped_from)} points, as asked by crop.")
        if self.filled:
            notes.append(
                f"heights had no data at {self._gaps}, which were filled in from their neighbours, as asked by fill: "
                "short waves are missing there, and a summit would be lost."
            )
        return tuple(notes)

    @property
    def _gaps(self) -> str:
        """Number and share of the points that were filled in, in words."""
        return f"{self.filled} {'point' if self.filled == 1 else 'points'} ({100 * self.share:.3g} %)"


UNTOUCHED = HeightEdits()


def edited_lines(height: FloatArray, *, fill: bool, asked_by: str, missing: str = "") -> tuple[FloatArray, HeightEdits]:
    """Lines, shape (points, lines), filled in by interpolation along each if asked for, and what was done.

    missing: what stands in the cells of a file without data.
    """
    count, share = points_to_fill(height, fill=fill, asked_by=asked_by, missing=missing)
    lines = np.stack([_filled_line(line) for line in height.T], axis=1) if count else height
    return lines, HeightEdits(filled=count, share=share)


def without_unknown_ends(height: FloatArray) -> tuple[FloatArray, tuple[str, ...]]:
    """Lines, shape (points, lines), less the rows at both ends in which a line has no data, and a note of that."""
    complete_rows = np.flatnonzero(~np.isnan(height).any(axis=1))
    if not complete_rows.size or complete_rows.size == len(height):
        return height, ()
    first, last = int(complete_rows[0]), int(complete_rows[-1])
    ends = [f"{count} at its {end}" for count, end in ((first, "beginning"), (len(height) - 1 - last, "end")) if count]
    note = f"rows without data are left out, {' and '.join(ends)}"
    # most of a line, or one of several lines, is no end
    mostly_complete = 2 * (last + 1 - first) > len(height)
    return (height[first : last + 1], (note,) if ends else ()) if mostly_complete else (height, ())


def _filled_line(line: FloatArray) -> FloatArray:
    """A line, linear between its finite points, and about the mean slope beyond the first and the last."""
    finite, at = np.isfinite(line), np.arange(line.size)
    mean = np.polynomial.Polynomial.fit(at[finite], line[finite], 1)(at)
    return np.asarray(mean + np.interp(at, at[finite], (line - mean)[finite]))


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
            f"heights must be finite, got {_extent(infinite, 'infinite')}: a point without data is nan, not infinite"
        )
    count, share = int(unknown.sum()), float(unknown.mean()) if height.size else 0.0
    if count and not (fill and share < MOST_FILLED):
        advice = f"fewer than 1 % can be filled in from their neighbours, as: {asked_by}" if asked_by else BY_HAND
        if asked_by and share >= MOST_FILLED:
            advice = f"cut out a part that is known; {advice}"
        gaps = _extent(unknown, "without data (NaN or masked)") + (f", cells with {missing}" if missing else "")
        raise ValueError(f"heights must be known everywhere, got {gaps}: {advice}")
    return count, share


def _extent(places: NDArray[np.bool_], what: str) -> str:
    """Number and share of the places, and the first of them, in words."""
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
            f"crop must find a square of whole points, got {_size(height.shape)} points, {dx:.5g} x {dy:.5g} m apart: "
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
    is_unknown, edges, weights = unknown.ravel(), [], []
    for axis, step in enumerate(spacing):
        near = np.delete(unknown, -1, axis) | np.delete(unknown, 0, axis)
        edges.append(np.stack([np.delete(index, end, axis)[near] for end in (-1, 0)]))
        weights.append(np.full(edges[-1].shape[1], (min(spacing) / step) ** 2))
    (first, second), weight = np.hstack(edges), np.hstack(weights)
    rows, columns = np.hstack([first, second, first, second]), np.hstack([first, second, second, first])
    values = np.hstack([weight, weight, -weight, -weight])
    laplacian = scipy.sparse.coo_array((values, (rows, columns)), shape=(is_unknown.size,) * 2).tocsr()[is_unknown]
    right = -laplacian @ np.where(unknown, 0.0, height - plane).ravel()
    filled = height.copy()
    filled[unknown] = scipy.sparse.linalg.spsolve(laplacian[:, is_unknown].tocsc(), right) + plane[unknown]
    return filled


def _plane(height: FloatArray, mask: NDArray[np.bool_]) -> FloatArray:
    """The plane of least squares through the heights of the mask, at all points [m]."""
    x, y = (np.linspace(-1.0, 1.0, n) for n in height.shape)
    values = np.where(mask, height, 0.0)
    in_x, in_y = mask.sum(axis=1), mask.sum(axis=0)
    moments = np.array(
        [
            [in_x.sum(), in_x @ x, in_y @ y],
            [in_x @ x, in_x @ x**2, x @ mask @ y],
            [in_y @ y, x @ mask @ y, in_y @ y**2],
        ]
    )
    mean, slope_x, slope_y = np.linalg.solve(moments, [values.sum(), x @ values.sum(axis=1), values.sum(axis=0) @ y])
    return np.asarray(mean + slope_x * x[:, np.newaxis] + slope_y * y)


def _size(shape: tuple[int, ...]) -> str:
    """A shape as "512 x 256"."""
    return " x ".join(map(str, shape))


FEWEST = 16
"""Points along each side, below which there is no spectrum to speak of."""
RINGS = 5
"""Rings of the spectrum in an octave of wavenumbers."""
STEEP = 0.3
"""Rms gradient from where on it is warned of."""
OBLONG, SKEWED, PEAKED, TILTED = 1.5, 0.5, 1.0, 1.0
"""From where on texture, skewness, excess kurtosis and tilt are warned of."""
FLAT = 2.0
"""Rms heights above the mean plane: where the highest hundredth of Gaussian heights begins, 2.3, less its scatter with
few long waves. Plateaus begin lower, and are much stiffer than a spectrum says."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MeasuredHeights:
    """Heights of a surface on a regular grid, by default about their mean plane.

    Parameters
    ----------
    height : array_like, shape (nx, ny)
        Heights, positive towards the other body [m]; 16 or more along each side.
    spacing : tuple of float
        Distances (dx, dy) of the points [m]. Square cells read the heights linearly between points.
    edits : HeightEdits, optional
        What was done to the heights before: nothing, unless `measured` or a scene file filled points in or cropped.
    detrend : "none", "mean" or "plane", optional
        What is subtracted from the heights: nothing, their mean, or their plane of least squares.

    Attributes
    ----------
    tilt : float
        Root mean square of the mean plane over that of the heights about it [-].

    Raises
    ------
    ValueError
        If there are fewer than 16 points along a side, heights are masked, not finite or a plane, or a spacing is not
        positive.
    TypeError
        If heights are not real numbers.

    Examples
    --------
    >>> x = np.arange(64) * 1e-6
    >>> face = validation.MeasuredHeights(height=1e-7 * np.sin(1e5 * x)[:, None] + 0.01 * x, spacing=(1e-6, 1e-6))
    >>> face.height.shape, face.sides
    ((64, 64), (6.4e-05, 6.4e-05))
    """

    is_single: ClassVar = True
    hurst: ClassVar = None

    height: FloatArray
    spacing: tuple[float, float]
    edits: HeightEdits = UNTOUCHED
    detrend: Detrend = "plane"
    tilt: float = field(init=False)

    def __post_init__(self) -> None:
        if self.detrend not in get_args(Detrend):
            raise ValueError(f"detrend must be one of {', '.join(get_args(Detrend))}, got {self.detrend!r}")
        height = complete_heights(self.height)
        check_grid(height)
        for name, side in zip(("spacing[0]", "spacing[1]"), self.spacing, strict=True):
            positive(name, side)
        level = _subtract_plane(height)
        if not level.std() > 1e-9 * np.abs(height).max():
            raise ValueError("heights must be rough, got a plane")
        kept = {"none": height, "mean": height - height.mean(), "plane": level}[self.detrend]
        object.__setattr__(self, "height", kept)
        object.__setattr__(self, "tilt", float((height - level).std() / level.std()))

    @property
    def sides(self) -> tuple[float, float]:
        """Lengths of the grid [m]."""
        (nx, ny), (dx, dy) = self.height.shape, self.spacing
        return nx * dx, ny * dy

    @property
    def places(self) -> tuple[FloatArray, FloatArray]:
        """x and y of the points, from the middle of the surface [m]."""
        (nx, ny), (dx, dy) = self.height.shape, self.spacing
        return (np.arange(nx) - (nx - 1) / 2) * dx, (np.arange(ny) - (ny - 1) / 2) * dy

    @property
    def rms(self) -> float:
        """Root mean square height [m]."""
        return float(self.height.std())

    @property
    def edges(self) -> tuple[float, ...]:
        """Ends of the rings of wavenumbers in which the spectrum is known [rad/m]."""
        return self._rings[0]

    def __repr__(self) -> str:
        points = " x ".join(map(str, self.height.shape))
        sides = " x ".join(in_unit(side, "length") for side in self.sides)
        return f"MeasuredHeights({points} points on {sides}, rms={in_unit(self.rms, 'length')})"

    @property
    def q_min(self) -> float:
        """Lower end of the first ring [rad/m]."""
        return self.edges[0]

    @property
    def q_max(self) -> float:
        """Upper end of the last ring, the Nyquist wavenumber of the coarser axis [rad/m]."""
        return self.edges[-1]

    @property
    def longest(self) -> float:
        """The longest wavelength, 2 pi / q_min [m]."""
        return 2 * math.pi / self.q_min

    @property
    def q_resolved(self) -> float:
        """Wavenumber of waves with four points [rad/m]."""
        return self.q_max / 2

    @overload
    def c2d(self, q: float) -> float: ...
    @overload
    def c2d(self, q: Numbers) -> FloatArray: ...
    def c2d(self, q: float | Numbers) -> float | FloatArray:
        """C_2D as the mean over all directions, constant in each ring, of the mean square of the heights [m^4]."""
        edges, level = np.array(self.edges), np.array(self._rings[1])
        ring = np.searchsorted(edges, np.abs(np.asarray(q, dtype=np.float64)), side="right") - 1
        inside = (ring >= 0) & (ring < level.size)
        return number_or_array(np.asarray(np.where(inside, level[np.clip(ring, 0, level.size - 1)], 0.0)))

    def at(self, x: NDArray[np.floating], y: NDArray[np.floating]) -> FloatArray:
        """Heights over the grid of x and y, from the middle of the surface, ascending [m]: linear between points."""
        ends = self.places
        inside = [np.clip(places, end[0], end[-1]) for places, end in zip((x, y), ends, strict=True)]
        return np.asarray(scipy.interpolate.RectBivariateSpline(*ends, self.height, kx=1, ky=1)(*inside))

    @property
    def waves(self) -> str:
        """Points and sides, distances of points where they differ, and what was done to the heights, in words."""
        sides, steps = (" x ".join(in_unit(length, "length") for length in pair) for pair in (self.sides, self.spacing))
        distances = f", {steps} apart" if abs(self.spacing[0] / self.spacing[1] - 1) > 1e-6 else ""
        return (
            f"measured, {self.height.shape[0]} x {self.height.shape[1]} points on {sides}{distances}{self.edits.words}"
        )

    def mean_over_cells(self, shape: tuple[int, int], cell: float) -> FloatArray:
        """Mean heights over square cells about the middle, so that short waves are no longer ones [m]."""
        parts = max(1, math.ceil(cell / min(self.spacing) * (1 - 1e-9)))
        x, y = ((np.arange(parts * n) - (parts * n - 1) / 2) * cell / parts for n in shape)
        return np.asarray(self.at(x, y).reshape(shape[0], parts, shape[1], parts).mean(axis=(1, 3)))

    @cached_property
    def texture(self) -> float:
        """sqrt(l1 / l2) of the eigenvalues of <dh/dx_i dh/dx_j>: one where isotropic, large for ridges [-]."""
        gx, gy = np.gradient(self.height, *self.spacing)
        tensor = [[np.mean(gx * gx), np.mean(gx * gy)], [np.mean(gx * gy), np.mean(gy * gy)]]
        small, large = np.linalg.eigvalsh(np.array(tensor))
        return math.sqrt(large / max(small, 1e-12 * large))

    def notes(self) -> tuple[str, ...]:
        """All that may be wrong about these heights though they are valid, in sentences."""
        notes = [*self.edits.notes]
        if self.gradient > STEEP:
            notes.append(
                f"heights are steep, rms gradient {self.gradient:.2g}: theory is that of small slopes; are the units "
                "of heights and of their spacing right?"
            )
        if self.tilt > TILTED:
            removed = "removed" if self.detrend == "plane" else "kept, as asked by detrend"
            notes.append(
                f"heights are tilted: the mean plane, which was {removed}, is {self.tilt:.2g} times as rough as "
                "what is left; it would matter for a body that cannot rotate."
            )
        (nx, ny), (dx, dy) = self.height.shape, self.spacing
        if nx != ny and abs(dx * nx / (dy * ny) * nx / ny - 1) < 1e-6:
            notes.append(
                f"{nx} x {ny} heights are {dx * nx:.3g} m x {dy * ny:.3g} m large, so that their points are "
                f"{max(dx / dy, dy / dx):.3g} times as far apart along one side as along the other; with both sides "
                "exchanged they would be equally far apart: are the sides in the order of the axes?"
            )
        return (*notes, *self.beyond_a_spectrum())

    def beyond_a_spectrum(self) -> tuple[str, ...]:
        """What Geike's rule takes for granted and these heights do not have: isotropy, Gaussian heights."""
        sentences = []
        if self.texture > OBLONG:
            sentences.append(
                f"heights are anisotropic, slopes along one axis {self.texture:.2g} times those along the other: "
                "models of an isotropic spectrum do not hold, boundary elements do."
            )
        if sentence := self.not_gaussian():
            sentences.append(sentence)
        return tuple(sentences)

    def not_gaussian(self) -> str:
        """Skewness, kurtosis and summits of heights in a sentence; empty where they are Gaussian, about."""
        skewness, kurtosis = (
            float(scipy.stats.skew(self.height, axis=None)),
            float(scipy.stats.kurtosis(self.height, axis=None)),
        )
        summits = float(np.quantile(self.height, 0.99)) / self.rms
        if abs(skewness) <= SKEWED and abs(kurtosis) <= PEAKED and summits >= FLAT:
            return ""
        return (
            f"heights are not Gaussian, skewness {skewness:.2g}, excess kurtosis {kurtosis:.2g}, and the highest "
            f"hundredth from {summits:.2g} rms heights on: a spectrum does not describe them fully; boundary elements "
            "use the heights themselves."
        )

    @property
    def gradient(self) -> float:
        """g, the root mean square of abs(grad h), by differences of neighbouring points [-]."""
        return math.hypot(*self._rms_slopes)

    @property
    def slope_along(self) -> float:
        """h', the rms slope along the first axis, in one direction, by the same differences [-]."""
        return self._rms_slopes[0]

    @cached_property
    def _rms_slopes(self) -> tuple[float, float]:
        """Root mean square of dh/dx and of dh/dy, by differences of neighbouring points [-]."""
        along, across = (np.diff(self.height, axis=i) / d for i, d in enumerate(self.spacing))
        return math.sqrt(float(np.mean(along**2))), math.sqrt(float(np.mean(across**2)))

    @cached_property
    def _rings(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """`_spectrum` of these heights, computed once."""
        return _spectrum(self.height, self.spacing)


def check_covers(name: str, heights: MeasuredHeights, sides: tuple[float, float], contact_radius: float) -> None:
    """Raises ValueError for a surface that is smaller than these sides, or whose points miss the contact."""
    if any(side < needed for side, needed in zip(heights.sides, sides, strict=True)):
        long, wide, *actual = (in_unit(side, "length", digits=3) for side in (*sides, *heights.sides))
        raise ValueError(f"{name} must be {long} long and {wide} wide for this contact, got {' and '.join(actual)}")
    if max(heights.spacing) > contact_radius:
        raise ValueError(
            f"heights.spacing must be no more than the contact radius, {contact_radius:.3g} m, got "
            f"{max(heights.spacing):.3g} m"
        )


def check_grid(values: FloatArray) -> None:
    """Raises ValueError for heights along one side, or with few points along one of two."""
    if values.ndim != 2 or min(values.shape) < FEWEST:
        raise ValueError(f"heights must be {FEWEST} points or more along two sides, got shape {values.shape}")


def _subtract_plane(height: FloatArray) -> FloatArray:
    """Heights less their plane of least squares; rows and columns are orthogonal about their middle."""
    x, y = (np.arange(n) - (n - 1) / 2 for n in height.shape)
    slope_x = (height.mean(axis=1) @ x) / (x @ x)
    slope_y = (height.mean(axis=0) @ y) / (y @ y)
    return np.asarray(height - height.mean() - slope_x * x[:, np.newaxis] - slope_y * y)


def _spectrum(height: FloatArray, spacing: tuple[float, float]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Edges of rings and C_2D in each: |H|^2 behind Hann's window, scaled to the mean square of the heights."""
    (nx, ny), (dx, dy) = height.shape, spacing
    hann_x, hann_y = (np.sin(np.pi * (np.arange(n) + 0.5) / n) ** 2 for n in (nx, ny))
    power = np.abs(np.fft.fft2(hann_x[:, np.newaxis] * hann_y * height)) ** 2
    q = np.hypot(2 * np.pi * np.fft.fftfreq(nx, dx)[:, np.newaxis], 2 * np.pi * np.fft.fftfreq(ny, dy))
    first, last = 2 * math.pi / max(nx * dx, ny * dy), math.pi / max(dx, dy)
    rings = max(math.floor(RINGS * math.log2(last / first)), 1)
    edges = first * (last / first) ** (np.arange(rings + 1) / rings)
    # narrow rings around the longest waves may hold none: they go to the next
    counts = np.histogram(q, edges)[0]
    edges = np.concatenate([[edges[0]], edges[1:][np.cumsum(counts > 0) > 0]])
    counts, sums = np.histogram(q, edges)[0], np.histogram(q, edges, weights=power)[0]
    # an empty ring between others has the level of the one before
    level = (sums / np.maximum(counts, 1))[np.maximum.accumulate(np.where(counts > 0, np.arange(counts.size), 0))]
    mean_square = np.pi * float(np.sum(level * np.diff(edges**2)))
    level *= height.var() / mean_square
    return tuple(edges.tolist()), tuple(level.tolist())
