"""Lateral structure from parallel lines: coherence by adaptive quadrature, alpha and the filter of drawn surfaces."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy import integrate, special

import validation
from tests.railway.oblique_lines import draw_lines
from tests.seeded import Times, catches
from validation.analysis.spectra import NominalBands
from validation.railway.problems.rail_quantity import RailQuantity
from validation.railway.problems.rail_strip import LateralBands, line_of, strip_of, structure_of, uniform_parts
from validation.railway.scenes.measured_lines import MeasuredLines
from validation.railway.theory import line_coherence
from validation.railway.theory.line_coherence import LARGEST, UNKNOWN, ParallelLines, in_words
from validation.railway.theory.transverse_structure import (
    BandedStructure,
    IsotropicGround,
    LineSpectrum,
    Ridges,
    WaveBand,
)

RAIL = validation.load_scene("rail")
POSITIONS = (0.0, 0.005, 0.010)
BENT = LineSpectrum((10.0, 100.0, 1e3, 4e3), (1e-12, 3e-14, 2e-16, 3e-17))


def power_law(exponent):
    return LineSpectrum.through([1.0, 10.0], [1e-9, 1e-9 * 10**-exponent])


# --- coherence ---


@catches("the coherence of half of the distance", alpha=0.7).at(
    "validation.railway.theory.transverse_structure.WaveBand.coherence",
    lambda band, q, s: np.sinc(band.alpha * np.asarray(q) * s / 2 / math.pi),
)
@pytest.mark.parametrize("alpha", [0.2, 0.7, 3.0])
def test_the_coherence_of_a_band_of_waves_is_an_integral_over_them(alpha):
    """int C(k_x, k_y) cos(k_y s) dk_y by the density of the band, over C_line."""
    band = WaveBand(alpha)
    for q, s in ((30.0, 0.01), (300.0, 0.005), (900.0, 0.01)):
        ends = np.linspace(0, alpha * q, 40)
        integral = sum(
            integrate.quad(lambda k, q=q, s=s: float(band.density(q, k, BENT)) * math.cos(k * s), a, b)[0]
            for a, b in pairwise(ends)
        )
        assert float(band.coherence(q, s)) == pytest.approx(2 * integral / float(BENT(q)), abs=1e-7)


def c_2d(q, k):
    return float(BENT.isotropic(math.hypot(q, k)))


@catches("half of the coherence of isotropic ground", q=300.0).at(
    "validation.railway.theory.transverse_structure.IsotropicGround.coherence", Times(0.5)
)
@pytest.mark.parametrize("q", [30.0, 300.0, 900.0])
def test_the_coherence_of_isotropic_ground_is_an_integral_over_c_2d(q):
    """By adaptive quadrature with a weight of cosine; of the line by Abel's inverse at each point."""
    for s in (0.002, 0.01):
        ends = q * np.geomspace(0.01, 100, 80)
        near = sum(
            integrate.quad(lambda k, s=s: c_2d(q, k) * math.cos(k * s), a, b)[0] for a, b in pairwise([0, *ends])
        )
        far = integrate.quad(lambda k: c_2d(q, k), ends[-1], np.inf, weight="cos", wvar=s, limit=400)[0]
        expected = 2 * (near + far) / float(BENT(q))
        assert float(IsotropicGround(BENT).coherence(q, s)) == pytest.approx(expected, abs=1e-3)


@pytest.mark.parametrize("exponent", [1.6, 2.4])
def test_the_coherence_of_an_isotropic_power_law_is_a_bessel_function(exponent):
    """2^(1 - p/2) / Gamma(p/2) (q s)^(p/2) K_p/2(q s)."""
    q, s, order = np.array([20.0, 100.0, 400.0]), 0.01, exponent / 2
    expected = 2 ** (1 - order) / math.gamma(order) * (q * s) ** order * special.kv(order, q * s)
    np.testing.assert_allclose(IsotropicGround(power_law(exponent)).coherence(q, s), expected, atol=1e-3)
    assert IsotropicGround(BENT).coherence(q, 0.0).tolist() == Ridges().coherence(q, s).tolist() == [1.0] * 3


def test_a_structure_of_bands_has_that_of_each_band():
    banded = BandedStructure((10.0, 100.0, 1000.0), (WaveBand(0.5), WaveBand(2.0)))
    q = np.array([[5.0, 50.0], [500.0, 5000.0]])
    own = [WaveBand(0.5), WaveBand(0.5), WaveBand(2.0), WaveBand(2.0)]
    expected = [float(band.coherence(k, 0.01)) for band, k in zip(own, q.ravel(), strict=True)]
    assert banded.coherence(q, 0.01).ravel().tolist() == expected
    with pytest.raises(ValueError, match="edges"):
        BandedStructure((10.0, 100.0), (Ridges(), Ridges()))
    transfer, line = (lambda x, y: 1 / (1 + (0.01 * y) ** 2) + 0 * x), power_law(2.0)
    powers = banded.band_power(line, transfer, edges=[10.0, 100.0, 1000.0], semi_axes=(5e-3, 5e-3))
    for i, band in enumerate((WaveBand(0.5), WaveBand(2.0))):
        alone = band.band_power(line, transfer, edges=[10.0, 100.0, 1000.0], semi_axes=(5e-3, 5e-3))
        assert powers[i] == pytest.approx(alone[i])


# --- estimates ---


def scene_of_lines(structure, exponent, seed, positions=POSITIONS, **changes):
    heights = draw_lines(np.random.default_rng(seed), structure, exponent, positions=positions)
    lines = MeasuredLines(height=heights, spacing=1e-3, positions=positions, longest=0.4)
    return replace(RAIL, roughness=lines, lateral_structure=None, **changes)


def bands_inside(structure, exponent, seed, positions=POSITIONS):
    """Of each band: whether both ends are known, and whether A3 of the drawn structure is in the interval of the
    lines. To 0.01 dB, which the spectrum of the lines leaves in place of that of the surface.
    """
    scene = scene_of_lines(structure, exponent, seed, positions)
    quantity, line = RailQuantity(scene, "contact-filter"), power_law(exponent)
    drawn = structure_of(structure, line)
    transfer = quantity.filtered.__globals__["transfer_of"]("linear, ellipse", scene.contact)
    edges, axes = quantity.bands.edges, scene.contact.semi_axes
    a3 = 10 * np.log10(drawn.band_power(line, transfer, edges=edges, semi_axes=axes))
    off = np.abs(a3 - quantity.linear.mean(axis=0))
    known = [estimate.kind == "between" for estimate in scene.measured_structure]
    return known, off <= quantity.half_width + quantity.smoothing_error + 0.01


SURFACES = [(alpha, p, seed) for seed, p in enumerate((1.6, 2.0, 2.6)) for alpha in (0.25, 0.5, 1.0, 2.0, "isotropic")]


def independent_waves(lines, q, waves, count):
    return REAL_BAND(lines, q, waves, 4 * count)


REAL_BAND = line_coherence.BandOfLines.of_waves


@catches("four times as many independent waves as there are").at(
    "validation.railway.theory.line_coherence.BandOfLines.of_waves", staticmethod(independent_waves)
)
@catches("the coherence of lines half as far apart").at(
    "validation.railway.theory.line_coherence.ParallelLines.apart",
    property(lambda lines: np.abs(np.subtract.outer(lines.positions, lines.positions)).round(9) / 2),
)
@pytest.mark.slow
def test_the_filter_of_drawn_surfaces_is_in_its_interval():
    """In 90 to 99 % of 345 bands; of those with two ends as well."""
    known, inside = (np.concatenate(column) for column in zip(*(bands_inside(*of) for of in SURFACES), strict=True))
    assert inside.size == 345 and known.sum() > 200
    assert 0.90 <= inside.mean() <= 0.99
    assert 0.90 <= inside[known].mean() <= 0.99


def test_alpha_is_between_ends_where_coherence_tells_and_one_sided_where_not():
    """15 m of lines 5 and 10 mm apart: alpha k s is 0.06 at 400 mm and 13 at 2.5 mm for alpha = 0.5."""
    estimates = scene_of_lines(0.5, 2.0, 1).measured_structure
    waves = NominalBands().within(0.4, 0.0025).nominal
    for estimate, wave in zip(estimates, waves, strict=True):
        if 0.01 <= wave <= 0.1:
            assert estimate.kind == "between" and 0.8 * estimate.low < 0.5 < 1.2 * estimate.high
            assert estimate.high / estimate.low < 2
        if wave < 0.004:
            assert estimate.kind == "at least" and estimate.isotropic and estimate.high == LARGEST
    ridges = scene_of_lines("ridges", 2.0, 1).measured_structure
    assert {estimate.kind for estimate in ridges} == {"at most"}
    assert max(estimate.high for estimate in ridges) < 0.7 and not any(estimate.isotropic for estimate in ridges)


def test_lines_far_apart_leave_all_open():
    """Of alpha = 2 and lines 0.3 m apart there is no coherence down from 100 mm: the ends are those of a scene
    without lines, but for the least alpha."""
    scene = scene_of_lines(2.0, 2.0, 3, (0.0, 0.3))
    short = scene.measured_structure[10:]
    assert {estimate.kind for estimate in short} <= {"at least", "not determined"}
    assert all(estimate.isotropic and estimate.low < 0.2 for estimate in short)


def test_noise_that_no_structure_has_is_not_determined():
    """Lines of which two are alike and the one between is of another rail."""
    heights = draw_lines(np.random.default_rng(1), "ridges", 2.0, positions=POSITIONS)
    heights[:, 1] = draw_lines(np.random.default_rng(2), "ridges", 2.0, positions=(0.0,))[:, 0]
    bands = NominalBands().within(0.1, 0.0025)
    estimates = ParallelLines(heights, 1e-3, POSITIONS).estimates(bands, None)
    assert [estimate.kind for estimate in estimates] == ["not determined"] * len(bands)
    few = ParallelLines(heights[:200], 1e-3, POSITIONS).estimates(NominalBands().within(0.1, 0.08), None)
    assert few == (UNKNOWN, UNKNOWN)


@pytest.mark.parametrize("shift", [-9, 7])
def test_lines_that_are_shifted_along_the_track_say_nothing_and_are_named(shift):
    scene = scene_of_lines(0.5, 2.0, 4)
    assert not scene.parallel_lines.shifts.any()
    heights = scene.roughness.height.copy()
    heights[:, 2] = np.roll(heights[:, 2], shift)
    shifted = replace(scene, roughness=replace(scene.roughness, height=heights))
    assert shifted.parallel_lines.shifts[2] == pytest.approx(1e-3 * shift, abs=4e-3)
    assert set(shifted.measured_structure) == {UNKNOWN}
    assert any("shifted along the track" in note for note in shifted.diagnose())


def test_lines_need_a_position_each_and_two_at_least():
    with pytest.raises(ValueError, match="two lines"):
        ParallelLines(np.zeros((100, 1)), 1e-3, (0.0,))
    with pytest.raises(ValueError, match="one a position"):
        ParallelLines(np.zeros((100, 3)), 1e-3, (0.0, 0.1))


# --- scenes ---


def test_a_scene_of_lines_needs_no_key_and_says_what_was_measured():
    scene = scene_of_lines(0.5, 2.0, 1)
    (shown,) = (text for name, text in scene.describe() if name == "what lies across")
    assert shown.startswith("by the coherence of 3 lines: alpha") and shown.endswith(" mm")
    assert in_words(scene.measured_structure, scene.levels.bands) in shown
    for stated in ("isotropic", 0.5):
        assert replace(scene, lateral_structure=stated).measured_structure is None
    one = MeasuredLines(height=scene.roughness.height[:, 0], spacing=1e-3, longest=0.4)
    assert replace(scene, roughness=one).measured_structure is None
    open_, own = (RailQuantity(each, "contact-filter") for each in (replace(scene, roughness=one), scene))
    assessed = own.counted(own.linear.mean(axis=0))
    assert (own.half_width[assessed] < open_.half_width[assessed] + 0.01).all()
    assert own.half_width[assessed].max() < 0.3 < open_.half_width[assessed].max()


def test_compare_has_the_measured_filter_and_its_uncertainty():
    scene = scene_of_lines("isotropic", 2.0, 1)
    found = validation.compare(scene, quantity="contact-filter", tolerance="3 dB", models=["linear, ellipse"])
    assert "the lateral structure by the lines leaves ±" in found.models[0].reason
    quantity = RailQuantity(scene, "contact-filter")
    np.testing.assert_allclose(found.value, quantity.linear.mean(axis=0))
    (solved,) = found.selection.solved
    known = np.isfinite(found.errors_of(solved))
    assert (found.errors_of(solved)[known] >= quantity.half_width[known]).all()
    longer = replace(quantity, longest=3)
    assert len(longer.linear[0]) == len(longer.bands) == 30
    np.testing.assert_allclose(longer.linear[:, -20:], quantity.linear[:, -20:], atol=0.02)


def test_strips_of_a_measured_structure_have_the_power_of_each_band():
    """Of a line along the middle, by the variances of all waves: those of the strip's own line."""
    scene = scene_of_lines(0.5, 2.0, 1)
    edges = tuple(scene.levels.bands.edges.tolist())
    halves = ("ridges",) * 15 + (0.5,) * (len(edges) - 16)
    mixed = strip_of(scene, LateralBands(edges, halves), 6, 0, 1)
    own = [strip_of(scene, across, 6, 0, 1) for across in ("ridges", 0.5)]
    k = 2 * math.pi * np.abs(np.fft.fftfreq(mixed.shape[0], mixed.spacing))
    of_line = [strip.variance.sum(axis=1) for strip in (mixed, *own)]
    long = k < edges[15]
    np.testing.assert_allclose(of_line[0], np.where(long, of_line[1], of_line[2]))
    assert mixed.ground.highest == own[1].ground.highest
    assert uniform_parts("ridges", np.array(edges))[0][0] == "ridges"
    parts = uniform_parts(mixed.ground.across, np.array(edges))
    assert [across for across, _ in parts] == list(halves)
    assert line_of(scene) is scene.isotropic.line
