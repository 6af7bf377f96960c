"""Persson's stiffness of an interface beside the diffusion of pressures, marched in steps, and beside its limits."""

import math
import types

import numpy as np
import pytest
from scipy import integrate, linalg, special

from tests.seeded import catches
from validation.theory import interface

EDGES = (2.0, 3.0, 24.0)


def c2d(q):
    """A plateau and a power law of H = 0.7."""
    return 1e-3 * np.where(q < 3, 1.0, (q / 3) ** -3.4)


def stiffness(p, *, gamma=0.45, modulus=2.0, spectrum=c2d, edges=EDGES):
    return interface.persson_stiffness(p, c2d=spectrum, edges=edges, modulus=modulus, gamma=gamma)


def contact_fraction(pressure, gradient):
    """True area over nominal area: erf(sqrt(2) p / (E* g)), pressure and gradient over one E*."""
    return special.erf(math.sqrt(2) * pressure / gradient)


@catches("pressures that diffuse half as fast").at(
    f"{__name__}.contact_fraction", lambda pressure, gradient: math.erf(pressure / gradient)
)
def test_the_area_is_that_of_pressures_that_diffuse():
    """The pressure is p at first, diffuses by dW = W'' dV / 2 and is absorbed at zero: Crank and Nicolson, from a
    variance that all but misses zero to that of full contact, E*^2 g^2 / 4. Second order: 120 steps, 300 pressures."""
    p, variance = 0.3, np.linspace(0.004, 0.09, 120)
    step = 0.008
    sigma = step * np.arange(1, 300)
    density = np.exp(-((sigma - p) ** 2) / (2 * variance[0])) / math.sqrt(2 * math.pi * variance[0])
    half = (variance[1] - variance[0]) / 4 / step**2
    banded = np.repeat([[-half], [1 + 2 * half], [-half]], sigma.size, axis=1)
    for reached in variance[1:]:
        spread = np.diff(density, 2, prepend=0.0, append=0.0)
        density = linalg.solve_banded((1, 1), banded, density + half * spread)
        found = contact_fraction(p, 2 * math.sqrt(reached))
        assert found == pytest.approx(step * density.sum(), abs=5e-4)
    assert found < 0.7


def gap(p, gamma):
    """u = int_p^inf dU/dp' / p' dp' for E* = 2, dU/dp a difference of energies."""
    q = np.geomspace(EDGES[0], EDGES[-1], 5001)
    gradient = np.sqrt(2 * np.pi * integrate.cumulative_trapezoid(q**3 * c2d(q), q))
    pressures = np.geomspace(p, 20 * gradient[-1], 121)
    share = contact_fraction(pressures[:, np.newaxis], 2 * gradient)
    stored = (q**2 * c2d(q))[1:] * share * (gamma + (1 - gamma) * share**2)
    work = np.diff(np.pi * np.trapezoid(stored, q[1:]))
    return float(np.sum(work / np.sqrt(pressures[1:] * pressures[:-1])))


def slopes_in_one_direction(c2d, edges):
    q, s = SLOPES(c2d, edges)
    return q, s / math.sqrt(2)


SLOPES = interface._slopes


@catches("waves of an interface by their slope in one direction", gamma=0.45).at(
    "validation.theory.interface._slopes", slopes_in_one_direction
)
@catches("the contact of an interface without the root of two", gamma=0.45).at(
    "validation.theory.interface.special", types.SimpleNamespace(erf=lambda x: special.erf(x / math.sqrt(2)))
)
@pytest.mark.parametrize("gamma", [1.0, 0.45])
def test_the_stiffness_is_the_slope_of_the_gap_that_the_energy_leaves(gamma):
    """-dp/du by a difference over 2 %: good to its square, and to that of the steps of 6 % in the work."""
    for p in (0.02, 0.2):
        slope = 0.02 * p / (gap(0.99 * p, gamma) - gap(1.01 * p, gamma))
        assert stiffness(p, gamma=gamma) == pytest.approx(slope, rel=0.01)


def test_a_light_load_is_proportional_and_a_heavy_one_closes_the_gap():
    """K = p / u_0, u_0 = gamma sqrt(pi) int q^2 C w dq; the gap closes before the pressure is E*."""
    light = np.array([1e-5, 1e-4])
    length = light / stiffness(light)
    assert length[0] == pytest.approx(length[1], rel=1e-3)

    def integrand(t):
        # q = 2 + t^2 takes the root out of w at the first wave
        q = 2 + t**2
        cubes, _ = integrate.quad(lambda k: k**3 * c2d(k), 2, q, points=[3.0] if q > 3 else None)
        return q**2 * c2d(q) / math.sqrt(cubes) * 2 * t

    u_0, _ = integrate.quad(integrand, 1e-6, math.sqrt(22), points=[1.0])
    assert length[0] == pytest.approx(0.45 * u_0, rel=1e-3)
    assert light[0] / stiffness(light[0], gamma=1.0) == pytest.approx(u_0, rel=1e-3)
    assert stiffness(100.0) > 1e12


def test_the_stiffness_scales_with_modulus_height_and_length():
    """K(p; E*, h, L) = E* / L K(p L / (E* h)); twice as long and as high, of the same slopes, has 16 times C_2D."""
    assert stiffness(0.6, modulus=6.0) == pytest.approx(3 * stiffness(0.2), rel=1e-12)
    higher = stiffness(0.4, spectrum=lambda q: 4 * c2d(q))
    assert higher == pytest.approx(stiffness(0.2), rel=1e-12)
    longer = stiffness(0.2, spectrum=lambda q: 16 * c2d(2 * q), edges=(1.0, 1.5, 12.0))
    assert longer == pytest.approx(stiffness(0.2) / 2, rel=1e-9)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"p": 0.0}, "pressure must be finite and positive, got 0.0"),
        ({"gamma": 1.1}, r"gamma must be in \(0, 1\], got 1.1"),
        ({"edges": (2.0,)}, r"edges must be two or more, positive and ascending, got \(2.0,\)"),
        ({"modulus": -1.0}, "modulus must be finite and positive, got -1.0"),
    ],
)
def test_what_has_no_answer_is_refused(wrong, said):
    with pytest.raises(ValueError, match=f"^{said}$"):
        stiffness(**{"p": 0.1, **wrong})
