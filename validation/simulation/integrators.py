"""Integrators of y'' = f(place, y): explicit and symplectic Euler, velocity Verlet, Runge and Kutta.

Each is a generator of position, velocity and f at the beginning of every step. Forces are known only
at whole cells of a track: one cell a step, or two cells where the scheme has half steps.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from validation.engine.engine import FloatArray

Acceleration = Callable[[int, FloatArray], FloatArray]
State = tuple[FloatArray, FloatArray, FloatArray]
Damping = float | FloatArray


@dataclass(frozen=True)
class Integrator:
    """A scheme of motion.

    march(f, y, v, dt): iterator of steps without end, dt of a cell; cells: of a step; limit: omega dt of a step up to
    which a linear vibration stays bounded.
    """

    name: str
    march: Callable[[Acceleration, FloatArray, FloatArray, float], Iterator[State]]
    limit: float
    cells: int = 1


def _explicit_euler(f: Acceleration, y: FloatArray, v: FloatArray, dt: float) -> Iterator[State]:
    place = 0
    while True:
        a = f(place, y)
        yield y, v, a
        y, v, place = y + dt * v, v + dt * a, place + 1


def _symplectic_euler(f: Acceleration, y: FloatArray, v: FloatArray, dt: float) -> Iterator[State]:
    place = 0
    while True:
        a = f(place, y)
        yield y, v, a
        v = v + dt * a
        y, place = y + dt * v, place + 1


def _runge_kutta(f: Acceleration, y: FloatArray, v: FloatArray, dt: float) -> Iterator[State]:
    place, h = 0, 2 * dt
    while True:
        a1 = f(place, y)
        yield y, v, a1
        v2 = v + dt * a1
        a2 = f(place + 1, y + dt * v)
        v3 = v + dt * a2
        a3 = f(place + 1, y + dt * v2)
        v4 = v + h * a3
        a4 = f(place + 2, y + h * v3)
        y, v, place = y + h / 6 * (v + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), place + 2


def velocity_verlet(rate: Damping = 0.0, share: Damping = 1.0) -> Integrator:
    """Velocity Verlet of y'' = share f - rate y', rate = c / m [1/s].

    Of arrays of shape (bodies, 1) each body has its own y, of which f has the sum, and velocities are (bodies, wheels).

    The new velocity is solved from its own damping: y_(n+1) - 2 y_n + y_(n-1) = dt^2 f_n - rate dt (y_(n+1) - y_(n-1))
    / 2, of second order, with the limit of the wheel without a dashpot.
    """

    def march(f: Acceleration, y: FloatArray, v: FloatArray, dt: float) -> Iterator[State]:
        place, a = 0, f(0, y)
        while True:
            yield y, v, a
            half = v + dt / 2 * (share * a - rate * v)
            y, place = y + dt * (half if isinstance(rate, float) else half.sum(axis=0)), place + 1
            a = f(place, y)
            v = (half + dt / 2 * share * a) / (1 + rate * dt / 2)

    return Integrator("velocity Verlet", march, limit=2.0)


EXPLICIT_EULER = Integrator("explicit Euler", _explicit_euler, limit=0.0)
SYMPLECTIC_EULER = Integrator("symplectic Euler", _symplectic_euler, limit=2.0)
VELOCITY_VERLET = velocity_verlet()
RUNGE_KUTTA = Integrator("Runge-Kutta", _runge_kutta, limit=2 * math.sqrt(2), cells=2)
INTEGRATORS = (EXPLICIT_EULER, SYMPLECTIC_EULER, VELOCITY_VERLET, RUNGE_KUTTA)
