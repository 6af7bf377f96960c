"""How far off an answer may be, and errors in the unit in which that was asked."""

import math
from dataclasses import dataclass

from mdr.checks import positive
from validation.analysis.evidence import plus_minus

Columns = dict[str, list[str]]
NAMES = "by"
"""The column of the names of models."""
NONE = "—"


def short(value: float) -> str:
    """A number with two digits, without a power of ten where that can be."""
    return f"{float(f'{value:.2g}'):g}"


def half_width(error: float) -> str:
    """An error as "± 1.2", or "± unknown"."""
    return f"± {short(error)}" if math.isfinite(error) else "± unknown"


def signed(value: float, digits: int) -> str:
    """A number with its sign, but for a zero; a dash where it is not finite."""
    if not math.isfinite(value):
        return NONE
    return f"{rounded:+.{digits}f}" if (rounded := round(value, digits)) else f"{0:.{digits}f}"


def tenth(level: float) -> str:
    """A level to a tenth, without the sign of a zero; a dash where it is not finite."""
    return f"{round(float(level), 1) + 0.0:.1f}" if math.isfinite(level) else NONE


def two_digits(error: float) -> str:
    return f"{error:.2g}" if math.isfinite(error) else "unknown"


def scaled(value: float, error: float) -> str:
    """A number with its error, over a power of ten where that is far from one: (5.49 ± 0.50)e7."""
    power = math.floor(math.log10(value))
    if -3 < power < 4:
        return plus_minus(value, error)
    shown = plus_minus(value / 10**power, error / 10**power)
    return f"({shown})e{power}" if "±" in shown else f"{shown}e{power}"


def format_seconds(seconds: float, least: str = "1 ms") -> str:
    """A duration in a unit that fits. least: the text for less than a millisecond."""
    if not math.isfinite(seconds):
        return NONE
    units = (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3))
    return next((f"{short(seconds / size)} {unit}" for unit, size in units if seconds >= size), least)


FORMS = '"5%", "0.05" or "0.4 dB"'
LARGEST = 2.0
"""Of a number: a larger one is a percentage, or decibels, without its unit."""


def decibels(error: float) -> float:
    """Error of an amplitude [dB], from its relative error: 20 lg(1 + error)."""
    return 20 * math.log10(1 + error)


def relative(level: float) -> float:
    """Relative error of an amplitude, from its error [dB]: 10^(level / 20) - 1."""
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
