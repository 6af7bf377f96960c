"""Cases about rolling that end a claim: roughness from force, how far models follow, stiffness along a track."""

import math
from dataclasses import replace

import numpy as np
import pytest

import bem3d
from tests.cases.planted import judged, statuses
from tests.seeded import Times, catches, module_with
from validation.analysis.case import Outcomes
from validation.analysis.evidence import ClaimStatus
from validation.cases.rolling import reduced_models as models
from validation.cases.rolling import track_stiffness as stiffness
from validation.cases.rolling.force_spectrum import ForceSpectrum
from validation.simulation import rolling_strip
from validation.simulation.reduced_models import COARSEST, JUDGE, LINEAR, MODELS, READ, bands_of, roll_by_all
from validation.simulation.rolling_strip import HERTZ, RoughStrip, level_3d, over_bands
from validation.simulation.track_spectrum import TrackSpectrum, self_affine
from validation.theory.rolling import mean_force_spectrum_1d

RNG = np.random.default_rng(0)
HOLDS, LIMITED, CONTRADICTED = ClaimStatus.SUPPORTED, ClaimStatus.LIMITED, ClaimStatus.REFUTED

# --- roughness from force ---

CASE = ForceSpectrum()
GEIKE = TrackSpectrum(CASE.spectrum, "geike")
TRUE = over_bands(GEIKE, CASE.bands)


def off(found):
    """Found over true roughness in bands without a zero of the filter [dB]."""
    return 10 * np.log10(found[CASE.between_zeros] / TRUE[CASE.between_zeros])


@catches("factor 2 lost in the mean filter, read backwards").at(
    "validation.simulation.rolling_strip.mean_force_spectrum_1d", Times(0.5)
)
def test_the_mean_filter_finds_the_roughness_of_the_mean_force():
    """To the bend of the spectrum in a band."""
    levels = over_bands(lambda q: mean_force_spectrum_1d(q, GEIKE, modulus=1.0), CASE.bands) / HERTZ**2
    assert np.abs(off(rolling_strip.by_mean_filter(CASE.bands, levels))).max() < 0.25


@catches("half of the height in the filter of three dimensions, read backwards").at(
    "validation.simulation.rolling_strip.level_3d", Times(0.5)
)
def test_the_filter_in_three_dimensions_finds_isotropic_roughness():
    """And next to nothing below it, where the mean filter finds a twelfth of it."""
    rolling_strip.filter_3d.cache_clear()
    levels = level_3d(CASE.spectrum, CASE.bands)
    in_1d, in_3d = (read(CASE.bands, levels) for read in (rolling_strip.by_mean_filter, rolling_strip.by_filter_3d))
    rolling_strip.filter_3d.cache_clear()
    assert np.abs(off(in_3d)).max() < 0.3
    below = np.array(CASE.bands.edges[1:]) < 1
    assert in_3d[below].sum() < 0.01 * TRUE.sum() and in_1d[below].sum() > 0.08 * TRUE.sum()
    assert off(in_1d).mean() < -2


# --- how far models follow ---


def outcome(height, spectrum, *, kept, linear):
    """Of one strip: levels of linear theory so many times those of the others."""
    level = height**2 * RNG.lognormal(0, 0.1, (1, len(bands_of(self_affine(*spectrum)).centres)))
    levels = np.repeat(level, len(MODELS), axis=0)
    levels[list(MODELS).index(LINEAR)] *= linear
    found = {"level": levels, "work": np.ones(len(MODELS)), "failed": np.array(0.0)}
    return found | {"kept": np.array(kept + 1e-3 * RNG.standard_normal())}


@pytest.mark.parametrize(("by", "status"), [("slope", HOLDS), ("height", CONTRADICTED)])
def test_the_parameter_that_decides_is_found(by, status):
    """A loss of contact that depends on one parameter alone; a level that leaves linear theory at the largest slope."""
    case, found = models.ReducedModels(spectra=((0.7, 1.0, 10.0), (0.7, 0.3, 5.0)), slopes=(0.1, 0.5, 1.0)), {}
    for slope in case.slopes:
        for spectrum in case.spectra:
            height = models.height_at(slope, spectrum)
            kept = 1 - 0.3 * (slope if by == "slope" else height)
            linear = 2.0 if slope == 1.0 else 1.0
            found[slope, spectrum] = [outcome(height, spectrum, kept=kept, linear=linear) for _ in range(4)]
    assert statuses(models.STUDY.evidence(Outcomes(case, found))) == [LIMITED, HOLDS, status]


@catches("half of the force of linear theory beside boundary elements").at(
    "validation.simulation.reduced_models.linear_force", Times(0.5)
)
@catches("contact kept beside a square wheel").at(
    "validation.simulation.reduced_models.math", module_with(math, pi=4.0)
)
def test_models_on_a_strip_have_its_level_where_it_is_low():
    """Whatever the cells, within half of a decibel of linear theory; contact is whole, to cells at its edge."""
    scene = RoughStrip(spectrum=self_affine(0.7, 1.0, 8.0), height=0.01, length=19.0, width=7.0, seed=1)
    (strip,) = scene.strips(12, 1e-5, 1)
    found, names = roll_by_all(strip), list(MODELS)
    level = dict(zip(names, found["level"].sum(axis=1), strict=True))
    for model in (JUDGE, COARSEST, READ):
        assert 10 * np.log10(level[model] / level[LINEAR]) == pytest.approx(0, abs=0.5)
    assert found["kept"] == pytest.approx(1, abs=0.05)
    assert dict(zip(names, found["work"], strict=True))[COARSEST] < found["work"][names.index(JUDGE)] / 10


# --- stiffness along a track ---

SMALL = stiffness.TrackStiffness(forces=(1.0,), length=16, strips=3, refined=3, tracks=5)


def whole_frame_in_contact(wheel, position):
    wheel.carry(position, 4 / 3)
    pressure = wheel.pressure()[2]
    body = bem3d.HalfSpace(shape=pressure.shape, spacing=wheel.track.spacing, modulus=1.0)
    return bem3d.solve_fixed_area(body, np.ones(pressure.shape, dtype=bool)).stiffness


@catches("stiffness of the frame for that of the contact", height=0.3).at(
    "validation.simulation.rolling_strip.tangent_stiffness", whole_frame_in_contact
)
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
    tracks = SMALL.tracks_of(1.0)
    tracks = replace(tracks, scene=replace(tracks.scene, height=1e-6))
    along = rolling_strip.roll_loaded_tracks(tracks)
    assert along["mean"] == pytest.approx(1, abs=2 / tracks.springs)
    assert np.sqrt(along["variance"]).max() < 1 / tracks.springs


def along(mean=1.0, deviation=0.1, rows=8):
    """Moments of tracks with little scatter."""
    scatter = 1 + 1e-4 * RNG.standard_normal(rows)
    return {"mean": mean * scatter, "variance": (mean * deviation) ** 2 * scatter}


def test_the_deviation_is_that_of_the_mean_variance():
    for quantity, value in ((stiffness.DEVIATION, 0.1), (stiffness.MEAN, 2.0)):
        assert math.exp(stiffness.moment(quantity, along(2.0, 0.1)).value) == pytest.approx(value, rel=1e-3)


@pytest.mark.parametrize(("springs", "status"), [(0.1, HOLDS), (0.15, CONTRADICTED)])
def test_the_claim_of_the_stiffness_follows_its_numbers(springs, status):
    bem = along()
    found = {(stiffness.WHEEL, 1.0): bem, (stiffness.REFINED, 1.0): bem}
    result = Outcomes(SMALL, found | {(stiffness.SPRINGS, 1.0): along(deviation=springs)})
    assert statuses(stiffness.STUDY.evidence(result)) == [status]
    (number,) = judged(stiffness.STUDY, result, stiffness.DEVIATION, stiffness.OVER)
    assert number.value == pytest.approx(100 * (springs / 0.1 - 1), abs=1)
