"""Springs that read a surface: linear theory of the half-space while all touch, a line over ridges, loops as oracle."""

import math
import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mdr
from mdr.rolling_surface import weights_across
from tests.seeded import catches
from validation.railway.theory.contact_filters import half_space_filter
from validation.theory.half_space import elliptic_contact

D, MODULUS = 1e-4, 2e11


def settings(radius=1.0, cells=40, aspect=1.0):
    smooth = elliptic_contact(radius if isinstance(radius, tuple) else (radius, radius), modulus=MODULUS, approach=D)
    steps = smooth.along / cells, smooth.across * aspect / cells
    return smooth, {"spacing": steps, "radius": radius, "modulus": MODULUS}


def by_loops(height, position, d, *, spacing, radius, modulus):
    """E* dx sum of max(d - x^2 / R + H, 0) on a sphere, H by a fine sum over the angle across."""
    nx, ny = height.shape
    a, force = math.sqrt(radius * D), 0.0
    for j in range(-nx, nx + 1):
        x = j * spacing[0]
        b = math.sqrt(max(a**2 - x**2, 0.0))
        angles = (np.arange(4000) + 0.5) * np.pi / 4000
        columns = np.floor(b * np.cos(angles) / spacing[1] + ny / 2).astype(int)
        if b == 0:
            columns = np.array([ny // 2])
        read = height[(position + j) % nx, np.clip(columns, 0, ny - 1)].mean()
        force += modulus * spacing[0] * max(d - x**2 / radius + read, 0.0)
    return force


def even_across(half_widths, points, step):
    """Equal weights over the contact, for those of the flat punch."""
    y = np.abs(np.arange(points) + 0.5 - points / 2)[:, np.newaxis] * step
    inside = (y <= np.maximum(half_widths, step)).astype(float)
    return inside / inside.sum(axis=0)


@catches("equal weights across the contact", radius=1.0, waves=(0, 3)).at(
    "mdr.rolling_surface.weights_across", even_across
)
@pytest.mark.parametrize("radius", [1.0, (1.0, 0.3), (0.3, 1.0)])
@pytest.mark.parametrize("waves", [(1, 0), (3, 2), (0, 3), (6, 1)])
def test_low_waves_of_any_direction_have_the_filter_of_the_half_space(radius, waves):
    smooth, given_ = settings(radius)
    nx, ny = 240, 121
    (dx, dy), k = given_["spacing"], smooth.stiffness
    along, across = 2 * np.pi * waves[0] / (nx * dx), 2 * np.pi * waves[1] / (ny * dy)
    x, y = np.arange(nx)[:, np.newaxis] * dx, (np.arange(ny) - (ny - 1) / 2) * dy
    strip = 1e-5 * D * np.cos(along * x) * np.cos(across * y)
    rough, flat = (mdr.roll_surface(h, **given_, approach=D).force for h in (strip, 0 * strip))
    mode = np.fft.rfft(rough - flat)[waves[0]].real / nx * (2 if waves[0] else 1) / (1e-5 * D)
    expected = float(half_space_filter(along, across, semi_axes=(smooth.along, smooth.across)))
    assert mode / k == pytest.approx(expected, abs=0.015)


def test_over_ridges_it_is_the_springs_of_a_line():
    _, given_ = settings(1.0)
    line = 0.3 * D * np.random.default_rng(4).standard_normal(200)
    of_line = {**given_, "spacing": given_["spacing"][0]}
    for load in ({"approach": D}, {"force": 4 / 3 * MODULUS * D**1.5}):
        ridges = mdr.roll_surface(np.repeat(line[:, np.newaxis], 101, axis=1), **given_, **load)
        springs = mdr.roll(line, **of_line, **load)
        np.testing.assert_allclose(ridges.force, springs.force, rtol=1e-9)
        np.testing.assert_allclose(ridges.approach, springs.approach, rtol=1e-9, atol=1e-9 * D)
        np.testing.assert_array_equal(np.rint(ridges.stiffness / springs.stiffness), 1.0)


@catches("one width across for all springs").at(
    "mdr.rolling_surface.weights_across",
    lambda widths, points, step: weights_across(np.full_like(widths, widths.max()), points, step),
)
def test_it_is_a_sum_over_springs_and_across():
    _, given_ = settings(1.0, cells=20)
    height = 0.5 * D * np.random.default_rng(6).standard_normal((80, 51))
    found = mdr.roll_surface(height, **given_, approach=D).force
    for position in (0, 33, 79):
        assert found[position] == pytest.approx(by_loops(height, position, D, **given_), rel=2e-3)


@given(st.integers(0, 2**32 - 1), st.floats(0.01, 2))
def test_force_and_approach_are_inverse(seed, rough):
    _, given_ = settings(1.0, cells=16)
    height = rough * D * np.random.default_rng(seed).standard_normal((48, 41))
    force = 4 / 3 * MODULUS * D**1.5
    under = mdr.roll_surface(height, **given_, force=force)
    # the smooth contact is that of the force, and the same at its approach
    for i in (0, 17):
        shift = height + (under.approach[i] - D)
        assert mdr.roll_surface(shift, **given_, approach=D).force[i] == pytest.approx(force, rel=1e-9)


@pytest.mark.parametrize("load", [{"approach": D}, {"force": 4 / 3 * MODULUS * D**1.5}])
def test_heights_beside_the_contact_take_no_work(load):
    _, given_ = settings(1.0, cells=20)
    height = 0.5 * D * np.random.default_rng(6).standard_normal((80, 401))
    beside, under = height.copy(), height.copy()
    beside[:, :170] += 9 * D
    under[7, 200] += 9 * D
    plain, other, touched = (mdr.roll_surface(h, **given_, **load) for h in (height, beside, under))
    np.testing.assert_array_equal([plain.force, plain.approach], [other.force, other.approach])
    assert plain.examined[0] == other.examined[0] < touched.examined[0]


def test_the_strip_is_not_copied():
    _, given_ = settings(1.0, cells=20)
    height = np.zeros((2000, 401))
    tracemalloc.start()
    mdr.roll_surface(height, **given_, approach=D)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < height.nbytes / 2


def test_few_springs_are_warned_of():
    _, given_ = settings(1.0, cells=4)
    with pytest.warns(mdr.SpringResolutionWarning):
        mdr.roll_surface(np.zeros((60, 41)), **given_, approach=D)
