"""Numbers as they are printed: cells of tables, and numbers in sentences."""

import math

from validation.analysis.evidence import plus_minus

Columns = dict[str, list[str]]
NAMES = "by"
"""The column of the names of models."""
NONE = "—"


def short(value: float) -> str:
    """Two digits, without a power of ten where that can be."""
    return f"{float(f'{value:.2g}'):g}"


def half_width(error: float) -> str:
    """As "± 1.2", or "± unknown"."""
    return f"± {short(error)}" if math.isfinite(error) else "± unknown"


def signed(value: float, digits: int) -> str:
    """With its sign, but for a zero; a dash where there is no number."""
    if not math.isfinite(value):
        return NONE
    return f"{rounded:+.{digits}f}" if (rounded := round(value, digits)) else f"{0:.{digits}f}"


def tenth(level: float) -> str:
    """To a tenth, without the sign of a zero; a dash where there is no number."""
    return f"{round(float(level), 1) + 0.0:.1f}" if math.isfinite(level) else NONE


def two_digits(error: float) -> str:
    return f"{error:.2g}" if math.isfinite(error) else "unknown"


def scaled(value: float, error: float) -> str:
    """With its error, over a power of ten where that is far from one: (5.49 ± 0.50)e7."""
    power = math.floor(math.log10(value))
    if -3 < power < 4:
        return plus_minus(value, error)
    shown = plus_minus(value / 10**power, error / 10**power)
    return f"({shown})e{power}" if "±" in shown else f"{shown}e{power}"


def format_seconds(seconds: float, least: str = "1 ms") -> str:
    """In a unit that fits; least: of less than a millisecond."""
    if not math.isfinite(seconds):
        return NONE
    units = (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3))
    return next((f"{short(seconds / size)} {unit}" for unit, size in units if seconds >= size), least)
