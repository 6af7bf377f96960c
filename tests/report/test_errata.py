"""Errata of the chapter and remarks on it, each by a derivation of its own."""

import math
from functools import partial

import numpy as np
import pytest
from scipy import integrate

from validation.report.chapter import ERRATA, REMARKS

A, R, E, V = 2e-3, 0.5, 2e11, 20.0
X = np.linspace(-A, A, 20_001)


def erratum(place, rows=ERRATA):
    (row,) = (row for row in rows if row["place"] == place)
    return row


remark = partial(erratum, rows=REMARKS)


def test_14_5_pulls_without_the_approach():
    d = A**2 / R
    hertz = 4 / 3 * E * math.sqrt(R) * d**1.5
    assert E * np.trapezoid(-(X**2) / R, X) == pytest.approx(-2 / 3 * E * A * d, rel=1e-6)
    assert E * np.trapezoid(d - X**2 / R, X) == pytest.approx(hertz, rel=1e-6)
    assert "-2/3 E* a d" in erratum("(14.5)")["why"] and "(d + h - Z0)" in erratum("(14.5)")["correct"]


def test_14_9_has_the_spectrum_under_the_root():
    """The sum of B^2 over the waves of both signs is the integral of the spectrum, whatever the length."""
    q_min, q_max = 2 * np.pi / 0.01, 2 * np.pi / 2e-4

    def c1d(q):
        return np.where((q >= q_min) & (q <= q_max), q**-2.4, 0.0)

    sums = []
    for length in (1.0, 2.0):
        q = 2 * np.pi / length * np.arange(1, int(1.01 * q_max * length / (2 * np.pi)))
        sums.append((2 * np.sum(2 * np.pi * c1d(q) / length), 2 * np.sum(2 * np.pi / length * c1d(q) ** 2)))
    exact = 2 * (q_min**-1.4 - q_max**-1.4) / 1.4
    assert [corrected for corrected, _ in sums] == pytest.approx([exact, exact], rel=0.01)
    # as printed, a profile has another height by far, in another unit
    assert sums[0][1] < 1e-3 * exact
    assert erratum("(14.9)")["correct"] == "B_1D = sqrt(2π C_1D / L)"


def test_14_10_has_a_wavenumber_q():
    q = 1.3 / A
    assert np.exp(1j * q * (X + A)) - np.exp(1j * q * (X - A)) == pytest.approx(2j * np.sin(q * A) * np.exp(1j * q * X))
    assert "2i sin(qa)" in erratum("(14.10)")["why"]


def test_14_7_leaves_the_mean_force_open():
    """Its integrand is the same for any constant force; (14.11) is its change by a wave."""
    q = 1.3 / A
    change = 2 / q * np.sin(q * A) * np.cos(q * X)
    assert np.gradient(change + 7.0, X)[1:-1] == pytest.approx(
        (np.cos(q * (X + A)) - np.cos(q * (X - A)))[1:-1], abs=1e-5
    )
    assert "F_0" in remark("(14.7)")["condition"]


def test_14_15_has_the_other_sign_of_h():
    """A bump under the wheel raises the force of (14.5), and lowers that of springs under (14.15) as printed."""
    d = A**2 / R
    bump = 0.1 * d * np.exp(-((X / A) ** 2))
    smooth, with_bump, as_printed = (np.trapezoid(np.maximum(d - X**2 / R + s * bump, 0), X) for s in (0, 1, -1))
    assert as_printed < smooth < with_bump
    assert "- h(x)" in erratum("(14.15)")["correct"]


def test_the_period_of_region_3_is_a_frequency():
    omega = np.linspace(0, 6 * np.pi * V / A, 1001)
    assert np.sin((omega + np.pi * V / A) / V * A) ** 2 == pytest.approx(np.sin(omega / V * A) ** 2, abs=1e-9)
    assert erratum("After (14.19), Δω3")["correct"] == "Δω3 = π v0/a"


def test_14_13_needs_the_amount_of_q():
    assert isinstance((-600.0) ** (-2 * 0.7 - 1), complex) and "|q|" in erratum("(14.13), (14.18)")["correct"]


def test_a_steel_rail_halves_the_modulus():
    """Hertz by itself: F = 4/3 E* sqrt(R) d^(3/2), a^2 = R d, k = 2 E* a; steel of 210 GPa and 1/3, 500 kg, 4905 N."""
    printed = remark("Section 14.2")["why"]
    for bodies in (1, 2):
        modulus = 210e9 / (1 - 1 / 9) / bodies
        d = (3 * 4905 / (4 * modulus * math.sqrt(R))) ** (2 / 3)
        a = math.sqrt(R * d)
        omega = math.sqrt(2 * modulus * a / 500)
        for text in (f"{1e3 * a:.5g} mm", f"{1e6 * d:.5g} µm", f"{omega:.0f} "):
            assert text in printed, text
    assert f"{2 * math.pi * R:.2f} m" in printed


def test_small_roughness_that_is_steep_ends_the_contact_in_several_places():
    d, x = A**2 / R, np.linspace(0, 2 * A, 200_001)
    ends = []
    for over in (0.3, 10.0):  # the slope of a wave over that of the wheel at its end, 2 a/R
        height, q = 0.01 * d, over * 2 * A / R / (0.01 * d)
        ends.append(np.count_nonzero(np.diff(np.sign(d - x**2 / R + height * np.cos(q * x)))))
    assert ends[0] == 1 < ends[1]
    assert "h' is much smaller than d/a" in remark("(14.4)")["condition"]


def test_the_first_wave_of_14_8_counts_whole():
    """65 longest waves on the track; the sum over the integral of q^(-2H-1)."""
    n = np.arange(65, 3251)
    excess = np.sum(n**-2.4) / ((65**-1.4 - 3250**-1.4) / 1.4) - 1
    assert f"{100 * excess:.1f} %" in remark("(14.8)")["why"]


@pytest.mark.parametrize(("ratio", "said"), [(2.0, "at twice ω_eigen its level is"), (None, "at the jump")])
def test_the_acceleration_is_force_over_mass_far_above_the_resonance(ratio, said):
    """M z'' = k (u - z) with u = cos(omega t): z'' over k u / M."""
    mass, stiffness = 500.0, 2 * 236.25e9 * 1.98196e-3
    omega = ratio * math.sqrt(stiffness / mass) if ratio else 2 * math.pi / 0.01 * V
    z = np.linalg.solve([[stiffness - mass * omega**2]], [stiffness])[0]
    level = 20 * math.log10(abs(omega**2 * z / (stiffness / mass)))
    digits = 1 if ratio else 2
    assert f"{said} {level:.{digits}f} dB" in remark("Region 3, slope")["why"]


def test_a_line_on_isotropic_ground_has_a_plateau_below_q_min():
    """C_line(q) = int C_2D(sqrt(q^2 + k^2)) dk over the waves of the band, at q far below it; Geike's at q_min."""
    hurst = 0.7
    plateau = 2 * integrate.quad(lambda k: k ** (-2 * hurst - 2), 1.0, np.inf)[0]
    assert f"{10 * math.log10(plateau / math.pi):.1f} dB for H = {hurst}" in remark("(14.20)")["why"]


def test_leakage_falls_with_the_time_and_not_with_the_step():
    """A wave that ends half a period on: the density far above its frequency, between the lines."""

    def far(time, step):
        t = np.arange(0, time, step)
        x = np.sin(np.pi * (2 * round(time) + 0.5) / time * t)
        density = np.abs(np.fft.rfft(x)) ** 2 * step**2 / time
        f = np.fft.rfftfreq(t.size, step)
        return float(density[(f > 20) & (f < 25)].mean())

    base = far(40.0, 1e-3)
    assert far(80.0, 1e-3) == pytest.approx(base / 2, rel=0.1)
    assert far(40.0, 5e-4) == pytest.approx(base, rel=0.01)
    assert "falls with the time T" in remark("Region 4")["why"]


def test_the_often_quoted_factor_of_the_square_is_too_low():
    """Capacitance of a unit square, 0.3667896 of 4 pi epsilon_0 (Read, J. Comput. Phys. 133, 1997)."""
    row, square, quoted = remark("Square punches, Fig. 14.1"), 0.3667896 * math.pi, 1.012 * 2 / math.sqrt(math.pi)
    assert f"{square:.4f}" in row["condition"]
    assert f"gives {quoted:.4f}, {100 * (1 - quoted / square):.1f} % less" in row["why"]


@pytest.mark.parametrize("row", [*ERRATA, *REMARKS], ids=lambda row: row["place"])
def test_each_row_has_all_its_columns_and_its_numbers(row):
    assert set(row) in ({"place", "printed", "correct", "why"}, {"place", "printed", "condition", "why"})
    assert all(row.values()) and not any(mark in text for text in row.values() for mark in "{}")
