"""Contact area and mean gap of rough punches by `compare`, beside finer grids."""

from dataclasses import replace

import numpy as np
import pytest

import bem3d
from tests.advice.planted_answers import ball, punch, waves
from tests.seeded import Times, catches
from validation.advice.advice import in_full, in_short
from validation.advice.compare import compare
from validation.advice.models import boundary_elements_pressed
from validation.advice.models_of_scene import quantities_of
from validation.scenes.measured_heights import MeasuredHeights
from validation.simulation.indentation import height_of
from validation.simulation.model import Target

LIGHT = punch(load=0.1, ground=waves(last=8))


def face(points=32, seed=2):
    rough = waves(last=8)
    height = bem3d.rough_surface(
        rough.c2d, shape=(points, points), spacing=1 / points, rng=np.random.default_rng(seed), rms=rough.rms
    )
    return MeasuredHeights(height=height, spacing=(1 / points, 1 / points))


MEASURED = punch(load=0.1, ground=face())


def areas_and_gaps(scene, cells, realisation=0):
    """Cells under pressure, and the mean of u - h - d."""
    height = height_of(scene, cells, realisation, 0)
    body = bem3d.HalfSpace(shape=height.shape, spacing=scene.size / cells, modulus=scene.modulus)
    contact = bem3d.solve(body, -height, force=scene.load, tolerance=1e-4, indenter_ends_at_edge=True)
    return contact.area, float(np.mean(body.displacement(contact.pressure) - height)) - contact.approach


@catches("cells that count as a whole", "contact-area").at("bem3d.Contact.corrected_area", bem3d.Contact.area)
@catches("a gap that is larger by 30 %", "mean-gap").at("bem3d.Contact.mean_gap", Times(1.3))
@pytest.mark.parametrize("quantity", ["contact-area", "mean-gap"])
def test_area_and_gap_are_those_of_finer_grids_on_the_same_surfaces(quantity):
    """16 cells to the shortest wave extrapolated by 32, of the same 16 surfaces; the counted area is 10 % above."""
    comparison = compare(LIGHT, quantity=quantity, tolerance=0.01, realisations=16)
    finest = next(candidate for candidate in comparison.models if candidate.name.endswith("64²"))
    index = ["contact-area", "mean-gap"].index(quantity)
    coarse, fine = (np.mean([areas_and_gaps(LIGHT, cells, i)[index] for i in range(16)]) for cells in (128, 256))
    assert abs(float(finest.answer.value[0]) / (2 * fine - coarse) - 1) < min(finest.answer.grid, 0.09)


@pytest.mark.parametrize("quantity", ["contact-area", "mean-gap"])
def test_the_error_of_a_measured_face_covers_what_splitting_its_points_changes(quantity):
    """Eight parts of each point along each side."""
    comparison = compare(MEASURED, quantity=quantity, tolerance=0.5)
    best = comparison.selection.best
    split = areas_and_gaps(MEASURED, 256)[["contact-area", "mean-gap"].index(quantity)]
    assert comparison.statistic == "single surface"
    assert abs(float(best.answer.value[0]) / split - 1) < best.answer.grid


@catches("no part of the correction left").at(
    "validation.advice.models.boundary_elements_pressed.LEFT_OF_CORRECTION", 0.0
)
def test_the_error_of_an_area_has_a_quarter_of_its_correction():
    """0.11811 of a cell for each side on the boundary, of the first surface."""
    counted, _ = areas_and_gaps(LIGHT, 64)
    area = counted - 0.11811 * sides(LIGHT, 64) / 64**2
    on_64, target = boundary_elements_pressed.on_grid(64), Target(LIGHT, "contact-area", 0.1, 0)
    left = boundary_elements_pressed.left_by_correction(target, on_64)
    assert left == pytest.approx(0.25 * np.log(counted / area), rel=1e-3)
    assert boundary_elements_pressed.left_by_correction(replace(target, quantity="mean-gap"), on_64) == 0.0


def sides(scene, cells):
    """Neighbours of which one is under pressure, within the punch."""
    height = height_of(scene, cells, 0, 0)
    body = bem3d.HalfSpace(shape=height.shape, spacing=scene.size / cells, modulus=scene.modulus)
    under = bem3d.solve(body, -height, force=scene.load, tolerance=1e-4, indenter_ends_at_edge=True).pressure > 0
    return np.sum(under[1:] != under[:-1]) + np.sum(under[:, 1:] != under[:, :-1])


def test_a_closed_gap_has_no_value_and_says_why():
    comparison = compare(punch(load=1e3, ground=waves(last=4)), quantity="mean-gap", tolerance=0.3)
    assert comparison.selection.best is None
    assert all("the gap is closed" in candidate.reason for candidate in comparison.models)


def test_a_rough_punch_alone_has_them_and_mdr_has_neither():
    assert quantities_of(LIGHT) == ("stiffness", "contact-area", "mean-gap")
    assert quantities_of(punch(ground=None)) == quantities_of(ball(0.1, 1, 4)) == ("stiffness",)
    with pytest.raises(ValueError, match="quantity must be one of stiffness for scene"):
        compare(punch(ground=None), quantity="mean-gap")
    comparison = compare(LIGHT, quantity="contact-area", tolerance=0.5, realisations=8)
    assert in_short(comparison) == "MDR has no contact area"
    assert in_full(comparison) == ["MDR: its springs have no neighbours, and it has no contact area."]
