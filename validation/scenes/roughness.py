"""Isotropic self-affine roughness, as scenes have it."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr import SelfAffine
from mdr.checks import positive
from validation.scenes.reader import LENGTH, NUMBER, Reader, table


@dataclass(frozen=True, kw_only=True)
class Roughness:
    """Isotropic self-affine roughness between two waves; the scene that holds it checks it.

    rms: root mean square height [m]; hurst: H; longest, shortest: wavelengths between which it is rough [m].
    """

    rms: float
    hurst: float
    longest: float
    shortest: float

    @property
    def q_min(self) -> float:
        """2 pi over the longest wave [rad/m]."""
        return 2 * math.pi / self.longest

    @property
    def q_max(self) -> float:
        """2 pi over the shortest wave [rad/m]."""
        return 2 * math.pi / self.shortest

    @property
    def slope_along(self) -> float:
        """Root mean square slope in one direction, h'^2 = pi int_0^inf q^3 C_2D dq, half of the gradient's [-]."""
        width, power = math.log(self.q_max / self.q_min), 2 - 2 * self.hurst
        height = -math.expm1(-2 * self.hurst * width) / (2 * self.hurst)
        slope = math.expm1(power * width) / power if abs(power * width) > 1e-9 else width
        return self.rms * self.q_min * math.sqrt(slope / height / 2)

    @property
    def spectrum(self) -> SelfAffine:
        """C_2D ~ q^(-2H-2) between q_min and q_max."""
        return SelfAffine(hurst=self.hurst, q_min=self.q_min, q_max=self.q_max, rms=self.rms)

    @property
    def edges(self) -> tuple[float, float]:
        """q_min and q_max [rad/m]."""
        return self.q_min, self.q_max

    def c2d(self, q: ArrayLike) -> NDArray[np.float64]:
        """C_2D of the spectrum [m^4]."""
        return self.spectrum.c2d(q)


def roughness_of(name: str, given: object) -> Roughness:
    """Of a table in a scene file."""
    readers: dict[str, Reader] = {"rms": LENGTH, "hurst": NUMBER, "longest": LENGTH, "shortest": LENGTH}
    return Roughness(**table(readers, (), name, given))


def check_band(key: str, rough: object) -> None:
    """Roughness in itself."""
    if not isinstance(rough, Roughness):
        raise TypeError(f"{key} must be a Roughness or None, got {rough!r}")
    longest, shortest = positive(f"{key}.longest", rough.longest), positive(f"{key}.shortest", rough.shortest)
    if not shortest < longest:
        raise ValueError(f"{key}.shortest must be below the longest wave, {longest:g} m, got {shortest:g} m")
    try:
        _ = rough.spectrum
    except (TypeError, ValueError) as problem:
        # which begins with the name of its argument, "hurst" or "rms"
        raise type(problem)(f"{key}.{problem}") from None
