"""What `judge` writes: no result lost, no file of others replaced, no character that acts, every curve drawn."""

import csv
import json
import math
import re
from dataclasses import replace

import pytest

import validation
from tests.judging.judged_points import NO_RESULT, NOT_SERVED, OUTSIDE, WITHIN
from tests.judging.test_judge_command import RIGHT, broken, pointed
from tests.seeded import catches
from validation.__main__ import main
from validation.judging import judge as judged
from validation.judging.figure import figure_of, left_out
from validation.judging.judgement import SolverTime, judged_number, missing_number
from validation.judging.kinds.own import ErrorOfCall
from validation.judging.worker import Called


@pytest.fixture
def file(tmp_path):
    return tmp_path / "mine.py"


LAWS = """
from validation import stiffness_model
def law(name):
    @stiffness_model(name)
    def stiff(load, side, modulus, roughness):
        {body}
        return 1.1523 * modulus * side
"""


def laws(path, names, body="pass"):
    path.write_text(LAWS.format(body=body) + "".join(f"law({name!r})\n" for name in names), encoding="utf-8")
    return path


@pytest.fixture
def quick(monkeypatch):
    """Judged by the least that there is."""

    def points(model, tolerance):
        for load in (1.0, 2.0):
            value = model.call(load=load, side=1.0, modulus=1.0, roughness=None)
            reason = getattr(value, "reason", "")
            if reason:
                yield missing_number("k", {"Fbar": load}, NOT_SERVED if value.refused else NO_RESULT, reason)
            else:
                yield judged_number("k", {"Fbar": load}, float(value), 1.0, 0.0, tolerance)

    monkeypatch.setattr(judged, "points_of", points)
    monkeypatch.setattr(judged, "costs_of", lambda model, points: [])


@pytest.mark.parametrize(
    ("names", "folders"),
    [
        (["law (1)", "law [1]", "Law_1"], ["law_1", "law_1-2", "Law_1-3"]),
        (["good", "n" * 300, "n" * 299], ["good", "n" * 120, "n" * 118 + "-2"]),
        (["con", ".."], ["_con", "model"]),
        (["one alone"], [""]),
    ],
)
def test_no_result_is_lost_whatever_models_are_called(names, folders, quick, file, tmp_path, monkeypatch):
    monkeypatch.setattr("validation.judging.figure.figure_of", lambda found, form: b"<svg/>")
    out = tmp_path / "out"
    for _ in range(2):  # a second time in the place of the first
        assert main(["judge", str(laws(file, names)), "--out", str(out)]) == 0
        found = [json.loads((out / name / "judgement.json").read_text(encoding="utf-8"))["model"] for name in folders]
        assert found == names
    assert sorted(path.name for path in out.rglob("summary.txt")) == ["summary.txt"] * len(names)


@pytest.mark.parametrize(
    ("there", "words", "sentence"),
    [
        (
            "out/a/summary.txt",
            "--out out",
            "--out must be a new or empty folder or an earlier report, got out/a with oth",
        ),
        (
            "out/b/notes.txt",
            "--out out",
            "--out must be a new or empty folder or an earlier report, got out/b with oth",
        ),
        ("out", "--out out", "--out must be a folder that can be written, got out: Not a directory"),
        ("a.json/x", "--json a.json", "--json must be a file of its own, got a.json, which is a folder"),
        ("", "--out out --json out/judgement.json", "got out/judgement.json, which is in the folder of --out"),
        (
            "",
            "--out out --csv out/a/x.csv",
            "got out/a/x.csv, which is in the folder of --out",
        ),
        ("", f"--json {'n' * 300}", "File name too long"),
        ("", f"--csv new/{'n' * 300}/a.csv", "File name too long"),
        ("", f"--out new/{'n' * 300}", "File name too long"),
    ],
)
def test_what_cannot_be_written_is_said_before_anything_is_judged(
    there, words, sentence, file, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("validation.judging.commands.judge.judged", broken)
    if there:
        place = tmp_path / there
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text("of somebody else", encoding="utf-8")
    assert main(["judge", str(laws(file, ["a", "b"])), *words.split()]) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err and printed.err.count("\n") == 1 and not printed.out
    assert not there or (tmp_path / there).read_text(encoding="utf-8") == "of somebody else"


def test_a_file_that_is_read_only_is_not_replaced(file, tmp_path, monkeypatch, capsys):
    place = tmp_path / "a.json"
    place.write_text("kept", encoding="utf-8")
    monkeypatch.setattr("os.access", lambda path, mode: str(path) != str(place))
    assert main(["judge", str(file), "--json", str(place)]) == 2
    assert "got " in capsys.readouterr().err and place.read_text(encoding="utf-8") == "kept"


def test_no_control_character_and_no_formula_leaves(quick, file, tmp_path, capsys):
    body = r"raise ValueError('\x1b[2J\x1b[31m<script>alert(1)</script>\u202e\udc80')"
    name = '=HYPERLINK("http://x")'
    out, page = tmp_path / "out", tmp_path / "a.csv"
    assert main(["judge", str(laws(file, [name], body)), "--out", str(out), "--csv", str(page)]) == 3
    texts = [capsys.readouterr().out, *(path.read_bytes().decode() for path in (*out.iterdir(), page))]
    assert len(texts) == 7
    for text in texts:
        assert text.replace("\n", "").replace("\t", "").isprintable()
    rows = list(csv.DictReader(page.read_text(encoding="utf-8").splitlines()))
    assert {row["model"] for row in rows} == {"'" + name}
    assert json.loads((out / "judgement.json").read_text(encoding="utf-8"))["model"] == name
    assert "\\x1b[2J" in (out / "summary.txt").read_text(encoding="utf-8")


def test_a_fork_is_named_and_its_answers_are_left_out(quick, file, tmp_path, capsys):
    body = "import os\n        child = os.fork()\n        if child: os.waitpid(child, 0)"
    assert main(["judge", str(laws(file, ["forks"], body)), "--json", str(tmp_path / "a.json")]) == 0
    *points, last = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))["verdicts"]
    assert [point["value"] for point in points] == [1.1523] * 2
    assert (last["quantity"], last["outcome"]) == ("forking", NO_RESULT) and "a process that it forked" in last[
        "reason"
    ]
    assert capsys.readouterr().out.count("tolerance 10 %); stiffness model") == 1


@pytest.mark.parametrize("name", ["mine.py", "helper.py", "data.txt"])
def test_a_file_that_is_changed_while_it_is_judged_is_named(name, quick, file, tmp_path, capsys):
    """And so is what it has from its folder; nothing is said of one that is not changed."""
    (tmp_path / "helper.py").write_text("FACTOR = 1.0\n", encoding="utf-8")
    (tmp_path / "data.txt").write_text("1.0\n", encoding="utf-8")
    body = "import helper, pathlib; pathlib.Path(__file__).with_name('data.txt').read_text()"
    assert main(["judge", str(laws(file, ["steady"], body))]) == 0
    assert "was changed" not in capsys.readouterr().out
    text = repr(f"{(tmp_path / name).read_text(encoding='utf-8')}\n# another\n")
    body += f"; load > 1 and pathlib.Path({str(tmp_path / name)!r}).write_text({text})"
    if name == "mine.py":
        body = body.replace(text, "'# another'")
    assert main(["judge", str(laws(file, ["changes"], body)), "--json", str(tmp_path / "a.json")]) == 0
    last = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))["verdicts"][-1]
    assert (last["quantity"], last["outcome"]) == ("file", NO_RESULT)
    assert last["reason"] == f"{name} was changed while it was judged: judge it again"


def test_a_solver_whose_file_is_changed_is_not_right(monkeypatch, file):
    model = Called(validation.contact_solver("mine")(lambda gap, force: gap))
    monkeypatch.setattr(Called, "changed", "mine.py")
    monkeypatch.setattr(judged, "resolve_name", lambda place: lambda model: ([RIGHT], []))
    assert judged.judged(model, judged.tolerance_of(0.1)).wrong


def several(count, curves=2):
    """Judgements with so many curves."""
    points = [p for h in range(curves) for p in pointed([2] * 20, H=float(h))]
    for i in range(count):
        yield judged.Judgement(f"law {i}", "stiffness_model", judged.tolerance_of(0.1), tuple(points), 1.0)


@pytest.mark.parametrize(("count", "curves", "missing"), [(13, 2, 0), (1, 15, 0), (9, 1, 5)])
def test_a_figure_shows_all_models_and_curves_or_names_what_it_leaves_out(count, curves, missing, monkeypatch):
    if missing:
        monkeypatch.setattr("validation.judging.figure.PANELS", count - missing)
    found = list(several(count, curves))
    drawn = figure_of(found, "svg").decode()
    words = [" ".join(text.split()) for text in re.findall(r">([^<>]+)</", drawn)]
    text = " ".join(words)
    assert left_out(found) == [f"law {i}" for i in range(count - missing, count)]
    assert ("not shown: law 4, law 5, law 6" in text) == bool(missing)
    shown = {word.partition(") ")[2] for word in words if re.match(r"\([a-z]+\) law", word)}
    assert {f"law {i}: k" for i in range(count - missing)} <= shown
    assert {f"H = {h}" for h in range(curves)} <= set(words)


NAMED = ["Persson with a twist", "Hertz and more", "springs", "boundary elements", "theory of mine", "floor", "_mine"]


@pytest.mark.parametrize("name", NAMED)
def test_a_model_of_a_user_has_a_marker_of_its_own_and_a_name_in_the_legend(name, monkeypatch):
    costs = tuple(ErrorOfCall(other, 0.1, "-", 1e-5 * i) for i, other in enumerate((name, "springs"), 1))
    found = judged.Judgement(name, "stiffness_model", judged.tolerance_of(0.1), (), 1.0, costs=costs)
    figures = []
    monkeypatch.setattr("validation.report.drawing.picture", lambda figure, form: figures.append(figure))
    figure_of([found], "svg")
    axes = figures[0].axes[0]
    own, springs = [line for line in axes.lines if len(line.get_xdata())]
    assert own.get_marker() not in ("none", "None", "") and own.get_marker() != springs.get_marker()
    labels = [text.get_text() for text in figures[0].legends[0].get_texts()] if figures[0].legends else []
    labels += [text.get_text() for text in axes.texts]
    expected = {"springs": "springs (this model)", "_mine": " _mine"}.get(name, name)
    assert sorted(labels) == sorted([expected, "springs"])


def axes_of(found, monkeypatch):
    figures = []
    monkeypatch.setattr("validation.report.drawing.picture", lambda figure, form: figures.append(figure))
    figure_of([found], "svg")
    return [axis for axis in figures[0].axes if axis.lines or axis.patches]


def judgement_of(name, values):
    points = tuple(
        judged_number("k", {"H": 0.7, "Fbar": 10.0**i}, value, 2.0, 0.05, 0.1, unit="-")
        for i, value in enumerate(values)
    )
    costs = (ErrorOfCall(name, abs(values[0] / 2 - 1), "-", 1e-3), ErrorOfCall("springs", 0.5, "-", 1e-2))
    return judged.Judgement(name, "stiffness_model", judged.tolerance_of(0.1), points, 1.0, costs=costs)


def test_a_model_that_is_far_off_leaves_the_scale_of_another_one(monkeypatch):
    figures = []
    monkeypatch.setattr("validation.report.drawing.picture", lambda figure, form: figures.append(figure))
    figure_of([judgement_of("good", [2.0, 2.2, 1.9]), judgement_of("bad", [2e3, 4e3, 2.0])], "svg")
    good, bad = [
        axis.get_ylim() for axis in figures[0].axes if axis.get_ylabel().startswith("relative") or axis.patches
    ][:2]
    assert -20 < good[0] < -10 and 12 < good[1] < 20 and bad[1] > 1e5


@pytest.mark.parametrize("values", [[2e300, 3e300], [2.0, 2e306], [1e-300, 2.0]])
def test_a_number_that_no_axis_has_room_for_is_no_fault(values):
    assert figure_of([judgement_of("huge", values)], "svg").startswith(b"<?xml")


@pytest.mark.parametrize(
    ("unit", "values", "label", "shown", "within"),
    [
        ("-", [2.0, 2.2, 1.0], "relative deviation from the reference [%]", [0.0, 10.0, -50.0], 10.0),
        ("dB", [2.0, 5.0, 1.0], "deviation from the reference [dB]", [0.0, 3.0, -1.0], 20 * math.log10(1.1)),
    ],
)
def test_a_figure_has_the_points_and_the_tolerance_on_the_axes_that_it_names(
    unit, values, label, shown, within, monkeypatch
):
    places = [{"H": 0.7, "Fbar": x} for x in (1.0, 10.0, 99.0)]
    known = zip(places, values, strict=True)
    points = tuple(judged_number("k", where, value, 2.0, 0.05, 0.1, unit=unit) for where, value in known)
    costs = (ErrorOfCall("mine", 0.25, unit, 1e-3), ErrorOfCall("springs", 0.5, unit, 1e-2))
    found = judged.Judgement("mine", "stiffness_model", judged.tolerance_of(0.1), points, 1.0, costs=costs)
    differences, seconds = axes_of(found, monkeypatch)
    assert (differences.get_xlabel(), " ".join(differences.get_ylabel().split())) == ("Fbar", label)
    (line,) = [line for line in differences.lines if len(line.get_xdata()) == 3]
    assert line.get_xdata().tolist() == [1.0, 10.0, 99.0] and line.get_ydata() == pytest.approx(shown)
    shade = differences.patches[0].get_extents().transformed(differences.transData.inverted())
    assert (shade.y0, shade.y1) == pytest.approx((-within, within))
    assert (seconds.get_xlabel(), " ".join(seconds.get_ylabel().split())) == (
        "seconds of a call",
        f"median error [{label.partition('[')[2]}",
    )
    places = [(line.get_xdata()[0], line.get_ydata()[0]) for line in seconds.lines if len(line.get_xdata()) == 1]
    factor = 100 if unit == "-" else 1
    assert places == [(1e-3, pytest.approx(0.25 * factor)), (1e-2, pytest.approx(0.5 * factor))]


def test_a_figure_of_a_solver_has_seconds_over_cells_of_both(monkeypatch):
    times = (SolverTime(32.0, 0.1, 0.2), SolverTime(64.0, 0.4, 0.6))
    found = judged.Judgement("bem3d", "contact_solver", judged.tolerance_of(0.1), (RIGHT,), 1.0, times=times)
    (axis,) = axes_of(found, monkeypatch)
    assert (axis.get_xlabel(), axis.get_ylabel()) == ("cells on a side", "seconds")
    drawn = {tuple(line.get_ydata()) for line in axis.lines if len(line.get_xdata()) == 2}
    assert drawn >= {(0.1, 0.4), (0.2, 0.6)}
    assert "in its time grows" not in found.summary() and "32²         0.1 s      0.5 times" in found.summary()
    # 4 times the cells take 4 times as long, and 3 times
    assert "power 1, that of bem3d 0.79" in found.summary()


def test_json_has_null_for_what_is_no_number_and_the_verdicts_of_both_schemas():
    lost = missing_number("k", {"Fbar": 1.0}, NO_RESULT, "no number")
    point = judged_number("k", {"Fbar": 2.0}, 2.0, 2.0, 0.0, 0.1)
    other = replace(point, where={"Fbar": 3.0})
    found = judged.Judgement("mine", "stiffness_model", judged.tolerance_of(0.1), (lost, point, other), 1.0)
    first, second, _ = found.as_dict()["verdicts"]
    assert first["value"] is first["difference"] is None and second["value"] == 2.0
    assert found.answered and not replace(found, numbers=(lost,)).answered
    assert [(row["verdict"], row["outcome"]) for row in (first, second)] == [("failed", NO_RESULT), ("agree", WITHIN)]
    ranges = [(row["from"], row["to"], row["outcome"]) for row in found.as_dict()["ranges"]]
    assert ranges == [(1.0, 1.0, NO_RESULT), (2.0, 3.0, WITHIN)]
    earlier = [(row["from"], row["to"], row["verdict"]) for row in found.as_dict()["enough"]]
    assert earlier == [(1.0, 1.0, "failed"), (2.0, 3.0, "agree")]


def test_keys_of_conditions_are_ascii_and_the_same_in_csv_and_json():
    where = {"H": 0.7, "q_r L / 2π": 8.0, "wavelength [mm]": 16.0, "region": "q a < 1"}
    found = judgement_of("mine", [2.0])
    found = replace(found, numbers=(replace(found.numbers[0], where=where),))
    (row,), keys = found.as_dict()["verdicts"], ["hurst", "q_r_L_2pi", "wavelength_mm", "region"]
    assert list(row["conditions"]) == keys and row["where"] == where
    assert list(row["conditions"].values()) == list(where.values())
    assert found.files()["verdicts.csv"].decode().splitlines()[0].split(",")[:6] == ["model", "quantity", *keys]


@catches("a number whose error is that of another one").at(
    "validation.judging.judge.row_of_number", lambda number: {"quantity": number.quantity, "error": 7.0}
)
def test_json_and_tables_have_the_names_of_python():
    where = {"H": 0.7, "wavelength [mm]": 16.0}
    found = judgement_of("mine", [2.0])
    found = replace(found, numbers=(replace(found.numbers[0], where=where),))
    (number,), (row,), (record,) = found.numbers, found.table(), found.as_dict()["numbers"]
    assert {name: getattr(number, name) for name in record} == record
    assert number.conditions == {"hurst": 0.7, "wavelength_mm": 16.0} and number.outcome == "within tolerance"
    assert row["hurst"] == 0.7 and {type(cell) for cell in row.values()} <= {float, str}
    assert {name: row[name] for name in record if name in row} == {name: record[name] for name in record if name in row}
    assert {*row} >= {"model", "kind", "value", "reference", "difference", "error", "error_grid", "unit", "outcome"}
    (part,), (record,) = found.ranges, found.as_dict()["ranges"]
    assert {record[name] == getattr(part, name) for name in ("quantity", "start", "stop", "conditions", "outcome")} == {
        True
    }


def test_one_model_of_a_file_is_judged_by_its_name(quick, file):
    path = laws(file, ["first", "second"])
    assert judged.judge(path, only="second").model == "second"
    with pytest.raises(ValueError, match="model must be one, got 'first', 'second': choose by only='first'"):
        judged.judge(path)
    with pytest.raises(ValueError, match="only must be one of first, second, got third"):
        judged.judge(path, only="third")


def test_names_of_the_last_release_work_and_name_the_new_ones():
    found = judgement_of("mine", [2.0, 3.0])
    with pytest.warns(FutureWarning, match=r"Judgement\.verdicts is Judgement\.numbers now, whose verdicts are within"):
        earlier = found.verdicts
    assert [number.verdict for number in earlier] == ["agree", "differ"]
    assert [(a.value, a.where, a.shown) for a in earlier] == [(n.value, n.where, n.shown) for n in found.numbers]
    with pytest.warns(FutureWarning, match=r"Judgement\.enough is Judgement\.ranges now"):
        parts = found.enough
    assert [(part.along, part.start, part.stop, part.verdict) for part in parts] == [
        ("Fbar", 1.0, 1.0, "agree"),
        ("Fbar", 10.0, 10.0, "differ"),
    ]
    assert [part.verdict for part in found.ranges] == [WITHIN, OUTSIDE]


@pytest.mark.parametrize("verdict", [OUTSIDE, NO_RESULT, NOT_SERVED])
def test_a_solver_is_wrong_by_whatever_decides_and_does_not_agree(verdict):
    point = replace(RIGHT, verdict=verdict)
    found = judged.Judgement("mine", "contact_solver", judged.tolerance_of(0.1), (RIGHT, point), 1.0)
    assert found.wrong and not replace(found, numbers=(RIGHT, replace(point, decides=False))).wrong
