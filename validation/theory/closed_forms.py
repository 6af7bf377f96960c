"""Linear elasticity of simple contacts: references, which import neither method.

Lengths in metres, forces in newtons, pressures in pascals; ``modulus`` is the contact modulus E*.
All arguments with a unit must be finite and positive unless said otherwise; ValueError names the one that is not.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

# pi times the capacitance of the unit square, 0.36679, which is known by numerical methods only; five digits
SQUARE_PUNCH = 1.1523
# separation over which the pressure of a rough face grows e-fold, over its rms height: measured, 0.45 to 0.5
INTERFACE = 0.48


def hertz_force(*, radius: float, modulus: float, approach: float) -> float:
    """F = 4/3 E* sqrt(R) d^(3/2) [N]. Source: Hertz; Johnson, Contact Mechanics, chapter 4."""
    positive(radius=radius, modulus=modulus, approach=approach)
    return 4 / 3 * modulus * math.sqrt(radius) * math.pow(approach, 1.5)


def hertz_approach(*, radius: float, modulus: float, force: float) -> float:
    """d = (9 F^2 / (16 R E*^2))^(1/3) [m]. Source: Hertz; Johnson, chapter 4."""
    positive(radius=radius, modulus=modulus, force=force)
    return math.cbrt(9 / 16 / radius) * math.cbrt(force / modulus) ** 2


def hertz_contact_radius(*, radius: float, approach: float) -> float:
    """a = sqrt(R d) [m]. Source: Hertz; Johnson, chapter 4."""
    positive(radius=radius, approach=approach)
    return math.sqrt(radius * approach)


def hertz_pressure(r: ArrayLike, *, radius: float, modulus: float, approach: float) -> FloatArray:
    """p(r) = (2 E* / pi) sqrt(a^2 - r^2) / R inside the contact, zero outside [Pa].

    r: distance from the centre, any shape [m]. Source: Hertz; Johnson, chapter 4.
    """
    positive(radius=radius, modulus=modulus, approach=approach)
    inside = np.maximum(radius * approach - np.asarray(r, dtype=np.float64) ** 2, 0.0)
    pressure: FloatArray = 2 * modulus / (np.pi * radius) * np.sqrt(inside)
    return pressure


def circular_punch_stiffness(*, radius: float, modulus: float) -> float:
    """k = 2 E* a of a flat circular punch of radius a, and of any Hertz contact of that radius [N/m].

    Source: Boussinesq; Johnson, chapter 3.
    """
    positive(radius=radius, modulus=modulus)
    return 2 * modulus * radius


def square_punch_stiffness(*, side: float, modulus: float) -> float:
    """k = 1.1523 E* L of a flat square punch [N/m].

    The square has no closed form: the factor is pi times the numerical capacitance of the unit square.
    """
    positive(side=side, modulus=modulus)
    return SQUARE_PUNCH * modulus * side


def rough_punch_stiffness(*, side: float, modulus: float, force: float, height: float) -> float:
    """1/k = 1/(1.1523 E* L) + u0/F, u0 = 0.48 h: a flat square punch in series with its rough face [N/m].

    The stiffness of a rough interface grows like the load, F / u0, and u0 is a fixed part of the height h (rms),
    whatever the spectrum: for loads that close the gaps of many waves and not the gap as a whole, F / (E* h L) from
    0.3 to 3, about; below, the face is stiffer; beyond, the flat punch counts. No exact law: 0.48 was measured.
    Source: Persson, Phys. Rev. Lett. 99, 125502 (2007); Akarapu, Sharp, Robbins, Phys. Rev. Lett. 106, 204301 (2011).
    """
    positive(side=side, modulus=modulus, force=force, height=height)
    return 1 / (1 / square_punch_stiffness(side=side, modulus=modulus) + INTERFACE * height / force)


def westergaard_full_pressure(*, amplitude: float, wavelength: float, modulus: float) -> float:
    """p* = pi E* h / lambda, the mean pressure that just closes a wave h cos(2 pi x / lambda) [Pa].

    Source: Westergaard, J. Appl. Mech. 6 (1939); Johnson, chapter 13.
    """
    positive(amplitude=amplitude, wavelength=wavelength, modulus=modulus)
    return math.pi * modulus * amplitude / wavelength


def westergaard_half_width(*, mean_pressure: float, amplitude: float, wavelength: float, modulus: float) -> float:
    """a from mean(p) / p* = sin^2(pi a / lambda), for 0 < mean(p) <= p* [m]. Source: Johnson, chapter 13."""
    full = westergaard_full_pressure(amplitude=amplitude, wavelength=wavelength, modulus=modulus)
    positive(mean_pressure=mean_pressure)
    if mean_pressure > full:
        raise ValueError(f"mean_pressure must not exceed the pressure of full contact, {full:.6g}, got {mean_pressure}")
    return wavelength / math.pi * math.asin(math.sqrt(mean_pressure / full))


def westergaard_pressure(
    x: ArrayLike, *, mean_pressure: float, amplitude: float, wavelength: float, modulus: float
) -> FloatArray:
    """p(x) = 2 p* cos(pi x / lambda) sqrt(sin^2(pi a / lambda) - sin^2(pi x / lambda)) for abs(x) < a, else zero [Pa].

    x: from the crest of the wave, periodic, any shape [m]. Source: Westergaard; Johnson, chapter 13.
    """
    full = westergaard_full_pressure(amplitude=amplitude, wavelength=wavelength, modulus=modulus)
    a = westergaard_half_width(mean_pressure=mean_pressure, amplitude=amplitude, wavelength=wavelength, modulus=modulus)
    phase = np.pi * np.asarray(x, dtype=np.float64) / wavelength
    inside = np.maximum(math.sin(math.pi * a / wavelength) ** 2 - np.sin(phase) ** 2, 0.0)
    pressure: FloatArray = 2 * full * np.abs(np.cos(phase)) * np.sqrt(inside)
    return pressure


def positive(**values: float) -> None:
    """Raise ValueError that names the first value that is not finite and positive."""
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name} must be finite and positive, got {value}")
