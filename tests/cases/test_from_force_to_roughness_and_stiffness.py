"""Cases about rolling that end a claim: where linear theory ends, roughness from force, stiffness along a track."""

import math
from dataclasses import replace

import numpy as np
import pytest

import bem3d
from tests.cases.planted import judged, statuses
from validation.analysis.evidence import ClaimStatus
from validation.analysis.statistics import Estimate
from validation.analysis.study import Outcomes
from validation.cases.rolling import roughness_from_force as from_force
from validation.cases.rolling import track_stiffness as stiffness
from validation.cases.rolling import validity
from validation.cases.rolling.validity import CORRELATION, HEIGHT, KEPT, OFF, REFERENCE, SLOPE, SPECTRA
from validation.simulation import rolling_strip
from validation.simulation.reduced_strip import FOLLOWING, LAYER, READ, over_boundary_elements, roll_reduced
from validation.simulation.rolling_strip import level_1d, level_3d, roll_strip, strip_levels
from validation.simulation.track_spectrum import INPUT_SPECTRA

RNG = np.random.default_rng(0)
HOLDS, CONTRADICTED = ClaimStatus.HOLDS, ClaimStatus.CONTRADICTED

# --- roughness from force ---

CASE = from_force.RoughnessFromForce()
TRUE = from_force.true_roughness(CASE)


def off(found):
    """Found over true roughness in bands without a zero of the filter [dB]."""
    between = CASE.inside & ~CASE.zeros
    return 10 * np.log10(found[between] / TRUE[between])


def test_the_true_roughness_is_half_of_the_mean_square_height():
    """Over positive wavenumbers, in the bands from q a = 1.1 on of a spectrum that begins at 1."""
    first, last = np.array(CASE.bands.edges)[:-1][CASE.inside][0], CASE.bands.edges[-1]
    power = -2 * CASE.hurst
    share = (first**power - last**power) / (CASE.first**power - CASE.last**power)
    assert TRUE[CASE.inside].sum() == pytest.approx(share / 2, rel=1e-3)


def test_the_filter_in_one_dimension_finds_the_roughness_of_ridges():
    """Levels of (14.12) with Geike's spectrum: of ridges across the track, where it is exact; to the bend in a band."""
    levels = level_1d(CASE.spectrum, "geike", CASE.bands)
    assert np.abs(off(from_force.roughness(CASE.bands, levels, from_force.FILTER_1D))).max() < 0.25


def test_the_filter_in_three_dimensions_finds_isotropic_roughness():
    """And next to nothing below it, where filters in one dimension find a tenth of it."""
    from_force.filter_3d.cache_clear()
    levels = level_3d(CASE.spectrum, CASE.bands)
    found = {by: from_force.roughness(CASE.bands, levels, by) for by in from_force.FILTERS}
    from_force.filter_3d.cache_clear()
    in_1d, in_3d = found[from_force.FILTER_1D], found[from_force.FILTER_3D]
    assert np.abs(off(in_3d)).max() < 0.3
    below = np.array(CASE.bands.edges[1:]) < 1
    assert in_3d[below].sum() < 0.01 * TRUE.sum() and in_1d[below].sum() > 0.1 * TRUE.sum()
    assert (off(in_1d) < -2).all()
    assert off(found[from_force.MEAN_FILTER]).mean() < -2


@pytest.mark.parametrize(("factor", "between"), [(1.0, HOLDS), (4.0, CONTRADICTED)])
def test_claims_of_roughness_from_force_follow_their_numbers(factor, between):
    """Boundary elements that are linear theory, times a factor."""
    linear = RNG.lognormal(0, 0.2, (6, len(TRUE)))
    level = factor * linear * (1 + 1e-3 * RNG.standard_normal(linear.shape))
    found = {height: {"level": level, "linear level": linear} for height in CASE.heights}
    claims = statuses(from_force.CASE.evidence(Outcomes(CASE, found)))
    assert claims[2] is between
    assert factor > 1 or claims[:2] == [CONTRADICTED, CONTRADICTED]


# --- where linear theory ends ---


def test_a_smooth_wheel_keeps_its_contact_whatever_its_force():
    kept = validity.contact_kept([{"area": 0.8 * one ** (2 / 3), "force": one} for one in RNG.uniform(0.5, 2, (4, 50))])
    assert (kept.value, kept.half_width) == (pytest.approx(0.8), pytest.approx(0, abs=1e-9))


def test_the_level_off_linear_theory_is_a_root_mean_square_in_decibels():
    linear = RNG.lognormal(0, 0.2, (5, 2))
    found = validity.off_linear({"level": linear * [10**0.3, 10**-0.4], "linear level": linear})
    assert (found.value, found.half_width) == (pytest.approx(math.sqrt((3**2 + 4**2) / 2)), pytest.approx(0, abs=1e-9))


@pytest.mark.parametrize("parameter", [SLOPE, HEIGHT])
def test_the_parameter_that_counts_is_found(parameter):
    """A loss of contact, and of level, that depends on one parameter alone."""
    case, found = validity.Validity(slopes=(0.5, 1.0), heights=(0.1, 0.3)), {}
    for name, spectrum in SPECTRA.items():
        for given, value in case.levels:
            height = value / spectrum.slope_along if given == SLOPE else value
            x = height * (spectrum.slope_along if parameter == SLOPE else 1.0)
            of = {KEPT: 1 - 0.3 * x, OFF: 8 * x, LAYER: 0.1, READ: 3.0}
            estimates = {what: Estimate(one, 0.01 * one, 4) for what, one in of.items()}
            found[name, given, value] = estimates | {CORRELATION: 1.0}
    by_slope, by_height = (HOLDS, CONTRADICTED)[:: 1 if parameter == SLOPE else -1]
    expected = [by_slope, by_height, by_slope, by_height, CONTRADICTED, HOLDS]
    assert statuses(validity.CASE.evidence(Outcomes(case, found))) == expected


def test_a_reduced_model_stands_beside_boundary_elements_on_the_surface_itself():
    """Low roughness, whatever the cells: both have the level of linear theory within half of a decibel."""
    case = validity.Validity(waves=3, width=7, cells=8)
    strip, bands = case.strips_of(REFERENCE, HEIGHT, 0.01)[0], case.bands_for(SPECTRA[REFERENCE])
    beside, rolled = strip_levels([roll_strip(strip)], 1 / strip.cells, bands), [roll_reduced(strip)]
    for model in FOLLOWING:
        found = over_boundary_elements(model, rolled, strip, beside, bands)
        assert 10 * np.log10(found["level"].sum() / found["linear level"].sum()) == pytest.approx(0, abs=0.5)


# --- stiffness along a track ---

SMALL = stiffness.TrackStiffness(forces=(1.0,), length=16, strips=3, refined=3, tracks=5, surfaces=4, profiles=10)


@pytest.mark.parametrize("height", [0.0, 0.3])
def test_the_stiffness_along_a_track_is_the_change_of_force_with_approach(height):
    """Beside a finite difference; on a smooth track 2 E* a, to an edge some tenths of a cell out of place."""
    surface = np.ascontiguousarray(replace(SMALL.rough_strip(1.0), height=height).surface(8, 0))
    wheel = bem3d.RollingContact(bem3d.Track(height=surface, spacing=1 / 8, radius=1.0, modulus=1.0), tolerance=1e-9)
    found = rolling_strip.tangent_stiffness(wheel, 5)
    approach, step = wheel.carry(5, 4 / 3).approach, 1e-4
    more, less = (wheel.press(5, approach + sign * step).force for sign in (1, -1))
    assert found == pytest.approx((more - less) / (2 * step), rel=0.01)
    assert height or found == pytest.approx(2, rel=0.05)


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
    for quantity, value in ((stiffness.DEVIATION, 0.1), (stiffness.MEAN, 2.0)):
        assert math.exp(stiffness.of_tracks(quantity, along(2.0, 0.1)).value) == pytest.approx(value, rel=1e-3)
    punches = stiffness.of_punches(2 + 0.2 * RNG.standard_normal(4000), stiffness.DEVIATION)
    assert math.exp(punches.value) == pytest.approx(0.1, rel=0.05)
    assert punches.half_width == pytest.approx(1.96 / math.sqrt(2 * 4000), rel=0.1)


@pytest.mark.slow
@pytest.mark.parametrize(("springs", "status"), [(0.1, HOLDS), (0.15, CONTRADICTED)])
def test_claims_of_the_stiffness_follow_their_numbers(springs, status):
    bem, scatter = along(), RNG.standard_normal(4000)
    result = Outcomes(
        SMALL,
        {(grid, 1.0): bem for grid in (stiffness.WHEEL, stiffness.REFINED)}
        | {(rule, 1.0): along(deviation=springs) for rule in INPUT_SPECTRA}
        | {(stiffness.PUNCH, 1.0): 1 + 0.1 * scatter, (stiffness.PROFILE, 1.0): 1 + springs * scatter},
    )
    fluctuation, mean, *_, punch = statuses(stiffness.STUDY.evidence(result))
    assert [fluctuation, mean, punch] == [status, HOLDS, HOLDS]
    (number,) = judged(stiffness.STUDY, result, stiffness.DEVIATION, stiffness.OVER["geike"])
    assert number.value == pytest.approx(springs / 0.1 - 1, abs=0.01)
