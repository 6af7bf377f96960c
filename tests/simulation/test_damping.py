"""The dashpot of a wheel: exact motions of a linear contact, the work that it takes, and every contact with it."""

import dataclasses
import math

import numpy as np
import pytest

from tests.cases.planted import LOW
from tests.railway.power_law_ground import isotropic_strip
from tests.seeded import Times, catches
from tests.simulation.test_wheel_motion import strips
from tests.simulation.wheels import SCHEMES, ULP, WHEEL, springs_law, track
from validation.railway.problems import wheel_on_rail
from validation.railway.problems.wheel_on_rail import WheelOnRail
from validation.scenes.wheel_body import DampedWheel, Wheel
from validation.simulation import wheel_on_springs
from validation.simulation.contact_laws import BoundaryElementsLaw, HertzLaw, LinearLaw
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS_THAT_READ as SPRINGS
from validation.simulation.motion import simulate
from validation.simulation.wheel_on_half_space import WheelStrip, simulate_strip
from validation.simulation.wheel_on_springs import WheelEnsemble

ZETA = 0.05


def damped(zeta=ZETA):
    """omega_eigen = 1 and M = 2, so that c = 4 zeta."""
    return DampedWheel(**dataclasses.asdict(WHEEL), damping=zeta)


def linear(change, zeta=ZETA):
    return LinearLaw(damped(zeta), change)


def test_without_damping_all_numbers_are_those_of_plain_velocity_verlet_to_the_bit():
    law, change = springs_law(track(200, 3, 0.2), 12.5), track(50, 2, 0.3)
    start = law.at_rest(0) + 0.2
    plain, mine = (simulate(wheel, law, time_step=0.05, steps=500, approach=start) for wheel in (WHEEL, damped(0.0)))
    for name in ("acceleration", "velocity"):
        assert np.array_equal(getattr(mine, name), getattr(plain, name))
    assert np.array_equal(linear(change, 0.0).steady_state(0.1), LinearLaw(WHEEL, change).steady_state(0.1))


@catches("factor 2 in the constant of the dashpot").at("validation.scenes.wheel_body.damping_rate", Times(2.0))
@catches("a dashpot that drives the wheel").at("validation.scenes.wheel_body.damping_rate", Times(-1.0))
def test_free_vibration_decays_by_the_exact_law_of_a_dashpot_at_second_order():
    """y = A exp(-zeta t) (cos(w t) + zeta / w sin(w t)), w = sqrt(1 - zeta^2), released at rest."""
    errors, w = [], math.sqrt(1 - ZETA**2)
    for steps in (400, 800, 1600):
        dt = 40.0 / steps
        t = dt * np.arange(steps)
        law = linear(np.zeros((1, 1)))
        motion = simulate(law.wheel, law, time_step=dt, steps=steps, approach=np.array([1.25]), path=True)
        exact = 0.25 * np.exp(-ZETA * t) * (np.cos(w * t) + ZETA / w * np.sin(w * t))
        errors.append(np.abs(motion.path[:, 0] - 1 - exact).max())
    assert errors[0] < 0.02
    assert -np.diff(np.log2(errors)) == pytest.approx(2, abs=0.05)


@catches("factor 2 in the dashpot of the steady state", frequency=0.5).at(
    "validation.scenes.wheel_body.damping_rate", Times(2.0)
)
@pytest.mark.slow
@pytest.mark.parametrize("frequency", [0.5, 1.0, 3.0])
def test_a_sine_brings_the_wheel_into_its_steady_response(frequency):
    """From rest, after exp(-zeta t) is gone: y = -dF / (k - M w^2 + i c w), of second order in w dt; at w = 1 the
    amplitude is dF / (2 zeta k)."""
    points, force = 120, 0.01
    dt = 2 * math.pi / frequency / points
    rounds = math.ceil(25 / ZETA * frequency / (2 * math.pi))
    law = linear(force * np.cos(2 * np.pi * np.arange(points) / points)[:, np.newaxis])
    motion = simulate(law.wheel, law, time_step=dt, steps=points * rounds, approach=np.ones(1), path=True)
    last = motion.path[-points:, 0] - 1
    found = 2 * np.fft.rfft(last)[1] / points
    expected = -force / (2 - 2 * frequency**2 + 4j * ZETA * frequency)
    assert abs(found / expected - 1) < 0.25 * (max(frequency, 1) * dt) ** 2 / ZETA + 1e-9
    d, v = law.steady_state(dt)
    assert abs(d[0] - motion.approach[0]) <= 1e-10 and abs(v[0] - motion.velocity[0]) <= 1e-10


@pytest.mark.parametrize("points", [50, 51, 2])
def test_the_steady_state_with_damping_repeats_itself_even_at_the_resonance(points):
    change = np.random.default_rng(points).normal(size=(points, 2))
    law = linear(change)
    for dt in (0.3, 2 * math.sin(np.pi * 2 / 50)):
        d, v = law.steady_state(dt)
        motion = simulate(law.wheel, law, time_step=dt, steps=points, approach=d, velocity=v)
        rounding = 64 * ULP * points / ZETA * np.abs(change).max() / dt
        assert np.abs(motion.approach - d).max() <= rounding and np.abs(motion.velocity - v).max() <= rounding


LAWS = {
    "springs": lambda: springs_law(track(200, 1, 0.2), 12.5),
    "linear": lambda: linear(track(200, 1, 0.2)),
    "Hertz": lambda: HertzLaw(WHEEL),
    "boundary elements": lambda: BoundaryElementsLaw(WHEEL, strips(4, 0.02), 0.25, tolerance=1e-9),
}


@pytest.mark.parametrize("name", [*list(LAWS)[:3], pytest.param(list(LAWS)[3], marks=pytest.mark.slow)])
def test_every_contact_moves_by_the_same_equation(name):
    """M d'' = F_N - F - c d' by central differences, F asked for again, after a throw that loses contact."""
    law, dt = LAWS[name](), 0.1
    motion = simulate(
        damped(), law, time_step=dt, steps=40, approach=np.array([-0.05]), velocity=-np.ones(1), path=True
    )
    d = motion.path[:, 0]
    speed, swing = (d[2:] - d[:-2]) / (2 * dt), (d[2:] - 2 * d[1:-1] + d[:-2]) / dt**2
    force = np.array([law.force(n, motion.path[n])[0] for n in range(40)])
    assert np.abs(force - motion.force[:, 0]).max() <= 1e-6
    assert np.abs(2 * swing - (4 / 3 - force[1:-1] - 4 * ZETA * speed)).max() <= 1e-6
    assert np.abs(motion.acceleration[1:-1, 0] + swing).max() <= 1e-9 / dt**2
    if name != "linear":
        assert motion.airborne[0] == np.count_nonzero(force == 0) > 5


@pytest.mark.parametrize("name", [name for name in SCHEMES if name != "velocity Verlet"])
def test_other_schemes_are_refused_for_a_wheel_with_damping(name):
    with pytest.raises(ValueError, match=f"integrator must be velocity Verlet .* got {name}"):
        simulate(damped(), HertzLaw(WHEEL), time_step=0.1, steps=5, integrator=SCHEMES[name])


# --- the problems that are solved ------------------------------------------------------------------------------------


def over_force(acceleration, change, dt):
    """Gain of each wave that the force has, z'' over dF."""
    waves, driven = np.fft.rfft(acceleration), np.fft.rfft(change)
    kept = np.abs(driven) > 1e-3 * np.abs(driven).max()
    omega = 2 * np.pi * np.fft.rfftfreq(len(change), dt)[kept]
    return omega, np.abs(waves[kept] / driven[kept])


def gain(omega, dt, wheel, zeta):
    """Of leapfrog with a dashpot, s^2 / |k - M s^2 + i c sin(w dt) / dt|, s = 2 sin(w dt / 2) / dt."""
    s, c = 2 * np.sin(omega * dt / 2) / dt, 2 * zeta * math.sqrt(wheel.stiffness * wheel.mass)
    return s**2 / np.abs(wheel.stiffness - wheel.mass * s**2 + 1j * c * np.sin(omega * dt) / dt)


@catches("damping forgotten in a scene of springs", linear_contact=True).at(
    "validation.scenes.rolling.DampedWheel", lambda damping, **given: Wheel(**given)
)
@pytest.mark.slow
@pytest.mark.parametrize("linear_contact", [True, False], ids=["linear", "springs"])
def test_a_scene_with_damping_damps_its_wheels_on_springs(linear_contact):
    """Waves that excite the resonance, on springs of little height: the gain is that of the dashpot within h/d."""
    scene = dataclasses.replace(LOW, damping=0.1, speed=1.5, springs=80)
    ensemble = WheelEnsemble(scene=scene, linear=linear_contact, track="steady-state", seed=4)
    motion, left = wheel_on_springs._motion(ensemble)
    assert left.max() <= wheel_on_springs.STEADY_TOLERANCE
    change = wheel_on_springs.linear_law_1d(scene.body, ensemble.heights(), scene.spacing).change[:, 0]
    omega, found = over_force(motion.acceleration[:, 0], change, motion.time_step)
    ratio = omega / scene.eigenfrequency
    assert ratio.min() < 0.9 and ratio.max() > 1.1
    expected = gain(omega, motion.time_step, scene.body, 0.1)
    near = (ratio > 0.7) & (ratio < 1.4)
    assert found[near] == pytest.approx(expected[near], rel=1e-6 if linear_contact else 0.05)


@pytest.mark.slow
def test_a_scene_with_damping_damps_its_wheel_on_boundary_elements():
    """On low ground they follow the linear contact, whose gain is that of the dashpot, from their common start on."""
    scene = dataclasses.replace(LOW, damping=0.3, speed=6.0)
    strip = WheelStrip(
        scene=scene, realisation=0, natural_periods=2, width=2, cells=6, shared=2, tolerance=1e-7, seed=1
    )
    found = simulate_strip(strip)
    off = np.abs(found["bem"] - found["linear"]).max() / found["linear"].std()
    assert off < 0.1
    undamped = simulate_strip(dataclasses.replace(strip, scene=dataclasses.replace(scene, damping=0.0)))
    assert np.abs(undamped["linear"] - found["linear"]).max() > 3 * off * found["linear"].std()


def on_rail(model, zeta=ZETA, rms=1e-7):
    strip = isotropic_strip(rms, 0.36, 1e-3)
    return WheelOnRail(strip=strip, mass=500.0, speed=22.0, model=model, tolerance=1e-6, damping=zeta)


def without_a_dashpot(case):
    """The wheel on a rail, whatever damping it is given."""
    springs = wheel_on_rail.spring_wheel(case.strip.radii, case.strip.modulus)
    return Wheel(radius=springs.radius, modulus=springs.modulus, mass=case.mass, load=case.strip.force)


@catches("damping forgotten on a rail", model=SPRINGS).at(
    "validation.railway.problems.wheel_on_rail.WheelOnRail.wheel", property(without_a_dashpot)
)
@pytest.mark.parametrize("model", [pytest.param(BEM, marks=pytest.mark.slow), SPRINGS])
def test_a_wheel_on_a_rail_moves_by_its_equation_with_the_dashpot(model):
    case = on_rail(model)
    d, force = wheel_on_rail.in_motion(case, case.law())
    dt = case.time_step
    speed, swing = (d[2:] - d[:-2]) / (2 * dt), (d[2:] - 2 * d[1:-1] + d[:-2]) / dt**2
    c = 2 * ZETA * math.sqrt(case.wheel.stiffness * 500.0)
    dashpot = c * speed
    rest = 500.0 * swing - (5e4 - force[1:-1] - dashpot)
    assert np.abs(rest).max() < 1e-3 * np.abs(dashpot).max()
