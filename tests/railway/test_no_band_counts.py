"""Where no model of a rail can be enough: no band counts, or what lies across is left out. No solve is made in vain."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from tests.seeded import catches
from validation import compare, load_scene, summary, to_json
from validation.advice.advice import what_would_help
from validation.advice.cases.model_selection import EdgeTrial, true_error
from validation.advice.scene_model import SceneModel
from validation.analysis.spectra import assessed_bands
from validation.railway.cases import filters
from validation.railway.problems.rail_quantity import COUNTED
from validation.railway.scenes.rail import RailScene
from validation.simulation.method import Resolution
from validation.simulation.model import Target, models_serving

RAIL = load_scene("rail")
assert isinstance(RAIL, RailScene)


def of_bands(inside):
    levels = RAIL.levels
    return replace(
        RAIL, roughness=replace(levels, wavelengths=levels.wavelengths[inside], levels=levels.levels[inside])
    )


SHORT, QUIET = of_bands(slice(25, 29)), of_bands(slice(22, 24))
"""6.3 to 3.15 mm and 12.5 to 10 mm, in a contact 11 mm long."""


def asked(model):
    raise AssertionError(f"{model.name} is solved")


@catches("the bands of a wrong filter that count", across="isotropic", scene=QUIET, span="12.5 to 10 mm").at(
    "validation.railway.problems.rail_quantity.RailQuantity.no_answer", ""
)
@catches("levels counted that no one hears", across="ridges", scene=SHORT, span="6.3 to 3.15 mm").at(
    "validation.railway.problems.rail_quantity.COUNTED", -60.0
)
@pytest.mark.parametrize(("scene", "span"), [(SHORT, "6.3 to 3.15 mm"), (QUIET, "12.5 to 10 mm")])
@pytest.mark.parametrize("across", ["ridges", "isotropic", 0.5, None])
def test_no_model_is_enough_where_no_band_counts(scene, span, across):
    """Also where a wrong filter has one: the linear bed of springs at 12.5 mm."""
    found = compare(
        replace(scene, lateral_structure=across), quantity="contact-filter", tolerance="1 dB", callback=asked
    )
    assert not found.met and found.model == "" and math.isinf(found.error)
    assert all(one.status == "out of range" and math.isinf(one.predicted_error) for one in found.models)
    text = " ".join(summary(found).split())
    assert "no band has A3 above -15 dB" in text and "levels of longer waves would count" in text
    assert span in text and ": enough" not in text
    assert float(text.partition("the contact is ")[2].partition(" mm long")[0]) == pytest.approx(11, abs=0.5)
    assert json.loads(to_json(found))["met"] is False


@catches("enough where no band counts").at(
    "validation.railway.problems.rail_quantity.RailQuantity.largest_error", lambda quantity, a3, error: 0.0
)
def test_a_solve_leaves_its_bands_and_no_error():
    """As with --all: what was found is told, and no error of it is known."""
    for model in models_serving(SHORT, "contact-filter"):
        if model.name.startswith("linear"):
            answer = SceneModel(model, Target(SHORT, "contact-filter", 0.1), Resolution()).solve()
            assert math.isinf(answer.error) and not answer.failed
            assert (20 * np.log10(answer.value) < COUNTED).all() and "no band" in answer.counted


def test_the_longest_band_that_counts_is_enough_for_an_answer():
    found = compare(of_bands(slice(21, 29)), quantity="contact-filter", tolerance="3 dB")
    assert found.met and (found.value > COUNTED).sum() == 1
    assert not compare(SHORT, quantity="equivalent-roughness", tolerance="1 dB").met


def test_a_trial_without_a_band_that_counts_has_no_true_error():
    trial = EdgeTrial(kind="rail", number=0, tolerances=(0.1,), seed=3)
    quiet = np.full(4, 10 ** (-20 / 20))
    assert math.isnan(true_error(trial, quiet, quiet))
    assert true_error(trial, quiet * 2, np.ones(4)) > 0.5


OPEN = replace(RAIL, lateral_structure=None)


def test_no_model_is_solved_that_what_lies_across_makes_too_wide():
    names = []
    found = compare(OPEN, quantity="contact-filter", tolerance="1 dB", callback=lambda one: names.append(one.name))
    assert names == ["linear, ellipse"] and not found.met
    (missed, helps) = what_would_help(found)
    assert missed.startswith("not reached: the tolerance of 1 dB")
    assert 'lateral_structure = "isotropic" or "ridges" in [rail]' in helps


@pytest.mark.parametrize(("scene", "tolerance"), [(RAIL, "0.2 dB"), (OPEN, "1.6 dB")])
def test_a_solve_that_may_help_is_made(scene, tolerance):
    """The ground is known, or both ends are within the tolerance."""

    class AskedError(Exception):
        pass

    def stop(model):
        raise AskedError(model.name)

    with pytest.raises(AskedError, match="boundary elements"):
        compare(scene, quantity="contact-filter", tolerance=tolerance, callback=stop)


@catches("a band behind the first zero that counts").at(
    "validation.advice.cases.model_selection.assessed_bands", lambda level, above: level > above
)
def test_a_second_harmonic_behind_the_first_zero_is_no_failure_of_a_filter():
    """One rule everywhere: bands before the first below -15 dB. A corrugation of 16 mm has its half wavelength there,
    which no linear filter has."""
    trial = EdgeTrial(kind="rail", number=0, tolerances=(0.1,), seed=3)
    a3 = np.array([0.0, -5.0, -16.0, -8.0])
    truth, off = 10 ** (a3 / 20), np.array([1.0, 1.1, 1.0, 0.2])
    assert true_error(trial, truth * off, truth) == pytest.approx(0.1)
    for mask in (assessed_bands(a3, COUNTED), filters.counted(a3)):
        assert mask.tolist() == [True, True, False, False]
    assert assessed_bands(np.array([math.nan, -1.0, -20.0, math.nan]), COUNTED).tolist() == [False, True, False, False]
