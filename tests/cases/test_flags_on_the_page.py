"""A flag that something did not converge, on the page: what is said, and the exit status."""

from concurrent.futures import Future
from dataclasses import replace

import numpy as np
import pytest

from tests.seeded import catches
from validation import __main__ as command
from validation.analysis.case import Case
from validation.analysis.evidence import Evidence, Number, Role, Verdict
from validation.engine.engine import Engine
from validation.engine.progress import Part
from validation.report import build
from validation.report.contents import CASES


def evidence(numbers=(), unconverged=()):
    return Evidence(
        title="t", method="m", numbers=tuple(numbers), tables=(), conclusions=(), captions={}, unconverged=unconverged
    )


def number(value, role=Role.CRITERION, sample=0.0):
    """Beside one, within a tenth."""
    given = {"quantity": f"{value:g} {role} {sample:g}", "source": "s", "reason": "r"}
    return Number(value=value, reference=1.0, tolerance=0.1, sample=sample, role=role, **given)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("numbers", "unconverged", "status"),
    [
        ([number(1.0)], (), 0),
        ([number(3.0, Role.FINDING), number(1.0, Role.FINDING, sample=1.0)], (), 0),
        ([number(1.0), number(3.0)], (), 1),
        ([number(1.0, sample=1.0)], (), 1),
        ([number(1.0)], ("surface 3: residual 0.1",), 3),
        ([number(3.0)], ("surface 3: residual 0.1",), 3),
    ],
)
def test_what_a_report_ends_with(numbers, unconverged, status, monkeypatch, tmp_path, capsys):
    shown, out = evidence(numbers, unconverged), tmp_path / "report"
    monkeypatch.setattr(Case, "evidence", lambda case, result: result)
    monkeypatch.setitem(CASES, "geike", replace(CASES["geike"], run=lambda case, engine: shown))
    assert command.main(["report", "--only", "geike", "--out", str(out), "--workers", "1"]) == status
    page = "".join(page.read_text(encoding="utf-8") for page in out.glob("*.html"))
    printed, results = capsys.readouterr().out, (out / "results.json").read_text(encoding="utf-8")
    for line in unconverged:
        assert (
            line in page
            and line in results
            and f"not converged: {line}" in printed
            and f"exit status {status}: " in printed
        )
    criteria = [n for n in numbers if n.role is Role.CRITERION]
    missed = [n for n in criteria if n.verdict is not Verdict.WITHIN]
    assert all(f"check not passed: {n.sentence}" in " ".join(printed.split()) for n in missed)
    met = f"{len(criteria) - len(missed)} of {len(criteria)}"
    assert (met if criteria else "none") in printed


@pytest.mark.slow
def test_what_is_lost_is_counted_while_it_runs(tmp_path):
    for found, failed in ((0, 2), (4, 2)):
        progress = Part("toy")
        Engine(store=tmp_path, progress=progress).map(lost_if_odd, range(4))
        (solves,) = progress.kinds
        assert (solves.done, solves.stored, solves.failed) == (4, found, failed)


def lost_if_odd(problem):
    return {"failed": np.array(float(problem % 2))} if problem else {}


def as_it_is(result):
    return result


def of_a_number_that_is_lost(result):
    return result.numbers[9]


def section_of(part, result, making, monkeypatch):
    """What a report makes of a result that has come."""
    future = Future()
    future.set_result(result)
    monkeypatch.setattr(Case, "evidence", lambda case, result: making(result))
    return build._section("geike", CASES["geike"].quick, future, part)


@catches("a lost solve that nobody tells", making=as_it_is).at("validation.report.build._lost", lambda progress: ())
@pytest.mark.parametrize("making", [as_it_is, of_a_number_that_is_lost])
def test_a_lost_solve_is_told_whatever_its_case_makes_of_it(making):
    """A case that drops the flag, or whose evidence cannot be made of what is left, has not converged either."""
    part = Part("geike")
    part.begin("lost if odd", total=4)
    for failed in (False, True, False, True):
        part.step(failed)
    with pytest.MonkeyPatch.context() as patch:
        section = section_of(part, evidence(), making, patch)
    assert section.unconverged[:1] == ("lost if odd: 2 did not converge",)


def test_evidence_that_cannot_be_made_of_whole_solves_is_a_fault(monkeypatch):
    with pytest.raises(IndexError):
        section_of(Part("geike"), evidence(), of_a_number_that_is_lost, monkeypatch)
