"""A contact filter for tools that map noise: the columns and wavelengths of the table of CNOSSOS-EU."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import validation
from tests.selection.test_model_hierarchy import Finding
from validation.__main__ import main
from validation.selection.compare import Comparison
from validation.selection.filter_table import filter_table
from validation.selection.hierarchy import select_model

PUBLISHED = Path(validation.__file__).parent / "cases" / "rail" / "cnossos_a3_2021.csv"
RAIL = validation.load_scene("rail")


def table_published():
    lines = PUBLISHED.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def filtered(scene, a3, quantity="contact-filter"):
    return Comparison(scene, quantity, select_model([Finding(value=tuple(10 ** (np.array(a3) / 20)))], 0.2))


def test_a_filter_has_the_columns_and_the_wavelengths_of_the_table():
    a3 = -np.arange(35) / 8
    found, published = filter_table(filtered(RAIL, a3)), table_published()
    mine = [row for row in published if (row["wheel_load_kN"], row["wheel_diameter_mm"]) == ("50", "920")]
    assert list(found.columns) == list(published[0])
    nominal = [float(row["wavelength_mm"]) for row in mine]
    assert found["wavelength_mm"].tolist() == filtered(RAIL, a3).wavelength_mm.tolist() == nominal
    assert (set(found["wheel_load_kN"]), set(found["wheel_diameter_mm"])) == ({50.0}, {920.0})
    assert found["a3_dB"] == pytest.approx(a3, abs=0.0501)


def test_waves_longer_than_those_of_the_scene_pass_and_shorter_ones_are_left_out():
    levels = RAIL.levels
    inner = slice(5, 20)
    short = replace(levels, wavelengths=levels.wavelengths[inner], levels=levels.levels[inner])
    scene, a3 = replace(RAIL, roughness=short), np.array([-0.04] + [-1.04] * 14)
    found = filter_table(filtered(scene, a3))["a3_dB"]
    assert found[:6].tolist() == [0.0] * 6 and found[6:20].tolist() == [-1.0] * 14 and np.isnan(found[20:]).all()
    # where the longest of them does not pass, longer ones are not known to
    assert np.isnan(filter_table(filtered(scene, a3 - 0.1))["a3_dB"][:5]).all()


def test_what_is_no_filter_is_refused(tmp_path, capsys):
    with pytest.raises(ValueError, match=r"--cnossos is for the quantity contact-filter of a rail, got equivalent"):
        filter_table(filtered(RAIL, [0.0] * 35, "equivalent-roughness"))
    words = ["--quantity", "equivalent-roughness", "--cnossos", str(tmp_path / "a3.csv")]
    assert main(["compare", "rail", *words]) == 2
    assert "--cnossos" in capsys.readouterr().err and not list(tmp_path.iterdir())


def test_a_tool_gets_a_filter_for_a_load_that_the_table_lacks(tmp_path):
    out = tmp_path / "a3.csv"
    words = ["--tolerance", "1 dB", "--sweep", "wheel.load=50 kN,65 kN", "--cnossos", str(out)]
    assert main(["compare", "rail", *words]) == 0
    rows = list(csv.DictReader(out.read_text().splitlines()))
    assert [row["wheel_load_kN"] for row in rows] == ["50"] * 35 + ["65"] * 35
    at_20_mm = [float(row["a3_dB"]) for row in rows if row["wavelength_mm"] == "20"]
    # a larger load has a larger contact, which takes more of the short waves; the table has -8.0 dB for 50 kN
    assert at_20_mm[1] < at_20_mm[0] == pytest.approx(-8.0, abs=1.0)
