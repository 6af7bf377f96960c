"""Files of heights as instruments and scripts write them: each form is read as it was written, or refused by key."""

import re
from pathlib import Path

import numpy as np
import pytest

from validation.scenes import table_files
from validation.scenes.bundled import SCENES
from validation.scenes.description import description_lines
from validation.scenes.load import load_scene
from validation.scenes.measured_heights import MeasuredHeights

PUNCH = (SCENES / "rough_punch.toml").read_text(encoding="utf-8")
HEIGHT = 1e-7 * np.random.default_rng(1).standard_normal((64, 64))


def scene_of(folder, file, *lines, spacing='"1 um"', side="64 um"):
    start = PUNCH.partition("[roughness]")[0].replace('"1 mm"', f'"{side}"').replace("23.076923 N", "0.01 N")
    path = folder / "scene.toml"
    text = "\n".join((start, "[heights]", f'file = "{file}"', f"spacing = {spacing}", *lines))
    path.write_text(text, encoding="utf-8")
    return path


def heights_in(folder, file, *lines, **settings):
    return load_scene(scene_of(folder, file, *lines, **settings)).ground


def level(height, spacing=(1e-6, 1e-6)):
    return pytest.approx(MeasuredHeights(height=height, spacing=spacing).height, rel=1e-9, abs=1e-18)


def refused(folder, file, *lines, said, **settings):
    with pytest.raises(ValueError, match=said) as problem:
        heights_in(folder, file, *lines, **settings)
    sentence = str(problem.value)
    assert sentence.startswith(f"scene {folder}/scene.toml: heights")
    assert "\n" not in sentence
    assert len(sentence) < 400 + 3 * len(str(folder))


def rows_of(height, delimiter=","):
    return "".join(delimiter.join(map(repr, row)) + "\n" for row in height.tolist())


# Headers


HEADER = "Instrument 7\nDate: 2024-05-01, 12:30\nX;Y;Z\n"


def test_a_header_that_is_no_comment_is_left_out_and_told(tmp_path):
    (tmp_path / "face.csv").write_text(HEADER.replace(";", ",") + rows_of(HEIGHT), encoding="utf-8")
    for lines in ((), ("skip = 1",)):
        ground = heights_in(tmp_path, "face.csv", *lines)
        assert ground.height == level(HEIGHT)
        assert "face.csv: it has 3 lines above its numbers." in ground.notes()
    refused(tmp_path, "face.csv", "skip = 67", said=r"got no line below the 67 to skip$")


# Places beside the heights


def xyz(*, form="{:.6f},{:.6f},{:.9f}", missing=()):
    """Rows of x and y [um], half a micrometre and one apart, and height [nm], of 64 x 48 points."""
    points = [(i, j) for i in range(64) for j in range(48) if (i, j) not in missing]
    return [form.format(i / 2, j, 1e9 * HEIGHT[i, j]) + "\n" for i, j in points]


@pytest.mark.parametrize("file", ["face.csv", "face.xyz", "face.txt"])
def test_three_columns_are_x_y_and_height_in_any_order_of_rows(tmp_path, file):
    rows = xyz()
    np.random.default_rng(1).shuffle(rows)
    (tmp_path / file).write_text("x [um],y [um],z [nm]\n" + "".join(rows), encoding="utf-8")
    path = scene_of(tmp_path, file, side="1 mm")
    text = (
        path.read_text(encoding="utf-8")
        .replace('spacing = "1 um"', "")
        .replace("[punch]", "[sphere]")
        .replace("side", "radius")
    )
    path.write_text(text.replace("0.01 N", "0.04 N"), encoding="utf-8")
    ground = load_scene(path).ground
    assert ground.height == level(HEIGHT[:, :48], (0.5e-6, 1e-6))
    assert ground.spacing == pytest.approx((0.5e-6, 1e-6))
    assert f"{file}: its columns are x, y and height of 64 x 48 points, 500 nm and 1 µm apart." in ground.notes()


def test_columns_that_are_named_x_y_and_z_are_found_among_others(tmp_path):
    rows = [f"{i},{j},{99 - i},{1e9 * HEIGHT[i, j]:.9f},1\n" for i in range(64) for j in range(64)]
    (tmp_path / "face.csv").write_text("X [um],Y [um],intensity,Z [nm],mask\n" + "".join(rows), encoding="utf-8")
    assert heights_in(tmp_path, "face.csv").height == level(HEIGHT)


def test_places_of_a_grid_without_units_have_those_of_the_spacing(tmp_path):
    square = [f"{i} {j} {1e9 * HEIGHT[i, j]:.9f}\n" for j in range(64) for i in range(64)]
    (tmp_path / "face.txt").write_text("".join(square), encoding="utf-8")
    assert heights_in(tmp_path, "face.txt", 'unit = "nm"').height == level(HEIGHT)
    refused(tmp_path, "face.txt", spacing='"1.5 um"', said=r"spacing must be that of column 1 and column 2, 1 ap")
    (tmp_path / "face.txt").write_text("".join(square[:-1]), encoding="utf-8")
    refused(tmp_path, "face.txt", 'unit = "nm"', said=r"got 1 of 4096 .* as: fill = true$")
    (tmp_path / "face.txt").write_text("".join([*square, square[0]]), encoding="utf-8")
    refused(tmp_path, "face.txt", said="x, y and height on a regular grid, got 4097 rows")
    (tmp_path / "face.txt").write_text("".join(square).replace("63 ", "63.4 "), encoding="utf-8")
    refused(tmp_path, "face.txt", said=r"got 64 places along x that are not evenly apart")


def test_a_first_column_and_a_first_row_of_places_are_no_heights(tmp_path):
    places = [f"{i}," + ",".join(map(repr, row)) + "\n" for i, row in enumerate(HEIGHT.tolist())]
    (tmp_path / "face.csv").write_text("".join(places), encoding="utf-8")
    said = "face.csv: its first column runs evenly, 1 µm apart, and is left out of the heights"
    assert heights_in(tmp_path, "face.csv").height == level(HEIGHT)
    assert f"{said}." in heights_in(tmp_path, "face.csv").notes()
    (tmp_path / "face.csv").write_text("," + ",".join(map(str, range(64))) + "\n" + "".join(places), encoding="utf-8")
    ground = heights_in(tmp_path, "face.csv")
    assert ground.height == level(HEIGHT)
    assert f"{said}; its first row runs evenly, 1 µm apart, and is left out of the heights." in ground.notes()


@pytest.mark.parametrize(("down", "right"), [(1, -1), (-1, 1), (-1, -1)])
def test_places_that_fall_turn_the_heights(tmp_path, down, right):
    table = np.full((65, 65), np.nan)
    table[1:, 0], table[0, 1:], table[1:, 1:] = np.arange(64)[::down], np.arange(64)[::right], HEIGHT[::down, ::right]
    (tmp_path / "face.csv").write_text(rows_of(table).replace("nan", "", 1), encoding="utf-8")
    assert heights_in(tmp_path, "face.csv").height == level(HEIGHT)


@pytest.mark.parametrize("step", [0.5, -0.5])
@pytest.mark.parametrize("corner", [False, True])
def test_steps_of_places_below_one_rise_or_fall(tmp_path, step, corner):
    places, way = step * np.arange(64.0), 1 if step > 0 else -1
    table = np.column_stack([places, HEIGHT[::way, ::way] if corner else HEIGHT[::way]])
    if corner:
        table = np.vstack([np.append(-1.0, places), table])
    (tmp_path / "face.csv").write_text(rows_of(table), encoding="utf-8")
    ground = heights_in(tmp_path, "face.csv", spacing='"0.5 um"', side="32 um")
    assert ground.height == level(HEIGHT, (0.5e-6, 0.5e-6))
    assert ground.spacing == (0.5e-6, 0.5e-6)


def test_the_first_column_has_its_own_unit_and_its_own_spacing(tmp_path):
    header = "x [mm]," + ",".join(f"z{i} [nm]" for i in range(32)) + "\n"
    rows = rows_of(np.column_stack([np.arange(64.0) / 1000, 1e9 * HEIGHT[:, :32]]))
    (tmp_path / "face.csv").write_text(header + rows, encoding="utf-8")
    ground = heights_in(tmp_path, "face.csv", spacing='["1 um", "2 um"]')
    assert ground.spacing == (1e-6, 2e-6) and ground.height == level(HEIGHT[:, :32], (1e-6, 2e-6))
    refused(tmp_path, "face.csv", spacing='["2 um", "1 um"]', said="spacing must be that of the first column, 1 µm")


def test_a_first_row_that_does_not_run_evenly_from_its_first_cell_is_of_heights(tmp_path):
    heights = np.vstack([np.append(7.5, np.arange(1.0, 64)) * 1e-8, HEIGHT[:63]])
    (tmp_path / "face.csv").write_text(rows_of(np.column_stack([np.arange(64.0), heights])), encoding="utf-8")
    ground = heights_in(tmp_path, "face.csv")
    assert ground.height == level(heights)
    assert ground.notes()[0].count("left out") == 1


@pytest.mark.parametrize("step", [0.5, -0.5])
def test_a_first_row_of_places_without_a_column_is_no_heights(tmp_path, step):
    """It gives the spacing of y, the second of two."""
    table = np.vstack([step * np.arange(64.0), HEIGHT[:32, :: 1 if step > 0 else -1]])
    (tmp_path / "face.csv").write_text(rows_of(table), encoding="utf-8")
    ground = heights_in(tmp_path, "face.csv", spacing='["1 um", "0.5 um"]', side="32 um")
    assert ground.height == level(HEIGHT[:32], (1e-6, 0.5e-6))
    assert "its first row runs evenly, 500 nm apart, and is left out of the heights" in ground.notes()[0]
    refused(
        tmp_path, "face.csv", spacing='["0.5 um", "0.7 um"]', said="spacing must be that of the first row, 0.5 apart"
    )


def test_rows_all_of_which_run_evenly_are_heights(tmp_path):
    """A tilted plane has no row of places."""
    plane = np.add.outer(np.arange(64.0) ** 2, np.arange(64.0)) * 1e-8
    (tmp_path / "face.csv").write_text(rows_of(plane), encoding="utf-8")
    assert heights_in(tmp_path, "face.csv", 'detrend = "none"').height == pytest.approx(plane, rel=1e-12)


def test_of_three_columns_the_one_beside_x_and_y_is_the_height(tmp_path):
    rows = [f"{1e9 * HEIGHT[i, j]:.9f},{j},{i}\n" for i in range(64) for j in range(64)]
    (tmp_path / "face.csv").write_text("height [nm],y [um],x [um]\n" + "".join(rows), encoding="utf-8")
    assert heights_in(tmp_path, "face.csv").height == level(HEIGHT)


@pytest.mark.parametrize("header", ["z [um]", "# Unit: µm", "Einheit;µm", "height (µm)"])
def test_a_header_has_the_unit_of_all_heights(tmp_path, header):
    (tmp_path / "face.csv").write_bytes(f"Gerät 7\n{header}\n".encode("latin-1") + rows_of(1e6 * HEIGHT).encode())
    ground = heights_in(tmp_path, "face.csv")
    assert ground.height == level(HEIGHT)
    assert "its header has the unit um" in ground.notes()[0] and "the encoding cp1252" in ground.notes()[0]
    refused(tmp_path, "face.csv", 'unit = "nm"', said=r"heights\.unit must be that of the file, um, or be left out")


@pytest.mark.parametrize("sentinel", ["-9999", "1e38", "-32768.0", "32767"])
def test_what_instruments_write_for_no_data_is_told_and_no_height(tmp_path, sentinel):
    rows = rows_of(1e6 * HEIGHT).splitlines()
    rows[4] = f"{sentinel}," + rows[4].partition(",")[2]
    (tmp_path / "face.csv").write_text("\n".join(rows), encoding="utf-8")
    refused(tmp_path, "face.csv", 'unit = "um"', said=r"got 1 of 4096 .*, the first at \[4, 0\].* as: fill = true$")
    ground = heights_in(tmp_path, "face.csv", 'unit = "um"', "fill = true")
    assert ground.edits.filled == 1 and ground.rms < 2e-7
    assert "stands for no data at 1 of 4096 points, far from all others" in ground.notes()[0]


def test_a_value_of_no_data_is_a_height_where_others_are_as_large(tmp_path):
    heights = 1e10 * HEIGHT
    heights[4, 4] = -999.0
    np.savetxt(tmp_path / "face.csv", heights)
    assert heights_in(tmp_path, "face.csv", 'unit = "pm"').edits.filled == 0


# Archives


def test_an_array_of_an_archive_is_read_by_its_key(tmp_path):
    np.savez(tmp_path / "face.npz", x=np.arange(64), heights=HEIGHT)
    assert heights_in(tmp_path, "face.npz", 'key = "heights"').height == level(HEIGHT)
    np.savez_compressed(tmp_path / "face.npz", z=HEIGHT.astype(np.float32), y=HEIGHT)
    (tmp_path / "face.npz").rename(tmp_path / "FACE.NPZ")
    assert heights_in(tmp_path, "FACE.NPZ", 'key = "y"').height == level(HEIGHT)


def test_a_key_that_an_archive_does_not_have_is_refused_with_those_that_it_has(tmp_path):
    np.savez(tmp_path / "face.npz", x=np.arange(64), heights=HEIGHT)
    which = r', the archive has "x", "heights", as: key = "heights", of \S+/face\.npz$'
    refused(tmp_path, "face.npz", said="heights.key is missing" + which)
    refused(tmp_path, "face.npz", 'key = "height"', said='heights.key must be in the archive, got "height"' + which)
    refused(tmp_path, "face.npz", "key = 3", said=r"heights\.key must be a text")
    np.savez(tmp_path / "many.npz", **{f"a{i}": HEIGHT for i in range(15)})
    refused(tmp_path, "many.npz", said=r'"a0", .*"a11" and 3 more, as: key = "a')
    np.savez(tmp_path / "none.npz")
    refused(tmp_path, "none.npz", said=r"heights\.key is of no use, the archive is empty, of ")
    (tmp_path / "face.npz").rename(tmp_path / "face.npy")
    refused(tmp_path, "face.npy", said=r"heights\.key is missing, the archive has")


def test_keys_that_a_file_has_no_use_for_are_refused(tmp_path):
    np.save(tmp_path / "face.npy", HEIGHT)
    np.savetxt(tmp_path / "face.csv", HEIGHT)
    refused(tmp_path, "face.npy", "skip = 1", said=r"heights\.skip must be left out of a file of numpy, got face\.npy$")
    refused(tmp_path, "face.csv", 'key = "z"', said=r"heights\.key must be left out but for an \.npz, got face\.csv$")
    refused(tmp_path, "face.npy", 'key = "z"', said=r"one array without a name, for which heights\.key has no use$")


def test_broken_archives_are_refused(tmp_path, monkeypatch):
    path = tmp_path / "face.npz"
    np.savez(path, heights=HEIGHT)
    whole = path.read_bytes()
    key = 'key = "heights"'
    path.write_bytes(whole[:-30])
    refused(tmp_path, "face.npz", key, said=r"got: an archive that cannot be read, File is not a zip file$")
    path.write_bytes(whole[:5000] + b"\x00\x01" + whole[5002:])
    refused(tmp_path, "face.npz", key, said=r"got: an archive that cannot be read, Bad CRC-32")
    np.savez_compressed(path, heights=np.zeros((64, 64)))
    monkeypatch.setattr(table_files, "MOST_BYTES", 8 * 64 * 64)
    refused(tmp_path, "face.npz", key, said=r"got: an array of 32896 bytes, more than 32768$")


# What is done to the heights


def test_a_rectangular_face_is_cropped_where_it_is_asked_for_and_told(tmp_path):
    face = 1e-7 * np.random.default_rng(2).standard_normal((96, 64))
    np.save(tmp_path / "face.npy", face)
    scene = load_scene(scene_of(tmp_path, "face.npy", "crop = true"))
    assert scene.ground.height == level(face[16:80])
    assert "note: heights are the central square of 96 x 64 points, as asked by crop." in description_lines(scene)


def test_points_of_two_distances(tmp_path):
    face = 1e-7 * np.random.default_rng(2).standard_normal((64, 32))
    np.save(tmp_path / "face.npy", face)
    found = heights_in(tmp_path, "face.npy", spacing='["1 um", "2 um"]')
    assert found.spacing == (1e-6, 2e-6)
    assert found.height == level(face, (1e-6, 2e-6))
    assert "64 x 32 points on 64 µm x 64 µm, 1 µm x 2 µm apart" in found.waves


SPACINGS = [
    ('["1 um"]', r"must be a length or two, as .* along x and y, got \['1 um'\]$"),
    ('["1 um", "0 um"]', r'\[1\] must be positive, got "0 um"$'),
    ('["-1 um", "1 um"]', r'\[0\] must be positive, got "-1 um"$'),
    ('"1 N"', r'must be a length, as "0\.5 m", in one of m, '),
    ('["1 um", 2]', r"\[1\] must be a length"),
    ('"nan um"', r'must be finite, got "nan um"$'),
]
WISHES = [
    ("fill = 1", r"fill must be true or false, got 1, as: fill = true$"),
    ('crop = "yes"', r"crop must be true or false, got 'yes', as: crop = true$"),
    ("fil = true", r"fil is unknown, heights must be made of file, spacing, .*, as: fill = true$"),
    *((f"unit = {one}", r"unit must be one of m, cm, mm, .*, as: unit = \"um\"$") for one in ('""', "3")),
    *((f"skip = {one}", r"skip must be (a whole|a number)") for one in ("1.5", '"3"', "true", "[3]")),
]


@pytest.mark.parametrize(
    ("line", "spacing", "said"),
    [*((line, '"1 um"', said) for line, said in WISHES), *(("", one, f"spacing ?{said}") for one, said in SPACINGS)],
)
def test_wishes_and_spacings_that_are_none_are_refused(tmp_path, line, spacing, said):
    np.save(tmp_path / "face.npy", HEIGHT)
    refused(tmp_path, "face.npy", line, spacing=spacing, said=rf"heights\.{said}")


def test_keys_that_are_missing_are_shown_as_a_line(tmp_path):
    path = scene_of(tmp_path, "face.npy")
    np.save(tmp_path / "face.npy", HEIGHT)
    text = path.read_text(encoding="utf-8")
    for line in ('file = "face.npy"', 'spacing = "1 um"'):
        path.write_text(text.replace(line, ""), encoding="utf-8")
        with pytest.raises(ValueError, match=rf"heights\.{line.split()[0]} is missing, .* as: {re.escape(line)}$"):
            load_scene(path)


@pytest.mark.parametrize("shape", [(0, 0), (64,), (64, 15), (16, 16, 16)])
@pytest.mark.parametrize("lines", [(), ("crop = true", "fill = true")])
def test_arrays_of_another_shape_are_refused(tmp_path, shape, lines):
    np.save(tmp_path / "face.npy", np.ones(shape))
    said = rf"heights: heights must be 16 points or more along two sides, got shape {re.escape(str(shape))}$"
    refused(tmp_path, "face.npy", *lines, said=said)


PAGE = (Path(__file__).parents[2] / "reports" / "docs" / "own_data.md").read_text(encoding="utf-8")


def test_the_page_prints_what_it_says(capsys):
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    exec(code, {})
    assert f"prints `{capsys.readouterr().out.strip()}`." in PAGE
