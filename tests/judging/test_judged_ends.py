"""Past the scenes of its judge a model is led until it breaks; and it stands beside the suite's own by its seconds."""

import itertools
import math
import warnings
from types import SimpleNamespace

import numpy as np
import pytest

from tests.judging.judged_points import (
    INCONCLUSIVE,
    NO_RESULT,
    NOT_SERVED,
    OUTSIDE,
    SCALING,
    SWEEPS,
    WITHIN,
    judged,
    of,
    verdicts,
)
from tests.seeded import catches
from validation.judging import replies
from validation.judging.kinds import own, properties
from validation.judging.kinds.judge import Finding, ModelAnswer, points_of
from validation.judging.kinds.own import ellipse, half_space, in_3d
from validation.judging.kinds.references import Reference
from validation.judging.registry import offer
from validation.judging.worker import Called


def flat(load, side, modulus):
    return 1.1523 * modulus * side


def hertz(height, spacing, modulus, load):
    radius = spacing**2 / -np.diff(height, 2, axis=0).mean()
    return 2 * modulus * (3 * load * radius / (4 * modulus)) ** (1 / 3)


def smooth(line, radius, modulus, approach):
    return 4 / 3 * modulus * radius**0.5 * (approach + line).clip(0) ** 1.5


def under_load(line, radius, modulus, load):
    return (3 * load / (4 * modulus * radius**0.5)) ** (2 / 3) - line


def test_the_grid_of_a_reference_is_added_linearly_to_the_samples_of_both():
    """What the cells leave goes one way in all surfaces: 0.05 + sqrt(0.03^2 + 0.04^2) = 0.1."""
    known = Reference({"H": 0.7}, 1.0, sample=0.03, grid=0.05, quantity="k")
    for value, verdict in ((1.0, WITHIN), (1.09, INCONCLUSIVE), (1.25, OUTSIDE)):
        point = Finding(known, ModelAnswer(value, 0.04)).judged(0.101)
        assert point.verdict == verdict and point.error == pytest.approx(0.1 * value)
    level = Reference({"H": 0.7}, 3.0, sample=0.3, grid=0.5, unit="dB", quantity="k")
    assert Finding(level, ModelAnswer(3.0, 0.4)).judged(0.1).error == pytest.approx(1.0)


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
    assert {point.verdict for point in found} == {WITHIN}


def divides(k_x, a_x):
    return np.sin(k_x * a_x) / (k_x * a_x)


def falls_below(load, side, modulus):
    return flat(load, side, modulus) - 1e5 * load


def twice(q, roughness):
    return 2 * in_3d(q, 2e-3, 1.15e11, roughness)


def springs(line, spacing, radius, modulus, approach):
    """Under a smooth wheel, within half a period: their sum is that of Hertz on small cells."""
    x = spacing[0] * (np.arange(line.size) - line.size // 2)
    return 0 * line + modulus * spacing[0] * (approach - x**2 / radius).clip(0).sum()


def upside_down(line, radius, modulus, approach):
    return smooth(-line, radius, modulus, approach)


WRONG = [
    ("stiffness_model", lambda load: 1e3 * load**0.5, properties.HEAVY, [OUTSIDE] * 4),
    ("stiffness_model", falls_below, properties.HEAVY, [NO_RESULT] * 4),
    ("stiffness_model", lambda load: 1 / load, properties.LIGHT, [OUTSIDE] * 3),
    ("stiffness_of_surface", lambda height, load: 2 * load, properties.FEW, [OUTSIDE] * 5),
    ("force_spectrum", twice, properties.LONG, [OUTSIDE] * 3),
    ("contact_filter", divides, properties.LONG, [NO_RESULT, WITHIN, WITHIN]),
    ("contact_filter", lambda k_x, a_x: 1 + (k_x * a_x) ** 2, properties.SHORT, [OUTSIDE] * 3),
    ("rolling_model", lambda line, approach: 0 * line + approach, properties.SMOOTH, [OUTSIDE] * 5),
    ("rolling_model", springs, properties.SMOOTH, [OUTSIDE, WITHIN, WITHIN, WITHIN, WITHIN]),
    ("rolling_model", upside_down, properties.LONG, [OUTSIDE] * 2),
    ("contact_filter", lambda k_x: 1.05 + 0 * k_x, properties.SHORT, [OUTSIDE] * 3),
]


STAYING = {
    kind: [one._replace(at=one.at[:1] * len(one.at)) for one in some] for kind, some in properties.SWEEPS.items()
}


@catches("a sweep that stays where it begins", *WRONG[5]).at("validation.judging.kinds.properties.SWEEPS", STAYING)
@catches("a track shorter than the contact", *WRONG[8]).at("validation.judging.kinds.properties.TRACK", 1)
@catches("a bound for a closed form", *WRONG[-1]).at("validation.judging.kinds.properties.ROUNDING", None)
@pytest.mark.parametrize(("kind", "function", "quantity", "expected"), WRONG)
def test_where_a_model_breaks_is_found(kind, function, quantity, expected):
    assert [p.verdict for p in of(judged(kind, function, by=SWEEPS), quantity)] == expected


def rooted(height, spacing, modulus, load):
    """As the root of what the load is over the one that flattens the surface."""
    return (modulus * spacing * len(height) * load / height.std()) ** 0.5


@pytest.mark.parametrize(
    ("kind", "function"), [case for case in CASES if case[1] != hertz] + [("stiffness_of_surface", rooted)]
)
def test_what_closed_forms_say_scales(kind, function):
    found = judged(kind, function, tolerance=1e-9, by=SCALING)
    assert {point.verdict for point in found} == (set() if kind == "contact_filter" else {WITHIN})


def steel(modulus):
    """Another power of E*, which is right for one material."""
    return (modulus / 1.15e11) ** 1e-4


def when_heavy(load, side, modulus, roughness):
    return flat(load, side, modulus) * (steel(modulus) if load > modulus * roughness.rms * side else 1)


def unlike(load, side, modulus, rng):
    return flat(load, side, modulus) * (modulus / 1e9) ** 0.04 * rng.normal(1, 1e-3)


UNSCALED = [
    ("stiffness_model", lambda side, modulus: modulus * side * steel(modulus), "modulus", {OUTSIDE}),
    ("stiffness_model", when_heavy, "modulus", {WITHIN, OUTSIDE}),
    ("stiffness_model", unlike, "modulus", {OUTSIDE}),
    ("stiffness_model", lambda side, modulus, rng: flat(0, side, modulus) * rng.normal(1, 0.3), "length", {WITHIN}),
    ("stiffness_model", lambda modulus, load: (modulus * load) ** 0.5, "length", {WITHIN}),
    ("stiffness_model", lambda side, modulus: modulus * side**1.1, "length", {OUTSIDE}),
    ("stiffness_model", lambda load, side: load / (1e-3 * side), "height", {OUTSIDE}),
    (
        "stiffness_of_surface",
        lambda height, modulus, spacing: modulus * spacing * steel(modulus),
        "modulus",
        {OUTSIDE},
    ),
    ("stiffness_of_surface", lambda height, modulus: modulus * 4e-5 * len(height), "length", {OUTSIDE}),
    ("force_spectrum", lambda q, modulus, roughness: in_3d(q, 2e-3, 1.15e11, roughness), "modulus", {OUTSIDE}),
    ("force_spectrum", lambda q, modulus, roughness: in_3d(q, 2e-3, modulus, roughness), "length", {OUTSIDE}),
    ("rolling_model", lambda line, radius, approach: smooth(line, radius, 1.15e11, approach), "modulus", {OUTSIDE}),
    ("rolling_model", lambda line, modulus, approach: smooth(line, 0.5, modulus, approach), "length", {OUTSIDE}),
    ("rolling_model", lambda line, radius, modulus, load: under_load(line, 0.5, modulus, load), "length", {OUTSIDE}),
    ("force_spectrum", lambda q: 1e300 + 0 * q, "length", {OUTSIDE}),
    ("force_spectrum", lambda q: 1e-300 + 0 * q, "length", {OUTSIDE}),
    ("rolling_model", lambda line, load: [][1], "length", {NO_RESULT}),
    ("stiffness_model", lambda side: -side, "height", {NO_RESULT}),
]


ONE = properties.Powers(1, 1, 1)


@catches("a rule of scaling by the tolerance of a user", *UNSCALED[0]).at(
    "validation.judging.kinds.properties.EXACT", 0.5
)
@catches("heights that never change", *UNSCALED[6]).at(
    "validation.judging.kinds.properties.RULES", {**properties.RULES, "scaling with the height": ONE}
)
@pytest.mark.parametrize(("kind", "function", "what", "expected"), UNSCALED)
def test_what_is_right_in_some_units_alone_is_found(kind, function, what, expected):
    """Whatever the tolerance of a user."""
    assert verdicts(judged(kind, function, tolerance=0.5, by=SCALING), f"scaling with the {what}") == expected


@catches("a warning that is not heard").at("validation.judging.worker.Called.warned", property(lambda called: ""))
def test_a_warning_stands_beside_the_number():
    def warns(load, side, modulus, roughness):
        if load > 50 * modulus * roughness.rms * side:
            warnings.warn("too\nheavy", stacklevel=1)
        return flat(load, side, modulus)

    reasons = [p.reason for p in of(judged("stiffness_model", warns, by=SWEEPS), properties.HEAVY)]
    assert reasons == ["", *["it warned: too heavy"] * 3]


def test_its_point_on_the_chart_is_beside_those_of_the_suite(monkeypatch):
    """The same filter has the same error, as it is kept; another one is timed by the same arguments."""
    model = Called(ellipse)
    points = list(points_of(model, 0.1))
    monkeypatch.setattr(replies, "time", SimpleNamespace(perf_counter=itertools.count().__next__))
    mine, *others = own.costs_of(model, points)
    assert [one.model for one in others] == ["linear, ellipse", "linear, on the line", "spring bed (DPRS), linear"]
    assert mine.error == pytest.approx(others[0].error, rel=1e-5) and others[1].error > 10 * mine.error
    # by a clock that each look at it sets forward
    assert [one.seconds for one in (mine, *others)] == 4 * [1]
    assert not own.costs_of(Called(ellipse), [])


def test_seconds_are_of_the_slowest_call_that_was_answered(monkeypatch):
    """What is refused may take longer, and has no time."""
    clock = SimpleNamespace(now=0.0, perf_counter=lambda: clock.now)
    monkeypatch.setattr(replies, "time", clock)

    def but_for_long_waves(k_x, a_x):
        if k_x.min() * a_x < 1e-3:
            clock.now += 5.0
            raise ValueError("too long")
        clock.now += 2.0 if k_x.size > 100 else 1.0
        return divides(k_x, a_x)

    model = Called(offer("contact_filter", "mine", {}, but_for_long_waves))
    points = list(points_of(model, 0.1))
    assert {point.verdict for point in points} >= {NOT_SERVED, OUTSIDE}
    assert model.longest["k_x"].size > 100
    assert own.costs_of(model, points)[0].seconds == 2.0


@catches("another quantity on the chart of errors").at(
    "validation.judging.kinds.own.MAIN", dict.fromkeys(own.MAIN, "contact filter of a long wave")
)
def test_errors_are_medians_of_the_quantity_of_their_kind():
    points = list(points_of(Called(offer("contact_filter", "mine", {}, divides)), 0.1))
    known = [abs(p.difference) for p in of(points, "contact filter")]
    assert own.error_of("contact_filter", points) == pytest.approx(np.median(known))
    assert math.isnan(own.error_of("contact_law", points))


@catches("a rule of scaling by ten times the interval of its draws").at(
    "validation.judging.kinds.properties.OF_SAMPLE", 20.0
)
def test_draws_that_scale_wrong_by_more_than_two_intervals_are_found():
    """Each draw has its own power of E*, whose mean is off one by 4 %; the interval of eight draws is some 1.5 %."""

    def powers(load, side, modulus, rng):
        return flat(load, side, modulus) * (modulus / 1e9) ** rng.normal(0.04, 0.012)

    found = of(judged("stiffness_model", powers, by=SCALING), "scaling with the modulus")
    assert {point.verdict for point in found} == {OUTSIDE}
    assert all(0.02 < point.difference < 0.07 for point in found)
