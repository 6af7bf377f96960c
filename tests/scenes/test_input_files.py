"""Files of others: what is no file, too large, or not what it says is refused at once, in one sentence."""

import os
import struct

import numpy as np
import pytest

from tests.scenes.test_height_forms import PUNCH, scene_of
from validation.__main__ import main
from validation.analysis.escapes import is_printable, printable, quoted, shortened
from validation.scenes import table_files, text_dialect
from validation.scenes.bundled import check_regular, contents_of
from validation.scenes.load import load_scene
from validation.scenes.reader import LONGEST_LINE, MOST_BYTES
from validation.scenes.table_files import read_table

HEIGHT = 1e-6 * np.random.default_rng(1).standard_normal((64, 64))


def refused(capsys, *words):
    """The one sentence in which a command refuses its input."""
    assert main(words) == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line


def header(path, shape, behind=b""):
    """An .npy of doubles that tells a shape, and holds what it holds."""
    with path.open("wb") as file:
        np.lib.format.write_array_header_1_0(file, {"descr": "<f8", "fortran_order": False, "shape": shape})
        file.write(behind)


MAKE = {
    "an empty file": lambda path: path.write_bytes(b""),
    r"a header of \(10000000, 10000000\) values of 8 bytes, and 0 bytes": lambda path: header(path, (10**7, 10**7)),
    r"a header of \(64, 64\) values of 8 bytes, and 32760 bytes": lambda path: header(path, (64, 64), bytes(8 * 4095)),
    r"a header of \(-1, 64\) values": lambda path: header(path, (-1, 64), bytes(512)),
    "a header that cannot be read": lambda path: path.write_bytes(
        b"\x93NUMPY\x02\x00" + struct.pack("<I", 9) + b"{" * 9
    ),
    r"an .npy of the unknown version \(9, 0\)|only support format version": lambda path: path.write_bytes(
        b"\x93NUMPY\x09\x00" + bytes(100)
    ),
    "objects in place of numbers": lambda path: np.save(path, np.full((64, 64), None)),
    "a file that does not begin as arrays of numpy do": lambda path: path.write_bytes(b"no array"),
}


@pytest.mark.parametrize("said", MAKE)
def test_arrays_that_are_none_are_refused_before_anything_is_allocated(tmp_path, capsys, said):
    MAKE[said](tmp_path / "face.npy")
    line = refused(capsys, "compare", str(scene_of(tmp_path, "face.npy")))
    assert line.startswith(f"error: scene {tmp_path}/scene.toml: heights.file {tmp_path}/face.npy must hold a table")
    with pytest.raises(ValueError, match=f"got: ({said})"):
        read_table("it", tmp_path / "face.npy")


@pytest.mark.parametrize("version", [(1, 0), (2, 0), (3, 0)])
@pytest.mark.parametrize("order", ["C", "F"])
def test_arrays_of_every_version_and_order_are_read(tmp_path, version, order):
    with (tmp_path / "face.NPY").open("wb") as file:
        np.lib.format.write_array(file, np.array(HEIGHT, order=order), version=version)
    assert (read_table("it", tmp_path / "face.NPY").values == HEIGHT).all()


@pytest.mark.parametrize("kind", [np.float32, np.int16, np.uint8, ">f8"])
def test_numbers_of_other_kinds_are_read_and_complex_ones_refused(tmp_path, kind):
    np.save(tmp_path / "face.npy", (100 * np.abs(HEIGHT) / HEIGHT.max()).astype(kind))
    assert read_table("it", tmp_path / "face.npy").values.dtype == np.float64
    np.save(tmp_path / "face.npy", HEIGHT.astype(complex))
    with pytest.raises(ValueError, match=r"must hold real numbers, got complex128$"):
        read_table("it", tmp_path / "face.npy")
    with pytest.raises(OSError, match=r"^it .* cannot be read: No such file"):
        read_table("it", tmp_path / "none.npy")


def test_what_is_no_regular_file_is_refused_without_reading_it(tmp_path, capsys):
    os.mkfifo(tmp_path / "pipe.csv")
    os.mkfifo(tmp_path / "pipe.toml")
    (tmp_path / "folder.npy").mkdir()
    for file, kind in (("pipe.csv", "a pipe"), ("folder.npy", "a folder"), ("/dev/zero", "a device")):
        line = refused(capsys, "compare", str(scene_of(tmp_path, file)))
        assert line.endswith(f"{tmp_path / file} must be a regular file, got {kind}")
    for command in (["compare"], ["report", "--scene"]):
        assert refused(capsys, *command, str(tmp_path / "pipe.toml")).endswith("must be a regular file, got a pipe")
        assert refused(capsys, *command, "/dev/zero") == "error: scene /dev/zero must be a regular file, got a device"


def test_sizes_are_bounded(tmp_path, monkeypatch):
    path = tmp_path / "file"
    path.write_bytes(b"12345")
    assert contents_of("it", path, most=5) == b"12345"
    assert check_regular("it", path, most=5) == 5
    with pytest.raises(ValueError, match=r"^it \S+file must have at most 4 bytes, got 5$"):
        contents_of("it", path, most=4)
    # a file of the system tells no size before it is read
    with pytest.raises(ValueError, match=r"^it /proc/self/environ must have at most 4 bytes, got more$"):
        contents_of("it", type(path)("/proc/self/environ"), most=4)
    np.save(tmp_path / "face.npy", HEIGHT)
    monkeypatch.setattr(table_files, "MOST_VALUES", 4095)
    with pytest.raises(ValueError, match=r"must hold at most 4095 heights, got 4096$"):
        read_table("it", tmp_path / "face.npy")
    monkeypatch.setattr(table_files, "MOST_BYTES", 4096)
    with pytest.raises(ValueError, match=r"must have at most 4096 bytes, got \d+$"):
        read_table("it", tmp_path / "face.npy")


INSTRUMENT = r"(the format of an instrument|the file must have a format that SurfaceTopography reads)"
"""Without the package that reads such files, and with it."""


@pytest.mark.parametrize(
    ("contents", "said"),
    [
        (b"1, 2, 3\n1, 2\n", r"rows must be of one length, got 3 numbers in line 1 and 2 in line 2: .*skip = 1"),
        (b"1, 2\n1, 2\n1, 2\n1\n", "rows must be of one length, got 1 cell in line 4 of a table of 2"),
        (b"1, 2\n1, x\n1, 2\n1, 2\n1, 2\n", "rows must be numbers, got 'x' in column 2 of line 2: .*nodata = \"x\""),
        (b"1, \x1b[31m2\n", INSTRUMENT),
        (b"1\n" * 500, "the file must have at most 99 lines of at most 100 characters, got more"),
        (b"1, 2\n" + b"1," * 500, "the file must have at most 99 lines of at most 100 characters, got more"),
        (b"\xff\xfe1, 2\n", INSTRUMENT),
    ],
)
def test_tables_that_are_none_are_refused_in_one_line(tmp_path, monkeypatch, contents, said):
    monkeypatch.setattr(text_dialect, "MOST_LINES", 99)
    monkeypatch.setattr(text_dialect, "LONGEST_LINE", 100)
    (tmp_path / "face.csv").write_bytes(contents)
    with pytest.raises(ValueError, match=rf"^it \S+face\.csv: {said}[^\n]*$"):
        read_table("it", tmp_path / "face.csv")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("a = " + 50000 * "[" + 50000 * "]", f"must have at most {MOST_BYTES} bytes, got 100004"),
        ("a = " + 20000 * "[\n" + 20000 * "]\n", "must be valid TOML, got: values nested too deep"),
        ("a = " + 20000 * "[" + 20000 * "]", f"must have lines of at most {LONGEST_LINE} bytes, got 40004"),
        (".".join(60000 * "a") + " = 1", f"must have at most {MOST_BYTES} bytes, got 120003"),
        ("wheel." + ".".join(400 * "a") + " = 1", "name is missing, a scene must have it"),
        (PUNCH.replace("name", "name." + ".".join(400 * "a")), "name must be a text that is not blank, got {'a': {'"),
        (
            "punch = 1\n" + PUNCH.replace("[punch]\n", "").replace("side", "# side").replace("load", "#"),
            "punch must be a table, got 1",
        ),
    ],
)
def test_scenes_that_are_bombs_are_refused_in_one_sentence(tmp_path, capsys, text, said):
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    line = refused(capsys, "compare", str(path))
    assert line.startswith(f"error: scene {path}")
    assert said in line
    assert len(line) < 400


SECRET = "root:x:0:0:secret:/root:/bin/bash"


@pytest.mark.parametrize(
    "contents",
    [
        f"{SECRET}\n".encode(),
        f'"{SECRET}" = [\n'.encode(),
        f"\x7fELF\x02{SECRET}".encode() + bytes(range(128, 256)),
        SECRET.encode("utf-16"),
        f"secret{SECRET}".encode() + b"\0" * 40,
        b"name = " + SECRET.encode(),
    ],
)
def test_a_foreign_file_is_named_and_not_quoted(contents, tmp_path):
    path = tmp_path / "foreign"
    path.write_bytes(contents)
    with pytest.raises(ValueError, match="must be valid TOML, got: ") as refused:
        load_scene(path)
    said = str(refused.value)
    assert said.startswith(f"scene {path} ") and len(said.splitlines()) == 1
    assert "secret" not in said.replace(str(path), "") and "root" not in said.replace(str(path), "")


def test_control_characters_do_not_reach_the_terminal(tmp_path, capsys):
    path = tmp_path / "one\n\x1b[31mtwo.toml"
    shown_path = str(tmp_path / r"one\n\x1b[31mtwo.toml")
    name = "name must be one line without control characters, got "
    for old, new, said in (
        ('"Rough punch"', r'"a\u001b[31m\nb"', rf"{name}'a\x1b[31m\nb'"),
        ('"Rough punch"', r'"a\u202eb"', rf"{name}'a\u202eb'"),
        ("side =", r'"si\u001bde\n" =', r"punch.si\x1bde\n is unknown, punch must be made of side, load, pressure"),
        ('"1 mm"', r'"1 \u009bmm"', 'punch.side must be a length, as "0.5 m", in one of m, cm, mm, um, µm'),
        ("[roughness]", "[rough", r"got: Expected"),
    ):
        assert old in PUNCH
        path.write_text(PUNCH.replace(old, new, 1), encoding="utf-8")
        line = refused(capsys, "compare", str(path))
        assert said in line
        assert shown_path in line
        assert is_printable(line)
    assert r"\x1b[31m" in refused(capsys, "compare", "no\x1b[31mscene")
    assert is_printable(refused(capsys, "compare", "no\n\x1b[31m/scene"))
    assert r"\x1b[31m" in refused(capsys, "compare", "sphere", "\x1b[31mmore")
    with pytest.raises(SystemExit):
        main(["compare", "sphere", "--\x1b[31mmore"])
    assert "\x1b" not in capsys.readouterr().err


def test_what_is_shown_is_short_and_on_one_line():
    deep = [1]
    for _ in range(5000):
        deep = [deep]
    assert shortened(deep) == "[[[[...]]]]"
    assert len(shortened("x" * 10**6)) < 200
    assert len(quoted("x" * 10**6)) < 200
    assert quoted('a"\\\n') == r'"a\"\\\n"'
    assert printable("a\x07b\N{NO-BREAK SPACE}µ²\u2028") == "a\\x07b\N{NO-BREAK SPACE}µ²\\u2028"
    assert printable("a\nb\x1b", lines=True) == "a\nb\\x1b"
