"""Limits of the solver: either a solution with its residual under the tolerance, or an honest failure. Never a NaN."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import bem3d
from tests.oracles import contact_by_least_squares, dense_operator, displacement
from tests.strategies import half_spaces

TOLERANCE = 1e-8


def half_space(shape=(16, 16), *, periodic=False, spacing=1.0, modulus=1.0):
    return bem3d.HalfSpace(shape=shape, spacing=spacing, modulus=modulus, periodic=periodic)


def rough(shape, seed=0):
    return np.random.default_rng(seed).normal(size=shape)


def checked(contact):
    """The contact, if it is what it says: finite, its residual met on all cells by an operator of the test's own."""
    half_space, gap = contact.problem.half_space, contact.problem.gap
    assert contact.status == "converged"
    assert np.isfinite([contact.force, contact.approach, contact.area, contact.residual]).all()
    assert (contact.pressure >= 0).all()
    u = displacement(half_space, contact.pressure)
    w, s = gap + u - contact.approach, contact.approach - gap.min()
    if s > 0:
        # the digits that the oracle itself loses: Love's far field cancels, and so does a mean pressure on a period
        cell = max(half_space.steps) / half_space.modulus
        noise = 1e-11 * (np.abs(u).max() + np.abs(gap).max()) + 1e-14 * cell * contact.pressure.max()
        assert -w.min() <= contact.tolerance * s + noise
        assert (contact.pressure * np.abs(w)).sum() <= (contact.tolerance * s + noise) * contact.pressure.sum()
    return contact


@pytest.mark.slow
@pytest.mark.parametrize("fraction", [0.99, 0.999, 1.0])
@pytest.mark.parametrize("periodic", [True, False])
def test_full_and_nearly_full_contact(fraction, periodic):
    """Pressed until so much of the area is in contact."""
    body, gap = half_space((40, 50), periodic=periodic), 1e-3 * rough((40, 50))
    contact = None
    for force in np.geomspace(1e-2, 1e3, 60):
        contact = checked(bem3d.solve(body, gap, force=force, start=contact, tolerance=TOLERANCE))
        if contact.area >= fraction * gap.size:
            break
    assert contact.area >= fraction * gap.size
    if periodic and fraction == 1.0:
        # the pressure that flattens it, by Fourier, and the rest uniform
        q = 2 * np.pi * np.hypot(np.fft.fftfreq(40)[:, np.newaxis], np.fft.rfftfreq(50))
        flat = np.fft.irfft2(-q / 2 * np.fft.rfft2(gap), gap.shape) + contact.force / gap.size
        assert contact.pressure == pytest.approx(flat, abs=1e-5 * flat.max())
    if not periodic:
        near = checked(bem3d.solve(body, gap, approach=contact.approach, tolerance=TOLERANCE))
        assert near.force == pytest.approx(contact.force, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(("periodic", "cells"), list(itertools.product([True, False], [1, 2])))
def test_one_and_two_cells(periodic, cells):
    """Solved by hand: p = s / K_00 in one cell, s / (K_00 + K_01) in each of two neighbours."""
    body, gap = half_space((8, 9), periodic=periodic), np.full((8, 9), 5.0)
    gap[3, 4 : 4 + cells] = 0.0
    matrix = dense_operator(body)
    first = 3 * 9 + 4
    compliance = matrix[first, first : first + cells].sum()
    by_approach = checked(bem3d.solve(body, gap, approach=0.5, tolerance=TOLERANCE))
    assert by_approach.pressure[3, 4] == pytest.approx(0.5 / compliance, rel=1e-7)
    by_force = checked(bem3d.solve(body, gap, force=cells * 0.5 / compliance, tolerance=TOLERANCE))
    assert by_force.approach == pytest.approx(0.5, rel=1e-7)
    assert by_force.area == by_approach.area == cells
    assert by_force.stiffness() == pytest.approx(cells / compliance, rel=1e-7)


@pytest.mark.parametrize("prescribed", [{"force": 2.0}, {"approach": 1.5}])
@pytest.mark.parametrize("shape", [(16, 16), (48, 33), (1, 1), (1, 40), (128, 1)])
def test_flat_gaps_and_rows_of_cells(shape, prescribed):
    contact = checked(bem3d.solve(half_space(shape), np.ones(shape), **prescribed, tolerance=TOLERANCE))
    assert contact.area == np.prod(shape)
    for periodic in (True, False):
        checked(bem3d.solve(half_space(shape, periodic=periodic), rough(shape), force=1.0, tolerance=TOLERANCE))


@pytest.mark.parametrize("force", [1e-12, 1e12])
@pytest.mark.parametrize("periodic", [True, False])
def test_tiny_and_huge_forces(force, periodic):
    gap = rough((33, 20))
    body = half_space(gap.shape, periodic=periodic)
    contact = bem3d.solve(body, gap, force=force, tolerance=TOLERANCE, raise_on_failure=False)
    if periodic and force > 1:
        # a uniform pressure does not bend the half-space: its last digits are all the roughness has left
        assert contact.status == "stagnation"
        assert contact.residual <= 100 * np.finfo(float).eps * contact.pressure.max() / np.ptp(gap)
    else:
        checked(contact)
    assert contact.force == pytest.approx(force, rel=1e-12, abs=0)
    assert contact.area == (1 if force < 1 else gap.size)


@pytest.mark.parametrize(("shape", "load"), [((79, 65), 0.0016), ((89, 55), 0.00022), ((64, 40), 0.01)])
def test_ridges_under_a_force(shape, load):
    """A start with too many cells, all alike along the ridge: neither a conjugate nor a preconditioned step gains."""
    gap = np.cos(2 * np.pi * np.arange(shape[0]) / shape[0])[:, np.newaxis] + np.zeros(shape)
    body = half_space(shape, periodic=True)
    for factor in (0.5, 1.0, 2.0, 4.0):
        force = factor * load * gap.size
        contact = checked(bem3d.solve(body, gap, force=force, tolerance=TOLERANCE))
        assert np.ptp(contact.pressure, axis=1).max() <= 1e-5 * contact.pressure.max()


@pytest.mark.parametrize("part", [0.97, 0.999, 1 - 1e-9])
@pytest.mark.parametrize("n", [40, 65, 81])
def test_the_mean_gap_of_coarser_grids_changes_nothing(n, part):
    """Odd axes count a cell twice when they are halved: the approach is valid all the same, wherever a wave begins."""
    x = np.cos(2 * np.pi * (np.arange(n) + 0.5) / n)
    gap = -np.add.outer(x, x) + 0.01 * rough((n, n))
    body = half_space((n, n), periodic=True)
    for shift in (0, n // 4):
        moved = np.roll(gap, shift, axis=(0, 1))
        approach = moved.min() + part * (moved.mean() - moved.min())
        contact = bem3d.solve(body, moved, approach=approach, tolerance=1e-6, raise_on_failure=False)
        assert contact.converged or contact.residual < 1e-4
        if part < 0.99:
            checked(contact)


@pytest.mark.parametrize("seed", range(6))
def test_an_approach_one_digit_below_the_mean_gap_is_valid_on_coarser_grids_too(seed):
    """Their mean is off by a rounding, beyond which they have no contact to begin with."""
    gap = rough((32, 33), seed)
    approach = float(np.nextafter(gap.mean(), -np.inf))
    contact = bem3d.solve(half_space(gap.shape, periodic=True), gap, approach=approach, raise_on_failure=False)
    assert contact.converged == (contact.residual <= contact.tolerance)
    assert np.isfinite(contact.pressure).all()


@pytest.mark.parametrize("height", [1e-14, 1e-32, 1e-200, 1e-300])
@pytest.mark.parametrize("periodic", [True, False])
def test_flat_but_for_noise(height, periodic):
    """Heights that no pressure can tell from a plane: an end, and no hang."""
    gap = height * np.random.default_rng(42961).random((11, 5))
    body = half_space(gap.shape, periodic=periodic)
    for force in (height / 2, 1.0, 485.24):
        contact = bem3d.solve(body, gap, force=force, raise_on_failure=False)
        assert contact.converged == (contact.residual <= contact.tolerance)
        assert contact.iterations < 200
    if not periodic:
        contact = bem3d.solve(body, gap, approach=height / 2, raise_on_failure=False)
        assert contact.converged == (contact.residual <= contact.tolerance)


@pytest.mark.slow
@pytest.mark.parametrize("shape", [(5, 1), (8, 3), (1, 9)])
@pytest.mark.parametrize("spacing", [(1.0, 1e-3), (1.0, 1000.0)])
@pytest.mark.parametrize("periodic", [True, False])
def test_a_force_is_held_to_the_last_digit(shape, spacing, periodic):
    body = half_space(shape, periodic=periodic, spacing=spacing)
    for seed in range(20):
        gap = np.random.default_rng(seed).lognormal(size=shape)
        contact = bem3d.solve(body, gap, force=7.92, tolerance=TOLERANCE, raise_on_failure=False)
        assert contact.force == pytest.approx(7.92, rel=1e-14)


@pytest.mark.parametrize("tolerance", [1e-13, 1e-15, 1e-30])
@pytest.mark.parametrize("periodic", [True, False])
def test_tolerance_below_rounding(tolerance, periodic):
    """Ends soon, either way, and never with a residual that it does not have."""
    body, gap = half_space((40, 40), periodic=periodic), rough((40, 40))
    contact = bem3d.solve(body, gap, force=1.0, tolerance=tolerance, raise_on_failure=False)
    assert contact.converged == (contact.residual <= tolerance)
    assert contact.residual < 1e-11
    assert contact.iterations < 200


@st.composite
def nasty(draw):
    """Gaps with little to hold on to: few heights, spikes over plateaus, boards, ramps; any load."""
    body = draw(half_spaces(most=draw(st.sampled_from([6, 12, 40]))))
    levels = draw(st.sampled_from([(0.0, 1.0), (0.0, 1.0, 1e-9), (0.0, 1e-6, 1.0, 1e6), tuple(np.linspace(0, 1, 65))]))
    gap = draw(arrays(np.float64, body.shape, elements=st.sampled_from(levels), fill=st.sampled_from(levels)))
    gap = gap + draw(st.sampled_from([0.0, 1e-3, 1.0])) * (np.indices(body.shape).sum(axis=0) % 2)
    return body, gap, 10 ** draw(st.floats(-8, 8))


@pytest.mark.slow
@given(problem=nasty())
def test_nasty_gaps_under_a_force(problem):
    body, gap, force = problem
    contact = bem3d.solve(body, gap, force=force, tolerance=1e-7, raise_on_failure=False)
    assert contact.converged == (contact.residual <= 1e-7)
    assert np.isfinite(contact.pressure).all()
    if contact.converged:
        checked(contact)
    else:
        # heights that are mere rounding beside the overlap leave no residual to reach
        assert contact.residual <= 1e-3 or contact.status != "converged"


@pytest.mark.slow
@given(problem=nasty(), part=st.floats(0.001, 2))
def test_nasty_gaps_at_an_approach(problem, part):
    body, gap, _ = problem
    low = gap.min()
    if body.periodic and np.ptp(gap) == 0:
        return
    reach = gap.mean() - low if body.periodic else np.ptp(gap) or 1.0
    approach = low + (min(part, 0.99) if body.periodic else part) * reach
    contact = bem3d.solve(body, gap, approach=approach, tolerance=1e-7)
    checked(contact)
    if not body.periodic and gap.size <= 40:
        dense = contact_by_least_squares(body, gap, approach)
        assert contact.force == pytest.approx(dense.sum() * body.cell_area, rel=1e-5)
