"""Boundary elements against closed forms on finer and finer grids: the error, and how fast it falls."""

import math

import numpy as np
import pytest

import bem3d
from tests.oracles import flat_square_by_graded_cells
from tests.seeded import E_FOR_E_STAR, Times, catches
from validation.cases.exact import hertz
from validation.simulation.exact_contacts import FlatPunches, press_flat_punches, press_sphere_by_bem, press_wave
from validation.theory import closed_forms


def slope(sizes, errors):
    """Order of convergence: slope of ln error against ln size."""
    return -np.polyfit(np.log(sizes), np.log(np.abs(errors)), 1)[0]


def sphere_force_errors(cells_per_radius):
    case = hertz.Hertz()
    return [press_sphere_by_bem(case.sphere(n, case.approach))["force"] / case.force - 1 for n in cells_per_radius]


@catches("E for E* in boundary elements").at("bem3d.kernel.free_space_symbol", Times(E_FOR_E_STAR))
@pytest.mark.slow
def test_sphere_force_at_second_order():
    """Variational: at most (dx/a)^2 / 4; grids of n = 128, 256, 512 cells with a = n/4."""
    n = np.array([32, 64, 128])
    errors = np.abs(sphere_force_errors(n))
    assert (errors <= 0.25 / n**2).all()
    assert slope(n, errors) == pytest.approx(2, abs=0.3)


@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.5, 0.5), (0.3, 0.1)])
@pytest.mark.parametrize("across", [1, 2])
def test_sphere_anywhere_between_the_cells(offset, across):
    """The centre on a corner, a centre or anywhere in a cell, on squares and on longer cells: the same bound."""
    n = 24
    sides, steps = (4 * n, 4 * n * across), (1 / n, 1 / (n * across))
    x, y = ((np.arange(m) - m / 2 + 0.5 + shift) * d for m, d, shift in zip(sides, steps, offset, strict=True))
    half_space = bem3d.HalfSpace(shape=sides, spacing=steps, modulus=1.0)
    contact = bem3d.solve(half_space, (x[:, np.newaxis] ** 2 + y**2) / 2, approach=1.0, tolerance=1e-8)
    assert contact.force == pytest.approx(4 / 3, rel=0.25 / n**2)
    assert contact.stiffness() == pytest.approx(2.0, rel=1 / n)


@catches("no padding, seen in a contact").at("bem3d.halfspace._doubled", lambda points: points + points % 2)
@catches("a residual that forgives").at(
    ("bem3d.contact.relative_error", "bem3d.projected_cg.relative_error"), Times(1e-6)
)
def test_a_wider_grid_changes_nothing():
    """Free space has no images: the same contact on a grid that just holds it and on a wide one, to the residual."""
    n = 12
    forces = []
    for side in (28, 72):
        x = (np.arange(side) - side / 2 + 0.5) / n
        half_space = bem3d.HalfSpace(shape=(side, side), spacing=1 / n, modulus=1.0)
        gap = (x[:, np.newaxis] ** 2 + x**2) / 2
        forces.append(bem3d.solve(half_space, gap, approach=1.0, tolerance=1e-11).force)
    assert forces[0] == pytest.approx(forces[1], rel=1e-9)


def flat_punches(cells):
    return FlatPunches(cells=cells, tolerance=1e-10)


def square_stiffness(cells):
    return [float(press_flat_punches(flat_punches(n))["square"]) for n in cells]


@catches("1.1419 for 1.1523 under the square punch").at(
    "validation.theory.closed_forms.SQUARE_PUNCH", 1.012 * 2 / math.sqrt(math.pi)
)
def test_square_punch_at_first_order():
    """-0.35 / n of its value, and 1.1523 within 5e-4 after one extrapolation."""
    n = np.array([16, 32, 64, 128])
    stiffness = np.array(square_stiffness(n))
    steps = np.diff(stiffness)
    assert slope(n[1:], steps) == pytest.approx(1, abs=0.1)
    assert 2 * stiffness[-1] - stiffness[-2] == pytest.approx(closed_forms.SQUARE_PUNCH, abs=5e-4)


@pytest.mark.slow
def test_reference_of_the_square_punch_against_graded_cells():
    """Cells that grow finer as the cosine towards the edges: second order, so one extrapolation gives four digits."""
    coarse, fine = flat_square_by_graded_cells(11), flat_square_by_graded_cells(22)
    assert fine + (fine - coarse) / 3 == pytest.approx(closed_forms.SQUARE_PUNCH, abs=3e-4)


def test_circular_punch_within_half_a_cell():
    """k / (2 E* a) with a the radius of a circle of as many cells: the staircase is worth less than half a cell."""
    for n in (32, 64, 128):
        assert press_flat_punches(flat_punches(n))["circle"] == pytest.approx(1.0, rel=1 / n)


def wave_errors(cells, load):
    return [float(press_wave(hertz.Hertz().wave(load, n))["error"]) for n in cells]


@catches("pi lost in the pressure that closes a wave").at(
    "validation.theory.closed_forms.westergaard_full_pressure", Times(1 / np.pi)
)
@catches("factor 2 lost in the periodic symbol").at("bem3d.kernel.periodic_symbol", Times(0.5))
def test_wave_pressure_at_first_order():
    """Half load: the edges of the contact fall between cells on each grid; 7e-4 at n = 512."""
    n = np.array([64, 128, 256, 512])
    errors = np.array(wave_errors(n, 0.5))
    assert (errors <= 7e-4 * 512 / n).all()
    assert slope(n, errors) == pytest.approx(1, abs=0.1)


@pytest.mark.parametrize("load", [0.1, 0.37, 0.9])
def test_wave_pressure_away_from_the_edge(load):
    """Where an edge cuts a cell, that cell is wrong by up to its own pressure; inside 0.9 a the error is of order 3/2
    in the cells across the half-width: a misplaced edge weighs dx^(3/2) in the force."""
    for n in (128, 512):
        wave = hertz.Hertz().wave(load, n)
        found, a = press_wave(wave), closed_forms.westergaard_half_width(**wave.scene)
        inside = np.abs(found["x"]) < 0.9 * a
        worst = np.max(np.abs(found["pressure"] - found["exact_pressure"])[inside]) / found["exact_pressure"].max()
        assert worst <= 0.5 * (wave.spacing / a) ** 1.5


def test_a_row_of_cells_answers_like_a_whole_periodic_grid():
    """Ridges: one row, or sixteen equal rows of cells of another depth."""
    x = np.arange(32) / 32
    gap = 0.02 * np.sin(np.pi * x) ** 2
    row = bem3d.HalfSpace(shape=(32, 1), spacing=(1 / 32, 1.0), modulus=1.0, periodic=True)
    grid = bem3d.HalfSpace(shape=(32, 16), spacing=(1 / 32, 1 / 16), modulus=1.0, periodic=True)
    one = bem3d.solve(row, gap[:, np.newaxis], force=0.01, tolerance=1e-11)
    many = bem3d.solve(grid, np.repeat(gap[:, np.newaxis], 16, axis=1), force=0.01, tolerance=1e-11)
    np.testing.assert_allclose(many.pressure, np.repeat(one.pressure, 16, axis=1), atol=1e-9 * one.pressure.max())
