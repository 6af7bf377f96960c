"""A rail that gives way: its impedance, the bodies that have it, and every contact on it in the time loop."""

import dataclasses
import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from tests.railway.power_law_ground import isotropic_strip
from tests.seeded import Times, catches
from tests.simulation.test_wheel_motion import strips
from tests.simulation.wheels import WHEEL, springs_law, track
from validation.railway.problems import wheel_on_rail
from validation.railway.problems.wheel_on_rail import WheelOnRail
from validation.scenes import rail_impedance
from validation.scenes.rail_impedance import FITTED, FreeBeam, RailBody, RailDashpot, impedance_of_bodies
from validation.scenes.wheel_body import DampedWheel
from validation.simulation.contact_laws import BoundaryElementsLaw, HertzLaw, LinearLaw, in_series
from validation.simulation.integrators import INTEGRATORS, velocity_verlet
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS_THAT_READ as SPRINGS
from validation.simulation.motion import simulate
from validation.theory.rolling import contact_resonance

RAIL_60 = FreeBeam(bending_stiffness=6.38e6, mass_per_length=60.2)
STEEL = DampedWheel(radius=0.46, mass=500.0, modulus=1.154e11, load=5e4)
DASHPOT, MASSIVE = RailDashpot(dashpot=1.5e5), RailDashpot(dashpot=1.5e5, mass=30.0)
RAILS = {"dashpot": DASHPOT, "dashpot and mass": MASSIVE, "free beam": RAIL_60}
SMALL = RailDashpot(dashpot=0.7, mass=0.5)
"""In units of `WHEEL`, M = 2 and k = 2."""


def on(rail, wheel=STEEL):
    return DampedWheel(**{**dataclasses.asdict(wheel), "rail": None} | {"rail": rail})


# --- impedances ---


@catches("the root of two of the beam's impedance").at(
    "validation.scenes.rail_impedance.FreeBeam.factor", Times(math.sqrt(0.5))
)
@catches("an impedance that falls as that of a stiffness").at(
    "validation.scenes.rail_impedance.FreeBeam.impedance",
    lambda beam, omega: beam.factor * np.sqrt(-1j * np.asarray(omega)),
)
def test_a_beam_moves_as_the_integral_over_its_waves():
    """u / F = (1 / 2 pi) int dk / (EI k^4 - rho A w^2), the loss of the beam small, beside Z = 2 rho A c_B (1 + i)."""
    omega, loss = 2 * math.pi * 600.0, 0.1
    stiffness = 6.38e6 * (1 + 1j * loss)

    def integrand(k):
        return 1 / (stiffness * k**4 - 60.2 * omega**2) / math.pi

    k_b = (60.2 * omega**2 / 6.38e6) ** 0.25
    panels = k_b * np.array([0, 0.8, 0.9, 0.95, 1, 1.05, 1.1, 1.2, 2, 10, 100])
    parts = [
        sum(quad(lambda k, part=part: getattr(integrand(k), part), *ends)[0] for ends in pairwise(panels))
        for part in ("real", "imag")
    ]
    lossy = FreeBeam(bending_stiffness=6.38e6, mass_per_length=60.2).impedance(omega) * (1 + 1j * loss) ** 0.25
    assert 1 / (1j * omega * complex(*parts)) == pytest.approx(complex(lossy), rel=1e-5)
    c_b = omega / k_b
    assert complex(RAIL_60.impedance(omega)) == pytest.approx(2 * 60.2 * c_b * (1 + 1j), rel=1e-12)


@catches("waves beyond the outermost bodies left out").at("validation.scenes.rail_impedance.TAIL", 1.0)
@catches("factor 2 in the mobility of the bodies").at("validation.scenes.rail_impedance.math.pi", 2 * math.pi)
def test_the_bodies_have_the_impedance_of_the_beam_within_a_per_cent():
    omega = 2 * math.pi * np.geomspace(*FITTED, 300)
    bodies = RAIL_60.bodies(1e-5)
    assert all(body.mass > 0 and body.dashpot > 0 for body in bodies)
    off = np.abs(impedance_of_bodies(bodies, omega) / RAIL_60.impedance(omega) - 1)
    assert 0.003 < off.max() < 0.01


def test_more_bodies_have_it_more_closely(monkeypatch):
    """The trapezoidal rule errs as exp(-pi^2 / step) of ln p, beside the tails."""
    omega, off = 2 * math.pi * np.geomspace(*FITTED, 300), []
    monkeypatch.setattr(rail_impedance, "TAIL", 1e4)
    for bodies in (10, 14, 18):
        monkeypatch.setattr(rail_impedance, "BODIES", bodies)
        off.append(np.abs(impedance_of_bodies(RAIL_60.bodies(), omega) / RAIL_60.impedance(omega) - 1).max())
    steps = np.log(5000 / 20 * 1e8) / (np.array([10, 14, 18]) - 1)
    assert np.log(off) == pytest.approx(np.log(2) - math.pi**2 / steps, abs=0.4)


def test_the_contact_resonance_is_where_the_mobilities_cancel():
    """Of a mass on a mass, sqrt(k (1/M + 1/m)); on a dashpot as on a rigid rail; on a beam above it."""
    wheel = {"stiffness": 1e9, "mass": 500.0}
    heavy = contact_resonance(impedance=lambda w: np.asarray(1j * w * 50.0), **wheel)
    assert heavy == pytest.approx(math.sqrt(1e9 * (1 / 500 + 1 / 50)), rel=1e-9)
    assert contact_resonance(impedance=DASHPOT.impedance, **wheel) == pytest.approx(math.sqrt(1e9 / 500), rel=1e-9)
    beam = contact_resonance(impedance=RAIL_60.impedance, **wheel)
    assert 3.5e3 < beam < 5e3 and 1e5 < abs(RAIL_60.impedance(beam)) < 3e5


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (lambda: RailDashpot(dashpot=0.0), "rail.impedance.dashpot"),
        (lambda: RailDashpot(dashpot=1.0, mass=-1.0), "rail.impedance.mass must be zero or positive, got -1"),
        (lambda: FreeBeam(bending_stiffness=-1.0, mass_per_length=60.0), "rail.bending_stiffness"),
        (lambda: FreeBeam(bending_stiffness=1.0, mass_per_length=math.nan), "rail.mass_per_length"),
    ],
)
def test_impedances_that_are_refused(make, named):
    with pytest.raises(ValueError, match=named):
        make()


# --- linear contact, over frequency ---


def receptances(rail, omega):
    """Approach over dF of the linear contact by closed forms: wheel and rail in series, on the contact spring."""
    moves = -1 / (STEEL.mass * omega**2) + 1 / (1j * omega * rail.impedance(omega))
    return -moves / (1 + STEEL.stiffness * moves)


def steady(rail, frequency, points):
    """Approach over dF of a sine, from the time loop, and how far its state moves in a period."""
    wheel, change = on(rail), 1000.0 * np.cos(2 * np.pi * np.arange(points) / points)[:, np.newaxis]
    law, dt = LinearLaw(wheel, change), 1 / (frequency * points)
    d, v = law.steady_state(dt)
    motion = simulate(wheel, law, time_step=dt, steps=points, approach=d, velocity=v, path=True)
    moved = max(
        np.abs(motion.approach - d).max() / np.ptp(motion.path), np.abs(motion.velocity - v).max() / np.abs(v).max()
    )
    return 2 * np.fft.rfft(motion.path[:, 0] - wheel.approach)[1] / points / 1000.0, moved


@catches("a rail that moves towards the wheel", "free beam", 700.0).at(
    "validation.simulation.contact_laws.in_series",
    lambda stiffness: in_series(np.concatenate([stiffness[:1], -stiffness[1:]])),
)
@catches("the rail forgotten", "dashpot and mass", 700.0).at(
    "validation.simulation.contact_laws.in_series", lambda stiffness: stiffness[0]
)
@pytest.mark.parametrize("frequency", [90.0, 240.0, 700.0, 2000.0])
@pytest.mark.parametrize("name", list(RAILS))
def test_a_linear_contact_answers_roughness_as_receptances_over_frequency_say(name, frequency):
    """Of second order in the time step, of first for a dashpot without a mass; a beam within its bodies' 1 %."""
    exact = receptances(RAILS[name], 2 * math.pi * frequency)
    answers = [steady(RAILS[name], frequency, points) for points in (200, 400)]
    assert max(moved for _, moved in answers) < 1e-6
    off = np.abs([answer / exact - 1 for answer, _ in answers])
    if name == "free beam":
        assert off[1] < 0.01
    else:
        assert off[1] < 0.02
        assert off[0] / off[1] == pytest.approx({"dashpot": 2, "dashpot and mass": 4}[name], rel=0.1)


@pytest.mark.parametrize("points", [50, 51, 2])
def test_the_steady_state_on_a_rail_repeats_itself(points):
    wheel, change = on(SMALL, WHEEL), np.random.default_rng(points).normal(size=(points, 2))
    change -= change.mean(axis=0)
    law = LinearLaw(wheel, change)
    d, v = law.steady_state(0.3)
    motion = simulate(wheel, law, time_step=0.3, steps=points, approach=d, velocity=v)
    assert v.shape == (2, 2)
    assert np.abs(motion.approach - d).max() < 1e-12 and np.abs(motion.velocity - v).max() < 1e-12


# --- every contact ---

LAWS = {
    "springs": lambda wheel: springs_law(track(200, 1, 0.2), 12.5),
    "linear": lambda wheel: LinearLaw(wheel, track(200, 1, 0.2)),
    "Hertz": lambda wheel: HertzLaw(WHEEL),
    "BEM": lambda wheel: BoundaryElementsLaw(WHEEL, strips(4, 0.02), 0.25, tolerance=1e-9),
}


@catches("a rail that follows half of the force", "springs").at(
    "validation.simulation.motion.velocity_verlet",
    lambda rate, share: velocity_verlet(rate, np.where(np.arange(len(share))[:, np.newaxis] > 0, share / 2, share)),
)
@pytest.mark.parametrize("name", [*list(LAWS)[:3], pytest.param("BEM", marks=pytest.mark.slow)])
def test_every_contact_moves_wheel_and_rail_by_the_same_force(name):
    """d = y_w + u with M y_w'' = F_N - F and m u'' + c u' = F_N - F by central differences, after a throw."""
    wheel, dt, steps = on(SMALL, WHEEL), 0.05, 60
    law = LAWS[name](wheel)
    start = np.array([[-1.0], [0.0]])
    motion = simulate(wheel, law, time_step=dt, steps=steps, approach=np.array([-0.05]), velocity=start, path=True)
    d, force = motion.path[:, 0], np.array([law.force(n, motion.path[n])[0] for n in range(steps)])
    assert np.abs(force - motion.force[:, 0]).max() < 1e-6
    free = 4 / 3 - force
    assert np.abs(motion.acceleration[:, 0] + free / 2).max() < 1e-6
    y, u = np.zeros(steps), np.zeros(steps)
    # leapfrog of both, from the force alone
    y[1], u[1] = -dt + dt**2 / 2 * free[0] / 2, dt**2 / 2 * free[0] / SMALL.mass
    inertia, dashpot = SMALL.mass / dt**2, SMALL.dashpot / (2 * dt)
    for n in range(1, steps - 1):
        y[n + 1] = 2 * y[n] - y[n - 1] + dt**2 * free[n] / 2
        u[n + 1] = (free[n] + 2 * inertia * u[n] - (inertia - dashpot) * u[n - 1]) / (inertia + dashpot)
    assert np.abs(d - d[0] - y - u).max() < 1e-9
    if name != "linear":
        assert motion.airborne[0] == np.count_nonzero(force == 0) > 5


@catches("a rail that drives the wheel").at(
    "validation.scenes.rail_impedance.RailDashpot.bodies",
    lambda rail, time_step: (RailBody(rail.mass, -rail.dashpot),),
)
def test_the_rail_takes_the_energy_that_its_dashpot_turns_to_heat():
    """E = M y'^2 / 2 + m u'^2 / 2 + V(d), thrown off and back; dE = -c int u'^2 dt to second order."""
    errors = []
    for dt in (0.02, 0.01, 0.005):
        wheel, steps = on(SMALL, WHEEL), round(12 / dt)
        states = [(np.array([1.9]), np.zeros((2, 1)))]
        energies, heat = [], 0.0
        for _ in range(steps):
            d, v = states[-1]
            motion = simulate(wheel, HertzLaw(WHEEL), time_step=dt, steps=1, approach=d, velocity=v)
            states.append((motion.approach, motion.velocity))
        d, v = np.array([d[0] for d, _ in states]), np.array([v[:, 0] for _, v in states])
        potential = 8 / 15 * np.maximum(d, 0.0) ** 2.5 - 4 / 3 * d
        energies = v[:, 0] ** 2 + SMALL.mass / 2 * v[:, 1] ** 2 + potential
        heat = np.concatenate([[0.0], np.cumsum(SMALL.dashpot * dt * (v[1:, 1] ** 2 + v[:-1, 1] ** 2) / 2)])
        errors.append(np.abs(energies + heat - energies[0]).max())
        assert heat[-1] > 0.3 * (energies[0] + 0.8)
    assert errors[-1] < 1e-4
    assert -np.diff(np.log2(errors)) == pytest.approx(2, abs=0.2)


@pytest.mark.parametrize("name", list(RAILS))
def test_a_free_vibration_on_a_rail_dies_even_close_to_the_largest_step(name):
    rail = RAILS[name]
    largest = 2 / math.sqrt(STEEL.stiffness * (1 / STEEL.mass + sum(1 / b.mass for b in rail.bodies(1e-5))))
    if name == "dashpot":
        # its mass is c dt / 2: k (1/M + 2 / (c dt)) dt^2 = 4
        k, m, c = STEEL.stiffness, STEEL.mass, rail.dashpot
        largest = (-2 / c + math.sqrt(4 / c**2 + 16 / (k * m))) * m / 2
    wheel = on(rail)
    law = LinearLaw(wheel, np.zeros((1, 1)))
    start = np.array([1.5 * wheel.approach])
    motion = simulate(wheel, law, time_step=0.98 * largest, steps=20_000, approach=start, path=True)
    off = np.abs(motion.path[:, 0] / wheel.approach - 1)
    assert off[-1000:].max() < 0.05 * off[:1000].max()
    with pytest.raises(ValueError, match=r"time_step must be below .* of wheel and rail on the contact dt = "):
        simulate(wheel, law, time_step=1.02 * largest, steps=10, approach=start)


def test_other_schemes_are_refused_on_a_rail_that_gives_way():
    for scheme in INTEGRATORS:
        if scheme.name != "velocity Verlet":
            with pytest.raises(ValueError, match="integrator must be velocity Verlet for a wheel on a rail that gives"):
                simulate(on(SMALL, WHEEL), HertzLaw(WHEEL), time_step=0.1, steps=5, integrator=scheme)


@catches("a rail forgotten in the problem", SPRINGS).at(
    "validation.railway.problems.wheel_on_rail.DampedWheel", lambda rail, **settings: DampedWheel(**settings)
)
@pytest.mark.parametrize("model", [pytest.param(BEM, marks=pytest.mark.slow), SPRINGS])
def test_a_wheel_on_a_beam_follows_little_roughness_as_the_linear_contact_does(model):
    """Force over dF of each wave in the steady state, (1 + k R)^-1 of closed forms, past the bodies' 1 %."""
    strip = isotropic_strip(3e-8, 0.36, 1e-3)
    case = WheelOnRail(strip=strip, mass=500.0, speed=22.0, model=model, tolerance=1e-6, rail=RAIL_60, rounds=(1, 1))
    _, force = wheel_on_rail.in_motion(case, case.law())
    change = case.linear.change[:, 0]
    waves, driven = np.fft.rfft(force), np.fft.rfft(change)
    kept = np.abs(driven) > 0.2 * np.abs(driven).max()
    omega = 2 * np.pi * np.fft.rfftfreq(change.size, case.time_step)[kept]
    moves = -1 / (500.0 * omega**2) + 1 / (1j * omega * RAIL_60.impedance(omega))
    expected = 1 / (1 + case.wheel.stiffness * moves)
    assert kept.sum() > 8
    assert np.abs(waves[kept] / driven[kept] / expected - 1).max() < 0.15
