"""Past the scenes of its judge a model is led until it breaks; and it stands beside the suite's own by its seconds."""

import math
import time
import warnings

import numpy as np
import pytest

from tests.selection.judged_points import SWEEPS, judged, of
from validation.engine.offered import offer
from validation.engine.others import Called
from validation.selection.judging import own, sweeps
from validation.selection.judging.judge import points_of
from validation.selection.judging.own import ellipse, half_space, in_3d


def flat(load, side, modulus):
    return 1.1523 * modulus * side


def hertz(height, spacing, modulus, load):
    radius = spacing**2 / -np.diff(height, 2, axis=0).mean()
    return 2 * modulus * (3 * load * radius / (4 * modulus)) ** (1 / 3)


def smooth(line, radius, modulus, approach):
    return 4 / 3 * modulus * radius**0.5 * (approach + line).clip(0) ** 1.5


def under_load(line, radius, modulus, load):
    return (3 * load / (4 * modulus * radius**0.5)) ** (2 / 3) - line


RIGHT = {
    "stiffness_model": [flat, lambda load, side, modulus, rng: flat(load, side, modulus)],
    "stiffness_of_surface": [hertz],
    "force_spectrum": [in_3d],
    "contact_filter": [ellipse],
    "rolling_model": [half_space, smooth, under_load],
}
CASES = [(kind, function) for kind in RIGHT for function in RIGHT[kind]]


@pytest.mark.parametrize(("kind", "function"), CASES)
def test_what_closed_forms_say_breaks_nowhere(kind, function):
    found = judged(kind, function, by=SWEEPS)
    assert len({point.quantity for point in found}) > (kind == "contact_filter")
    assert {point.verdict for point in found} == {"agree"}


def divides(k_x, a_x):
    return np.sin(k_x * a_x) / (k_x * a_x)


def falls_below(load, side, modulus):
    return flat(load, side, modulus) - 1e5 * load


def twice(q, roughness):
    return 2 * in_3d(q, 2e-3, 1.15e11, roughness)


def upside_down(line, radius, modulus, approach):
    return smooth(-line, radius, modulus, approach)


WRONG = [
    ("stiffness_model", lambda load: 1e3 * load**0.5, sweeps.HEAVY, ["differ"] * 4),
    ("stiffness_model", falls_below, sweeps.HEAVY, ["failed"] * 4),
    ("stiffness_model", lambda load: 1 / load, sweeps.LIGHT, ["differ"] * 3),
    ("stiffness_of_surface", lambda height, load: 2 * load, sweeps.FEW, ["differ"] * 5),
    ("force_spectrum", twice, sweeps.LONG, ["differ"] * 3),
    ("contact_filter", divides, sweeps.LONG, ["failed", "agree", "agree"]),
    ("contact_filter", lambda k_x, a_x: 1 + (k_x * a_x) ** 2, sweeps.SHORT, ["differ"] * 3),
    ("rolling_model", lambda line, approach: 0 * line + approach, sweeps.SMOOTH, ["differ"] * 5),
    ("rolling_model", upside_down, sweeps.LONG, ["differ"] * 2),
    ("contact_filter", lambda k_x: 1.05 + 0 * k_x, sweeps.SHORT, ["differ"] * 3),
]


@pytest.mark.parametrize(("kind", "function", "quantity", "expected"), WRONG)
def test_where_a_model_breaks_is_found(kind, function, quantity, expected):
    assert [p.verdict for p in of(judged(kind, function, by=SWEEPS), quantity)] == expected


def test_a_warning_stands_beside_the_number():
    def warns(load, side, modulus, roughness):
        if load > 50 * modulus * roughness.rms * side:
            warnings.warn("too\nheavy", stacklevel=1)
        return flat(load, side, modulus)

    reasons = [p.reason for p in of(judged("stiffness_model", warns, by=SWEEPS), sweeps.HEAVY)]
    assert reasons == ["", *["it warned: too heavy"] * 3]


def test_its_point_on_the_chart_is_beside_those_of_the_suite():
    """The same filter has the same error, as it is kept; another one is timed by the same arguments."""
    model = Called(ellipse)
    mine, *others = own.costs_of(model, list(points_of(model, 0.1)))
    assert [one.model for one in others] == ["linear, ellipse", "linear, on the line", "spring bed (DPRS), linear"]
    assert mine.error == pytest.approx(others[0].error, rel=1e-5) and others[1].error > 10 * mine.error
    assert all(0 < one.seconds < 10 for one in (mine, *others))
    assert not own.costs_of(Called(ellipse), [])


def test_seconds_are_of_the_slowest_call_that_was_answered():
    """What is refused may take longer, and has no time."""

    def but_for_long_waves(k_x, a_x):
        if k_x.min() * a_x < 1e-3:
            time.sleep(0.2)
            raise ValueError("too long")
        time.sleep(0.03 * (k_x.size > 100))
        return divides(k_x, a_x)

    model = Called(offer("contact_filter", "mine", {}, but_for_long_waves))
    points = list(points_of(model, 0.1))
    assert {point.verdict for point in points} >= {"refused", "differ"}
    assert model.longest["k_x"].size > 100
    assert 0.03 < own.costs_of(model, points)[0].seconds < 0.2


def test_errors_are_medians_of_the_quantity_of_their_kind():
    points = list(points_of(Called(offer("contact_filter", "mine", {}, divides)), 0.1))
    known = [abs(p.difference) for p in of(points, "contact filter")]
    assert own.error_of("contact_filter", points) == pytest.approx(np.median(known))
    assert math.isnan(own.error_of("contact_law", points))
