"""Numbers by which `compare` goes on, gives up or leaves out, and the ends of intervals that it writes."""

import csv
import io
import math
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import pytest

import validation
from tests.advice.planted_answers import Finding, compared
from tests.judging.test_own_models import OPEN, PUNCH, SCENES, answers, stored
from tests.seeded import catches
from validation.advice import compare
from validation.advice.models_of_scene import models_of
from validation.advice.scene_model import Answer, SceneModel
from validation.judging import own_models
from validation.railway.models.rail import LINEAR_ELLIPSE
from validation.railway.problems.rail_quantity import COUNTED
from validation.simulation.method import Resolution
from validation.simulation.model import Cost, ErrorEstimate, Sampling, Target
from validation.theory.closed_forms import rough_punch_stiffness

ROUGH = validation.load_scene("rough_punch")


def test_the_ends_of_an_interval_are_the_value_less_and_more_its_error():
    text = validation.to_csv(compared(Finding(value=(5.0,), parts=(0.1, 0, 0))))
    (row,) = csv.DictReader(io.StringIO(text))
    assert [float(row[name]) for name in ("low", "value", "high")] == pytest.approx([4.5, 5.0, 5.5])


def test_another_seed_draws_other_surfaces_and_the_same_one_the_same():
    found = [validation.compare(ROUGH, models="springs", seed=seed).value for seed in (0, 1, 0)]
    assert found[0] == found[2] != found[1]


@catches("a model out of its range that takes as long as it likes", seconds=61.0, solved=False).at(
    "validation.advice.compare.LONGEST_BEYOND_RANGE", math.inf
)
@pytest.mark.parametrize(("seconds", "solved"), [(59.0, True), (61.0, False)])
def test_out_of_its_range_a_model_is_solved_that_takes_a_minute_at_the_most(seconds, solved):
    target = SimpleNamespace(scene=ROUGH, quantity="stiffness")
    model = SimpleNamespace(target=target, cost=lambda: Cost(work=1, seconds=seconds))
    assert compare._beyond(model) is solved


@pytest.mark.parametrize(("known", "is_known"), [(20, True), (19, False)])
def test_an_error_is_known_of_a_model_that_answers_twenty_scenes(known, is_known):
    scenes = [point for point, *_ in answers().scenes(PUNCH) if point.number != OPEN]
    points = [point.target().scene.load for point in scenes][:known]

    @validation.stiffness_model(f"of {known}")
    def of_some(load, side, modulus, roughness):
        if not any(math.isclose(load, one) for one in points):
            raise ValueError("no answer to this load")
        return rough_punch_stiffness(side=side, modulus=modulus, force=load, height=roughness.rms)

    assert known < SCENES - 2
    with stored((PUNCH, answers())):
        (own,) = own_models.of_functions([of_some], ROUGH, "stiffness")
    assert (own.errors[PUNCH].measured is not None) is is_known


@catches("bands of which nothing is left").at("validation.railway.problems.rail_quantity.COUNTED", -math.inf)
def test_bands_count_in_which_something_is_left():
    rail = validation.load_scene("rail")
    answer = SceneModel(LINEAR_ELLIPSE, Target(rail, "contact-filter"), Resolution()).solve()
    expected = 20 * np.log10(answer.value) > COUNTED
    assert answer.counts == tuple(expected.tolist()) and 0 < sum(answer.counts) < len(answer.counts)


@dataclass(frozen=True)
class Scripted(SceneModel):
    """A grid whose errors are told, and how many surfaces it was asked for. noise: whether more surfaces lessen it."""

    noise: bool = True
    asked: list = field(default_factory=list)

    @property
    def sampling(self):
        return Sampling(scatter=0.2, fewest=8, most=1000, compared=8)

    def estimate(self):
        return ErrorEstimate(sample=0.01, reason="told")

    def _answer(self, expected, count, compared, before):
        self.asked.append((count, compared))
        grid = 0.5 / math.sqrt(compared) if self.noise else 0.2
        about = {"cost": Cost(work=1, seconds=1.0), "realisations": count}
        return Answer(value=np.ones(1), grid=grid, sample=0.2 / math.sqrt(count), **about)


def scripted(noise):
    model = next(one for one in models_of(ROUGH, "stiffness", 0.05, 0) if one.name.startswith("boundary"))
    return Scripted(model.model, Target(ROUGH, "stiffness", 0.05), model.resolution, noise=noise)


@catches("noise taken for the error of a grid").at("validation.advice.scene_model.FALLS", 0.5)
def test_a_grid_whose_error_is_noise_is_compared_on_more_surfaces():
    model = scripted(noise=True)
    answer = model.solve()
    assert answer.error <= 0.05 and model.asked[-1][1] > 64
    assert model.asked[0] == (8, 8) and model.asked[1] == (16, 16)


@catches("the error of a grid taken for noise").at("validation.advice.scene_model.FALLS", 1.0)
def test_a_grid_whose_error_is_its_own_is_given_up_soon():
    model = scripted(noise=False)
    assert model.solve().error > 0.05 and model.asked == [(8, 8), (16, 16)]
