"""Quantities with units: the nearest float, the same number in any unit, and other forms refused by name."""

from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from tests.seeded import catches
from validation.analysis.escapes import quoted
from validation.scenes import units
from validation.scenes.units import UNITS, in_unit, quantity

# what a unit is in SI, written down here once more
TIMES = {"m": 1, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9, "km": 1e3}
TIMES |= {"kg": 1, "g": 1e-3, "t": 1e3, "N": 1, "kN": 1e3, "MN": 1e6, "mN": 1e-3}
TIMES |= {"Pa": 1, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "m/s": 1, "mm/s": 1e-3, "km/h": 1 / 3.6, "dB": 1, "%": 1e-2}
TIMES |= {"kgf": 9.80665, "tf": 9806.65, "daN": 10, "uN": 1e-6, "µN": 1e-6, "nN": 1e-9, "bar": 1e5}
TIMES |= {"N/m2": 1, "kN/m2": 1e3, "MN/m2": 1e6, "N/mm2": 1e6, "kN/mm2": 1e9, "cm/s": 1e-2, "um/s": 1e-6, "µm/s": 1e-6}
EVERY_UNIT = [(dimension, unit) for dimension, units in UNITS.items() for unit in units]


@catches("a load in uN taken for one in mN", text="40 uN", dimension="force", value=4e-5).at(
    "validation.scenes.units.UNITS", {**units.UNITS, "force": {**units.UNITS["force"], "uN": Fraction(1, 1000)}}
)
@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("0.5 um", "length", 5e-07),
        ("0.5 \N{GREEK SMALL LETTER MU}m", "length", 5e-07),
        ("  +0.5   um ", "length", 5e-07),
        ("72 km/h", "speed", 20.0),
        ("-2 m/s", "speed", -2.0),
        ("10N", "force", 10.0),
        ("5e-3mm", "length", 5e-6),
        ("40 uN", "force", 4e-5),
        ("40 \N{MICRO SIGN}N", "force", 4e-5),
        ("40 \N{GREEK SMALL LETTER MU}N", "force", 4e-5),
        ("7nN", "force", 7e-9),
        ("3 daN", "force", 30.0),
        ("210000 N/mm²", "pressure", 210e9),
        ("210000 N/mm^2", "pressure", 210e9),
        ("210 kN/mm2", "pressure", 210e9),
        ("6 bar", "pressure", 6e5),
        ("5 µm/s", "speed", 5e-6),
    ],
)
def test_a_quantity_is_the_nearest_float(text, dimension, value):
    assert quantity("it", text, dimension) == value


def test_every_unit_is_known_here():
    assert {unit for _, unit in EVERY_UNIT} == set(TIMES)


@pytest.mark.parametrize(("dimension", "unit"), EVERY_UNIT)
@given(value=st.floats(1e-200, 1e200))
@example(value=0.1)
@example(value=1e22)
def test_a_quantity_is_the_same_number_in_any_unit(dimension, unit, value):
    # dividing here, the unit here, and the reading each round once: 2^-53 times three, to first order
    assert quantity("it", f"{value / TIMES[unit]!r} {unit}", dimension) == pytest.approx(value, rel=4 * 2**-53, abs=0)


@given(digits=st.integers(-(10**17), 10**17))
def test_metric_prefixes_do_not_round(digits):
    assert quantity("it", f"{digits} um", "length") == float(f"{digits}e-6")
    assert quantity("it", f"{digits} GPa", "pressure") == float(f"{digits}e9")


@pytest.mark.parametrize(
    ("value", "dimension", "words"),
    [
        (2e-9, "force", "2 nN"),
        (4e-5, "force", "40 µN"),
        (1e-3, "force", "1 mN"),
        (4905, "force", "4.905 kN"),
        (3e-12, "force", "0.003 nN"),
        (210e9, "pressure", "210 GPa"),
        (0.92, "length", "920 mm"),
    ],
)
def test_a_value_is_printed_in_the_largest_unit_that_leaves_a_digit_before_the_point(value, dimension, words):
    assert in_unit(value, dimension) == words
    assert quantity("it", words, dimension) == pytest.approx(value, rel=1e-5)


FORMS = "10² m|0.5|m|0.5 kg|0.5 inch|0.5 M|half m|0,5 m|0x1 m|1 m 2 mm|0.5 m m|0.5 dm|0. 5m"


@pytest.mark.parametrize("wrong", [0.5, 1, True, None, ["0.5 m"], "", *FORMS.split("|")])
def test_other_forms_are_refused_with_an_example_and_the_units(wrong):
    with pytest.raises(ValueError, match=r'^wheel.radius must be a length, as "0.5 m", in one of m, .*, km, ') as no:
        quantity("wheel.radius", wrong, "length")
    assert str(no.value).endswith(f"got {quoted(wrong)}")


@pytest.mark.parametrize(("dimension", "unit"), EVERY_UNIT)
def test_units_of_other_dimensions_are_refused(dimension, unit):
    for other in UNITS:
        if other != dimension:
            with pytest.raises(ValueError, match=f"^it must be a {other}, as .*{unit}"):
                quantity("it", f"1 {unit}", other)


@pytest.mark.parametrize("number", ["nan", "-nan", "snan", "inf", "-inf", "1e400", "1e999999999", "-1e400"])
def test_quantities_that_are_not_finite_are_refused(number):
    with pytest.raises(ValueError, match=f'^wheel.mass must be finite, got "{number} t"$'):
        quantity("wheel.mass", f"{number} t", "mass")


@pytest.mark.parametrize("number", ["0", "-0.0", "-1", "1e-400", "-1e-999999999"])
def test_quantities_that_are_not_positive_are_refused_where_they_must_be(number):
    assert quantity("wheel.mass", f"{number} kg", "mass") <= 0
    with pytest.raises(ValueError, match=f'^wheel.mass must be positive, got "{number} kg"$'):
        quantity("wheel.mass", f"{number} kg", "mass", positive=True)
