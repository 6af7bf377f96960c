"""Motions that repeat themselves, and spectra of records: what leaks, and what does not."""

import math

import numpy as np
import pytest

from tests.seeded import Times, catches
from tests.simulation.wheels import ULP, WHEEL, drift, quantum, springs_law, track
from validation.simulation import motion as wheel_in_motion
from validation.simulation.contact_laws import LinearLaw
from validation.simulation.motion import natural_periods, periodic_motion, simulate
from validation.theory import rolling as wheel_theory


def one_copy(wheel, law, **settings):
    """Shooting that rolls and does not correct."""
    start = settings.pop("start")
    for name in ("rounds", "tolerance"):
        settings.pop(name, None)
    motion = wheel_in_motion.simulate(wheel, law(1), **settings, approach=start[0], velocity=start[1])
    return motion.approach, motion.velocity, np.zeros(start[0].shape)


@catches("shooting without a correction").at(f"{__name__}.periodic_motion", one_copy)
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


def periodogram(record, time_step):
    """(14.17), |FFT|^2 dt / N, and the frequencies df apart."""
    count = len(record)
    spectrum = np.abs(np.fft.fft(record, axis=0)) ** 2 * time_step / count
    return np.fft.fftfreq(count, time_step), spectrum


@catches("factor 4 lost in the leakage", count=64).at("validation.theory.rolling.leakage", Times(4.0))
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
