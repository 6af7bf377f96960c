"""The test of all error estimates: what it draws, counts and decides, and that estimates hold on new surfaces."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from tests.selection.planted_answers import Finding, punch
from validation.analysis.study import Outcomes
from validation.cases.selection import model_selection as ladder
from validation.cases.selection import model_selection_study as calibration
from validation.cases.selection.random_scenes import KINDS, random_scene
from validation.selection.quantities import models_of
from validation.simulation.models import pressed


@pytest.fixture(scope="module")
def account():
    return ladder.run(ladder.CalibrationTest(punches=3, spheres=1, rolling=1, tolerances=(0.1, 0.3)))


@pytest.mark.slow
def test_estimated_errors_hold_on_surfaces_that_no_model_has_seen(account):
    found = calibration.STUDY.evidence(account)
    scenes = found.table("scenes")
    assert len(scenes["kind"]) == 2 * 5
    met = scenes["met"] == 1
    assert met.any()
    assert (scenes["estimated error"][met] <= scenes["tolerance"][met]).all()
    assert (scenes["true error"][met] <= scenes["estimated error"][met] + scenes["error of the reference"][met]).all()
    assert (scenes["true error"][met] > 0).all()
    assert len(found.numbers) == 2 * 2


def outcome(estimated, true, spent, fine, *, met=1.0):
    """Of a trial at one tolerance."""
    one = {"model": 0.0, "estimated": estimated, "true": true, "spent": spent, "fine": fine, "met": met}
    return {name: np.array([value]) for name, value in one.items()} | {"reference": np.array(0.0)}


def test_answers_at_the_edges_are_a_claim_and_scenes_that_are_refused_are_named():
    case = ladder.CalibrationTest(punches=1, spheres=0, rolling=0, edges=(("punch", 3),))
    edge = {"estimated": np.array([0.1]), "met": np.ones(1), "reference": np.array(0.0), "offered": np.array(0.0)}
    edges = [{**edge, "true": np.array([true]), "refused": np.array("")} for true in (0.05, 0.3)]
    edges.append({**edge, "true": np.array([math.nan]), "refused": np.array("too narrow")})
    found = calibration.STUDY.evidence(Outcomes(case, {"random": [outcome(0.1, 0.05, 5.0, 10.0)], "edges": edges}))
    held, far_off, refused = found.claims[-1].numbers
    assert (held.value, refused.value, far_off.value) == (50.0, 0.0, pytest.approx(200.0))
    assert found.table(calibration.AT_EDGES)["held"].tolist() == [1]
    (row,) = zip(*found.table(calibration.UNTESTED).columns.values(), strict=True)
    assert row == ("punch", case.edge_trials[2].number, "too narrow")


def test_the_calibration_test_has_the_numbers_it_is_given():
    """Three of four estimates hold; two are out of reach, one has no answer."""
    outcomes = [
        outcome(0.1, 0.05, 5.0, 10.0),
        outcome(0.1, 0.09, 2.0, 10.0),
        outcome(0.1, 0.20, 22.0, 110.0),
        outcome(0.3, 0.20, 0.25, 10.0, met=0.0),
        outcome(math.nan, math.nan, 1.0, 10.0, met=0.0),
    ]
    case = ladder.CalibrationTest(punches=5, spheres=0, rolling=0, wheels=0, tolerances=(0.1,))
    found = calibration.STUDY.evidence(Outcomes(case, {"random": outcomes, "edges": []}))
    covered, spent = found.numbers
    assert covered.value == pytest.approx(75)
    # Clopper and Pearson, three of four
    assert covered.sample == pytest.approx(75 - 100 * stats.beta.ppf(0.025, 3, 2))
    assert spent.value == pytest.approx(2925 / 140) and 0 < spent.sample < 50
    assert [claim.numbers for claim in found.claims] == [(covered,), (spent,)]


def test_savings_are_beside_the_measured_time_of_the_reference(monkeypatch):
    """It was expected to take 10 s and took 25: so would fine boundary elements at the tolerance of the selection."""
    fine = Finding(kind="boundary elements", claimed=9.0, seconds=10.0, spent=25.0)
    monkeypatch.setattr(ladder, "models_of", lambda *_: [Finding(parts=(0.1, 0, 0), value=(1.2,), spent=0.5), fine])
    trial = ladder.CalibrationTest(punches=1, tolerances=(0.2,)).trials[-1]
    found = ladder.calibrate(trial)
    assert {name: found[name].tolist() for name in ("fine", "spent", "estimated", "met")} == {
        "fine": [25.0],
        "spent": [0.5],
        "estimated": [0.1],
        "met": [1.0],
    }
    assert found["true"] == pytest.approx(math.log(1.2))
    assert ladder.MODELS[int(found["model"][0])] == "springs"


@given(kind=st.sampled_from(KINDS), number=st.integers(0, 10**6))
def test_random_scenes_are_the_same_for_the_same_numbers(kind, number):
    assert random_scene(kind, number, 7) == random_scene(kind, number, 7)
    assert random_scene(kind, number, 7) != random_scene(kind, number, 8)


def test_a_model_that_the_case_does_not_know_is_an_error():
    models = models_of(punch(), "stiffness", 0.1, 0)
    new = replace(models[0], model=replace(pressed.springs, name="a new closed form"))
    with pytest.raises(
        ValueError, match=r"^the kind of a model must be one of .*closed form, .*, got a new closed form$"
    ):
        ladder.name_in_models(new, models)
    assert ladder.COARSE not in ladder.CHEAP
