"""Stiffness of an interface beside Westergaard's and a difference of loads; load paths inside Barber's bounds."""

import math

import numpy as np
import pytest

import bem3d
from bem3d import contact as contact_module
from bem3d import kernel
from tests import oracles
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


# --- gap and area of a contact ---


@catches("a gap that the displacement does not open", periodic=True).at(
    "bem3d.Contact.displacement", property(lambda contact: np.zeros(contact.pressure.shape))
)
@catches("the mean gap of an interface over its overlap", periodic=True).at(
    "bem3d.Contact.mean_gap", property(lambda contact: contact.approach - contact.problem.first_touch)
)
@pytest.mark.parametrize("periodic", [True, False])
def test_the_gap_is_that_of_an_operator_without_transforms(periodic):
    """gap + K p - d, K the dense matrix: zero under pressure, positive beside it, and its mean."""
    n = 16
    body = bem3d.HalfSpace(shape=(n, n), spacing=(0.1, 0.2), modulus=2.0, periodic=periodic)
    height = np.random.default_rng(1).normal(size=(n, n))
    contact = bem3d.solve(body, -height, force=0.3, tolerance=1e-9, indenter_ends_at_edge=True)
    u = (oracles.dense_operator(body) @ contact.pressure.ravel()).reshape(n, n)
    scale = contact.approach + height.max()
    assert contact.displacement == pytest.approx(u, abs=1e-9 * scale)
    assert contact.gap == pytest.approx(u - height - contact.approach, abs=1e-9 * scale)
    assert contact.gap.min() > -1e-8 * scale and np.abs(contact.gap[contact.pressure > 0]).max() < 1e-6 * scale
    assert contact.mean_gap == pytest.approx((u - height).mean() - contact.approach, abs=1e-9 * scale)
    assert contact.gap is contact.gap and not contact.gap.flags.writeable


def test_gap_and_area_without_contact_are_those_of_the_problem():
    body = bem3d.HalfSpace(shape=(4, 4), spacing=1.0, modulus=1.0)
    gap = np.arange(16.0).reshape(4, 4)
    contact = bem3d.solve(body, gap, approach=-1.0)
    assert contact.corrected_area == contact.area == 0.0
    np.testing.assert_array_equal(contact.gap, gap + 1.0)
    assert contact.mean_gap == 8.5


def sides_by_a_loop(under, periodic):
    """Pairs of neighbours of which one is under pressure."""
    nx, ny = under.shape
    pairs = [((i, j), (i + 1, j)) for i in range(nx) for j in range(ny) if i + 1 < nx or periodic]
    pairs += [((i, j), (i, j + 1)) for i in range(nx) for j in range(ny) if j + 1 < ny or periodic]
    return sum(under[a] != under[b[0] % nx, b[1] % ny] for a, b in pairs)


@catches("half of a cell for each two sides", periodic=False).at("bem3d.contact.PERIMETER", 0.25)
@catches("an area without its correction", periodic=True).at("bem3d.Contact.corrected_area", bem3d.Contact.area)
@pytest.mark.parametrize("periodic", [True, False])
def test_the_correction_counts_the_sides_of_cells_on_the_boundary(periodic):
    """0.11811 of a cell for each; contacts that go over the end of a periodic grid, cells of 1 : 2."""
    body = bem3d.HalfSpace(shape=(12, 10), spacing=(0.1, 0.2), modulus=2.0, periodic=periodic)
    height = np.random.default_rng(2).normal(size=(12, 10))
    contact = bem3d.solve(body, -height, force=1.0, indenter_ends_at_edge=True)
    sides = sides_by_a_loop(contact.pressure > 0, periodic)
    assert sides > 10
    assert contact.area - contact.corrected_area == pytest.approx(0.11811 * sides * 0.02, rel=1e-4)


def heights_of_common_waves(cells):
    """The same 16 x 16 waves of a plateau and H = 0.7 on every grid, rms height 1e-3; cell centres of all grids differ
    by a shift, which a periodic face does not have."""
    x = (np.arange(cells) + 0.5) / cells
    i, j = np.arange(-16, 17), np.arange(17)
    q = np.hypot(i[:, np.newaxis], j)
    phase = np.random.default_rng(4).uniform(0, 2 * np.pi, q.shape)
    amplitude = np.where((q > 0) & (q <= 16), np.maximum(q, 4.0) ** -1.7, 0.0) * np.exp(1j * phase)
    along_x, along_y = (np.exp(2j * np.pi * np.outer(x, waves)) for waves in (i, j))
    height = (along_x @ amplitude @ along_y.T).real
    return 1e-3 * height / height.std()


@catches("twice the correction", waves=4).at("bem3d.contact.PERIMETER", 2 * contact_module.PERIMETER)
@catches("no correction", waves=4).at("bem3d.contact.PERIMETER", 0.0)
@pytest.mark.parametrize("waves", [4, 8])
def test_the_corrected_area_of_a_rough_face_is_that_of_cells_eight_times_as_fine(waves):
    """What is left is less than a quarter of the correction, on 4 and 8 cells to the shortest of 16 waves a side; the
    fine grid's own area is extrapolated by half of its correction, which is an eighth of the coarse one's at most."""
    areas = {}
    for cells in (16 * waves, 512):
        height = heights_of_common_waves(cells)
        body = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0, periodic=True)
        contact = list(bem3d.indent(body, -height, forces=(0.003, 0.012), tolerance=1e-4))
        areas[cells] = np.array([(c.area, c.corrected_area) for c in contact]).T
    (counted, corrected), (_, fine) = areas[16 * waves], areas[512]
    left = corrected - fine
    assert (np.abs(left) < 0.25 * (counted - corrected)).all(), left


@catches("half of the correction", n=16).at("bem3d.contact.PERIMETER", 0.1 * contact_module.PERIMETER)
@pytest.mark.parametrize("n", [8, 16])
def test_the_corrected_area_of_a_sphere_is_within_half_of_the_correction(n):
    """Mean of nine places of the sphere between the cells, beside pi R d."""
    step, counted, corrected = 1e-3 / n, [], []
    for x_0, y_0 in np.ndindex(3, 3):
        x, y = ((np.arange(3 * n) - 1.5 * n + (k + 0.5) / 3) * step for k in (x_0, y_0))
        gap = (x[:, np.newaxis] ** 2 + y**2) / 0.2
        body = bem3d.HalfSpace(shape=(3 * n, 3 * n), spacing=step, modulus=1e11)
        contact = bem3d.solve(body, gap, approach=1e-5)
        counted.append(contact.area)
        corrected.append(contact.corrected_area)
    counted, corrected = np.mean(counted), np.mean(corrected)
    assert abs(corrected - math.pi * 1e-6) < 0.5 * (counted - corrected)
