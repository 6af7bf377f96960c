"""Files of lines as people have them: dead lines, rows of positions, repeated places, times, units, other programs."""

import zipfile
from dataclasses import replace

import numpy as np
import pytest

from tests.railway.test_line_outliers import rail
from tests.scenes.test_exported_tables import columns, in_memory, line_of, rail_with, refused, rows, told
from tests.seeded import catches
from validation.advice.compare import compare
from validation.advice.exported import to_json
from validation.advice.summary import summary
from validation.analysis.spectra import NominalBands
from validation.railway.problems.rail_models import rail_quantity, reason_of, what_would_state_the_ground
from validation.railway.scenes import measured_lines
from validation.railway.scenes.line_edits import edited
from validation.railway.scenes.measured_lines import along_the_track
from validation.scenes import table_files
from validation.scenes.load import load_scene
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.measured_surface import measured
from validation.scenes.table_files import heights_of_columns
from validation.simulation.model import Target

POINTS = 2400
"""Of a line at 1 mm."""
AT = np.arange(POINTS)
LINES = np.round([rail(seed)[:POINTS] for seed in (21, 22, 23)], 3)
Z = LINES[0]
UM = 'spacing = "1 mm"', 'unit = "um"'


def with_positions(*places):
    return (*UM, f"positions = [{', '.join(f'{chr(34)}{place} mm{chr(34)}' for place in places)}]")


# Lines that measured nothing


DEAD = {
    "a constant": (np.full(POINTS, 3.25), "is 3.25 everywhere"),
    "noise": (np.round(0.05 * np.random.default_rng(1).standard_normal(POINTS), 3), "is noise"),
    "loud noise": (np.round(9.0 * np.random.default_rng(1).standard_normal(POINTS), 3), "is noise"),
    "no data": (np.full(POINTS, np.nan), "has no data"),
}


@pytest.mark.parametrize("dead", DEAD)
def test_a_dead_line_is_left_out_with_its_position(tmp_path, dead):
    line, said = DEAD[dead]
    contents = columns("", LINES[0], LINES[1], line, LINES[2])
    scene = rail_with(tmp_path, "lines", contents, *with_positions(-10, -5, 0, 5))
    assert scene.roughness.positions == (-0.01, -0.005, 0.005)
    assert scene.roughness.height == pytest.approx(1e-6 * LINES.T)
    assert f"column 3 at 0 mm {said}" in told(scene)[0] and "is left out" in told(scene)[0]
    # positions of the lines that are left do as well
    scene = rail_with(tmp_path, "lines", contents, *with_positions(5, -5, -10))
    assert scene.roughness.positions == (-0.01, -0.005, 0.005)
    assert scene.roughness.height == pytest.approx(1e-6 * LINES.T[:, ::-1])
    refused(
        tmp_path, "lines", contents, *with_positions(-5, 5), said="one a line, got 2 for 3 lines, .* without column 3"
    )


def test_one_line_of_noise_is_no_line_that_others_show_to_be_dead(tmp_path):
    noise = np.round(np.random.default_rng(2).standard_normal((2, POINTS)), 3)
    scene = rail_with(tmp_path, "lines", columns("", *noise), *with_positions(0, 5))
    assert scene.roughness.height.shape == (POINTS, 2)


# Without a file


def lines_of(*values, header="", positions=None):
    return along_the_track(in_memory(columns(header, *values)), metre=1e-6, spacing=1e-3, positions=positions)


positions_of = measured_lines._positions_of


def positions_without_the_last(numbers, given, rest, dead):
    where, words = positions_of(numbers, given, rest, dead)
    return (given[: len(rest)] if given else where), words


@catches("positions of the first lines for those that are left").at(
    "validation.railway.scenes.measured_lines._positions_of", positions_without_the_last
)
def test_positions_of_dead_lines_go_with_them():
    found = lines_of(LINES[0], np.full(POINTS, 3.25), LINES[1], positions=[-0.01, 0.0, 0.01])
    assert list(found.positions) == [-0.01, 0.01] and found.height == pytest.approx(1e-6 * LINES[:2].T)


@catches("noise of a sensor taken for roughness").at(
    "validation.railway.scenes.measured_lines.noise_among", lambda lines: []
)
def test_noise_beside_rough_lines_is_no_line():
    found = lines_of(LINES[0], DEAD["noise"][0], LINES[1], positions=[-0.01, 0.0, 0.01])
    assert found.height.shape == (POINTS, 2) and list(found.positions) == [-0.01, 0.01]


@catches("a row of positions read as a point").at(
    "validation.railway.scenes.measured_lines._without_first_row", lambda numbers, given: (numbers, ())
)
def test_positions_in_a_first_row_are_no_point():
    found = lines_of(*np.concatenate([[[-10.0], [-5.0], [0.0]], LINES], axis=1), positions=[-0.01, -0.005, 0.0])
    assert found.height == pytest.approx(1e-6 * LINES.T)


@catches("times taken for places").at("validation.railway.scenes.measured_lines.EPOCH", (0.0, 0.0))
def test_seconds_since_1970_are_no_places():
    assert any("has time stamps" in note for note in lines_of(1714730400000 + AT, Z).notes)


# Rows and columns of places


def test_a_first_row_of_positions_is_no_row_of_heights(tmp_path):
    body = columns("", *LINES)[1:]
    for header, keys in (
        ("-10,0,10\n", with_positions(-10, 0, 10)),
        ("-10,-4,10\n", with_positions(-10, -4, 10)),
        ("100,200,300\n", with_positions(1, 2, 3)),
    ):
        scene = rail_with(tmp_path, "lines", header + body, *keys)
        assert scene.roughness.height == pytest.approx(1e-6 * LINES.T)
        assert f"its first row, {header.strip().replace(',', ', ')}, has positions" in told(scene)[0]
    refused(
        tmp_path, "lines", "1000,2000,3000\n" + body, *UM, said=r'as: positions = \["1000 mm", "2000 mm", "3000 mm"\]$'
    )
    refused(
        tmp_path, "lines", body, *UM, said=r'positions is missing: .*, as: positions = \["-10 mm", "0 mm", "10 mm"\]$'
    )
    placed = "".join(f"{i},{row}\n" for i, row in enumerate(("\n" + body).strip().split("\n")))
    scene = rail_with(tmp_path, "lines", ",-10,0,10\n" + placed, *with_positions(-10, 0, 10))
    assert scene.roughness.height == pytest.approx(1e-6 * LINES.T) and len(told(scene)) == 1


def test_places_that_repeat_turn_back_or_jump_are_named(tmp_path):
    def with_places(places, heights=Z):
        return columns("x [mm],z [um]", places, heights[: len(places)])

    again = with_places(
        np.append(AT[:1500], np.append([1499] * 30, AT[1500:])), np.append(Z[:1500], np.append([0.0] * 30, Z[1500:]))
    )
    scene = rail_with(tmp_path, "lines", again)
    assert line_of(scene) == pytest.approx(1e-6 * Z)
    assert "30 rows repeat the place of the row before, the first 1499 in row 1501" in told(scene)[0]
    back = with_places(np.concatenate([AT[:1500], AT[1400:1500][::-1], AT[1400:]])[:POINTS])
    refused(tmp_path, "lines", back, said="got x .mm., which runs back from 1499 to 1498 in row 1502")
    refused(tmp_path, "lines", with_places(AT + 0.4 * (AT > 1499)), said="jumps from 1499 to 1500.4 in row 1501")
    scene = rail_with(tmp_path, "lines", columns("z [um],x [mm]", Z[::-1], AT[::-1]))
    assert line_of(scene) == pytest.approx(1e-6 * Z)


def test_rows_without_data_at_the_ends_are_cut_off_and_counted(tmp_path):
    cells = np.where((AT < 40) | (AT >= POINTS - 100), "NaN", Z.astype(str))
    scene = rail_with(tmp_path, "lines", columns("x [mm],z [um]", AT, cells))
    assert line_of(scene) == pytest.approx(1e-6 * Z[40:-100])
    assert "rows without data are left out, 40 at its beginning and 100 at its end" in told(scene)[0]
    half = np.where(AT < POINTS * 0.6, "NaN", Z.astype(str))
    refused(tmp_path, "lines", columns("x [mm],z [um]", AT, half), said="heights must be known everywhere")


def test_gaps_of_places_are_named(tmp_path):
    kept = np.delete(AT, np.arange(1500, 1520))
    scene = rail_with(tmp_path, "lines", columns("x [mm],z [um]", kept, Z[kept]), "fill = true")
    assert "20 of its places have no row, the first behind 1499" in told(scene)[0]


# Times


STAMPS = {
    "ISO": "2024-05-03T10:00:0{}.250",
    "a clock": "10:00:0{}",
    "German": "03.05.2024 10:00:0{}",
    "American": "05/03/2024 10:00:0{} PM",
}


@pytest.mark.parametrize("stamp", STAMPS)
@pytest.mark.parametrize("header", ["", "time;z [um]\n"])
def test_time_stamps_are_named_with_keys_that_can_be_pasted(tmp_path, stamp, header):
    contents = header + rows((STAMPS[stamp].format(i % 9), z) for i, z in enumerate(Z))
    first = 2 if header else 1
    said = rf"got the time stamp .* in column 1 of line {first}, .* columns = \[2\]; of lines .*spacing = \"1 mm\"$"
    refused(tmp_path, "lines", contents, said=said)
    scene = rail_with(tmp_path, "lines", contents, "columns = [2]", *UM)
    assert line_of(scene) == pytest.approx(1e-6 * Z)


@pytest.mark.parametrize("name", ["t", "time"])
def test_numbers_that_are_times_are_no_places(tmp_path, name):
    for uneven in (0, 1):
        contents = columns(f"{name},z [um]", 1714730400000 + AT + uneven * (AT % 3 == 2), Z)
        scene = rail_with(tmp_path, "lines", contents, 'spacing = "1 mm"')
        assert line_of(scene) == pytest.approx(1e-6 * Z)
        assert f"{name} has time stamps and is left out" in told(scene)[0]


# Cells, names, units


ERRORS = [
    "#DIV/0!",
    "#VALUE!",
    "#N/A",
    "#REF!",
    "#NAME?",
    "#NUM!",
    "#NULL!",
    "Inf",
    "-inf",
    "Err:502",
    "#wert!",
    "n/a",
    "--",
]


def test_errors_of_spreadsheets_are_known_at_once_with_their_counts(tmp_path):
    cells = Z.astype(str).astype(object)
    cells[100 : 100 + len(ERRORS)], cells[2000] = ERRORS, "#DIV/0!"
    contents = columns("x [m],z [um]", AT / 1000, cells)
    refused(
        tmp_path, "lines", contents, said=r"got 14 of .*, cells with #DIV/0! 2, #VALUE! 1, .*Err:502 1.*: .*fill = true"
    )
    scene = rail_with(tmp_path, "lines", contents, "fill = true")
    assert np.delete(line_of(scene), [*range(100, 113), 2000]) == pytest.approx(
        1e-6 * np.delete(Z, [*range(100, 113), 2000])
    )
    assert "cells without a number have no data: #DIV/0! 2" in told(scene)[0]


@pytest.mark.parametrize("cell", ["#DIV0", "#", "infinite", "Err:5", "err"])
def test_other_words_are_no_missing_numbers(cell):
    with pytest.raises(ValueError, match="got"):
        in_memory(f"x;z\n1;2\n3;{cell}5\n4;5\n6;7\n")


@pytest.mark.parametrize(
    "name",
    [
        "Höhe [µm]",
        "Höhe [\N{GREEK SMALL LETTER MU}m]",
        "höhe [um]",
        "Höhe",
        "HÖHE  (µm)",
        "Ho\N{COMBINING DIAERESIS}he [µm]",
    ],
)
def test_a_column_is_named_as_the_file_has_it_or_without_its_unit(name):
    text = "Weg [mm];Höhe [µm];Höhe2 [V]\n1;2;3\n4;5;6\n7;8;9\n"
    assert in_memory(text, columns=(name,)).values[:, 0].tolist() == [2, 5, 8]
    with pytest.raises(ValueError, match=r'got "Hoehe": the table has 3, "Weg \[mm\]", "Höhe \[µm\]", "Höhe2 \[V\]"'):
        in_memory(text, columns=("Hoehe",))


of_columns = table_files.heights_of_columns


def in_the_unit_of_the_first(table, places, metre):
    one = table.columns[places[0]]
    return of_columns(replace(table, columns=(one,) * len(table.columns)), places, metre)


@catches("all columns in the unit of the first").at(
    ("validation.scenes.table_files.heights_of_columns", f"{__name__}.heights_of_columns"), in_the_unit_of_the_first
)
def test_each_column_has_its_own_unit():
    """All columns in the unit of the first are wrong by a factor of a thousand."""
    table = in_memory("a [um];b [mm];c [nm]\n1;2;3\n4;5;6\n7;8;9\n")
    np.testing.assert_allclose(
        heights_of_columns(table, [0, 1, 2], None), [[1e-6, 2e-3, 3e-9], [4e-6, 5e-3, 6e-9], [7e-6, 8e-3, 9e-9]]
    )
    np.testing.assert_allclose(heights_of_columns(table, [2, 0], None)[0], [3e-9, 1e-6])


def test_lines_in_several_units_are_named(tmp_path):
    contents = columns("a [um],b [mm]", LINES[0], np.round(1e-3 * LINES[1], 6))
    scene = rail_with(tmp_path, "lines", contents, 'spacing = "1 mm"', *with_positions(0, 5)[2:])
    assert scene.roughness.height == pytest.approx(1e-6 * LINES[:2].T)
    assert "its lines are in um and mm, each in its own" in told(scene)[0]


@catches("a large height taken for no data").at("validation.scenes.number_table.LONELY", 0.0)
def test_a_value_is_no_data_where_it_is_far_from_all_others_alone():
    """Three spans away, and not in a table whose values reach as far."""
    spread = np.linspace(-40.0, 60.0, 50)
    for far, gone in ((-9999.0, True), (32767.0, True)):
        text = "x;z\n" + rows((i, value) for i, value in enumerate([*spread, far]))
        assert np.isnan(in_memory(text).values[-1, 1]) == gone
        wide = "x;z\n" + rows((i, value) for i, value in enumerate([*(200 * spread), far]))
        assert in_memory(wide).values[-1, 1] == far


def test_a_unit_that_no_rail_has_is_doubted_unless_the_scene_says_it(tmp_path):
    contents = columns("x [mm],z [um]", AT, np.round(1e-3 * Z, 7))
    scene = rail_with(tmp_path, "lines", contents)
    assert "dB re the limit curve of ISO 3095, which no rail has: is the unit another" in told(scene)[0]
    assert scene.levels.fault and not compare(scene, tolerance="3 dB").met
    assert rail_with(tmp_path, "lines", contents, 'unit = "um"').levels.fault == ""


# Files of other programs


FOREIGN = {
    "it.h5": (b"\x89HDF\r\n\x1a\n" + bytes(500), "h5py"),
    "it.xlsx": (b"PK\x03\x04" + bytes(500), "save its sheet as"),
    "it.ods": (b"PK\x03\x04" + bytes(500), "save its sheet as"),
    "it.csv": (b"PK\x03\x04" + bytes(500), "a sheet is saved as CSV"),
    "it.xls": (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(500), "save its sheet as"),
    "it.mat": (b"MATLAB 5.0 MAT-file, Platform: GLNXA64" + bytes(500), "writematrix"),
    "it.al3d": (b"AliconaImaging\x00\r\n" + bytes(500), "exports heights as a text"),
    "it.parquet": (b"PAR1" + bytes(500), "read_parquet"),
}


@pytest.mark.parametrize("file", FOREIGN)
@pytest.mark.parametrize("kind", ["lines", "levels", "heights"])
def test_files_of_other_programs_are_exported_as_one_sentence_says(tmp_path, file, kind):
    contents, said = FOREIGN[file]
    keys = ['spacing = "1 mm"'] if kind != "levels" else []
    for more in ([], ["columns = [1]"]):
        refused(tmp_path, kind, contents, *keys, *more, said=f"the file must be a text, .*{said}", file=file)


# Surfaces


def test_a_first_row_of_coordinates_alone_is_no_row_of_heights(tmp_path):
    heights = np.round(np.random.default_rng(4).standard_normal((64, 48)), 3)
    text = ",".join(str(float(i)) for i in range(48)) + "\n" + rows(heights, ",")
    (tmp_path / "h.csv").write_text(text, encoding="utf-8")
    scene = tmp_path / "punch.toml"
    face = '[heights]\nfile = "h.csv"\nspacing = "1 um"\nunit = "um"\ncrop = true\n'
    body = 'name = "a"\n[punch]\nside = "48 um"\nload = "1 mN"\n[material]\ncontact_modulus = "1 GPa"\n'
    scene.write_text(body + face, encoding="utf-8")
    ground = load_scene(scene).ground
    assert ground.edits.cropped_from == (64, 48)
    assert any("its first row runs evenly, 1 µm apart, and is left out" in note for note in ground.notes())


def test_heights_may_keep_their_tilt_or_their_mean():
    x = np.arange(32.0)[:, np.newaxis]
    heights = np.random.default_rng(1).standard_normal((32, 24)) + 0.5 * x + 7.0
    found = {d: MeasuredHeights(height=heights, spacing=(1.0, 1.0), detrend=d) for d in ("none", "mean", "plane")}
    assert (found["none"].height == heights).all()
    np.testing.assert_allclose(found["mean"].height, heights - heights.mean())
    slope = np.polynomial.Polynomial.fit(np.arange(32.0), found["plane"].height.mean(axis=1), 1).convert().coef[1]
    assert slope == pytest.approx(0.0, abs=1e-12)
    assert any("was kept, as asked by detrend" in note for note in found["mean"].notes())
    with pytest.raises(ValueError, match="detrend must be one of none, mean, plane, got 'tilt'"):
        MeasuredHeights(height=heights, spacing=(1.0, 1.0), detrend="tilt")
    assert measured(_Face(heights), unit="m", detrend="none").height.max() == heights.max()


class _Face:
    def __init__(self, heights):
        self.heights, self.physical_sizes = heights, (32.0, 24.0)


# What comes out


def spiky(kind):
    line = Z.copy()
    if kind == "spikes":
        line[100:POINTS:96] += 90.0
    elif kind == "dropout":
        line[2000] = 5000.0
    elif kind == "clipped":
        line = line.clip(-10.0, 10.0)
    return columns("z [um]", line)


def asked(tmp_path, kind, *keys):
    scene = rail_with(tmp_path, "lines", spiky(kind), 'spacing = "1 mm"', *keys)
    return scene, compare(scene, tolerance="1 dB", models="linear, ellipse")


def test_the_result_of_lines_with_outliers_names_them(tmp_path):
    for kind, said in (("spikes", "has 24 spikes"), ("dropout", "has 1 dropout"), ("clipped", "is clipped at -10 µm")):
        _, found = asked(tmp_path, kind)
        for text in (summary(found), to_json(found)):
            assert said in " ".join(text.split())


def test_the_error_of_a_filter_has_what_outliers_leave(tmp_path):
    errors = {}
    for name, keys in (("clean", ()), ("spikes", ()), ("kept", ('outliers = "keep"',))):
        scene, found = asked(tmp_path, "spikes" if name != "clean" else "clean", *keys)
        errors[name] = found.errors_of(found.models[0])
        left = np.array(scene.levels.errors or [0.0] * len(scene.levels.levels))
        assert (rail_quantity(Target(scene, "contact-filter")).left_by_faults == left).all()
    known = np.isfinite(errors["clean"])
    assert (errors["spikes"][known] >= errors["clean"][known] - 0.1).all()
    assert errors["kept"][known].max() > errors["clean"][known].max() + 3


def test_nothing_is_within_a_tolerance_on_clipped_lines(tmp_path):
    scene, found = asked(tmp_path, "clipped")
    assert not found.met and found.model == ""
    text = " ".join(summary(compare(scene, tolerance=1.0)).split())
    assert "the roughness is not known: measured line 1 is clipped" in text


def test_no_more_lines_are_asked_for_where_a_dropout_is_at_fault(tmp_path):
    scene, _ = asked(tmp_path, "dropout", 'outliers = "keep"')
    target = Target(scene, "contact-filter")
    quantity = rail_quantity(target)
    assert what_would_state_the_ground(target).startswith("a measurement without the outliers that the notes name")
    a3 = quantity.linear.mean(axis=0)
    assert "outliers of the measured lines leave ± " in reason_of(quantity, a3, quantity.left_by_ground)
    clean, _ = asked(tmp_path, "clean")
    target = Target(clean, "contact-filter")
    quantity = rail_quantity(target)
    assert "outliers" not in what_would_state_the_ground(target)
    assert "outliers" not in reason_of(quantity, a3, quantity.left_by_ground)


def test_longer_bands_have_the_error_of_the_first(tmp_path):
    scene, _ = asked(tmp_path, "spikes")
    longer = rail_quantity(Target(scene, "contact-filter")).__class__(
        scene, "contact-filter", longest=NominalBands().longest
    )
    more = len(longer.bands) - len(scene.levels.levels)
    assert longer.left_by_faults[: more + 1].tolist() == [scene.levels.errors[0]] * (more + 1)


def test_a_spreadsheet_is_an_archive(tmp_path):
    with zipfile.ZipFile(tmp_path / "it.xlsx", "w") as archive:
        archive.writestr("xl/workbook.xml", "secret")
    contents = (tmp_path / "it.xlsx").read_bytes()
    refused(tmp_path, "lines", contents, *UM, said="a spreadsheet: save its sheet", file="it.xlsx")


THOUSANDS = [f"{i:,}" for i in range(2000)]


@pytest.mark.parametrize(("sign", "decimal"), [(",", "."), (".", ",")])
def test_whole_numbers_with_signs_between_thousands_are_no_decimals(tmp_path, sign, decimal):
    rng = np.random.default_rng(2)
    heights = np.rint(1e3 * np.cumsum(rng.standard_normal(2000)))
    rows = [f"{place};{height:,.0f}" for place, height in zip(THOUSANDS, heights, strict=True)]
    contents = "x [mm];z [nm]\n" + "\n".join(rows).replace(",", sign) + "\n"
    refused(tmp_path, "lines", contents, said=rf'which may be either: say it, as: decimal = "\{decimal}"$')
    scene = rail_with(tmp_path, "lines", contents, f'decimal = "{decimal}"', 'outliers = "keep"')
    assert scene.roughness.height[:, 0] == pytest.approx(1e-9 * heights)


def test_names_of_columns_that_are_places_are_no_units_of_heights(tmp_path):
    body = columns("", *LINES)[1:]
    for header in ("-10 mm,0 mm,10 mm\n", "-10,0,10\n"):
        contents = "x [mm]," + header + "".join(f"{i},{row}\n" for i, row in enumerate(body.strip().split("\n")))
        refused(tmp_path, "lines", contents, 'unit = "um"', said=r'positions = \["-10 mm", "0 mm", "10 mm"\]$')
        scene = rail_with(tmp_path, "lines", contents, 'unit = "um"', 'positions = ["-10 mm", "0 mm", "10 mm"]')
        assert scene.roughness.height == pytest.approx(1e-6 * LINES.T)


def test_a_line_that_mostly_has_no_data_is_left_out_with_its_position(tmp_path):
    dead = LINES[1].copy()
    dead[10:-10] = np.nan
    contents = columns("", LINES[0], dead, LINES[2])
    scene = rail_with(tmp_path, "lines", contents, *with_positions(-10, 0, 10))
    assert scene.roughness.height == pytest.approx(1e-6 * LINES[[0, 2]].T)
    assert scene.roughness.positions == pytest.approx((-0.01, 0.01))
    assert any("column 2 at 0 mm has no data in" in note for note in told(scene))


@pytest.mark.parametrize(
    "stamp", ["03-May-2024 10:00:00.001", "May 3, 2024 10:00", "3. Mai 2024 10:00", "Fri 3 May 2024"]
)
def test_dates_with_names_of_months_are_time_stamps(tmp_path, stamp):
    contents = "Time;z [um]\n" + "".join(f"{stamp};{z:.3f}\n" for z in Z)
    refused(
        tmp_path, "lines", contents, said=r"the time stamp .* in line|the time stamp .* of line 2, .* columns = \[2\]"
    )


def test_a_unit_that_the_header_has_wrong_is_changed_as_the_message_says(tmp_path):
    contents = "x [mm],z [mm]\n" + "".join(f"{i},{z:.3f}\n" for i, z in enumerate(Z))
    refused(
        tmp_path, "lines", contents, said=r'skip = 1 leaves out the header, beside unit = "um" and spacing = "1 mm"'
    )
    scene = rail_with(tmp_path, "lines", contents, "skip = 1", *UM)
    assert scene.roughness.height[:, 0] == pytest.approx(1e-6 * Z, abs=1e-9)


def test_bars_and_utf_16_without_a_mark_are_read(tmp_path):
    contents = "".join(f"{i}|{z:.3f}\n" for i, z in enumerate(Z))
    assert "bars between its columns" in told(rail_with(tmp_path, "lines", contents, *UM))[0]
    for encoding in ("utf-16-le", "utf-16-be"):
        scene = rail_with(tmp_path, "lines", contents.encode(encoding), *UM)
        assert scene.roughness.height[:, 0] == pytest.approx(1e-6 * Z, abs=1e-9)


def test_the_error_of_long_gaps_covers_nineteen_of_twenty_bands():
    off, bands = [], NominalBands().within(0.9, 2.5e-3)
    for seed in range(12):
        line = 1e-6 * rail(seed)[:4000]
        held = line.copy()
        held[2000:2160] = 12.345e-6
        edits = edited(held[:, np.newaxis], 1e-3)
        both = bands.powers_of_records(np.array([line, edits.result(held[:, np.newaxis])[:, 0]]), spacing=1e-3)
        change = np.abs(10 * np.log10(both[1] / both[0]))
        off.append(change > np.array(edits.errors(bands, both[1:])))
    assert np.mean(off) < 0.05
