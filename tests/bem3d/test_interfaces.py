"""Stiffness of an interface beside Westergaard's and a difference of loads; load paths inside Barber's bounds."""

import math

import numpy as np
import pytest

import bem3d
from bem3d import kernel
from tests.seeded import catches
from validation.theory import closed_forms

WAVE = {"amplitude": 1e-3, "wavelength": 1.0, "modulus": 2.0}
N = 32


periodic_symbol = kernel.periodic_symbol


def yielding_mean_plane(shape, spacing, modulus):
    """The longest wave's for the zero mode, which belongs to no interface."""
    symbol = periodic_symbol(shape, spacing, modulus)
    symbol[0, 0] = symbol.max()
    return symbol


@catches("a mean plane of a periodic half-space that yields", load=0.3).at(
    "bem3d.kernel.periodic_symbol", yielding_mean_plane
)
@pytest.mark.parametrize("load", [0.05, 0.3, 0.8])
def test_a_wave_has_the_stiffness_and_the_approach_of_westergaard(load):
    """Of flat periodic strips 1 / K = -(2 lambda / (pi E*)) ln sin(pi a / lambda), the logarithm of the capacity of an
    arc; its integral is d = h s (1 - ln s), s = mean(p) / p* = sin^2(pi a / lambda). The edge of the contact falls
    between two cells: half a cell in a. The approach is of second order."""
    pressure = load * closed_forms.westergaard_full_pressure(**WAVE)
    compliance, approach = -math.log(load) / (2.0 * math.pi), 1e-3 * load * (1 - math.log(load))
    a = closed_forms.westergaard_half_width(mean_pressure=pressure, **WAVE)
    for n in (64, 512):
        body = bem3d.HalfSpace(shape=(n, 1), spacing=(1 / n, 1.0), modulus=2.0, periodic=True)
        gap = -1e-3 * np.cos(2 * np.pi * np.arange(n) / n)[:, np.newaxis]
        contact = bem3d.solve(body, gap, force=pressure, tolerance=1e-10)
        half_a_cell = 2 / 2.0 / math.tan(math.pi * a) / (2 * n)
        assert 1 / contact.stiffness() == pytest.approx(compliance, abs=half_a_cell)
        # the mean plane of the wave is its amplitude below its crest
        assert contact.approach + 1e-3 == pytest.approx(approach, abs=4e-3 / n**2 * 64)


def rough(scale=1e-3):
    def c2d(q):
        return np.where((q > 3) & (q < 60), np.maximum(q, 20.0) ** -3.4, 0.0)

    return bem3d.rough_surface(c2d, shape=(N, N), spacing=1 / N, rng=np.random.default_rng(3), rms=scale)


@catches("a mean gap that the stiffness does not close", pressure=5e-3).at(
    "bem3d.kernel.periodic_symbol", yielding_mean_plane
)
@pytest.mark.parametrize("pressure", [2e-4, 5e-3])
def test_the_stiffness_of_an_interface_is_what_closes_its_mean_gap(pressure):
    """-dp/du of two loads so near that the contact stays: the mean displacement of a periodic half-space is zero."""
    body, height = bem3d.HalfSpace(shape=(N, N), spacing=1 / N, modulus=1.0, periodic=True), rough()
    solved = [bem3d.solve(body, -height, force=f * pressure, tolerance=1e-9) for f in (1 - 1e-5, 1.0, 1 + 1e-5)]
    gaps = [np.mean(body.displacement(c.pressure) - height) - c.approach for c in solved]
    assert len({c.area for c in solved}) == 1
    assert -2e-5 * pressure / (gaps[2] - gaps[0]) == pytest.approx(solved[1].stiffness(), rel=1e-3)


@catches("half of the stiffness along a load path", shape="sphere").at(
    "bem3d.Contact.stiffness", lambda contact: contact.frozen.stiffness / 2
)
@pytest.mark.parametrize("shape", ["punch", "sphere", "interface"])
def test_a_load_path_lies_between_those_of_the_smooth_bodies_at_the_extreme_heights(shape):
    """d_smooth(F) - max h <= d(F) <= d_smooth(F) - min h, whatever the spectrum. F(d) is convex, so that its slope is
    at least that of the chord from the first touch, and for a punch at most that of the flat one: Barber, Proc. R. Soc.
    A 459, 53 (2003). The heights are squares, of one side; the smooth body stands on the same grid."""
    body = bem3d.HalfSpace(shape=(N, N), spacing=1 / N, modulus=1.0, periodic=shape == "interface")
    x = (np.arange(N) + 0.5) / N - 0.5
    smooth = np.add.outer(x**2, x**2) if shape == "sphere" else np.zeros((N, N))
    height = rough(0.05) ** 2
    forces = np.geomspace(1e-4, 1e-2, 7)
    paths = [
        bem3d.indent(body, gap, forces=forces, stiffness=True, tolerance=1e-6) for gap in (smooth, smooth - height)
    ]
    for flat, contact in zip(*paths, strict=True):
        lag = flat.approach - contact.approach
        assert height.min() - 1e-9 <= lag <= height.max() + 1e-9
        chord = contact.force / (contact.approach - (smooth - height).min())
        assert contact.stiffness() >= chord * (1 - 1e-6)
        if shape == "punch":
            assert contact.stiffness() <= flat.stiffness() * (1 + 1e-6)
