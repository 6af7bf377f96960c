"""Scenes at the edges of the ranges: drawn again alike, valid, and on both sides of every end."""

import numpy as np
import pytest

from validation.cases.selection import edge_scenes
from validation.cases.selection.edge_scenes import EDGE_KINDS, MEASURED, PUNCH, edge_scene
from validation.scenes.indentation import IndentationScene
from validation.selection.compare import models_of, quantities_of
from validation.simulation.model import GridModel


def drawn(kind, count=24):
    return [edge_scene(kind, number, 3) for number in range(count)]


@pytest.mark.parametrize("kind", EDGE_KINDS)
def test_a_scene_is_that_of_its_numbers_and_has_its_quantity(kind):
    for number, (scene, quantity) in enumerate(drawn(kind, 6)):
        again, _ = edge_scene(kind, number, 3)
        assert (again.load, again.ground.rms) == (scene.load, scene.ground.rms)
        assert edge_scene(kind, number, 4)[0].load != scene.load
        assert quantity in quantities_of(scene)
    assert {quantity for _, quantity in drawn(kind)} == set(edge_scenes.QUANTITIES[kind.removeprefix(MEASURED)])


@pytest.mark.parametrize("kind", EDGE_KINDS)
def test_some_are_inside_and_some_beyond_what_cheap_models_claim(kind):
    found = set()
    for scene, quantity in drawn(kind, 72):
        cheap = [model for model in models_of(scene, quantity, 0.3, 0) if model.kind != GridModel.name]
        found.add(any(model.estimate().in_range for model in cheap))
        if len(found) == 2:
            break
    assert found == {True, False}


@pytest.mark.parametrize("texture", edge_scenes.TEXTURES)
def test_of_measured_textures_a_gaussian_one_alone_is_told_by_its_spectrum(texture):
    """Of punches under all loads and bands; plateaus, ridges, outliers and pits are beyond a spectrum."""
    first = edge_scenes.TEXTURES.index(texture)
    scenes = [edge_scene(MEASURED + PUNCH, first + len(edge_scenes.TEXTURES) * i, 5)[0] for i in range(12)]
    assert all(isinstance(scene, IndentationScene) for scene in scenes)
    known = np.mean([scene.ground.beyond_a_spectrum() == () for scene in scenes])
    assert known >= 0.8 if texture is edge_scenes.gaussian_face else known <= 0.1
