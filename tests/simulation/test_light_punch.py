"""Light loads on few cells: the same stiffness as by transforms, on the same surface."""

import dataclasses
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import bem3d
from bem3d import few_cells
from tests.oracles import approach_by_least_squares, contact_by_least_squares, dense_operator
from tests.seeded import catches
from validation.simulation import rough_punch as light_punch
from validation.simulation import surface
from validation.simulation.rough_punch import PunchRoughness, Surface, press_lightly, press_surface
from validation.simulation.surface import refined

ROUGHNESS = PunchRoughness(hurst=0.7, waves=(1, 16), seed=5)
SURFACE = Surface(roughness=ROUGHNESS, realisation=3, cells=64, forces=(0.001, 0.01, 0.1), tolerance=1e-6)
COMMON = ("stiffness", "area", "approach")


def half_a_fine_cell_aside(height, cells):
    """The mean of neighbours: what it is between them, nearly."""
    fine = surface.refined(height, cells)
    return (fine + np.roll(fine, 1, axis=0)) / 2


@catches("a finer grid half a cell aside", cells=128).at(
    "validation.simulation.rough_punch.refined", half_a_fine_cell_aside
)
@pytest.mark.parametrize("cells", [32, 64, 128])
def test_the_same_numbers_as_by_transforms(cells):
    surface = replace(SURFACE, cells=cells)
    light, plain = press_lightly(surface), press_surface(surface)
    for name in COMMON:
        np.testing.assert_allclose(light[name], plain[name], rtol=1e-4)
    assert light["failed"] == 0
    assert (light["residual"] < 1e-6).all()


def half_of_a_light_force(half_space, gap, *, forces, **settings):
    return few_cells.indent_few_cells(half_space, gap, forces=forces / 2, **settings)


@catches("half of a light force").at("bem3d.indent_few_cells", half_of_a_light_force)
def test_beside_the_dense_solution():
    """A bump raises the force, F = Fbar h; stiffness is that of the cells in contact."""
    surface = replace(SURFACE, cells=12, roughness=replace(ROUGHNESS, waves=(1, 3)), tolerance=1e-8)
    found = press_lightly(surface)
    half_space = bem3d.HalfSpace(shape=(12, 12), spacing=1 / 12, modulus=1.0)
    height, dense = surface.roughness.surface(12, surface.realisation), dense_operator(half_space)
    for i, force in enumerate(surface.forces):
        approach = approach_by_least_squares(half_space, -height, force * 1e-3)
        assert found["approach"][i] == pytest.approx(approach, abs=1e-6 * (approach + height.max()))
        cells = np.flatnonzero(contact_by_least_squares(half_space, -height, approach) > 0)
        stiffness = np.linalg.solve(dense[np.ix_(cells, cells)], np.ones(cells.size)).sum() / 144
        assert found["stiffness"][i] == pytest.approx(stiffness, rel=1e-5)
        assert found["area"][i] == pytest.approx(cells.size / 144)


def heavier_loads_as_light_ones(surface):
    return press_surface(dataclasses.replace(surface, forces=tuple(f / 2 for f in surface.forces)))


@catches("light loads that are not carried on", limit="OVERLAPPING", times=1).at(
    "validation.simulation.rough_punch.press_surface", heavier_loads_as_light_ones
)
@pytest.mark.parametrize(("limit", "times"), [("OVERLAPPING", 1), ("TOUCHING", 0.1)])
def test_heavier_loads_go_on_by_transforms(limit, times):
    """Where more cells overlap than are worth a matrix, or will touch."""
    expected = press_surface(SURFACE)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(light_punch, limit, times)
        light = press_lightly(SURFACE)
    assert light["applications"][0] < 1 < light["applications"][-1] == int(light["applications"][-1])
    for name in COMMON:
        np.testing.assert_allclose(light[name], expected[name], rtol=1e-4)


@catches("a load tried on a matrix whatever touches").at(
    "validation.simulation.rough_punch._while_few", lambda contacts, forces, most: contacts
)
def test_a_load_that_will_have_many_cells_is_not_tried():
    """The contact before it tells: their number goes with the force."""
    tried = []

    def contacts():
        for load in (1.0, 2.0, 8.0):
            tried.append(load)
            yield SimpleNamespace(cells=np.zeros((int(10 * load), 2)), force=load)

    few = light_punch._while_few(contacts(), np.array([1.0, 2.0, 8.0]), 79.0)
    assert [contact.force for contact in few] == tried == [1.0, 2.0]


@pytest.mark.parametrize(("coarse", "fine"), [(32, 64), (64, 256), (48, 80), (33, 66), (32, 33)])
def test_a_refined_surface_is_the_one_that_is_drawn_on_the_fine_grid(coarse, fine):
    def c2d(q):
        return np.where(q < 8.5 * 2 * np.pi, q**-3.0, 0.0)

    draws = [
        bem3d.rough_surface(c2d, shape=(n, n), spacing=1 / n, rng=np.random.default_rng(1), rms=1.0)
        for n in (coarse, fine)
    ]
    np.testing.assert_allclose(refined(draws[0], fine), draws[1], atol=1e-12)
