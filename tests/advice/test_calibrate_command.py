"""`calibrate` shows the table; what measures that of the package is a script of the checkout."""

import pytest

from validation.__main__ import main
from validation.advice import calibration


def test_the_table_of_the_package_and_of_a_folder_is_shown(tmp_path, capsys):
    rows = calibration.TABLE.read_bytes().splitlines(keepends=True)
    (tmp_path / "calibration.csv").write_bytes(
        b"".join(row for row in rows if not row.startswith((b"rolling", b"wheel")))
    )
    assert main(["calibrate", "--show"]) == main(["calibrate", "--show", "--out", str(tmp_path)]) == 0
    whole, part = capsys.readouterr().out.split("errors of models: ")[1:]
    assert "not in the table" not in whole and "not in the table of the calibration: wheel acceleration-rms" in part
    assert "punch     stiffness         springs" in whole and "rolling" not in part.split("\n", 1)[1]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--check 1 --install", "--check and --install must be given to .ci/calibrate.py of a checkout"),
        ("--answers", "--answers must be given to .ci/calibrate.py of a checkout"),
        ("--punches 1 --spheres=1 --rolling 1 --wheels 1 --seed 2", "--punches and --rolling and --seed and"),
        ("--show --install", "--install must be given to .ci/calibrate.py of a checkout"),
        ("", "calibrate must have an option, as --show; without one it is .ci/calibrate.py of a checkout"),
    ],
)
def test_what_measures_the_table_of_the_package_is_refused_and_the_script_named(
    words, said, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    assert main(["calibrate", *words.split()]) == 2
    line = capsys.readouterr().err
    assert line.startswith(f"error: {said}") and ".ci/calibrate.py" in line and len(line.splitlines()) == 1
    assert not list(tmp_path.iterdir())
