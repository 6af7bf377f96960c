"""(14.15) and (14.16): a wheel that rolls over a rough track, for any contact force."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mdr.checks import positive
from validation.engine.engine import FloatArray
from validation.scenes.rail_impedance import RailBody
from validation.scenes.wheel_body import Wheel, moving_bodies
from validation.simulation.contact_laws import ContactLaw, LinearLaw
from validation.simulation.integrators import VELOCITY_VERLET, Integrator, velocity_verlet


@dataclass(frozen=True, eq=False, kw_only=True)
class Motion:
    """Wheels at the beginning of each step.

    acceleration: z'' upward, shape (steps, wheels) [m/s^2]; time_step: of the record [s]; lowest, highest: approach of
    each wheel [m]; airborne: steps of each wheel without contact; initial_velocity: d' at first [m/s]; approach,
    velocity, next_acceleration: d [m], d' [m/s] and z'' [m/s^2] after the last step; path, force: d and F at each
    step, shape (steps, wheels), None unless they were asked for. On a rail that gives way velocities are those of the
    wheel, downward, and of each body of the rail, upward, whose sum is d', shape (1 + bodies, wheels).
    """

    acceleration: FloatArray
    time_step: float
    lowest: FloatArray
    highest: FloatArray
    airborne: NDArray[np.int64]
    initial_velocity: FloatArray
    approach: FloatArray
    velocity: FloatArray
    next_acceleration: FloatArray
    path: FloatArray | None = None
    force: FloatArray | None = None

    @property
    def duration(self) -> float:
        """T = N dt [s]."""
        return len(self.acceleration) * self.time_step

    @property
    def jump(self) -> FloatArray:
        """The step of the acceleration from the end of the record to its beginning, which leaks, (wheels,) [m/s^2]."""
        return np.asarray(self.next_acceleration - self.acceleration[0])


def _integrator_of(bodies: Sequence[RailBody], integrator: Integrator) -> Integrator:
    """The integrator for bodies with dashpots, the wheel first: velocity Verlet alone has them. Raises ValueError."""
    wheel, *rail = bodies
    if (wheel.dashpot or rail) and integrator is not VELOCITY_VERLET:
        kind = "on a rail that gives way" if rail else "with damping"
        raise ValueError(f"integrator must be {VELOCITY_VERLET.name} for a wheel {kind}, got {integrator.name}")
    if not rail:
        return velocity_verlet(wheel.dashpot / wheel.mass) if wheel.dashpot else integrator
    mass, dashpot = (np.array(column)[:, np.newaxis] for column in zip(*bodies, strict=True))
    return velocity_verlet(dashpot / mass, wheel.mass / mass)


def simulate(
    wheel: Wheel,
    law: ContactLaw,
    *,
    time_step: float,
    steps: int,
    approach: FloatArray | None = None,
    velocity: FloatArray | None = None,
    integrator: Integrator = VELOCITY_VERLET,
    path: bool = False,
) -> Motion:
    """M z'' = F(x, d) - F_N - c z', d'' = -z'', one cell of the track in each time step dx / v_0.

    On a rail that gives way d = -z - sum of u_j, m_j u_j'' = F - F_N - c_j u_j' of each body of the rail, downward.

    law: the contact force of all wheels, which advance together; time_step: of one cell [s]; steps: that are recorded;
    approach, velocity: as in `Motion`, at the beginning, by default static equilibrium over the first cell [m, m/s];
    integrator: symplectic and of second order by default, the only one for a wheel with a dashpot; path: whether to
    keep approaches and forces.
    Wheels may lose contact, F = 0, and come back; the dashpot, between wheel and inertial frame, acts on.
    Raises ValueError for a step at or past the limit of the integrator, omega_eigen dt, before it begins.
    """
    step, bodies = integrator.cells * positive("time_step", time_step), moving_bodies(wheel, time_step)
    _check_stable(wheel, bodies, step, integrator)
    if steps < 1:
        raise ValueError(f"steps must be at least 1, got {steps}")
    d, v = _start(law, len(bodies), approach, velocity)
    gravity, rate = wheel.load / wheel.mass, bodies[0].dashpot / wheel.mass
    integrator = _integrator_of(bodies, integrator)

    def lifted(a: FloatArray, v: FloatArray) -> FloatArray:
        return np.negative(a - rate * (v if len(bodies) == 1 else v[0]))

    def acceleration(place: int, d: FloatArray) -> FloatArray:
        return np.asarray(gravity - law.force(place, d) / wheel.mass)

    states = integrator.march(acceleration, d, v, time_step)
    record, initial_velocity = np.empty((steps, d.size)), v
    paths, forces = np.empty((2, steps, d.size)) if path else (None, None)
    lowest, highest, airborne = d, d, np.zeros(d.size, dtype=np.int64)
    for n in range(steps):
        d, v, a = next(states)
        record[n], airborne = lifted(a, v), airborne + (a >= gravity)
        lowest, highest = np.minimum(lowest, d), np.maximum(highest, d)
        if paths is not None and forces is not None:
            paths[n], forces[n] = d, wheel.load - wheel.mass * a
    d, v, a = next(states)
    return Motion(
        acceleration=record,
        time_step=step,
        lowest=lowest,
        highest=highest,
        airborne=airborne,
        initial_velocity=initial_velocity,
        approach=d,
        velocity=v,
        next_acceleration=lifted(a, v),
        path=paths,
        force=forces,
    )


def _start(
    law: ContactLaw, bodies: int, approach: FloatArray | None, velocity: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """Approach and velocities at the beginning, by default static equilibrium. Raises ValueError."""
    d = law.at_rest(0) if approach is None else np.array(approach, dtype=np.float64)
    each = d.shape if bodies == 1 else (bodies, *d.shape)
    v = np.zeros(each) if velocity is None else np.array(velocity, dtype=np.float64)
    if not (np.isfinite(d).all() and np.isfinite(v).all() and v.shape == each):
        raise ValueError(f"approach and velocity must be finite and alike in shape, {each}, got {d} and {v}")
    return d, v


def simulate_from_linear_motion(
    law: ContactLaw, linear: LinearLaw, time_step: float, steps: int, *, path: bool = False
) -> Motion:
    """A wheel that begins in the steady state of the linear law, at its velocity and its force."""
    approach, velocity = linear.steady_state(time_step)
    start = law.at_rest(0) + approach - linear.at_rest(0)
    return simulate(linear.wheel, law, time_step=time_step, steps=steps, approach=start, velocity=velocity, path=path)


def periodic_motion(
    wheel: Wheel,
    law: Callable[[int], ContactLaw],
    *,
    time_step: float,
    steps: int,
    start: tuple[FloatArray, FloatArray],
    tolerance: float = 1e-9,
    rounds: int = 12,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Initial approach and velocity of the motion that has the period of the track: without free vibration.

    By shooting: the change of the state over one round of the track must vanish. Its derivative, by differences from
    two neighbours of each wheel, is computed once.
    law(n): the contact of n copies of all wheels, copy after copy; start: first guess; tolerance: of the residual;
    rounds: at most, after the first.
    Returns approach, velocity and residual of each wheel, the change over a round over d_N; a wheel whose residual
    exceeds the tolerance has not converged.
    Best conditioned where a round takes a whole number of natural periods and a half.
    """
    d, v = (np.array(x, dtype=np.float64) for x in start)
    small = 1e-6 * wheel.approach
    omega = wheel.eigenfrequency

    def after(n: int, d: FloatArray, v: FloatArray) -> FloatArray:
        motion = simulate(wheel, law(n), time_step=time_step, steps=steps, approach=d, velocity=omega * v)
        return np.stack([motion.approach, motion.velocity / omega]).reshape(2, n, -1)

    v = v / omega
    near = after(3, np.concatenate([d, d + small, d]), np.concatenate([v, v, v + small]))
    derivative = np.moveaxis((near[:, 1:] - near[:, :1]) / small, -1, 0)
    newton = np.moveaxis(np.linalg.inv(np.eye(2) - derivative), 0, -1)
    state, image = np.stack([d, v]), near[:, 0]
    residual = np.abs(image - state).max(axis=0) / wheel.approach
    for _ in range(rounds):
        if (residual <= tolerance).all():
            break
        (r, s), ((a, b), (c, e)) = image - state, newton
        step = np.clip(np.stack([a * r + b * s, c * r + e * s]), -wheel.approach / 2, wheel.approach / 2)
        # a wheel that has converged stays as it is, so that its bits do not depend on the others
        state = np.where(residual > tolerance, state + step, state)
        image = after(1, *state)[:, 0]
        residual = np.abs(image - state).max(axis=0) / wheel.approach
    return state[0], omega * state[1], residual


def natural_periods(wheel: Wheel, length: float, speed: float) -> float:
    """Natural periods that pass while the wheel rolls a length [-]."""
    return wheel.eigenfrequency * length / speed / (2 * math.pi)


def _check_stable(wheel: Wheel, bodies: Sequence[RailBody], step: float, integrator: Integrator) -> None:
    """Raise ValueError where omega times the step [s] reaches the limit of the integrator.

    omega^2 = k sum of 1 / m: omega_eigen of a wheel, and what Verlet needs of a rail whatever its dashpots are.
    """
    omega = wheel.eigenfrequency if len(bodies) == 1 else math.sqrt(wheel.stiffness * sum(1 / b.mass for b in bodies))
    limit = max(integrator.limit, 2.0)
    if omega * step >= limit:
        why = "the motion would grow without bound"
        if not integrator.limit:
            why = "the motion grows at any step, and from 2 on nothing would be left of it"
        name = "omega_eigen" if len(bodies) == 1 else "omega of wheel and rail on the contact"
        raise ValueError(
            f"time_step must be below {limit:.6g} / {name} = {limit / omega:.6g} s for "
            f"{integrator.name}, got {step:.6g} s: {name} dt = {omega * step:.6g}, and {why}"
        )
