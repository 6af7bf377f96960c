"""Error bars of boundary elements on a rail, on tracks that are made up: sample, grid, and what the ground leaves."""

import math
from contextlib import contextmanager
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats
from scipy.optimize import brentq

from tests.seeded import catches
from validation import load_scene
from validation.advice.scene_model import SceneModel
from validation.railway.models.rail import BOUNDARY_ELEMENTS
from validation.railway.problems import rail_models
from validation.railway.problems.rail_models import ContactFilter
from validation.railway.problems.rail_quantity import RailQuantity
from validation.railway.problems.rail_strip import strip_bands
from validation.simulation.method import Resolution
from validation.simulation.model import Target, models_serving
from validation.simulation.model_names import BEM, LINEAR

RAIL = load_scene("rail")
OPEN = replace(RAIL, lateral_structure=None)
POWERS = np.array([0.8, 1.3, 1.0, 0.9, 1.2, 1.1])
"""Of boundary elements on each strip, over linear theory."""
GRID = 0.35
"""What the coarse grid has more than the fine one [dB]."""


@contextmanager
def planted(powers, grid=0.0):
    """Boundary elements that have so many times the power of linear theory on each strip, on the coarse grid more.

    powers: of all strips, or by what lies across them.
    """
    white = np.random.default_rng(0).standard_normal(2048)
    length = 60 * max(RAIL.contact.along, RAIL.contact.across)

    def strip(scene, across, cells, realisation, seed):
        power = (powers[across] if isinstance(powers, dict) else powers)[realisation]
        return SimpleNamespace(spacing=length / white.size, cells=cells, power=power, shape=(white.size, cells))

    def roll(model, scene, strip):
        off = grid if strip.cells == rail_models.COARSE else 0.0
        gain = math.sqrt(strip.power) * 10 ** (off / 20)
        return {LINEAR: white, BEM: gain * white, "failed": np.array(0.0)}

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rail_models, "strip_of", strip)
        patch.setattr(rail_models.ContactFilter, "roll", roll)
        yield


def aspect(scene):
    return scene.contact.across / scene.contact.along


def found(scene=RAIL):
    quantity = RailQuantity(scene, "contact-filter")
    return (
        quantity,
        SimpleNamespace(**BOUNDARY_ELEMENTS.filter.find(quantity, 0)),
        np.isin(quantity.bands.numbers, strip_bands(scene).numbers),
    )


over_twin = ContactFilter.over_twin


def without_sample_error(*args):
    value, error = over_twin(*args)
    return value, 0 * error


@catches("boundary elements on a rail without their sample error").at(
    "validation.railway.problems.rail_models.ContactFilter.over_twin", without_sample_error
)
def test_the_sample_leaves_students_interval_of_the_strips():
    """t s / sqrt(6) of the mean of six powers, in decibels."""
    with planted(POWERS):
        _, filters, inside = found()
    expected = stats.t.ppf(0.975, 5) * POWERS.std(ddof=1) / math.sqrt(6) / POWERS.mean() * 10 / math.log(10)
    assert expected > 0.5 and not filters.grid.any()
    np.testing.assert_allclose(filters.sample[inside], expected, rtol=0.02)
    assert not filters.sample[~inside].any()


def test_of_both_ends_of_what_lies_across_the_larger_error_counts():
    """Strips of one end alone scatter: a ground that may be that one is known no better."""
    with planted(POWERS):
        alone = found()[1].sample
    for ends in ({"ridges": POWERS, "isotropic": np.ones(6)}, {"ridges": np.ones(6), "isotropic": POWERS}):
        with planted(ends):
            _, filters, inside = found(OPEN)
        np.testing.assert_allclose(filters.sample[inside], alone[inside], rtol=1e-9)


@catches("a_x / a_y in place of a_y / a_x", over=0.48, known=True).at(
    "validation.railway.problems.rail_models.ASPECTS", (1 / 1.9, 1 / 0.45)
)
@pytest.mark.parametrize(("over", "known"), [(0.43, False), (0.48, True), (1.8, True), (2.0, False)])
def test_contacts_longer_or_wider_than_those_on_strips_have_no_known_error(over, known):
    """Strips had a_y / a_x from 0.45 to 1.9, which is nearly (R_y / R_x)^(2/3)."""
    quantity = RailQuantity(RAIL, "contact-filter")
    (linear,) = (one for one in models_serving(RAIL, "contact-filter") if one.name == LINEAR)
    radius = brentq(lambda r: aspect(replace(RAIL, crown_radius=r)) - over, 0.03, 5.0)
    reason = linear.filter.beyond(replace(quantity, scene=replace(RAIL, crown_radius=radius)))
    assert reason == ("" if known else f"a_y / a_x is {over:.2g}: errors were measured from 0.45 to 1.9")


def test_a_reason_names_the_worst_of_the_bands_that_count():
    """The error is larger where nothing is left to hear, which decides nothing."""
    quantity = RailQuantity(RAIL, "contact-filter")
    a3, nominal = quantity.linear[0], 1000 * quantity.bands.nominal
    error = np.select([nominal == 40, a3 <= -15], [2.0, 5.0], 0.5)
    assert rail_models.reason_of(quantity, a3, error).startswith("its error is largest at 40 mm: ")


@catches("a tenth of the grid error of boundary elements on a rail").at(
    "validation.railway.problems.rail_models.OF_FINE", 0.1 * rail_models.OF_FINE
)
def test_the_grid_leaves_what_second_order_makes_of_two_grids():
    """An error of order h^2 on 12 cells is 1 / ((12/8)^2 - 1) = 0.8 of the difference from 8."""
    with planted(np.ones(6), GRID):
        _, filters, inside = found()
    order = 1 / ((rail_models.FINE / rail_models.COARSE) ** 2 - 1)
    np.testing.assert_allclose(filters.grid[inside], order * GRID, rtol=1e-6)
    assert not filters.grid[~inside].any() and filters.sample[inside].max() < 1e-6


model_error = ContactFilter.model_error


@catches("a bias on a rail added at a right angle").at(
    "validation.advice.scene_model.Answer.error_in_bands",
    property(lambda answer: np.sqrt(sum(part**2 for part in answer.band_errors.values()))),
)
@catches("a bias of the worst band on a rail added at a right angle").at(
    "validation.advice.scene_model.Answer.error",
    property(lambda answer: float(np.sqrt(answer.model**2 + answer.grid**2 + answer.sample**2))),
)
@catches("boundary elements that know what lies across a rail").at(
    "validation.railway.problems.rail_models.ContactFilter.model_error",
    lambda model, quantity, a3: model_error(model, quantity, a3) - quantity.left_by_ground,
)
def test_what_the_ground_leaves_adds_to_grid_and_sample_as_it_is():
    """A bias: half of the difference of ridges and isotropic ground, and the other two at a right angle beside it."""
    with planted(POWERS, GRID):
        quantity, filters, inside = found(OPEN)
        answer = SceneModel(BOUNDARY_ELEMENTS, Target(OPEN, "contact-filter", 0.5), Resolution()).solve()
    ends = [
        RailQuantity(replace(RAIL, lateral_structure=across), "contact-filter").linear[0]
        for across in ("ridges", "isotropic")
    ]
    half = np.abs(ends[0] - ends[1]) / 2
    np.testing.assert_allclose(filters.model[inside], half[inside], rtol=1e-9)
    random = np.sqrt(filters.grid**2 + filters.sample**2)
    np.testing.assert_allclose(answer.error_in_bands, filters.model + random, rtol=1e-9)
    counted = quantity.counted(filters.a3)
    worst = float((filters.model + random)[counted].max())
    assert 20 * math.log10(1 + answer.error) == pytest.approx(worst, rel=1e-6)
    # its parts are those of that band, beside which one that does not count is worse
    at = int(np.argmax(np.where(counted, filters.model + random, 0.0)))
    assert (filters.model + random).max() > worst
    parts = [20 * math.log10(1 + part) for part in (answer.grid, answer.sample)]
    assert parts == pytest.approx([filters.grid[at], filters.sample[at]], rel=1e-6)
