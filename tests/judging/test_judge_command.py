"""`mdr-validation judge` and `validation.judge`: what they write, how they end, what they refuse in one sentence."""

import csv
import json
import re
import subprocess
import sys
from dataclasses import replace
from functools import partial

import pytest

import validation
from tests.judging.judged_points import NO_RESULT, OUTSIDE, WITHIN
from validation.__main__ import main
from validation.judging import judge as judged
from validation.judging.figure import figure_of
from validation.judging.judgement import LEVEL, SolverTime, judged_number, missing_number
from validation.judging.judgement_text import paragraph
from validation.judging.kinds.own import ErrorOfCall
from validation.judging.kinds.properties import HEAVY, LIGHT

SERIES = """
from validation import stiffness_model

@stiffness_model("in series")
def series(load, side, modulus, roughness):
    return 1 / (0.49 * roughness.rms / load + 1 / (1.1523 * modulus * side))
"""
NAN = """
@stiffness_model("lost")
def lost(load):
    print("lost at", load)
    return float("nan")
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(SERIES, encoding="utf-8")
    return path


@pytest.mark.slow
def test_a_formula_is_judged_and_written(file, tmp_path, capsys):
    places = [tmp_path / name for name in ("found.json", "found.csv", "found.png")]
    words = [word for pair in zip(("--json", "--csv", "--figure"), map(str, places), strict=True) for word in pair]
    assert main(["judge", str(file), "--out", str(tmp_path / "out"), *words]) == 0
    printed, found = capsys.readouterr().out, json.loads(places[0].read_text(encoding="utf-8"))
    assert list(found) == [
        *(
            "schema_version",
            "model",
            "kind",
            "tolerance",
            "numbers",
            "verdicts",
            "ranges",
            "enough",
            "remarks",
            "seconds",
        )
    ]
    assert found["schema_version"] == 2
    assert (found["model"], found["kind"], found["tolerance"]) == ("in series", "stiffness_model", 0.1)
    point = found["verdicts"][0]
    assert {"quantity", "where", "value", "reference", "difference", "error", "outcome", "reason"} <= set(point)
    assert point["conditions"] == {"hurst": point["where"]["H"], "normalised_load": point["where"]["Fbar"]}
    assert point["difference"] == pytest.approx(point["value"] / point["reference"] - 1)
    assert {"quantity", "where", "along", "from", "to", "verdict"} == set(found["enough"][0])
    assert {"quantity", "conditions", "along", "from", "to", "start", "stop", "outcome"} == set(found["ranges"][0])
    ranges = [r for r in found["ranges"] if r["quantity"] == "mean stiffness" and r["conditions"] == {"hurst": 0.7}]
    assert [(r["along"], r["outcome"]) for r in ranges] == [("normalised_load", OUTSIDE), ("normalised_load", WITHIN)]
    rows = list(csv.DictReader(places[1].read_text(encoding="utf-8").splitlines()))
    assert len(rows) == len(found["verdicts"])
    assert [row["outcome"] for row in rows] == [p["outcome"] for p in found["verdicts"]]
    assert [row["normalised_load"] for row in rows[:2]] == ["0.001", "0.002154435"] and "verdict" not in rows[0]
    assert places[2].read_bytes()[1:4] == b"PNG"
    strip = "H = 0.7                          ########=====  within tolerance from 0.464 to 10; "
    assert f"{strip}outside tolerance from 0.001 to 0.215" in printed
    legend = "= within tolerance, # outside tolerance, ? inconclusive, r not served, x no result"
    assert f"strips: {legend}" in printed
    said = " ".join(printed.split())
    assert "compared with boundary elements, the references of mdr-validation" in said
    assert "A number is within 10 % where its whole 95 % interval is, by the errors of both." in said
    assert "Its mean stiffness is within 10 % for Fbar = 0.464 to 10 at every H (compared: H = 0.4, 0.55, 0.7, " in said
    assert "1; Fbar = 0.001 to 10; all at q_max / q_min = 64)." in said
    assert "They share: Fbar up to 0.00215" in printed
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert names == {"judgement.json", "verdicts.csv", "summary.txt", "judgement.svg", "costs.csv", "manifest.json"}
    costs = list(csv.DictReader((tmp_path / "out" / "costs.csv").read_text(encoding="utf-8").splitlines()))
    assert [(cost["model"], cost["unit"]) for cost in costs] == [("in series", "-"), ("springs", "-")]
    assert all(0 < float(cost["error"]) < 1 and float(cost["seconds"]) > 0 for cost in costs)
    assert (tmp_path / "out" / "summary.txt").read_text(encoding="utf-8").splitlines()[2:] == printed.splitlines()[2:-1]


@pytest.mark.slow
def test_a_model_that_answers_nowhere_ends_with_three_unless_another_does(file, tmp_path, capsys):
    file.write_text(SERIES + NAN, encoding="utf-8")
    assert main(["judge", str(file), "--only", "lost", "--json", str(tmp_path / "found.json")]) == 3
    assert "returned NaN or infinity" in capsys.readouterr().out
    last = json.loads((tmp_path / "found.json").read_text(encoding="utf-8"))["verdicts"][-1]
    assert (last["quantity"], last["outcome"], last["value"]) == ("printing", NO_RESULT, None)
    assert last["reason"].startswith("printed 'lost at ")
    assert main(["judge", str(file), "--json", str(tmp_path / "found.json")]) == 0
    assert [one["model"] for one in json.loads((tmp_path / "found.json").read_text(encoding="utf-8"))] == [
        "in series",
        "lost",
    ]


def broken(model, *_):
    raise ZeroDivisionError("planted")


@pytest.mark.parametrize(
    "place",
    [
        "validation.judging.kinds.stiffness._rise",
        "validation.judging.kinds.properties.swept",
        "validation.judging.judge.costs_of",
        "validation.judging.solvers.checks.judged",
    ],
)
def test_an_error_of_ours_is_a_row_and_takes_no_other_model_with_it(place, file, tmp_path, capsys, monkeypatch):
    solver = "@contact_solver('solver')\ndef solver(gap, force): return gap\n" if "solvers" in place else ""
    law = "@contact_law('no force')\ndef law(approach): return 0 * approach\n"
    file.write_text(f"{SERIES}\nfrom validation import contact_law, contact_solver\n{law}{solver}", encoding="utf-8")
    monkeypatch.setattr(place, broken)
    assert main(["judge", str(file), "--json", str(tmp_path / "found.json")]) == 0
    assert "Traceback" not in capsys.readouterr().err
    found = {one["model"]: one["verdicts"] for one in json.loads((tmp_path / "found.json").read_text(encoding="utf-8"))}
    reason = "mdr-validation could not go on, which is its own error: ZeroDivisionError: planted, line "
    rows = [row for rows in found.values() for row in rows if row["quantity"] == "judging"]
    assert {row["outcome"] for row in rows} == {NO_RESULT} and rows[0]["reason"].startswith(reason)
    assert {row["reason"].partition(";")[0] for row in found["no force"] if row["reference"] != 1} >= {
        "at an approach of 0.032 m it bears less than the load"
    }
    assert len(found["in series"]) > 50


@pytest.mark.parametrize(
    ("body", "words", "sentence"),
    [
        (None, [], "error: FILE must be a Python file, or a name of judge --list, got '{path}'"),
        (SERIES, ["--list"], "--list judges nothing, got it beside {path}: leave one of them out"),
        ("x = 1", [], "mine.py: no function has a decorator, which is one of @stiffness_model, @stiffness_of_surface"),
        (
            "import nothing_of_the_kind",
            [],
            "ModuleNotFoundError: No module named 'nothing_of_the_kind', line 1 of mine",
        ),
        ("def f(:", [], "mine.py: SyntaxError"),
        (
            SERIES.replace("load,", "laod,"),
            [],
            "mine.py: line 4 of mine.py: 'in series': laod is unknown: @stiffness_model may ask for load, side, ",
        ),
        (SERIES, ["--only", "other"], "--only must be one of in series, got other"),
        (SERIES, ["--tolerance", "ten"], "tolerance must be as"),
    ],
)
def test_what_cannot_be_judged_is_refused_in_one_sentence(body, words, sentence, file, capsys):
    if body is None:
        file.unlink()
    else:
        file.write_text(body, encoding="utf-8")
    assert main(["judge", str(file), *words]) == 2
    printed = capsys.readouterr()
    assert sentence.format(path=file) in printed.err
    assert printed.err.count("\n") == 1 and not printed.out


OFFERS = """bro/ken.law = broken_pack:series
contact_pack = contact_pack
lost = no_such_pack
no name = contact_pack:nobody
series = contact_pack:series
wrong = wrong_pack:series"""


@pytest.fixture
def package(tmp_path, monkeypatch):
    """An installed one that offers a model by its entry point, and another that is broken."""
    (tmp_path / "contact_pack.py").write_text(SERIES + "\nprint('imported')\n", encoding="utf-8")
    about = tmp_path / "contact_pack-1.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: contact-pack\nVersion: 1\n", encoding="utf-8")
    (tmp_path / "broken_pack.py").write_text("import this_is_no_module\n" + SERIES, encoding="utf-8")
    (tmp_path / "wrong_pack.py").write_text(SERIES.replace("load,", "laod,"), encoding="utf-8")
    (about / "entry_points.txt").write_text(f"[mdr_validation.models]\n{OFFERS}\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))


def test_what_a_package_offers_is_listed_unread_and_judged_by_its_name(package, capsys):
    assert main(["judge", "--list"]) == 0
    assert capsys.readouterr().out.splitlines() == OFFERS.replace(" = ", ": ").splitlines()
    for name in ("series", "contact_pack"):
        assert main(["judge", name]) == 0
        assert capsys.readouterr().out.startswith("in series: ")
    assert "contact_pack" not in sys.modules
    assert main(["judge"]) == 2
    assert "judge needs a FILE with decorated functions, or a name" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("lost", "entry point 'lost' (no_such_pack): ModuleNotFoundError: No module named 'no_such_pack'"),
        (
            "bro/ken.law",
            "entry point 'bro ken.law' (broken_pack:series): ModuleNotFoundError: No module named 'this_is_no_module', "
            "line 1 of broken_pack.py",
        ),
        ("no name", "entry point 'no name' (contact_pack:nobody): ImportError: cannot import name 'nobody' from 'co"),
        ("wrong", "entry point 'wrong' (wrong_pack:series): line 4 of wrong_pack.py: 'in series': laod is unknown"),
    ],
)
def test_an_entry_point_that_is_broken_is_named_with_the_line_of_its_package(name, said, package, capsys):
    assert main(["judge", name]) == 2
    line = capsys.readouterr().err
    assert line.startswith(f"error: {said}") and len(line.splitlines()) == 1
    assert "of entry point" not in line


def test_where_a_model_breaks_and_what_it_costs_is_said(file, tmp_path, capsys):
    """A stiffness that falls, and an end of another law: which loads, how far off, and that nothing was said of it."""
    file.write_text(
        SERIES.replace("return 1", "return 1 / (1 + load / (20 * modulus * roughness.rms * side))"), encoding="utf-8"
    )
    assert main(["judge", str(file), "--figure", str(tmp_path / "found.svg")]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert "Tests not passed: rise with the load, at the least, H = 0.4 to 1: -" in printed
    assert "under a heavy load, Fbar = 30 to 1e+04: -" in printed and "%, without a warning" in printed
    assert "Median error of the mean stiffness, and seconds of the call that took longest: in series" in printed
    assert re.search(r"springs \d+\.?\d* %", printed)
    assert b"seconds of a call" in (tmp_path / "found.svg").read_bytes()


def solver(*points):
    """What a solver is judged to be by these points."""
    return judged.Judgement("mine", "contact_solver", judged.tolerance_of(0.1), points, 1.0)


RIGHT = replace(judged_number("approach", {"problem": "sphere"}, 1.0, 1.0, 0.0, 0.1), decides=True)
BESIDE = judged_number("order of convergence", {"problem": "flat"}, 3.0, 1.0, 0.0, 0.1)
LOST = missing_number("approach", {"problem": "rough"}, NO_RESULT, "raised MemoryError", decides=True)


@pytest.mark.parametrize(
    ("points", "status"), [([RIGHT, RIGHT, BESIDE], 0), ([RIGHT, LOST], 1), ([LOST], 3), ([], 3), ([BESIDE], 0)]
)
def test_a_solver_that_differs_where_that_decides_ends_with_one(points, status, monkeypatch, file, capsys):
    monkeypatch.setattr("validation.judging.commands.judge.judged", lambda model, tolerance: solver(*points))
    assert main(["judge", str(file)]) == status


def test_the_functions_take_what_is_decorated_and_a_file(file):
    @validation.stiffness_model("flat punch")
    def flat(side, modulus):
        return 1.1523 * modulus * side

    found = validation.judge(flat, "1 dB")
    assert found.tolerance.relative == pytest.approx(10 ** (1 / 20) - 1)
    assert {p.verdict for p in found.numbers if p.where.get("Fbar") == 0.001} == {OUTSIDE}
    assert {p.verdict for p in found.numbers if p.where.get("Fbar") == 10.0} == {WITHIN}
    assert validation.judge(file).model == "in series"
    file.write_text(SERIES + NAN, encoding="utf-8")
    with pytest.raises(ValueError, match="model must be one, got 'in series', 'lost'"):
        validation.judge(file)
    with pytest.raises(TypeError, match="folder must be a path, got 3"):
        solver(RIGHT).save(3)
    for wrong in (flat.function, 3, None):
        with pytest.raises(TypeError, match="must be a function with a decorator"):
            validation.judge(wrong)


def test_a_figure_has_a_form():
    with pytest.raises(ValueError, match="a figure must be one of svg, png, pdf, got 'gif'"):
        figure_of([solver(RIGHT)], "gif")
    assert b"<svg" in figure_of([solver(RIGHT)], "svg")


def test_a_paragraph_says_beside_what_how_near_and_over_which_conditions():
    """Of levels in decibels; of points apart how many are near."""
    level = partial(judged_number, value=1.0, half_width=0.1, tolerance=0.1, unit=LEVEL)
    places = [{"wheel": f"wheel {i}", "alpha": a} for i in range(13) for a in (0.0, 0.5)]
    filters = [level("contact filter", where, reference=1 + 4 * where["alpha"]) for where in places]
    regions = [level("level", {"region": f"region {i}"}, reference=1.1) for i in (1, 2)]
    said = paragraph(judged.Judgement("mine", "contact_law", judged.tolerance_of(0.1), (*filters, *regions), 1.0))
    assert (
        "with springs (MDR) under the wheel of Table 14.1 (R = 0.5 m, E* = 236.25 GPa, 4905 N, 500 kg, 20 m/s, " in said
    )
    filter_ = "Its contact filter is within 0.83 dB for alpha = 0 at every wheel compared there"
    assert f"{filter_} (compared: 13 values of wheel; alpha = 0, 0.5)." in said
    assert "Of 28 points 15 are within tolerance, 13 outside tolerance. " in said
    assert "The largest deviation, of its contact filter, is -2 dB ± 0.1 dB" in said
    assert "Its level is within 0.83 dB at 2 of 2 points (compared: region 1, region 2)." in said


def pointed(values, **common):
    """Along Fbar, one where the number is 1."""
    return [judged_number("k", {**common, "Fbar": 10.0**i}, value, 2.0, 0.0, 0.1) for i, value in enumerate(values)]


@pytest.mark.parametrize(
    ("groups", "said"),
    [
        ({16.0: [2, 2, 2], 64.0: [2, 2]}, "Its k is within 10 % for Fbar = 1 to 10 at every band"),
        ({16.0: [3, 3, 2], 64.0: [3, 3]}, "Its k is within 10 % for Fbar = 100 at band = 16 ("),
        (
            {16.0: [2, 3, 2], 64.0: [3, 2, 3]},
            "Its k is within 10 % for Fbar = 1 and 100 at band = 16; 10 at band = 64 (",
        ),
        ({"old": [3, 3, 2], "new": [3, 3]}, "Its k is within 10 % for Fbar = 100 at every band compared there"),
        ({16.0: [3, 3, 3], 64.0: [3, 3]}, "For no Fbar its k is within 10 % for certain"),
    ],
)
def test_a_range_ends_where_a_reference_does_and_what_is_good_somewhere_is_said(groups, said):
    points = tuple(point for band, values in groups.items() for point in pointed(values, band=band))
    words = paragraph(judged.Judgement("mine", "stiffness_model", judged.tolerance_of(0.1), points, 1.0))
    assert said in words


def test_ends_at_which_a_model_agrees_are_not_where_it_breaks():
    """Not even where it differs in its own scenes."""
    ends = [
        judged_number(HEAVY, {"Fbar": 30.0}, 1.0, 1.0, 0.0, 0.1),
        judged_number(LIGHT, {"Fbar": 1e-6}, 1.0, 1.0, 0.2, 0.1),
    ]
    for last, words in (
        (2.0, "asymptotic limits: 1 of 2 passed; inconclusive: under a light load"),
        (3.0, "Tests not passed: "),
    ):
        broken = judged_number("scaling with the length", {"Fbar": 3.0}, last / 2, 1.0, 0.0, 1e-6)
        points = (*pointed([3, 3]), *ends, broken)
        found = judged.Judgement("mine", "stiffness_model", judged.tolerance_of(0.1), points, 1.0)
        assert ("closed form: scaling with the length." in paragraph(found)) == (last == 3.0)
        assert words in " ".join(found.summary().split()) and "nowhere" not in found.summary()


def test_a_paragraph_on_a_model_that_answers_nowhere_says_that_alone():
    lost = tuple(missing_number("k", {"Fbar": 10.0**i}, NO_RESULT, "no number", reference=1.1) for i in range(3))
    said = paragraph(judged.Judgement("mine", "stiffness_model", judged.tolerance_of(0.1), lost, 1.0))
    assert said.endswith("by the errors of both. It has no value at 3 of 3 points.")


def test_seconds_are_drawn_with_plain_ticks():
    """Two errors within a tenth of a decade have a tick; a solver and ours are two curves."""
    costs = tuple(ErrorOfCall(name, error, "dB", 1e-5) for name, error in (("mine", 5.9), ("other", 6.1)))
    near = judged.Judgement("mine", "contact_filter", judged.tolerance_of(0.1), (), 1.0, costs=costs)
    timed = replace(solver(RIGHT), times=(SolverTime(32.0, 0.1, 0.2), SolverTime(64.0, 0.4, 0.6)))
    drawn = figure_of([near, timed], "svg").decode()
    for text in ("median error [dB]", "seconds, one thread", "bem3d", "other"):
        assert text in drawn
    assert re.search(r">\s*5\s*<", drawn) and "×" not in drawn and "10^" not in drawn


@pytest.mark.slow
def test_a_script_without_a_guard_may_judge_a_file(file):
    """The other process does not import the script once more."""
    code = f"import validation; print(validation.judge({str(file)!r}).model)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8")
    assert (run.stdout, run.stderr) == ("in series\n", "")
