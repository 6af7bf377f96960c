"""A wheel with two radii on springs: the foundation that has the load curve and the contact length of the ellipse."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy

from mdr.checks import positive


class SpringWheel(NamedTuple):
    """Radius R_1 of the profile x^2 / R_1, modulus E_1 of the springs, a_y / a_x of the contact that they stand for."""

    radius: float
    modulus: float
    aspect: float


def spring_wheel(radius: float | Sequence[float], modulus: float) -> SpringWheel:
    """The wheel on springs, for a radius R or two, (along, across) the track.

    Hertz on an ellipse with the semi-axis a_x along the track, the larger one a, has R_1 = a_x^2 / d and
    F = 2/3 pi E* a d / K(e) = 4/3 E_1 a_x d, so that E_1 = pi E* a / (2 K a_x); of a sphere, R and E*. The load curve
    and the force over ridges across the track are those of the half-space. Source: Johnson, Contact Mechanics, 4.2;
    Popov and Hess, (14.2).
    """
    if not isinstance(radius, (Sequence, np.ndarray)) or isinstance(radius, str) or np.ndim(radius) == 0:
        return SpringWheel(positive("radius", radius), positive("modulus", modulus), 1.0)
    if len(radius) != 2:
        raise ValueError(f"radius must be one number or two (along, across), got {radius!r}")
    along, across = positive("radius[0]", radius[0]), positive("radius[1]", radius[1])
    modulus = positive("modulus", modulus)
    if along == across:
        return SpringWheel(along, modulus, 1.0)
    larger = max(along, across)
    k = _axis_ratio(min(along, across) / larger)
    whole = float(scipy.special.ellipkm1(k**2))
    major = 2 * larger * _integral(k) / whole
    if along == larger:
        return SpringWheel(major, modulus * math.pi / (2 * whole), k)
    return SpringWheel(k**2 * major, modulus * math.pi / (2 * whole * k), 1 / k)


def _axis_ratio(radius_ratio: float) -> float:
    """k = b / a of the contact of radii whose ratio, below one, is k^2 D(k) / (K - D), D = (K - E) / e^2."""

    def excess(log_k: float) -> float:
        k = math.exp(log_k)
        d = _integral(k)
        return math.log(k**2 * d / (float(scipy.special.ellipkm1(k**2)) - d) / radius_ratio)

    return math.exp(scipy.optimize.brentq(excess, math.log(radius_ratio), 0.0, xtol=1e-15))


def _integral(k: float) -> float:
    """(K - E) / e^2 = R_D(0, k^2, 1) / 3, which keeps its digits where k is near one."""
    return float(scipy.special.elliprd(0, k**2, 1)) / 3
