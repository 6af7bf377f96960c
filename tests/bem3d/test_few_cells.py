"""Contacts of few cells by their influence coefficients: beside the same by transforms, and beside an oracle."""

import numpy as np
import pytest
import scipy
from hypothesis import given
from hypothesis import strategies as st

import bem3d
from bem3d import few_cells
from tests.oracles import approach_by_least_squares, contact_by_least_squares, dense_operator
from tests.seeded import E_FOR_E_STAR, Times, catches
from tests.strategies import pressed

FORCES = (1e-6, 4e-6, 2e-5)


def rough_punch(cells=96, seed=1):
    def c2d(q):
        return np.where(q < cells / 4 * 2 * np.pi, q**-3.4, 0.0)

    rng = np.random.default_rng(seed)
    height = bem3d.rough_surface(c2d, shape=(cells, cells), spacing=1 / cells, rng=rng, rms=1e-3)
    return bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0), -height


def spread(contact, shape):
    """Its pressure on the whole grid."""
    whole = np.zeros(shape)
    whole[tuple(contact.cells.T)] = contact.pressure
    return whole


@pytest.mark.parametrize("seed", range(4))
def test_the_same_as_by_transforms(seed):
    """Two solutions within the same small residual: pressure, approach, area and stiffness at each load."""
    body, gap = rough_punch(seed=seed)
    path = bem3d.indent(body, gap, forces=FORCES, stiffness=True, tolerance=1e-9, indenter_ends_at_edge=True)
    for few, contact in zip(bem3d.indent_few_cells(body, gap, forces=FORCES, tolerance=1e-9), path, strict=True):
        np.testing.assert_allclose(spread(few, body.shape), contact.pressure, atol=1e-6 * contact.pressure.max())
        assert few.area == pytest.approx(contact.area, rel=1e-12)
        assert few.approach == pytest.approx(contact.approach, abs=1e-8 * (contact.approach - gap.min()))
        assert few.stiffness == pytest.approx(contact.stiffness(), rel=1e-6)
        assert few.pressure.sum() * body.cell_area == pytest.approx(few.force, rel=1e-12)


@catches("a cell that has left, kept for the rounding of its pressure").at("bem3d.projected_cg.ROUNDING", 0.0)
def test_a_cell_that_leaves_the_contact_keeps_no_rounding_of_its_pressure():
    """One asperity carries all; a second, pressed on the way there, once kept 1e-17 of it and counted as contact."""
    body, gap = rough_punch(cells=24, seed=432)
    (contact,) = bem3d.indent_few_cells(body, gap, forces=[1e-6], tolerance=1e-4)
    assert len(contact.cells) == 1


@pytest.mark.slow
@given(problem=pressed(most=8, periodic=False, by=("force",)))
def test_any_gap_beside_least_squares(problem):
    """Plateaus, spikes, single cells, full contact; cells of any proportion."""
    body, gap, force = problem.half_space, problem.gap, problem.prescribed["force"]
    (contact,) = bem3d.indent_few_cells(body, gap, forces=[force], tolerance=1e-9)
    approach = approach_by_least_squares(body, gap, force)
    overlap = approach - gap.min()
    assert contact.approach == pytest.approx(approach, abs=1e-7 * overlap)
    pressure = contact_by_least_squares(body, gap, contact.approach)
    displaced = dense_operator(body) @ (spread(contact, body.shape) - pressure).ravel()
    assert np.abs(displaced).max() < 1e-6 * overlap


def forgiving_residual(pressure, w, overlap):
    return 1e-6 * bem3d.residual(pressure, w, overlap)


@catches("the cells that are looked at first, and no others").at("bem3d.few_cells.GROWTH", 1)
@catches("few cells judged by a forgiving residual").at("bem3d.few_cells.residual", forgiving_residual)
@given(seed=st.integers(0, 100), force=st.sampled_from([1e-6, 1e-5, 1e-4]))
def test_the_residual_is_that_of_the_whole_grid(seed, force):
    """Cells that do not overlap cannot touch: it is taken on all others."""
    body, gap = rough_punch(48, seed)
    (contact,) = bem3d.indent_few_cells(body, gap, forces=[force], tolerance=1e-7)
    pressure = spread(contact, body.shape)
    w = gap + body.displacement(pressure) - contact.approach
    whole = bem3d.residual(pressure, w, contact.approach - gap.min())
    assert whole == pytest.approx(contact.residual, abs=1e-12)
    assert contact.residual <= 1e-7


@catches("a stiffness of few cells within a tenth").at("bem3d.few_cells.STIFFNESS_TOLERANCE", 0.1)
def test_stiffness_is_the_slope_of_the_load():
    """Between two near forces whose contact is the same."""
    body, gap = rough_punch()
    before, after = bem3d.indent_few_cells(body, gap, forces=[1e-5, 1.0001e-5], tolerance=1e-10)
    assert before.area == after.area
    slope = (after.force - before.force) / (after.approach - before.approach)
    assert before.stiffness == pytest.approx(slope, rel=1e-5)


def summed_pressure(operator):
    """1.x by the same iteration, of x itself."""
    ones = np.ones(len(operator.matrix))
    return float(scipy.sparse.linalg.cg(operator.matrix, ones, rtol=few_cells.STIFFNESS_TOLERANCE)[0].sum())


@catches("the sum of the pressure for its energy", spacing=(1.0, 1.0)).at(
    "bem3d.few_cells._sum_of_unit_pressure", summed_pressure
)
@pytest.mark.parametrize("spacing", [(1.0, 1.0), (1.0, 30.0), (1000.0, 1.0)])
def test_stiffness_of_a_flat_punch_is_that_of_a_direct_solve(spacing):
    """Error: the square of the residual, 1e-12, times the condition of K, and the rounding of the direct solve."""
    body = bem3d.HalfSpace(shape=(12, 12), spacing=spacing, modulus=1.0)
    (contact,) = bem3d.indent_few_cells(body, np.zeros(body.shape), forces=[1.0])
    dense = dense_operator(body)
    exact = np.linalg.solve(dense, np.ones(dense.shape[0])).sum() * body.cell_area
    assert contact.stiffness == pytest.approx(exact, rel=1e-12 * np.linalg.cond(dense) + 1e-13)


influence = few_cells._influence


@catches("E for E* among few cells").at("bem3d.few_cells._influence", Times(E_FOR_E_STAR))
@catches("few cells as wide as they are long").at(
    "bem3d.few_cells._influence", lambda body: influence(body.like(shape=body.shape, spacing=body.steps[0]))
)
def test_one_cell_is_as_soft_as_it_is_alone():
    body = bem3d.HalfSpace(shape=(16, 9), spacing=(2.0, 0.5), modulus=3.0)
    gap = np.ones(body.shape)
    gap[11, 4] = 0.0
    (contact,) = bem3d.indent_few_cells(body, gap, forces=[1e-3])
    assert contact.cells.tolist() == [[11, 4]]
    assert contact.stiffness == pytest.approx(body.cell_area / body.self_compliance, rel=1e-12)
    assert contact.approach == pytest.approx(contact.pressure[0] * body.self_compliance, rel=1e-12)


def of_the_first_body(kept):
    """Influence kept by the shape of the grid alone."""
    return lambda body: kept.setdefault(body.shape, influence(body))


@catches("a second modulus among few cells", modulus=3.0).at(
    "bem3d.few_cells._influence", lambda body: influence(body) / body.modulus
)
@catches("few cells on the body that was pressed before", modulus=3.0).at(
    "bem3d.few_cells._influence", of_the_first_body({})
)
@pytest.mark.parametrize("modulus", [1e-3, 3.0, 2e11])
def test_the_modulus_is_the_unit_of_force(modulus):
    """The same grid under E* times the force, one body after another: every approach is the same."""
    body, gap = rough_punch(48)
    soft = list(bem3d.indent_few_cells(body, gap, forces=FORCES))
    other = bem3d.HalfSpace(shape=body.shape, spacing=body.steps, modulus=modulus)
    scaled = bem3d.indent_few_cells(other, gap, forces=[modulus * force for force in FORCES])
    for one, same in zip(soft, scaled, strict=True):
        np.testing.assert_array_equal(one.cells, same.cells)
        np.testing.assert_allclose(same.pressure, modulus * one.pressure, rtol=1e-5)
        assert same.approach == pytest.approx(one.approach, rel=1e-5)
        assert same.stiffness == pytest.approx(modulus * one.stiffness, rel=1e-8)


def test_as_many_cells_as_are_allowed_and_no_more():
    """The lighter contacts are good; on its way to the last, a search on few cells is not mistaken for a contact."""
    body, gap = rough_punch()
    path = list(bem3d.indent(body, gap, forces=FORCES, tolerance=1e-9, indenter_ends_at_edge=True))
    overlapping = [int((gap < contact.approach).sum()) for contact in path]
    assert overlapping[0] < overlapping[1] < overlapping[2]
    few = bem3d.indent_few_cells(body, gap, forces=FORCES, max_cells=overlapping[1] + 1)
    assert [len(next(few).cells), len(next(few).cells)] == [np.count_nonzero(c.pressure) for c in path[:2]]
    with pytest.raises(bem3d.TooManyCellsError, match=r"forces\[2\] = 2e-05 N .* than max_cells"):
        next(few)
    assert len(list(bem3d.indent_few_cells(body, gap, forces=FORCES, max_cells=overlapping[2] + 1))) == len(FORCES)


def test_not_converged_is_no_result(monkeypatch):
    body, gap = rough_punch()
    with pytest.raises(bem3d.ConvergenceError, match=r"residual .* asked for 1e-12, at force 1e-05 N") as caught:
        list(bem3d.indent_few_cells(body, gap, forces=[1e-5], tolerance=1e-12, max_iterations=1))
    assert caught.value.history[-1] == caught.value.result.residual > 1e-12
    monkeypatch.setattr("bem3d.few_cells.MOST_STEPS", 0)
    assert np.isnan(next(bem3d.indent_few_cells(body, gap, forces=[1e-5])).stiffness)
