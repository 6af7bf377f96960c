"""The referees themselves: integrals, inverses and limits that tie one closed form to another."""

import inspect
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate

from tests.seeded import Times, catches
from tests.strategies import scales
from validation.theory import closed_forms


@given(radius=scales, modulus=scales, approach=scales)
def test_hertz_approach_inverts_the_force(radius, modulus, approach):
    force = closed_forms.hertz_force(radius=radius, modulus=modulus, approach=approach)
    assert closed_forms.hertz_approach(radius=radius, modulus=modulus, force=force) == pytest.approx(
        approach, rel=1e-13
    )


@catches("2/3 for 4/3 in the force of Hertz").at("validation.theory.closed_forms.hertz_force", Times(0.5))
@given(radius=st.floats(0.1, 10), approach=st.floats(0.1, 10))
def test_hertz_pressure_integrates_to_the_force(radius, approach):
    """int p 2 pi r dr with r = a sin(t), which takes the root out of the integrand."""
    a = closed_forms.hertz_contact_radius(radius=radius, approach=approach)
    t, weight = (v / 2 for v in np.polynomial.legendre.leggauss(20))
    t = np.pi / 2 * (t + 0.5)
    p = closed_forms.hertz_pressure(a * np.sin(t), radius=radius, modulus=2.0, approach=approach)
    total = np.sum(weight * p * 2 * np.pi * a * np.sin(t) * a * np.cos(t)) * np.pi / 2
    assert total == pytest.approx(closed_forms.hertz_force(radius=radius, modulus=2.0, approach=approach), rel=1e-12)


@catches("a for 2a in the stiffness of Hertz").at("validation.theory.closed_forms.circular_punch_stiffness", Times(0.5))
@given(radius=st.floats(0.1, 10), approach=st.floats(0.1, 10))
def test_hertz_stiffness_is_that_of_the_punch_of_its_radius(radius, approach):
    step = 1e-4 * approach
    low, high = (
        closed_forms.hertz_force(radius=radius, modulus=2.0, approach=approach + side) for side in (-step, step)
    )
    a = closed_forms.hertz_contact_radius(radius=radius, approach=approach)
    assert (high - low) / (2 * step) == pytest.approx(
        closed_forms.circular_punch_stiffness(radius=a, modulus=2.0), rel=1e-7
    )


def test_hertz_displacement_under_its_pressure_is_the_sphere():
    """u(0) = (1 / pi E*) int p / r dA = d: the pressure carries the approach, by quadrature."""
    p = integrate.quad(lambda r: closed_forms.hertz_pressure(r, radius=3.0, modulus=2.0, approach=0.5), 0, np.sqrt(1.5))
    assert 2 / 2.0 * p[0] == pytest.approx(0.5, rel=1e-8)


WAVE = {"amplitude": 1e-6, "wavelength": 1e-3, "modulus": 1e9}


@given(load=st.floats(0.01, 1.0))
def test_westergaard_pressure_has_its_mean(load):
    mean = load * closed_forms.westergaard_full_pressure(**WAVE)
    a = closed_forms.westergaard_half_width(mean_pressure=mean, **WAVE)
    t = np.pi * (np.arange(4000) + 0.5) / 4000 - np.pi / 2
    x = a * np.sin(t)
    p = closed_forms.westergaard_pressure(x, mean_pressure=mean, **WAVE)
    total = np.sum(p * a * np.cos(t)) * np.pi / 4000
    assert total / 1e-3 == pytest.approx(mean, rel=1e-6)


def test_westergaard_closes_at_the_full_pressure():
    full = closed_forms.westergaard_full_pressure(**WAVE)
    assert closed_forms.westergaard_half_width(mean_pressure=full, **WAVE) == pytest.approx(0.5e-3)
    valley = closed_forms.westergaard_pressure(0.5e-3, mean_pressure=full, **WAVE)
    assert valley == pytest.approx(0, abs=1e-9 * full)


FORMS = [
    form for name, form in inspect.getmembers(closed_forms, inspect.isfunction) if name[0] != "_" and name != "positive"
]


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
@pytest.mark.parametrize("form", FORMS)
def test_bad_input_is_named(form, bad):
    """Of every form; a pressure may be asked for anywhere."""
    parameters = inspect.signature(form).parameters
    for name in parameters.keys() - {"x", "r"}:
        values = {**dict.fromkeys(parameters, 0.1), name: bad}
        places = [values.pop(place) for place in ("x", "r") if place in values]
        with pytest.raises(ValueError, match=f"{name} must be finite and positive"):
            form(*places, **values)


def test_westergaard_beyond_full_contact_is_refused():
    wave = {"amplitude": 1.0, "wavelength": 1.0, "modulus": 1.0}
    assert closed_forms.westergaard_half_width(mean_pressure=math.pi, **wave) > 0
    with pytest.raises(ValueError, match=r"^mean_pressure must not exceed .* full contact, 3.14159, got 4.0$"):
        closed_forms.westergaard_half_width(mean_pressure=4.0, **wave)


def test_square_punch_lies_between_the_circles_of_its_area_and_of_its_diagonal():
    """Of all punches of an area the circle is the softest; a punch that holds another is stiffer."""
    k = closed_forms.square_punch_stiffness(side=3.0, modulus=2.0)
    low, high = (
        closed_forms.circular_punch_stiffness(radius=a, modulus=2.0) for a in (3 / math.sqrt(math.pi), 3 / math.sqrt(2))
    )
    assert low < k < high
    assert k == pytest.approx(1.1523 * 3 * 2, rel=1e-14)


def test_a_rough_punch_is_a_flat_one_in_series_with_its_face():
    scene = {"side": 0.2, "modulus": 3.0}
    flat = closed_forms.square_punch_stiffness(**scene)
    for force in (1e-9, 1e-3, 1e9):
        both = closed_forms.rough_punch_stiffness(force=force, height=1e-3, **scene)
        assert 1 / both == pytest.approx(1 / flat + 0.48 * 1e-3 / force, rel=1e-14)
