"""A wheel above a rough strip, and the frame that moves along with it."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from bem3d.checks import BoolArray, FloatArray, IndexArray, OneOrTwo, grid_spacing, positive, positive_pair, strip
from bem3d.diagnostics import ContactWarning, diagnose_sphere, diagnose_units, typical_slope
from bem3d.halfspace import HalfSpace
from bem3d.results import ReadOnly, kept, line, pair, span
from bem3d.smooth_wheel import SmoothContact, checked_profile, equivalent_radius, smooth_contact, top_column
from bem3d.window import Box, fast_side

Span = tuple[int, int]
Spans = tuple[Span, Span]
"""Rows from, to, counted from the wheel's cell; columns from, to, of the strip."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Track(ReadOnly):
    """Rough strip, periodic along axis 0, and a rigid wheel that rolls along its middle.

    Parameters
    ----------
    height : array_like, shape (nx, ny)
        Heights, positive towards the wheel [m].
    spacing : float or tuple of float
        Sides of a cell, one number or (dx, dy) [m].
    radius : float or tuple of float
        Radius R of a sphere, or (along, across) the track [m]. Curvatures of two bodies add: 1/R = 1/R_1 + 1/R_2.
    modulus : float
        Contact modulus E* [Pa].
    transverse_profile : array_like, shape (ny,), optional
        Heights z of both bodies across the track, in place of R_y: one a column, positive towards the other body, those
        of two bodies added, zero at the highest point [m]. ``radius`` is then one number.

    Raises
    ------
    ValueError, TypeError
        If an argument is out of range; the message names it.

    Notes
    -----
    With the wheel at x_i the gap is g = (x - x_i)^2 / (2 R_x) + y^2 / (2 R_y) - h(x, y), y = 0 in the middle of
    axis 1, or g = (x - x_i)^2 / (2 R_x) - z(y) - h(x, y). A contact longer than a period meets the same roughness
    again. A profile falls from its highest point, which lies inside; the contact may be of several parts.

    Examples
    --------
    >>> track = bem3d.Track(height=np.zeros((64, 32)), spacing=1e-4, radius=0.5, modulus=2e11)
    >>> track.steps, track.highest
    ((0.0001, 0.0001), 0.0)
    """

    height: FloatArray
    spacing: OneOrTwo
    radius: OneOrTwo
    modulus: float
    transverse_profile: FloatArray | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "height", kept(strip("height", self.height)))
        object.__setattr__(self, "spacing", grid_spacing(self.spacing))
        object.__setattr__(self, "modulus", positive("modulus", self.modulus))
        if self.transverse_profile is None:
            object.__setattr__(self, "radius", positive_pair("radius", self.radius, "(along, across)"))
        else:
            z = checked_profile(self.transverse_profile, self.height.shape[1], self.steps[1])
            object.__setattr__(self, "transverse_profile", kept(z))
            radii = positive("radius", self.radius), equivalent_radius(z, self.steps[1])
            object.__setattr__(self, "radius", radii)

    def __repr__(self) -> str:
        cells, profile = " x ".join(map(str, self.height.shape)), self.transverse_profile
        radius, spacing = (pair("m", *both) for both in (self.radii, self.steps))
        across = f"radius={radius}" if profile is None else f"radius={span(self.radii[0], 'm')}"
        across += "" if profile is None else f", transverse_profile={span(profile, 'm')}"
        height, modulus = span(self.height, "m"), span(self.modulus, "Pa")
        return line(f"Track({cells} cells of {spacing}, height={height}, {across}, modulus={modulus})")

    @cached_property
    def highest(self) -> float:
        """The highest point of the strip [m]."""
        return float(self.height.max())

    @property
    def cell_area(self) -> float:
        """dx dy [m^2]."""
        return self.steps[0] * self.steps[1]

    @property
    def steps(self) -> tuple[float, float]:
        """Spacing along both axes (dx, dy) [m]."""
        dx, dy = self.spacing  # type: ignore[misc]
        return dx, dy

    @property
    def radii(self) -> tuple[float, float]:
        """Of the wheel, along and across the track (R_x, R_y); of a profile, about [m]."""
        along, across = self.radius  # type: ignore[misc]
        return along, across

    @cached_property
    def smooth(self) -> SmoothContact:
        """The contact without roughness."""
        return smooth_contact(self.radii)

    def half_space(self, shape: tuple[int, int]) -> HalfSpace:
        """The half-space under a frame of that shape; all are kept, with their plans."""
        if shape not in self._half_spaces:
            self._half_spaces[shape] = HalfSpace(shape=shape, spacing=self.spacing, modulus=self.modulus)
        return self._half_spaces[shape]

    @cached_property
    def _half_spaces(self) -> dict[tuple[int, int], HalfSpace]:
        return {}

    def wheel(self, rows: IndexArray, columns: IndexArray) -> FloatArray:
        """x^2 / (2 R_x) + y^2 / (2 R_y), or - z(y), at cells `rows` ahead and columns of the strip, broadcast [m]."""
        x, y, (along, across) = self.along(rows), self.across(columns), self.radii
        if self.transverse_profile is not None:
            return np.asarray(x**2 / (2 * along) - self.transverse_profile[columns])
        return np.asarray((x**2 + along / across * y**2) / (2 * along))

    def along(self, rows: IndexArray) -> FloatArray:
        """x of cells so many rows ahead of the wheel [m]."""
        return np.asarray(rows * self.steps[0])

    def across(self, columns: IndexArray) -> FloatArray:
        """y of columns of the strip [m]."""
        return np.asarray((columns - (self.height.shape[1] - 1) / 2) * self.steps[1])

    def smooth_contact(self, approach: float) -> Spans:
        """Of the cells under the smooth wheel, one at least, as far as the strip has them."""
        ny, (dx, dy), (a, b) = self.height.shape[1], self.steps, self.smooth.semi_axes(approach)
        # one column more: of an even number of them the middle lies between two
        ahead, across = int(a / dx), min(int(b / dy) + 1, ny // 2)
        middle = (ny - 1) / 2 if self.transverse_profile is None else top_column(self.transverse_profile)
        first, last = max(math.ceil(middle) - across, 0), min(math.floor(middle) + 1 + across, ny)
        return (-ahead, ahead + 1), (first, last)

    def diagnose(self, approach: float) -> tuple[ContactWarning, ...]:
        """Diagnostics of the contact of the smooth wheel, F / (pi a b) on average by Hertz."""
        (nx, ny), (dx, dy), smooth = self.height.shape, self.steps, self.smooth
        area = math.pi * math.sqrt(smooth.along * smooth.across) * approach
        pressure = 4 / 3 * math.sqrt(smooth.sphere * approach) * (approach / area) * self.modulus
        units = diagnose_units(
            pressure=pressure,
            modulus=self.modulus,
            approach=approach,
            side=max(nx * dx, ny * dy),
            slope=typical_slope(self.height, self.steps),
        )
        return (*diagnose_sphere(area / self.cell_area), *units)

    def reach(self, approach: float) -> int:
        """How many rows ahead and behind a cell can overlap at this approach [m]."""
        return int(np.sqrt(2 * self.radii[0] * max(approach + self.highest, 0.0)) / self.steps[0])

    def widened(self, spans: Spans, margin: int) -> Spans:
        """Spans that hold these and a margin, of sides that transform fast; columns as far as the strip has them."""
        # the strip is periodic along the track: rows have no end
        rows, ny = _widened(spans[0], margin, sys.maxsize), self.height.shape[1]
        first, last = _widened(spans[1], margin, ny)
        # moved inward at an edge, not shortened: the length is one that transforms fast
        start = min(max(first, 0), ny - (last - first))
        return rows, (start, start + last - first)


class Frame:
    """A window that moves with the wheel: the only cells that are solved on.

    spans: rows from, to, counted from the wheel's cell; columns from, to, of the strip.
    """

    def __init__(self, track: Track, spans: Spans):
        self.track, self.spans = track, spans
        self.rows, self.columns = spans
        self.shape = self.rows[1] - self.rows[0], self.columns[1] - self.columns[0]
        self.half_space = track.half_space(self.shape)
        self._ahead, self._across = np.arange(*self.rows), np.arange(*self.columns)
        self._wheel = track.wheel(self._ahead[:, np.newaxis], self._across)
        self._limit = -np.inf

    def within(self, other: Frame) -> bool:
        """Whether all of it is part of another frame."""
        return joined(self.spans, other.spans) == other.spans

    def box(self, spans: Spans) -> Box:
        """Where a part of it lies in its fields."""
        rows, columns = spans
        return (
            slice(rows[0] - self.rows[0], rows[1] - self.rows[0]),
            slice(columns[0] - self.columns[0], columns[1] - self.columns[0]),
        )

    def take(self, field: FloatArray, frame: Frame) -> FloatArray:
        """A field of another frame under the same wheel, zero where that one does not reach."""
        here = np.zeros(self.shape)
        common = common_part(self.spans, frame.spans)
        here[self.box(common)] = field[frame.box(common)]
        return here

    def gap(self, position: int) -> FloatArray:
        """Undeformed separation in the frame [m]."""
        rows = self.track.height.take(self._ahead + position, axis=0, mode="wrap")
        return np.asarray(self._wheel - rows[:, slice(*self.columns)])

    def spans_of(self, marked: BoolArray) -> Spans:
        """Of all marked cells, one at least."""
        ahead, across = np.flatnonzero(marked.any(axis=1)), np.flatnonzero(marked.any(axis=0))
        return (
            (int(ahead[0]) + self.rows[0], int(ahead[-1]) + 1 + self.rows[0]),
            (int(across[0]) + self.columns[0], int(across[-1]) + 1 + self.columns[0]),
        )

    def at_edge(self, pressure: FloatArray) -> bool:
        """Whether a first or last column of the strip carries pressure, beyond which nothing is known."""
        first = self.columns[0] == 0 and bool(pressure[:, 0].any())
        return first or (self.columns[1] == self.track.height.shape[1] and bool(pressure[:, -1].any()))

    def outside(self, position: int, approach: float, pressure: FloatArray) -> Spans | None:
        """Spans of the frame and of cells outside that may touch; None where none does.

        A force F, whose pressure has its centre at c and the variance s^2 about it, moves the surface at r by
        u >= F / (pi E* sqrt(|r - c|^2 + s^2)), whatever its distribution: the mean of 1/X is at least 1 over the mean
        of X, and that at least 1 over the root mean square. Where g + u > d even so, there is no contact.
        """
        # 1. the cells outside that overlap geometrically: others cannot touch, since u >= 0 for p >= 0
        if approach > self._limit:
            self._survey(approach)
        if not self._rim_wheel.size:
            return None
        track = self.track
        # 2. the least displacement there, from three moments of the pressure
        force, centre, variance = self._moments(pressure)
        distance = np.sqrt((self._rim_x - centre[0]) ** 2 + (self._rim_y - centre[1]) ** 2 + variance)
        least = force / (np.pi * track.modulus) / distance
        # flat indices wrap by whole rows: columns stay, and the track begins anew
        height = track.height.ravel().take(self._rim + position * track.height.shape[1], mode="wrap")
        # 3. what would touch in spite of it: none is the proof that the frame has the whole contact
        touching = np.flatnonzero(self._rim_wheel - height + least < approach)
        if not touching.size:
            return None
        ny = track.height.shape[1]
        # floored: rows behind the wheel are negative
        ahead, across = self._rim[touching] // ny, self._rim[touching] % ny
        found = (int(ahead.min()), int(ahead.max()) + 1), (int(across.min()), int(across.max()) + 1)
        return joined((self.rows, self.columns), found)

    def _survey(self, approach: float) -> None:
        """List the cells outside that overlap somewhere along the track, up to a little more than this approach."""
        track, ny = self.track, self.track.height.shape[1]
        # a little farther, so that approaches that rise slowly need no survey at each position
        self._limit = approach + 0.05 * abs(approach)
        most = track.reach(self._limit)
        ahead = np.arange(-most, most + 1)[:, np.newaxis]
        across = np.arange(ny)
        inside = (ahead >= self.rows[0]) & (ahead < self.rows[1])
        inside = inside & (across >= self.columns[0]) & (across < self.columns[1])
        # by the highest point of the track: the list holds at every position
        rim = np.nonzero(~inside & (track.wheel(ahead, across) < self._limit + track.highest))
        rows, columns = rim[0] - most, rim[1]
        self._rim = rows * ny + columns
        self._rim_x, self._rim_y = track.along(rows), track.across(columns)
        self._rim_wheel = track.wheel(rows, columns)

    def _moments(self, pressure: FloatArray) -> tuple[float, tuple[float, float], float]:
        """Force [N], its centre [m] and the mean square distance from it [m^2]; each cell pressed evenly."""
        total = float(pressure.sum())
        if total == 0:
            return 0.0, (0.0, 0.0), 1.0
        dx, dy = self.track.steps
        # a cell's own spread: points in their places would be nearer together, and the bound too high
        centre, variance = [], (dx**2 + dy**2) / 12
        for axis, places in ((1, self.track.along(self._ahead)), (0, self.track.across(self._across))):
            share = pressure.sum(axis=axis) / total
            mean = float((share * places).sum())
            centre.append(mean)
            variance += float((share * (places - mean) ** 2).sum())
        return total * dx * dy, (centre[0], centre[1]), variance


def joined(spans: Spans, others: Spans) -> Spans:
    """The smallest spans that hold both."""
    rows, columns = ((min(a[0], b[0]), max(a[1], b[1])) for a, b in zip(spans, others, strict=True))
    return rows, columns


def common_part(spans: Spans, others: Spans) -> Spans:
    """What both hold."""
    rows, columns = ((max(a[0], b[0]), min(a[1], b[1])) for a, b in zip(spans, others, strict=True))
    return rows, columns


def _widened(span: Span, margin: int, most: int) -> Span:
    """A span widened on both sides to a length that transforms fast, as far as there are cells."""
    length = fast_side(span[1] - span[0] + 2 * margin, most)
    first = span[0] - (length - (span[1] - span[0])) // 2
    return first, first + length
