"""The references of the judges are what the report shows, and name what they are."""

from pathlib import Path

import numpy as np
import pytest

from tests.advice.script import run
from tests.seeded import catches
from validation.engine.engine import SERIAL
from validation.judging.kinds import held_out_points, interfaces, references, rolling, stiffness
from validation.judging.kinds.from_report import HELD_OUT, SOURCES, Report
from validation.judging.kinds.held_out_points import held_out
from validation.judging.kinds.own import ERRORS
from validation.judging.kinds.references import about, as_file, file_name, reference_rows
from validation.judging.kinds.rolling import EACH, GRIDS, HEIGHTS, LIFT, MEAN
from validation.judging.kinds.stiffness import OF_SURFACE
from validation.report.folder import REFERENCES, Folder
from validation.simulation.rolling_strip import roll_strip

REPORT = Path(__file__).parents[2] / "reports" / "reference"
SOLVED = (MEAN, EACH, LIFT, OF_SURFACE, ERRORS, *HELD_OUT)
"""Take solves that the report does not keep."""
AFTER_THE_REPORT = (interfaces.AREA, interfaces.GAP)
"""The committed report may be older; its next has them."""


@pytest.mark.parametrize("quantity", [name for name in SOURCES if name not in SOLVED])
def test_a_file_is_what_the_committed_report_shows(quantity):
    """Otherwise the report was made anew: `calibrate --references reports/reference`, then `.ci/calibrate.py`."""
    try:
        rows = [row for row in SOURCES[quantity].find(Report(REPORT), SERIAL) if np.isfinite(row.value)]
    except (ValueError, FileNotFoundError) as older:
        if quantity not in AFTER_THE_REPORT:
            raise
        pytest.skip(f"the committed report is older than this quantity: {older}")
    assert [row.where for row in reference_rows(quantity)] == [
        {name: place if isinstance(place, str) else float(f"{place:.7g}") for name, place in row.where.items()}
        for row in rows
    ]
    for name in references.VALUES:
        mine, report = ([getattr(row, name) for row in some] for some in (reference_rows(quantity), rows))
        assert mine == pytest.approx(report, rel=1e-3 if name != "value" else 1e-6)
    assert about(quantity)["settings"] == Report(REPORT).settings(SOURCES[quantity].case)


def test_all_of_them_are_small_and_complete():
    assert references.quantities() == sorted(SOURCES, key=file_name)
    assert sum(path.stat().st_size for path in references.FOLDER.iterdir()) < 3e6
    for quantity in SOURCES:
        rows = reference_rows(quantity)
        assert rows and all(np.isfinite([row.value, row.sample, row.grid]).all() for row in rows)
        assert all(min(row.sample, row.grid) >= 0 for row in rows)
        assert set(about(quantity)) == {"quantity", "unit", "case", "commit", "settings"}


def test_positions_are_those_of_boundary_elements_on_the_strip():
    """The coarse grid is three times as far off as what the two grids leave."""
    height, coarse = HEIGHTS[-1], GRIDS[0]
    (strip,) = rolling.strip_of(height).strips(coarse, 1e-4 * height, 1)
    force = roll_strip(strip)["force"]
    rows = [row for row in reference_rows(EACH) if row.where["h/d"] == height]
    left = np.array([2 * abs(row.value) * row.grid for row in rows])
    assert np.abs(force - [row.value for row in rows]) == pytest.approx(left * 1.5, abs=2e-4)


class Made:
    """An engine whose forces are 2, and off by a tenth of a cell."""

    def map_groups(self, solve, groups):
        return {
            key: [{"force": np.full(round(strip.scene.length * strip.cells), 2 + 0.1 / strip.cells)}]
            for key, (strip,) in groups.items()
        }


def test_positions_are_extrapolated_to_cells_of_no_size():
    rows = list(SOURCES[EACH].find(None, Made()))
    assert [row.value for row in rows] == pytest.approx([2.0] * len(rows))
    assert [row.grid for row in rows] == pytest.approx([0.1 / GRIDS[1] / 2] * len(rows))
    assert [row.where for row in rows] == [row.where for row in reference_rows(EACH)]


class Pressed:
    """An engine whose finer grid is 10 % stiffer on one half of the surfaces, and 10 % less stiff on the other."""

    def map_groups(self, solve, groups):
        sign = {stiffness.CELLS: 0.0, 2 * stiffness.CELLS: 1.0}
        return {
            (hurst, cells): [
                {"stiffness": np.full(len(stiffness.FORCES), np.exp(0.1 * sign[cells] * (-1) ** i))}
                for i in range(len(of))
            ]
            for (hurst, cells), of in groups.items()
        }


def test_a_surface_is_known_as_well_as_its_two_grids_agree():
    """All loads are asked, and a right answer on the cells that a model is given does not differ."""
    rows = list(stiffness.solved_surfaces(Pressed()))
    assert len(rows) == 3 * 8 * len(stiffness.FORCES) == len(reference_rows(OF_SURFACE))
    assert [row.value for row in rows[:: len(stiffness.FORCES)][:2]] == pytest.approx(np.exp([0.1, -0.1]))
    assert [row.grid for row in rows] == pytest.approx([2.306 * 0.1] * len(rows), rel=1e-3)


def test_what_is_written_is_read_and_what_is_unknown_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(references, "FOLDER", tmp_path)
    row = references.Reference({"H": 0.7, "across": "ridges"}, 2.0, 0.5, 0.25, quantity="a level, of mine")
    (tmp_path / file_name("a level, of mine")).write_bytes(as_file({"quantity": "a level, of mine"}, [row]))
    assert reference_rows("a level, of mine") == [row]
    with pytest.raises(LookupError, match="a level, of mine, got 'mass'"):
        reference_rows("mass")


def test_the_script_puts_references_that_were_made_in_the_place_of_those_of_the_package(tmp_path, monkeypatch, capsys):
    made, package = tmp_path / "references", tmp_path / "package"
    package.mkdir()
    monkeypatch.setattr(references, "FOLDER", package)
    with Folder(made, kind=REFERENCES) as folder:
        folder.replace({"a_level.csv": b"made"})
    assert run("--references", str(made)) == run("--references", str(package), "--install") == 2
    assert capsys.readouterr().err.count("error: --references must be a folder of mdr-validation calibrate") == 2
    assert run("--references", str(made), "--install") == 0
    assert [(path.name, path.read_bytes()) for path in package.iterdir()] == [("a_level.csv", b"made")]


def test_a_folder_without_a_full_report_is_refused(tmp_path):
    with pytest.raises(ValueError, match="the folder of a full report"):
        Report(tmp_path)


def test_held_out_faces_are_those_of_boundary_elements_on_the_finer_grid():
    """Two of them under the heavier loads, by transforms alone."""
    rows = [row for row in reference_rows(held_out(OF_SURFACE)) if row["Fbar"] > 0.05]
    for face in held_out_points.FACES[1:3]:
        found = held_out_points.press_face(held_out_points.PressedFace(face, held_out_points.FACE_CELLS))
        stored = [row for row in rows if row.where["surface"] == str(face)]
        for row, value in zip(stored, found["stiffness"][1:], strict=True):
            assert value == pytest.approx(row.value, rel=1.5 * row.grid) and row.grid < 0.02


def test_a_face_whose_waves_are_elongated_is_rougher_across_than_along():
    """A gradient of twice the size along axis 1, on one face as on any grid."""
    plain, elongated = (held_out_points.HeldOutSurface(0.6, n, 0).height(192) for n in (1, 2))
    along, across = (float(np.std(np.diff(elongated, axis=axis))) for axis in (0, 1))
    assert across / along == pytest.approx(2.0, rel=0.1)
    assert np.std(np.diff(plain, axis=1)) / np.std(np.diff(plain, axis=0)) == pytest.approx(1.0, rel=0.1)
    fine = held_out_points.HeldOutSurface(0.6, 2, 0).height(576)
    assert fine[1::3, 1::3] == pytest.approx(elongated, abs=1e-9)


def test_held_out_positions_are_those_of_boundary_elements_on_cells_of_two_lengths():
    """The coarse grid is three times as far off as what the two grids leave."""
    scene, height = held_out_points.THIRD, held_out_points.HEIGHTS[-1]
    found = held_out_points.roll_oblong(held_out_points.OblongStrip(scene, height, GRIDS[0], by_load=False))
    rows = [row for row in reference_rows(held_out(EACH), where=scene.where) if row["h/d"] == height]
    left = np.array([2 * abs(row.value) * row.grid for row in rows])
    assert np.abs(found["value"] - [row.value for row in rows]) == pytest.approx(left * 1.5, abs=2e-4)
    assert scene.lateral == 2 and scene.surface(height, 8).shape[1] == 2 * 8 * round(held_out_points.WIDTH)


@catches("held-out loads that are those of the table").at("validation.judging.kinds.held_out_points.LOADS", (0.01, 0.1))
def test_held_out_scenes_are_none_of_the_tables():
    table = {(row["H"], 64) for row in reference_rows("mean stiffness")}
    assert not {(one.hurst, one.ratio) for one in held_out_points.PUNCHES} & table
    loads = {round(row["Fbar"], 6) for row in reference_rows("mean stiffness")}
    assert not {round(force, 6) for force in held_out_points.LOADS} & loads
    assert all(scene.wheel != rolling.MAIN and scene.hurst != 0.7 for scene in held_out_points.SCENES)


def test_held_out_levels_are_those_of_linear_theory_on_smooth_roughness():
    """Within their errors, which are less than half a decibel; and below it on rougher ones."""
    for scene in held_out_points.SCENES:
        for row in reference_rows(held_out(rolling.RMS), where=scene.where):
            linear = 10 * np.log10(rolling.variance_of(scene.spectrum))
            half = row.sample + row.grid
            assert half < 0.5
            assert abs(row.value - linear) < half + 0.02 if row["h/d"] < 0.1 else row.value < linear
