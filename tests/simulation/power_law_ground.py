"""The ground of a made-up strip of rail."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PowerLawGround:
    """C ~ k^-exponent along the track between two wavenumbers, as ridges across it or isotropic.

    rms: of the heights [m]. Isotropic: C_2D ~ k^(-exponent - 1), of which a line keeps the exponent well below the last
    wavenumber.
    """

    rms: float
    exponent: float
    first: float
    last: float
    across: str = "isotropic"

    @property
    def highest(self) -> float:
        return self.last

    def variance(self, along: FloatArray, across: FloatArray, steps: tuple[float, float]) -> FloatArray:
        """Of ridges k_y = 0 alone."""
        k = np.hypot(along, across)
        inside = (k >= self.first * (1 - 1e-9)) & (k <= self.last * (1 + 1e-9))
        shape = np.where(inside, np.where(inside, k, 1.0) ** -self.exponent, 0.0)
        n, log = 1 - self.exponent, math.log(self.last / self.first)
        whole = log if n == 0 else self.first**n * math.expm1(n * log) / n
        level, (dx, dy) = self.rms**2 / whole, steps
        if self.across == "ridges":
            return np.asarray(np.where(across == 0, level / 2 * shape * dx, 0.0))
        return np.asarray(level / (2 * math.pi) * shape / np.where(inside, k, 1.0) * dx * dy)
