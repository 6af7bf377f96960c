"""The cases of rolling: what they draw and roll, and verdicts on planted changes."""

import math
from dataclasses import asdict, replace
from functools import partial

import numpy as np
import pytest
from scipy import integrate

from tests.cases.planted import changed, judged
from tests.seeded import catches, catches_root_of_two
from validation.analysis.claim_text import THREE_D_DIFFER, Direction
from validation.analysis.evidence import ClaimStatus, Verdict
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling import ridges
from validation.cases.rolling.force_spectrum import LINEAR_3D, OVER, RMS_LEVEL, of_bem
from validation.cases.rolling.force_spectrum_study import CASE
from validation.report.answers.first_screen import answered_questions
from validation.report.section import Section
from validation.simulation import rolling_strip
from validation.simulation.rolling_strip import RoughStrip, Tracks, crop_to_reach, level_1d, roll_tracks
from validation.simulation.track_spectrum import INPUT_SPECTRA, PiecewisePowerLaw, TrackSpectrum
from validation.theory.rolling import force_spectrum_1d, force_variance

SMALL = rolling.ForceSpectrum(
    heights=(0.01,), last=9.0, lowest=0.5, length=32.0, width=12.0, cells=6, strips=4, refined=3, tracks=40
)


@pytest.fixture(scope="module")
def rolled():
    return rolling.run(SMALL)


def rough(**changes):
    settings = {"spectrum": SMALL.spectrum, "height": 0.1, "length": 16.0, "width": 8.0, "seed": 3}
    return RoughStrip(**{**settings, **changes})


@catches_root_of_two(
    "h' of power laws",
    "validation.simulation.track_spectrum.slope_in_one_direction",
    spectrum=PiecewisePowerLaw(edges=(1.0, 3.0), exponents=(2.0,)),
)
@catches_root_of_two(
    "the gradient of power laws",
    "validation.simulation.track_spectrum.PiecewisePowerLaw.gradient",
    spectrum=PiecewisePowerLaw(edges=(1.0, 3.0), exponents=(2.0,)),
)
@catches_root_of_two(
    "h' a/d in the words of rolling",
    "validation.simulation.track_spectrum.PiecewisePowerLaw.slope_along",
    spectrum=PiecewisePowerLaw(edges=(1.0, 3.0), exponents=(2.0,)),
)
@pytest.mark.parametrize(
    "spectrum",
    [
        *rolling.ForceSpectrum().spectra.values(),
        PiecewisePowerLaw(edges=(1.0, 3.0), exponents=(2.0,)),
        PiecewisePowerLaw(edges=(0.1, 1.0, 2.0, 40.0), exponents=(0.0, 2.0, 3.4)),
    ],
)
def test_power_laws_have_unit_height_and_are_continuous(spectrum):
    pieces = list(zip(spectrum.edges, spectrum.edges[1:], strict=False))
    square = sum(integrate.quad(lambda q: 2 * np.pi * q * spectrum.c2d(q), *piece, epsrel=1e-12)[0] for piece in pieces)
    assert square == pytest.approx(1, rel=1e-9)
    gradient = sum(
        integrate.quad(lambda q: 2 * np.pi * q**3 * spectrum.c2d(q), *piece, epsrel=1e-12)[0] for piece in pieces
    )
    assert spectrum.gradient == pytest.approx(math.sqrt(gradient), rel=1e-9)
    assert spectrum.slope_along == pytest.approx(math.sqrt(gradient / 2), rel=1e-9)
    inner = np.array(spectrum.edges[1:-1])
    assert spectrum.c2d(inner * (1 - 1e-10)) == pytest.approx(spectrum.c2d(inner * (1 + 1e-10)), rel=1e-8)
    assert (spectrum.c2d([0.99 * spectrum.edges[0], 1.01 * spectrum.edges[-1]]) == 0).all()


def test_inputs_are_ordered_along_the_track():
    """At q a = 4: Geike's most, then the line trace, then the rolling spectrum; below the band Geike's has nothing."""
    found = (TrackSpectrum(SMALL.spectrum, name)(np.array([4.0, 0.9 * SMALL.first])) for name in INPUT_SPECTRA)
    at = dict(zip(INPUT_SPECTRA, found, strict=True))
    assert at["geike"][0] > at["line"][0] > at["rolling"][0] > 0
    assert at["geike"][1] == 0 < at["rolling"][1] < at["line"][1]


def test_strips_are_the_same_surface_on_finer_cells():
    """The same waves: the coarse heights are those of the fine surface, half a fine cell between its centres."""
    coarse, fine = rough().surface(8, 1), rough().surface(24, 1)
    assert fine[1::3, 1::3] == pytest.approx(coarse, abs=1e-10)
    assert coarse.std() == pytest.approx(0.1, rel=1e-12)


def test_tracks_have_the_variance_of_linear_theory():
    """Of Geike's spectrum: to the part of the band that a wave has, 2 pi / L, for a sum in place of the integral."""
    tracks = Tracks(
        scene=rough(height=1e-3, length=256.0, seed=5),
        input_spectrum="geike",
        realisations=5,
        springs=12,
        bands=SMALL.bands,
    )
    outcome = roll_tracks(tracks)
    exact = 1e-6 * force_variance(SMALL.spectrum.c2d, edges=SMALL.spectrum.edges, contact_radius=1.0, modulus=1.0)
    assert outcome["variance"].mean() == pytest.approx(exact / rolling_strip.HERTZ**2, rel=2 * np.pi / 256)
    assert outcome["level"].sum(axis=1).mean() * 2 <= outcome["variance"].mean() * (1 + 1e-9)


@catches("a band of all waves for the waves of a track, in the curve of the book").at(
    "validation.cases.rolling.force_spectrum.levels_on_track",
    lambda case, spectrum: level_1d(case.spectrum, "geike", case.bands),
)
def test_the_curve_on_a_track_is_that_of_its_waves_through_the_filter():
    """(14.12) on the waves that a drawn track has, beside (14.11) over the track itself."""
    tracks = replace(SMALL, tracks=2).tracks_of(1e-3, rolling.SPRINGS)
    curve = partial(force_spectrum_1d, contact_radius=1.0, modulus=1.0)
    book = 1e-6 * rolling.levels_on_track(SMALL, curve)
    for level in roll_tracks(tracks)["linear level"]:
        assert level == pytest.approx(book, rel=1e-6, abs=1e-20)


def test_what_is_rolled_over_is_the_middle_of_the_surface():
    surface = rough().surface(8, 1)
    part = crop_to_reach(surface, 1 / 8)
    cut = (surface.shape[1] - part.shape[1]) / 2
    assert cut == int(cut) > 0
    np.testing.assert_array_equal(part, surface[:, int(cut) : -int(cut)])
    # no cell left out can overlap, not even the highest
    assert (part.shape[1] / 2 / 8) ** 2 / 2 >= 1 + surface.max()


# --- evidence ---


def bem_with(result, **columns):
    """Boundary elements, on both grids, with other columns: functions of their outcome."""
    keys = [(name, h) for name in (rolling.BEM, rolling.REFINED) for h in result.case.heights]
    return changed(result, {key: result[key] | {n: of(result[key]) for n, of in columns.items()} for key in keys})


def at(result, quantity, model):
    """Over boundary elements."""
    return judged(CASE, result, quantity, model + OVER)


@pytest.mark.slow
def test_boundary_elements_agree_with_linear_theory_and_six_decibels_more_differ(rolled):
    """In octaves, at h/d = 0.01, with error bars of coarse grids."""
    (number,) = at(rolled, RMS_LEVEL, LINEAR_3D)
    assert number.value <= 0.3 + number.uncertainty
    louder = bem_with(rolled, level=lambda one: 10**0.6 * one["level"])
    (before, finer), (after, still) = (of_bem(result, 0.01) for result in (rolled, louder))
    assert 10 / math.log(10) * (after.values - before.values) == pytest.approx(6, abs=1e-9)
    assert still.values == pytest.approx(finer.values, rel=1e-6)
    (number,) = at(louder, RMS_LEVEL, LINEAR_3D)
    assert number.verdict is Verdict.OUTSIDE


@pytest.mark.slow
def test_springs_have_the_curve_of_the_book_and_three_dimensions_do_not(rolled):
    """And half of their force does not have it."""
    evidence = CASE.evidence(rolled)
    curve, three_d, equivalent, *_ = evidence.claims
    assert curve.status is ClaimStatus.SUPPORTED
    of_curve, of_three_d = (
        claim.outcome(judged.numbers) for claim, judged in zip(CASE.study.claims[:2], evidence.claims[:2], strict=True)
    )
    assert of_curve.tolerance == 1.0
    assert (three_d.status, of_three_d.direction) == (ClaimStatus.REFUTED, Direction.ABOVE)
    assert CASE.study.claims[1].no == THREE_D_DIFFER
    assert equivalent.status is ClaimStatus.SUPPORTED
    # the line trace, of which no claim is made, has not the levels of three dimensions
    assert any(n.model == rolling.INPUT_NAMES["line"] and n.verdict is Verdict.OUTSIDE for n in evidence.numbers)
    springs = rolled[rolling.SPRINGS, 0.01]
    halved = changed(rolled, {(rolling.SPRINGS, 0.01): springs | {"level": springs["level"] / 4}})
    assert CASE.evidence(halved).claims[0].status is ClaimStatus.REFUTED


@pytest.mark.slow
def test_the_first_screen_finds_the_numbers_of_rolling(rolled):
    """Both of its questions, over h' a/d."""
    section = Section("rolling", CASE, "", asdict(SMALL), CASE.evidence(rolled))
    rows = {row.question.name: row for row in answered_questions([section])}
    for name in ("rolling-rms", "rolling-spectrum"):
        assert rows[name].strip[1].place == f"{0.01 * SMALL.spectrum.slope_along:.2g}"
        assert rows[name].measured.endswith("H = 0.7")
    assert rows["rolling-spectrum"].word == "Outside tolerance"


@pytest.mark.slow
def test_a_strip_that_was_lost_counts_in_nothing(rolled):
    bem = {name: values.copy() for name, values in rolled[rolling.BEM, 0.01].items()}
    for values in bem.values():
        values[3] = np.nan
    assert np.isfinite([n.value for n in judged(CASE, changed(rolled, {(rolling.BEM, 0.01): bem}))]).all()


@pytest.mark.slow
def test_ridges_agree_and_a_lost_factor_does_not():
    result = ridges.run(ridges.RollingOverRidges(length=20, shortest=6.0, cells=(6, 8), springs=(8.5, 16.5)))
    # the phase counts as much as the amplitude
    responses = ({key: factor * r for key, r in result.by_key.items()} for factor in (1.0, 0.5, np.exp(0.3j)))
    whole, halved, turned = (
        [n.model for n in judged(ridges.CASE, changed(result, one)) if not n.met] for one in responses
    )
    assert whole == []
    assert set(halved) == {ridges.BEM, ridges.FILTER, ridges.FULL, ridges.SPRINGS}
    assert len(turned) >= 5
