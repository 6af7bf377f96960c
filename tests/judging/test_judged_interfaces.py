"""Models of an interface of others are objects of the core, in the table of the suite's own."""

import math

import numpy as np
import pytest

from tests.judging.judged_points import NOT_SERVED, OUTSIDE, WITHIN, judged, of, verdicts
from tests.seeded import Times, catches
from validation.judging.kinds import interfaces, own
from validation.judging.kinds.interfaces import (
    AREA,
    CONTACT,
    GAP,
    METHODS,
    STIFFNESS,
    JudgedInterface,
    OfferedInterface,
)
from validation.judging.kinds.judge import LostError
from validation.judging.kinds.references import reference_rows
from validation.judging.kinds.stiffness import HEIGHT, MODULUS, SIDE
from validation.judging.registry import offer
from validation.judging.worker import Called
from validation.theory.interface import InterfaceModel, Persson, RoughnessSpectrum, quantities_of

KIND = "interface_model"


def spectrum_of(roughness):
    return RoughnessSpectrum.of_c2d(roughness.c2d, (roughness.q_min, roughness.q_roll_off, roughness.q_max))


def stiffness_alone(pressure, roughness, quantity):
    if quantity != "stiffness":
        raise NotImplementedError("a stiffness alone")
    return pressure / (0.48 * roughness.rms)


@catches("loads of an interface by the slope in one direction").at(
    "validation.judging.kinds.interfaces.JudgedInterface.pressure", Times(math.sqrt(2))
)
def test_perssons_area_is_the_contact_that_names_a_load():
    """erf at a load is the contact that it is named by."""
    points = of(judged(KIND, own.persson), AREA)
    rows = reference_rows(AREA)
    assert len(points) == len(rows) == 35
    for point, row in zip(points, rows, strict=True):
        assert point.value == pytest.approx(row[CONTACT] / 100, rel=1e-6)
        assert point.difference == pytest.approx(row[CONTACT] / 100 / row.value - 1, rel=1e-5)
    # some 30 % low at 1 %: outside of 10 %, within 45 %
    assert verdicts(points, AREA, **{CONTACT: 1.0}) == {OUTSIDE}
    assert verdicts(judged(KIND, own.persson, 0.45), AREA, **{CONTACT: 1.0}) == {WITHIN}


@catches("the gap over another height").at("validation.judging.kinds.interfaces.SIDE", 2 * SIDE)
def test_what_boundary_elements_have_is_within():
    """Asked with the pressure of each row, in SI units: A / L^2, u = h times the row, K = p / h times the row."""
    rows = {
        (method, row[interfaces.ROLL_OFF], row[interfaces.H]): [] for method in METHODS for row in reference_rows(AREA)
    }
    for method, quantity in METHODS.items():
        for row in reference_rows(quantity):
            rows[method, row[interfaces.ROLL_OFF], row[interfaces.H]].append((row[CONTACT], row.value))

    def from_table(pressure, modulus, roughness, quantity):
        ground = round(roughness.q_roll_off / roughness.q_min), roughness.hurst
        gradient = spectrum_of(roughness).gradient
        contact = 100 * math.erf(math.sqrt(2) * pressure / (modulus * gradient))
        near, value = min(rows[quantity, *ground], key=lambda pair: abs(math.log(pair[0] / contact)))
        assert near == pytest.approx(contact, rel=1e-3) or near in (1.0, 10.0)
        h = 1e-3 * 1e-2
        return value * {"area_fraction": 1.0, "mean_gap": h, "stiffness": pressure / h}[quantity]

    points = judged(KIND, from_table, 0.15)
    compared = [point for quantity in METHODS.values() for point in of(points, quantity)]
    assert len(compared) == 105
    assert all(abs(point.difference) < 1e-6 for point in compared)
    assert {point.verdict for quantity in (GAP, AREA) for point in of(points, quantity, **{CONTACT: 10.0})} == {WITHIN}


def test_what_a_model_does_not_have_is_not_served_and_breaks_no_rule():
    points = judged(KIND, stiffness_alone)
    assert verdicts(points, AREA) == verdicts(points, GAP) == {NOT_SERVED}
    assert {p.quantity for p in points} == {
        *METHODS.values(),
        *(f"{STIFFNESS}: scaling with the {name}" for name in ("modulus", "length")),
    }
    # between 3 and 10 % the constant is right
    assert verdicts(points, STIFFNESS, **{CONTACT: 10.0}) == {WITHIN}


RULES = [
    (lambda p, q: 1.0, ()),
    (lambda p, q: {"stiffness": 1.1}.get(q, 1.0), ("stiffness over the slope of the gap",)),
    (lambda p, q: {"mean_gap": 0.5}.get(q, 1.0), ("stiffness over the slope of the gap",)),
]


@pytest.mark.parametrize(("factor", "broken"), RULES)
def test_the_stiffness_is_the_slope_of_the_gap(factor, broken):
    def scaled(pressure, modulus, roughness, quantity):
        model = Persson(spectrum_of(roughness), modulus)
        return factor(pressure, quantity) * float(getattr(model, quantity)(pressure))

    points = judged(KIND, scaled)
    rules = [p for p in points if p.quantity not in METHODS.values()]
    assert {p.quantity for p in rules if p.verdict is OUTSIDE} == set(broken)


@catches("no other modulus in a rule of scaling", "modulus").at(
    "validation.judging.kinds.interfaces.OfferedInterface.answers",
    lambda offered, method, pressures: [float(p) for p in pressures],
)
@pytest.mark.parametrize("forgotten", ["modulus", "length"])
def test_a_unit_that_is_forgotten_breaks_a_rule(forgotten):
    def wrong(pressure, modulus, roughness, quantity):
        spectrum = spectrum_of(roughness)
        modulus = 1e9 if forgotten == "modulus" else modulus
        value = float(getattr(Persson(spectrum, modulus), quantity)(pressure))
        return value * (roughness.q_min if forgotten == "length" and quantity != "area_fraction" else 1.0)

    points = judged(KIND, wrong)
    broken = {p.quantity for p in points if "scaling" in p.quantity and p.verdict is OUTSIDE}
    assert any(quantity.endswith(forgotten) for quantity in broken)
    other = "length" if forgotten == "modulus" else "modulus"
    assert not any(quantity.endswith(other) for quantity in broken)


def test_an_offered_function_is_a_model_of_the_core():
    ground = JudgedInterface(8, 0.7)
    model = OfferedInterface(Called(offer(KIND, "mine", {}, stiffness_alone)), ground.roughness, MODULUS)
    assert isinstance(model, InterfaceModel) and model.name == "mine"
    assert quantities_of(model) == tuple(METHODS)
    pressures = np.array([[1e3, 2e3]])
    assert model.stiffness(pressures) == pytest.approx(pressures / (0.48 * HEIGHT * SIDE))
    with pytest.raises(LostError, match="a stiffness alone"):
        model.area_fraction(pressures)


def test_the_roughness_that_is_given_has_the_heights_and_slopes_of_its_name():
    ground = JudgedInterface(8, 0.7)
    spectrum = spectrum_of(ground.roughness)
    assert spectrum.height == pytest.approx(HEIGHT * SIDE, rel=1e-6)
    contact = math.erf(math.sqrt(2) * ground.pressure(3.0) / (MODULUS * spectrum.gradient))
    assert contact == pytest.approx(0.03, rel=1e-6)
