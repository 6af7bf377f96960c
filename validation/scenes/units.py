"""Quantities with units, as they stand in scene files: "0.5 m", "210 GPa", "72 km/h"."""

import math
from decimal import Context, Decimal, InvalidOperation
from fractions import Fraction
from functools import partial
from typing import Literal

from validation.analysis.escapes import quoted, shortened

Dimension = Literal["length", "mass", "force", "pressure", "speed", "level", "share of critical"]

TABLE: dict[Dimension, tuple[str, str, str]] = {
    "length": ("0.5 m", "nm µm mm m", "m=1 cm=1e-2 mm=1e-3 um=1e-6 µm=1e-6 nm=1e-9 km=1e3"),
    "mass": ("500 kg", "g kg t", "kg=1 g=1e-3 t=1e3"),
    "force": (
        "4905 N",
        "nN µN mN N kN MN",
        "N=1 kN=1e3 MN=1e6 mN=1e-3 uN=1e-6 µN=1e-6 nN=1e-9 daN=10 kgf=9.80665 tf=9806.65",
    ),
    "pressure": (
        "210 GPa",
        "Pa kPa MPa GPa",
        "Pa=1 kPa=1e3 MPa=1e6 GPa=1e9 bar=1e5 N/m2=1 kN/m2=1e3 MN/m2=1e6 N/mm2=1e6 kN/mm2=1e9",
    ),
    "speed": ("20 m/s", "mm/s m/s", "m/s=1 cm/s=1e-2 mm/s=1e-3 um/s=1e-6 µm/s=1e-6 km/h=10/36"),
    "level": ("10 dB", "dB", "dB=1"),
    "share of critical": ("2 %", "%", "%=1e-2"),
}
"""An example, the units in which a quantity is printed, the smallest first, and each unit over the SI unit."""


RANGE: dict[Dimension, tuple[float, float]] = {
    "length": (1e-12, 1e6),
    "mass": (1e-15, 1e9),
    "force": (1e-15, 1e12),
    "pressure": (1e-3, 1e15),
    "speed": (1e-9, 1e4),
}
"""Of a quantity that must be positive, in SI units: no body has another, and beyond it doubles or grids have an end."""


def _unit_factors(units: str) -> dict[str, Fraction]:
    """SI units in each unit of pairs as "mm=1e-3", exactly, so that a quantity is rounded once."""
    return {unit: Fraction(si) for unit, _, si in (pair.partition("=") for pair in units.split())}


UNITS = {dimension: _unit_factors(units) for dimension, (_, _, units) in TABLE.items()}
LENGTHS = UNITS["length"] | _unit_factors("Å=1e-10 A=1e-10 pm=1e-12")
"""With those of the atomic force microscope, over a metre; A is how SurfaceTopography writes Å in ASCII."""
SAME = {"\N{GREEK SMALL LETTER MU}": "µ", "m²": "m2", "m^2": "m2"}
"""What looks the same, or means the same in a unit."""
# decimal, so that "0.5 um" is the float nearest to 5e-7; nothing trapped, since what is not finite is refused anyway
DECIMAL = Context(prec=60, traps=[InvalidOperation])


def quantity(name: str, text: object, dimension: Dimension, *, positive: bool = False) -> float:
    """The float nearest to a quantity of the given dimension, in SI units.

    text: a decimal number and a unit, with or without a space between them; positive: whether it must be above zero,
    and within `RANGE`. Raises ValueError naming the quantity that is of another form or dimension, not finite, or out
    of range.
    """
    words = text.strip() if isinstance(text, str) else ""
    for sign, same in SAME.items():
        words = words.replace(sign, same)
    ending = max((unit for unit in UNITS[dimension] if words.endswith(unit)), key=len, default="")
    try:
        number = DECIMAL.create_decimal(words.removesuffix(ending).strip() if ending else "")
    except InvalidOperation:
        example, _, _ = TABLE[dimension]
        accepted = f'a {dimension}, as "{example}", in one of {", ".join(UNITS[dimension])}'
        if ending and words.count(",") == 1:
            accepted += ", with a point before the decimals"
        raise ValueError(f"{name} must be {accepted}, got {quoted(text)}") from None
    value, unit = math.nan, UNITS[dimension][ending]
    if number.is_finite():
        value = float(DECIMAL.divide(DECIMAL.multiply(number, Decimal(unit.numerator)), Decimal(unit.denominator)))
    if not math.isfinite(value):
        raise ValueError(f"{name} must be finite, got {quoted(text)}")
    if positive and value <= 0:
        raise ValueError(f"{name} must be positive, got {quoted(text)}")
    low, high = RANGE.get(dimension, (0.0, math.inf))
    if positive and not low * (1 - 1e-9) <= value <= high * (1 + 1e-9):
        ends = " and ".join(f"{end / float(unit):g} {ending}" for end in (low, high))
        raise ValueError(f"{name} must lie between {ends}, got {quoted(text)}: is its unit right?")
    return value


def in_unit(value: float, dimension: Dimension, *, digits: int = 5) -> str:
    """A quantity in SI units with so many digits, in the largest unit that leaves one or more before the point."""
    printed = TABLE[dimension][1].split()
    unit = next((u for u in reversed(printed) if abs(value) * (1 + 1e-9) >= UNITS[dimension][u]), printed[0])
    return f"{float(f'{float(value) / UNITS[dimension][unit]:.{digits}g}'):.{max(digits, 6)}g} {unit}"


def metres_of(name: str, unit: object, *, hint: str = "") -> float:
    """How many metres a unit of heights is. Raises ValueError that begins with the name and ends with the hint."""
    # the micro sign and the Greek letter look the same, as do the letter and the sign of an angstrom
    factor = LENGTHS.get(str(unit).strip().replace("\N{GREEK SMALL LETTER MU}", "µ").replace("\N{ANGSTROM SIGN}", "Å"))
    if factor is None:
        raise ValueError(f"{name} must be one of {', '.join(LENGTHS)}, got {shortened(unit)}{hint}")
    return float(factor)


unit_of = partial(metres_of, hint=', as: unit = "um"')
"""Of a key in a scene file."""
