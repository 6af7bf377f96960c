"""Quantities with units, as they stand in scene files: "0.5 m", "210 GPa", "72 km/h"."""

import math
from decimal import Context, Decimal, InvalidOperation
from fractions import Fraction
from typing import Literal

from validation.scenes.printable import quoted, shortened

Dimension = Literal["length", "mass", "force", "pressure", "speed", "level"]

POWERS: dict[Dimension, dict[str, int]] = {
    "length": {"m": 0, "cm": -2, "mm": -3, "um": -6, "µm": -6, "nm": -9, "km": 3},
    "mass": {"kg": 0, "g": -3, "t": 3},
    "force": {"N": 0, "kN": 3, "MN": 6, "mN": -3},
    "pressure": {"Pa": 0, "kPa": 3, "MPa": 6, "GPa": 9},
    "speed": {"m/s": 0, "mm/s": -3},
    "level": {"dB": 0},
}
OTHERS: dict[Dimension, dict[str, Fraction]] = {
    "force": {"kgf": Fraction(980665, 10**5), "tf": Fraction(980665, 10**2)},
    "speed": {"km/h": Fraction(10, 36)},
}
UNITS = {
    dimension: {unit: Fraction(10) ** power for unit, power in powers.items()} | OTHERS.get(dimension, {})
    for dimension, powers in POWERS.items()
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
SMALL = {"Å": Fraction(1, 10**10), "A": Fraction(1, 10**10), "pm": Fraction(1, 10**12)}
"""Units of the atomic force microscope, over a metre; A is how SurfaceTopography writes Å in ASCII."""
LENGTHS = UNITS["length"] | SMALL
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


def metres_of(name: str, unit: object) -> float:
    """How many metres a unit of heights is. Raises ValueError that begins with the name."""
    # the micro sign and the Greek letter look the same, as do the letter and the sign of an angstrom
    found = LENGTHS.get(str(unit).strip().replace("\N{GREEK SMALL LETTER MU}", "µ").replace("\N{ANGSTROM SIGN}", "Å"))
    if found is None:
        raise ValueError(f"{name} must be one of {', '.join(LENGTHS)}, got {shortened(unit)}")
    return float(found)


def unit_of(name: str, given: object) -> float:
    """How many metres one of a unit of heights is."""
    try:
        return metres_of(name, given)
    except ValueError as problem:
        raise ValueError(f'{problem}, as: unit = "um"') from None


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
