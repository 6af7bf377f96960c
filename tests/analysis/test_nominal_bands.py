"""Base-ten one-third octaves of wavelength, against the tables of the field and against sums by hand."""

import math

import numpy as np
import pytest
from scipy import integrate

from tests.seeded import Times, catches
from validation.analysis.spectra import NominalBands, band_number

TABLE = (2000, 1600, 1250, 1000, 800, 630, 500, 400, 315, 250, 200, 160, 125, 100, 80, 63, 50, 40, 31.5, 25, 20, 16)
TABLE += (12.5, 10, 8, 6.3, 5, 4, 3.15, 2.5, 2, 1.6, 1.25, 1, 0.8)
"""Of CNOSSOS-EU, in mm."""


def test_names_are_those_of_the_tables():
    bands = NominalBands.named([mm / 1000 for mm in TABLE])
    assert bands == NominalBands()
    assert (1000 * bands.nominal).tolist() == list(TABLE)
    np.testing.assert_allclose(bands.wavelengths, bands.nominal, rtol=0.01)


@catches("bands of base two for those of base ten").at(
    "validation.analysis.spectra.NominalBands.edges",
    property(lambda bands: bands.centres[0] * 2 ** ((np.arange(len(bands) + 1) - 0.5) / 3)),
)
def test_bands_are_base_ten_and_lie_beside_each_other():
    bands = NominalBands(0, -20)
    np.testing.assert_allclose(bands.edges[1:] / bands.edges[:-1], 10**0.1, rtol=1e-12)
    np.testing.assert_allclose(np.sqrt(bands.edges[1:] * bands.edges[:-1]), bands.centres, rtol=1e-12)
    assert bands.centres[10] == pytest.approx(2 * math.pi / 0.1, rel=1e-12)
    # base two is off by a quarter of a band at the short end
    assert abs(math.log(2 ** (-20 / 3) / bands.wavelengths[-1]) / math.log(10**0.1)) > 0.05


@pytest.mark.parametrize(
    ("wavelengths", "said"),
    [
        ([0.1, 0.08, 0.08, 0.063], "80 mm twice"),
        ([0.1, 0.063, 0.08], "no 80 mm behind 100 mm"),
        ([0.1, 0.125], "sorted, got 125 mm behind 100 mm"),
        ([0.1, 0.05], "no 80 mm behind 100 mm"),
        ([2.0, 1.7], "got 1700 mm"),
        ([1000.0], "got 1e[+]06 mm"),
        ([math.nan], "got nan"),
        ([], "got none"),
    ],
)
def test_what_is_no_row_of_bands(wavelengths, said):
    with pytest.raises(ValueError, match=said):
        NominalBands.named(wavelengths)


@catches("positive wavenumbers alone for the power of a band").at("validation.analysis.spectra.levels", Times(0.5))
def test_power_of_a_wave_is_in_its_band_alone():
    """A cosine of amplitude A has A^2 / 2."""
    bands = NominalBands(-10, -20)
    x = np.arange(4000) * 1e-3
    found = bands.powers_of_track(3.0 * np.cos(2 * np.pi * x / 0.04), spacing=1e-3)
    np.testing.assert_allclose(found, np.where(np.array(bands.numbers) == band_number(0.04), 4.5, 0.0), atol=1e-12)


def test_a_track_must_be_long():
    with pytest.raises(ValueError, match="length must be so large"):
        NominalBands(0, -10).powers_of_track(np.zeros(100), spacing=1e-2)


def law(power):
    return lambda q: 1e-9 * (q / 100) ** power


def filtered(q):
    return np.sinc(q * 6e-3 / np.pi) ** 2


@pytest.mark.parametrize(
    ("spectrum", "bands", "within"),
    [
        *((law(power), NominalBands(-5, -15), 1e-11) for power in (-3.4, -1.0, 0.0, 2.0)),
        (filtered, NominalBands(-20, -31), 1e-9),
    ],
)
def test_power_of_a_spectrum_against_the_integral(spectrum, bands, within):
    """A power law, and a filter with six zeros a band: within rounding."""
    edges = zip(bands.edges[:-1], bands.edges[1:], strict=True)
    slow = [2 * integrate.quad(spectrum, low, high, epsrel=1e-12, limit=200)[0] for low, high in edges]
    np.testing.assert_allclose(bands.powers_of_spectrum(spectrum), slow, rtol=within)


def test_bands_within_two_wavelengths():
    assert NominalBands().within(1.0, 0.01) == NominalBands(0, -20)
    assert NominalBands(-5, -30).within(1.0, 2.5e-3) == NominalBands(-5, -26)
    with pytest.raises(ValueError, match="between the wavelengths 12 mm and 11 mm"):
        NominalBands().within(0.012, 0.011)


@catches("lines that keep their slope").at("scipy.signal.detrend", lambda heights, type: heights)
def test_power_of_a_record_is_that_of_its_waves():
    """Of a cut through two cosines on a slope: their mean squares, and nothing of the slope."""
    bands, x = NominalBands(-5, -20), np.arange(20000) * 1e-3
    record = 3.0 * np.cos(2 * np.pi * x / 0.0401 + 1.0) + 0.5 * np.cos(2 * np.pi * x / 0.1003) + 1e5 * x
    found = bands.powers_of_records(record, spacing=1e-3)
    assert found[list(bands.numbers).index(-14)] == pytest.approx(4.5, rel=1e-3)
    assert found[list(bands.numbers).index(-10)] == pytest.approx(0.125, rel=1e-2)
    assert found.sum() == pytest.approx(4.625, rel=1e-3)


def test_power_of_records_of_a_spectrum():
    """White noise has 2 C dq in each band, that of the widest within its scatter, and narrow ones without bias."""
    rng, bands = np.random.default_rng(4), NominalBands(-8, -22)
    found = bands.powers_of_records(rng.standard_normal((2000, 700)), spacing=1e-3).mean(axis=0)
    density = 1e-3 / (2 * np.pi)
    np.testing.assert_allclose(found, 2 * density * np.diff(bands.edges), rtol=0.07)


def test_bands_have_names_together():
    bands = NominalBands(-10, -16)
    masks = ("1111111", "1110010", "0000001", "0110110", "0000000")
    names = [bands.names([mark == "1" for mark in mask]) for mask in masks]
    assert names == ["100 to 25 mm", "100 to 63, 31.5 mm", "25 mm", "80 to 63, 40 to 31.5 mm", "none"]
