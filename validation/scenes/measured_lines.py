"""Measured lines along a rail, one or several side by side, and their levels."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mdr.checks import finite, positive
from validation.analysis.nominal_bands import NominalBands
from validation.scenes.height_edits import known_heights
from validation.scenes.measured import MeasuredHeights
from validation.scenes.roughness_levels import LEAST, MICROMETRE, RoughnessLevels
from validation.scenes.units import in_unit

FloatArray = NDArray[np.float64]

WAVES_PER_LINE = 4
"""Of the longest band, at the least: with fewer waves it is narrower than what a line resolves."""
POINTS_PER_WAVE = 2.5
"""Of the shortest band, at the least: EN 15610 has 1 mm for 2.5 mm."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MeasuredLines:
    """Heights of parallel lines on a rail.

    Parameters
    ----------
    height : array_like, shape (points, lines) or (points,)
        Heights, positive towards the wheel, the first axis along the track [m].
    spacing : float
        Distance of the points [m].
    positions : sequence of float, optional
        Places of the lines across the track, ascending [m]; of one line they may be left out.
    longest, shortest : float or None, optional
        Nominal wavelengths of the first and the last band [m]. None: all that lines of four waves and points of 2.5
        to a wave have.

    Raises
    ------
    ValueError, TypeError
        If heights are no real numbers, masked or not finite, positions are not one a line and ascending, lines are
        shorter than four of the longest waves, or points are too far apart for the shortest.
    """

    height: FloatArray
    spacing: float
    positions: Sequence[float] = (0.0,)
    longest: float | None = None
    shortest: float | None = None

    def __post_init__(self) -> None:
        values = known_heights(self.height)
        height = values[:, np.newaxis] if values.ndim == 1 else values
        positive("spacing", self.spacing)
        positions = tuple(finite(f"positions[{i}]", position) for i, position in enumerate(self.positions))
        if height.ndim != 2 or height.shape[1] != len(positions):
            raise ValueError(
                f"positions must be one a line, got {len(positions)} for heights of shape {values.shape}, whose first "
                "axis is along the track"
            )
        if not all(np.diff(positions) > 0):
            raise ValueError(f"positions must ascend, got {positions}")
        object.__setattr__(self, "height", height)
        object.__setattr__(self, "positions", positions)
        self._check_bands()

    @classmethod
    def of_heights(cls, heights: MeasuredHeights) -> "MeasuredLines":
        """The lines of a measured surface along its first axis."""
        return cls(height=heights.height, spacing=heights.spacing[0], positions=heights.places[1].tolist())

    @property
    def length(self) -> float:
        """Of each line [m]."""
        return len(self.height) * self.spacing

    @cached_property
    def bands(self) -> NominalBands:
        """Those between the longest and the shortest wavelength."""
        longest = self.length / WAVES_PER_LINE if self.longest is None else self.longest
        shortest = POINTS_PER_WAVE * self.spacing if self.shortest is None else self.shortest
        try:
            return NominalBands().within(longest, shortest)
        except ValueError as reason:
            raise ValueError(
                f"spacing must be that of the points of the lines, as 1 mm, with longest above shortest: {reason}; got "
                f"{len(self.height)} points, {1e3 * self.spacing:g} mm apart"
            ) from None

    @cached_property
    def levels(self) -> RoughnessLevels:
        """Levels of the mean energy of all lines, which expects that of one and scatters less."""
        powers = self.bands.powers_of_records(self.height.T, spacing=self.spacing).mean(axis=0)
        empty = powers < MICROMETRE**2 * 10 ** (LEAST / 10)
        if empty.any() and not empty.all():
            raise ValueError(
                f"levels must lie above {LEAST:g} dB re 1 um, got less in bands of {self.bands.names(empty)}: longest "
                "and shortest leave them out, or is the unit another?"
            )
        count = len(self.positions)
        source = f"{count} measured {'line' if count == 1 else 'lines'}"
        return RoughnessLevels.of_powers(self.bands, powers, source=source)

    def _check_bands(self) -> None:
        slack = 1 + 1e-9
        if self.longest is not None and self.longest * WAVES_PER_LINE > self.length * slack:
            shown = [in_unit(value, "length") for value in (positive("longest", self.longest), self.length)]
            raise ValueError(f"longest must be a quarter of the lines at the most, {shown[1]} long, got {shown[0]}")
        if self.shortest is not None and self.shortest * slack < self.spacing * POINTS_PER_WAVE:
            shown = [in_unit(value, "length") for value in (positive("shortest", self.shortest), self.spacing)]
            raise ValueError(f"shortest must be {POINTS_PER_WAVE} points or more, {shown[1]} apart, got {shown[0]}")
        _ = self.bands
