"""Contact filters of a rolling wheel on an elliptic contact: from the height of a wave to the displacement, 1 if long.

Waves h exp(i (k_x x + k_y y)), x along the track; S^2 = (k_x a_x)^2 + (k_y a_y)^2. Wavenumbers in rad/m, of any shapes
that go together; semi-axes in metres.
"""

import math
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from validation.railway.theory.transverse_structure import FAR, IsotropicGround, WaveBand
from validation.theory.closed_forms import positive
from validation.theory.half_space import on_panels

FloatArray = NDArray[np.float64]

PANEL_NODES = 16
"""Of Gauss and Legendre, on a panel of a turn of J_1^2 at the most."""


def half_space_filter(along: ArrayLike, across: ArrayLike, *, semi_axes: tuple[float, float]) -> FloatArray:
    """sin(S) / S: the half-space under an ellipse that keeps its size, by reciprocity with the flat elliptic punch.

    Over ridges, k_y = 0, it is that of springs, (14.11). Source: Popov and Hess; Johnson, Contact Mechanics, chapter 3.
    """
    return np.asarray(np.sinc(_phase(along, across, semi_axes) / np.pi))


def corrugation_harmonic(phase: ArrayLike) -> FloatArray:
    """r_2 d / A^2: amplitude of cos(2 k x) that a ridge A cos(k x) makes at constant load, on a circle of radius a.

    The edge moves by what the flat punch leaves there, U(t) = sum_n e_n i^n sqrt(pi s / 2) J_(n-1/2)(s) cos(n t),
    s = k a, and with the wheel's own motion, -S = -sin(s) / s, the force is F''(d) / 2 times the mean square of both
    around the edge: r_2 d / A^2 = (sum_n (-1)^n e_n (pi s / 2) J_(n-1/2)(s)^2 - 2 S cos s + S^2) / 8, e_0 = 1, else 2.
    Of second order in A / d. Springs on a line have cos(2 s) in the place of the sum: their edge has two points.
    Source: the intensity of the pressure at the edge of a flat punch, Johnson, Contact Mechanics, chapter 3.
    phase: k a, zero or positive [-].
    """
    s = np.asarray(phase, dtype=np.float64)
    n = np.arange(2 * int(s.max(initial=1.0)) + 20)
    signs = np.where(n == 0, 1, 2) * (-1.0) ** n
    x = np.maximum(s, 1e-9)[..., np.newaxis]
    edge = np.sum(signs * math.pi / 2 * x * special.jv(n - 0.5, x) ** 2, axis=-1)
    return _with_wheel(edge, s)


def corrugation_harmonic_of_springs(phase: ArrayLike) -> FloatArray:
    """r_2 d / A^2 of springs on a line, (cos 2s - 2 S cos s + S^2) / 8, as `corrugation_harmonic`."""
    s = np.asarray(phase, dtype=np.float64)
    return _with_wheel(np.cos(2 * s), s)


def _with_wheel(edge: FloatArray, s: FloatArray) -> FloatArray:
    moved = np.sinc(s / np.pi)
    return np.asarray((edge - 2 * moved * np.cos(s) + moved**2) / 8)


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
    x, dx = on_panels(np.linspace(0, math.atan(alpha), panels + 1), PANEL_NODES)
    phase = kb[..., np.newaxis] / np.cos(x)
    # J_1(S) / (k b) = (J_1(S) / S) sec x, which is regular for long waves
    share = np.where(phase > 0, special.j1(phase) / np.where(phase > 0, phase, 1.0), 0.5) / np.cos(x)
    return np.asarray(4 / alpha * (share**2 @ dx))


def _phase(along: ArrayLike, across: ArrayLike, semi_axes: tuple[float, float]) -> FloatArray:
    a, b = semi_axes
    positive(along=a, across=b)
    return np.hypot(np.asarray(along, dtype=np.float64) * a, np.asarray(across, dtype=np.float64) * b)


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
