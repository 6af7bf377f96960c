"""Free vibration of the wheel of Table 14.1 by every scheme, and the theory of one step."""

import math
from dataclasses import dataclass
from itertools import islice

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from validation.analysis.statistics import Estimate
from validation.engine.engine import FloatArray, Outcome
from validation.scenes.wheel_body import Wheel
from validation.simulation.contact_laws import ContactLaw, HertzLaw, LinearLaw
from validation.simulation.integrators import (
    EXPLICIT_EULER,
    INTEGRATORS,
    RUNGE_KUTTA,
    SYMPLECTIC_EULER,
    VELOCITY_VERLET,
    Integrator,
)

WHEEL = Wheel(radius=0.5, mass=500.0, modulus=236.25e9, load=4905.0)
"""Table 14.1, and the load M g."""
SPEED = 20.0
SCHEMES = {scheme.name: scheme for scheme in INTEGRATORS}
LIFT_OFF = 2.5 ** (2 / 3)
"""Released from a greater approach over d_N, a wheel on a Hertz contact loses contact: V(LIFT_OFF) = V(0)."""
TENTHS = 10


@dataclass(frozen=True, kw_only=True)
class Vibrations:
    """Free linear vibration by one scheme, in steps omega_eigen dt."""

    scheme: str
    steps: tuple[float, ...]
    natural_periods: int


@dataclass(frozen=True, kw_only=True)
class LongRun:
    """A very long free vibration on a Hertz contact, dt = a / 100 / v_0."""

    scheme: str
    highest: tuple[float, ...]
    steps: int

    @property
    def omega_dt(self) -> float:
        return WHEEL.eigenfrequency * WHEEL.contact_radius / 100 / SPEED


def march(
    scheme: Integrator, law: ContactLaw, omega_dt: float, d: FloatArray, steps: int
) -> tuple[FloatArray, FloatArray]:
    """u = d / d_N and u' / omega_eigen, shape (steps, wheels), from rest at d; omega_dt: omega_eigen times a step."""

    def acceleration(place: int, d: FloatArray) -> FloatArray:
        return np.asarray((WHEEL.load - law.force(place, d)) / WHEEL.mass)

    time_step = omega_dt / WHEEL.eigenfrequency / scheme.cells
    states = islice(scheme.march(acceleration, d, np.zeros_like(d), time_step), steps)
    y, v, _ = map(np.stack, zip(*states, strict=True))
    return y / WHEEL.approach, v / (WHEEL.approach * WHEEL.eigenfrequency)


def vibrate(problem: Vibrations) -> Outcome:
    """Growth and angle of a step, of each step, and the largest change of the energy in the first natural period."""
    scheme, law, rows = SCHEMES[problem.scheme], LinearLaw(WHEEL, np.zeros((1, 1))), []
    for x in problem.steps:
        steps = max(24, math.ceil(problem.natural_periods * 2 * math.pi / x))
        u, v = march(scheme, law, x, np.array([2 * WHEEL.approach]), steps)
        factor = eigenvalue(u[:, 0] - 1, max(1, int(math.pi / 2 / x)))
        energy = ((u - 1) ** 2 + v**2)[: math.ceil(2 * math.pi / x) + 1, 0]
        rows.append((abs(factor), np.angle(factor), np.abs(energy - 1).max()))
    growth, angle, change = np.array(rows).T
    return {"growth": growth, "angle": angle, "change": change}


def eigenvalue(y: FloatArray, stride: int) -> complex:
    """lambda of largest modulus in y_n = sum c_i lambda_i^n, of two: from y_{n+m} = trace y_n - det y_{n-m}."""
    before, now, after = y[: -2 * stride], y[stride:-stride], y[2 * stride :]
    trace, minus_det = np.linalg.lstsq(np.stack([now, before], axis=1), after, rcond=None)[0]
    roots = np.roots([1.0, -trace, -minus_det])
    largest = complex(roots[np.argmax(np.abs(roots))])
    return complex(abs(largest) ** (1 / stride) * np.exp(1j * abs(np.angle(largest)) / stride))


def amplification(scheme: str, x: FloatArray) -> NDArray[np.complex128]:
    """lambda of a step of the scheme for y'' = -omega^2 y, x = omega dt, the larger of both, angle in [0, pi].

    Explicit Euler: 1 + i x; Runge-Kutta: the series of exp(i x) up to x^4; symplectic Euler and Verlet:
    lambda + 1/lambda = 2 - x^2, so that the frequency is (2 / dt) asin(x / 2) up to x = 2.
    """
    z = 1j * np.asarray(x, dtype=np.float64)
    if scheme == EXPLICIT_EULER.name:
        return np.asarray(1 + z)
    if scheme == RUNGE_KUTTA.name:
        series = 1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24
        return np.asarray(series.real + 1j * np.abs(series.imag))
    half = z.imag / 2
    return np.where(half < 1, np.exp(2j * np.arcsin(np.minimum(half, 1))), -np.exp(2 * np.arccosh(np.maximum(half, 1))))


def first_period(scheme: str, x: FloatArray) -> FloatArray:
    """Largest relative change of the energy within a natural period, released at rest.

    Explicit Euler: (1 + x^2)^n - 1 after n = 2 pi / x steps; Runge-Kutta: 1 - (1 - x^6 / 72 + x^8 / 576)^n, since
    |lambda|^2 is that; symplectic Euler keeps u^2 + u'^2 - x u u', so z / (1 - z) with z = x / 2; Verlet keeps
    u^2 (1 - x^2 / 4) + u'^2, so x^2 / 4.
    """
    n = np.ceil(2 * np.pi / x)
    changes = {
        EXPLICIT_EULER.name: np.expm1(n * np.log1p(x**2)),
        SYMPLECTIC_EULER.name: x / 2 / (1 - x / 2),
        VELOCITY_VERLET.name: x**2 / 4,
        RUNGE_KUTTA.name: -np.expm1(n * np.log1p(-(x**6) / 72 + x**8 / 576)),
    }
    return np.asarray(changes[scheme])


def long_run(problem: LongRun) -> Outcome:
    """Means in each tenth, over the beginning, of the energy and of what Verlet keeps in its place, of each release."""
    scheme, highest = SCHEMES[problem.scheme], np.array(problem.highest)
    tenth = problem.steps // TENTHS
    law, d = HertzLaw(WHEEL, highest.size), WHEEL.approach * highest
    u, v = march(scheme, law, problem.omega_dt, d, TENTHS * tenth)
    energies = {"energy": hertz_energy(u, v), "kept": kept_energy(u, v, problem.omega_dt)}
    return {name: e.reshape(TENTHS, tenth, -1).mean(axis=1) / e[0] for name, e in energies.items()}


def hertz_energy(u: FloatArray, v: FloatArray) -> FloatArray:
    """v^2 / 2 + V(u) - V(1), V = (2/3) ((2/5) max(u, 0)^(5/2) - u)."""
    return np.asarray(v**2 / 2 + 2 / 3 * (0.4 * np.maximum(u, 0.0) ** 2.5 - u + 0.6))


def kept_energy(u: FloatArray, v: FloatArray, x: float) -> FloatArray:
    """What Verlet keeps in place of the energy but for x^4, x = omega dt: H + x^2 (v^2 V'' / 12 - V'^2 / 24)."""
    root = np.sqrt(np.maximum(u, 0.0))
    slope = 2 / 3 * (root**3 - 1)
    return np.asarray(hertz_energy(u, v) + x**2 * (v**2 * root / 12 - slope**2 / 24))


def fit_drift(y: FloatArray) -> Estimate:
    """Change over the whole of a long run by a straight line through its tenths."""
    line = stats.linregress((np.arange(y.size) + 0.5) / y.size, y)
    return Estimate(float(line.slope), float(line.stderr), y.size - 1)
