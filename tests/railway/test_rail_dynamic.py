"""The wheel that moves on a rail: its claim follows planted lifts, and a linear contact is read from its force."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.seeded import catches
from validation.analysis.evidence import ClaimStatus
from validation.railway.cases.rail_dynamic import (
    AIRBORNE,
    BEAM,
    FILTERED,
    FINE,
    RAIL,
    RAIL_60,
    RIGID,
    STUDY,
    RailDynamic,
    RailDynamicResult,
    series,
)
from validation.railway.problems import wheel_on_rail
from validation.railway.problems.wheel_on_rail import (
    FilteredHertzLaw,
    WheelOnRail,
    hann,
    over_dynamic_stiffness,
    while_in_contact,
)
from validation.simulation.model_names import BEM, SPRINGS_THAT_READ
from validation.simulation.motion import simulate

CASE = RailDynamic(strips=6, compared=6, width=0.5)
KEY = (0.0, RIGID, BEM, FINE)
TRACKS = ("constant", "linear", "line", "inferred", "force", "filtered")


def planted(factor):
    """Lifts at constant load that are those of linear theory, and in motion some factor of them; a tenth in the air."""

    def outcome(key, i):
        problem = CASE.problem(key, i)
        lift = problem.linear.change[:, 0] / problem.wheel.stiffness
        seen = hann(lift.size) * (lift - lift.mean())
        shares = {"airborne": np.array(0.1 if key[1] == RIGID else 0.0), "airborne_filtered": np.array(0.2)}
        return {**dict.fromkeys(TRACKS, seen), "moving": factor(key[0]) * seen, **shares}

    return RailDynamicResult(CASE, {key: [outcome(key, i) for i in range(n)] for key, n in CASE.keys.items()})


@pytest.mark.slow
@pytest.mark.parametrize(
    ("factor", "status", "only"),
    [
        (lambda offset: 1.02, ClaimStatus.SUPPORTED, False),
        (lambda offset: 1.5, ClaimStatus.REFUTED, False),
        (lambda offset: 1 + 0.05 * offset, ClaimStatus.REFUTED, True),
    ],
)
def test_the_claim_of_the_filter_follows_what_lifts_the_wheel_in_motion(factor, status, only):
    result = planted(factor)
    claim = STUDY.evidence(result).claims[0]
    assert claim.status is status
    assert STUDY.claims[0].outcome(claim.numbers).only_within == ((0.0,) if only else ())
    shares = {
        (airborne.where[RAIL], airborne.model): [each.value for each in airborne.values]
        for airborne in series(result)
        if airborne.quantity == AIRBORNE
    }
    assert shares == {
        (RIGID, BEM): pytest.approx([10, 10]),
        (BEAM, BEM): pytest.approx([0, 0]),
        **dict.fromkeys(((RIGID, FILTERED), (BEAM, FILTERED)), pytest.approx([20, 20])),
    }


class FilterHolds(WheelOnRail):
    """The smooth wheel over the roughness that is filtered at constant load, by springs that read the surface."""

    def law(self):
        return FilteredHertzLaw(self.wheel, wheel_on_rail.at_constant_load(self))


def of_the_filter(key, i):
    problem = CASE.problem((*key[:2], SPRINGS_THAT_READ, key[3]), i)
    fields = {name: getattr(problem, name) for name in problem.__dataclass_fields__}
    return wheel_on_rail.roll_and_move(FilterHolds(**fields))


@pytest.mark.slow
@catches("the height of a flight for what lifts the wheel").at(
    "validation.railway.problems.wheel_on_rail.lift",
    lambda wheel, force, approach: wheel.approach * (np.maximum(force, 0.0) / wheel.load) ** (2 / 3) - approach,
)
@catches("the roughness of another place in the contact").at(
    "validation.railway.problems.wheel_on_rail.FilteredHertzLaw.force",
    lambda law, place, approach: law.hertz.force(place, approach + law.lift[(place + 3) % law.lift.size]),
)
def test_a_wheel_for_which_the_filter_holds_exactly_is_judged_so_though_it_flies():
    """At +5 and +10 dB, with flights of a tenth of the time and more: the ratios are one to rounding."""
    keys = {key: [of_the_filter(key, i) for i in range(3)] for key in CASE.keys if key[1] == RIGID and key[2] == BEM}
    result = RailDynamicResult(CASE, keys)
    assert np.mean([float(outcome["airborne"]) for outcome in keys[CASE.offsets[-1], RIGID, BEM, FINE]]) > 0.1
    for offset in CASE.offsets:
        for track, other in (("moving", "constant"), ("force", "filtered")):
            ratio = result.over((offset, RIGID), (BEM, track), (BEM, other))
            assert np.abs(ratio.values).max() < 1e-9


def test_a_lift_in_motion_that_is_a_factor_of_the_constant_one_has_this_factor_between_flights():
    rng = np.random.default_rng(2)
    constant, flies = rng.standard_normal(4000), np.arange(4000) % 40 < 12
    seen = while_in_contact(np.where(flies, np.nan, 1.5 * constant + 3), constant)
    gain = float(seen @ constant / (constant @ constant))
    assert gain == pytest.approx(1.5, abs=0.02)
    assert np.array_equal(while_in_contact(constant + 0.0, constant), constant)
    assert np.isnan(while_in_contact(np.full(5, np.nan), np.ones(5))).all()


@pytest.mark.parametrize("rail", [None, RAIL_60])
@pytest.mark.parametrize("damping", [0.0, 0.02])
def test_the_lift_is_read_from_the_force_of_a_linear_contact(damping, rail):
    """F (1/k - 1/(M w^2 - i c w) + ...) of its steady motion, on a track without mean: to rounding."""
    problem = replace(CASE.problem(KEY, 0), damping=damping, rail=rail)
    law, dt, steps = problem.linear, problem.time_step, problem.strip.shape[0]
    start = dict(zip(("approach", "velocity"), law.steady_state(dt), strict=True))
    motion = simulate(problem.wheel, law, time_step=dt, steps=steps, path=True, **start)
    lift = law.change[:, 0] / problem.wheel.stiffness
    inferred = over_dynamic_stiffness(problem, motion.force[:, 0] - problem.wheel.load)
    assert np.abs(inferred - (lift - lift.mean())).max() < 1e-6 * np.abs(lift).max()


def test_a_strip_ends_half_a_natural_period_after_whole_ones():
    problem = CASE.problem(KEY, 0)
    periods = problem.strip.length / CASE.speed * CASE.resonance
    assert periods == pytest.approx(CASE.periods + 0.5, abs=0.06)
    assert math.tau * CASE.resonance == pytest.approx(problem.wheel.eigenfrequency, rel=1e-9)
    assert replace(CASE, periods=9).problem(KEY, 0).strip.length > problem.strip.length


def test_a_rigid_rail_has_the_dashpot_and_the_beam_has_none():
    wheels = {key[1]: CASE.problem(key, 0).wheel for key in CASE.keys}
    assert {name: (wheel.damping, wheel.rail) for name, wheel in wheels.items()} == {
        RIGID: (0.02, None),
        BEAM: (0.0, RAIL_60),
    }
