"""Love's half-space, by which solvers are judged: no code of `bem3d` or `mdr` stands behind it."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import fft

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Residual:
    """What is left of the conditions of a contact, w = gap + u - approach; zero for the discrete answer.

    tension: the most negative pressure over the largest; complementarity: sum(p abs(w)) / (s sum(p)), s the deepest
    geometric overlap; penetration: max(-w) / s, both NaN without an overlap; approach: of the bodies [m], as prescribed
    or as the contact has it.
    """

    tension: float
    complementarity: float
    penetration: float
    approach: float

    @property
    def worst(self) -> float:
        """NaN where one of them is."""
        return float(np.max([self.tension, self.complementarity, self.penetration]))


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

    def residual(self, gap: FloatArray, pressure: FloatArray, approach: float | None = None) -> Residual:
        """Of a pressure (n, m) under an approach [m]; without one under that which the contact has, as a force does."""
        separation = gap + self.displacement(pressure)
        total = float(pressure.sum())
        if approach is None:
            approach = float((pressure * separation).sum() / total)
        w, overlap = separation - approach, approach - float(gap.min())
        scale = overlap if overlap > 0 else math.nan  # pressure without an overlap is no answer
        return Residual(
            tension=max(-float(pressure.min()), 0.0) / float(np.abs(pressure).max()),
            complementarity=float((np.abs(pressure) * np.abs(w)).sum()) / abs(scale * total),
            penetration=max(-float(w.min()), 0.0) / scale,
            approach=approach,
        )

    @cached_property
    def _transfer(self) -> NDArray[np.complex128]:
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
            first, second = u * np.arcsinh(v / np.abs(u)), v * np.arcsinh(u / np.abs(v))
        return np.asarray(np.where(u == 0, 0, first) + np.where(v == 0, 0, second))

    right, left, above, below = x + dx / 2, x - dx / 2, y + dy / 2, y - dy / 2
    return np.asarray(
        primitive(right, above) - primitive(left, above) - primitive(right, below) + primitive(left, below)
    )
