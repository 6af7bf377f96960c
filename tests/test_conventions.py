"""The factors of CONVENTIONS.md, as the code has them."""

import math
from pathlib import Path

import numpy as np
import pytest

import bem3d
import mdr
import validation

PAGE = (Path(__file__).parents[1] / "CONVENTIONS.md").read_text(encoding="utf-8")
L, E, N = 2e-3, 3e9, 256
SPACING = L / N
ROUGH = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi / L * 16, q_max=2 * np.pi / L * 60, rms=1e-7)
X = (np.arange(N) + 0.5) * SPACING
WAVE = 2 * np.pi / L * 5


def row(first, text=PAGE):
    """The cells of the one row of a table that begins with this."""
    (line,) = [line for line in text.splitlines() if line.startswith(f"| {first}")]
    return [cell.strip() for cell in line.strip("|").split("|")]


def trapezoid(values, q):
    return float(np.trapezoid(values, q))


def test_a_slope_in_one_direction_and_the_gradient():
    """2 int q^2 C_line dq = pi int q^3 C_2D dq = g^2 / 2, by sums; Geike's profile has the slope g."""
    assert row("rms slope h'")[1].startswith("h'^2 = 2 int_0^inf q^2 C_line dq = g^2 / 2")
    ground = validation.Roughness(rms=1e-7, hurst=0.7, longest=L / 16, shortest=L / 60)
    # the line trace has a corner at q_min
    q = np.concatenate([np.linspace(0, ROUGH.q_min, 2001), np.linspace(ROUGH.q_min, ROUGH.q_max, 8001)[1:]])
    line = mdr.line_trace(q[1:], ROUGH.c2d, q_max=ROUGH.q_max)
    assert ground.slope_along**2 == pytest.approx(2 * trapezoid(q[1:] ** 2 * line, q[1:]), rel=1e-3)
    gradient = 2 * np.pi * trapezoid(q**3 * ROUGH.c2d(q), q)
    assert ground.slope_along**2 == pytest.approx(gradient / 2, rel=1e-3)
    assert 2 * trapezoid(q[1:] ** 2 * mdr.geike(q[1:], ROUGH.c2d), q[1:]) == pytest.approx(gradient, rel=1e-3)


@pytest.mark.parametrize("periodic", [False, True])
def test_a_bump_is_a_smaller_gap_and_contact_begins_at_minus_its_height(periodic):
    height = 1e-7 * np.cos(2 * np.pi / L * X)[:, np.newaxis] * np.cos(2 * np.pi / L * X)
    half_space = bem3d.HalfSpace(shape=(N, N), spacing=SPACING, modulus=E, periodic=periodic)
    assert bem3d.solve(half_space, -height, approach=-1.0001 * height.max()).force == 0
    contact = bem3d.solve(half_space, -height, approach=-0.9 * height.max())
    assert contact.force == pytest.approx(contact.pressure.sum() * SPACING**2)
    assert contact.pressure[height < 0.5 * height.max()].max() == 0
    separation = -height + half_space.displacement(contact.pressure) - contact.approach
    assert np.abs(separation[contact.pressure > 0]).max() < 1e-5 * height.max()
    curve = mdr.load_curve(height[0], length=L, modulus=E)
    assert curve.approach[0] == -height[0].max()


def test_factors_of_surface_topography():
    """1/(2 pi) and 1/(4 pi^2), where the package is installed."""
    topography = pytest.importorskip("SurfaceTopography")
    assert row("SurfaceTopography, `power_spectrum_from_profile`")[2] == "1/(2 pi)"
    assert row("SurfaceTopography, `power_spectrum_from_area`")[2] == "1/(4 pi^2)"
    profile = mdr.rough_profile(ROUGH.c1d, length=L, points=N, rng=np.random.default_rng(1))
    line = topography.UniformLineScan(profile, L, periodic=True)
    q, c1d = line.power_spectrum_from_profile(resampling_method=None)
    assert c1d[20:50] / (2 * np.pi) == pytest.approx(ROUGH.c1d(q[20:50]))
    surface = bem3d.rough_surface(ROUGH.c2d, shape=(N, N), spacing=SPACING, rng=np.random.default_rng(1))
    area = topography.Topography(surface, (L, L), periodic=True)
    *_, c2d = area.power_spectrum_from_area(return_map=True)
    assert c2d[20:50, 0] / (4 * np.pi**2) == pytest.approx(ROUGH.c2d(2 * np.pi / L * np.arange(20, 50)))
    assert row("SurfaceTopography, `rms_gradient`; ")[2] == "1"
    ground = validation.MeasuredHeights(height=surface, spacing=(SPACING, SPACING))
    assert area.rms_gradient() == pytest.approx(ground.gradient, rel=0.02)


def test_factors_of_tamaas():
    """Lx Ly / (4 pi^2), and g on a side of 1, where the package is installed."""
    tamaas = pytest.importorskip("tamaas")
    assert row("tamaas, `Statistics2D.computePowerSpectrum`")[2] == "Lx Ly / (4 pi^2)"
    surface = bem3d.rough_surface(ROUGH.c2d, shape=(N, N), spacing=SPACING, rng=np.random.default_rng(1))
    c2d = tamaas.Statistics2D.computePowerSpectrum(surface).real[20:50, 0] * L**2 / (4 * np.pi**2)
    assert c2d == pytest.approx(ROUGH.c2d(2 * np.pi / L * np.arange(20, 50)))
    assert (
        row("SurfaceTopography, `rms_gradient`; tamaas, `Statistics2D.computeSpectralRMSSlope` on a side of 1")[2]
        == "1"
    )
    q = np.linspace(ROUGH.q_min, ROUGH.q_max, 8001)
    gradient = math.sqrt(2 * np.pi * trapezoid(q**3 * ROUGH.c2d(q), q))
    assert tamaas.Statistics2D.computeSpectralRMSSlope(surface) / L == pytest.approx(gradient, rel=0.03)


def test_approaches_of_the_other_packages():
    """Where each one counts from: periodic, one load, the approach of three packages, where they are installed."""
    tamaas = pytest.importorskip("tamaas")
    n, spacing = 32, L / 32
    x = (np.arange(n) + 0.5) * spacing
    height = 1e-7 * np.cos(2 * np.pi / L * x)[:, np.newaxis] * np.cos(2 * np.pi / L * x)
    half_space = bem3d.HalfSpace(shape=(n, n), spacing=spacing, modulus=E, periodic=True)
    ours = bem3d.solve(half_space, -height, force=1e5 * L**2, tolerance=1e-9)
    model = tamaas.Model(tamaas.model_type.basic_2d, [L, L], [n, n])
    model.E, model.nu = E, 0.0
    tamaas.PolonskyKeerRey(model, height.copy(), 1e-12).solve(1e5)
    assert -np.array(model.displacement).mean() == pytest.approx(ours.approach, rel=1e-6)
