"""The wheel in motion: every law of contact and every scheme against exact motions, balances, orders and limits."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import bem3d
from tests.oracles import free_vibration_by_small_steps
from validation.analysis.spectra import waves
from validation.scenes.wheel_body import Wheel
from validation.simulation import integrators
from validation.simulation.contact_laws import BoundaryElementsLaw, HertzLaw, LinearLaw, SpringsLaw
from validation.simulation.integrators import EXPLICIT_EULER, RUNGE_KUTTA, SYMPLECTIC_EULER, VELOCITY_VERLET
from validation.simulation.motion import natural_periods, periodic_motion, simulate
from validation.theory import wheel as wheel_theory
from validation.theory.rolling import linear_force

WHEEL = Wheel(radius=1.0, mass=2.0, modulus=1.0, load=4 / 3)
"""d_N = a = 1, k = 2 and omega_eigen = 1, gravity 2/3."""
GRAVITY = 2 / 3
ULP = 2.0**-53
SCHEMES = {scheme.name: scheme for scheme in integrators.INTEGRATORS}
SYMPLECTIC = (SYMPLECTIC_EULER.name, VELOCITY_VERLET.name)


def quantum(springs):
    """Of approach, in the force of springs: 32 * 2 a / dx * 2^-53."""
    return 32 * 2 * springs * ULP


def drift(steps, time_step, each):
    """How far a wheel gets by errors of its approach, seen by the force: n kicks of omega^2 dt each, all alike."""
    return (steps * time_step + 2) * each


def track(points, wheels, rms, *, seed=0, longest=1, shortest=8):
    """Some waves of a periodic track, of which each wheel has its own."""
    rng = np.random.default_rng(seed)
    x = 2 * np.pi * np.arange(points)[:, np.newaxis, np.newaxis] / points
    number = np.arange(longest, shortest + 1)
    phase = rng.uniform(0, 2 * np.pi, (wheels, number.size))
    return rms * math.sqrt(2 / number.size) * np.cos(number * x + phase).sum(axis=2)


def springs_law(height, springs):
    return SpringsLaw(WHEEL, height, 1 / springs)


class Counted:
    """A law that counts how often it is asked, and where."""

    def __init__(self, law):
        self.law, self.places = law, []

    def force(self, place, approach):
        self.places.append(place)
        return self.law.force(place, approach)

    def at_rest(self, place):
        self.places.append(place)
        return self.law.at_rest(place)


# --- smooth tracks ----------------------------------------------------------------------------------------------------


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


def test_at_rest_the_wheel_bears_its_load():
    for law in (HertzLaw(WHEEL, 2), LinearLaw(WHEEL, track(40, 2, 0.3)), springs_law(track(40, 2, 0.3), 12.5)):
        for place in (0, 3, 17):
            assert law.force(place, law.at_rest(place)) == pytest.approx(4 / 3, rel=4 * quantum(12.5))


# --- balances and symmetries ------------------------------------------------------------------------------------------


def laws(points=200):
    height = track(points, 3, 0.2)
    return {"springs": springs_law(height, 12.5), "linear": LinearLaw(WHEEL, height), "Hertz": HertzLaw(WHEEL, 3)}


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


@pytest.mark.parametrize(("rms", "thrown"), [(0.0, 0.3), (0.05, 0.0), (0.3, 0.0), (0.2, 1.5)])
def test_time_reversal(rms, thrown):
    """Back over the mirrored track with the velocity reversed: where it came from.

    Springs add exactly, so that only the rounding of the approach to a quantum is not reversed, and that of floats.
    """
    points, springs, steps, dt = 300, 12.5, 700, 0.05
    height = track(points, 3, rms)
    start, speed = np.array([1.0, 1.1, 0.7]), np.array([0.0, -0.1, 0.2]) - thrown
    there = simulate(
        WHEEL, springs_law(height, springs), time_step=dt, steps=steps, approach=start, velocity=speed, path=True
    )
    assert (there.airborne > 0).any() or rms + thrown < 0.5
    mirrored = height[(steps - np.arange(points)) % points]
    back = simulate(
        WHEEL,
        springs_law(mirrored, springs),
        time_step=dt,
        steps=steps,
        approach=there.approach,
        velocity=-there.velocity,
        path=True,
    )
    # contacts that stiffen on impact spread neighbouring motions, though not by orders of magnitude
    allowed = 10 * drift(2 * steps, dt, quantum(springs) + 4 * ULP)
    assert np.abs(back.approach - start).max() <= allowed
    assert np.abs(back.velocity + speed).max() <= allowed
    assert np.abs(back.path[1:] - there.path[:0:-1]).max() <= allowed


@pytest.mark.parametrize("name", ["springs", "linear", "Hertz"])
def test_a_wheel_has_the_same_bits_in_every_ensemble(name):
    height = track(300, 4, 0.3)
    make = {
        "springs": lambda which: springs_law(height[:, which], 12.5),
        "linear": lambda which: LinearLaw(WHEEL, height[:, which]),
        "Hertz": lambda which: HertzLaw(WHEEL, len(which)),
    }[name]
    start, speed = np.array([1.0, 1.3, 0.4, 1.1]), np.array([0.0, 0.5, -1.0, 0.1])

    def run(which):
        return simulate(
            WHEEL, make(which), time_step=0.1, steps=700, approach=start[which], velocity=speed[which], path=True
        )

    together = run([0, 1, 2, 3])
    for which in ([0], [2], [3, 1], [2, 0, 1]):
        some = run(which)
        for field in ("lowest", "highest", "airborne", "approach", "velocity", "next_acceleration", "jump"):
            assert np.array_equal(getattr(some, field), getattr(together, field)[which]), field
        assert np.array_equal(some.acceleration, together.acceleration[:, which])
        assert np.array_equal(some.path, together.path[:, which])


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


@given(turn=st.integers(-20, 20), mass=st.integers(-20, 20))
@settings(max_examples=20)
def test_units_of_time_and_mass_that_are_powers_of_two_change_no_bit(turn, mass):
    """E* l / M is a power of four then, and so its root is exact."""
    kilogram, second = 2.0**mass, 2.0**turn
    pascal = kilogram / second**2
    there = Wheel(radius=1.0, mass=2 * kilogram, modulus=pascal, load=4 / 3 * pascal)
    height = track(150, 2, 0.2)
    one = simulate(WHEEL, springs_law(height, 12.5), time_step=0.1, steps=150, path=True)
    other = simulate(there, SpringsLaw(there, height, 1 / 12.5), time_step=0.1 * second, steps=150, path=True)
    assert np.array_equal(other.path, one.path)
    assert np.array_equal(other.velocity * second, one.velocity)
    assert np.array_equal(other.acceleration * second**2, one.acceleration)


# --- the linear contact -----------------------------------------------------------------------------------------------


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


# --- schemes ----------------------------------------------------------------------------------------------------------


def after(name, cells, turns):
    """Approach and velocity after so many small natural periods, on a Hertz contact released at 1.5 d_N."""
    scheme = SCHEMES[name]
    dt = 2 * math.pi * turns / cells
    steps = cells // scheme.cells
    motion = simulate(WHEEL, HertzLaw(WHEEL), time_step=dt, steps=steps, approach=np.array([1.5]), integrator=scheme)
    assert motion.duration == pytest.approx(2 * math.pi * turns, rel=1e-12)
    return np.array([motion.approach[0], motion.velocity[0]])


@pytest.mark.parametrize("name", SCHEMES)
def test_order_of_a_scheme_on_a_free_vibration(name):
    """At a place that is no turning point, where symplectic Euler would be better than it is."""
    exact = free_vibration_by_small_steps(1.5, turns=0.8)
    cells = {1: (400, 800, 1600, 3200), 2: (100, 200, 400, 800), 4: (40, 80, 160, 320)}[SCHEMES[name].order]
    errors = [np.abs(after(name, n, 0.8) - exact).max() for n in cells]
    assert -np.diff(np.log2(errors)) == pytest.approx(SCHEMES[name].order, abs=0.2)


@pytest.mark.parametrize(("name", "order"), [("velocity Verlet", 2), ("Runge-Kutta", 4), ("symplectic Euler", 2)])
def test_after_its_period_a_free_vibration_is_back(name, order):
    """Symplectic Euler is velocity Verlet seen half a step later, so that over a whole period it is of second order."""
    period = wheel_theory.hertz_period(1.5)
    errors = [np.abs(after(name, n, period) - [1.5, 0]).max() for n in (80, 160, 320)]
    assert -np.diff(np.log2(errors)) == pytest.approx(order, abs=0.2)


def energies(name, turn, steps, highest):
    """v^2 / 2 + V(d) of a free vibration on a Hertz contact, on and on."""

    def acceleration(_, d):
        return 2 / 3 * (1 - d * math.sqrt(d)) if d > 0 else 2 / 3

    states = SCHEMES[name].march(acceleration, highest, 0.0, turn)
    state = np.array([next(states)[:2] for _ in range(steps)])
    return state[:, 1] ** 2 / 2 + 2 / 3 * (0.4 * np.maximum(state[:, 0], 0) ** 2.5 - state[:, 0])


@pytest.mark.parametrize("name", SYMPLECTIC)
@pytest.mark.parametrize("highest", [1.5, 2.5])
def test_symplectic_schemes_keep_the_energy(name, highest):
    """They swing about it by their order in omega dt, with or without lift-off, however long."""
    turn, order = 0.02, SCHEMES[name].order
    energy = energies(name, turn, 100_000, highest)
    off = np.abs(energy - energy[0])
    depth = energy[0] + 0.4
    early, late = off[:2000].max(), off[-2000:].max()
    assert early <= turn**order * depth
    assert late <= 1.2 * early
    # and no drift within what the swing leaves
    assert abs(energy[-50_000:].mean() - energy[:50_000].mean()) <= 0.1 * early


def test_explicit_euler_gains_energy_at_its_rate():
    """(1 + (omega dt)^2) a step on a linear contact, exactly."""
    dt, steps = 0.01, 3000
    motion = simulate(
        WHEEL,
        LinearLaw(WHEEL, np.zeros((1, 1))),
        time_step=dt,
        steps=steps,
        approach=np.array([1.001]),
        integrator=EXPLICIT_EULER,
    )
    energy = (motion.approach - 1) ** 2 + motion.velocity**2
    assert energy / 1e-6 == pytest.approx((1 + dt**2) ** steps, rel=1e-10)


@pytest.mark.parametrize("name", SYMPLECTIC)
def test_a_step_below_the_limit_is_bounded_and_one_above_is_not(name):
    """Bounded by an ellipse whose axes differ as 1 / sqrt(1 - omega dt / 2); beyond, by acosh((omega dt)^2 / 2 - 1)."""
    limit = SCHEMES[name].limit
    assert limit == 2.0
    law = LinearLaw(WHEEL, np.zeros((1, 1)))
    below = simulate(WHEEL, law, time_step=1.999, steps=20_000, approach=np.array([1.01]), integrator=SCHEMES[name])
    # from the invariant x^2 + v^2 - omega dt x v of symplectic Euler
    ratio = 1 / (1 - 1.999**2 / 4)
    assert max(below.highest[0] - 1, 1 - below.lowest[0]) <= 0.01 * math.sqrt(ratio) * 1.001
    states = SCHEMES[name].march(lambda _, x: -x, 1.0, 0.0, 2.01)
    size = np.array([abs(next(states)[0]) for _ in range(101)])
    assert math.log(size[100] / size[60]) / 40 == pytest.approx(math.acosh(2.01**2 / 2 - 1), rel=0.01)


def test_runge_kutta_is_bounded_up_to_its_limit():
    """A step of two cells: |R(i omega dt)| = 1 at 2 sqrt(2)."""
    assert RUNGE_KUTTA.limit == pytest.approx(2 * math.sqrt(2))
    for factor, bounded in ((0.99, True), (1.01, False)):
        states = RUNGE_KUTTA.march(lambda _, x: -x, 1.0, 0.0, factor * math.sqrt(2))
        size = np.array([abs(next(states)[0]) for _ in range(500)])
        assert (size.max() <= 1.0) == bounded


@pytest.mark.parametrize("name", SCHEMES)
def test_a_step_at_the_limit_is_refused_before_it_begins(name):
    """Explicit Euler, which has none, where all would miss the resonance."""
    limit = max(SCHEMES[name].limit, 2.0)
    cell = limit / SCHEMES[name].cells
    for time_step in (cell, 1.5 * cell, 1e9):
        law = Counted(HertzLaw(WHEEL))
        with pytest.raises(ValueError, match="time_step must be below"):
            simulate(WHEEL, law, time_step=time_step, steps=5, integrator=SCHEMES[name])
        assert not law.places
    law = Counted(HertzLaw(WHEEL))
    simulate(WHEEL, law, time_step=0.999 * cell, steps=5, integrator=SCHEMES[name])
    assert law.places


@pytest.mark.parametrize("name", SCHEMES)
def test_the_track_is_met_a_cell_a_step(name):
    """And two cells a step of Runge and Kutta, with its middle in the one between."""
    scheme, law = SCHEMES[name], Counted(HertzLaw(WHEEL))
    motion = simulate(WHEEL, law, time_step=0.1, steps=4, approach=np.ones(1), integrator=scheme)
    evaluations, cells = scheme.evaluations, scheme.cells
    assert len(law.places) == 4 * evaluations + 1
    middle = {1: [], 4: [1, 1, 2]}[evaluations]
    assert law.places == [cells * n + more for n in range(4) for more in (0, *middle)] + [4 * cells]
    assert motion.time_step == pytest.approx(cells * 0.1)


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        *[({"time_step": value}, "time_step") for value in (0.0, -0.1, np.nan, np.inf)],
        ({"steps": 0}, "steps"),
        ({"approach": np.array([np.nan, 1.0])}, "approach"),
        ({"approach": np.ones(2), "velocity": np.array([np.inf, 0.0])}, "velocity"),
        ({"approach": np.ones(2), "velocity": np.zeros(3)}, "alike"),
    ],
)
def test_motions_that_are_refused(changes, named):
    law = Counted(HertzLaw(WHEEL, 2))
    with pytest.raises(ValueError, match=named):
        simulate(WHEEL, law, **{"time_step": 0.1, "steps": 5, **changes})
    assert not law.places


# --- the period of a Hertz contact ------------------------------------------------------------------------------------


@pytest.mark.parametrize("highest", [1.1, 1.5, 1.84, 1.845, 2.0, 2.2, 3.0, 10.0, 100.0])
def test_period_of_free_vibration_by_small_steps(highest):
    """Lifted off from (5/2)^(2/3) = 1.842 on, where V = 0."""
    assert wheel_theory.hertz_period(highest) == pytest.approx(free_vibration_by_small_steps(highest), rel=1e-9)


@pytest.mark.parametrize("above", [0.05, 1e-2, 1e-4, 1e-7, 1e-12])
def test_the_period_of_the_smallest_vibrations(above):
    """Differences of the potential cancel there; the period does not, 1 + A^2 / 24 (Landau, Lifshitz, section 28)."""
    assert wheel_theory.hertz_period(1 + above) == pytest.approx(1 + above**2 / 24, abs=1e-10 + above**3 / 100)


@pytest.mark.parametrize("off", [-1e-3, -1e-7, -1e-12, 0.0, 1e-12, 1e-7, 1e-3])
def test_the_period_of_a_wheel_that_just_lifts_off(off):
    """Continuous and smooth: that of (5/2)^(2/3), by a slope of order one."""
    touch = 2.5 ** (2 / 3)
    expected = free_vibration_by_small_steps(touch)
    slope = (free_vibration_by_small_steps(touch + 0.01) - expected) / 0.01
    assert wheel_theory.hertz_period(touch + off) == pytest.approx(
        expected + slope * off, abs=1e-8 + off**2 + 0.05 * abs(off)
    )


@pytest.mark.parametrize("highest", [1.0, 0.5, -1.0, np.nan])
def test_no_period_without_a_vibration(highest):
    with pytest.raises(ValueError, match="highest"):
        wheel_theory.hertz_period(highest)


def test_eigenfrequency():
    wheel = Wheel(radius=0.5, mass=500.0, modulus=236.25e9, load=4905.0)
    found = wheel_theory.eigenfrequency(contact_radius=wheel.contact_radius, modulus=wheel.modulus, mass=wheel.mass)
    assert found == pytest.approx(wheel.eigenfrequency, rel=1e-14)
    # the stiffness of Hertz is the derivative of its force, by a central difference of error (e / d)^2 / 24
    e = 1e-3 * wheel.approach
    rise = np.diff(HertzLaw(wheel).force(0, wheel.approach + np.array([-e, e]))) / (2 * e)
    assert math.sqrt(rise[0] / wheel.mass) == pytest.approx(found, rel=1e-6)
    assert HertzLaw(wheel).force(0, np.array([wheel.approach])) == pytest.approx(4905.0, rel=1e-14)
    assert natural_periods(wheel, 2.0, 20.0) == pytest.approx(found * 0.1 / (2 * math.pi), rel=1e-14)


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


def test_steps_without_contact_are_counted_on_rough_tracks():
    height = track(400, 3, 0.5, shortest=20)
    law = springs_law(height, 12.5)
    motion = simulate(
        WHEEL, law, time_step=0.05, steps=800, velocity=np.array([0.0, -2.0, 0.1]), approach=np.ones(3), path=True
    )
    again = springs_law(height, 12.5)
    free = sum(again.force(n, motion.path[n]) == 0 for n in range(800))
    assert np.array_equal(motion.airborne, free)
    assert free.max() > 50


# --- motions that repeat themselves -----------------------------------------------------------------------------------


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


# --- spectra ----------------------------------------------------------------------------------------------------------


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


# --- boundary elements in the loop ------------------------------------------------------------------------------------


def strips(cells, height, wheels=1):
    """Low waves of a wavelength of three radii and more, on strips of 6 by 3 radii."""
    nx, ny = 6 * cells, 3 * cells
    x = 2 * np.pi * (np.arange(nx) + 0.5)[:, np.newaxis] / nx
    y = 2 * np.pi * (np.arange(ny) + 0.5) / ny
    return [height * (np.cos(2 * x + y + i) + np.cos(x - 0.4 * i)) for i in range(wheels)]


def three_dimensional(cells, height, steps=30, dt=0.1):
    """Motion on boundary elements and that of the linear law with the 3D filter, both over their motion at rest."""
    strip = strips(cells, height)[0]
    change = linear_force(strip, spacing=1 / cells, radius=1.0, modulus=1.0, approach=1.0) - 4 / 3
    law = LinearLaw(WHEEL, change[:, np.newaxis])
    d, v = law.steady_state(dt)
    settings = {"time_step": dt, "steps": steps, "velocity": v, "path": True}
    rest = BoundaryElementsLaw(WHEEL, [0 * strip], 1 / cells, tolerance=1e-6).at_rest(0)
    solved = BoundaryElementsLaw(WHEEL, [strip], 1 / cells, tolerance=1e-6)
    found = simulate(WHEEL, solved, approach=d - 1 + rest, **settings).path - rest
    expected = simulate(WHEEL, law, approach=d, **settings).path - 1
    assert solved.operator_applications > steps
    return found, expected


@pytest.mark.parametrize("cells", [4, 6])
def test_boundary_elements_in_the_loop_follow_linear_theory_in_three_dimensions(cells):
    """The residual tells 1e-6 of d; nonlinearity h / d; the grid, as for a ragged circle, (dx / a)^(3/2) or less."""
    height = 0.01
    found, expected = three_dimensional(cells, height)
    assert np.abs(expected).max() > 0.1 * height
    error = np.abs(found - expected).max() / np.abs(expected).max()
    assert error <= 2 * height + cells**-1.5


def test_wheels_on_boundary_elements_do_not_know_of_each_other():
    several = strips(4, 0.02, wheels=2)
    settings = {"time_step": 0.2, "steps": 20}
    together = simulate(WHEEL, BoundaryElementsLaw(WHEEL, several, 0.25), **settings)
    for i, strip in enumerate(several):
        alone = simulate(WHEEL, BoundaryElementsLaw(WHEEL, [strip], 0.25), **settings)
        assert np.array_equal(alone.acceleration[:, 0], together.acceleration[:, i])


def test_a_wheel_thrown_off_boundary_elements_comes_back():
    law = BoundaryElementsLaw(WHEEL, strips(4, 0.01), 0.25)
    motion = simulate(
        WHEEL, law, time_step=0.1, steps=30, approach=np.array([-0.03]), velocity=np.array([-0.5]), path=True
    )
    free = np.flatnonzero(motion.acceleration[:, 0] == -GRAVITY)
    assert motion.airborne[0] == free.size >= 15
    assert motion.highest[0] > 0.5


def test_a_contact_that_does_not_converge_raises():
    law = BoundaryElementsLaw(WHEEL, strips(4, 0.01), 0.25, tolerance=1e-30)
    with pytest.raises(bem3d.ConvergenceError, match="at place 0") as caught:
        simulate(WHEEL, law, time_step=0.1, steps=5)
    assert len(caught.value.history) > 1
    with pytest.raises(bem3d.ConvergenceError, match="at place 3"):
        law.force(3, np.array([1.0]))


def test_a_motion_is_frozen():
    motion = simulate(WHEEL, HertzLaw(WHEEL), time_step=0.1, steps=3)
    assert motion.path is None
    with pytest.raises(dataclasses.FrozenInstanceError):
        motion.time_step = 1.0
