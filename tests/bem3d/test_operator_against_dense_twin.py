"""The FFT operator against a matrix written out cell by cell, and the kernel against quadrature."""

import dataclasses
import pickle

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy import integrate

import bem3d
from bem3d import blocked_convolution, halfspace, kernel
from tests.oracles import dense_operator, love_by_logarithms
from tests.seeded import catches
from tests.strategies import half_spaces


def random_pressure(half_space, seed):
    return np.random.default_rng(seed).standard_normal(half_space.shape)


def in_blocks(patch, columns, numbers):
    """So many columns, and numbers in rows, at a time, on the smallest grids."""
    patch.setattr(halfspace, "CACHED_NUMBERS", 0)
    patch.setattr(halfspace, "CACHED_CELLS", 0)
    patch.setattr(blocked_convolution, "COLUMNS_AT_ONCE", columns)
    patch.setattr(blocked_convolution, "LEAST_AT_ONCE", 0)
    patch.setattr(blocked_convolution, "NUMBERS_AT_ONCE", numbers)


def assert_dense(half_space, seed):
    pressure = random_pressure(half_space, seed)
    dense = dense_operator(half_space) @ pressure.ravel()
    fast = half_space.displacement(pressure)
    np.testing.assert_allclose(fast.ravel(), dense, atol=1e-12 * np.abs(dense).max(initial=1e-300))


def shifted_table(cells, aspect):
    x, y = np.arange(cells[0])[:, np.newaxis], aspect * np.arange(cells[1])
    return kernel.love(x + 0.5, y, 1.0, aspect)


def repeated(quadrant, padded):
    rest = quadrant[1 : (padded[0] + 1) // 2]
    return np.concatenate([quadrant, rest]) / (padded[0] * padded[1])


@catches("a symbol that repeats instead of mirroring").at("bem3d.convolution._halfplane", repeated)
# 2n - 2 points would do, since the kernel is even: the two farthest distances may share a point
@catches("padding two points short").at(
    "bem3d.halfspace._doubled", lambda points: max(points + points % 2, 2 * points - 4)
)
@catches("kernel shifted by half a cell").at("bem3d.kernel.love_table", shifted_table)
@pytest.mark.slow
@given(half_space=half_spaces(most=8), seed=st.integers(0, 1000))
def test_displacement(half_space, seed):
    assert_dense(half_space, seed)


multiply = blocked_convolution.BlockedConvolution._multiply


@catches("a symbol a row too far").at(
    "bem3d.blocked_convolution.BlockedConvolution._multiply",
    lambda convolution, buffers, block: multiply(convolution, buffers, (block[0], np.roll(block[1], 1, axis=0))),
)
@pytest.mark.slow
@given(
    half_space=half_spaces(most=8),
    seed=st.integers(0, 1000),
    columns=st.integers(1, 5),
    numbers=st.integers(1, 60),
    threads=st.integers(1, 3),
)
def test_displacement_by_blocks(half_space, seed, columns, numbers, threads):
    """However many columns and rows they have, and the last of them fewer; by any threads."""
    with pytest.MonkeyPatch.context() as patch:
        in_blocks(patch, columns, numbers)
        assert_dense(dataclasses.replace(half_space, threads=threads), seed)


@catches("columns a power of two apart", n=1024).at("bem3d.blocked_convolution.COLUMNS_AT_ONCE", 32)
@pytest.mark.parametrize("n", [256, 512, 1024])
def test_rows_of_a_block_of_columns_are_not_a_power_of_two_apart(n):
    """Or they would share a few places of the cache, and displace each other."""
    apart = blocked_convolution.blocks(n + 1, blocked_convolution.COLUMNS_AT_ONCE)[0].stop
    assert apart & (apart - 1), f"{apart} numbers"


@given(x=st.floats(-20, 20), y=st.floats(-20, 20), dx=st.floats(0.1, 10), dy=st.floats(0.1, 10))
def test_love_against_the_textbook_logarithms(x, y, dx, dy):
    # the logarithms cancel, and one of them is that of zero, on the lines through the sides of the cell
    assume(abs(abs(x) - dx / 2) > 1e-3 and abs(abs(y) - dy / 2) > 1e-3)
    assert kernel.love(x, y, dx, dy) == pytest.approx(love_by_logarithms(x, y, dx, dy), rel=1e-9, abs=1e-11)


@catches("half of the corner function").at(
    "bem3d.kernel.corner", lambda x, y: kernel._half(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
)
def test_love_against_quadrature():
    value, error = integrate.dblquad(lambda s, t: 1 / np.hypot(3 - s, 2 - t), -1, 1, -0.5, 0.5)
    assert kernel.love(3.0, 2.0, 1.0, 2.0) == pytest.approx(value, abs=10 * error)


def test_corner_is_continued_to_the_axes():
    assert kernel.corner(0.0, 0.0) == 0
    assert kernel.corner(0.0, 3.0) == pytest.approx(kernel.corner(1e-14, 3.0), abs=1e-11)
    assert kernel.corner(2.0, 0.0) == 0


@pytest.mark.parametrize("periodic", [True, False])
def test_self_compliance_goes_with_the_modulus(periodic):
    half_space = bem3d.HalfSpace(shape=(4, 3), spacing=(0.5, 2.0), modulus=7.0, periodic=periodic)
    assert half_space.self_compliance == pytest.approx(dense_operator(half_space)[0, 0], rel=1e-12)


def test_far_away_a_loaded_cell_is_a_point_force():
    """u = F / (pi E* r), with a relative error of order (dx / r)^2."""
    half_space = bem3d.HalfSpace(shape=(101, 3), spacing=0.1, modulus=2.0)
    pressure = np.zeros(half_space.shape)
    pressure[0, 1] = 7.0
    r = 0.1 * np.arange(20, 101)
    expected = 7.0 * 0.01 / (np.pi * 2.0 * r)
    np.testing.assert_allclose(half_space.displacement(pressure)[20:, 1], expected, rtol=0.2 / 20**2)


def test_input_is_not_touched_and_results_are_not_shared():
    half_space = bem3d.HalfSpace(shape=(6, 7), spacing=1.0, modulus=1.0)
    pressure = random_pressure(half_space, 0)
    kept = pressure.copy()
    first = half_space.displacement(pressure)
    saved = first.copy()
    half_space.displacement(2 * pressure)
    np.testing.assert_array_equal(pressure, kept)
    np.testing.assert_array_equal(first, saved)


def test_a_half_space_survives_pickling():
    half_space = bem3d.HalfSpace(shape=(5, 6), spacing=(1.0, 2.0), modulus=3.0, periodic=True)
    pressure = random_pressure(half_space, 0)
    expected = half_space.displacement(pressure)
    copy = pickle.loads(pickle.dumps(half_space))
    assert copy == half_space
    np.testing.assert_array_equal(copy.displacement(pressure), expected)
