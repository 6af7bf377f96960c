"""The linear wheel with a dashpot, against its equation of motion solved wave by wave, and its limits."""

import numpy as np
import pytest

from tests.seeded import catches
from validation.theory import rolling as wheel

OMEGA = np.array([0.3, 0.9, 1.0, 1.3, 7.0]) * 40.0
K, M, ZETA = 8000.0, 5.0, 0.07
"""omega_0 = 40, c = 2 zeta sqrt(k M) = 28."""


def solved(omega):
    """d of M d'' + 28 d' + k d = -cos(omega t), by the two real equations of its cosine and its sine."""
    matrix = np.array([[K - M * omega**2, 28.0 * omega], [-28.0 * omega, K - M * omega**2]])
    cosine, sine = np.linalg.solve(matrix, [-1.0, 0.0])
    return cosine - 1j * sine


def test_the_dynamic_stiffness_is_that_of_the_equation_of_motion():
    found = wheel.dynamic_stiffness(OMEGA, stiffness=K, mass=M, damping=ZETA)
    assert -1 / found == pytest.approx(np.array([solved(w) for w in OMEGA]), rel=1e-12)


def damped_wheel_alone(omega, **given):
    """M^2 times what the acceleration has."""
    return wheel.acceleration_over_force(omega, mass=1.0, **given)


@catches("a dashpot without its own force on the wheel").at(
    "validation.theory.rolling.contact_force_over_force", damped_wheel_alone
)
def test_acceleration_and_force_over_the_force_at_a_fixed_approach():
    d = np.array([solved(w) for w in OMEGA])
    given = {"eigenfrequency": 40.0, "damping": ZETA}
    found = wheel.acceleration_over_force(OMEGA, mass=M, **given)
    assert found == pytest.approx(np.abs(OMEGA**2 * d) ** 2, rel=1e-12)
    assert found[2] == pytest.approx(1 / (2 * ZETA * M) ** 2, rel=1e-12)
    assert wheel.contact_force_over_force(OMEGA, **given) == pytest.approx(np.abs(1 + K * d) ** 2, rel=1e-12)


def test_without_damping_it_is_the_wheel_without_a_dashpot():
    given = {"eigenfrequency": 40.0, "mass": M}
    apart = OMEGA[[0, 1, 3, 4]]
    found = wheel.acceleration_over_force(apart, **given)
    assert found == pytest.approx(1 / (M * (1 - (40.0 / apart) ** 2)) ** 2, rel=1e-12)


def test_in_steps_it_is_the_central_difference():
    """Of exp(i w t): (e - 2 + 1/e) / dt^2 and (e - 1/e) / (2 dt), e = exp(i w dt)."""
    dt = 0.02
    turn = np.exp(1j * OMEGA * dt)
    expected = K + M * (turn - 2 + 1 / turn) / dt**2 + 28.0 * (turn - 1 / turn) / (2 * dt)
    found = wheel.dynamic_stiffness(OMEGA, stiffness=K, mass=M, damping=ZETA, time_step=dt)
    assert found == pytest.approx(expected, rel=1e-11)
