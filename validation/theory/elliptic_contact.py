"""The contact of two bodies with two radii each: Hertz on an ellipse. A reference, which imports neither method.

With k = b/a, the ratio of the semi-axes, and Carlson's integral R_D, D = R_D(0, k^2, 1) / 3 is (K - E) / e^2 of the
textbooks without its loss of digits near the circle. Source: Johnson, Contact Mechanics, chapter 4.
"""

import math
from dataclasses import dataclass

import scipy
from scipy import special

from validation.theory.closed_forms import positive


@dataclass(frozen=True, kw_only=True)
class EllipticContact:
    """Semi-axes along x and y [m], approach [m], force [N], largest pressure [Pa], stiffness dF/dd [N/m]."""

    along: float
    across: float
    approach: float
    force: float
    pressure: float
    stiffness: float

    @property
    def semi_axes(self) -> tuple[float, float]:
        return self.along, self.across


def elliptic_contact(
    radii: tuple[float, float], *, modulus: float, force: float | None = None, approach: float | None = None
) -> EllipticContact:
    """The contact under a force or at an approach; exactly one of the two is given.

    radii: along and across [m], each of both bodies together: 1/R is the sum of their curvatures. With R_a the larger:
    R_b / R_a = R_D(0, k^2, 1) / R_D(0, 1, k^2), a^3 = 3 F R_a D / (pi E*), d = a^2 K / (2 R_a D),
    p_0 = 3 F / (2 pi a b), dF/dd = pi E* a / K = 3 F / (2 d).
    """
    positive(along=radii[0], across=radii[1], modulus=modulus)
    long, short = max(radii), min(radii)
    k = _axis_ratio(short / long)
    d, first_kind = float(special.elliprd(0, k**2, 1)) / 3, float(special.elliprf(0, k**2, 1))
    if force is not None and approach is None:
        positive(force=force)
        a = math.cbrt(3 * force / modulus * long * d / math.pi)
        approach = a**2 / long * first_kind / (2 * d)
    elif approach is not None and force is None:
        positive(approach=approach)
        a = math.sqrt(2 * d * long * approach / first_kind)
    else:
        raise ValueError(f"one of force and approach must be given, got force {force} and approach {approach}")
    stiffness = math.pi * modulus * a / first_kind
    load = 2 / 3 * stiffness * approach
    axes = (a, k * a) if radii[0] >= radii[1] else (k * a, a)
    pressure = 1.5 * load / (math.pi * a * k * a)
    return EllipticContact(
        along=axes[0], across=axes[1], approach=approach, force=load, pressure=pressure, stiffness=stiffness
    )


def _axis_ratio(radius_ratio: float) -> float:
    """b/a from R_b / R_a, both one at the most: it lies between that and one."""
    if radius_ratio == 1:
        return 1.0

    def excess(log_k: float) -> float:
        square = math.exp(2 * log_k)
        return math.log(float(special.elliprd(0, square, 1) / special.elliprd(0, 1, square)) / radius_ratio)

    return math.exp(scipy.optimize.brentq(excess, math.log(radius_ratio), 0.0, xtol=1e-15))
