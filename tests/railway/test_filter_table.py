"""A contact filter for tools that map noise: the columns and wavelengths of the table of CNOSSOS-EU."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import validation
from tests.advice.planted_answers import Finding, compared
from tests.seeded import catches
from validation.__main__ import main
from validation.advice.compare import compare
from validation.railway.rail_columns import filter_table
from validation.simulation.model_names import SPRINGS_GEIKE

PUBLISHED = Path(validation.__file__).parent / "railway" / "tables" / "cnossos_a3_2021.csv"
RAIL = validation.load_scene("rail")


def table_published():
    lines = PUBLISHED.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def filtered(scene, a3, quantity="contact-filter"):
    return compared(Finding(value=tuple(10 ** (np.array(a3) / 20))), scene=scene, quantity=quantity)


def test_a_filter_has_the_columns_and_the_wavelengths_of_the_table():
    a3 = -np.arange(35) / 8
    found, published = filter_table(filtered(RAIL, a3)), table_published()
    mine = [row for row in published if (row["wheel_load_kN"], row["wheel_diameter_mm"]) == ("50", "920")]
    assert list(found.columns) == list(published[0])
    nominal = [float(row["wavelength_mm"]) for row in mine]
    assert found["wavelength_mm"].tolist() == filtered(RAIL, a3).wavelength_mm.tolist() == nominal
    assert (set(found["wheel_load_kN"]), set(found["wheel_diameter_mm"])) == ({50.0}, {920.0})
    assert found["a3_dB"] == pytest.approx(a3, abs=0.0501)


def without_long_waves(first, across="ridges", p=None):
    """The rail from one of its bands on; levels of C_line ~ q^-p where that is given."""
    levels = RAIL.levels
    values = levels.levels if p is None else tuple((10 * (p - 1) * np.log10(levels.bands.wavelengths)).tolist())
    cut = replace(levels, wavelengths=levels.wavelengths[first:], levels=values[first:])
    return replace(RAIL, roughness=cut, lateral_structure=across)


@pytest.mark.parametrize("first", [5, 13, 18])
def test_longer_waves_have_the_limit_of_the_filter(first):
    """Over ridges (sin q a / q a)^2, to the tenth of a decibel that is written and what a band is off its centre."""
    scene = without_long_waves(first)
    found = filter_table(compare(scene, quantity="contact-filter", tolerance="3 dB"))["a3_dB"]
    centre = 2 * scene.contact.along / RAIL.levels.bands.wavelengths[:first]
    assert found[:first] == pytest.approx(20 * np.log10(np.sinc(centre)), abs=0.055)
    assert np.isfinite(found).all()
    short = replace(scene, roughness=scene.roughness.within(None, 0.01))
    assert np.isnan(filter_table(compare(short, quantity="contact-filter", tolerance="3 dB"))["a3_dB"][24:]).all()


@pytest.mark.parametrize("across", ["isotropic", 1.0, None])
def test_longer_waves_are_those_of_a_scene_that_has_them(across):
    whole, cut = (without_long_waves(first, across, 2.4) for first in (0, 14))
    tables = [
        filter_table(compare(scene, quantity="contact-filter", tolerance="3 dB"))["a3_dB"] for scene in (whole, cut)
    ]
    np.testing.assert_allclose(tables[1], tables[0], atol=0.101)
    assert (tables[1][:14] < 0).any()


@catches("long waves that pass under every filter").at(
    "validation.railway.rail_columns.of_longer_waves", lambda model, target: np.zeros(35)
)
def test_springs_on_geikes_spectrum_are_off_for_long_waves_too():
    """By sqrt(pi) Gamma((p + 1) / 2) / Gamma(p / 2) of C_line ~ q^-p: 2.0 dB for p = 2."""
    one = compare(
        without_long_waves(12, "isotropic", 2.0), quantity="contact-filter", tolerance="3 dB", models=[SPRINGS_GEIKE]
    )
    assert filter_table(one)["a3_dB"][:7] == pytest.approx(10 * np.log10(np.pi / 2), abs=0.06)


def test_what_is_no_filter_is_refused(tmp_path, capsys):
    with pytest.raises(ValueError, match=r"--cnossos is for the quantity contact-filter of a rail, got equivalent"):
        filter_table(filtered(RAIL, [0.0] * 35, "equivalent-roughness"))
    words = ["--quantity", "equivalent-roughness", "--cnossos", str(tmp_path / "a3.csv")]
    assert main(["compare", "rail", *words]) == 2
    assert "--cnossos" in capsys.readouterr().err and not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_tool_gets_a_filter_for_a_load_that_the_table_lacks(tmp_path):
    out = tmp_path / "a3.csv"
    words = ["--tolerance", "1 dB", "--sweep", "wheel.load=50 kN,65 kN", "--cnossos", str(out)]
    assert main(["compare", "rail", *words]) == 0
    rows = list(csv.DictReader(out.read_text(encoding="utf-8").splitlines()))
    assert [row["wheel_load_kN"] for row in rows] == ["50"] * 35 + ["65"] * 35
    at_20_mm = [float(row["a3_dB"]) for row in rows if row["wavelength_mm"] == "20"]
    # a larger load has a larger contact, which takes more of the short waves; the table has -8.0 dB for 50 kN
    assert at_20_mm[1] < at_20_mm[0] == pytest.approx(-8.0, abs=1.0)
