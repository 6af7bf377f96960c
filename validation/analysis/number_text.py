"""Numbers as text: values with half-widths, units, decibels, per cent, factors and durations.

Functions of a float come first, those of a `Number` with its interval, unit and reference after them.
"""

import math
from collections.abc import Callable, Sequence

from validation.analysis.evidence import Number, Place
from validation.analysis.statistics import DECIBEL

NONE = "—"
"""In the place of a number that is not finite."""
PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}
DURATIONS = (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3))


def plus_minus(value: float, half_width: float) -> str:
    """A value with its interval, to the second digit of that: 12640 ± 110; of no finite interval "± unknown"."""
    if math.isinf(half_width):
        return f"{short(value)} {half_width_text(half_width)}"
    if not half_width > 0:
        return f"{value:.5g}"
    place = 1 - math.floor(math.log10(half_width))
    # what rounds to nothing has no sign
    rounded, half = round(value, place) + 0.0, round(half_width, place)
    if place < 8:
        return f"{rounded:.{max(place, 0)}f} ± {half:.{max(place, 0)}f}"
    return f"{value:.5g} ± {half_width:.2g}"


def scaled(value: float, half_width: float) -> str:
    """A value with its interval, over a power of ten where that is far from one: (5.49 ± 0.50)e7."""
    power = math.floor(math.log10(value))
    if -3 < power < 4:
        return plus_minus(value, half_width)
    shown = plus_minus(value / 10**power, half_width / 10**power)
    return f"({shown})e{power}" if "±" in shown else f"{shown}e{power}"


def half_width_text(half_width: float) -> str:
    """ "± 1.2", or "± unknown"."""
    return f"± {short(half_width)}" if math.isfinite(half_width) else "± unknown"


def short(value: float, digits: int = 2) -> str:
    """The value with so many significant digits, then as %g prints it: "0.052", "1e+07"."""
    return f"{float(f'{value:.{digits}g}'):g}"


def two_digits(value: float) -> str:
    """The value with two significant digits, "1.2e+03" from 100 on; "unknown" where it is not finite."""
    return f"{value:.2g}" if math.isfinite(value) else "unknown"


def signed(value: float, digits: int) -> str:
    """The value with so many decimals and its sign, a zero without one; a dash where it is not finite."""
    if not math.isfinite(value):
        return NONE
    return f"{rounded:+.{digits}f}" if (rounded := round(value, digits)) else f"{0:.{digits}f}"


def tenth(level: float, sign: str = "-") -> str:
    """A level to a tenth, of which no zero is negative; a dash where it is not finite. sign: "+" for both signs."""
    return f"{round(float(level), 1) + 0.0:{sign}.1f}" if math.isfinite(level) else NONE


def interval_text(low: float, high: float, digits: int = 3) -> str:
    """ "0.464 to 10"; of two equal ends "10"."""
    return f"{low:.{digits}g} to {high:.{digits}g}" if high > low else f"{low:.{digits}g}"


def half_open_text(name: str, low: float, high: float, *, closed: bool = False) -> str:
    """ "0.01 ≤ Fbar < 0.1", so that neighbours share no value; closed: the last of them."""
    return f"{low:.2g} ≤ {name} {'≤' if closed else '<'} {high:.2g}"


def place_value(value: float) -> str:
    """The value of a condition with three digits; from 1000 to 1e6 it is rounded to a whole number."""
    return f"{value:.0f}" if 1000 <= abs(value) < 1e6 else f"{value:.3g}"


def place_text(place: Place) -> str:
    """A value or a range of a condition, "0.1", "177 to 1402", a region by its name."""
    ends = place if isinstance(place, tuple) else (place,)
    return " to ".join(end if isinstance(end, str) else place_value(end) for end in ends)


def enumeration(names: Sequence[object]) -> str:
    """ "a", "a and b", "a, b and c", and of names that have commas themselves "a, 1; b, 1; c"."""
    *before, last = map(str, names)
    if len(before) > 1 and any(", " in str(name) for name in names):
        return "; ".join((*before, last))
    return f"{', '.join(before)} and {last}" if before else last


def with_prefix(value: float) -> str:
    """A value with a prefix of its unit, which follows: "2 µ"."""
    power = int(f"{value:e}".partition("e")[2]) // 3 * 3
    return f"{value / 10.0**power:.5g} {PREFIXES[power]}"


def in_seconds(seconds: float) -> str:
    """Two digits with a prefix: "54 ms"."""
    return f"{with_prefix(float(f'{seconds:.2g}'))}s"


def format_seconds(seconds: float, least: str = "1 ms") -> str:
    """A duration in a unit that fits: "2 min". least: the text for less than a millisecond."""
    if not math.isfinite(seconds):
        return NONE
    return next((f"{short(seconds / size)} {unit}" for unit, size in DURATIONS if seconds >= size), least)


def deviation_text(difference: float, unit: str, sign: str = "-") -> str:
    """A relative deviation in per cent, "+12 %", or in dB, where that is its unit: "-3.1 dB"."""
    return f"{difference:{sign}.2g} dB" if unit == "dB" else f"{100 * difference:{sign}.3g} %"


def level_in_decibels(level: float) -> str:
    """The level rounded to 0.1 dB, with its sign: "-1.1 dB"."""
    return f"{round(level, 1) + 0.0:+.3g} dB"


def level_in_per_cent(level: float) -> str:
    """The ratio of two amplitudes, from its level [dB]: "-12 %"."""
    return f"{round(100 * math.expm1(level / DECIBEL)) + 0:+d} %"


def level_as_factor(level: float) -> str:
    """The ratio of two amplitudes, from its level [dB]: "0.53 times", "350 times"."""
    return f"{short(math.exp(level / DECIBEL))} times"


Printer = Callable[[Number], str]
"""How a claim, or a matrix, prints its numbers."""
LARGEST_PER_CENT = 1.2
"""A larger tolerance of a ratio is a factor: up and down are not alike."""


def with_reference(number: Number) -> str:
    """Value with its interval, and its reference unless that is zero: "12520 ± 190 beside 12566 N"."""
    value = plus_minus(number.value, number.uncertainty)
    sign = "+" if not number.reference and number.value > 0 else ""
    digits = 6 if number.tolerance < 1e-3 * abs(number.reference) else 5
    reference = f"{number.reference:.{digits}g}"
    if number.uncertainty > 0 and abs(number.reference) < 1000:
        reference = f"{float(plus_minus(number.reference, number.uncertainty).split(' ')[0]):g}"
    relation = f" beside {reference}" if number.reference else ""
    return f"{sign}{value}{relation}{number.behind}"


def off_by(number: Number) -> str:
    """What is left of a difference to a closed form."""
    return f"off by {number.difference:+.1e}{number.behind}"


def share(number: Number) -> str:
    """The share that a number between 0 and 1 is, in per cent with its interval: "12 ± 3 %"."""
    half = f" ± {100 * number.uncertainty:.2g}" if number.uncertainty else ""
    return f"{100 * number.value:.2g}{half} %"


def times_source(number: Number) -> str:
    """Its ratio to that of its source."""
    return f"{number.value:.3g} times that of {number.source}"


def decibels(number: Number) -> str:
    """A number in dB and its interval, rounded to 0.1 dB: "+0.2 ± 0.5 dB", "+0.2 dB", "less than 0.05 dB"."""
    value, half_width = (round(x, 1) + 0.0 for x in (number.value, number.uncertainty))
    if not half_width:
        return f"{value:+.1f} dB" if value else "less than 0.05 dB"
    return f"{value:+.1f} ± {half_width:.1f} dB"


def decibels_rms(number: Number) -> str:
    """A root mean square in dB, which has no sign: "2.5 dB rms"."""
    return f"{decibels(number).removeprefix('+')} rms"


def _ratios(number: Number) -> list[float]:
    """A ratio of amplitudes in decibels, and the ends of its interval, as factors."""
    return [math.exp((number.value + x) / DECIBEL) for x in (0, -number.uncertainty, number.uncertainty)]


def per_cent(number: Number) -> str:
    """A ratio of amplitudes in decibels with its interval, in per cent; less than 1 % of its reference is none left."""
    middle, low, high = (100 * (ratio - 1) for ratio in _ratios(number))
    half = max(high - middle, middle - low)
    text = plus_minus(middle, half) if half > 0.05 else f"{middle:.1f}"
    return f"{'+' if middle > 0 else ''}{text} %" if middle > -99 + 1e-9 else "none left"


def times(number: Number) -> str:
    """A ratio of amplitudes in decibels with its interval, as a factor without an exponent."""
    middle, low, high = map(short, _ratios(number))
    return f"{middle} times ({low} to {high})"


def tolerance_text(number: Number, printer: Printer) -> str:
    """Its tolerance as its values are printed."""
    if printer is share:
        return f"{100 * number.tolerance:.2g} %"
    if printer in (per_cent, times):
        factor = math.exp(number.tolerance / DECIBEL)
        return f"a factor of {factor:.3g}" if factor > LARGEST_PER_CENT else f"{100 * (factor - 1):.2g} %"
    return f"{short(number.tolerance)}{number.behind}"
