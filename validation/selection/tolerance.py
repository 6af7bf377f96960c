"""How far off an answer may be, and errors in the unit in which that was asked."""

import math
from dataclasses import dataclass

FORMS = '"5%", "0.05" or "0.4 dB"'


@dataclass(frozen=True)
class Tolerance:
    """relative: half-width over value; in_decibels: whether it was asked in dB, 20 lg(1 + relative)."""

    relative: float
    in_decibels: bool = False

    def shown(self, error: float) -> str:
        """An error in the unit of the tolerance, with two digits; "unknown" where none is known."""
        if not math.isfinite(error):
            return "unknown"
        return f"{short(20 * math.log10(1 + error))} dB" if self.in_decibels else f"{short(100 * error)} %"

    def __str__(self) -> str:
        return self.shown(self.relative)


def tolerance_of(given: float | str) -> Tolerance:
    """A ratio, or a text: in per cent, a ratio, or decibels of an amplitude. Raises ValueError for any other text."""
    if not isinstance(given, str):
        return Tolerance(given)
    text, scale = given.strip(), 1.0
    decibels = text.lower().endswith("db")
    if text.endswith("%"):
        text, scale = text[:-1], 0.01
    elif decibels:
        text = text[:-2]
    try:
        value = scale * float(text)
    except ValueError:
        raise ValueError(f"tolerance must be as {FORMS}, got {given!r}") from None
    relative = 10 ** (value / 20) - 1 if decibels else value
    if not 0 < relative <= 1:
        raise ValueError(f"tolerance must be as {FORMS}, above zero and no more than 100 %, or 6 dB, got {given!r}")
    return Tolerance(relative, decibels)


def short(value: float) -> str:
    """Two digits, without a power of ten where that can be."""
    return f"{float(f'{value:.2g}'):g}"
