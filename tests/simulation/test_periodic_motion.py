"""Motions that repeat themselves, and spectra of records: what leaks, and what does not."""

import math

import numpy as np
import pytest

from tests.simulation.wheels import ULP, WHEEL, drift, quantum, springs_law, track
from validation.analysis.spectra import waves
from validation.simulation.contact_laws import LinearLaw
from validation.simulation.motion import natural_periods, periodic_motion, simulate
from validation.theory import wheel as wheel_theory


def test_the_periodic_motion_of_a_linear_contact_is_its_steady_state():
    """Shooting is exact in one round for a linear contact, but for its derivative by differences: 1e-16 / 1e-6."""
    change, dt = track(120, 3, 0.4), 0.08
    law = LinearLaw(WHEEL, change)
    start = np.array([1.3, 0.8, 1.0]), np.array([0.2, -0.3, 0.0])
    d, v, left = periodic_motion(
        WHEEL, lambda n: LinearLaw(WHEEL, np.tile(change, (1, n))), time_step=dt, steps=120, start=start, tolerance=0.0
    )
    expected = law.steady_state(dt)
    # differences of the state are worth as much, as far as a turn and half of the resonance keeps them apart
    gain = 1 / (2 * abs(math.sin(0.5 * 120 * 2 * math.asin(dt / 2))))
    rounding = 64 * ULP * 120 * dt * gain
    assert left.max() <= rounding
    assert np.abs(d - expected[0]).max() <= 4 * rounding * gain
    assert np.abs(v - expected[1]).max() <= 4 * rounding * gain
    motion = simulate(WHEEL, law, time_step=dt, steps=120, approach=d, velocity=v)
    assert np.abs(motion.jump).max() <= 8 * rounding * gain


@pytest.mark.parametrize(("rms", "rounds"), [(0.005, 6), (0.02, 6), (0.1, 3)])
def test_a_motion_on_springs_repeats_itself_within_what_is_left(rms, rounds):
    """What is left is what a round changes, to the last bit; each further round leaves a part of it."""
    height, dt, points = track(300, 3, rms), 0.035, 300
    assert natural_periods(WHEEL, 300 / 12.5, 1 / (12.5 * dt)) == pytest.approx(points * dt / (2 * np.pi))

    def law(n):
        return springs_law(np.tile(height, (1, n)), 12.5)

    start = LinearLaw(WHEEL, 0 * height).steady_state(dt)
    settings = {"time_step": dt, "steps": points}
    d, v, left = periodic_motion(WHEEL, law, **settings, start=start, rounds=rounds, tolerance=0.0)
    motion = simulate(WHEEL, law(1), **settings, approach=d, velocity=v)
    change = np.maximum(np.abs(motion.approach - d), np.abs(motion.velocity - v))
    assert np.abs(left - change).max() <= 4 * ULP
    _, _, before = periodic_motion(WHEEL, law, **settings, start=start, rounds=1, tolerance=0.0)
    assert (left <= 0.5 ** (rounds - 1) * before + drift(points, dt, quantum(12.5))).all()
    assert (left <= rms / 10).all()
    # to be what repeats itself is more than rolling a round: another start leaves what it was off by
    other = simulate(WHEEL, law(1), **settings, approach=d + 0.01, velocity=v)
    assert np.abs(other.approach - d - 0.01).max() > 1e-3


def test_shooting_ends_where_its_tolerance_is_met_and_says_so_where_it_is_not():
    height, settings = track(300, 2, 0.1), {"time_step": 0.035, "steps": 300}
    start = LinearLaw(WHEEL, 0 * height).steady_state(0.035)
    for rounds, met in ((12, True), (1, False)):
        _, _, left = periodic_motion(
            WHEEL,
            lambda n: springs_law(np.tile(height, (1, n)), 12.5),
            **settings,
            start=start,
            tolerance=1e-8,
            rounds=rounds,
        )
        assert (left <= 1e-8).all() == met


def test_periodic_motion_has_the_same_bits_in_every_ensemble():
    """A gentle track, done in a round or two, and a rough one that takes more."""
    height = np.concatenate([track(300, 1, 0.005), track(300, 1, 0.15, seed=1)], axis=1)

    def shot(which):
        def law(n):
            return springs_law(np.tile(height[:, which], (1, n)), 12.5)

        start = LinearLaw(WHEEL, 0 * height[:, which]).steady_state(0.035)
        return periodic_motion(WHEEL, law, time_step=0.035, steps=300, start=start)

    together = shot([0, 1])
    for i in range(2):
        for alone, beside in zip(shot([i]), together, strict=True):
            assert np.array_equal(alone, beside[[i]])


def periodogram(record, time_step):
    """(14.17), |FFT|^2 dt / N, and the frequencies df apart."""
    count = len(record)
    spectrum = np.abs(np.fft.fft(record, axis=0)) ** 2 * time_step / count
    return np.fft.fftfreq(count, time_step), spectrum


def test_steady_state_does_not_leak():
    """Between the waves of the track there is nothing but rounding; from static equilibrium, the resonance leaks."""
    change, dt, count = track(400, 1, 0.4, longest=20, shortest=30), 0.05, 400
    law = LinearLaw(WHEEL, change)
    d, v = law.steady_state(dt)
    steady = simulate(WHEEL, law, time_step=dt, steps=count, approach=d, velocity=v)
    free = simulate(WHEEL, law, time_step=dt, steps=count)
    empty = np.r_[40:200]
    one = periodogram(steady.acceleration[:, 0], dt)[1]
    assert one[empty].max() <= (400 * 64 * ULP) ** 2 * one.max()
    other = periodogram(free.acceleration[:, 0], dt)[1]
    # all but the motion of the track is a vibration that ends elsewhere than it began: the floor of its jump
    jump = free.jump - steady.jump
    omega = 2 * np.pi * np.arange(count) / (count * dt)
    floor = wheel_theory.leakage(omega[empty], jump=jump, time_step=dt, duration=count * dt)
    # the next term of the floor is the jump of the derivative over omega: of order omega_eigen / omega
    assert np.abs(np.log(other[empty] / floor)).max() <= 0.5
    assert np.abs(np.log(other[100:200] / floor[60:])).max() <= 0.15


@pytest.mark.parametrize("count", [64, 101])
def test_leakage_is_the_spectrum_of_a_ramp(count):
    dt, jump = 0.3, -1.7
    frequency, found = periodogram(jump * np.arange(count) / count, dt)
    omega = 2 * np.pi * frequency[1:]
    floor = wheel_theory.leakage(omega, jump=jump, time_step=dt, duration=count * dt)
    assert np.abs(found[1:] / floor - 1).max() <= 64 * ULP * count
    low = np.abs(omega) * dt < 0.2
    # and J^2 / (omega^2 T) where sin(x) = x (1 - x^2 / 6)
    assert floor[low] == pytest.approx(jump**2 / (omega[low] ** 2 * count * dt), rel=0.2**2 / 12 * 1.1)


def test_the_break_moves_as_the_floor_and_the_spectrum_meet():
    """J^2 / (omega^2 T) = omega^(-2 H - 3)."""
    for hurst in (0.4, 0.7, 1.0):
        meets = [t ** wheel_theory.break_exponent(hurst) for t in (1.0, 100.0)]
        for t, omega in zip((1.0, 100.0), meets, strict=True):
            assert 1 / (omega**2 * t) == pytest.approx(omega ** (-2 * hurst - 3), rel=1e-12)


@pytest.mark.parametrize("speed", [0.5, 20.0])
def test_spectra_over_frequency_are_those_of_the_record(speed):
    """<F^2> = int C_F dq = int A df, wave by wave, from a record in space and one in time."""
    count, dx = 121, 0.02
    force = np.random.default_rng(0).normal(size=count)
    force -= force.mean()
    along = waves(force, spacing=dx)
    found = wheel_theory.over_frequency(along.spectrum, speed=speed)
    frequency, expected = periodogram(force, dx / speed)
    half = slice(1, count // 2 + 1)
    assert along.q * speed / (2 * np.pi) == pytest.approx(frequency[half], rel=1e-12)
    assert found == pytest.approx(expected[half], rel=1e-9)
    df = speed / (count * dx)
    assert 2 * found.sum() * df == pytest.approx(np.mean(force**2), rel=1e-12)


def test_acceleration_over_force_is_that_of_a_steady_motion():
    """|a / dF|^2, wave by wave. Leapfrog has 2 sin(omega dt / 2) / dt for omega, smaller by (omega dt)^2 / 24.

    Near the resonance that counts 2 omega_0^2 / |omega_0^2 - omega^2| times; the power doubles it.
    """
    count, dt = 3001, 0.01
    change = np.zeros((count, 1))
    used = np.arange(1, 60)
    rng = np.random.default_rng(1)
    for n in used:
        change[:, 0] += rng.uniform(0.5, 1) * np.cos(2 * np.pi * n * np.arange(count) / count + rng.uniform(0, 6))
    law = LinearLaw(WHEEL, change)
    d, v = law.steady_state(dt)
    motion = simulate(WHEEL, law, time_step=dt, steps=count, approach=d, velocity=v)
    frequency, force = periodogram(change[:, 0], dt)
    _, found = periodogram(motion.acceleration[:, 0], dt)
    omega = 2 * np.pi * frequency[used]
    ratio = wheel_theory.acceleration_over_force(omega, eigenfrequency=1.0, mass=WHEEL.mass)
    gain = 4 * np.maximum(1, 1 / np.abs(1 - omega**2))
    assert (np.abs(found[used] / force[used] / ratio - 1) <= (omega * dt) ** 2 / 24 * gain * 1.1 + 1e-9).all()
    # Parseval: <a^2> = int A df
    assert found.sum() / (count * dt) == pytest.approx(np.mean(motion.acceleration**2), rel=1e-12)
    # the static limit, and the free mass
    slow, fast = wheel_theory.acceleration_over_force([1e-4, 1e4], eigenfrequency=1.0, mass=2.0)
    assert slow == pytest.approx(1e-16 / 4, rel=1e-7)
    assert fast == pytest.approx(1 / 4, rel=1e-7)
