"""Profiles and surfaces drawn from a spectrum, measured back: moments, spectra, symmetry, Geike's rule between them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import bem3d
import mdr
from mdr import profile
from tests.seeded import Times, catches
from tests.strategies import hursts, scales

seeds = st.integers(0, 2**63)
lengths = st.integers(8, 65)


def rng(seed):
    return np.random.default_rng(seed)


def band(hurst, waves, length=1.0, rms=1.0):
    """Self-affine between the first and the given wave of a period."""
    step = 2 * np.pi / length
    return mdr.SelfAffine(hurst=hurst, q_min=step, q_max=waves * step, rms=rms)


def profile_moment(height, n, length):
    q = 2 * np.pi * np.fft.fftfreq(height.size, length / height.size)
    return np.sum(np.abs(q) ** n * np.abs(np.fft.fft(height, norm="forward")) ** 2)


def surface_moment(height, n, spacing):
    qx, qy = (2 * np.pi * np.fft.fftfreq(cells, step) for cells, step in zip(height.shape, spacing, strict=True))
    return np.sum(np.hypot(qx[:, None], qy) ** n * np.abs(np.fft.fft2(height, norm="forward")) ** 2)


@given(hurst=hursts, points=lengths, shape=st.tuples(lengths, lengths), seed=seeds, rms=scales)
def test_rms_is_exact_where_it_is_asked_for(hurst, points, shape, seed, rms):
    profile = mdr.rough_profile(band(hurst, points // 2).c1d, length=1.0, points=points, rng=rng(seed), rms=rms)
    surface = bem3d.rough_surface(
        band(hurst, min(shape) // 2, min(shape)).c2d, shape=shape, spacing=1.0, rng=rng(seed), rms=rms
    )
    assert np.sqrt(np.mean(profile**2)) == pytest.approx(rms, rel=1e-12)
    assert np.sqrt(np.mean(surface**2)) == pytest.approx(rms, rel=1e-12)


def test_many_profiles_are_those_of_as_many_draws():
    spectrum = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi, q_max=2 * np.pi * 8, rms=1.0)
    for points in (32, 33, 16):
        settings = {"c1d": spectrum.c1d, "length": 1.0, "points": points, "rms": 2.0}
        many = mdr.rough_profiles(**settings, count=5, rng=np.random.default_rng(1))
        rng = np.random.default_rng(1)
        each = [mdr.rough_profile(**settings, rng=rng) for _ in range(5)]
        assert many == pytest.approx(np.array(each), rel=1e-12, abs=1e-14)


@pytest.mark.parametrize("n", [0, 2, 4], ids=["height", "gradient", "curvature"])
@pytest.mark.parametrize("cells", [96, 97])
def test_drawn_profiles_and_surfaces_have_equal_moments(cells, n):
    """Geike's rule on drawn roughness. For a smooth spectrum, sums over waves are integrals to rounding (Poisson)."""
    step = 2 * np.pi / cells

    def c2d(q):
        return np.exp(-(((q / step - 24) / 4) ** 2))

    profile = mdr.rough_profile(lambda q: mdr.geike(q, c2d), length=cells, points=cells, rng=rng(1))
    surface = bem3d.rough_surface(c2d, shape=(cells, cells), spacing=1.0, rng=rng(2))
    ratio = profile_moment(profile, n, cells) / surface_moment(surface, n, (1.0, 1.0))
    assert ratio == pytest.approx(1, rel=1e-9)


def test_a_wave_at_the_edge_of_the_band_survives_rounding():
    """q_min = 2 pi / L carries most of the height, whatever the last bit of the lattice says."""
    for length in np.random.default_rng(0).uniform(0.1, 10, 200):
        spectrum = band(0.7, 4, length)
        height = mdr.rough_profile(spectrum.c1d, length=length, points=32, rng=rng(1))
        waves = np.abs(np.fft.fft(height, norm="forward")) > 1e-6
        assert np.count_nonzero(waves) == 8


def waves_of_a_profile(c1d, length, points, generator, amplitudes):
    """The sum over waves of `rough_profile`, one after the other; at Nyquist, its own mirror image, up or down."""
    x = (np.arange(points) + 0.5) * length / points
    last = points // 2
    if amplitudes == "fixed":
        turns = [complex(math.cos(t), math.sin(t)) for t in 2 * math.pi * generator.random(last)]
    else:
        turns = [complex(a, b) / math.sqrt(2) for a, b in generator.standard_normal((last, 2))]
    height = np.zeros(points)
    for j, turn in enumerate(turns, 1):
        q = 2 * math.pi * j / length
        size = math.sqrt(2 * math.pi * float(c1d(np.array([q]))[0]) / length)
        if 2 * j < points:
            height += 2 * size * (turn.real * np.cos(q * x) - turn.imag * np.sin(q * x))
        else:
            own = math.copysign(1, turn.real) if amplitudes == "fixed" else math.sqrt(2) * turn.real
            height += size * own * np.cos(math.pi * np.arange(points))
    return height


def half_a_circle(modes, own_mirror, amplitudes, rng):
    return np.where(own_mirror, 1.0, np.exp(1j * np.pi * rng.random(modes)))


resolved = profile._resolved


# sqrt(2 pi / L) C_1D, which has the wrong unit
@catches("(14.9) as printed", points=20, amplitudes="fixed").at(
    "mdr.profile._resolved", lambda *given: resolved(*given) ** 2
)
@catches("phases on half of the circle", points=20, amplitudes="fixed").at("mdr.profile._random_waves", half_a_circle)
@pytest.mark.parametrize("amplitudes", ["fixed", "gaussian"])
@pytest.mark.parametrize("points", [2, 3, 8, 9, 20, 65])
def test_a_profile_is_the_sum_of_its_waves_in_the_order_of_their_numbers(points, amplitudes):
    """One random number a wave, or two, from the longest to the shortest; the next draw goes on with the next one."""

    def c1d(q):
        return np.where(q <= math.pi * points / 2.5 * (1 + 1e-9), 0.02 / (0.1 + q**2), 0.0)

    ours, theirs = rng(7), rng(7)
    for _ in range(4):
        height = mdr.rough_profile(c1d, length=2.5, points=points, rng=ours, amplitudes=amplitudes)
        expected = waves_of_a_profile(c1d, 2.5, points, theirs, amplitudes)
        assert height == pytest.approx(expected, abs=1e-13 * np.abs(expected).max())


def waves_of_a_surface(c2d, shape, spacing, generator, amplitudes):
    """The sum over waves of `rough_surface`, one wave after the other, by rings of equal max(|i| / nx, j / ny).

    Within a ring by j, then by i; of waves with j = 0 or ny / 2, those with i > 0 stand for both.
    """
    (nx, ny), (dx, dy) = shape, spacing
    x, y = (np.arange(nx) + 0.5)[:, np.newaxis] / nx, (np.arange(ny) + 0.5) / ny
    rows = [i if 2 * i < nx else i - nx for i in range(nx)]
    waves = sorted(
        ((i, j) for i in rows for j in range(ny // 2 + 1)),
        key=lambda wave: (max(abs(wave[0]) * ny, wave[1] * nx), wave[::-1]),
    )
    if amplitudes == "fixed":
        turns = [complex(math.cos(t), math.sin(t)) for t in 2 * math.pi * generator.random(len(waves))]
    else:
        turns = [complex(a, b) / math.sqrt(2) for a, b in generator.standard_normal((len(waves), 2))]
    height = np.zeros(shape)
    for (i, j), turn in zip(waves, turns, strict=True):
        own = 2 * i in (0, -nx) and 2 * j in (0, ny)
        if (i, j) == (0, 0) or (not own and 2 * j in (0, ny) and not 0 < 2 * i < nx):
            continue
        q = 2 * math.pi * math.hypot(i / (nx * dx), j / (ny * dy))
        size = 2 * math.pi * math.sqrt(float(c2d(np.array([q]))[0]) / (nx * dx * ny * dy))
        # waves that the grid sees as up and down, one cell after the other, are not moved to the centres of the cells
        along = np.pi * np.arange(nx)[:, np.newaxis] if 2 * i == -nx else 2 * np.pi * i * x
        across = np.pi * np.arange(ny) if 2 * j == ny else 2 * np.pi * j * y
        if own:
            up = math.copysign(1, turn.real) if amplitudes == "fixed" else math.sqrt(2) * turn.real
            height += size * up * np.cos(along) * np.cos(across)
        else:
            height += 2 * size * (turn.real * np.cos(along + across) - turn.imag * np.sin(along + across))
    return height


@catches("surface shifted by half a cell", shape=(6, 6), spacing=(1, 1), amplitudes="fixed").at(
    "bem3d.surface._half_a_cell", lambda mode, points: np.ones(mode.shape)
)
@catches("spectrum of a surface without its mirror images", shape=(6, 6), spacing=(1, 1), amplitudes="fixed").at(
    "bem3d.surface._hermitian", lambda wave, amplitudes: wave
)
@catches("one-sided spectrum taken for two-sided", shape=(6, 6), spacing=(1, 1), amplitudes="fixed").at(
    "bem3d.rough_surface", Times(np.sqrt(2))
)
@pytest.mark.parametrize("amplitudes", ["fixed", "gaussian"])
@pytest.mark.parametrize(
    ("shape", "spacing"),
    [((6, 6), (1, 1)), ((5, 7), (1, 0.8)), ((8, 6), (0.7, 1)), ((6, 9), (1, 1)), ((1, 6), (1, 1)), ((3, 2), (1, 1))],
)
def test_a_surface_is_the_sum_of_its_waves_ring_by_ring(shape, spacing, amplitudes):
    """The same seed is the same surface in every version; the next draw goes on with the next random number."""
    nyquist = math.pi / max(spacing)

    def c2d(q):
        return np.where(q <= nyquist * (1 + 1e-9), 0.03 / (0.1 + q**2), 0.0)

    ours, theirs = rng(8), rng(8)
    for _ in range(4):
        height = bem3d.rough_surface(c2d, shape=shape, spacing=spacing, rng=ours, amplitudes=amplitudes)
        expected = waves_of_a_surface(c2d, shape, spacing, theirs, amplitudes)
        assert height == pytest.approx(expected, abs=1e-13 * np.abs(expected).max())


def profile_of(c1d):
    return mdr.rough_profile(c1d, length=2 * np.pi, points=64, rng=rng(1))


def surface_of(c2d):
    return bem3d.rough_surface(c2d, shape=(64, 16), spacing=(np.pi / 32, np.pi / 32), rng=rng(1))


DRAWS = [pytest.param(profile_of, 4, id="profile"), pytest.param(surface_of, 5, id="surface")]


@pytest.mark.parametrize(("draw", "power"), DRAWS)
def test_power_beyond_nyquist_may_be_a_billionth_of_the_curvature_and_no_more(draw, power):
    """q^4 C_1D and q^5 C_2D beyond the Nyquist wavenumber 32, over the largest of the waves drawn: q = 8."""

    def spectrum(share):
        def density(q):
            beyond = 1e-9 * share * 8.0**power / np.maximum(q, 32.0) ** power
            return np.where(q < 32.5, (np.abs(q - 8) < 1e-9) * 1.0, beyond)

        return density

    assert draw(spectrum(0.9)).std() > 0
    words = (
        "^c.d must vanish beyond the Nyquist wavenumber of the (points|grid), 32 rad/m, got power there: lower q_max or"
    )
    with pytest.raises(ValueError, match=words):
        draw(spectrum(1.1))
