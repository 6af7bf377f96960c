"""Stiffness models with known answers: right ones are judged right by range, wrong ones where they are wrong."""

from functools import cache, partial
from types import SimpleNamespace

import numpy as np
import pytest

from tests.judging import judged_points
from tests.judging.judged_points import INCONCLUSIVE, NO_RESULT, NOT_SERVED, OUTSIDE, WITHIN, of, verdicts
from tests.seeded import catches
from validation.judging.judgement import ranges_of
from validation.judging.kinds import stiffness
from validation.judging.kinds.judge import ModelAnswer
from validation.judging.kinds.references import Reference, reference_rows
from validation.judging.kinds.stiffness import JudgedPunch
from validation.judging.registry import offer
from validation.judging.worker import Called
from validation.simulation.rough_punch import PlateauSpectrum
from validation.theory.closed_forms import SQUARE_PUNCH

MEAN, DEVIATION = "mean stiffness", "deviation of the stiffness"
RISE = "rise with the load, at the least"


def series(load, side, modulus, roughness):
    return 1 / (0.49 * roughness.rms / load + 1 / (SQUARE_PUNCH * modulus * side))


judged = partial(judged_points.judged, "stiffness_model")
judged_surfaces = partial(judged_points.judged, "stiffness_of_surface")


@cache
def solved():
    """Fbar, mean and deviation of boundary elements by H, bandwidth and roll-off; constants where one is not known."""
    found = {}
    for quantity, column in ((MEAN, 0), (stiffness.ROLLED_OFF, 0), (DEVIATION, 1), (stiffness.BY_BAND, 1)):
        for row in reference_rows(quantity):
            one = JudgedPunch.at(row.where)
            of = found.setdefault((one.hurst, one.waves, one.roll_off), {})
            of.setdefault(one.force, [0.1, 0.3])[column] = row.value
    return {key: np.log([(force, *of[force]) for force in sorted(of)]).T for key, of in found.items()}


def as_known(load, side, modulus, roughness):
    """Mean and deviation of boundary elements, by what a model is given."""
    waves = round(roughness.q_max / roughness.q_min)
    roll_off = round(getattr(roughness, "q_roll_off", 0.0) * side / (2 * np.pi))
    force, mean, deviation = solved()[roughness.hurst, waves, roll_off]
    at = np.log(load / (modulus * roughness.rms * side))
    mean = modulus * side * np.exp(np.interp(at, force, mean))
    return mean, mean * np.exp(np.interp(at, force, deviation))


def test_an_interface_in_series_is_enough_for_heavy_loads_alone():
    points = judged(series)
    for hurst in sorted({p.where["H"] for p in points if p.quantity == MEAN}):
        ranges = [r for r in ranges_of(points) if r.quantity == MEAN and r.where == {"H": hurst}]
        assert (ranges[0].verdict, ranges[-1].verdict) == (OUTSIDE, WITHIN)
        assert ranges[0].start == 1e-3 and ranges[0].stop >= 0.1
        assert 0.2 < ranges[-1].start < 0.5 and ranges[-1].stop == 10
    assert verdicts(points, RISE) == {WITHIN}
    assert not verdicts(points, DEVIATION)


def test_with_e_for_e_star_a_law_is_nowhere_enough():
    """The modulus of steel on steel, over which E* is 0.55."""
    points = judged(lambda load, side, modulus, roughness: as_known(load, side, 0.55 * modulus, roughness)[0])
    assert verdicts(points, MEAN) == {OUTSIDE}


given = stiffness.JudgedPunch.arguments.fget


def under_twice_the_load(asked):
    return {**given(asked), "load": 2 * given(asked)["load"]}


@catches("a model asked under twice the load").at(
    "validation.judging.kinds.stiffness.JudgedPunch.arguments", property(under_twice_the_load)
)
def test_what_boundary_elements_have_agrees_and_what_is_twice_as_far_differs():
    points = judged(as_known)
    for quantity in (MEAN, DEVIATION, stiffness.ROLLED_OFF, stiffness.BY_BAND):
        assert OUTSIDE not in verdicts(points, quantity) and WITHIN in verdicts(points, quantity)
        assert all(p.difference == pytest.approx(0, abs=1e-6) for p in of(points, quantity))

    def twice(load, side, modulus, roughness):
        mean, deviation = as_known(load, side, modulus, roughness)
        return mean, 2 * deviation

    points = judged(twice)
    assert verdicts(points, MEAN) == verdicts(judged(as_known), MEAN)
    assert WITHIN not in verdicts(points, stiffness.BY_BAND) and OUTSIDE in verdicts(points, stiffness.BY_BAND)
    assert WITHIN not in {p.verdict for p in points if p.quantity == DEVIATION and p.reference > 0.02}


def without_the_error_of_the_sample(values, so_few, first_equal):
    return stiffness.Stiffness(ModelAnswer(np.mean(values)), ModelAnswer(np.std(values) / np.mean(values)))


@catches("realisations without the error of their sample").at(
    "validation.judging.kinds.stiffness.sampled", without_the_error_of_the_sample
)
@pytest.mark.slow
def test_realisations_have_their_mean_and_deviation_with_the_error_of_the_sample():
    def draws(load, side, modulus, roughness, rng):
        mean, deviation = as_known(load, side, modulus, roughness)
        return rng.normal(mean, deviation)

    points = [p for p in judged(draws, 0.3) if p.quantity in (MEAN, DEVIATION)]
    assert OUTSIDE not in verdicts(points, MEAN) and WITHIN in verdicts(points, MEAN)
    assert np.mean([abs(p.difference) <= p.error for p in points]) > 0.85
    assert all(p.reason == "100 realisations" for p in of(points, MEAN))


@pytest.mark.parametrize(("seconds", "count"), [(1e-3, 100), (0.02, 20), (2.0, 8)])
def test_realisations_are_of_one_of_three_numbers_and_equal_ones_have_no_deviation(seconds, count, monkeypatch):
    """A clock that runs three times as slow changes none of them."""
    for factor in (1, 3):
        monkeypatch.setattr(stiffness, "seconds_of", lambda model, punch, took=seconds * factor: took)
        points = judged(lambda load, side, modulus, roughness, rng: 1.5 * as_known(load, side, modulus, roughness)[0])
        assert verdicts(points, MEAN) == {INCONCLUSIVE} == verdicts(points, DEVIATION)
        equal = f"{count} equal realisations{'' if count == 100 else ', since a call takes long'}"
        equal = f"{equal}: rng is asked for and not used"
        assert {p.reason for p in of(points, MEAN)} == {equal}
        assert {p.reason for p in of(points, DEVIATION)} == {f"{equal}; no deviation is known"}
        assert all(np.isinf(p.error) and p.difference == pytest.approx(0.5, abs=1e-6) for p in of(points, MEAN))


def test_the_fastest_call_is_counted(monkeypatch):
    """The first one may import what it needs."""
    seconds = iter([5.0, 2.0, 3.0])
    clock = SimpleNamespace(now=0.0, perf_counter=lambda: clock.now)
    monkeypatch.setattr(stiffness, "time", clock)

    def mine(load, rng):
        clock.now += next(seconds)
        return load

    assert stiffness.seconds_of(Called(offer("stiffness_model", "mine", {}, mine)), JudgedPunch(0.7, 0.1)) == 2.0


@pytest.mark.parametrize(
    ("answer", "verdict", "reason"),
    [
        (lambda load: float("nan"), NO_RESULT, "returned NaN or infinity"),
        (lambda load: -1.0, NO_RESULT, "a stiffness of -1 N/m"),
        (lambda load: (1.0, -1.0), NO_RESULT, "a deviation of -1 N/m"),
        (lambda load: [][1], NO_RESULT, "raised IndexError: list index out of range"),
        (lambda load, rng: float("nan"), NO_RESULT, "returned NaN or infinity"),
        (lambda load, rng: (1.0, 0.1), NO_RESULT, "returned shape (2,), must be one number"),
    ],
)
def test_a_model_without_a_number_is_a_row_with_the_reason(answer, verdict, reason):
    points = judged(answer)
    assert {p.verdict for p in points if p.quantity == MEAN} == {verdict}
    assert all(p.reason.startswith(reason) for p in of(points, MEAN))


def test_a_load_that_is_refused_is_a_row_with_the_words_of_the_model():
    def heavy(load, side, modulus, roughness):
        if load < 0.1 * modulus * roughness.rms * side:
            raise ValueError("too light")
        return series(load, side, modulus, roughness)

    light = [p for p in judged(heavy) if p.quantity == MEAN and p.where["Fbar"] < 0.09]
    assert {(p.verdict, p.reason.partition(",")[0]) for p in light} == {(NOT_SERVED, "raised ValueError: too light")}


@catches("no load between those that are known", deep=0.3).at("validation.judging.kinds.stiffness.BETWEEN", 0)
@pytest.mark.parametrize("deep", [0.7, 0.3])
def test_a_stiffness_that_falls_between_loads_that_are_known_is_found(deep):
    """As it is at all of them, and less by that part between any two."""

    def dips(load, side, modulus, roughness):
        wave = np.sin(3 * np.pi * np.log10(load / (modulus * roughness.rms * side))) ** 2
        return (1 - deep * wave) * series(load, side, modulus, roughness)

    points, right = judged(dips), judged(series)
    assert [p.verdict for p in of(points, MEAN)] == [p.verdict for p in of(right, MEAN)]
    assert verdicts(right, RISE) == {WITHIN} and verdicts(points, RISE) == {OUTSIDE}
    assert min(p.difference for p in of(points, RISE)) == pytest.approx(-deep, abs=0.1)


@catches("the level of a power law for that of its plateau").at(
    "validation.judging.kinds.stiffness.PlateauRoughness._density", PlateauSpectrum._density
)
def test_a_plateau_is_given_with_its_own_rms_height():
    rough = JudgedPunch(0.7, 0.1, 64, 8).arguments["roughness"]
    q = np.geomspace(rough.q_min, rough.q_max, 200001)
    assert np.sqrt(2 * np.pi * np.trapezoid(q * rough.c2d(q), q)) == pytest.approx(rough.rms, rel=1e-6)
    assert np.sqrt(2 * np.trapezoid(rough.c1d(q), q)) == pytest.approx(rough.rms, rel=1e-6)
    assert rough.c2d(2 * rough.q_min) == rough.c2d(7.9 * rough.q_min)


FORCES = (0.01, 1.0)


def by_the_summit(height, spacing, modulus, load):
    """Of the highest summit alone, which scatters from surface to surface [N/m]."""
    return modulus * spacing * len(height) * (load / modulus) ** 0.5 / height.max()


@pytest.fixture
def summits(monkeypatch):
    """References by that law, on six surfaces."""
    rows = [
        Reference(
            {"H": 0.7, "surface": f"surface {i}", "Fbar": force}, value, 0.0, 0.01, quantity="stiffness of a surface"
        )
        for i in range(6)
        for height in [stiffness.SIDE * stiffness.roughness(0.7).surface(256, i)]
        for force in FORCES
        for load in [force * stiffness.MODULUS * stiffness.HEIGHT * stiffness.SIDE**2]
        for value in [by_the_summit(height, stiffness.SIDE / 256, 1.0, load / stiffness.MODULUS) / stiffness.SIDE]
    ]
    monkeypatch.setattr(stiffness, "reference_rows", lambda quantity: rows)


def test_surfaces_are_judged_one_by_one_and_in_their_mean_and_deviation(summits):
    points = judged_surfaces(by_the_summit)
    assert len(points) == 6 * 2 + 2 * 2
    assert {p.verdict for p in points} == {WITHIN}
    # both on the same surfaces: what they share leaves no error but that of the grid
    assert all(p.error == pytest.approx(0.01) for p in points)
    stiffer = judged_surfaces(
        lambda height, spacing, modulus, load: 1.3 * by_the_summit(height, spacing, modulus, load)
    )
    assert verdicts(stiffer, stiffness.OF_SURFACE) == verdicts(stiffer, MEAN) == {OUTSIDE}
    assert verdicts(stiffer, DEVIATION) == {WITHIN}


def test_a_law_without_the_surface_has_no_deviation(summits):
    mean = {
        force: np.mean([row.value for row in stiffness.reference_rows("") if row.where["Fbar"] == force])
        for force in FORCES
    }

    def blind(height, load):
        force = load / (stiffness.MODULUS * stiffness.HEIGHT * stiffness.SIDE**2)
        return mean[min(mean, key=lambda one: abs(one / force - 1))] * stiffness.MODULUS * stiffness.SIDE

    points = judged_surfaces(blind)
    assert OUTSIDE not in verdicts(points, MEAN)
    assert verdicts(points, DEVIATION) == {OUTSIDE}


def test_a_surface_turned_upside_down_is_another_one(summits):
    points = judged_surfaces(lambda height, spacing, modulus, load: by_the_summit(-height, spacing, modulus, load))
    assert OUTSIDE in verdicts(points, stiffness.OF_SURFACE)


def test_surfaces_that_there_is_no_time_for_are_left_open(summits, monkeypatch):
    monkeypatch.setattr(stiffness, "SECONDS", 0.0)
    points = judged_surfaces(by_the_summit)
    reasons = [p.reason for p in points if p.quantity == stiffness.OF_SURFACE and p.verdict == INCONCLUSIVE]
    assert reasons == ["not asked: 0 s are over"] * 12
