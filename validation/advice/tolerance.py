"""How far off an answer may be, and errors in the unit in which that was asked."""

import math
from dataclasses import dataclass

from mdr.checks import positive
from validation.advice.cells import short

FORMS = '"5%", "0.05" or "0.4 dB"'
LARGEST = 2.0
"""Of a number: a larger one is a percentage, or decibels, without its unit."""


def decibels(error: float) -> float:
    """Of an amplitude, from its relative error."""
    return 20 * math.log10(1 + error)


def relative(level: float) -> float:
    """Of an amplitude, from its error [dB]."""
    return float(10 ** (level / 20) - 1)


@dataclass(frozen=True)
class Tolerance:
    """relative: half-width over value; in_decibels: whether it was asked in dB, 20 lg(1 + relative)."""

    relative: float
    in_decibels: bool = False

    @property
    def unit(self) -> str:
        return "dB" if self.in_decibels else "%"

    def in_unit(self, error: float) -> float:
        """A relative error."""
        return decibels(error) if self.in_decibels else 100 * error

    def shown(self, error: float) -> str:
        """An error in the unit of the tolerance, with two digits; "unknown" where none is known."""
        return f"{short(self.in_unit(error))} {self.unit}" if math.isfinite(error) else "unknown"

    def shown_beside(self, error: float) -> str:
        """With as many digits as it takes to differ from the tolerance: 1.04 dB beside 1 dB."""
        text = self.shown(error)
        if text != str(self) or error <= self.relative:
            return text
        wanted, found = self.in_unit(self.relative), self.in_unit(error)
        digits = next((n for n in range(3, 16) if f"{found:.{n}g}" != f"{wanted:.{n}g}"), 16)
        return f"{found:.{digits}g} {self.unit}"

    def __str__(self) -> str:
        return self.shown(self.relative)


def tolerance_of(given: float | str) -> Tolerance:
    """A ratio, or a text: in per cent, a ratio, or decibels of an amplitude.

    Raises ValueError for any other text and a number that is no ratio, TypeError for what is neither.
    """
    if not isinstance(given, str):
        if positive("tolerance", given) > LARGEST:
            raise ValueError(f"tolerance must be as {FORMS}, got {given:g}: {_meant(given)}?")
        return Tolerance(given)
    text, in_decibels = given.strip(), given.strip().lower().endswith("db")
    number = text[:-2] if in_decibels else text.removesuffix("%")
    try:
        value = float(number) * (0.01 if text.endswith("%") else 1.0)
    except ValueError:
        raise ValueError(f"tolerance must be as {FORMS}, got {given!r}") from None
    if text == number and LARGEST < value < math.inf:
        raise ValueError(f"tolerance must be as {FORMS}, got {given!r}: {_meant(value)}?")
    relative = math.expm1(min(value, 100.0) * math.log(10) / 20) if in_decibels else value
    if not 0 < relative <= 1:
        raise ValueError(f"tolerance must be as {FORMS}, above zero and no more than 100 %, or 6 dB, got {given!r}")
    return Tolerance(relative, in_decibels)


def _meant(number: float) -> str:
    return f'{number / 100:g} or "{number:g}%"'
