"""A contact model is one file: found there, it is in `compare`, on the charts and in the solver comparison."""

import math
import sys
from dataclasses import replace

import numpy as np
import pytest

from tests.benchmarks.made_up import use_a_clock_of_its_own
from validation.advice import models
from validation.advice.compare import compare
from validation.advice.models import boundary_elements_pressed, rolling
from validation.advice.models_of_scene import models_of
from validation.advice.scene_model import SceneModel
from validation.advice.summary import summary
from validation.benchmarks import timing
from validation.benchmarks.peers import all_methods
from validation.benchmarks.work_precision.pareto import points
from validation.benchmarks.work_precision.problem import Grids, RollingProblem, RoughPunchProblem, measure
from validation.scenes.scene import STIFFNESS, SceneQuantity
from validation.simulation.method import Resolution
from validation.simulation.model import Target
from validation.simulation.model_names import FILTER_3D
from validation.simulation.rough_punch import PunchRoughness

TOY = """
import numpy as np

from validation.simulation.method import Result
from validation.simulation.model import Cost, ErrorEstimate, model


@model(
    name="toy",
    setting="three realisations",
    serves=lambda scene, quantity: quantity == "stiffness" and getattr(scene, "shape", "") == "punch" and scene.ground,
    claim=lambda model, target, resolution: ErrorEstimate(model=0.01, reason="by decree"),
    cost=lambda target, resolution: Cost(work=3, seconds=1e-9),
)
def toy(target, resolution):
    return Result({"stiffness": target.scene.stiffness * np.array([0.4, 0.5, 0.6])}, count=3)
"""


@pytest.fixture
def toy(tmp_path, monkeypatch):
    """A model in a folder of its own, beside those that are there."""
    (tmp_path / "toy_model.py").write_text(TOY, encoding="utf-8")
    monkeypatch.setattr(models, "__path__", [*models.__path__, str(tmp_path)])
    yield
    sys.modules.pop(f"{models.__name__}.toy_model", None)


PUNCH = PunchRoughness(hurst=0.7, waves=(1, 8), seed=0).scene(force=0.1)


def test_a_model_that_is_found_is_a_candidate(toy):
    assert models_of(PUNCH, "stiffness", 0.1, 0)[0].name == "toy"
    found = compare(PUNCH, tolerance=1.0)
    best = found.selection.best
    assert best.model.name == "toy" and best.status == "accepted"
    assert best.answer.value == pytest.approx(PUNCH.stiffness / 2)
    # of three realisations
    assert best.answer.sample == pytest.approx(4.303 * 0.2 / math.sqrt(3), rel=1e-3)
    assert "by toy" in summary(found)


def test_a_model_that_is_found_is_on_the_charts(toy, monkeypatch):
    use_a_clock_of_its_own(monkeypatch)
    grids = Grids(cells=(16, 32), fixed=16, tolerances=())
    problem = RoughPunchProblem(waves=7, realisations=3, profiles=3, grids=grids, springs=(16,))
    chart = points(problem, measure(timing.TimedProblem(problem=problem, slow=1.0, enough=0.0)))
    mine = {point.quantity: point for point in chart if point.method == "toy"}
    assert {"mean stiffness", "relative deviation"} == set(mine)
    assert all(point.finished for point in mine.values())
    assert mine["mean stiffness"].setting == "three realisations"
    assert "toy" in all_methods()


@pytest.mark.slow
def test_a_rolling_model_that_is_found_is_on_the_chart_of_its_quantity(monkeypatch):
    """The rms force of linear theory is the same in one and in three dimensions, under whatever name."""
    use_a_clock_of_its_own(monkeypatch)
    monkeypatch.setattr(rolling, "linear_filter_1d", replace(rolling.linear_filter_1d, name="found"))
    grids = Grids(cells=(2, 4), fixed=2, tolerances=(), per="to a radius")
    problem = RollingProblem(last=4.0, length=24, width=12, tracks=2, grids=grids, springs=(8,))
    chart = points(problem, measure(timing.TimedProblem(problem=problem, slow=1.0, enough=0.0)))
    rms = {point.method: point for point in chart if point.quantity == "rms"}
    assert rms["found"].finished and rms["found"].is_model
    assert rms["found"].over == pytest.approx(rms[FILTER_3D].over, rel=1e-6)
    assert [point.status for point in chart if point.method == "found" and point.quantity == "spectrum"] == [
        "out of range: it does not have this quantity"
    ]


@pytest.mark.parametrize(("itself", "mean"), [(True, 4.0), (False, math.sqrt(12.0))])
def test_a_second_quantity_of_a_punch_says_how_its_realisations_are_averaged(monkeypatch, itself, mean):
    """(2 + 6) / 2, or sqrt(2 * 6): no name of a quantity decides it."""
    gap = SceneQuantity("mean-gap", "m", averaged_itself=itself)
    monkeypatch.setattr(type(PUNCH), "quantities", property(lambda scene: (STIFFNESS, gap)))
    gaps = SceneModel(boundary_elements_pressed.MODEL, Target(PUNCH, "mean-gap", 0.1, 0), Resolution())
    found, half = gaps._mean(np.array([[2.0], [6.0]]))
    assert found == pytest.approx([mean]) and half > 0
