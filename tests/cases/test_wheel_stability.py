"""Where time stepping and springs fail: verdicts of a small case, and planted changes that must be noticed."""

from functools import partial

import numpy as np
import pytest

from tests.cases import planted
from tests.cases.planted import changed, whole
from tests.seeded import catches
from validation.analysis.evidence import Role, Verdict
from validation.cases.stability import wheel_stability as case
from validation.simulation import free_vibration as free
from validation.simulation import integrators
from validation.simulation import spring_tracks as rough
from validation.simulation.contact_laws import HertzLaw
from validation.simulation.integrators import EXPLICIT_EULER, INTEGRATORS, RUNGE_KUTTA, VELOCITY_VERLET
from validation.simulation.motion import simulate

SMALL = case.WheelStability(
    steps=(0.02, 0.04, 0.5, 1.9, 2.1, 2.8, 2.9), long_steps=40_000, highest=(1.06, 3.0), heights=(1e-3, 0.3)
)
EULER, VERLET, KUTTA = EXPLICIT_EULER.name, VELOCITY_VERLET.name, RUNGE_KUTTA.name
BY_NAME = pytest.mark.parametrize("scheme", INTEGRATORS, ids=lambda scheme: scheme.name)
verdicts = partial(planted.verdicts, case.CASE)


@pytest.fixture(scope="module")
def result():
    return case.run(SMALL)


@pytest.mark.slow
def test_all_criteria_are_met(result):
    evidence = whole(case.CASE.evidence(result))
    assert {number.role for number in evidence.numbers} == {Role.CRITERION, Role.FINDING}


amplification = free.amplification


@catches("half of the longest step", scheme=integrators.VELOCITY_VERLET).at(
    "validation.simulation.free_vibration.amplification", lambda scheme, x: amplification(scheme, 2 * np.asarray(x))
)
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


@BY_NAME
def test_small_steps_grow_turn_and_change_the_energy_as_the_eigenvalue_of_one_step_says(scheme):
    """But for extremes that lie between steps, (omega dt)^2, and for Runge-Kutta rounding of a small change."""
    x = np.array([0.02, 0.04])
    found = free.vibrate(free.Vibrations(scheme=scheme.name, steps=(0.02, 0.04), natural_periods=6))
    factor = free.amplification(scheme.name, x)
    assert found["growth"] == pytest.approx(np.abs(factor), rel=1e-9)
    assert found["angle"] == pytest.approx(np.angle(factor), rel=1e-9)
    assert found["change"] == pytest.approx(free.first_period(scheme.name, x), rel=10 * x[1] ** 2)


@pytest.mark.parametrize("height", [1.0, 3.0])
def test_wheels_that_lift_off_are_pushed_alone_and_keep_the_balance_of_momentum(height):
    """F T - F_N T = M (v_0 - v_end), in contact and in the air, but for rounding of the highest force."""
    track = rough.RoughTrack(rms=height * free.WHEEL.approach, seed=144)
    found = rough.lift_off(rough.LiftOff(track=track, wheels=4))
    assert (found["airborne"] > 0).any() and (found["airborne"] < 1).all()
    assert (found["lowest"] > -1e-15).all() and np.abs(found["imbalance"]).max() < 1e-10
    # linear theory pulls harder than the load where wheels lift off
    assert (found["pull"] > 1).all()


def test_verlet_keeps_its_energy_to_the_fourth_order():
    """Halving the step divides what is left by sixteen."""
    law, d = HertzLaw(free.WHEEL), np.array([1.5 * free.WHEEL.approach])
    swings = [np.ptp(free.kept_energy(*free.march(VELOCITY_VERLET, law, x, d, round(30 / x)), x)) for x in (0.1, 0.05)]
    assert np.log2(swings[0] / swings[1]) == pytest.approx(4, abs=0.3)


def exchanged(found, name, other):
    """The outcome of one scheme as that of another."""
    return {**found, name: found[other]}


def drifting(found):
    """1e-9 of the energy over a long run."""
    more = 1e-9 * np.linspace(0, 1, free.TENTHS)[:, np.newaxis]
    return {**found, VERLET: {**found[VERLET], "kept": found[VERLET]["kept"] + more}}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "change", "quantity", "model"),
    [
        ("linear", lambda found: exchanged(found, VERLET, KUTTA), case.GROWTH, VERLET),
        ("long", drifting, case.DRIFT, VERLET),
        ("refusals", lambda found: {**found, "a step of nothing": rough.refusal(lambda: None)}, case.REFUSED, ""),
    ],
)
def test_a_planted_change_is_noticed(result, name, change, quantity, model):
    assert verdicts(changed(result, {name: change(result[name])}), quantity, model) == {Verdict.OUTSIDE}


linear_response = rough.linear_response


@catches("coarse springs taken for a continuum", seed=0).at(
    "validation.simulation.spring_tracks.linear_response", lambda track, stride: linear_response(track, 1)
)
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
