"""Quantities with units, as they stand in scene files: "0.5 m", "210 GPa", "72 km/h"."""

import math
from decimal import Context, Decimal, InvalidOperation
from fractions import Fraction
from typing import Literal

from validation.scenes.printable import quoted

Dimension = Literal["length", "mass", "force", "pressure", "speed", "level"]

ONE = Fraction(1)
UNITS: dict[Dimension, dict[str, Fraction]] = {
    "length": {
        "m": ONE,
        "cm": ONE / 10**2,
        "mm": ONE / 10**3,
        "um": ONE / 10**6,
        "µm": ONE / 10**6,
        "nm": ONE / 10**9,
        "km": ONE * 10**3,
    },
    "mass": {"kg": ONE, "g": ONE / 10**3, "t": ONE * 10**3},
    "force": {
        "N": ONE,
        "kN": ONE * 10**3,
        "MN": ONE * 10**6,
        "mN": ONE / 10**3,
        "kgf": ONE * 980665 / 10**5,
        "tf": ONE * 980665 / 10**2,
    },
    "pressure": {"Pa": ONE, "kPa": ONE * 10**3, "MPa": ONE * 10**6, "GPa": ONE * 10**9},
    "speed": {"m/s": ONE, "mm/s": ONE / 10**3, "km/h": ONE * 10 / 36},
    "level": {"dB": ONE},
}
"""Each unit over the SI unit of its dimension."""
EXAMPLES: dict[Dimension, str] = {
    "length": "0.5 m",
    "mass": "500 kg",
    "force": "4905 N",
    "pressure": "210 GPa",
    "speed": "20 m/s",
    "level": "10 dB",
}
PRINTED_UNITS: dict[Dimension, tuple[str, ...]] = {
    "length": ("nm", "µm", "mm", "m"),
    "mass": ("g", "kg", "t"),
    "force": ("mN", "N", "kN", "MN"),
    "pressure": ("Pa", "kPa", "MPa", "GPa"),
    "speed": ("mm/s", "m/s"),
    "level": ("dB",),
}
"""Units in which a quantity is printed, the smallest first."""
# decimal, so that "0.5 um" is the float nearest to 5e-7; nothing trapped, since what is not finite is refused anyway
DECIMAL = Context(prec=60, traps=[InvalidOperation])


def quantity(name: str, text: object, dimension: Dimension, *, positive: bool = False) -> float:
    """The float nearest to a quantity of the given dimension, in SI units.

    text: a decimal number and a unit, with or without a space between them; positive: whether it must be above zero.
    Raises ValueError naming the quantity that is of another form or dimension, not finite, or not positive.
    """
    found = _read(text, dimension)
    if found is None:
        accepted = f'a {dimension}, as "{EXAMPLES[dimension]}", in one of {", ".join(UNITS[dimension])}'
        raise ValueError(f"{name} must be {accepted}, got {quoted(text)}")
    if not math.isfinite(found):
        raise ValueError(f"{name} must be finite, got {quoted(text)}")
    if positive and found <= 0:
        raise ValueError(f"{name} must be positive, got {quoted(text)}")
    return found


def in_unit(value: float, dimension: Dimension, *, digits: int = 5) -> str:
    """A quantity in SI units with so many digits, in the largest unit that leaves one or more before the point."""
    units = [unit for unit in PRINTED_UNITS[dimension] if abs(value) * (1 + 1e-9) >= UNITS[dimension][unit]]
    unit = units[-1] if units else PRINTED_UNITS[dimension][0]
    return f"{float(f'{float(value) / UNITS[dimension][unit]:.{digits}g}'):.{max(digits, 6)}g} {unit}"


def _read(text: object, dimension: Dimension) -> float | None:
    """The quantity, or None if the text is of another form or dimension."""
    # the micro sign and the Greek letter look the same
    words = text.strip().replace("\N{GREEK SMALL LETTER MU}", "µ") if isinstance(text, str) else ""
    ending = max((unit for unit in UNITS[dimension] if words.endswith(unit)), key=len, default=None)
    if ending is None:
        return None
    unit = UNITS[dimension][ending]
    try:
        number = DECIMAL.create_decimal(words.removesuffix(ending).strip())
    except InvalidOperation:
        return None
    if not number.is_finite():
        return math.nan
    return float(DECIMAL.divide(DECIMAL.multiply(number, Decimal(unit.numerator)), Decimal(unit.denominator)))
