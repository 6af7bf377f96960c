"""The wheel in motion: every law of contact against exact motions, balances and symmetries; lift-off."""

import math
import types

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.seeded import E_FOR_E_STAR, Times, catches
from tests.simulation.wheels import GRAVITY, SCHEMES, ULP, WHEEL, drift, laws, quantum, springs_law, track
from validation.scenes.wheel_body import Wheel
from validation.simulation import contact_laws, integrators, motion
from validation.simulation.contact_laws import BoundaryElementsLaw, HertzLaw, LinearLaw, SpringsLaw
from validation.simulation.motion import simulate

# --- smooth tracks ----------------------------------------------------------------------------------------------------


def without_load(wheel, law, **settings):
    """M z'' = F."""
    weightless = types.SimpleNamespace(load=0.0, mass=wheel.mass, eigenfrequency=wheel.eigenfrequency)
    return motion.simulate(weightless, law, **settings)


@catches("load forgotten in the equation of motion", law=contact_laws.HertzLaw(WHEEL, 2), each=4 * ULP).at(
    f"{__name__}.simulate", without_load
)
@pytest.mark.parametrize(
    ("law", "each"),
    [
        (HertzLaw(WHEEL, 2), 4 * ULP),
        (LinearLaw(WHEEL, np.zeros((7, 2))), 4 * ULP),
        (springs_law(np.zeros((100, 2)), 12.5), quantum(12.5)),
        # the contact ends upon a spring
        (springs_law(np.zeros((100, 2)), 10.0), quantum(10.0)),
    ],
    ids=["Hertz", "linear", "springs", "springs that just touch"],
)
def test_on_a_smooth_track_a_wheel_stays_at_rest(law, each):
    """But for the rounding of its force, which it meets again in every step."""
    motion = simulate(WHEEL, law, time_step=0.1, steps=10_000, path=True)
    start = law.at_rest(0)
    assert np.abs(motion.path - start).max() <= drift(10_000, 0.1, each)
    assert np.abs(motion.acceleration).max() <= 2 * drift(10_000, 0.1, each)
    assert (motion.airborne == 0).all()
    assert (motion.lowest == motion.path.min(axis=0)).all()
    assert (motion.highest == motion.path.max(axis=0)).all()


@catches("E for E* in the force, not in the approach at rest").at("mdr.RollingEnsemble.force", Times(E_FOR_E_STAR))
def test_at_rest_the_wheel_bears_its_load():
    for law in (HertzLaw(WHEEL, 2), LinearLaw(WHEEL, track(40, 2, 0.3)), springs_law(track(40, 2, 0.3), 12.5)):
        for place in (0, 3, 17):
            assert law.force(place, law.at_rest(place)) == pytest.approx(4 / 3, rel=4 * quantum(12.5))


@catches("a jump that is not there", name="linear").at(
    "validation.simulation.motion.Motion.jump",
    property(lambda motion: motion.next_acceleration - motion.next_acceleration),
)
@pytest.mark.parametrize("name", ["springs", "linear", "Hertz"])
def test_the_change_of_velocity_is_the_mean_acceleration(name):
    """Velocity Verlet adds (z_n'' + z_n+1'') / 2 dt: the mean of the record, and half of the jump over N."""
    start = np.array([1.1, 1.4, 0.6])
    motion = simulate(WHEEL, laws()[name], time_step=0.07, steps=1500, approach=start, velocity=np.zeros(3))
    gained = -motion.velocity / motion.duration
    mean = motion.acceleration.mean(axis=0)
    assert motion.duration == pytest.approx(105.0, rel=1e-14)
    assert np.abs(mean + motion.jump / 3000 - gained).max() <= 1500 * 4 * ULP
    # so the mean force is the load, but for what the ends of the record make of it
    force = WHEEL.mass * mean + WHEEL.load
    ends = 2 * WHEEL.mass * (np.abs(motion.velocity) / motion.duration + np.abs(motion.jump) / 3000)
    assert np.abs(force - WHEEL.load).max() <= ends.max()


@pytest.mark.parametrize("name", ["explicit Euler", "symplectic Euler"])
def test_the_change_of_velocity_of_eulers_schemes_is_the_sum_of_the_record(name):
    motion = simulate(WHEEL, laws()["linear"], time_step=0.01, steps=500, integrator=SCHEMES[name])
    assert np.abs(motion.acceleration.sum(axis=0) * 0.01 + motion.velocity).max() <= 500 * 4 * ULP


def by_another(march):
    """What `simulate` does where no scheme is asked for."""
    return {**motion.simulate.__kwdefaults__, "integrator": march}


@catches("explicit Euler where nothing is asked for", rms=0.05, thrown=0.0).at(
    "validation.simulation.motion.simulate.__kwdefaults__", by_another(integrators.EXPLICIT_EULER)
)
@pytest.mark.parametrize(("rms", "thrown"), [(0.0, 0.3), (0.05, 0.0), (0.3, 0.0), (0.2, 1.5)])
def test_time_reversal(rms, thrown):
    """Back over the mirrored track with the velocity reversed: where it came from.

    Springs add exactly, so that only the rounding of the approach to a quantum is not reversed, and that of floats.
    """
    points, springs, steps, dt = 300, 12.5, 700, 0.05
    height = track(points, 3, rms)
    start, speed = np.array([1.0, 1.1, 0.7]), np.array([0.0, -0.1, 0.2]) - thrown
    settings = {"time_step": dt, "steps": steps, "path": True}
    there = simulate(WHEEL, springs_law(height, springs), approach=start, velocity=speed, **settings)
    assert (there.airborne > 0).any() or rms + thrown < 0.5
    mirrored = springs_law(height[(steps - np.arange(points)) % points], springs)
    back = simulate(WHEEL, mirrored, approach=there.approach, velocity=-there.velocity, **settings)
    # contacts that stiffen on impact spread neighbouring motions, though not by orders of magnitude
    allowed = 10 * drift(2 * steps, dt, quantum(springs) + 4 * ULP)
    assert np.abs(back.approach - start).max() <= allowed
    assert np.abs(back.velocity + speed).max() <= allowed
    assert np.abs(back.path[1:] - there.path[:0:-1]).max() <= allowed


@pytest.mark.slow
@given(length=st.floats(-5, 2), modulus=st.floats(-3, 11), mass=st.floats(-3, 4), seed=st.integers(0, 100))
@settings(max_examples=20)
def test_units_do_not_matter(length, modulus, mass, seed):
    """d ~ l and t ~ sqrt(M / (E* l)), whatever M, E* and l; v_0 is in the time step, and so is its unit."""
    metre, pascal, kilogram = 10.0**length, 10.0**modulus, 10.0**mass
    second = math.sqrt(kilogram / (pascal * metre))
    there = Wheel(radius=metre, mass=2 * kilogram, modulus=pascal, load=4 / 3 * pascal * metre**2)
    height = track(150, 2, 0.2, seed=seed)
    one = simulate(WHEEL, springs_law(height, 12.5), time_step=0.1, steps=150, path=True)
    other = simulate(
        there, SpringsLaw(there, metre * height, metre / 12.5), time_step=0.1 * second, steps=150, path=True
    )
    allowed = 10 * drift(150, 0.1, 2 * quantum(12.5) + 64 * ULP)
    assert np.abs(other.path / metre - one.path).max() <= allowed
    assert np.abs(other.acceleration * second**2 / metre - one.acceleration).max() <= 2 * allowed
    assert np.abs(other.velocity * second / metre - one.velocity).max() <= allowed


# --- the linear contact -----------------------------------------------------------------------------------------------


@catches("symplectic Euler where nothing is asked for", turn=0.3).at(
    "validation.simulation.motion.simulate.__kwdefaults__", by_another(integrators.SYMPLECTIC_EULER)
)
@pytest.mark.parametrize("turn", [0.01, 0.3, 1.0, 1.9, 1.999])
def test_free_vibration_of_a_linear_contact_is_the_exact_one_of_leapfrog(turn):
    """d_n = d_N + A cos(n W), cos(W) = 1 - (omega dt)^2 / 2; rounding grows by 1 / sin(W) a step."""
    law, steps = LinearLaw(WHEEL, np.zeros((1, 1))), 2000
    found = simulate(WHEEL, law, time_step=turn, steps=steps, approach=np.array([1.25]), path=True).path[:, 0]
    angle = 2 * math.asin(turn / 2)
    expected = 1 + 0.25 * np.cos(angle * np.arange(steps))
    assert np.abs(found - expected).max() <= 8 * ULP * steps * (1 + turn**2) / math.sin(angle)


def steady_by_a_dense_solve(change, time_step):
    """(y_n+1 - 2 y_n + y_n-1) M / dt^2 + k y_n = -dF_n around the track."""
    count = len(change)
    one = np.eye(count)
    swing = np.roll(one, 1, axis=0) - 2 * one + np.roll(one, -1, axis=0)
    matrix = WHEEL.mass / time_step**2 * swing + WHEEL.stiffness * one
    return np.linalg.solve(matrix, -change), np.linalg.cond(matrix)


def softer_steady(law, time_step):
    """omega for the 2 sin(omega dt / 2) / dt of leapfrog."""
    frequency = 2 * np.pi * np.fft.rfftfreq(len(law.change), time_step)[:, np.newaxis]
    waves = np.fft.rfft(law.change, axis=0) / (law.wheel.stiffness - law.wheel.mass * frequency**2)
    d = -np.fft.irfft(waves, len(law.change), axis=0)
    return law.wheel.approach + d[0], (d[1] - d[-1]) / (2 * time_step)


@catches("a steady motion in continuous time", points=50, time_step=0.1).at(
    "validation.simulation.contact_laws.LinearLaw.steady_state", softer_steady
)
@pytest.mark.parametrize(("points", "time_step"), [(50, 0.1), (51, 0.7), (64, 1.7), (7, 0.3), (2, 0.3)])
def test_the_steady_motion_is_that_of_a_dense_solve_and_repeats_itself(points, time_step):
    change = np.random.default_rng(points).normal(size=(points, 2))
    law = LinearLaw(WHEEL, change)
    expected, condition = steady_by_a_dense_solve(change, time_step)
    d, v = law.steady_state(time_step)
    rounding = 16 * ULP * condition * (1 + np.abs(expected).max())
    assert np.abs(d - 1 - expected[0]).max() <= rounding
    assert np.abs(v - (expected[1 % points] - expected[-1]) / (2 * time_step)).max() <= rounding / time_step
    found = simulate(WHEEL, law, time_step=time_step, steps=3 * points, approach=d, velocity=v, path=True)
    spread = rounding * (1 + 1 / time_step) * (3 * points * time_step + 1)
    assert np.abs(found.path - 1 - np.tile(expected, (3, 1))).max() <= spread
    assert np.abs(found.approach - d).max() <= spread
    assert np.abs(found.jump).max() <= 2 * spread


def test_a_track_that_resonates_has_no_steady_motion():
    """2 sin(omega dt / 2) / dt = omega_eigen of the second wave."""
    omega_dt = 2 * np.pi * 2 / 40
    with pytest.raises(ValueError, match="resonance"):
        LinearLaw(WHEEL, np.ones((40, 1))).steady_state(2 * math.sin(omega_dt / 2))


SPRINGS = 200.5
POINTS, WAVE, STEP = 1500, 4, 0.02


def one_wave(height):
    """A wave under springs that keep their contact, and the linear law whose force is theirs.

    E* dx sum_{|j| <= m} cos(q j dx) = E* dx sin((m + 1/2) q dx) / sin(q dx / 2), which tends to (14.11).
    """
    dx, phase = 1 / SPRINGS, 2 * np.pi * WAVE * np.arange(POINTS)[:, np.newaxis] / POINTS + 0.4
    q_dx = 2 * np.pi * WAVE / POINTS
    response = dx * math.sin(SPRINGS * q_dx) / math.sin(q_dx / 2)
    assert response == pytest.approx(2 * math.sin(q_dx * SPRINGS) / (q_dx * SPRINGS), rel=q_dx**2 / 20)
    assert abs(response) > 0.1
    return springs_law(height * np.cos(phase), SPRINGS), LinearLaw(WHEEL, response * height * np.cos(phase))


def beyond_linear(height):
    """How far the motion on springs is off that of the linear law, both begun alike."""
    springs, linear = one_wave(height)
    d, v = linear.steady_state(STEP)
    rest = springs_law(np.zeros((POINTS, 1)), SPRINGS).at_rest(0)
    settings = {"time_step": STEP, "steps": POINTS, "velocity": v, "path": True}
    found = simulate(WHEEL, springs, approach=d - 1 + rest, **settings).path - rest
    return np.abs(found - (simulate(WHEEL, linear, approach=d, **settings).path - 1)).max(), np.ptp(found)


def test_a_wave_below_the_edge_of_the_contact_has_exactly_the_linear_response():
    """The last spring in contact is pressed by 2 a (dx / 2) / R = dx, so that heights below lose and gain none."""
    error, moved = beyond_linear(0.2 / SPRINGS)
    assert moved > 0.1 * 0.2 / SPRINGS
    assert error <= drift(POINTS, STEP, 2 * quantum(SPRINGS))


def test_a_wave_tends_to_the_linear_response_at_second_order():
    """F = linear part + E* R / (4 a) (h(x + a)^2 + h(x - a)^2): springs lost and gained at both edges.

    What drives the wheel beyond the linear motion is of second order in h - (d - d_N) there, and so is what it does.
    """
    heights = np.array([0.16, 0.08, 0.04])
    errors = [beyond_linear(height)[0] for height in heights]
    assert np.diff(np.log(errors)) / np.diff(np.log(heights)) == pytest.approx(2, abs=0.1)


# --- lift-off ---------------------------------------------------------------------------------------------------------


def lifted(name):
    """Laws without force above the plane, and one more wheel that stays on the ground."""
    return {"Hertz": HertzLaw(WHEEL, 2), "springs": springs_law(np.zeros((60, 2)), 12.5)}[name]


@pytest.mark.parametrize("name", ["Hertz", "springs"])
def test_a_wheel_thrown_up_flies_a_parabola_and_comes_back(name):
    """z = v t - g t^2 / 2 with g = F_N / M, which leapfrog follows exactly; it lands as fast as it was thrown."""
    dt, up = 0.01, 1.0
    time_of_flight = 2 * up / GRAVITY
    steps = round(2.5 * time_of_flight / dt)
    law = lifted(name)
    rest = law.at_rest(0)[1]
    motion = simulate(
        WHEEL, law, time_step=dt, steps=steps, approach=np.array([0.0, rest]), velocity=np.array([-up, 0.0]), path=True
    )
    t = dt * np.arange(math.floor(time_of_flight / dt) + 1)
    flight = motion.path[: t.size, 0]
    assert np.abs(flight - (GRAVITY * t**2 / 2 - up * t)).max() <= 8 * ULP * t.size
    assert (motion.acceleration[: t.size, 0] == -GRAVITY).all()
    assert motion.lowest[0] == pytest.approx(-(up**2) / (2 * GRAVITY), abs=GRAVITY * dt**2)
    # down to as deep as its energy presses it
    depth = motion.highest[0]
    assert 2 / 3 * (0.4 * depth**2.5 - depth) == pytest.approx(up**2 / 2, rel=0.02)
    assert motion.airborne[0] == np.count_nonzero(motion.path[:, 0] <= 0)
    # thrown up again before the end
    assert motion.airborne[0] > t.size
    assert motion.airborne[1] == 0


# --- boundary elements in the loop ------------------------------------------------------------------------------------


def strips(cells, height, wheels=1):
    """Low waves of a wavelength of three radii and more, on strips of 6 by 3 radii."""
    nx, ny = 6 * cells, 3 * cells
    x = 2 * np.pi * (np.arange(nx) + 0.5)[:, np.newaxis] / nx
    y = 2 * np.pi * (np.arange(ny) + 0.5) / ny
    return [height * (np.cos(2 * x + y + i) + np.cos(x - 0.4 * i)) for i in range(wheels)]


def test_wheels_on_boundary_elements_do_not_know_of_each_other():
    several = strips(4, 0.02, wheels=2)
    settings = {"time_step": 0.2, "steps": 20}
    together = simulate(WHEEL, BoundaryElementsLaw(WHEEL, several, 0.25), **settings)
    for i, strip in enumerate(several):
        alone = simulate(WHEEL, BoundaryElementsLaw(WHEEL, [strip], 0.25), **settings)
        assert np.array_equal(alone.acceleration[:, 0], together.acceleration[:, i])
