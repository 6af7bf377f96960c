"""What a model is told to cost is what it does: cells, positions and springs are counted while it solves."""

import math

import pytest

import mdr
from tests.seeded import catches
from validation.advice.models import boundary_elements_pressed as pressed
from validation.advice.models import pressed as on_profiles
from validation.advice.models_of_scene import models_of
from validation.railway.problems import rail_models, rail_strip
from validation.scenes.load import load_scene
from validation.simulation.model import Target, models_serving
from validation.simulation.model_names import BEM, SPRINGS, SPRINGS_THAT_READ

RAIL = load_scene("rail")
ON_STRIPS = [
    model
    for model in models_serving(RAIL, "contact-filter")
    if model.filter.on_strips and model.name not in (BEM, SPRINGS_THAT_READ)
]


@pytest.mark.parametrize("model", ON_STRIPS, ids=lambda model: model.name)
def test_a_model_of_a_rail_draws_as_many_cells_and_rolls_over_as_many_positions_as_it_says(model, monkeypatch):
    """Of few strips on coarse grids; springs that are finer than cells have strips drawn for themselves."""
    for name, few in (("STRIPS", 2), ("COARSE", 6), ("FINE", 7)):
        monkeypatch.setattr(rail_models, name, few)
    cells, positions = [], []
    draw, roll = rail_strip.draw_surface, rail_models.roll_rail

    def counted_draw(*arguments, **settings):
        cells.append(math.prod(settings["shape"]))
        return draw(*arguments, **settings)

    def counted_roll(problem):
        positions.append(problem.strip.shape[0])
        return roll(problem)

    monkeypatch.setattr(rail_strip, "draw_surface", counted_draw)
    monkeypatch.setattr(rail_models, "roll_rail", counted_roll)
    target = Target(RAIL, "contact-filter")
    (resolution,) = model.resolutions(target)
    told = model.cost(target, resolution)
    model.prepare(target, resolution)(0)()
    assert told.work == sum(cells) + sum(positions) and len(positions) == 4
    seconds = model.filter.seconds * sum(positions) + rail_models.DRAWN * sum(cells)
    assert seconds < told.seconds < seconds + 0.2


@catches("a cost without the strips that are drawn").at("validation.railway.problems.rail_models.DRAWN", 0.0)
def test_cells_that_are_drawn_are_most_of_the_cost_of_springs_on_a_line():
    """Where the draws had been left out, the cost was a twentieth."""
    (line,) = (model for model in ON_STRIPS if model.name == "springs on the line")
    target = Target(RAIL, "contact-filter")
    told = line.cost(target, line.resolutions(target)[0])
    assert told.work * rail_models.DRAWN > 0.8 * told.seconds > 2.0


ROUGH = load_scene("rough_punch")


def test_a_contact_takes_the_applications_that_it_is_told_to():
    for cells in (32, 64):
        grid = pressed.on_grid(cells)
        target = Target(ROUGH)
        found = pressed.MODEL.prepare(target, grid)(0)()
        assert 0.5 < found.work / pressed.cost(target, grid).work < 2


@pytest.mark.parametrize("tolerance", [0.1, 0.12])
def test_all_realisations_are_told_with_those_on_other_grids(tolerance, monkeypatch):
    """Within a factor of two of the contacts that are solved, each by its cells."""
    work, solve = [], pressed.pressed

    def counted(scene, height, residual):
        work.append(pressed.APPLICATIONS * height.size)
        return solve(scene, height, residual)

    monkeypatch.setattr(pressed, "pressed", counted)
    grid = next(one for one in models_of(ROUGH, "stiffness", tolerance, 0) if one.name == f"{BEM} 64²")
    found = grid.solve()
    assert found.error <= tolerance and found.cost.work == sum(work)
    assert 0.5 < sum(work) / grid.cost().work < 2


def test_so_many_realisations_cost_as_much_as_they_are():
    told = [
        next(
            one for one in models_of(ROUGH, "stiffness", 0.01, 0, realisations=count) if one.name == f"{BEM} 64²"
        ).cost()
        for count in (None, 800, 1600)
    ]
    assert told[2].work / told[1].work == pytest.approx(2, rel=0.01) and told[1].work > 50 * told[0].work


def test_profiles_are_told_as_they_are_drawn(monkeypatch):
    drawn, draw = [], mdr.rough_profiles

    def counted(*arguments, **settings):
        drawn.append(settings["points"] * settings["count"])
        return draw(*arguments, **settings)

    monkeypatch.setattr(on_profiles.mdr, "rough_profiles", counted)
    target = Target(ROUGH)
    (springs,) = (model for model in models_serving(ROUGH, "stiffness") if model.name == SPRINGS)
    (resolution,) = springs.resolutions(target)
    springs.prepare(target, resolution)(0)()
    assert springs.cost(target, resolution).work == sum(drawn)
