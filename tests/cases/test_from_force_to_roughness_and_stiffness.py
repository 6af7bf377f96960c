"""Cases about rolling that end a claim: where linear theory ends, roughness from force, stiffness along a track."""

import math
from dataclasses import replace

import numpy as np
import pytest

import bem3d
from validation.analysis.evidence import ClaimStatus, numbers_with
from validation.analysis.statistics import Estimate
from validation.analysis.study import Outcomes
from validation.cases.rolling import roughness_from_force, validity
from validation.cases.rolling.roughness_from_force import FILTER_1D, FILTER_3D, MEAN_FILTER, RoughnessFromForce
from validation.cases.rolling.track_stiffness import (
    DEVIATION,
    MEAN,
    OVER,
    PROFILE,
    PUNCH,
    REFINED,
    STUDY,
    WHEEL,
    TrackStiffness,
    of_punches,
    of_tracks,
)
from validation.cases.rolling.validity import (
    CORRELATION,
    HEIGHT,
    KEPT,
    OFF,
    REFERENCE,
    SLOPE,
    SPECTRA,
    Validity,
)
from validation.simulation import rolling_strip
from validation.simulation.reduced_pair import LAYER, MODELS, READ, over_boundary_elements, roll_reduced
from validation.simulation.rolling_strip import level_1d, level_3d, roll_strip, strip_levels
from validation.simulation.track_spectrum import INPUT_SPECTRA

RNG = np.random.default_rng(0)
HOLDS, CONTRADICTED = ClaimStatus.HOLDS, ClaimStatus.CONTRADICTED


def off(found):
    """Found over true roughness in bands without a zero of the filter [dB]."""
    return 10 * np.log10(found[BETWEEN] / TRUE[BETWEEN])


# --- roughness from force ---

CASE = RoughnessFromForce()
TRUE = roughness_from_force.true_roughness(CASE)
BETWEEN = CASE.inside & ~CASE.zeros


def test_the_true_roughness_is_half_of_the_mean_square_height():
    """Over positive wavenumbers, in the bands from q a = 1.1 on of a spectrum that begins at 1."""
    edges = np.array(CASE.bands.edges)
    first, last = edges[:-1][CASE.inside][0], edges[-1]
    power = -2 * CASE.hurst
    share = (first**power - last**power) / (CASE.first**power - CASE.last**power)
    assert TRUE[CASE.inside].sum() == pytest.approx(share / 2, rel=1e-3)


def test_the_filter_in_one_dimension_finds_the_roughness_of_ridges():
    """Levels of (14.12) with Geike's spectrum: of ridges across the track, where it is exact; to the bend in a band."""
    levels = level_1d(CASE.spectrum, "geike", CASE.bands)
    found = roughness_from_force.roughness(CASE.bands, levels, FILTER_1D)
    assert np.abs(off(found)).max() < 0.25


def test_the_filter_in_three_dimensions_finds_isotropic_roughness():
    """And next to nothing below it, where filters in one dimension find a tenth of it."""
    roughness_from_force.filter_3d.cache_clear()
    levels = level_3d(CASE.spectrum, CASE.bands)
    found = {by: roughness_from_force.roughness(CASE.bands, levels, by) for by in roughness_from_force.FILTERS}
    roughness_from_force.filter_3d.cache_clear()
    assert np.abs(off(found[FILTER_3D])).max() < 0.3
    below = np.array(CASE.bands.edges[1:]) < 1
    assert found[FILTER_3D][below].sum() < 0.01 * TRUE.sum()
    assert found[FILTER_1D][below].sum() > 0.1 * TRUE.sum()
    assert (off(found[FILTER_1D]) < -2).all()
    assert off(found[MEAN_FILTER]).mean() < -2


def on_linear_theory(factor=1.0):
    """A result whose boundary elements are linear theory, times a factor."""
    linear = RNG.lognormal(0, 0.2, (6, len(TRUE)))
    level = factor * linear * (1 + 1e-3 * RNG.standard_normal(linear.shape))
    return Outcomes(CASE, {height: {"level": level, "linear level": linear} for height in CASE.heights})


def test_claims_of_roughness_from_force_follow_their_numbers():
    evidence = roughness_from_force.CASE.evidence
    book, one, between, *_ = evidence(on_linear_theory()).claims
    assert book.claim == roughness_from_force.CASE.claim
    assert [book.status, one.status, between.status] == [CONTRADICTED, CONTRADICTED, HOLDS]
    assert evidence(on_linear_theory(4.0)).claims[2].status is CONTRADICTED


# --- where linear theory ends ---


def test_a_smooth_wheel_keeps_its_contact_whatever_its_force():
    force = RNG.uniform(0.5, 2.0, (4, 50))
    strips = [{"area": 0.8 * one ** (2 / 3), "force": one} for one in force]
    kept = validity.contact_kept(strips)
    assert kept.value == pytest.approx(0.8)
    assert kept.half_width == pytest.approx(0, abs=1e-9)


def test_the_level_off_linear_theory_is_a_root_mean_square_in_decibels():
    linear = RNG.lognormal(0, 0.2, (5, 2))
    found = validity.off_linear({"level": linear * [10**0.3, 10**-0.4], "linear level": linear})
    assert found.value == pytest.approx(math.sqrt((3**2 + 4**2) / 2))
    assert found.half_width == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("parameter", [SLOPE, HEIGHT])
def test_the_parameter_that_counts_is_found(parameter):
    """A loss of contact, and of level, that depends on one parameter alone."""
    case = Validity(slopes=(0.5, 1.0), heights=(0.1, 0.3))
    found = {}
    for name, spectrum in SPECTRA.items():
        for given, value in case.levels:
            height = value / spectrum.slope_along if given == SLOPE else value
            x = height * (spectrum.slope_along if parameter == SLOPE else 1.0)
            of = {KEPT: 1 - 0.3 * x, OFF: 8 * x, LAYER: 0.1, READ: 3.0}
            found[name, given, value] = {what: Estimate(one, 0.01 * one, 4) for what, one in of.items()} | {
                CORRELATION: 1.0
            }
    claims = validity.CASE.evidence(Outcomes(case, found)).claims
    slope, height, slope_level, height_level, read, layer = claims
    assert [read.status, layer.status] == [CONTRADICTED, HOLDS]
    right, wrong = (slope, height) if parameter == SLOPE else (height, slope)
    assert [right.status, wrong.status] == [HOLDS, CONTRADICTED]
    right, wrong = (slope_level, height_level) if parameter == SLOPE else (height_level, slope_level)
    assert [right.status, wrong.status] == [HOLDS, CONTRADICTED]


def test_a_reduced_model_stands_beside_boundary_elements_on_the_surface_itself():
    """Low roughness, whatever the cells: both have the level of linear theory within half of a decibel."""
    case = Validity(waves=3, width=7, cells=8)
    strip = case.strips_of(REFERENCE, HEIGHT, 0.01)[0]
    bands, truth = case.bands_for(SPECTRA[REFERENCE]), roll_strip(strip)
    beside = strip_levels([truth], 1 / strip.cells, bands)
    rolled = [roll_reduced(strip)]
    for model in MODELS:
        found = over_boundary_elements(model, rolled, strip, beside, bands)
        off = 10 * np.log10(found["level"].sum() / found["linear level"].sum())
        assert off == pytest.approx(0, abs=0.5)


def test_the_spectrum_of_reference_is_not_judged_beside_itself():
    assert all(name == REFERENCE or SPECTRA[name] != SPECTRA[REFERENCE] for name in SPECTRA)


# --- stiffness along a track ---

SMALL = TrackStiffness(forces=(1.0,), length=16, strips=3, refined=3, tracks=5, surfaces=4, profiles=10)


@pytest.mark.parametrize("height", [0.0, 0.3])
def test_the_stiffness_along_a_track_is_the_change_of_force_with_approach(height):
    """Beside a finite difference; on a smooth track 2 E* a, to an edge some tenths of a cell out of place."""
    surface = replace(SMALL.rough_strip(1.0), height=height).surface(8, 0)
    track = bem3d.Track(height=np.ascontiguousarray(surface), spacing=1 / 8, radius=1.0, modulus=1.0)
    wheel = bem3d.RollingContact(track, tolerance=1e-9)
    stiffness = rolling_strip.tangent_stiffness(wheel, 5)
    approach, step = wheel.carry(5, 4 / 3).approach, 1e-4
    more, less = (wheel.press(5, approach + sign * step).force for sign in (1, -1))
    assert stiffness == pytest.approx((more - less) / (2 * step), rel=0.01)
    if height == 0:
        assert stiffness == pytest.approx(2, rel=0.05)


def test_low_tracks_have_the_stiffness_of_the_smooth_wheel():
    tracks = SMALL.tracks_of(1.0, "geike")
    tracks = replace(tracks, scene=replace(tracks.scene, height=1e-6))
    along = rolling_strip.roll_loaded_tracks(tracks)
    assert along["mean"] == pytest.approx(1, abs=2 / tracks.springs)
    assert np.sqrt(along["variance"]).max() < 1 / tracks.springs


def along(mean=1.0, deviation=0.1, rows=8):
    """Moments of tracks with little scatter."""
    scatter = 1 + 1e-4 * RNG.standard_normal(rows)
    level = 1e-3 * deviation**2 * np.ones((rows, len(SMALL.bands.centres))) * scatter[:, np.newaxis]
    return {"mean": mean * scatter, "variance": (mean * deviation) ** 2 * scatter, "level": mean**2 * level}


@pytest.mark.slow
def test_the_deviation_is_that_of_the_mean_variance():
    assert math.exp(of_tracks(DEVIATION, along(2.0, 0.1)).value) == pytest.approx(0.1, rel=1e-3)
    assert math.exp(of_tracks(MEAN, along(2.0, 0.1)).value) == pytest.approx(2.0, rel=1e-3)
    punches = 2 + 0.2 * RNG.standard_normal(4000)
    assert math.exp(of_punches(punches, DEVIATION).value) == pytest.approx(0.1, rel=0.05)
    assert of_punches(punches, DEVIATION).half_width == pytest.approx(1.96 / math.sqrt(2 * 4000), rel=0.1)


@pytest.mark.slow
@pytest.mark.parametrize(("springs", "status"), [(0.1, HOLDS), (0.15, CONTRADICTED)])
def test_claims_of_the_stiffness_follow_their_numbers(springs, status):
    bem, scatter = along(), RNG.standard_normal(4000)
    result = Outcomes(
        SMALL,
        {(grid, 1.0): bem for grid in (WHEEL, REFINED)}
        | {(rule, 1.0): along(deviation=springs) for rule in INPUT_SPECTRA}
        | {(PUNCH, 1.0): 1 + 0.1 * scatter, (PROFILE, 1.0): 1 + springs * scatter},
    )
    found = STUDY.evidence(result)
    fluctuation, mean, *_, punch = found.claims
    assert [fluctuation.status, mean.status, punch.status] == [status, HOLDS, HOLDS]
    (number,) = numbers_with(found.numbers, DEVIATION, OVER["geike"])
    assert number.value == pytest.approx(springs / 0.1 - 1, abs=0.01)
