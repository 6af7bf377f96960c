"""A flag that something did not converge, on the page: the words and exit status 3."""

from concurrent.futures import Future
from dataclasses import replace

import numpy as np
import pytest

import bem3d
from validation import __main__ as command
from validation.analysis.evidence import Evidence, Number, Role, Table, Verdict
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import Engine
from validation.engine.progress import Part
from validation.report import build
from validation.report.contents import CASES


def number(verdict, role=Role.CRITERION):
    value, sample = {"agree": (1.0, 0.0), "differ": (3.0, 0.0), "undecided": (1.0, 1.0)}[verdict]
    return Number(
        quantity=f"a {verdict} {role}",
        value=value,
        reference=1.0,
        source="s",
        tolerance=0.1,
        reason="r",
        sample=sample,
        role=role,
    )


def reported(monkeypatch, tmp_path, *, numbers=(), unconverged=(), raises=None):
    """Exit status and page of a report of one case, made up."""
    shown = Evidence(
        title="Made up",
        method="nothing",
        numbers=tuple(numbers),
        tables=(Table("t", {"x": [1.0]}),),
        conclusions=(),
        captions={},
        unconverged=unconverged,
    )

    def run(case, engine):
        if raises:
            raise raises
        return shown

    entry = replace(CASES["geike"], run=run, evidence=lambda result: result)
    monkeypatch.setitem(CASES, "geike", entry)
    status = command.main(["report", "--only", "geike", "--out", str(tmp_path / "report"), "--workers", "1"])
    return (
        status,
        "".join(page.read_text() for page in (tmp_path / "report").glob("*.html")),
        (tmp_path / "report" / "results.json").read_text(),
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("numbers", "unconverged", "status"),
    [
        ([number("agree")], (), 0),
        ([number("differ", Role.FINDING), number("undecided", Role.FINDING)], (), 0),
        ([number("agree"), number("differ")], (), 1),
        ([number("undecided")], (), 1),
        ([number("agree")], ("surface 3: residual 0.1",), 3),
        ([number("differ")], ("surface 3: residual 0.1",), 3),
    ],
)
def test_what_a_report_ends_with(numbers, unconverged, status, monkeypatch, tmp_path, capsys):
    ended, page, results = reported(monkeypatch, tmp_path, numbers=numbers, unconverged=unconverged)
    assert ended == status
    printed = capsys.readouterr().out
    for line in unconverged:
        assert line in page and line in results and f"not converged: {line}" in printed
    assert ("Not converged" in page) == ("1 not converged" in page) == bool(unconverged)
    missed = [n for n in numbers if n.role is Role.CRITERION and n.verdict is not Verdict.AGREE]
    for n in missed:
        assert f"missed: {n.sentence}" in printed
    assert page.count("Missed criterion") == len(missed)
    criteria = sum(n.role is Role.CRITERION for n in numbers)
    assert f"criteria met {criteria - len(missed)} of {criteria}" in printed


@pytest.mark.slow
@pytest.mark.parametrize(
    "error",
    [
        NotConvergedError("too little is left", ("strip 1: 3 positions",)),
        bem3d.ConvergenceError("residual 0.1 after 1 iterations", (1.0, 0.1), None),
    ],
)
def test_a_case_without_evidence_is_not_converged(error, monkeypatch, tmp_path, capsys):
    ended, page, results = reported(monkeypatch, tmp_path, raises=error)
    assert ended == command.Exit.NOT_CONVERGED == 3
    printed = capsys.readouterr().out
    for line in (str(error), *getattr(error, "unconverged", ())):
        assert line in page and line in results and f"not converged: {line}" in printed
    assert "no result" in page and "no result" in printed


@pytest.mark.slow
def test_what_is_lost_is_counted_while_it_runs(tmp_path):
    for found, failed in ((0, 2), (4, 2)):
        progress = Part("toy")
        Engine(store=tmp_path, progress=progress).map(lost_if_odd, range(4))
        assert (progress.done, progress.found, progress.failed) == (4, found, failed)


def lost_if_odd(problem):
    return {"failed": np.array(float(problem % 2))} if problem else {}


def as_it_is(result):
    return result


def of_a_number_that_is_lost(result):
    return result.numbers[9]


@pytest.mark.parametrize("evidence", [as_it_is, of_a_number_that_is_lost])
def test_a_lost_solve_is_told_whatever_its_case_makes_of_it(evidence):
    """A case that drops the flag, or whose evidence cannot be made of what is left, has not converged either."""
    part, result = Part("geike"), Future()
    part.begin("lost if odd", total=4)
    for failed in (False, True, False, True):
        part.step(failed)
    result.set_result(Evidence(title="t", method="m", numbers=(), tables=(), conclusions=(), captions={}))
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(CASES, "geike", replace(CASES["geike"], evidence=evidence))
        section = build._section("geike", CASES["geike"].quick, result, part)
    assert section.unconverged[:1] == ("lost if odd: 2 did not converge",)


def test_evidence_that_cannot_be_made_of_whole_solves_is_a_fault():
    result = Future()
    result.set_result(())
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(CASES, "geike", replace(CASES["geike"], evidence=lambda result: result[0]))
        with pytest.raises(IndexError):
            build._section("geike", CASES["geike"].quick, result, Part("geike"))
