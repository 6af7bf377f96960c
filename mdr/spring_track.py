"""The springs along a periodic track, and the wheel above them."""

import math

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import FloatArray, finite_array, positive, stiffness_of_springs
from mdr.diagnostics import SpringContactWarning, diagnose_units, diagnose_wheel

MOST_SPRINGS = 2**28
"""To each side of a wheel: more would take gigabytes and hours."""


class SpringTrack:
    """Heights of the springs along the track, and the wheel."""

    def __init__(self, height: ArrayLike, spacing: float, radius: float, modulus: float):
        self.height = finite_array("height", height, ndim=1)
        self.spacing, self.radius = positive("spacing", spacing), positive("radius", radius)
        self.modulus = positive("modulus", modulus)
        self.spring = stiffness_of_springs("spacing", self.modulus, self.spacing)
        self._profile = np.empty(0)

    @property
    def points(self) -> int:
        """Springs of the track."""
        return self.height.size

    def diagnose(self, approach: float) -> tuple[SpringContactWarning, ...]:
        """Diagnostics of the contact of the smooth wheel."""
        if not approach > 0:
            return ()
        units = diagnose_units(approach=approach, radius=self.radius)
        return (*diagnose_wheel(2 * math.sqrt(self.radius * approach) / self.spacing), *units)

    def longer_than(self, contact: float) -> None:
        """Refuse a track that the wheel covers as a whole."""
        length = self.height.size * self.spacing
        if length <= contact:
            raise ValueError(f"height must be longer than the contact, {contact:.6g} m, got a track of {length:.6g} m")

    def wheel(self, j: int | FloatArray) -> float | FloatArray:
        """x^2 / R of the wheel, j springs from its middle."""
        return (j * self.spacing) ** 2 / self.radius

    def profile(self, reach: int) -> FloatArray:
        """`wheel` of 0, 1 .. reach, kept; each by itself, since an array is not squared to the same last digit."""
        if self._profile.size <= reach:
            more = range(self._profile.size, max(reach + 1, 2 * self._profile.size))
            self._profile = np.concatenate([self._profile, [self.wheel(j) for j in more]])
        return self._profile

    def distance(self, level: float) -> float:
        """Springs to each side, and parts of one, at which the wheel's profile is so high."""
        return math.sqrt(max(level, 0.0)) * math.sqrt(self.radius) / self.spacing

    def reach(self, level: float) -> int:
        """Springs to each side at which the wheel's profile stays below a level; -1 where nowhere."""
        if level <= 0:
            return -1
        about = self.distance(level)
        if not about < MOST_SPRINGS:
            raise ValueError(
                f"spacing must be larger, or height, radius and load smaller: the wheel overlaps heights to "
                f"{about:.3g} springs on each side, more than {MOST_SPRINGS}"
            )
        j = int(about)
        # by the profile as it is rounded, not by its root
        while self.wheel(j) >= level:
            j -= 1
        while self.wheel(j + 1) < level:
            j += 1
        return j
