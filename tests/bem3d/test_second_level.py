"""The second level of the approximate inverse: blocks of cells, on grids made small enough for a dense operator."""

import functools
import itertools

import numpy as np
import pytest

import bem3d
from bem3d import far_field, halfspace, kernel
from tests.bem3d.test_extreme_input import checked
from tests.bem3d.test_iteration_counts import self_affine
from tests.oracles import dense_operator, displacement
from tests.seeded import Times, catches


def with_levels(test):
    """A test with a second level on all grids, of blocks of 4 x 4 cells, and convolutions that threads share out."""

    @functools.wraps(test)
    def run(*given, **named):
        with pytest.MonkeyPatch.context() as patch:
            for name, small in {"ONE_LEVEL": 0, "BLOCK": 4, "CACHED_NUMBERS": 0, "CACHED_CELLS": 0}.items():
                patch.setattr(halfspace, name, small)
            test(*given, **named)

    return run


@catches("a far field of half the blocks", spacing=1.0).at("bem3d.kernel.far_table", Times(0.5))
@pytest.mark.parametrize("spacing", [1.0, (1.0, 0.7)])
@with_levels
def test_far_away_a_block_is_felt_as_the_pressure_on_it(spacing):
    """Four blocks away and more: the near field is e^-8 of it there, and the block's own size (1/4)^2 / 24."""
    body = bem3d.HalfSpace(shape=(48, 40), spacing=spacing, modulus=3.0)
    pressed, sums = np.zeros(body.shape), np.zeros(body.far.shape)
    pressed[:4, :4], sums[0, 0] = 1.0, 16.0
    whole = displacement(body, pressed).reshape(12, 4, 10, 4).mean(axis=(1, 3))
    distant = np.add.outer(np.arange(12), np.arange(10)) >= 6
    np.testing.assert_allclose(body.far(sums)[distant], whole[distant], rtol=0.01)


periodic_symbol = kernel.periodic_symbol


@catches("a far field that is all of K").at(
    "bem3d.kernel.far_periodic_symbol", lambda shape, steps, modulus, _: periodic_symbol(shape, steps, modulus)
)
@with_levels
def test_waves_of_a_period_are_near_or_far():
    """2 / (E* q), of the sums of a wave over blocks of an eighth of it, of which the mean is sinc(1/8) of the wave."""
    body = bem3d.HalfSpace(shape=(32, 32), spacing=0.5, modulus=3.0, periodic=True)
    wave, q = np.cos(2 * np.pi * (np.arange(32) + 0.5) / 32)[:, np.newaxis] * np.ones(32), 2 * np.pi / 16
    sums = wave.reshape(8, 4, 8, 4).sum(axis=(1, 3))
    near = 2 / (3 * np.hypot(q, body.near_wave))
    far = 2 / (3 * q) - near
    np.testing.assert_allclose(body.far(sums), far * sums / 16, rtol=1e-9)
    np.testing.assert_allclose(body.inverse(wave), wave / near, rtol=1e-9)


@catches("a near field alone", periodic=False).at(
    "bem3d.far_field.FarField._settled", lambda self, pressed, stiffness: 0 * pressed
)
@pytest.mark.parametrize("periodic", [False, True])
def test_work_on_a_contact_does_not_grow_with_the_grid(periodic):
    """The tops of four cells a wave, a twentieth of the cells: from 128 to 512 one iteration more, without it four."""
    counts = {}
    for level, n in itertools.product((512**2, 0), (128, 512)):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(halfspace, "ONE_LEVEL", level)
            body, gap = self_affine(n, periodic=periodic)
            contact = (-gap) > np.quantile(-gap, 0.95)
            counts[level, n] = bem3d.solve_fixed_area(body, contact).iterations
    assert counts[0, 512] <= counts[0, 128] + 1
    assert counts[512**2, 512] >= counts[512**2, 128] + 4


@pytest.mark.parametrize("periodic", [False, True])
@with_levels
def test_a_sparse_contact_is_nearly_inverted(periodic):
    """Eigenvalues of M K, the mean plane apart: within a factor of ten, on islands of which each is felt by all."""
    body = bem3d.HalfSpace(shape=(16, 16), spacing=1.0, modulus=1.0, periodic=periodic)
    contact = np.zeros(body.shape, dtype=bool)
    contact[1::4, 1::4] = contact[2::4, 1::4] = contact[1::8, 2::8] = True
    cells = np.flatnonzero(contact)
    operator = dense_operator(body)[np.ix_(cells, cells)]
    inverse = bem3d.window.Candidates(body, contact).inverse
    everywhere = np.ones(cells.size, dtype=bool)
    product = np.array([inverse(column, everywhere) for column in operator.T]).T
    values = np.sort(np.linalg.eigvals(product).real)[int(periodic) :]
    assert values[0] > 0 and values[-1] < 10 * values[0]


@catches("a cut whose force is felt from afar", periodic=False).at(
    "bem3d.far_field.FarField.cut", lambda self, pressure: np.maximum(pressure, 0.0, out=pressure)
)
@pytest.mark.slow
@pytest.mark.parametrize("periodic", [True, False])
def test_applications_do_not_grow(periodic):
    """From a grid of one level to one of two, with waves down to four cells on both."""
    counts = []
    for n in (512, 1024):
        body, gap = self_affine(n, periodic=periodic)
        counts.append(bem3d.solve(body, gap, force=0.005, tolerance=1e-4).operator_applications)
    assert counts[1] <= counts[0]


@with_levels
def test_a_cut_keeps_the_force_on_a_block_that_presses():
    """And leaves none on a block that would pull; the cells keep their ratios."""
    body = bem3d.HalfSpace(shape=(20, 16), spacing=1.0, modulus=2.0)
    rng = np.random.default_rng(1)
    marked = rng.random(body.shape) < 0.4
    cells, aim = bem3d.window.Candidates(body, marked), rng.normal(0.5, 1.0, np.count_nonzero(marked))
    before, pressure = cells.spread(aim), aim.copy()
    cells.cut(pressure)
    after = cells.spread(pressure)
    forces, kept = (field.reshape(5, 4, 4, 4).sum(axis=(1, 3)) for field in (before, after))
    assert (forces < 0).any() and ((pressure > 0) <= (aim > 0)).all() and (pressure >= 0).all()
    np.testing.assert_allclose(kept, np.maximum(forces, 0.0), rtol=1e-12, atol=1e-12)
    pressed = (before[:4, :4] > 0) & (after[:4, :4] > 0)
    np.testing.assert_allclose(np.ptp(after[:4, :4][pressed] / before[:4, :4][pressed]), 0.0, atol=1e-12)


HOSTILE = 500


@pytest.mark.parametrize("part", range(10))
@with_levels
def test_hostile_contacts_are_solved_or_refused(part):
    """Spikes, plateaus, ties, stripes, corners, on cells of any shape and unit: to 1e-8 by an operator of the tests."""
    for seed in range(part * HOSTILE // 10, (part + 1) * HOSTILE // 10):
        rng = np.random.default_rng(seed)
        shape = tuple(rng.integers(3, 26, size=2).tolist())
        dx, aspect, modulus = 10.0 ** rng.uniform([-6, -0.5, -3], [1, 0.5, 11])
        cells = {"shape": shape, "spacing": (dx, aspect * dx), "threads": seed % 3 + 1}
        body = bem3d.HalfSpace(**cells, modulus=modulus, periodic=bool(seed % 2))
        gap = HOSTILE_GAPS[seed // 2 % len(HOSTILE_GAPS)](rng, shape) * dx * 10.0 ** rng.uniform(-5, 0)
        force = modulus * max(float(np.ptp(gap)), 1e-9 * dx) * dx * max(shape) * 10.0 ** rng.uniform(-4, 1)
        contact = checked(bem3d.solve(body, gap, force=force, tolerance=1e-8))
        if not (body.periodic and contact.approach >= gap.mean()):
            again = checked(bem3d.solve(body, gap, approach=contact.approach, tolerance=1e-8))
            # near full contact the approach of a period says next to nothing of its force
            assert body.periodic or again.force == pytest.approx(contact.force, rel=1e-5), seed


def spikes(rng, shape):
    return 1.0 - (rng.random(shape) < 0.05) * rng.random(shape)


def stripes(rng, shape):
    return np.broadcast_to(np.arange(shape[0])[:, np.newaxis] % 3, shape) + 1e-3 * rng.random(shape)


def corners(rng, shape):
    gap = np.ones(shape)
    gap[0, 0] = gap[-1, -1] = 0.0
    return gap + 0.1 * rng.random(shape)


def tilted(rng, shape):
    return np.add.outer(np.arange(shape[0]) * rng.random(), np.arange(shape[1]) * rng.random())


HOSTILE_GAPS = [
    lambda rng, shape: rng.normal(size=shape),
    spikes,
    lambda rng, shape: rng.integers(0, 3, size=shape).astype(float),
    stripes,
    corners,
    tilted,
    lambda rng, shape: rng.exponential(size=shape) ** 4,
]


@with_levels
def test_no_free_cell_and_no_displacement_need_no_pressure():
    body = bem3d.HalfSpace(shape=(12, 12), spacing=1.0, modulus=1.0)
    cells = bem3d.window.Candidates(body, np.ones(body.shape, dtype=bool))
    none, everywhere = np.zeros(144, dtype=bool), np.ones(144, dtype=bool)
    assert not cells.inverse(np.zeros(144), none).any()
    assert not cells.inverse(np.zeros(144), everywhere).any()


@catches("one step on the blocks").at("bem3d.far_field.MOST_STEPS", 1)
@with_levels
def test_the_system_on_the_blocks_is_solved_within_its_accuracy():
    """(1 + C D) y = C b, by matrices."""
    body = bem3d.HalfSpace(shape=(20, 16), spacing=1.0, modulus=2.0)
    rng = np.random.default_rng(1)
    cells = np.flatnonzero(rng.random(320) < 0.3)
    far = far_field.FarField(body, cells, lambda vector: vector)
    stiffness, displaced = 10 * rng.random((2, 5, 4)) * (rng.random((5, 4)) < 0.8)
    pressed = stiffness * displaced
    matrix = np.array([body.far(unit.reshape(5, 4)).ravel() for unit in np.eye(20)]).T
    exact = np.linalg.solve(np.eye(20) + matrix * stiffness.ravel(), matrix @ pressed.ravel())
    found = far._settled(pressed, stiffness).ravel()
    assert np.linalg.norm(found - exact) <= 3 * far_field.ACCURACY * np.linalg.norm(exact)
