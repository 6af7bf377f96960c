"""The wheel that moves on a rail: its claim follows planted lifts, and a linear contact is read from its force."""

import math
from dataclasses import replace

import numpy as np
import pytest

from validation.analysis.evidence import ClaimStatus
from validation.railway.cases.rail_dynamic import AIRBORNE, FINE, STUDY, RailDynamic, RailDynamicResult, series
from validation.railway.problems.wheel_on_rail import hann, over_dynamic_stiffness
from validation.simulation.model_names import BEM
from validation.simulation.motion import simulate

CASE = RailDynamic(strips=6, compared=6, width=0.5)
KEY = (0.0, CASE.damping, BEM, FINE)


def planted(factor):
    """Lifts at constant load that are those of linear theory, and in motion some factor of them; a tenth in the air."""

    def outcome(key, i):
        problem = CASE.problem(key, i)
        lift = problem.linear.change[:, 0] / problem.wheel.stiffness
        seen = hann(lift.size) * (lift - lift.mean())
        same = dict.fromkeys(("constant", "linear", "line", "inferred"), seen)
        return {**same, "moving": factor(key[0]) * seen, "airborne": np.array(0.1 if key[1] else 0.3)}

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
        airborne.where["damping"]: [each.value for each in airborne.values]
        for airborne in series(result)
        if airborne.quantity == AIRBORNE
    }
    assert shares == {"none": pytest.approx([30]), "2 %": pytest.approx([10, 10])}


@pytest.mark.parametrize("damping", [0.0, 0.02])
def test_the_lift_is_read_from_the_force_of_a_linear_contact(damping):
    """F (1/k - 1/(M w^2 - i c w)) of its steady motion, on a track without mean: to rounding."""
    problem = CASE.problem((0.0, damping, BEM, FINE), 0)
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


def test_a_wheel_has_the_damping_that_it_is_compared_by():
    assert {key[1]: CASE.problem(key, 0).wheel.damping for key in CASE.keys} == {0.02: 0.02, 0.0: 0.0}
