"""What is rough: isotropic self-affine roughness, as scenes have it, or measured heights."""

import math
from dataclasses import dataclass
from typing import ClassVar, overload

from mdr import SelfAffine
from mdr.checks import FloatArray, Numbers, positive
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.reader import LENGTH, NUMBER, Reader, table
from validation.scenes.units import in_unit
from validation.theory.rolling import rms_gradient, slope_in_one_direction


@dataclass(frozen=True, kw_only=True)
class Roughness:
    """Isotropic self-affine roughness between two wavelengths. The scene that holds it checks its values.

    Parameters
    ----------
    rms : float
        Root mean square height h [m].
    hurst : float
        Hurst exponent H.
    longest, shortest : float
        Wavelengths between which it is rough [m].

    Examples
    --------
    >>> rough = validation.Roughness(rms=1e-6, hurst=0.8, longest=1e-3, shortest=1e-5)
    >>> print(f"q = {rough.q_min:.4g} to {rough.q_max:.4g} rad/m, slope {rough.slope_along:.2g} in one direction")
    q = 6283 to 6.283e+05 rad/m, slope 0.02 in one direction
    """

    is_single: ClassVar = False

    rms: float
    hurst: float
    longest: float
    shortest: float

    def __repr__(self) -> str:
        rms, longest, shortest = (f"{value:.5g}" for value in (self.rms, self.longest, self.shortest))
        return f"Roughness(rms={rms}, hurst={self.hurst:.4g}, longest={longest}, shortest={shortest})"

    @property
    def q_min(self) -> float:
        """2 pi over the longest wave [rad/m]."""
        return 2 * math.pi / self.longest

    @property
    def q_max(self) -> float:
        """2 pi over the shortest wave [rad/m]."""
        return 2 * math.pi / self.shortest

    @property
    def q_resolved(self) -> float:
        """All of its waves count [rad/m]."""
        return self.q_max

    @property
    def slope_along(self) -> float:
        """h', the root mean square slope in one direction, of all waves [-]."""
        return slope_in_one_direction(rms_gradient(self.c2d, edges=self.edges))

    @property
    def spectrum(self) -> SelfAffine:
        """C_2D ~ q^(-2H-2) between q_min and q_max."""
        return SelfAffine(hurst=self.hurst, q_min=self.q_min, q_max=self.q_max, rms=self.rms)

    @property
    def edges(self) -> tuple[float, float]:
        """The ends of the spectrum, (q_min, q_max) [rad/m]."""
        return self.q_min, self.q_max

    @overload
    def c2d(self, q: float) -> float: ...
    @overload
    def c2d(self, q: Numbers) -> FloatArray: ...
    def c2d(self, q: float | Numbers) -> float | FloatArray:
        """C_2D of the spectrum [m^4]."""
        return self.spectrum.c2d(q)

    @property
    def waves(self) -> str:
        """Wavelengths and Hurst exponent, in words."""
        longest, shortest = (in_unit(wave, "length") for wave in (self.longest, self.shortest))
        return f"{longest} to {shortest}, Hurst exponent {self.hurst:.3g}"

    def notes(self) -> tuple[str, ...]:
        """Notes on its quality: none, since it is generated and not measured."""
        return ()

    def beyond_a_spectrum(self) -> tuple[str, ...]:
        """What the spectrum leaves out: nothing of generated roughness."""
        return ()

    def not_gaussian(self) -> str:
        """Why the heights are not Gaussian: empty, since generated ones are."""
        return ""


RoughSurface = Roughness | MeasuredHeights
"""Roughness that is drawn from its spectrum, or one surface that was measured."""


def roughness_of(name: str, value: object) -> Roughness:
    """Roughness of a table in a scene file."""
    readers: dict[str, Reader] = {"rms": LENGTH, "hurst": NUMBER, "longest": LENGTH, "shortest": LENGTH}
    return Roughness(**table(readers, (), name, value))


def check_band(key: str, rough: object) -> None:
    """Raise TypeError or ValueError unless the object is a Roughness whose band and spectrum are valid."""
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
