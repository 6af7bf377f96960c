"""Names of the files below data: ASCII, short, unique, and the same whenever they are made."""

import json
import re

import pytest

from tests.report.remade import REFERENCE, sections
from validation.analysis.contents import csv_name
from validation.analysis.quantity import Quantity
from validation.report.columns import described
from validation.report.section import written_tables

LONG = "part of a sweep without the right message: none past the threshold, or one before it"


@pytest.mark.parametrize(
    ("table", "name"),
    [
        ("rms force, judged", "case-rms_force_judged.csv"),
        ("C_1D [m³]", "case-C_1D_m3.csv"),
        ("peak / ω_eigen", "case-peak_omega_eigen.csv"),
        ("α, λ and µ of β", "case-alpha_lambda_and_u_of_beta.csv"),
        ("Heß at 5 °", "case-He_at_5.csv"),
        (LONG, "case-part_of_a_sweep_without_the_right_message-81bfa7.csv"),
        (f"{LONG}, judged", "case-part_of_a_sweep_without_the_right_message-8c8508.csv"),
        (Quantity("force_over_bem", LONG), "case-force_over_bem.csv"),
    ],
)
def test_a_name_is_that_of_the_key_in_ascii_and_shortened_with_a_digest(table, name):
    assert csv_name("case", table) == name


def test_the_committed_names_are_ascii_short_and_unique():
    names = [path.name for room in ("data", "figures", "sounds") for path in (REFERENCE / room).iterdir()]
    assert all(re.fullmatch(r"[\w.+'-]+", name, flags=re.ASCII) and len(name) < 60 for name in names)
    assert len({name.casefold() for name in names}) == len(names) > 250


def test_each_table_of_the_committed_report_has_its_file():
    listed = json.loads((REFERENCE / "manifest.json").read_text(encoding="utf-8"))["files"]
    names = [csv_name(one.name, table.name) for one in sections() for table in written_tables(one.evidence)]
    assert len(set(names)) == len(names) and {f"data/{name}" for name in names} <= listed.keys()


def test_a_shortened_name_has_the_meanings_of_its_table():
    """The list of columns is written by the whole name, and has the file as it is called."""
    (section,) = [one for one in sections() if one.name == "ladder"]
    table = next(one for one in written_tables(section.evidence) if str(one.name).startswith("true error at the edges"))
    rows = list(described("ladder", table))
    assert ("by how much; 0 where none is above" in {row[3] for row in rows}) and len(rows[0]) == 4
    assert {row[0] for row in rows} == {"*", csv_name("ladder", table.name)}
