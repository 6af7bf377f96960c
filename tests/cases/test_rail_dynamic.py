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

CASE = RailDynamic(strips=6, compared=6, width=0.5)


def planted(moving=lambda key, lift: lift, scatter=0.0):
    """Lifts at constant load that are those of linear theory, and in motion what is planted."""
    rng = np.random.default_rng(0)

    def outcome(key, i):
        problem = CASE.problem(key, i)
        linear = problem.linear.change[:, 0] / problem.wheel.stiffness
        still = linear * (1 + scatter * rng.standard_normal())
        force = np.full(linear.size, CASE.load)
        force[0] += 1.0
        return {"constant": still, "moving": moving(key, still), "linear": linear, "line": linear, "force": force}

    return RailDynamicResult(CASE, {key: [outcome(key, i) for i in range(n)] for key, n in CASE.keys.items()})


@pytest.mark.slow
@pytest.mark.parametrize(
    ("moving", "status", "limits"),
    [
        (lambda key, lift: 1.02 * lift, ClaimStatus.HOLDS, ""),
        (lambda key, lift: 1.5 * lift, ClaimStatus.CONTRADICTED, ""),
        (lambda key, lift: (1 + 0.05 * key[0]) * lift, ClaimStatus.LIMITED, "dB over the curve up to 0"),
    ],
)
def test_the_claim_of_the_filter_follows_what_lifts_the_wheel_in_motion(moving, status, limits):
    claim = STUDY.evidence(planted(moving)).claims[0]
    assert claim.status is status
    assert (claim.limits if status is ClaimStatus.LIMITED else "") == limits


def test_the_lift_is_read_from_the_force_of_a_linear_contact():
    """F (1/k - 1/(M omega^2)) of its steady motion, on a track without mean: to rounding."""
    key = 0.0, BEM, FINE
    problem = CASE.problem(key, 0)
    law = problem.linear
    approach, velocity = law.steady_state(problem.time_step)
    steps = problem.strip.shape[0]
    motion = simulate(
        problem.wheel, law, time_step=problem.time_step, steps=steps, approach=approach, velocity=velocity
    )
    force = CASE.mass * motion.acceleration[:, 0]
    lift = law.change[:, 0] / problem.wheel.stiffness
    found = rail_dynamic.over_dynamic_stiffness(problem, force)
    assert np.abs(found - (lift - lift.mean())).max() < 1e-6 * np.abs(lift).max()


def test_a_strip_ends_half_a_natural_period_after_whole_ones():
    problem = CASE.problem((0.0, BEM, FINE), 0)
    periods = problem.strip.length / CASE.speed * CASE.resonance
    assert periods == pytest.approx(CASE.periods + 0.5, abs=0.06)
    assert math.tau * CASE.resonance == pytest.approx(problem.wheel.eigenfrequency, rel=1e-9)
    assert replace(CASE, periods=9).problem((0.0, BEM, FINE), 0).strip.length > problem.strip.length


def test_a_track_too_short_for_its_bands_is_refused_before_the_first_solve():
    with pytest.raises(ValueError, match=r"periods must be so many that .* got 12, which are 1.15 m, for waves of"):
        RailDynamic(longest=0.5, periods=12)
