"""Where time stepping and springs fail: verdicts of a small case, and planted changes that must be noticed."""

from functools import partial

import numpy as np
import pytest

from tests.cases import planted
from tests.cases.planted import changed, whole
from validation.analysis.evidence import Role, Verdict
from validation.cases.stability import wheel_stability as case
from validation.cases.stability.wheel_stability_study import CASE
from validation.simulation import free_vibration as free
from validation.simulation import spring_tracks as rough
from validation.simulation.contact_laws import HertzLaw
from validation.simulation.integrators import (
    EXPLICIT_EULER,
    INTEGRATORS,
    RUNGE_KUTTA,
    SYMPLECTIC_EULER,
    VELOCITY_VERLET,
)
from validation.simulation.motion import simulate
from validation.theory import wheel as wheel_theory

SMALL = case.WheelStability(
    steps=(0.02, 0.04, 0.5, 1.9, 2.1, 2.8, 2.9),
    turns=6,
    hertz_steps=(0.04, 0.08, 0.16),
    hertz_turns=4,
    highest=(1.5, 3.0),
    long_steps=40_000,
    long_highest=(1.06, 3.0),
    heights=(0.1, 1.0, 3.0),
    loads=(0.01, 1.0),
    lift_laps=1,
    wheels=4,
    spacing_heights=(1e-3, 0.3),
    spacing_tracks=1,
)
EULER, VERLET, KUTTA = EXPLICIT_EULER.name, VELOCITY_VERLET.name, RUNGE_KUTTA.name
BY_NAME = pytest.mark.parametrize("scheme", INTEGRATORS, ids=lambda scheme: scheme.name)
verdicts = partial(planted.verdicts, CASE)


@pytest.fixture(scope="module")
def result():
    return case.run(SMALL)


@pytest.mark.slow
def test_all_criteria_are_met(result):
    evidence = whole(CASE.evidence(result))
    assert {number.role for number in evidence.numbers} == {Role.CRITERION, Role.FINDING, Role.IDENTITY}
    flying = [outcome for problem, outcome in result["lift"] if problem.track.rms > 2 * free.WHEEL.approach]
    assert flying
    for outcome in flying:
        # very rough tracks leave room for their sums
        assert (outcome["airborne"] > 0).all() and (outcome["airborne"] < 1).all()
        assert outcome["failed"] == 0


@BY_NAME
def test_limits_are_those_of_the_eigenvalue(scheme):
    """Bounded just below the limit, growing just above it: to the first order in what lies between."""
    below, above = np.abs(free.amplification(scheme.name, scheme.limit + np.array([-1e-3, 1e-3])))
    if scheme.limit:
        assert below <= 1 + 1e-15
    assert above > 1 + 1e-7


def test_small_steps_turn_as_the_series_of_each_scheme_says():
    """RK4 loses x^6 / 72 of the energy a step, and its next term is x^8 / 576; Verlet turns by x + x^3 / 24."""
    x = 0.3
    loss = 1 - np.abs(free.amplification(KUTTA, x)) ** 2
    assert loss == pytest.approx(x**6 / 72 - x**8 / 576, rel=1e-9)
    assert np.angle(free.amplification(VERLET, x)) == pytest.approx(x + x**3 / 24, rel=x**4)


def test_vibrations_are_those_that_simulate_finds():
    law, d = HertzLaw(free.WHEEL), np.array([2 * free.WHEEL.approach])
    u, _ = free.march(VELOCITY_VERLET, law, 0.1, d, 50)
    step = 0.1 / free.WHEEL.eigenfrequency
    motion = simulate(free.WHEEL, law, time_step=step, steps=50, approach=d, velocity=np.zeros(1), path=True)
    np.testing.assert_array_equal(motion.path / free.WHEEL.approach, u)


def test_the_period_of_a_cosine():
    assert free.period(1 + np.cos(2 * np.pi * np.arange(300) / 37.3)) == pytest.approx(37.3, rel=1e-7)


def test_verlet_keeps_its_energy_to_the_fourth_order():
    """Halving the step divides what is left by sixteen."""
    law, d = HertzLaw(free.WHEEL), np.array([1.5 * free.WHEEL.approach])
    swings = [np.ptp(free.kept_energy(*free.march(VELOCITY_VERLET, law, x, d, round(30 / x)), x)) for x in (0.1, 0.05)]
    assert np.log2(swings[0] / swings[1]) == pytest.approx(4, abs=0.3)


@pytest.mark.slow
def test_a_wrong_limit_or_period_is_noticed(result, monkeypatch):
    """Every scheme growing from half its limit on; a period that is a thousandth longer."""
    amplification, period = free.amplification, wheel_theory.hertz_period
    monkeypatch.setattr(free, "amplification", lambda name, x: amplification(name, 2 * np.asarray(x)))
    assert verdicts(result, case.GROWTH) == {Verdict.DIFFER}
    monkeypatch.setattr(wheel_theory, "hertz_period", lambda highest: 1.001 * period(highest))
    assert verdicts(result, case.LIMIT) == {Verdict.DIFFER}


def exchanged(found, name, other):
    """The outcome of one scheme as that of another."""
    return {**found, name: found[other]}


def drifting(found):
    """1e-9 of the energy over a long run."""
    more = 1e-9 * np.linspace(0, 1, free.TENTHS)[:, np.newaxis]
    return {**found, VERLET: {**found[VERLET], "kept": found[VERLET]["kept"] + more}}


def first_of(name, more):
    """Something added to the first flight."""
    return lambda found: [(found[0][0], {**found[0][1], name: found[0][1][name] + more}), *found[1:]]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "change", "quantity", "model"),
    [
        (
            "linear",
            lambda found: exchanged(found, VERLET, SYMPLECTIC_EULER.name),
            "change of the energy in one period, over theory",
            VERLET,
        ),
        ("linear", lambda found: exchanged(found, VERLET, KUTTA), case.GROWTH, VERLET),
        ("long", drifting, case.DRIFT, VERLET),
        ("laps", lambda found: exchanged(found, VERLET, EULER), case.LAPS.format(case.FREE), VERLET),
        ("laps", lambda found: exchanged(found, EULER, VERLET), case.LAPS.format(case.FREE), EULER),
        ("lift", first_of("lowest", -2), case.LOWEST, "springs"),
        ("lift", first_of("mean", 1e-9), case.IMBALANCE, "springs"),
        ("refusals", lambda found: {**found, "a step of nothing": rough.refusal(lambda: None)}, case.REFUSED, ""),
    ],
)
def test_a_planted_change_is_noticed(result, name, change, quantity, model):
    assert verdicts(changed(result, {name: change(result[name])}), quantity, model) == {Verdict.DIFFER}


@pytest.mark.slow
def test_springs_taken_for_a_continuum_are_noticed(result, monkeypatch):
    exact, lowest = rough.linear_response, SMALL.spacing_heights[0]
    monkeypatch.setattr(rough, "linear_response", lambda track, stride: exact(track, 1))
    (problem,) = case.spacing_problems(SMALL, lowest)
    coarse = changed(result, spacing={**result["spacing"], lowest: [rough.coarsen(problem)]})
    assert verdicts(coarse, case.SUM) == {Verdict.DIFFER}


@pytest.mark.parametrize("seed", range(5))
def test_linear_spacing_holds_for_other_tracks(seed):
    """Within the five standard deviations of the error model; in them it is neither far too wide nor too narrow."""
    track = rough.RoughTrack(rms=1e-3 * free.WHEEL.approach, seed=seed, waves=9, per_wave=rough.FINE)
    found = rough.coarsen(track)
    carried = found["level"] > 0
    off = np.log(found["level"][carried] / found["linear"][carried]) / found["spread"][carried]
    assert 0.1 < np.sqrt(np.mean(off**2)) < 3
    assert np.abs(off).max() < 5


def test_the_ends_of_contact_leave_more_open_where_it_is_rougher():
    low, high = (rough.RoughTrack(rms=h * free.WHEEL.approach, seed=0, per_wave=rough.FINE) for h in (1e-3, 1e-2))
    assert rough.spread(high, 1) == pytest.approx(10 * rough.spread(low, 1), rel=0.05)


@BY_NAME
def test_a_refusal_says_by_how_much(scheme):
    """2.002 is not 2; and explicit Euler is not said to hold below it."""
    answer = rough.refusals()[f"simulate, {scheme.name}, a step just past its limit"]
    assert f"omega_eigen dt = {1.001 * max(scheme.limit, 2.0):.6g}" in answer
    assert ("grows at any step" in answer) == (scheme is EXPLICIT_EULER)
