"""A report that makes one case anew keeps the others as they were made, and says of what is new on which processor."""

import json
import re
from dataclasses import replace
from types import SimpleNamespace

import pytest

from tests.report.test_command_line import SMALL
from tests.seeded import catches
from validation import __main__ as command
from validation.report import provenance
from validation.report import provenance as code_behind
from validation.report.contents import CASES, TIMED

TODAY = {"geike": "today", "hertz": "today"}


@pytest.fixture(autouse=True)
def _small(monkeypatch, without_figures):
    for name in ("hertz", "geike"):
        monkeypatch.setitem(CASES, name, replace(CASES[name], quick=SMALL[name]))


def report(out, *words):
    return command.main(["report", "--out", str(out), "--workers", "1", *words])


def refused(capsys, said, out, *words):
    assert report(out, *words) == command.Exit.BAD_INPUT
    assert said in capsys.readouterr().err


def of(folder, file):
    return json.loads((folder / file).read_text(encoding="utf-8"))


@pytest.mark.slow
def test_the_other_case_is_kept(tmp_path, monkeypatch):
    commits = iter(("first00", "second0", "third00"))
    monkeypatch.setattr(provenance, "_commit", lambda: next(commits))
    assert report(tmp_path, "--only", "hertz", "geike") == command.Exit.MET
    first, made = of(tmp_path, "results.json"), of(tmp_path, "provenance.json")
    assert report(tmp_path, "--only", "geike", "--keep", "--seed", "5") == command.Exit.MET
    second, about = of(tmp_path, "results.json"), of(tmp_path, "provenance.json")
    assert list(second["cases"]) == ["hertz", "geike"]
    assert second["cases"]["hertz"] == first["cases"]["hertz"]
    assert second["cases"]["geike"] != first["cases"]["geike"]
    assert (made["commit"], about["commit"]) == ("first00", "second0")
    assert about["kept"] == {"hertz": "first00"}
    assert about["seconds"]["hertz"] == made["seconds"]["hertz"]
    assert list(about["code"]) == ["hertz", "geike"] and about["code"] == made["code"]
    assert about["load"] >= 0 and about["date"].endswith("+00:00") and about["machines"] == {}
    page = "".join(path.read_text(encoding="utf-8") for path in tmp_path.glob("*.html"))
    assert "Version" in page and "commit second0; kept as made at commit first00: hertz" in page
    cited = {
        figure: commit for commit, figure in re.findall(r"commit (\w+), profile quick\), exact.html#figure-(\w+)", page)
    }
    assert cited == {"hertz": "first00", "geike": "second0"}
    assert report(tmp_path, "--only", "geike") == command.Exit.MET
    assert list(of(tmp_path, "results.json")["cases"]) == ["geike"]


WITH_KEPT = provenance.with_kept


def as_of_today(about, before, kept):
    """A case that is kept passes for one of this run."""
    return WITH_KEPT(about, {**before, "kept": {}, "commit": about["commit"]}, kept)


@catches("a case that is kept has today's commit").at("validation.report.provenance.with_kept", as_of_today)
def test_a_case_that_is_kept_twice_has_the_commit_that_made_it():
    about = {"commit": "today00", "seeds": {"ridges": 1}, "seconds": {"ridges": 1.0}, "kept": {}}
    before = {"commit": "before0", "seeds": {}, "seconds": {"hertz": 3.0}, "kept": {"geike": "first00"}}
    made = {"code": {"geike": "digest"}, "machines": {"hertz": {"cores": 2}}}
    sections = [SimpleNamespace(name="hertz"), SimpleNamespace(name="geike")]
    found = provenance.with_kept({**about, "code": {}, "machines": {}}, before | made, sections)
    assert found["kept"] == {"hertz": "before0", "geike": "first00"}
    assert found["commit"] == "today00" and found["seconds"] == {"ridges": 1.0, "hertz": 3.0}
    assert {part: found[part] for part in made} == made
    assert provenance.kept_from(found) == {"before0": ["hertz"], "first00": ["geike"]}


def test_what_cannot_be_kept_is_refused(tmp_path, capsys):
    refused(capsys, "--keep needs an earlier report", tmp_path / "none", "--only", "geike", "--keep")
    assert not (tmp_path / "none").exists()
    refused(capsys, "--keep is for --only", tmp_path / "none", "--keep")
    assert report(tmp_path, "--only", "hertz") == command.Exit.MET
    refused(capsys, "needs the profile of the report", tmp_path, "--only", "geike", "--keep", "--profile", "full")
    old = of(tmp_path, "results.json")
    del old["cases"]["hertz"]["title"]
    (tmp_path / "results.json").write_text(json.dumps(old), encoding="utf-8")
    refused(capsys, "cannot keep hertz: 'title'", tmp_path, "--only", "geike", "--keep")


@catches("a case that is kept, whatever code has made it", made_by={}, named="geike and hertz").at(
    "validation.report.provenance.require_todays_code", lambda *of: None
)
@pytest.mark.parametrize(
    ("made_by", "named"),
    [({}, "geike and hertz"), ({"geike": "today", "hertz": "of another commit"}, "hertz"), (TODAY, "")],
)
def test_a_case_of_other_code_is_not_kept(made_by, named):
    """Or of code that its report does not name; the message says what to make anew."""
    said = ""
    try:
        code_behind.require_todays_code({"code": made_by}, TODAY)
    except ValueError as error:
        said = str(error)
    assert said.endswith(f"{named}: make it anew, with --only {named.replace(' and', '')}" if named else "")
    assert bool(said) is bool(named)


def test_every_case_has_a_digest_of_its_own(monkeypatch):
    """Its settings are a part of it."""
    monkeypatch.setattr(code_behind, "version_of", lambda *of: str(of))
    found = [code_behind.versions_of(CASES | TIMED, profile) for profile in ("quick", "full")]
    assert len({digest for some in found for digest in some.values()}) == 2 * len(CASES | TIMED)


@catches("the code behind a case without its settings").at("validation.report.provenance.as_json", lambda value: b"")
def test_the_code_behind_a_case_is_what_makes_its_numbers():
    """Settings and series; neither a study in a file of its own nor the page."""
    roots, case = [], CASES["wheel_distance"]
    other = replace(case, quick=replace(case.quick, wheels=case.quick.wheels + 1))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(code_behind, "version_of", lambda *of: roots.append(of) or "digest")
        (quick, full), (more, same) = (
            [code_behind.version_of_numbers(one, profile) for profile in ("quick", "full")] for one in (case, other)
        )
    assert set(roots) == {(("validation.analysis.case", "validation.cases.wheel.distance"), code_behind.WORDS)}
    assert more != quick and same == full


CPUINFO = "processor : 0\nmodel name\t: Made-up 9 @ 3 GHz\n\nprocessor : 1\nmodel name\t: Another\n"


@pytest.mark.parametrize(
    ("listed", "wanted"), [(CPUINFO, "Made-up 9 @ 3 GHz"), ("CPU part : 0xd0c\n", "arch"), (None, "arch")]
)
def test_the_processor_is_the_first_that_the_system_lists_or_its_architecture(listed, wanted, tmp_path, monkeypatch):
    if listed is not None:
        (tmp_path / "cpuinfo").write_text(listed, encoding="utf-8")
    monkeypatch.setattr(provenance, "PROCESSORS", tmp_path / "cpuinfo")
    monkeypatch.setattr(provenance.platform, "processor", lambda: "")
    monkeypatch.setattr(provenance.platform, "machine", lambda: "arch")
    assert provenance.processor() == wanted
