"""Love's half-space, by which solvers are judged: no code of `bem3d` or `mdr` stands behind it."""

import math
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy import fft, special

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
    """b/a from R_b / R_a <= 1: b/a lies between that ratio and one [-]."""
    if radius_ratio == 1:
        return 1.0

    def excess(log_k: float) -> float:
        square = math.exp(2 * log_k)
        return math.log(float(special.elliprd(0, square, 1) / special.elliprd(0, 1, square)) / radius_ratio)

    return math.exp(scipy.optimize.brentq(excess, math.log(radius_ratio), 0.0, xtol=1e-15))


@cache
def gauss_legendre(nodes: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Nodes and weights on [-1, 1], read-only; exact for polynomials of degree 2 nodes - 1."""
    rule = np.polynomial.legendre.leggauss(nodes)
    for values in rule:
        values.flags.writeable = False
    return rule


def on_panels(ends: ArrayLike, nodes: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """So many nodes on each panel between ascending ends, and their weights, panel by panel."""
    node, weight = gauss_legendre(nodes)
    first, half = np.asarray(ends)[:-1, np.newaxis], np.diff(np.asarray(ends))[:, np.newaxis] / 2
    return (first + half * (1 + node)).ravel(), (half * weight).ravel()


FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class LoveHalfSpace:
    """An elastic half-space under pressures that are constant on rectangles.

    u(x) = sum over rectangles of p / (pi E*) int dA / r; periodic: u(q) = 2 p(q) / (E* q), no mean displacement.
    shape: (n, m) cells; spacing: (dx, dy) [m]; modulus: E* [Pa].
    Source: Love, Phil. Trans. R. Soc. A 228 (1929) 377; Johnson, Contact Mechanics, eq. (3.25).
    """

    shape: tuple[int, int]
    spacing: tuple[float, float]
    modulus: float
    periodic: bool = False

    def displacement(self, pressure: FloatArray) -> FloatArray:
        """u [m] at the centres of the cells (n, m), from the pressure [Pa] on them (n, m)."""
        padded = self.shape if self.periodic else tuple(2 * n for n in self.shape)
        waves = fft.rfft2(pressure, padded) * self._transfer
        n, m = self.shape
        return np.asarray(fft.irfft2(waves, padded)[:n, :m])

    @cached_property
    def _transfer(self) -> NDArray[np.complex128]:
        """u(q) / p(q) of each wave of the padded grid, of the periodic one 2 / (E* q) [m/Pa]."""
        (n, m), (dx, dy) = self.shape, self.spacing
        if self.periodic:
            q = 2 * math.pi * np.hypot(fft.fftfreq(n, dx)[:, np.newaxis], fft.rfftfreq(m, dy))
            return np.asarray(np.divide(2 / self.modulus, q, out=np.zeros_like(q), where=q > 0), dtype=np.complex128)
        # cells to the right and, by the period of the padded grid, to the left
        x, y = (fft.fftfreq(2 * count, 1 / (2 * count)) * d for count, d in zip(self.shape, self.spacing, strict=True))
        return np.asarray(fft.rfft2(love(x[:, np.newaxis], y, dx, dy) / (math.pi * self.modulus)))


def love(x: FloatArray, y: FloatArray, dx: float, dy: float) -> FloatArray:
    """int dA / r [m] over the rectangle dx times dy [m] around the origin, seen from (x, y) [m] on its plane.

    The double integral of 1 / r is x asinh(y / abs(x)) + y asinh(x / abs(y)), between the corners.
    """

    def primitive(u: FloatArray, v: FloatArray) -> FloatArray:
        with np.errstate(divide="ignore", invalid="ignore"):
            terms = u * np.arcsinh(v / np.abs(u)), v * np.arcsinh(u / np.abs(v))
        return np.asarray(np.where(u == 0, 0, terms[0]) + np.where(v == 0, 0, terms[1]))

    ends = ((sign, x + sign * dx / 2) for sign in (1, -1))
    return np.asarray(sum(i * j * primitive(u, y + j * dy / 2) for i, u in ends for j in (1, -1)))
