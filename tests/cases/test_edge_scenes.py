"""Scenes at the edges of the ranges: drawn again alike, valid, and on both sides of every end."""

import warnings

import numpy as np
import pytest

import bem3d
from validation.cases.selection import edge_scenes
from validation.cases.selection.edge_scenes import EDGE_KINDS, MEASURED, PUNCH, QUANTITIES, ROLLING, SPHERE, edge_scene
from validation.scenes.indentation import IndentationScene
from validation.selection.compare import models_of, quantities_of
from validation.simulation.model import GridModel
from validation.simulation.rolling_levels import by_linear_theory, strip_of
from validation.simulation.rolling_quantity import RollingQuantity
from validation.simulation.sampling import distance


def drawn(kind, count=24):
    return [edge_scene(kind, number, 3) for number in range(count)]


@pytest.mark.parametrize("kind", EDGE_KINDS)
def test_a_scene_is_that_of_its_numbers_and_has_its_quantity(kind):
    for number, (scene, quantity) in enumerate(drawn(kind, 6)):
        again, _ = edge_scene(kind, number, 3)
        assert (again.load, again.ground.rms) == (scene.load, scene.ground.rms)
        assert edge_scene(kind, number, 4)[0].load != scene.load
        assert quantity in quantities_of(scene)
    assert {quantity for _, quantity in drawn(kind)} == set(QUANTITIES[kind.removeprefix(MEASURED)])


@pytest.mark.parametrize("body", QUANTITIES)
def test_some_are_inside_and_some_beyond_what_cheap_models_claim(body):
    found = set()
    for scene, quantity in drawn(body, 72):
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


def pressed(scene):
    """Stiffness of a measured face on all of its points, and how many are in contact: no window, no coarser grid."""
    height, spacing = scene.ground.height, scene.ground.spacing[0]
    gap = -height
    if scene.shape == "sphere":
        x, y = scene.ground.places
        gap = np.add.outer(x**2, y**2) / (2 * scene.size) - height
    half_space = bem3d.HalfSpace(shape=height.shape, spacing=spacing, modulus=scene.modulus)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bem3d.ContactWarning)
        contact = bem3d.solve(half_space, gap, force=scene.load, tolerance=1e-6)
        return contact.stiffness(), np.count_nonzero(contact.pressure)


@pytest.mark.slow
@pytest.mark.parametrize("body", [PUNCH, SPHERE])
def test_claims_hold_on_measured_faces_and_few_of_them_are_refused(body):
    """Two of each texture, as far as sixteen of their points are in contact."""
    within, answerable = [], []
    for number in range(12):
        scene, quantity = edge_scene(MEASURED + body, number, 1)
        stiffness, points = pressed(scene)
        if points < 16:
            continue
        answers = [model.solve() for model in models_of(scene, quantity, 0.3, 0) if model.estimate().in_range]
        errors = [(answer.error, distance(answer.value, stiffness)) for answer in answers if not answer.failed]
        within += [true <= claimed for claimed, true in errors]
        answerable.append(bool(errors))
    assert len(answerable) >= 6 and all(within)
    assert sum(answerable) >= 0.8 * len(answerable)


def test_linear_theory_of_few_points_claims_what_its_cells_leave():
    """Four points to a contact radius: beside the same theory on cells a third as long, which no rule of h/d knows."""
    scene, name = edge_scene(MEASURED + ROLLING, 6, 3)
    linear = next(model for model in models_of(scene, name, 0.3, 0) if model.kind == "linear filter, 3D")
    quantity, answer = RollingQuantity(scene, name), linear.solve()
    fine = by_linear_theory(quantity, strip_of(quantity, 48, 0, 0), scene.contact_radius / 48)
    assert linear.estimate().error < distance(answer.value, fine) <= answer.error
