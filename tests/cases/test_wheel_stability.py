"""Where time stepping and springs fail: verdicts of a small case, and planted changes that must be noticed."""

from dataclasses import replace

import numpy as np
import pytest

from validation.analysis.evidence import Role, Verdict, numbers_with
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


@pytest.fixture(scope="module")
def result():
    return case.run(SMALL)


def changed(result, **found):
    return replace(result, found={**result.found, **found})


def verdicts(result, quantity, model=None, **where):
    found = numbers_with(CASE.evidence(result).numbers, quantity, model, **where)
    assert found
    return [number.verdict for number in found]


@pytest.mark.slow
def test_all_criteria_are_met(result):
    evidence = CASE.evidence(result)
    assert [n.sentence for n in evidence.numbers if not n.met] == []
    assert evidence.unconverged == ()
    (spaced,) = (claim for claim in evidence.claims if "quarter of the shortest wave" in claim.claim)
    assert spaced.claim.startswith("On low roughness")
    assert f"at h/d = {SMALL.spacing_heights[0]:g}" in spaced.answer
    assert evidence.claims[1].claim == f"Velocity Verlet keeps the energy over {SMALL.long_steps} steps."


@pytest.mark.parametrize("scheme", INTEGRATORS, ids=lambda scheme: scheme.name)
def test_limits_are_those_of_the_eigenvalue(scheme):
    """Bounded just below the limit, growing just above it: to the first order in what lies between."""
    below, above = np.abs(free.amplification(scheme.name, scheme.limit + np.array([-1e-3, 1e-3])))
    if scheme.limit:
        assert below <= 1 + 1e-15
    assert above > 1 + 1e-7


def test_small_steps_turn_as_the_series_of_each_scheme_says():
    """RK4 loses x^6 / 72 of the energy a step, and its next term is x^8 / 576; Verlet turns by x + x^3 / 24."""
    x = 0.3
    loss = 1 - np.abs(free.amplification(RUNGE_KUTTA.name, x)) ** 2
    assert loss == pytest.approx(x**6 / 72 - x**8 / 576, rel=1e-9)
    assert np.angle(free.amplification(VELOCITY_VERLET.name, x)) == pytest.approx(x + x**3 / 24, rel=x**4)


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
def test_swapped_integrators_are_noticed(result):
    linear = dict(result["linear"])
    names = VELOCITY_VERLET.name, SYMPLECTIC_EULER.name
    linear[names[0]], linear[names[1]] = linear[names[1]], linear[names[0]]
    assert Verdict.DIFFER in verdicts(changed(result, linear=linear), "change of the energy in one period, over theory")
    linear[names[0]] = result["linear"][RUNGE_KUTTA.name]
    assert Verdict.DIFFER in verdicts(changed(result, linear=linear), case.GROWTH)


@pytest.mark.slow
def test_a_wrong_limit_is_noticed(result, monkeypatch):
    """Every scheme growing from half its limit on."""
    exact = free.amplification
    monkeypatch.setattr(free, "amplification", lambda name, x: exact(name, 2 * np.asarray(x)))
    assert set(verdicts(result, case.GROWTH)) == {Verdict.DIFFER}


@pytest.mark.slow
def test_a_wrong_period_is_noticed(result, monkeypatch):
    exact = wheel_theory.hertz_period
    monkeypatch.setattr(wheel_theory, "hertz_period", lambda highest: 1.001 * exact(highest))
    assert set(verdicts(result, "period over 2 pi / omega, extrapolated to dt = 0")) == {Verdict.DIFFER}


@pytest.mark.slow
def test_a_drift_is_noticed(result):
    found = result["long"][VELOCITY_VERLET.name]
    drifting = found["kept"] + 1e-9 * np.linspace(0, 1, free.TENTHS)[:, np.newaxis]
    long = {**result["long"], VELOCITY_VERLET.name: {**found, "kept": drifting}}
    assert verdicts(changed(result, long=long), "drift of the conserved energy") == [Verdict.DIFFER]


@pytest.mark.slow
def test_explicit_euler_in_place_of_verlet_is_noticed(result):
    growth = "ln(growth of the energy of the free vibration), last tenth over first"
    laps = {**result["laps"], VELOCITY_VERLET.name: result["laps"][EXPLICIT_EULER.name]}
    assert verdicts(changed(result, laps=laps), growth, VELOCITY_VERLET.name) == [Verdict.DIFFER]
    laps = {**result["laps"], EXPLICIT_EULER.name: result["laps"][VELOCITY_VERLET.name]}
    assert verdicts(changed(result, laps=laps), growth, EXPLICIT_EULER.name) == [Verdict.DIFFER]


@pytest.mark.slow
def test_springs_that_pull_and_lost_momentum_are_noticed(result):
    (problem, found), *others = result["lift"]
    pulling = changed(result, lift=[(problem, {**found, "lowest": found["lowest"] - 2}), *others])
    assert verdicts(pulling, "lowest force over F_N, if negative") == [Verdict.DIFFER]
    heavy = changed(result, lift=[(problem, {**found, "mean": found["mean"] + 1e-9}), *others])
    momentum = "imbalance of impulse and momentum over F_N T, largest of all loads and heights"
    assert verdicts(heavy, momentum) == [Verdict.DIFFER]


@pytest.mark.slow
def test_springs_taken_for_a_continuum_are_noticed(result, monkeypatch):
    exact = rough.linear_response
    monkeypatch.setattr(rough, "linear_response", lambda track, stride: exact(track, 1))
    lowest = SMALL.spacing_heights[0]
    (problem,) = case.spacing_problems(SMALL, lowest)
    spacing = {**result["spacing"], lowest: [rough.coarsen(problem)]}
    numbers = CASE.evidence(changed(result, spacing=spacing)).numbers
    (number,) = [n for n in numbers if n.quantity.startswith("level of the last one-third octave over the sum")]
    assert number.verdict is Verdict.DIFFER


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


@pytest.mark.parametrize("scheme", INTEGRATORS, ids=lambda scheme: scheme.name)
def test_a_refusal_says_by_how_much(scheme):
    """2.002 is not 2; and explicit Euler is not said to hold below it."""
    answer = rough.refusals()[f"simulate, {scheme.name}, a step just past its limit"]
    assert f"omega_eigen dt = {1.001 * max(scheme.limit, 2.0):.6g}" in answer
    assert ("grows at any step" in answer) == (scheme is EXPLICIT_EULER)


@pytest.mark.slow
def test_what_was_not_refused_is_noticed(result):
    done = {**result["refusals"], "a step of nothing": rough.refusal(lambda: None)}
    assert verdicts(changed(result, refusals=done), case.REFUSED) == [Verdict.DIFFER]


@pytest.mark.slow
def test_very_rough_tracks_leave_room_for_their_sums(result):
    found = [outcome for problem, outcome in result["lift"] if problem.track.rms > 2 * free.WHEEL.approach]
    assert found
    for outcome in found:
        assert (outcome["airborne"] > 0).all() and (outcome["airborne"] < 1).all()
        assert outcome["failed"] == 0


@pytest.mark.slow
def test_findings_and_criteria_are_told_apart(result):
    roles = {number.role for number in CASE.evidence(result).numbers}
    assert roles == {Role.CRITERION, Role.FINDING, Role.IDENTITY}
