"""Time stepping: order, energy and limit of every scheme; the period of free vibration on a Hertz contact."""

import dataclasses
import math

import numpy as np
import pytest

from tests.oracles import free_vibration_by_small_steps
from tests.seeded import catches
from tests.simulation.wheels import SCHEMES, SYMPLECTIC, WHEEL, Counted
from validation.scenes.wheel_body import Wheel
from validation.simulation import integrators
from validation.simulation.contact_laws import HertzLaw
from validation.simulation.motion import natural_periods, simulate
from validation.theory import rolling as wheel_theory

ORDERS = {"explicit Euler": 1, "symplectic Euler": 1, "velocity Verlet": 2, "Runge-Kutta": 4}


def after(name, cells, turns):
    """Approach and velocity after so many small natural periods, on a Hertz contact released at 1.5 d_N."""
    scheme = SCHEMES[name]
    dt = 2 * math.pi * turns / cells
    steps = cells // scheme.cells
    motion = simulate(WHEEL, HertzLaw(WHEEL), time_step=dt, steps=steps, approach=np.array([1.5]), integrator=scheme)
    assert motion.duration == pytest.approx(2 * math.pi * turns, rel=1e-12)
    return np.array([motion.approach[0], motion.velocity[0]])


def half_a_step(scheme):
    """Forces at the right cells, steps of half their length."""
    return dataclasses.replace(scheme, march=lambda f, y, v, dt: scheme.march(f, y, v, dt / 2))


@catches("the step of a cell for that of two in Runge and Kutta", name="Runge-Kutta").at(
    f"{__name__}.SCHEMES", {**SCHEMES, "Runge-Kutta": half_a_step(integrators.RUNGE_KUTTA)}
)
@pytest.mark.parametrize("name", SCHEMES)
def test_order_of_a_scheme_on_a_free_vibration(name):
    """At a place that is no turning point, where symplectic Euler would be better than it is."""
    exact = free_vibration_by_small_steps(1.5, turns=0.8)
    cells = {1: (400, 800, 1600, 3200), 2: (100, 200, 400, 800), 4: (40, 80, 160, 320)}[ORDERS[name]]
    errors = [np.abs(after(name, n, 0.8) - exact).max() for n in cells]
    assert -np.diff(np.log2(errors)) == pytest.approx(ORDERS[name], abs=0.2)


def energies(name, turn, steps, highest):
    """v^2 / 2 + V(d) of a free vibration on a Hertz contact, on and on."""

    def acceleration(_, d):
        return 2 / 3 * (1 - d * math.sqrt(d)) if d > 0 else 2 / 3

    states = SCHEMES[name].march(acceleration, highest, 0.0, turn)
    state = np.array([next(states)[:2] for _ in range(steps)])
    return state[:, 1] ** 2 / 2 + 2 / 3 * (0.4 * np.maximum(state[:, 0], 0) ** 2.5 - state[:, 0])


def old_force_in_the_velocity(f, y, v, dt):
    """Velocity Verlet whose velocity has the force of the beginning alone: d is of first order then."""
    place = 0
    while True:
        a = f(place, y)
        yield y, v, a
        y, v, place = y + dt * v + dt**2 / 2 * a, v + dt * a, place + 1


@catches("velocity Verlet with the force of the beginning alone", name="velocity Verlet", highest=1.5).at(
    f"{__name__}.SCHEMES",
    {
        **SCHEMES,
        "velocity Verlet": dataclasses.replace(integrators.VELOCITY_VERLET, march=old_force_in_the_velocity),
    },
)
@pytest.mark.parametrize("name", SYMPLECTIC)
@pytest.mark.parametrize("highest", [1.5, 2.5])
def test_symplectic_schemes_keep_the_energy(name, highest):
    """They swing about it by their order in omega dt, with or without lift-off, however long."""
    turn, order = 0.02, ORDERS[name]
    energy = energies(name, turn, 100_000, highest)
    off = np.abs(energy - energy[0])
    depth = energy[0] + 0.4
    early, late = off[:2000].max(), off[-2000:].max()
    assert early <= turn**order * depth
    assert late <= 1.2 * early
    # and no drift within what the swing leaves
    assert abs(energy[-50_000:].mean() - energy[:50_000].mean()) <= 0.1 * early


@pytest.mark.parametrize(
    ("name", "highest"), [("symplectic Euler", 11.0), ("velocity Verlet", 11.0), ("Runge-Kutta", 1.0)]
)
def test_a_step_below_the_limit_is_bounded_and_one_above_is_not(name, highest):
    """Of symplectic schemes by an ellipse whose axes differ as 1 / sqrt(1 - (omega dt / 2)^2); a step of Runge and
    Kutta multiplies by |R(i omega dt)|, one at 2 sqrt(2)."""
    scheme = SCHEMES[name]
    assert scheme.limit == pytest.approx(2 * math.sqrt(2) if name == "Runge-Kutta" else 2.0)
    for factor, bounded in ((0.995, True), (1.01, False)):
        states = scheme.march(lambda _, x: -x, 1.0, 0.0, factor * scheme.limit / scheme.cells)
        size = np.array([abs(next(states)[0]) for _ in range(500)])
        assert (size.max() <= highest) == bounded


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
    cells, middle = scheme.cells, [1, 1, 2] if name == "Runge-Kutta" else []
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
