"""The mean contact of a rough wheel by Greenwood and Tripp: pressure and its tangent over the distance from the centre.

Units: a = d = E* = 1 of the smooth wheel, so R = 1. Rings of uniform pressure on the half-space, K p + r^2 / 2 - d =
g(p): the mean gap g under a mean pressure p belongs to the roughness. Source: Greenwood and Tripp, 1967.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
import scipy
from numpy.typing import ArrayLike
from scipy import special

from validation.engine.engine import FloatArray

EDGES = np.linspace(0.0, 3.0, 49)
RADII, AREAS = (EDGES[1:] + EDGES[:-1]) / 2, np.pi * np.diff(EDGES**2)
"""Radii and areas of rings of equal width."""
SOFTEST = 1e-3
"""-dg / d ln p at the least: without it a smooth wheel has no tangent outside of its contact."""
LOWEST = -300.0
"""ln p, below which nothing touches."""
STEPS = 300
"""Most steps of Newton's method, each at most one in ln p."""


class GapLaw:
    """The mean gap g under a mean pressure p, interpolated in ln p; it is made to decrease, and extrapolated below."""

    def __init__(self, pressures: FloatArray, gaps: FloatArray) -> None:
        logs = np.log(pressures)
        falling = np.minimum.accumulate(np.maximum(gaps, 0.0)) + SOFTEST * (logs[-1] - logs)
        self._law = scipy.interpolate.PchipInterpolator(logs, falling)
        self._slope = self._law.derivative()
        self._ends = logs[[0, -1]]

    def __call__(self, log_pressure: FloatArray) -> tuple[FloatArray, FloatArray]:
        """g and dg / d ln p; above the highest pressure, as at it."""
        inside = np.clip(log_pressure, *self._ends)
        slope = np.asarray(self._slope(inside))
        below = np.minimum(log_pressure - inside, 0.0)
        return np.asarray(self._law(inside) + slope * below), np.where(log_pressure > self._ends[1], -SOFTEST, slope)


@dataclass(frozen=True, eq=False)
class MeanContact:
    """Rings at `RADII` have pressure p, tangent P = dp/dd and displacement K P; their sums are force and stiffness."""

    pressure: FloatArray
    tangent: FloatArray
    displaced: FloatArray

    @property
    def force(self) -> float:
        return float(self.pressure @ AREAS)

    @property
    def stiffness(self) -> float:
        return float(self.tangent @ AREAS)


def mean_contact(law: GapLaw, approach: float) -> MeanContact:
    """The mean contact at an approach, by Newton's method on ln p. ArithmeticError where it does not converge."""
    operator, r = ring_operator(), RADII
    log_p = np.log(2 / np.pi * np.sqrt(np.maximum(approach - r**2 / 2, 0.0)) + 1e-3 * np.exp(-(r**2) / 2))
    for _ in range(STEPS):
        touching = np.flatnonzero(log_p > LOWEST)
        p = np.exp(log_p[touching])
        gap, slope = law(log_p[touching])
        k = operator[np.ix_(touching, touching)]
        step = np.linalg.solve(k * p - np.diag(slope), gap - k @ p - r[touching] ** 2 / 2 + approach)
        log_p[touching] += np.clip(step, -1.0, 1.0)
        if np.abs(step[p > 1e-12]).max(initial=0.0) < 1e-7:
            break
    else:
        raise ArithmeticError(f"the mean contact at the approach {approach:g} does not converge in {STEPS} steps")
    pressure, tangent = np.zeros((2, r.size))
    pressure[touching] = p
    # K P - g'(p) P = 1 with P = p T: the tangent of ln p is bounded where p vanishes
    tangent[touching] = p * np.linalg.solve(k * p - np.diag(slope), np.ones(touching.size))
    return MeanContact(pressure, tangent, operator @ tangent)


@cache
def ring_operator() -> FloatArray:
    """Displacement at the middle of each ring under unit pressure on each: differences of discs."""
    return np.asarray(np.diff([under_disc(RADII, radius) for radius in EDGES], axis=0).T)


def under_disc(r: ArrayLike, radius: float) -> FloatArray:
    """u(r) under unit pressure on a disc, E* = 1.

    4 c / pi E(r^2/c^2) inside; 4 r / pi (E(m) - (1 - m) K(m)), m = c^2/r^2, outside.
    Source: Johnson, Contact Mechanics, 3.4.
    """
    r = np.asarray(r, dtype=np.float64)
    if radius == 0:
        return np.zeros_like(r)
    inside = 4 * radius / np.pi * special.ellipe(np.minimum((r / radius) ** 2, 1.0))
    m = (radius / np.maximum(r, radius)) ** 2
    outside = 4 * r / np.pi * (special.ellipe(m) - (1 - m) * special.ellipk(np.minimum(m, 1 - 1e-15)))
    return np.asarray(np.where(r <= radius, inside, outside))
