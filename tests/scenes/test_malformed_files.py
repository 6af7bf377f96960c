"""Scene files as people break them: exit status 2 in one sentence that says what is right, by every command."""

import os
import re

import pytest

from tests.scenes.test_scene_files import TABLE, written
from validation.__main__ import main
from validation.scenes.bundled import path_of, places_of
from validation.scenes.load import load_scene

RAIL, PUNCH, ROLLING = (path_of(name).read_text(encoding="utf-8") for name in ("rail", "rough_punch", "rolling_wheel"))
LOAD = 'load = "50 kN"'
COMMANDS = (["compare"], ["report", "--out", "out", "--scene"], ["sound", "--out", "out"])


def said(capsys, words):
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert out == "" and len(err.splitlines()) == 1
    return err


@pytest.mark.parametrize(
    ("contents", "words"),
    [
        (b"", "got none|is missing|got a scene"),
        (bytes(range(256)) * 9, "must be valid TOML, got: no text in UTF-8"),
        (RAIL.encode("utf-16"), "no text in UTF-8"),
        (RAIL.replace("Wheel on", "Rad für").encode("latin-1"), "no text in UTF-8"),
        (b"name = 'a'\0\n", "must be valid TOML"),
        (b"[1, 2]", "must be valid TOML"),
        (b'{"name": "a"}', "must be valid TOML"),
        (b"name: a", "must be valid TOML"),
        (b"name = 'a'\nwheel = 5\nrail = 3\nmaterial = 'x'\n", "wheel must be a table, got 5|simulation is missing"),
        (RAIL.encode() + b"# a\n" * 40000, "must have at most 100000 bytes"),
        (RAIL.replace(LOAD, f"{LOAD}\n{LOAD}").encode(), "line 7, .*: a key or a table is given twice"),
        ((RAIL + "[wheel]\n").encode(), "a key or a table is given twice"),
        (RAIL.replace(LOAD, "load = 50 kN").encode(), "line 6, .*quotation marks, as: load = "),
        (RAIL.replace(LOAD, "load = “50 kN”").encode(), "quotation marks, as: load = "),
        (RAIL.replace(LOAD, "load = ").encode(), r"got: Invalid value \(at line 6"),
    ],
)
def test_files_that_are_no_scene(contents, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my.toml").write_bytes(contents)
    for command in COMMANDS:
        line = said(capsys, [*command, "my.toml"])
        assert line.startswith("error: scene my.toml")
        assert re.search(words, line)
    assert not (tmp_path / "out").exists()


def test_places_that_are_no_file(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder.toml").mkdir()
    os.mkfifo("pipe.toml")
    (tmp_path / "loop.toml").symlink_to("loop.toml")
    (tmp_path / "gone.toml").symlink_to("nowhere")
    for name, words in {
        "folder.toml": "must be a regular file, got a folder",
        "pipe.toml": "must be a regular file, got a pipe",
        "loop.toml": "cannot be read: ",
        "gone.toml": "cannot be read: No such file",
        "folder.toml/in.toml": "cannot be read: No such file",
        "none.toml": "cannot be read: No such file",
        f"{'a' * 400}.toml": "cannot be read: ",
        "/dev/zero": "must be a regular file, got a device",
    }.items():
        for command in COMMANDS:
            assert f"error: scene {name} {words}" in said(capsys, [*command, name])
    with pytest.raises(ValueError, match=r"^scene a\\x00.toml cannot be read: embedded null byte$"):
        load_scene("a\0.toml")


def test_marks_and_line_ends_of_editors_are_read(tmp_path):
    for text in ("\ufeff" + RAIL, RAIL.replace("\n", "\r\n"), RAIL.replace(" = ", "\t=\t"), RAIL.replace('"', "'")):
        path = tmp_path / "my.toml"
        path.write_bytes(text.encode())
        assert load_scene(path) == load_scene("rail")


@pytest.mark.parametrize(
    ("text", "old", "new", "words"),
    [
        (RAIL, "radius =", "RADIUS =", 'wheel.RADIUS is unknown, .*, as: radius = "460 mm"'),
        (RAIL, "load =", "Load =", 'wheel.Load is unknown, .*, as: load = "50 kN"'),
        (RAIL, "[wheel]", "[Wheel]", r"Wheel is unknown, as: \[wheel\]"),
        (PUNCH, "[punch]", "[PUNCH]", r"PUNCH is unknown, as: \[punch\]"),
        (RAIL, "[rail]", '[rail]\nspeed = "80 km/h"', r"rail.speed is unknown, .*; speed stands in \[wheel\]"),
        (RAIL, "[material]", '[material]\ncrown_radius = "1 m"', r"; crown_radius stands in \[rail\]"),
        (RAIL, "[wheel]", 'load = "1 N"\n[wheel]', r"load is unknown, .*; load stands in \[wheel\]"),
        (RAIL, "[rail.levels]", "[levels]", r"levels stands as \[wheel.levels\] or as \[rail.levels\]"),
        (PUNCH, "[roughness]", "[punch.roughness]", r"; roughness stands as \[roughness\]"),
        (PUNCH, "[material]", '[material]\nside = "1 m"', r"material.side is unknown, .*; side stands in \[punch\]"),
        (ROLLING, "[rail.roughness]", "[roughness]", r"roughness is unknown.*; roughness stands as \[rail.roughness\]"),
        (PUNCH, "side =", "sides =", "punch.sides is unknown, .*, as: side = "),
        (RAIL, '"50 kN"', '"50,5 kN"', "with a point before the decimals, got .50,5 kN"),
        (RAIL, '"50 kN"', '"50 kn"', "wheel.load must be a force, as .*, in one of N, kN, .*, kgf, tf, got"),
    ],
)  # fmt: skip
def test_keys_that_are_meant_are_named_with_their_table(text, old, new, words, tmp_path):
    with pytest.raises(ValueError, match=rf"^scene \S+scene.toml: [^\n]*{words}[^\n]*$"):
        load_scene(written(tmp_path, (old, new), text=text))


def test_places_of_keys_are_those_of_scenes_with_the_same_table():
    assert places_of("mass", required="wheel", roots=()) == ()
    assert places_of("mass", required="punch", roots=()) == ()
    assert places_of("springs", required="", roots=("name", "wheel", "material", "rail", "simulation")) == (
        "in [simulation]",
    )
    assert places_of("springs", required="", roots=("name", "punch", "material")) == ()
    assert set(places_of("load", required="material", roots=())) == {"in [wheel]", "in [punch]", "in [sphere]"}


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may read all files")
def test_a_file_without_permission(tmp_path, capsys):
    path = tmp_path / "my.toml"
    path.write_text(TABLE, encoding="utf-8")
    path.chmod(0)
    assert "cannot be read: Permission denied" in said(capsys, ["compare", str(path)])
