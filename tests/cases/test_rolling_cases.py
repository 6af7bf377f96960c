"""The cases of rolling: what they draw and roll, and verdicts on planted changes."""

import math
from dataclasses import asdict, replace

import numpy as np
import pytest
from scipy import integrate

from validation.analysis.claims import STATUS_WORDS
from validation.analysis.evidence import ClaimStatus, Verdict, numbers_with
from validation.analysis.spectra import Bands
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling import input_spectrum as rolling_input
from validation.cases.rolling import ridges
from validation.cases.rolling.force_spectrum import LEVEL, LINEAR_3D, OVER, RMS_FORCE, SPRINGS, bem_over_linear
from validation.cases.rolling.force_spectrum_study import CASE
from validation.report.answers.first_screen import answered_questions
from validation.report.section import Section
from validation.simulation import rolling_strip
from validation.simulation.rolling_strip import (
    RoughStrip,
    Strip,
    Tracks,
    coherence,
    correlation,
    crop_to_reach,
    roll_strip,
    roll_tracks,
)
from validation.simulation.track_spectrum import INPUT_SPECTRA, PiecewisePowerLaw, TrackSpectrum, self_affine
from validation.theory.rolling import force_variance, linear_force

SMALL = rolling.ForceSpectrum(
    heights=(0.01,), last=6.0, lowest=0.5, length=32.0, width=12.0, cells=6, strips=4, refined=3, tracks=40, springs=12
)


@pytest.fixture(scope="module")
def rolled():
    return rolling.run(SMALL)


def rough(**changes):
    settings = {"spectrum": SMALL.spectrum, "height": 0.1, "length": 16.0, "width": 8.0, "seed": 3}
    return RoughStrip(**{**settings, **changes})


@pytest.mark.parametrize(
    "spectrum",
    [
        *rolling_input.RollingInput().spectra.values(),
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


def test_a_spectrum_needs_an_exponent_a_piece():
    with pytest.raises(ValueError, match="edges must be one more than exponents, got 2 and 2"):
        PiecewisePowerLaw(edges=(1.0, 2.0), exponents=(1.0, 2.0))


def test_a_strip_of_parts_of_cells_is_refused():
    with pytest.raises(ValueError, match=r"length must be a whole number of cells, got 50\.26"):
        rough(length=2 * math.pi).surface(8, 0)


def test_strips_are_the_same_surface_on_finer_cells():
    """The same waves: the coarse heights are those of the fine surface, half a fine cell between its centres."""
    coarse, fine = rough().surface(8, 1), rough().surface(24, 1)
    assert fine[1::3, 1::3] == pytest.approx(coarse, abs=1e-10)
    assert coarse.std() == pytest.approx(0.1, rel=1e-12)


def test_what_is_rolled_over_is_the_middle_of_the_surface():
    surface = rough().surface(8, 1)
    part = crop_to_reach(surface, 1 / 8)
    cut = (surface.shape[1] - part.shape[1]) / 2
    assert cut == int(cut) > 0
    np.testing.assert_array_equal(part, surface[:, int(cut) : -int(cut)])
    # no cell left out can overlap, not even the highest
    assert (part.shape[1] / 2 / 8) ** 2 / 2 >= 1 + surface.max()


@pytest.mark.slow
def test_a_low_strip_is_rolled_as_linear_theory_has_it():
    """Position by position, to the grid: a few per cent of the fluctuation with 12 cells to a radius."""
    outcome = roll_strip(Strip(scene=rough(height=1e-3), realisation=1, cells=12, tolerance=1e-8))
    force, linear = outcome["force"] - outcome["force"].mean(), outcome["linear"] - outcome["linear"].mean()
    assert np.abs(force - linear).max() <= 0.06 * linear.std()
    assert outcome["failed"] == 0


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


@pytest.mark.parametrize("name", INPUT_SPECTRA)
def test_inputs_are_ordered_along_the_track(name):
    """At q a = 4: Geike's most, then the line trace, then the rolling spectrum; below the band Geike's has nothing."""
    spectrum = self_affine(0.7)
    at = {one: TrackSpectrum(spectrum, one)(np.array([4.0, 0.5])) for one in INPUT_SPECTRA}
    assert at["geike"][0] > at["line"][0] > at["rolling"][0] > 0
    assert at["geike"][1] == 0 < at["rolling"][1] < at["line"][1]
    assert (TrackSpectrum(spectrum, name)(np.array([[4.0], [0.5]]))[:, 0] == at[name]).all()


def changed(result, **columns):
    """Boundary elements, on both grids, with other columns: functions of their outcome."""
    of_bem = {(name, h): result[name, h] for name in ("bem3d", "refined") for h in result.case.heights}
    new = {key: {**one, **{name: of(one) for name, of in columns.items()}} for key, one in of_bem.items()}
    return replace(result, found={**result.found, **new})


def louder(result, factor):
    """Boundary elements whose fluctuation is so many times as large."""
    return changed(result, level=lambda one: factor**2 * one["level"])


def of_linear_theory(result):
    return numbers_with(CASE.evidence(result).numbers, LEVEL, LINEAR_3D + OVER)


@pytest.mark.slow
def test_boundary_elements_agree_with_linear_theory(rolled):
    """Below the band and in its long waves, at h/d = 0.01, with error bars of coarse grids."""
    for number in of_linear_theory(rolled)[:2]:
        assert abs(number.difference) <= 0.3 + number.uncertainty


@pytest.mark.slow
def test_six_decibels_more_are_six_decibels_and_differ(rolled):
    more = louder(rolled, 10 ** (6 / 20))
    (before, finer), (after, still) = (bem_over_linear(result, 0.01) for result in (rolled, more))
    assert 10 / math.log(10) * (after.values - before.values) == pytest.approx(6, abs=1e-9)
    assert still.values == pytest.approx(finer.values, rel=1e-6)
    number = of_linear_theory(more)[0]
    assert number.verdict is Verdict.DIFFER
    assert not number.met


@pytest.mark.slow
def test_claims_of_rolling_follow_their_numbers(rolled):
    """Linear theory holds where boundary elements are linear theory, and is contradicted where they are 6 dB louder."""
    exact = changed(rolled, level=lambda one: one["linear level"])
    for result, status in ((exact, ClaimStatus.HOLDS), (louder(exact, 2.0), ClaimStatus.CONTRADICTED)):
        (claim,) = (claim for claim in CASE.evidence(result).claims if claim.claim.startswith("Linear theory in 3D"))
        assert claim.status is status
        assert claim.answer.startswith(STATUS_WORDS[status])
    geike = CASE.evidence(exact).claims[0]
    assert geike.claim == CASE.claim
    assert geike.status is ClaimStatus.CONTRADICTED


@pytest.mark.slow
@pytest.mark.parametrize(("factor", "verdict"), [(1.0, Verdict.AGREE), (1.2, Verdict.DIFFER)])
def test_the_rms_force_of_springs_is_judged_beside_boundary_elements(rolled, factor, verdict):
    """20 % more of the fluctuation of both grids is 20 % less of springs over them, beyond 10 %."""
    exact = changed(rolled, variance=lambda one: factor**2 * one["linear variance"])
    (number,) = numbers_with(CASE.evidence(exact).numbers, RMS_FORCE, LINEAR_3D + OVER)
    assert number.value == pytest.approx(-20 * math.log10(factor), abs=1e-9)
    assert number.verdict is verdict
    (springs,) = numbers_with(CASE.evidence(rolled).numbers, RMS_FORCE, SPRINGS + OVER)
    assert abs(springs.difference) <= 0.2 + springs.uncertainty


@pytest.mark.slow
def test_the_first_screen_finds_the_numbers_of_rolling(rolled):
    """Both of its questions, over h' a/d."""
    section = Section("rolling", CASE, "", asdict(SMALL), CASE.evidence(rolled))
    rows = {row.question.name: row for row in answered_questions([section])}
    slope = 0.01 * SMALL.spectrum.slope_along
    for name in ("rolling-rms", "rolling-spectrum"):
        assert rows[name].strip[1][0] == f"{slope:.2g}"
        assert rows[name].measured.endswith("H = 0.7")
    assert rows["rolling-spectrum"].word == "No"


@pytest.mark.slow
def test_a_strip_that_was_lost_counts_in_nothing(rolled):
    bem = {name: values.copy() for name, values in rolled["bem3d", 0.01].items()}
    for name, values in bem.items():
        values[(slice(None), 3) if name == "cross" else 3] = np.nan
    numbers = CASE.evidence(replace(rolled, found={**rolled.found, ("bem3d", 0.01): bem})).numbers
    assert np.isfinite([number.value for number in numbers]).all()


@pytest.mark.slow
def test_coherence_is_one_for_copies_and_small_for_strangers(rolled):
    outcome = rolled["bem3d", 0.01]
    copied = {
        **outcome,
        "level": 4 * outcome["linear level"],
        "cross": np.stack([2 * outcome["linear level"], 0 * outcome["linear level"]]),
    }
    assert coherence(copied) == pytest.approx(1)
    assert correlation(copied) == pytest.approx((1, 2))
    rng = np.random.default_rng(0)
    strange = rolling_strip.levels_beside_linear(*rng.normal(size=(2, 1, 4096)), 1.0, Bands((0.1, 3.0)))
    assert coherence(strange) < 0.01


@pytest.mark.slow
def test_ridges_agree_and_a_lost_factor_does_not(monkeypatch):
    case = ridges.RollingOverRidges(length=20, shortest=6.0, cells=(6, 8), springs=(8.5, 16.5))
    result, evidence = ridges.run(case), ridges.CASE.evidence
    assert all(number.met for number in evidence(result).numbers)
    halved = {key: response / 2 for key, response in result.found.items()}
    missed = [n for n in evidence(replace(result, found=halved)).numbers if not n.met]
    assert {n.model for n in missed} == {ridges.BEM, ridges.FILTER, ridges.FULL, ridges.SPRINGS}
    # the phase counts as much as the amplitude
    turned = {key: response * np.exp(0.3j) for key, response in result.found.items()}
    assert sum(not n.met for n in evidence(replace(result, found=turned)).numbers) >= 5


def test_linear_force_of_a_lone_wave_on_a_strip():
    """Any direction: 2 E* sin(k a) / k under the middle of the strip, between the cells of an even number of them."""
    nx, ny, dx = 32, 24, 0.25
    qx, qy = 2 * np.pi * 3 / (nx * dx), 2 * np.pi * 2 / (ny * dx)
    x, y = np.arange(nx) * dx, (np.arange(ny) - (ny - 1) / 2) * dx
    height = 1e-3 * np.cos(qx * x[:, np.newaxis] + qy * y + 0.3)
    k = math.hypot(qx, qy)
    force = linear_force(height, spacing=dx, radius=1.0, modulus=1.0, approach=1.0)
    assert force - 4 / 3 == pytest.approx(2 * math.sin(k) / k * 1e-3 * np.cos(qx * x + 0.3), abs=1e-12)
