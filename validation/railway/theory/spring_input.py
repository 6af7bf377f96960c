"""Input spectra of springs along a rail in place of the line itself: the rolling spectrum, and that of Geike's rule.

Both are power spectral densities of one dimension, made from a surface C(k_x, k_y) [m^4] that a line sees as
C_line(k_x) = int C dk_y [m^3]. Two-sided; wavenumbers in rad/m, x along the track; semi-axes in metres.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from validation.railway.theory.transverse_structure import IsotropicGround
from validation.theory.closed_forms import positive

FloatArray = NDArray[np.float64]


def rolling_input_filter(along: ArrayLike, across: ArrayLike, *, semi_axes: tuple[float, float]) -> FloatArray:
    """sqrt(e(S) / e(k_x a_x)), e(t) = 1 / (1 + t^2): from a surface to the line under springs that roll [-].

    S^2 = (k_x a_x)^2 + (k_y a_y)^2. The filtered surface has the line spectrum int e(S) / e(k_x a_x) C dk_y, the
    rolling spectrum of springs on an ellipse; on a circle over isotropic ground it is that of a wheel. e goes as the
    mean of sin^2(t) / t^2 over its oscillation, for long waves and, but for a factor that the ratio does not have, for
    short ones: the force of springs on this line has the level of the half-space where all waves are long or all are
    short. Over ridges, k_y = 0, it is the line itself.

    along, across: k_x and k_y of any sign, of shapes that go together, whose common shape is returned; semi_axes: a_x
    and a_y, positive. Raises ValueError for other semi-axes. Source: linear elasticity of an ellipse that keeps its
    size, sin(S) / S, by reciprocity with the flat elliptic punch.
    """
    a, b = semi_axes
    positive(along=a, across=b)
    x, y = (np.asarray(k, dtype=np.float64) for k in (along, across))
    own = (x * a) ** 2
    return np.asarray(np.sqrt((1 + own) / (1 + own + (y * b) ** 2)))


def geike_over_line(wavenumber: ArrayLike, ground: IsotropicGround) -> FloatArray:
    """pi q C_2D(q) / C_line(q): power of the line of Geike's rule over that of a line on the same surface [-].

    wavenumber: q of any sign but zero, whose shape is returned; ground: the isotropic surface. Raises ValueError for a
    wavenumber of zero. Source: Popov and Hess, (10.12); the line trace by `line_spectrum`.
    """
    q = np.abs(np.asarray(wavenumber, dtype=np.float64))
    if not (q > 0).all():
        raise ValueError("wavenumber must not be zero, got a zero: a ratio of spectra has no value there")
    return np.asarray(math.pi * q * ground.c2d(q) / ground.line_power(q))
