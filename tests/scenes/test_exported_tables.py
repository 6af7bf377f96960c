"""Tables as others export them: delimiter, decimal sign, header, units, encoding and places are recognised and told."""

import io
import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.railway.test_rail_files import CURVE, LEVELS, loaded
from tests.seeded import catches
from validation.railway.scenes import level_files
from validation.railway.scenes.measured_lines import MeasuredLines, along_the_track
from validation.scenes import text_dialect
from validation.scenes.description import description_lines
from validation.scenes.measured_heights import edited_lines
from validation.scenes.number_table import TableForm, faults_of_places, places_of, runs_one_way, table_of_text
from validation.scenes.text_dialect import WRITTEN, Column, Dialect, column_of, columns_of, unit_of_all

BANDS = ((100, 4.9), (80, 2.9), (63, 0.9), (50, -1.2), (40, -3.0), (31.5, -5.1))
"""Nominal wavelengths [mm] and levels [dB]."""
TAB = "\t"
CYCLES, LEVEL = (10, 12.5, 16, 20, 25, 31.5), [level for _, level in BANDS]
Z = np.round(5 * np.random.default_rng(2).standard_normal(800), 3)
"""A line of 5 um."""


def comma(value):
    return str(value).replace(".", ",")


def rows(values, delimiter=";", form=str):
    return "".join(delimiter.join(map(form, row)) + "\n" for row in values)


def rail_with(folder, kind, contents, *keys, file="it.csv"):
    (folder / file).write_bytes(contents if isinstance(contents, bytes) else contents.encode("utf-8"))
    lines = "\n".join((f'file = "{file}"', *keys))
    return loaded(folder, (f"{LEVELS} ", f"[rail.{kind}]\n# "), ('# = "iso3095-2013"', f"{lines}\n#"))


def told(scene):
    return [note for note in scene.diagnose() if note.startswith("it.")]


def refused(folder, kind, contents, *keys, said, **settings):
    with pytest.raises(ValueError, match=said) as problem:
        rail_with(folder, kind, contents, *keys, **settings)
    assert "\n" not in str(problem.value) and len(str(problem.value)) < 500 + 2 * len(str(folder))


# Levels


CM = [(w / 10, level) for w, level in BANDS]
GERMAN = f"Wellenlänge [cm];Pegel [dB re 1 µm]\n{rows(CM, form=comma)}".replace("\n", "\r\n")
SHEET = f"\ufeffwavelength (mm);level (dB)\n{rows(BANDS, form=comma)};\n;\n".replace("\n", "\r\n")
WIDE = "EN 15610:2019\nSite: town, km 12.4\nOperator\tN.N.\nPoints\t6\n\n"
QUOTED = '"wavelength [mm]","level [dB]"\n' + rows(BANDS, ",", lambda value: f'"{comma(value)}"')
COUNTED = rows((i, level, w) for i, (w, level) in enumerate(BANDS))
RADIANS = rows(((2000 * np.pi / w, level) for w, level in BANDS), ",")
EXPORTS = {
    "German, Latin-1, Windows": (GERMAN.encode("latin-1"), "semicolons between its columns, decimal commas, the encod"),
    "German, UTF-8": (GERMAN, "it has semicolons between its columns, decimal commas."),
    "Greek mu": (GERMAN.replace("µ", "\N{GREEK SMALL LETTER MU}"), "decimal commas."),
    "a spreadsheet": (SHEET, "semicolons between its columns, decimal commas."),
    "a standard table": (f"{WIDE}Wavelength / cm\tLr / dB re 1 µm\n{rows(CM, TAB)}", "tabs between its columns, 5 lin"),
    "units in a line of their own": (f"lambda;L\nmm;dB\n{rows(BANDS)}", "2 lines above its numbers."),
    "quotation marks": (QUOTED, "it has decimal commas."),
    "spaces": (f"% wavelength [mm]   L [dB]\n{rows(BANDS, '   ')}", "it has spaces between its columns."),
    "cycles": (f"k [1/m],L [dB]\n{rows(zip(CYCLES, LEVEL, strict=True), ',')}", "its wavenumbers in 1/m are cycles"),
    "radians": (f"k [rad/m],L [dB]\n{RADIANS}", "its wavenumbers in rad/m are k = 2 pi / wavelength"),
    "upwards": (f"\ufeffwavelength_m;level_dB\n{rows((w / 1000, z) for w, z in BANDS[::-1])}", "semicolons"),
    "a last line": (f"lambda [mm];L [dB]\n{rows(BANDS)}\nEnd of file\n", "columns; 1 line below its num"),
    "a count and bands without levels": (f"no;L [dB];lambda [mm]\n{COUNTED}9;-;25\n", "1 of its rows have no level"),
}


@pytest.mark.parametrize("export", EXPORTS)
def test_levels_are_read_as_they_are_exported_and_how_is_told(tmp_path, export):
    contents, said = EXPORTS[export]
    scene = rail_with(tmp_path, "levels", contents)
    assert scene.levels.levels == tuple(level for _, level in BANDS)
    assert scene.levels.bands.nominal.tolist() == [w / 1000 for w, _ in BANDS]
    (note,) = told(scene)
    assert said in note
    assert f"note: {note}" in description_lines(scene)


TIMED = "time;lambda [mm];L [dB]\n" + rows((f"12:30:{i}", w, level) for i, (w, level) in enumerate(BANDS))
TWO = "wavelength [cm],left [dB],right [dB]\n" + rows(((w / 10, level, level + 1) for w, level in BANDS), ",")


@pytest.mark.parametrize(
    ("contents", "key", "said"),
    [
        (rows(BANDS, " "), 'unit = "mm"', r'got column 1 and column 2: without such names, .* unit = "mm"'),
        (TWO, 'columns = ["wavelength", "left"]', r"left \[dB\] and right \[dB\]: say which, as: columns = \[1, 2\]"),
        (TWO, "columns = [1, 2]", "columns"),
        (rows(((w, 2) for w, _ in BANDS[:3]), ","), 'decimal = ","', 'as: decimal = ","'),
        ("1\n2\n3\nwavelength [mm];L [dB]\n" + rows(BANDS), "skip = 3", "skip"),
        ("wavelength [mm];L [dB]\n125;x\n" + rows(BANDS), 'nodata = "x"', 'as: nodata = "x"'),
        ("wavelength [mm];L [dB]\n" + rows(BANDS) + "25;77.7\n", "nodata = 77.7", "level"),
        (GERMAN.replace("µ", "u").encode("cp500"), 'encoding = "cp500"', "got none in its first 8 lines: .*, encoding"),
        (
            TIMED,
            'columns = ["lambda", "L"]',
            r"the time stamp '12:30:0' in column 1 of line 2, .* as: columns = \[2, 3\]; of lines",
        ),
        ("text\n" * 3000 + "lambda [mm];L [dB]\n" + rows(BANDS), "skip = 3000", "skip leaves out more"),
        (TWO.replace(" [dB]", ""), "columns = [1, 2]", "left and right: the key columns has the two that are read"),
    ],
)
def test_keys_decide_where_recognition_cannot(tmp_path, contents, key, said):
    refused(tmp_path, "levels", contents, said=said)
    if "decimal" in key:
        refused(tmp_path, "levels", contents, key, said=r"columns must be named .* got column 1")
    else:
        assert rail_with(tmp_path, "levels", contents, key).levels.levels[0] == BANDS[0][1]


@pytest.mark.parametrize(
    ("key", "said"),
    [
        ("skip = -1", r"levels\.skip must be at least 0"),
        ("columns = []", r"levels\.columns must be names or numbers"),
        (
            'columns = [1, "x"]',
            r'columns must name one column each, got "x": the table has 2, "wavelength \[mm\]", "level \[dB\]"',
        ),
        ("columns = [1, 3]", r"columns must be numbers from 1 to 2, or names, got 3"),
        ('decimal = ";"', r'levels\.decimal must be "\." or ","'),
        ('encoding = "klingon"', r'levels\.encoding must be an encoding, as "latin-1"'),
        ('unit = "inch"', r"levels\.unit must be one of"),
        ('unit = "cm"', r'unit must be that of the column wavelength \[mm\], or be left out, got "cm"'),
        ("nodata = [[1]]", r"levels\.nodata must be"),
        ('curve = "iso3095-2013"', "one of curve, file"),
    ],
)
def test_keys_are_refused_by_name(tmp_path, key, said):
    refused(tmp_path, "levels", "wavelength [mm],level [dB]\n" + rows(BANDS, ","), key, said=said)


def test_a_curve_has_no_use_for_the_keys_of_a_file(tmp_path):
    with pytest.raises(ValueError, match=r'rail\.levels\.skip must be left out beside a curve, got it with "iso3095'):
        loaded(tmp_path, (CURVE, f"{CURVE}\nskip = 3"))


GROUPED = ["1.000,5", '"1,000.5"', "1 000,5", "1'000.5", "1\N{NARROW NO-BREAK SPACE}000,5", "1\N{NO-BREAK SPACE}000.5"]


@pytest.mark.parametrize("number", GROUPED)
def test_signs_between_thousands_are_read_where_they_can_be_nothing_else(number):
    decimal = "," if ",5" in number else "."
    text = "x [mm];z [um]\n" + f"999.5;3.5\n{number};3.5\n-{number.strip(chr(34))};1\n".replace("9.5", f"9{decimal}5")
    table = in_memory(text.replace("3.5", f"3{decimal}5"))
    assert table.values.tolist() == [[999.5, 3.5], [1000.5, 3.5], [-1000.5, 1.0]]
    assert "2 of its rows have a sign between thousands" in table.notes


@pytest.mark.parametrize(
    ("number", "value"),
    [("1.234.567", 1234567.0), ("1'234", 1234.0), ("1,234,567.5", 1234567.5), ("12 345 678", 12345678.0)],
)
def test_whole_thousands_are_read(number, value):
    assert in_memory(f"x;z\n1;2\n{number};3\n4;5\n").values[1, 0] == value


@pytest.mark.parametrize(("number", "decimal"), [("1,234", "."), ("1.234", ",")])
def test_one_sign_that_may_be_either_asks_for_the_decimal_sign(number, decimal):
    text = f"x;z\n1{decimal}5;2\n{number};3\n4{decimal}5;5\n"
    with pytest.raises(
        ValueError, match=rf"got '{number}' in line 3, which may be either: say it, as: decimal = .{decimal}."
    ):
        in_memory(text)
    assert in_memory(text, decimal=decimal).values[:, 0].tolist() == [1.5, 1234.0, 4.5]
    # where it is the decimal sign of the table it is no other
    assert in_memory(f"x;z\n{number};2\n1;3\n2;4\n").values[0, 0] == 1.234


@pytest.mark.parametrize("number", ["1.23,4", "1,2345.0", "1'23", "12.34.567", "1,234.567,8", "1 2345"])
def test_other_signs_within_numbers_are_refused(number):
    with pytest.raises(ValueError, match="got '1"):
        in_memory(f"x;z\n1;2\n{number};3\n4;5\n6;7\n")


# Foreign files


@pytest.mark.parametrize(
    "contents",
    [
        b"root:secret:0:0:root:/root:/bin/bash\n" * 30,
        b"\x7fELF secret" * 40,
        b"PK\x03\x04 secret",
        b"%PDF-1.7\nsecret secret secret\n\xe2\xe3\xcf\xd3\x00\n",
        b'{"secret": "secret secret secret secret secret"}',
        "secret\n".encode("utf-16"),
    ],
)
@pytest.mark.parametrize("file", ["it.csv", "it.npy", "it.npz"])
@pytest.mark.parametrize("kind", ["lines", "heights", "levels"])
def test_nothing_of_a_foreign_file_is_shown(tmp_path, contents, file, kind):
    with pytest.raises(ValueError) as problem:
        rail_with(tmp_path, kind, contents, *(['spacing = "1 mm"'] if kind != "levels" else []), file=file)
    assert "secret" not in str(problem.value)


def test_a_bad_cell_is_shown_short_and_by_its_line(tmp_path):
    contents = rows(enumerate(Z), ";").replace("\n", "\r\n").replace("7;", "7;" + 50 * "word", 1)
    refused(tmp_path, "lines", contents, said=r"got 'wordwordwordwordword\.\.\.' in column 2 of line 8: ")


# Lines


HEADER = "".join(f"Key {i}: value {i}\n" for i in range(17)) + "Points\t800\nDate\t2024-05-01\n"


def line_of(scene):
    assert isinstance(scene.roughness, MeasuredLines)
    return scene.roughness.height[:, 0]


def columns(header, *values, delimiter=",", form=str):
    return f"{header}\n" + rows(zip(*values, strict=True), delimiter, form)


AT = np.arange(800)
PLACED = {
    "a trolley": (HEADER + columns("x (mm)\theight (um)", AT, Z, delimiter="\t"), 1e-3),
    "commas": (columns("x [mm];z [µm]", AT, Z, delimiter=";", form=comma), 1e-3),
    "heights first": (columns("z [um],x [m]", Z, AT / 2000), 0.5e-3),
    "a count, too": (columns("n,x [mm],z [um]", AT + 1, AT / 2, Z), 0.5e-3),
    "a time, too": (columns("t [s],x [mm],z [um]", AT / 8, AT, Z), 1e-3),
    "a constant, too": (columns("x [mm],y [mm],z [um]", AT, 3.5 + 0 * AT, Z), 1e-3),
    "rounded": (columns("x [mm],z [um]", [f"{i / 3:.2f}" for i in AT], Z), 1e-3 / 3),
    "downwards": (columns("x [mm],z [um]", [f"{(800 - i) / 4:.2f}" for i in AT], Z), -0.25e-3),
    "from a kilometre on": (columns("x [m],z [um]", [f"{12345 + i / 1000:.3f}" for i in AT], Z), 1e-3),
}
XZ = columns("x [mm],z [um]", AT, Z)


@pytest.mark.parametrize("export", PLACED)
def test_a_column_that_runs_evenly_is_the_place_and_no_line(tmp_path, export):
    contents, step = PLACED[export]
    scene = rail_with(tmp_path, "lines", contents)
    assert line_of(scene) == pytest.approx(1e-6 * Z[:: -1 if step < 0 else 1], rel=1e-12)
    assert scene.roughness.spacing == pytest.approx(abs(step), rel=1e-4)
    (note,) = told(scene)
    assert "is the place along the track" in note and "apart, and " in note


@pytest.mark.parametrize("spacing", ["1 mm", "1 cm"])
def test_places_without_a_unit_have_that_of_the_spacing(tmp_path, spacing):
    """A column of millimetres was a second line: rms 3.75 for 5.3 um."""
    np.save(tmp_path / "it.npy", np.stack([np.arange(800.0), Z], axis=1))
    contents = (tmp_path / "it.npy").read_bytes()
    scene = rail_with(tmp_path, "lines", contents, f'spacing = "{spacing}"', 'unit = "um"', file="it.npy")
    assert line_of(scene) == pytest.approx(1e-6 * Z)
    step = spacing.replace("1 cm", "10 mm")
    assert told(scene) == [f"it.npy: column 1 is the place along the track, {step} apart, and column 2 is a line."]
    for key, said in (
        ('unit = "um"', 'missing: .* as: spacing = "1 mm"$'),
        ('spacing = "3 mm"', "that of column 1, 1 ap"),
    ):
        refused(tmp_path, "lines", contents, key, file="it.npy", said=f"spacing .*{said}")


def test_a_spacing_that_disagrees_with_the_places_is_refused(tmp_path):
    contents = PLACED["rounded"][0]
    said = r"rail\.lines\.spacing must be that of x \[mm\], 333\.\d+ µm, or be left out, got 1 mm$"
    refused(tmp_path, "lines", contents, 'spacing = "1 mm"', said=said)
    assert rail_with(tmp_path, "lines", contents, 'spacing = "0.3333 mm"').roughness.spacing == 0.3333e-3


def test_a_spacing_may_differ_from_that_of_the_places_by_its_rounding_alone(tmp_path):
    """By 0.2 %: a spacing that is a hundredth off would shift all wavelengths by as much."""
    contents = columns("x [mm],z [um]", AT, Z)
    for near in ("1.0015 mm", "0.9985 mm"):
        assert rail_with(tmp_path, "lines", contents, f'spacing = "{near}"').roughness.spacing == pytest.approx(
            1e-3 * float(near.split()[0])
        )
    for far in ("1.0025 mm", "0.9975 mm", "1.01 mm"):
        refused(tmp_path, "lines", contents, f'spacing = "{far}"', said=r"spacing must be that of x \[mm\], 1 mm, ")
    bare = columns("", AT, Z)
    refused(tmp_path, "lines", bare, 'spacing = "1.01 mm"', 'unit = "um"', said="spacing must be that of column 1, 1 a")


@pytest.mark.parametrize(
    ("contents", "keys", "said"),
    [
        (columns("", AT + (AT % 3) / 4, Z), (), r"got column 1, which runs one way but not evenly"),
        (columns("", AT, AT / 2), (), r"file must have heights beside places, got column 1 and column 2 al"),
        (columns("x [mm],y [mm],z [um]", AT, AT / 2, 1 + 0 * AT), (), "one that runs evenly, .*columns"),
        (columns("", AT), ('spacing = "1 mm"',), "got one column that runs evenly"),
        (XZ, ('positions = ["-5 mm", "5 mm"]',), r"positions must be one a line, got 2 for 1 line, z"),
        (XZ, ('unit = "mm"',), "unit must be that of the file, um, or be left out, got 1 mm"),
        (XZ.replace("z [um]", "v [m/s]"), (), r"columns must be lengths, got v \[m/s\]: .*columns = \[1\]"),
        (columns("v [m/s],x [mm],z [um]", Z, AT, Z), (), r"got v \[m/s\]: .*columns = \[2, 3\]"),
        (columns("x [km],z [um]", [f"{12 + i / 1e6:.5f}" for i in AT], Z), (), "runs one way but"),
        (columns("z [um]", Z), (), 'spacing is missing: .*as: spacing = "1 mm"'),
        (columns("", Z), ('spacing = "1 mm"',), 'is the unit another.*unit = "um"'),
    ],
)
def test_lines_that_cannot_be_told_are_refused_by_the_key_that_helps(tmp_path, contents, keys, said):
    refused(tmp_path, "lines", contents, *keys, said=rf"rail\.lines\..*{said}")


def test_a_line_may_be_tilted_as_much_as_to_run_one_way(tmp_path):
    tilted = np.round(Z + 50 * AT, 3)
    scene = rail_with(tmp_path, "lines", columns("x [mm],z [um]", AT, tilted))
    assert line_of(scene) == pytest.approx(1e-6 * tilted)
    keys = 'spacing = "1 mm"', 'unit = "um"', 'positions = ["0 mm", "5 mm"]'
    assert rail_with(tmp_path, "lines", columns("", tilted, Z), *keys).roughness.height.shape == (800, 2)


GONE = {3: "BAD", 10: "***", 11: "", 12: "-9999", 13: "NaN"}


def test_points_without_data_of_lines_are_filled_in_where_it_is_asked_for(tmp_path):
    contents = "x [mm];z [um]\n" + rows((i / 2, GONE.get(i, z)) for i, z in enumerate(Z))
    said = r"lines\.heights must be known everywhere, got 5 of 800 \(0\.625 %\) .*\[3, 0\].*, as: fill = true$"
    refused(tmp_path, "lines", contents, said=said)
    scene = rail_with(tmp_path, "lines", contents, "fill = true")
    straight = np.interp(np.arange(800), *(np.delete(one, list(GONE)) for one in (np.arange(800), Z)))
    assert line_of(scene) == pytest.approx(1e-6 * straight)
    assert [note for note in scene.diagnose() if "had no data at 5 points (0.625 %), which were filled in" in note]
    assert "-9999 stands for no data at 1 of 800 points, far from all others" in told(scene)[0]


def test_rows_that_are_missing_are_points_without_data(tmp_path):
    contents = "x [mm];z [um]\n" + rows((i / 2, z) for i, z in enumerate(Z) if i not in (5, 6, 100))
    refused(tmp_path, "lines", contents, said="got 3 of 800 ")
    scene = rail_with(tmp_path, "lines", contents, "fill = true")
    assert len(line_of(scene)) == 800 and line_of(scene)[[4, 7, 99, 101]] == pytest.approx(1e-6 * Z[[4, 7, 99, 101]])
    assert "3 of its places have no row" in told(scene)[0]


def test_lines_keep_the_slope_beyond_their_last_known_point(tmp_path):
    ramp = Z + 0.5 * np.arange(800)
    contents = "x [mm];z [um]\n" + rows((i / 2, "" if i > 797 else z) for i, z in enumerate(ramp))
    line = line_of(rail_with(tmp_path, "lines", contents, "fill = true"))
    assert 1e6 * np.diff(line[-3:]) == pytest.approx(0.5, abs=0.05)


# Without a file


def in_memory(text, **form):
    return table_of_text(io.BytesIO(text.encode()), TableForm(**form))


@pytest.mark.parametrize("between", ["End of part 1;", "End of part 1"])
def test_numbers_below_a_line_that_is_none_are_refused_at_that_line(between):
    """What stood there is not known, and one table of both parts would be made up."""
    part = rows([(1, 2.5), (2, 3.5), (3, 4.5)])
    assert in_memory(f"x;z\n{part}{between}\n").values.shape == (3, 2)
    with pytest.raises(ValueError, match="line 5"):
        in_memory(f"x;z\n{part}{between}\n{part}")


def test_the_place_along_the_track_is_no_line():
    table = in_memory("x [mm];z [um]\n" + rows(enumerate(Z)))
    lines = along_the_track(table, metre=None, spacing=1e-3, positions=None)
    assert lines.height.shape == (800, 1) and lines.height[:, 0] == pytest.approx(1e-6 * Z)


@catches("wavenumbers in cycles taken for radians").at(
    "validation.railway.scenes.level_files.WAVENUMBERS", {"1/m": 1 / (2 * math.pi), "1/cm": 1e2 / (2 * math.pi)}
)
def test_wavenumbers_are_cycles_over_a_metre():
    assert level_files._wavelengths(np.array([10.0, 16.0, 31.5]), "1/m")[0] == [0.1, 0.063, 0.0315]
    assert level_files._wavelengths(np.array([0.1, 0.16]), "1/cm")[0] == [0.1, 0.063]
    assert level_files._wavelengths(np.array([62.8, 100.5]), "rad/m")[0] == [0.1, 0.063]


@catches("a line filled in with its mean").at(
    "validation.scenes.measured_heights._filled_line", lambda line: np.where(np.isnan(line), np.nanmean(line), line)
)
def test_holes_of_a_line_lie_between_their_neighbours():
    line = np.array([0.0, 1.0, np.nan, 3.0, 9.0] + 300 * [0.0])[:, np.newaxis]
    found, edits = edited_lines(line, fill=True, asked_by="")
    assert found[2, 0] == pytest.approx(2.0) and edits.filled == 1


WAYS = st.sampled_from([way for way in WRITTEN if way != (",", ",")])
NUMBERS = st.one_of(st.integers(-900, 900).map(float), st.floats(-1e3, 1e3).map(lambda value: round(value, 3)))
LINES = st.lists(
    st.sampled_from(["Date: 2024-05-01", "Instrument 7", "# a comment", "", "Key;value", "a\tb"]), max_size=4
)
CODES = st.sampled_from(["utf-8", "utf-8-sig", "latin-1", "utf-16", "utf-16-le"])
TABLES = st.integers(1, 5).flatmap(
    lambda width: st.lists(st.lists(NUMBERS, min_size=width, max_size=width), min_size=3, max_size=9)
)


@given(way=WAYS, values=TABLES, above=LINES, named=st.booleans(), code=CODES, end=st.sampled_from(["\n", "\r\n", "\r"]))
def test_a_table_is_read_as_it_is_written_or_asked_for_its_decimal_sign(way, values, above, named, code, end):
    (delimiter, decimal), width = way, len(values[0])
    sign = delimiter or "  "
    names = [sign.join(f"c{i} [mm]" for i in range(width))] if named else []
    written = [sign.join(f"{value:g}".replace(".", decimal) for value in row) for row in values]
    contents = end.join([*above, *names, *written]).encode(code)
    try:
        table = table_of_text(io.BytesIO(contents), TableForm())
    except ValueError as problem:
        assert "decimal" in str(problem) and not named and width < 3
        table = table_of_text(io.BytesIO(contents), TableForm(decimal=decimal))
    if named or width > 2:
        np.testing.assert_array_equal(table.values, [[float(f"{value:g}") for value in row] for row in values])
    assert not named or [column.unit for column in table.columns] == ["mm"] * width
    assert (code[:6] == "utf-16") == any("the encoding utf-16" in note for note in table.notes)


def test_other_columns_than_the_chosen_may_be_texts():
    header = "Points;3\nStep;0.5\nGain;2\nstamp;z [um]\n"
    numbers, texts = (header + "".join(f"{stamp}{i};{i}.5\n" for i in range(40)) for stamp in ("7", "12:00:"))
    for text in (numbers, texts):
        for chosen in ("z", 2):
            assert in_memory(text, columns=(chosen,)).values[:, 0].tolist() == [i + 0.5 for i in range(40)]
    with pytest.raises(ValueError, match=r"the time stamp '12:00:0' in column 1 of line 5, .* columns = \[2\]"):
        in_memory(texts)
    with pytest.raises(ValueError, match=r"got 'broken' in column 1 of line 25"):
        in_memory(texts.replace("12:00:20;20.5", "broken;broken"), columns=(2,))


def test_a_header_with_a_decimal_comma_is_no_pair_of_names_nor_a_mark_part_of_one():
    assert in_memory("\ufeffx [mm],z [um]\n1,2.5\n2,3\n3,4\n", encoding="UTF8").columns[0].name == "x"
    assert in_memory("Weg 1,5 m\n3,25\n4,5\n1,25\n").values[:, 0].tolist() == [3.25, 4.5, 1.25]


number = text_dialect.Dialect.number


@catches("a point without data at zero", cell="BAD").at(
    "validation.scenes.text_dialect.Dialect.number", lambda dialect, cell: np.nan_to_num(number(dialect, cell))
)
@pytest.mark.parametrize("cell", ["", "BAD", "***", "NaN", "n/a", "-", "#N/A", "7.5"])
def test_cells_without_data_are_no_numbers(cell):
    values = in_memory(f"1;2\n3;{cell}\n4;5\n6;7\n", nodata=(7.5,)).values
    assert values[:, 0].tolist() == [1, 3, 4, 6] and np.isnan(values[:, 1]).tolist() == [False, True, False, False]


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("1,5 2,5\n3,5 4,5\n", [[1.5, 2.5], [3.5, 4.5]]),
        ("1.5D-1 2e3\n-.5 +4.\n", [[0.15, 2000.0], [-0.5, 4.0]]),
        ("\N{MINUS SIGN}1,5\t2\n3\t4\n", [[-1.5, 2.0], [3.0, 4.0]]),
        ("0,05\n0,25\n", [[0.05], [0.25]]),
        ("1 2  # a remark\n\n  # more\n3 4\n\x1a", [[1.0, 2.0], [3.0, 4.0]]),
        ("# X;Y\n% 7;1\n// Date: 2024-05-01, 12:30\n1;2\n3;4\n5;6\n", [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]),
        (";1;2\n0;3;4\n1;5;6\n", [[np.nan, 1.0, 2.0], [0.0, 3.0, 4.0], [1.0, 5.0, 6.0]]),
        ("0 1 No Data\n1 1 7\n2 1 8\n", [[0.0, 1.0, np.nan], [1.0, 1.0, 7.0], [2.0, 1.0, 8.0]]),
        ("Points\n3\nx;y\n1;2\n3;4\n", [[1.0, 2.0], [3.0, 4.0]]),
    ],
)
def test_numbers_are_what_is_written(text, values):
    np.testing.assert_array_equal(in_memory(text).values, values)


# Names, places and forms


@pytest.mark.parametrize(
    ("text", "column"),
    [
        ("height (um)", Column("height", "um")),
        ("z / μm", Column("z", "um")),
        ("y_mm", Column("y", "mm")),
        ("Level, dB (re 1 µm)", Column("Level", "dB", "1 um")),
        ("L [dB] re 1 µm", Column("L", "dB", "1 um")),
        ("f(x) in nm", Column("f(x) in", "nm")),
        ("rail (left) [nm]", Column("rail (left)", "nm")),
        *((f"h [{word}]", Column("h", "um")) for word in ("micrometer", "micrometre", "microns")),
        *((f"height {word}", Column("height", "mm")) for word in ("millimetre", "MM")),
    ],
)
def test_names_of_columns(text, column):
    assert column_of(text) == column


def test_names_stand_in_the_nearest_line_that_has_as_many():
    assert columns_of(["x [mm], z [um]", "# a comment"], 2, ",") == (Column("x", "mm"), Column("z", "um"))
    assert columns_of(["x   z", "mm  µm"], 2, "") == (Column("x", "mm"), Column("z", "um"))
    assert columns_of(["x [mm] z [um]"], 2, "") == (Column("x", "mm"), Column("z", "um"))
    assert columns_of(["date: 1, 2, 3"], 2, ",") == (Column(), Column())
    for above in (["Instrument 7", "z [um]"], ["Einheit: µm"], ["Z unit;um"]):
        assert unit_of_all(above) == {"um"}
    assert unit_of_all(["X unit: mm", "step (mm);0.5", "no [unit]", "x"]) == set()


def test_rough_lines_never_run_evenly():
    rng = np.random.default_rng(1)
    assert not any(places_of(rng.integers(0, 9, 8).astype(float)) for _ in range(2000))
    assert not any(places_of(np.cumsum(rng.standard_normal(9))) for _ in range(2000))
    assert places_of(np.cumsum(1 + rng.random(50))) is None
    assert places_of(np.arange(7.0)) is None and places_of(np.full(9, 3.0)) is None


def test_units_of_columns_go_before_one_of_the_whole_header():
    """Which is that of the heights, and would make millimetres of places into nanometres."""
    rows = "".join(f"{i},{i % 3}.5\n" for i in range(9))
    both, alone = (in_memory(f"Unit: nm\n{names}\n{rows}") for names in ("x [mm],z [um]", "x,z"))
    assert ([column.unit for column in both.columns], both.unit, alone.unit) == (["mm", "um"], "", "nm")
    assert not any("nm" in note for note in both.notes) and any("nm" in note for note in alone.notes)


@pytest.mark.parametrize(
    ("line", "count", "delimiter", "names"),
    [
        ("height", 1, "", ["height"]),
        # one column, below a line of two cells
        ("date\t2024", 1, "", [""]),
        ("date;2024", 1, "", [""]),
        ("x,z,", 2, ",", ["x", "z"]),
        (",x,z", 2, ",", ["", ""]),
        ("x [um] z [nm]", 2, " ", ["x", "z"]),
        ("place along  height", 2, ";", ["place along", "height"]),
    ],
)
def test_a_header_has_a_cell_for_each_column_or_names_none(line, count, delimiter, names):
    assert [column.name for column in columns_of([line], count, delimiter)] == names


@pytest.mark.parametrize(
    ("delimiter", "line", "nothing"),
    [(";", '"";""', True), (",", " ,\t,", True), (";", ";2", False), (",", "; 1,2", True), (";", "# 1;2", True)],
)
def test_a_line_without_a_cell_or_a_comment_says_nothing(delimiter, line, nothing):
    """A row of which the first cell is empty begins as a comment does."""
    assert Dialect(delimiter, ".").says_nothing(line) == nothing


@pytest.mark.parametrize(
    ("above", "below", "commas"),
    [
        (["height"], ["1,25"], True),
        (["x,z", ""], ["1,25"], False),
        (["x,y,z"], ["1,25"], True),
        (["2,5 um"], ["1,25"], True),
        ([], ["1,05", "1,25"], True),
        ([], ["1,-5", "1,25"], False),
        ([], ["1,25", "3"], None),
        ([], ["1,0", "1,5"], None),
    ],
)
def test_a_comma_is_the_decimal_sign_by_header_or_digits_or_is_asked_for(above, below, commas):
    """None: by neither."""
    points = Dialect(",", ".")
    if commas is None:
        with pytest.raises(ValueError, match="must be two columns or one with decimal commas"):
            text_dialect._has_decimal_commas(above, below, points)
    else:
        assert text_dialect._has_decimal_commas(above, below, points) == commas


EVEN = np.arange(20.0)


@pytest.mark.parametrize(
    ("at", "value", "fault"),
    [
        (7, 5.5, "runs back from 6 to 5.5 in row 8"),
        (7, 6.0, "has 6 and 6 behind another in row 8"),
        (slice(7, None), EVEN[7:] + 3, "jumps from 6 to 10 in row 8"),
        (slice(None), EVEN, ""),
        (7, np.nan, ""),
        (slice(0, 8), EVEN[:8] ** 2, ""),
    ],
)
@pytest.mark.parametrize("sign", [1, -1])
def test_the_fault_of_a_column_that_runs_evenly_for_the_most_part(at, value, fault, sign):
    """Up or down. Of a column that is off in more than a fifth of its steps, or without a number, nothing is said."""
    values = EVEN.copy()
    values[at] = value
    words = re.sub(r"(from|to|has|and) (?=[1-9])", r"\1 -" if sign < 0 else r"\1 ", fault)
    said = faults_of_places(sign * values)
    assert said.startswith(words) and bool(said) == bool(fault)


def test_places_run_evenly_with_gaps_or_not_at_all():
    gaps = np.delete(EVEN, [4, 5])
    places = places_of(gaps)
    assert (places.step, places.gaps, places.before_gap) == (1.0, 2, 3.0)
    for values in (np.append(EVEN, np.nan), EVEN**1.5, EVEN[:7], np.append(EVEN, 18.0)):
        assert places_of(values) is None


def test_a_column_runs_one_way_from_sixteen_rows_on():
    rounded = np.repeat(EVEN[:8], 2)
    assert runs_one_way(rounded) and runs_one_way(-rounded)
    assert not runs_one_way(rounded[:15]) and not runs_one_way(0 * rounded)
    assert not runs_one_way(np.append(rounded, 0.0))
