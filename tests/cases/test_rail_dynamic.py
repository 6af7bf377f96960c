"""The wheel that moves on a rail: its claims follow planted lifts, and a linear contact is read from its force."""

import math
from dataclasses import replace

import numpy as np
import pytest

from validation.analysis.evidence import ClaimStatus
from validation.cases.rail import rail_dynamic
from validation.cases.rail.rail_dynamic import FINE, STUDY, RailDynamic, RailDynamicResult
from validation.simulation.motion import simulate
from validation.simulation.wheel_on_rail import BEM

CASE, KEY = RailDynamic(strips=6, compared=6, width=0.5), (0.0, BEM, FINE)


def planted(factor):
    """Lifts at constant load that are those of linear theory, and in motion some factor of them."""

    def outcome(key, i):
        problem = CASE.problem(key, i)
        linear = problem.linear.change[:, 0] / problem.wheel.stiffness
        force = np.full(linear.size, CASE.load)
        force[0] += 1.0
        lifts = dict.fromkeys(("constant", "linear", "line"), linear)
        return {**lifts, "moving": factor(*key) * linear, "force": force}

    return RailDynamicResult(CASE, {key: [outcome(key, i) for i in range(n)] for key, n in CASE.keys.items()})


@pytest.mark.slow
@pytest.mark.parametrize(
    ("factor", "status", "limits"),
    [
        (lambda *key: 1.02, ClaimStatus.HOLDS, ""),
        (lambda *key: 1.5, ClaimStatus.CONTRADICTED, ""),
        (lambda offset, *_: 1 + 0.05 * offset, ClaimStatus.LIMITED, "dB over the curve up to 0"),
    ],
)
def test_the_claim_of_the_filter_follows_what_lifts_the_wheel_in_motion(factor, status, limits):
    claim = STUDY.evidence(planted(factor)).claims[0]
    assert claim.status is status
    assert status is not ClaimStatus.LIMITED or claim.limits == limits


def test_the_lift_is_read_from_the_force_of_a_linear_contact():
    """F (1/k - 1/(M omega^2)) of its steady motion, on a track without mean: to rounding."""
    problem = CASE.problem(KEY, 0)
    law, dt, steps = problem.linear, problem.time_step, problem.strip.shape[0]
    start = dict(zip(("approach", "velocity"), law.steady_state(dt), strict=True))
    motion = simulate(problem.wheel, law, time_step=dt, steps=steps, **start)
    lift = law.change[:, 0] / problem.wheel.stiffness
    found = rail_dynamic.over_dynamic_stiffness(problem, CASE.mass * motion.acceleration[:, 0])
    assert np.abs(found - (lift - lift.mean())).max() < 1e-6 * np.abs(lift).max()


def test_a_strip_ends_half_a_natural_period_after_whole_ones():
    problem = CASE.problem(KEY, 0)
    periods = problem.strip.length / CASE.speed * CASE.resonance
    assert periods == pytest.approx(CASE.periods + 0.5, abs=0.06)
    assert math.tau * CASE.resonance == pytest.approx(problem.wheel.eigenfrequency, rel=1e-9)
    assert replace(CASE, periods=9).problem(KEY, 0).strip.length > problem.strip.length


def test_a_track_too_short_for_its_bands_is_refused_before_the_first_solve():
    with pytest.raises(ValueError, match=r"periods must be so many that .* got 12, which are 1.15 m, for waves of"):
        RailDynamic(longest=0.5, periods=12)
