"""Numbers as text: each quantity in its own form, and no digit that its interval does not leave."""

import math
from dataclasses import replace

import pytest

from tests.analysis.test_judged_claims import point
from validation.analysis.number_text import (
    decibels,
    decibels_rms,
    deviation_text,
    enumeration,
    format_seconds,
    half_open_text,
    half_width_text,
    in_seconds,
    interval_text,
    level_in_decibels,
    off_by,
    per_cent,
    place_value,
    plus_minus,
    scaled,
    share,
    short,
    signed,
    tenth,
    times,
    times_source,
    tolerance_text,
    two_digits,
    with_prefix,
    with_reference,
)


def test_a_value_without_a_finite_interval_says_so():
    assert plus_minus(12.3, math.inf) == "12 ± unknown"


@pytest.mark.parametrize(
    ("printer", "value", "half_width", "text"),
    [
        (decibels, 0.24, 0.51, "+0.2 ± 0.5 dB"),
        (decibels, -1.26, 0.04, "-1.3 dB"),
        (decibels, -0.04, 0.01, "less than 0.05 dB"),
        (decibels, -0.04, 0.3, "+0.0 ± 0.3 dB"),
        (decibels_rms, 2.49, 0.0, "2.5 dB rms"),
        (times, 51.0, 0.0, "350 times (350 to 350)"),
        (times, -6.0, 1.0, "0.5 times (0.45 to 0.56)"),
        (per_cent, 20 * math.log10(2), 0.0, "+100.0 %"),
        (per_cent, 1.0, 0.0, "+12.2 %"),
        (per_cent, -1.0, 0.5, "-10.9 ± 5.3 %"),
        (per_cent, -40.0, 0.0, "none left"),
        (off_by, 1.0, 0.0, "off by +1.0e+00 dB"),
        (times_source, 0.5, 0.0, "0.5 times that of s"),
        (share, 0.123, 0.04, "12 ± 4 %"),
        (with_reference, 3.0, 0.1, "+3.00 ± 0.10 dB"),
    ],
)
def test_a_number_is_printed_as_its_quantity(printer, value, half_width, text):
    assert printer(point(value, half_width)) == text


@pytest.mark.parametrize(
    ("printer", "tolerance", "text"),
    [
        (with_reference, 0.333, "0.33 dB"),
        (share, 0.05, "5 %"),
        (per_cent, 1.0, "12 %"),
        (times, 6.0, "a factor of 2"),
    ],
)
def test_a_tolerance_is_printed_as_the_values_are(printer, tolerance, text):
    assert tolerance_text(point(0.0, tolerance=tolerance), printer) == text


def test_a_reference_of_five_digits_has_no_exponent():
    assert with_reference(point(12520.0, 190.0, reference=12566.4, tolerance=377.0)) == "12520 ± 190 beside 12566 dB"


def test_a_number_is_printed_beside_its_reference_with_the_digits_of_its_tolerance():
    near = point(1234.5, reference=1234.5678, tolerance=1.0)
    assert [with_reference(replace(near, tolerance=t)) for t in (1.0, 2.0)] == [
        "1234.5 beside 1234.57 dB",
        "1234.5 beside 1234.6 dB",
    ]
    assert [with_reference(point(x)) for x in (0.5, 0.0, -0.5)] == ["+0.5 dB", "0 dB", "-0.5 dB"]


def test_what_rounds_to_zero_has_no_sign_of_its_own():
    assert (tenth(-0.04), tenth(-0.04, sign="+"), signed(-0.04, 1)) == ("0.0", "+0.0", "0.0")
    assert (tenth(2.46), tenth(2.46, sign="+"), signed(2.46, 1)) == ("2.5", "+2.5", "+2.5")


def test_what_is_not_finite_is_a_dash_or_unknown():
    assert {tenth(math.nan), signed(math.inf, 1), format_seconds(math.nan)} == {"—"}
    assert (two_digits(math.inf), half_width_text(math.inf)) == ("unknown", "± unknown")


def test_digits_and_powers_of_ten():
    assert [short(x) for x in (0.456, 123.4, 1e5)] == ["0.46", "120", "100000"]
    assert (short(0.456, 1), two_digits(123.4)) == ("0.5", "1.2e+02")
    assert [place_value(x) for x in (0.12345, 999.9, 1402.4, 2e6)] == ["0.123", "1e+03", "1402", "2e+06"]
    assert (scaled(5.49e7, 5e6), scaled(12.0, 0.5)) == ("(5.49 ± 0.50)e7", "12.00 ± 0.50")


def test_ranges_of_a_parameter():
    assert (interval_text(0.46416, 10.0), interval_text(10.0, 10.0)) == ("0.464 to 10", "10")
    assert half_open_text("F", 0.1, 1.0) == "0.1 ≤ F < 1" and half_open_text("F", 1, 10, closed=True) == "1 ≤ F ≤ 10"


def test_durations_and_prefixes_of_units():
    assert [format_seconds(x) for x in (7200.0, 90.0, 2.0, 0.054, 1e-5)] == ["2 h", "1.5 min", "2 s", "54 ms", "1 ms"]
    assert format_seconds(1e-5, least="< 1 ms") == "< 1 ms"
    assert (in_seconds(0.0543), with_prefix(2e-6), with_prefix(2.1e11)) == ("54 ms", "2 µ", "210 G")


def test_a_deviation_is_in_per_cent_or_decibels():
    assert (deviation_text(0.12, "-", "+"), deviation_text(-3.14, "dB")) == ("+12 %", "-3.1 dB")


def test_a_level_that_rounds_to_nothing_has_no_minus():
    assert [level_in_decibels(level) for level in (-0.04, 0.04, -0.06)] == ["+0 dB", "+0 dB", "-0.1 dB"]


def test_two_names_with_commas_are_joined_by_and():
    """Of three the commas would not tell where one ends."""
    assert enumeration(["a, 1", "b"]) == "a, 1 and b"
