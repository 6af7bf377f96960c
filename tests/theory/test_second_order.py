"""The second order of springs under a rolling wheel: against slow sums, drawn profiles and springs themselves."""

import math
from dataclasses import replace

import numpy as np
import pytest

import mdr
from tests.seeded import Times, catches
from validation.analysis.spectra import band_means, waves
from validation.theory.rolling import RollingWheel

BAND = mdr.SelfAffine(hurst=0.7, q_min=12.0, q_max=40.0, rms=2e-3)
FIXED = RollingWheel(radius=1.0, modulus=1.0, contact_radius=1.0, mass=math.inf, speed=1.0)
RESONANCE = 14.0
MOVING = replace(FIXED, mass=2 / RESONANCE**2, damping=0.05)
"""Its resonance, sqrt(2 a E* / M), lies in the band, so that it moves by as much as the heights."""
POINTS, LENGTH, COUNT = 8192, 40.0, 60
SPACING = LENGTH / POINTS


def profiles():
    draw = {"length": LENGTH, "points": POINTS, "rms": BAND.rms}
    return np.array([mdr.rough_profile(BAND.c1d, rng=np.random.default_rng(i), **draw) for i in range(COUNT)])


pairs_of = RollingWheel._pairs


@catches("one end of the contact for both").at(
    "validation.theory.rolling.RollingWheel._pairs", lambda wheel, *waves: pairs_of(wheel, *waves) / 4
)
def test_two_waves_have_the_force_of_their_sum_and_difference():
    """An even band so narrow that it is two waves, +k and -k: 2 k and 0 have the power of a square, slowly summed."""
    k, width = 20.0, 0.2
    narrow = lambda q: np.where(np.abs(q - k) < width / 2, 1.0, 0.0)  # noqa: E731
    for wheel in (FIXED, MOVING):
        place = 2 * k + 0.05
        one = k - width / 2 + width * (np.arange(4000) + 0.5) / 4000
        one = one[np.abs(place - one - k) < width / 2]
        ends = [[np.exp(1j * x * at) + wheel.motion(x) for x in (one, place - one)] for at in (1.0, -1.0)]
        total = np.sum(np.abs(sum(mine * other for mine, other in ends)) ** 2) * width / 4000
        (found,) = wheel.force_spectrum(place, narrow, q_max=21.0)
        # the ends of the band lie within a step of either rule
        assert found == pytest.approx(2 * total / 16, rel=0.02)


def test_the_motion_is_that_of_a_force_integrated_over_the_contact_and_of_a_driven_oscillator():
    """h = cos(q x): the force by sums over the contact; M y'' + c y' + k y = -F after its transient, by small steps."""
    q = 11.0
    x = np.linspace(-1, 1, 20_001)
    force = complex(np.trapezoid(np.exp(1j * q * x), x))
    mass, stiffness = MOVING.mass, 2.0
    dashpot = 2 * MOVING.damping * math.sqrt(stiffness * mass)
    expected = -force / (stiffness - mass * q**2 + 1j * dashpot * q)
    assert complex(MOVING.motion(q)) == pytest.approx(expected, rel=1e-6)
    dt, y, v, worst = 4e-4, 0.0, 0.0, 0.0
    for n in range(60_000):
        v += dt * ((-force * np.exp(1j * q * n * dt)).real - dashpot * v - stiffness * y) / mass
        y += dt * v
        if n > 55_000:
            worst = max(worst, abs(y))
    assert worst == pytest.approx(abs(expected), rel=1e-2)
    assert abs(complex(FIXED.motion(q))) == 0.0


@catches("half of the second-order force", wheel=FIXED).at(
    "validation.theory.rolling.RollingWheel.force_spectrum", Times(0.25)
)
@catches("pairs of waves without the motion of the wheel", wheel=MOVING).at(
    "validation.theory.rolling.RollingWheel._pairs",
    lambda wheel, *waves: pairs_of(replace(wheel, mass=math.inf), *waves),
)
@pytest.mark.parametrize("wheel", [FIXED, MOVING], ids=["fixed", "moving"])
def test_the_second_order_force_is_that_of_drawn_profiles(wheel):
    """(u^2 + v^2) / 4 of Gaussian heights below q_min, in bands of a twelfth of pi: each within five standard errors,
    and the sum in 5 %; heights over the wheel by the Fourier transform of each profile."""
    heights, shift = profiles(), round(1 / SPACING)
    q = 2 * np.pi * np.fft.rfftfreq(POINTS, SPACING)
    moved = np.fft.irfft(wheel.motion(q) * np.fft.rfft(heights, axis=1), POINTS, axis=1)
    forces = sum((np.roll(heights, at, axis=1) + moved) ** 2 for at in (shift, -shift)) / 4
    drawn = waves(forces - forces.mean(axis=1, keepdims=True), spacing=SPACING)
    edges, places = np.arange(0.5, 11.5, math.pi / 12), drawn.q[drawn.q < 12]
    means = band_means(drawn.q, drawn.spectrum.T, edges)
    found, error = means.mean(axis=1), means.std(axis=1, ddof=1) / math.sqrt(COUNT)
    exact = band_means(places, wheel.force_spectrum(places, BAND.c1d, q_max=BAND.q_max), edges)
    assert (np.abs(found - exact) <= 5 * error + 0.03 * exact.max()).all()
    assert found.sum() == pytest.approx(exact.sum(), rel=0.05, abs=0)


@pytest.mark.slow
def test_springs_below_the_band_have_the_second_order_force():
    """One-sided springs at a constant approach, where the linear force has no wave."""
    roll = {"spacing": SPACING / 4, "radius": 1.0, "modulus": 1.0, "approach": 1.0}
    forces = np.array([mdr.rolling_force(np.repeat(one, 4), **roll) for one in 10 * profiles()[:20]])
    found = waves(forces, spacing=roll["spacing"])
    inside = (found.q > 0.5) & (found.q < 11.5)
    level = found.spectrum[:, inside].sum(axis=1)
    exact = 1e4 * FIXED.force_spectrum(found.q[inside], BAND.c1d, q_max=BAND.q_max).sum()
    # h / d = 0.02: the third order adds a part of its size
    assert level.mean() == pytest.approx(exact, rel=0.05 + 4 * level.std(ddof=1) / math.sqrt(20) / level.mean())


compliance_of = RollingWheel.compliance


@catches("twice the dashpot at the resonance").at(
    "validation.theory.rolling.RollingWheel.compliance",
    lambda wheel, q: compliance_of(replace(wheel, damping=2 * wheel.damping), q),
)
def test_at_the_resonance_the_dashpot_alone_bears_the_force():
    """A = 2 pi C_F / v0 / (2 zeta M)^2; far above it the wheel is a free mass."""
    for omega, free in ((RESONANCE, 1 / (2 * 0.05)), (1000 * RESONANCE, 1.0)):
        band = lambda q, omega=omega: np.where((q > 12) & (q < 12 + 2 * omega), 1.0, 0.0)  # noqa: E731
        q_max = 12 + 2 * omega
        (force,), (found,) = (of(omega, band, q_max=q_max) for of in (MOVING.force_spectrum, MOVING.acceleration))
        assert found == pytest.approx(2 * math.pi * force * (free / MOVING.mass) ** 2, rel=1e-5)


@catches("a factor 2 in the integral over the resonance").at("validation.theory.rolling.over_the_resonance", Times(2.0))
@catches("a mean square of both signs of the frequency").at(
    "validation.theory.rolling.RollingWheel.over_resonance", Times(2.0)
)
def test_region_1_is_the_integral_over_the_resonance_and_goes_as_one_over_the_damping():
    """A_F2 omega_0 / (8 zeta M^2) beside a fine sum over omega_0 / 2 to 2 omega_0, of first order in zeta."""
    wheel, band = replace(FIXED, mass=2 / 4.0**2), BAND.c1d
    off = []
    for zeta in (0.02, 0.01, 0.005):
        damped = replace(wheel, damping=zeta)
        omega = 4.0 + np.sinh(np.linspace(-math.asinh(2 / zeta / 4), math.asinh(4 / zeta / 4), 250)) * 4 * zeta
        summed = np.trapezoid(damped.acceleration(omega, band, q_max=BAND.q_max), omega) / (2 * math.pi)
        off.append(damped.over_resonance(band, q_max=BAND.q_max) / summed - 1)
    assert np.abs(off[-1]) < 0.03
    assert np.abs(np.diff(np.array(off) / np.array([0.02, 0.01, 0.005]))).max() < 1.0
    with pytest.raises(ValueError, match="damping must be positive, got 0: a resonance of no width has no integral"):
        wheel.over_resonance(band, q_max=BAND.q_max)
