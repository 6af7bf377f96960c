"""How far off an answer may be, and errors in the unit in which that was asked."""

import math
from dataclasses import dataclass

from mdr.checks import positive
from validation.analysis.number_text import short

Columns = dict[str, list[str]]
NAMES = "by"
"""The column of the names of models."""
FORMS = '"5%", "0.05" or "0.4 dB"'
LARGEST = 2.0
"""Of a number: a larger one is a percentage, or decibels, without its unit."""


def decibels(error: float) -> float:
    """Error of an amplitude [dB], from its relative error: 20 lg(1 + error)."""
    return 20 * math.log10(1 + error)


def relative(level: float) -> float:
    """Relative error of an amplitude, from its error [dB]: 10^(level / 20) - 1."""
    return float(10 ** (level / 20) - 1)


def percentage(level: float) -> float:
    """Relative error of an amplitude [%], from its error [dB]."""
    return 100 * relative(level)


@dataclass(frozen=True)
class Tolerance:
    """How far off an answer may be, with the unit in which that was asked.

    Attributes
    ----------
    relative : float
        Half-width over value, 0.05 for 5 %; of a text in (0, 1], of a number up to 2.
    in_decibels : bool
        Whether it was asked in dB of an amplitude, 20 lg(1 + ``relative``).

    Examples
    --------
    >>> tolerance = validation.Tolerance(0.122, in_decibels=True)
    >>> print(tolerance, tolerance.unit, tolerance.shown(0.05))
    1 dB dB 0.42 dB
    """

    relative: float
    in_decibels: bool = False

    @property
    def unit(self) -> str:
        return "dB" if self.in_decibels else "%"

    def in_unit(self, error: float) -> float:
        """A relative error in the unit of the tolerance, a number without it."""
        return decibels(error) if self.in_decibels else 100 * error

    def shown(self, error: float) -> str:
        """An error in the unit of the tolerance, with two digits; "unknown" where none is known."""
        return f"{short(self.in_unit(error))} {self.unit}" if math.isfinite(error) else "unknown"

    def shown_distinct(self, error: float) -> str:
        """An error with as many digits as it takes to differ from the tolerance: 1.04 dB beside 1 dB."""
        text = self.shown(error)
        if text != str(self) or error <= self.relative:
            return text
        limit, shown = self.in_unit(self.relative), self.in_unit(error)
        digits = next((n for n in range(3, 16) if f"{shown:.{n}g}" != f"{limit:.{n}g}"), 16)
        return f"{shown:.{digits}g} {self.unit}"

    def __str__(self) -> str:
        return self.shown(self.relative)


def tolerance_of(tolerance: float | str) -> Tolerance:
    """The tolerance of a ratio, or of a text: in per cent, a ratio, or decibels of an amplitude.

    Raises ValueError for any other text and a number that is no ratio, TypeError for what is neither.
    """
    if not isinstance(tolerance, str):
        if positive("tolerance", tolerance) > LARGEST:
            raise ValueError(f"tolerance must be as {FORMS}, got {tolerance:g}: {_percentages(tolerance)}?")
        return Tolerance(tolerance)
    text, in_decibels = tolerance.strip(), tolerance.strip().lower().endswith("db")
    number = text[:-2] if in_decibels else text.removesuffix("%")
    try:
        value = float(number) * (0.01 if text.endswith("%") else 1.0)
    except ValueError:
        raise ValueError(f"tolerance must be as {FORMS}, got {tolerance!r}") from None
    if text == number and LARGEST < value < math.inf:
        raise ValueError(f"tolerance must be as {FORMS}, got {tolerance!r}: {_percentages(value)}?")
    relative = math.expm1(min(value, 100.0) * math.log(10) / 20) if in_decibels else value
    if not 0 < relative <= 1:
        raise ValueError(f"tolerance must be as {FORMS}, above zero and no more than 100 %, or 6 dB, got {tolerance!r}")
    return Tolerance(relative, in_decibels)


def _percentages(number: float) -> str:
    """A number over 100 in the two ways in which it may be written, for a message: '0.05 or "5%"'."""
    return f'{number / 100:g} or "{number:g}%"'
