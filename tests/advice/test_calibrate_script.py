"""`.ci/calibrate.py` writes into a folder; the table of the package is replaced on demand, by no smaller one."""

from collections import Counter

import numpy as np
import pytest

from tests.advice.script import calibrate, run
from tests.seeded import catches
from validation.advice import calibration
from validation.advice.calibration_scenes import Answers, CalibrationRun, CalibrationScene, answers_in

ONE_PUNCH = ("--spheres", "0", "--rolling", "0", "--wheels", "0", "--workers", "1", "--punches", "1")

SOLVED = []
"""Numbers of the scenes that were."""


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    """In a folder of its own; solves are made up. The table of the package is the same afterwards."""
    before = calibration.TABLE.read_bytes()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(calibrate, "measure_errors", made_up)
    monkeypatch.setattr(calibrate, "reference_answer", answered)
    monkeypatch.setattr(calibrate, "ANSWERS", tmp_path / "package" / "calibration_answers.npz")
    SOLVED.clear()
    yield
    assert calibration.TABLE.read_bytes() == before


def made_up(point):
    return {"error": np.full(len(point.cheap), 0.1), **answered(point)}


def answered(point):
    """By boundary elements, as mean of two realisations."""
    SOLVED.append(point.number)
    value = np.array([1.0 + point.number])
    return {"value": value, "each": np.array([0.9 * value, 1.1 * value])} | {
        name: np.array(number) for name, number in (("reference", 0.01), ("failed", float(point.number == 1)))
    }


@pytest.mark.slow
def test_a_table_is_written_into_a_folder_of_the_users(tmp_path, capsys):
    assert run(*ONE_PUNCH) == 0
    printed = capsys.readouterr().out
    assert {row["number"] for row in calibration.rows_of(tmp_path / "calibration" / "calibration.csv")} == {"0"}
    assert "table: calibration/calibration.csv; `compare` goes on with that of the package" in printed
    assert "not in the table of the calibration: wheel acceleration-rms" in printed.splitlines()[0]
    assert sorted(path.name for path in (tmp_path / "calibration").iterdir() if path.is_file()) == [
        "calibration.csv",
        "calibration_answers.npz",
        "manifest.json",
    ]


@pytest.mark.slow
def test_a_run_goes_on_in_its_folder():
    assert run(*ONE_PUNCH, "--out", "mine") == 0
    assert run(*ONE_PUNCH[:-1], "3", "--out", "mine") == 0
    assert SOLVED == [0, 1, 2]


@pytest.mark.parametrize("few", [("--punches", "8"), ("--wheels", "0"), ("--spheres", "118")])
def test_a_smaller_table_is_not_installed_nor_measured(few, tmp_path, capsys, monkeypatch):
    # a broken check must not reach the table of the package
    monkeypatch.setattr(calibrate, "install", None)
    assert run("--install", *few) == 2
    said = capsys.readouterr().err
    assert said.startswith("error: --install must leave as many scenes as the table of the package has, ")
    assert len(said.splitlines()) == 1 and not list(tmp_path.iterdir())


def of_kinds(path, **counts):
    """A table with so many scenes of each kind, of one model."""
    about = {"measured": "2026-01-01", "command": "python .ci/calibrate.py --seed 1"}
    rows = [
        {"kind": kind, "quantity": "stiffness", "number": i, "model": "fit"}
        for kind, count in counts.items()
        for i in range(count)
    ]
    path.write_bytes(calibrate.as_table(about, rows))
    return path


@pytest.mark.parametrize(
    ("mine", "installed"),
    [
        ({"punch": 3, "sphere": 2}, True),
        ({"punch": 4, "sphere": 2, "wheel": 1}, True),
        ({"punch": 2, "sphere": 9}, False),
        ({"punch": 9}, False),
    ],
)
def test_a_table_is_installed_where_no_kind_has_fewer_scenes(mine, installed, tmp_path):
    there, new = of_kinds(tmp_path / "there.csv", punch=3, sphere=2), of_kinds(tmp_path / "new.csv", **mine)
    there.chmod(0o640)
    before = there.read_bytes()
    if installed:
        calibrate.install(new, there)
    else:
        with pytest.raises(ValueError, match="--install must leave as many scenes"):
            calibrate.install(new, there)
    assert there.read_bytes() == (new.read_bytes() if installed else before)
    assert there.stat().st_mode & 0o777 == 0o640


def refusal(**counts):
    try:
        calibrate.check_installable(CalibrationRun(**counts))
    except ValueError as refused:
        return str(refused)
    return ""


@catches("a table of any size in the place of that of the package").at(
    "tests.advice.script.calibrate._refuse_fewer", lambda mine, there: None
)
def test_the_run_that_the_table_is_of_may_be_installed_and_no_smaller_one():
    """Scenes without an answer of boundary elements are none of the table."""
    assert not refusal()
    assert "of punch stiffness, got 100" in refusal(punches=100)
    assert "of wheel acceleration" in refusal(wheels=0)


@pytest.mark.parametrize("differing", [[], ["punch 0, stiffness, fit: an error of 1 in the table, of 2 today"]])
def test_a_check_reports_and_writes_nothing(differing, monkeypatch, capsys):
    """Rows take today's code with --install alone."""
    stamps = Counter()

    def checked(count, engine, path, *, stamp):
        stamps[count, path, stamp] += 1
        return differing, "6 of 60 solves"

    monkeypatch.setattr(calibrate, "check_calibration", checked)
    monkeypatch.setattr(calibrate, "calibration_lines", lambda path: [])
    wanted = 1 if differing else 0
    assert run("--check", "1") == wanted
    printed = capsys.readouterr().out
    assert (differing or ["measured again: 6 of 60 solves, all the same; nothing was written"])[0] in printed
    assert run("--check", "1", "--install") == wanted
    assert stamps == {(1, calibration.TABLE, False): 1, (1, calibration.TABLE, True): 1}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--check", "1", "--wheels", "3"), "--wheels must be left out beside --check"),
        (("--model", "fit", "--seed", "3"), "--seed must be left out beside --model"),
        (("--references", "."), "--references must be a folder of mdr-validation calibrate --references"),
        (("--check", "1", "--install", "--out", "mine"), "--install is for"),
        (("--check", "1", "--out", "mine"), "no table of the calibration is in mine/calibration.csv"),
        (("--install",), "--install must be allowed to write"),
        ((*ONE_PUNCH, "--out", "."), "--out must be a new or empty folder"),
    ],
)
def test_what_cannot_be_done_is_refused_before_anything_is_measured(words, said, tmp_path, capsys, monkeypatch):
    """No file of others is touched."""
    monkeypatch.setattr(calibrate.os, "access", lambda path, mode: str(path) == ".")
    (tmp_path / "calibration.csv").write_text("mine", encoding="utf-8")
    assert run(*words) == 2
    assert said in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["calibration.csv"]


ANSWERS = ("--answers", *ONE_PUNCH[:-1], "3")
OTHERS = ("--rolling", "0", "--wheels", "0", "--workers", "1", "--punches", "0")
TWO_SPHERES = ("--answers", *OTHERS, "--spheres", "2")


@pytest.mark.slow
def test_answers_alone_are_made_and_each_kind_is_installed_beside_the_others(tmp_path, capsys):
    """Readable with numpy alone; scenes without an answer are left out; a table in the folder stays."""
    (tmp_path / "package").mkdir()
    assert run(*ONE_PUNCH) == run(*ANSWERS, "--install") == 0
    assert run(*TWO_SPHERES, "--install") == 0
    assert "sphere stiffness: 1 answers, 2 numbers" in capsys.readouterr().out
    assert (tmp_path / "calibration" / "calibration.csv").exists()
    with np.load(tmp_path / "package" / "calibration_answers.npz") as arrays:
        assert arrays["punch stiffness number"].tolist() == [0, 2] and arrays["punch stiffness value"].tolist() == [
            1,
            3,
        ]
        assert arrays["sphere stiffness each"].tolist() == [0.9, 1.1]
        assert "--answers --punches 3" in str(arrays["punch stiffness about"])
    assert run(*ANSWERS[:-1], "1", "--install") == 2
    assert "must leave as many answers as there are, 2 of punch stiffness" in capsys.readouterr().err


def test_answers_of_several_bands_are_read_as_they_were_written(tmp_path):
    """Scenes may have other numbers of bands and of realisations."""
    points = [CalibrationScene(kind="rolling", number=i, quantity="force-spectrum", seed=7) for i in range(3)]
    each = [np.arange(1.0, 1 + 2 * (i + 1)).reshape(2, i + 1) for i in range(3)]
    found = [
        (point, {"value": rows.mean(axis=0), "each": rows, "reference": np.array(0.1), "failed": np.array(0.0)})
        for point, rows in zip(points, each, strict=True)
    ]
    made = Answers.of(found, {"command": "python .ci/calibrate.py --seed 7"})
    group = "rolling", "force-spectrum"
    (tmp_path / "answers.npz").write_bytes(calibrate.as_file({group: made}))
    read = answers_in(tmp_path / "answers.npz")[group]
    assert (read.digest, read.seed) == (made.digest, 7)
    for (scene, value, rows), (point, outcome) in zip(read.scenes(group), found, strict=True):
        assert scene == point and (value == outcome["value"]).all() and (rows == outcome["each"]).all()
    assert answers_in(tmp_path / "none.npz") == {} and calibrate.merged(tmp_path / "none.npz", {group: made})


@pytest.mark.slow
def test_a_model_that_is_measured_alone_touches_no_other_row(tmp_path, monkeypatch):
    """Beside the stored answer: the fit is off by as much as the table has where that is the answer of the table."""
    points = [CalibrationScene(kind="punch", number=i, quantity="stiffness", seed=19) for i in range(2)]
    made = Answers.of([(point, answered(point)) for point in points], {"command": "--seed 19"})
    monkeypatch.setattr(calibrate, "answers_in", lambda: {("punch", "stiffness"): made})
    assert run("--model", "fit", "--workers", "1") == 0
    before, after = (
        {tuple(row[name] for name in ("kind", "quantity", "number", "model")): row for row in calibration.rows_of(path)}
        for path in (calibration.TABLE, tmp_path / "calibration" / "calibration.csv")
    )
    changed = [key for key in after if after[key] != before[key]]
    assert list(after) == list(before) and changed == [("punch", "stiffness", "0", "fit")]
    (fit,) = (one for one in points[0].cheap if one.name == "fit")
    value = fit.prepare(points[0].target(), fit.resolutions(points[0].target())[0])(0)().values["stiffness"]
    assert float(after[changed[0]]["error"]) == pytest.approx(abs(np.log(value)), rel=1e-4)
    assert run("--model", "own") == 2
