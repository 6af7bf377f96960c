"""The half-space by which solvers are judged, beside dense sums and quadrature."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate

import bem3d
from tests import oracles
from validation.theory.half_space import LoveHalfSpace, love


@pytest.mark.parametrize(("x", "y"), [(0.0, 0.0), (1.5, 0.0), (0.4, -0.8), (-3.0, 2.0)])
def test_the_kernel_is_the_integral_of_one_over_r(x, y):
    dx, dy = 1.0, 0.6

    def along(angle):
        # in polar coordinates around the point the integrand is one
        c, s = np.cos(angle), np.sin(angle)
        with np.errstate(divide="ignore"):
            ends = sorted([(-dx / 2 - x) / c, (dx / 2 - x) / c]), sorted([(-dy / 2 - y) / s, (dy / 2 - y) / s])
        low, high = max(ends[0][0], ends[1][0], 0.0), min(ends[0][1], ends[1][1])
        return max(high - low, 0.0)

    corners = [np.arctan2(v * dy / 2 - y, u * dx / 2 - x) for u in (-1, 1) for v in (-1, 1)]
    edges = [-np.pi, *sorted(corners), np.pi]
    exact = sum(integrate.quad(along, a, b, limit=200)[0] for a, b in itertools.pairwise(edges) if b > a)
    assert love(np.array(x), np.array(y), dx, dy) == pytest.approx(exact, rel=1e-8)


@given(st.booleans(), st.integers(3, 7), st.integers(2, 8), st.integers(0, 9))
def test_the_displacement_is_that_of_a_dense_matrix(periodic, n, m, seed):
    pressure = np.random.default_rng(seed).uniform(0, 1, (n, m))
    spacing = (0.3, 0.2)
    half_space = bem3d.HalfSpace(shape=(n, m), spacing=spacing, modulus=2.0, periodic=periodic)
    exact = (oracles.dense_operator(half_space) @ pressure.ravel()).reshape(n, m)
    found = LoveHalfSpace((n, m), spacing, 2.0, periodic).displacement(pressure)
    np.testing.assert_allclose(found, exact, atol=1e-12 * np.abs(exact).max())
