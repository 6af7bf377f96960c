"""What every frictionless contact obeys, whatever the gap: Hypothesis draws them."""

import itertools
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib import pyplot
from matplotlib.figure import Figure

import bem3d
from bem3d import contact, convolution
from bem3d.results import map_of
from bem3d.tangent_stiffness import solve_fixed_area
from tests.oracles import dense_operator
from tests.seeded import catches
from tests.strategies import pressed

TIGHT = 1e-12
exponents = st.integers(-30, 30)


relative_error = contact.relative_error


@catches("a residual blind to penetration").at(
    ("bem3d.contact.relative_error", "bem3d.projected_cg.relative_error"),
    lambda total, moved, _, overlap: relative_error(total, moved, 0.0, overlap),
)
@pytest.mark.slow
@given(problem=pressed())
def test_complementarity(problem):
    """p >= 0, no penetration, no gap under pressure: within the tolerance, by an operator that the solver never saw."""
    contact = problem.solve(tolerance=1e-9)
    half_space, gap = problem.half_space, problem.gap
    dense, p = dense_operator(half_space), contact.pressure.ravel()
    w = gap + (dense @ p).reshape(gap.shape) - contact.approach
    # rounding is of the size of the terms of the sum, which may cancel
    allowed = 1.001e-9 * (contact.approach - gap.min()) + 1e-13 * (1 + (np.abs(dense) @ p).max())
    assert problem.prescribed.get("force", contact.force) == pytest.approx(contact.force, rel=1e-12)
    assert (contact.pressure >= 0).all()
    assert -w.min() <= allowed
    assert np.sum(contact.pressure * np.abs(w)) <= allowed * contact.pressure.sum()


@pytest.mark.slow
@given(problem=pressed(), metre=exponents, height=exponents, pascal=exponents)
def test_scaling_by_powers_of_two_is_exact(problem, metre, height, pascal):
    """Lengths times s, heights times h, E* times m: p ~ m h / s, F ~ m h s. No absolute number hides anywhere."""
    scale, high, modulus = 2.0**metre, 2.0**height, 2.0**pascal
    old = problem.half_space
    spacing = (scale * old.steps[0], scale * old.steps[1])
    half_space = bem3d.HalfSpace(shape=old.shape, spacing=spacing, modulus=modulus, periodic=old.periodic)
    factor = {"approach": high, "force": modulus * high * scale}
    prescribed = {name: factor[name] * value for name, value in problem.prescribed.items()}
    one, other = problem.solve(), bem3d.solve(half_space, high * problem.gap, **prescribed)
    np.testing.assert_array_equal(other.pressure, modulus * high / scale * one.pressure)
    assert other.stiffness() == modulus * scale * one.stiffness()


@catches("stiffness of a contact grown by a cell").at(
    "bem3d.contact.solve_fixed_area",
    lambda body, cells, **settings: solve_fixed_area(body, cells | np.roll(cells, 1, axis=0), **settings),
)
@pytest.mark.slow
@given(problem=pressed(periodic=False, most=6, by=("approach",)))
def test_stiffness_is_that_of_the_dense_contact(problem):
    contact = problem.solve(tolerance=TIGHT)
    cells = np.flatnonzero(contact.pressure)
    block = dense_operator(problem.half_space)[np.ix_(cells, cells)]
    expected = np.linalg.solve(block, np.ones(cells.size)).sum() * problem.half_space.cell_area
    assert contact.stiffness(tolerance=1e-12) == pytest.approx(expected, rel=1e-10)


@pytest.mark.slow
@given(problem=pressed())
def test_a_start_does_not_change_the_answer(problem):
    cold = problem.solve(tolerance=TIGHT)
    rough_start = np.random.default_rng(0).random(problem.gap.shape)
    for start in (cold, rough_start, np.zeros(problem.gap.shape)):
        warm = problem.solve(tolerance=TIGHT, start=start)
        np.testing.assert_allclose(warm.pressure, cold.pressure, atol=1e-8 * cold.pressure.max())
    assert problem.solve(tolerance=1e-9, start=cold).iterations <= 1


@pytest.mark.parametrize(
    ("pressure", "w", "overlap", "expected"),
    [
        # a gap under pressure, (0.2 + 3 * 0.1) / 4, or a penetration, whichever is larger
        ([1.0, 3.0], [0.2, -0.1], 2.0, 0.125 / 2),
        ([1.0, 3.0], [0.2, -0.4], 2.0, 0.4 / 2),
        ([0.0, 3.0], [7.0, 0.0], 2.0, 0.0),
        # no pressure: all of the overlap is penetration
        ([0.0, 0.0], [1.0, -2.0], 2.0, 1.0),
        ([0.0, 0.0], [1.0, -0.5], 2.0, 0.25),
        # no overlap: no pressure is the solution, and any other is none
        ([0.0, 0.0], [1.0, 0.0], 0.0, 0.0),
        ([0.0, 0.0], [1.0, 0.5], -0.5, 0.0),
        ([0.5, 0.5], [1.0, 0.5], 0.0, np.inf),
        ([1e-9, 0.0], [1.0, 0.5], -0.5, np.inf),
        # no number stays none
        ([np.nan, 1.0], [0.0, 0.0], 1.0, np.nan),
        ([np.inf, 1.0], [0.0, 0.0], 1.0, np.nan),
        ([1.0, 1.0], [np.nan, 0.0], 1.0, np.nan),
        ([0.0, 1.0], [np.nan, 0.0], 1.0, np.nan),
    ],
)
def test_residual_by_hand(pressure, w, overlap, expected):
    assert bem3d.residual(np.array(pressure), np.array(w), overlap) == pytest.approx(expected, rel=1e-14, nan_ok=True)


def test_no_contact():
    half_space = bem3d.HalfSpace(shape=(4, 5), spacing=1.0, modulus=1.0)
    gap = np.full((4, 5), 0.5)
    loads = ({"force": 0.0}, {"approach": 0.5}, {"approach": -1.0})
    for solver, prescribed in itertools.product((bem3d.solve, bem3d.solve_polonsky_keer), loads):
        contact = solver(half_space, gap, **prescribed)
        assert (contact.force, contact.area, contact.residual, contact.stiffness()) == (0, 0, 0, 0)
        assert contact.approach == prescribed.get("approach", 0.5)
        assert (contact.status, contact.operator_applications, contact.history) == ("converged", 0, (0.0,))


def test_full_contact_of_a_periodic_half_space():
    """A wave under more than p*: the pressure is mean plus E* q h / 2 cos(q x), and the mean plane cannot yield."""
    half_space = bem3d.HalfSpace(shape=(16, 1), spacing=1.0, modulus=2.0, periodic=True)
    q = 2 * np.pi / 16
    wave = 0.1 * np.cos(q * np.arange(16.0))[:, np.newaxis]
    mean = 3 * 0.1 * q
    contact = bem3d.solve(half_space, -wave, force=mean * 16, tolerance=1e-12)
    np.testing.assert_allclose(contact.pressure, mean + q * wave, rtol=1e-10)
    assert contact.stiffness() == np.inf


@pytest.mark.parametrize("shape", [(1, 1), (3, 4)])
def test_flat_periodic_half_space_takes_a_uniform_pressure(shape):
    half_space = bem3d.HalfSpace(shape=shape, spacing=1.0, modulus=1.0, periodic=True)
    contact = bem3d.solve(half_space, np.full(shape, 0.3), force=2.0)
    np.testing.assert_allclose(contact.pressure, 2.0 / (shape[0] * shape[1]))
    assert contact.approach == 0.3


@pytest.mark.parametrize("solver", [bem3d.solve, bem3d.solve_polonsky_keer])
def test_result_carries_its_problem_and_its_costs(solver, monkeypatch):
    calls = []
    transform = convolution.CachedConvolution._convolve
    # in free space the operator is a padded convolution, on small grids a cached one, and nothing else is
    monkeypatch.setattr(convolution.CachedConvolution, "_convolve", lambda self: calls.append(transform(self)))
    half_space = bem3d.HalfSpace(shape=(48, 80), spacing=1.0, modulus=1.0)
    gap = np.random.default_rng(0).random((48, 80))
    contact = solver(half_space, gap, approach=0.7)
    cold = 1 if contact.coarse_applications else 0  # the first pressure on the coarsest grid is scaled by its energy
    assert contact.operator_applications + sum(n for _, n in contact.coarse_applications) + cold == len(calls)
    assert contact.iterations + 1 == len(contact.history)
    assert contact.residual == contact.history[-1] <= contact.tolerance
    np.testing.assert_array_equal(contact.problem.gap, gap)


def test_a_failure_comes_home_from_another_process():
    """With its sentence, its history and what was reached."""
    half_space = bem3d.HalfSpace(shape=(8, 8), spacing=1.0, modulus=1.0)
    with pytest.raises(bem3d.ConvergenceError) as caught:
        bem3d.solve(half_space, np.random.default_rng(0).random((8, 8)), force=1.0, max_iterations=1)
    copy = pickle.loads(pickle.dumps(caught.value))
    assert (str(copy), copy.history) == (str(caught.value), caught.value.history)
    np.testing.assert_array_equal(copy.result.pressure, caught.value.result.pressure)


def test_textbook_iteration_may_cycle_under_a_force():
    """A spike over a plateau of equal heights: two contact sets take turns. It must say so; by approach it ends."""
    half_space = bem3d.HalfSpace(shape=(8, 8), spacing=(2.0, 0.3125), modulus=1.0)
    gap = np.ones((8, 8))
    gap[0, 0] = 0.0
    stuck = bem3d.solve_polonsky_keer(half_space, gap, force=1.0, max_iterations=200, raise_on_failure=False)
    assert stuck.status == "iteration limit"
    with pytest.raises(bem3d.ConvergenceError, match="after 200 iterations"):
        bem3d.solve_polonsky_keer(half_space, gap, force=1.0, max_iterations=200)
    assert stuck.history[-1] == pytest.approx(stuck.history[-3], rel=1e-3)
    assert bem3d.solve_polonsky_keer(half_space, gap, approach=1.1, tolerance=TIGHT).converged
    assert bem3d.solve(half_space, gap, force=1.0, tolerance=TIGHT).converged


def test_a_start_that_is_a_solution_is_not_shared():
    half_space, gap = bem3d.HalfSpace(shape=(8, 8), spacing=1.0, modulus=1.0), np.random.default_rng(0).random((8, 8))
    start = bem3d.solve(half_space, gap, approach=0.7, tolerance=1e-8).pressure.copy()
    again = bem3d.solve(half_space, gap, approach=0.7, tolerance=1e-6, start=start)
    assert again.iterations == 0
    assert not np.shares_memory(again.pressure, start)


@pytest.mark.parametrize("side", [4, 40])
@pytest.mark.parametrize("prescribed", [{"force": 1e200}, {"force": 5e-324}, {"approach": 1e300}, {"approach": 1e308}])
def test_numbers_that_overflow_are_an_honest_failure(prescribed, side):
    """On grids that are begun with coarser ones, too."""
    half_space = bem3d.HalfSpace(shape=(side, side), spacing=1.0, modulus=1.0)
    gap = np.random.default_rng(0).random((side, side))
    contact = bem3d.solve(half_space, gap, **prescribed, raise_on_failure=False)
    assert contact.converged == (contact.residual <= contact.tolerance)
    if contact.converged:
        assert np.isfinite([contact.force, contact.approach]).all()


def oblong():
    """A ridge along the second axis, nearer to one end of the first."""
    x, y = np.arange(12) - 3.0, np.arange(8) - 3.5
    body = bem3d.HalfSpace(shape=(12, 8), spacing=(1e-4, 2e-4), modulus=1e11)
    return bem3d.solve(body, 1e-7 * (x[:, None] ** 2 + 0.2 * y**2), approach=1e-6, indenter_ends_at_edge=True)


@catches("a map whose axes are exchanged").at(
    "bem3d.contact.map_of", lambda values, steps, *rest: map_of(values.T, steps[::-1], *rest)
)
def test_a_contact_is_drawn_on_axes_of_a_user():
    contact, axis = oblong(), Figure().add_subplot()
    assert contact.plot(axis) is axis
    (image,) = axis.images
    assert image.get_extent() == pytest.approx((0.0, 12e-4, 0.0, 16e-4))
    # rows of an image are along y
    assert np.array_equal(image.get_array().filled(0.0).T, contact.pressure)
    gap = contact.plot(Figure().add_subplot(), quantity="gap").images[0].get_array().T
    dense = (dense_operator(contact.problem.half_space) @ contact.pressure.ravel()).reshape(12, 8)
    expected = contact.problem.gap + dense - contact.approach
    assert np.array_equal(gap.mask, contact.pressure > 0) and gap.compressed() == pytest.approx(expected[~gap.mask])


def test_a_map_of_nothing_else_is_refused(monkeypatch):
    contact = oblong()
    with pytest.raises(ValueError, match='quantity must be "pressure" or "gap", got \'force\''):
        contact.plot(quantity="force")
    with pytest.raises(TypeError, match="ax must be an Axes of matplotlib, or None for a new figure, got str"):
        contact.plot("here")
    monkeypatch.setattr(pyplot, "subplots", lambda **_: (None, Figure().add_subplot()))
    assert contact.plot().images
