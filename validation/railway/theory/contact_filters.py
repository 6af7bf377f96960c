"""Contact filters of a rolling wheel on an elliptic contact: from the height of a wave to the displacement, 1 if long.

Waves h exp(i (k_x x + k_y y)), x along the track; S^2 = (k_x a_x)^2 + (k_y a_y)^2. Wavenumbers in rad/m, of any shapes
that go together; semi-axes in metres.
"""

import math
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from validation.railway.theory.transverse_structure import FAR, WaveBand
from validation.theory.closed_forms import positive
from validation.theory.half_space import on_panels

FloatArray = NDArray[np.float64]

NODES = 16
"""Of Gauss and Legendre, on a panel of a turn of J_1^2 at the most."""


def half_space_filter(along: ArrayLike, across: ArrayLike, *, semi_axes: tuple[float, float]) -> FloatArray:
    """sin(S) / S: the half-space under an ellipse that keeps its size, by reciprocity with the flat elliptic punch.

    Over ridges, k_y = 0, it is that of springs, (14.11). Source: Popov and Hess; Johnson, Contact Mechanics, chapter 3.
    """
    return np.asarray(np.sinc(_phase(along, across, semi_axes) / np.pi))


def spring_bed_filter(along: ArrayLike, across: ArrayLike, *, semi_axes: tuple[float, float]) -> FloatArray:
    """2 J_1(S) / S: a two-dimensional bed of equal springs that keep their contact, the linear DPRS.

    Source: Remington and Webb, J. Sound Vib. 193 (1996) 83; Ford and Thompson, J. Sound Vib. 293 (2006) 769.
    """
    phase = _phase(along, across, semi_axes)
    return np.asarray(np.where(phase > 0, 2 * special.j1(phase) / np.where(phase > 0, phase, 1.0), 1.0))


def row_of_means_filter(along: ArrayLike, across: ArrayLike, *, semi_axes: tuple[float, float]) -> FloatArray:
    """sin(k_x a_x) / (k_x a_x) sin(k_y a_y) / (k_y a_y): a row of springs on the mean of the heights over 2 a_y.

    The contact is a rectangle of equal weights; a row of springs on a single line has the first factor alone.
    """
    first, second = (_phase(k, 0.0, (a, 1.0)) for k, a in zip((along, across), semi_axes, strict=True))
    return np.asarray(np.sinc(first / np.pi) * np.sinc(second / np.pi))


def remington_filter(wavenumber: ArrayLike, *, radius: float, alpha: float) -> FloatArray:
    """abs(H)^2 = 4 / (alpha (k b)^2) int_0^{atan alpha} J_1(k b sec x)^2 dx: Remington's closed form, as a power.

    It is the linear bed of springs on a circle of radius b, in the mean over waves with abs(k_y) < alpha k_x of equal
    power; tan x = k_y / k_x. 1 for long waves. wavenumber: k_x, zero or positive; alpha: positive.
    """
    positive(radius=radius, alpha=alpha)
    kb = np.asarray(wavenumber, dtype=np.float64) * radius
    if kb.min(initial=np.inf) > FAR:
        # the same mean over k_y / k_x, of which not all periods are needed
        return WaveBand(alpha).mean_square(kb, partial(spring_bed_filter, semi_axes=(1.0, 1.0)), semi_axis=1.0)
    largest = float(kb.max(initial=0.0)) * math.hypot(1, alpha)
    panels = 1 + math.ceil(largest / math.pi) + math.ceil(math.atan(alpha) * 4)
    x, dx = on_panels(np.linspace(0, math.atan(alpha), panels + 1), NODES)
    phase = kb[..., np.newaxis] / np.cos(x)
    # J_1(S) / (k b) = (J_1(S) / S) sec x, which is regular for long waves
    share = np.where(phase > 0, special.j1(phase) / np.where(phase > 0, phase, 1.0), 0.5) / np.cos(x)
    return np.asarray(4 / alpha * (share**2 @ dx))


def _phase(along: ArrayLike, across: ArrayLike, semi_axes: tuple[float, float]) -> FloatArray:
    a, b = semi_axes
    positive(along=a, across=b)
    return np.hypot(np.asarray(along, dtype=np.float64) * a, np.asarray(across, dtype=np.float64) * b)
