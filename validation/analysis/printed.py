"""Numbers and their margins as answers print them."""

import math
from collections.abc import Callable

from validation.analysis.evidence import Number, plus_minus
from validation.analysis.statistics import DECIBEL

Printed = Callable[[Number], str]
A_FACTOR = 1.2
"""A larger margin of a ratio is no per cent: up and down are not alike."""


def margin_of(number: Number, printed: Printed | None) -> str:
    """Its tolerance as its values are printed."""
    if printed is share:
        return f"{100 * number.tolerance:.2g} %"
    if printed in (per_cent, times):
        factor = math.exp(number.tolerance / DECIBEL)
        return f"a factor of {factor:.3g}" if factor > A_FACTOR else f"{100 * (factor - 1):.2g} %"
    return f"{float(f'{number.tolerance:.2g}'):g}{number.behind}"


def beside(number: Number) -> str:
    """Value with its interval, and its reference unless that is zero."""
    value = plus_minus(number.value, number.uncertainty)
    sign = "+" if not number.reference and number.value > 0 else ""
    digits = 6 if number.tolerance < 1e-3 * abs(number.reference) else 5
    known = f"{number.reference:.{digits}g}"
    if number.uncertainty > 0 and abs(number.reference) < 1000:
        known = f"{float(plus_minus(number.reference, number.uncertainty).split(' ')[0]):g}"
    of = f" beside {known}" if number.reference else ""
    return f"{sign}{value}{of}{number.behind}"


def off_by(number: Number) -> str:
    """What is left of a difference to a closed form."""
    return f"off by {number.difference:+.1e}{number.behind}"


def share(number: Number) -> str:
    """Of a whole, in per cent."""
    half = f" ± {100 * number.uncertainty:.2g}" if number.uncertainty else ""
    return f"{100 * number.value:.2g}{half} %"


def times_source(number: Number) -> str:
    """What is over that of its source."""
    return f"{number.value:.3g} times that of {number.source}"


def decibels(number: Number) -> str:
    """To a tenth, with an interval that has one: "+0.2 ± 0.5 dB", "+0.2 dB", "less than 0.05 dB"."""
    value, half_width = (round(x, 1) + 0.0 for x in (number.value, number.uncertainty))
    if not half_width:
        return f"{value:+.1f} dB" if value else "less than 0.05 dB"
    return f"{value:+.1f} ± {half_width:.1f} dB"


def decibels_rms(number: Number) -> str:
    """Of decibels, which has no sign: "2.5 dB rms"."""
    return f"{decibels(number).removeprefix('+')} rms"


def _ratios(number: Number) -> list[float]:
    """A ratio of amplitudes in decibels, and the ends of its interval, as factors."""
    return [math.exp((number.value + x) / DECIBEL) for x in (0, -number.uncertainty, number.uncertainty)]


def per_cent(number: Number) -> str:
    """A ratio of amplitudes in decibels with its interval, in per cent; less than 1 % of its reference is none left."""
    middle, low, high = (100 * (ratio - 1) for ratio in _ratios(number))
    half = max(high - middle, middle - low)
    said = plus_minus(middle, half) if half > 0.05 else f"{middle:.1f}"
    return f"{'+' if middle > 0 else ''}{said} %" if middle > -99 + 1e-9 else "none left"


def times(number: Number) -> str:
    """A ratio of amplitudes in decibels with its interval, as a factor without an exponent."""
    middle, low, high = (f"{float(f'{ratio:.2g}'):g}" for ratio in _ratios(number))
    return f"{middle} times ({low} to {high})"
