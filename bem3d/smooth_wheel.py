"""The smooth wheel: its contact with two radii, Hertz on an ellipse, or its measured profile across the track."""

import math
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from bem3d.checks import FloatArray, finite_row


@dataclass(frozen=True, kw_only=True)
class SmoothContact:
    """What two radii make of Hertz: at an approach d, semi-axes sqrt(along d) and sqrt(across d).

    along, across: squares of the semi-axes over the approach [m]; sphere: radius of the sphere with the same load
    curve, F = 4/3 E* sqrt(R) d^(3/2) [m]. For two equal radii all three are that radius.
    """

    along: float
    across: float
    sphere: float

    def semi_axes(self, approach: float) -> tuple[float, float]:
        """Along and across the track; zero where there is no contact [m]."""
        d = max(approach, 0.0)
        return math.sqrt(self.along * d), math.sqrt(self.across * d)

    def approach(self, force_over_modulus: float) -> float:
        """d = (9 F^2 / (16 R E*^2))^(1/3) of the sphere [m]."""
        return float(np.cbrt(9 / 16 / self.sphere) * np.cbrt(force_over_modulus) ** 2)


def smooth_contact(radii: tuple[float, float]) -> SmoothContact:
    """Of radii along and across.

    R_a: the larger; with k = b/a and Carlson's integrals, D = R_D(0, k^2, 1) / 3:
    R_b / R_a = R_D(0, k^2, 1) / R_D(0, 1, k^2), a^2 / d = 2 R_a D / K, sqrt(R) = pi / (2 K) sqrt(a^2 / d).
    Source: Johnson, Contact Mechanics, chapter 4, without the difference K - E, which loses digits near the circle.
    """
    larger, smaller = max(radii), min(radii)
    if larger == smaller:
        return SmoothContact(along=larger, across=larger, sphere=larger)
    square = _axis_ratio(smaller / larger) ** 2
    first_kind = float(scipy.special.elliprf(0, square, 1))
    major = 2 * larger * float(scipy.special.elliprd(0, square, 1)) / (3 * first_kind)
    along, across = (major, square * major) if radii[0] == larger else (square * major, major)
    return SmoothContact(along=along, across=across, sphere=(math.pi / (2 * first_kind)) ** 2 * major)


def _axis_ratio(radius_ratio: float) -> float:
    """k = b/a from R_b / R_a below one: k lies between that and one."""

    def excess(log_k: float) -> float:
        square = math.exp(2 * log_k)
        return math.log(float(scipy.special.elliprd(0, square, 1) / scipy.special.elliprd(0, 1, square)) / radius_ratio)

    return math.exp(scipy.optimize.brentq(excess, math.log(radius_ratio), 0.0, xtol=1e-15))


def checked_profile(values: ArrayLike, columns: int, step: float) -> FloatArray:
    """Heights of a profile [m], one a column `step` apart, zero at the highest point.

    Raises ValueError for another length, for a highest point that is not zero to within what a column may miss of a
    top, and where the profile does not fall from it to both sides, by half of the columns or more.
    """
    z = finite_row("transverse_profile", values, columns)
    top, highest = int(z.argmax()), float(z.max())
    if not 0 < top < columns - 1:
        raise ValueError(f"transverse_profile must be highest inside of the strip, got its top in column {top}")
    missed = highest - min(z[top - 1], z[top + 1])
    if not -missed <= highest <= 0:
        raise ValueError(f"transverse_profile must be zero at its highest point, got {highest:.6g} m")
    if not np.isfinite(equivalent_radius(z, step)):
        raise ValueError("transverse_profile must fall from its highest point to both sides, got a flat one")
    return z


def top_column(z: FloatArray) -> float:
    """Where a profile is highest; between two columns where both are [columns]."""
    return float(np.flatnonzero(z == z.max()).mean())


def equivalent_radius(z: FloatArray, step: float) -> float:
    """The median of -y^2 / (2 z) over all columns, y from the top: R of a parabola, about that of others [m].

    With it the contact without roughness is expected, from which a solve begins.
    """
    y = (np.arange(z.size) - top_column(z)) * step
    beside = y != 0
    with np.errstate(divide="ignore"):
        return float(np.median(-(y[beside] ** 2) / (2 * z[beside])))
