"""Make the pages and answers of the committed report anew, by today's code: `python .ci/pages.py [FIGURE ...]`.

From its results and data, without a solve: numbers and tables stay as they are, and claims are judged anew by them. The
figures that are named are drawn anew, "all" is every one. Then the table of README.md, as `make answers` does it.
"""

import json
import runpy
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from validation.analysis.case import Study, _title
from validation.analysis.claims import Claim
from validation.analysis.evidence import Evidence, JudgedClaim
from validation.report import earlier_report
from validation.report.build import _files
from validation.report.contents import CASES, TIMED
from validation.report.folder import RESULTS, Folder
from validation.report.page import FIGURES, draw_figure
from validation.report.provenance import _commit, with_kept
from validation.report.section import Section

ROOT = Path(__file__).resolve().parents[1]
REFERENCE = ROOT / "reports" / "reference"


def sections() -> list[Section]:
    """Of all cases of the report, whatever code has made them."""
    files = [REFERENCE / RESULTS, *(path for name in TIMED if (path := REFERENCE / f"{name}.json").exists())]
    cases = {name: case for file in files for name, case in json.loads(file.read_text("utf-8"))["cases"].items()}
    found = [earlier_report._section(REFERENCE, name, case) for name, case in cases.items()]
    in_order = list(CASES | TIMED)
    return [judged_anew(section) for section in sorted(found, key=lambda section: in_order.index(section.name))]


def judged_anew(section: Section) -> Section:
    """Its claims and matrices in today's words. Raises ValueError where a status would be another one."""
    evidence, study = section.evidence, section.entry.study
    if evidence is None:
        return section
    tested = [claim for claim in study.claims if claim.numbers(evidence.numbers)]
    pairs = [(claim, _judged(claim, old, evidence)) for claim, old in zip(tested, evidence.claims, strict=True)]
    said = {claim.says: claim.headline(judged) for claim, judged in pairs if claim.short}
    matrices = [matrix.table(evidence.numbers) for matrix in study.matrices]
    return replace(
        section,
        evidence=replace(
            evidence,
            claims=tuple(judged for _, judged in pairs),
            page_tables=(*matrices, *evidence.page_tables[len(matrices) :]),
            headlines=_headlines(study, said, evidence),
            finding=f"{_title(list(said.values())[:2])}." if said else "",
        ),
    )


def _judged(claim: Claim, old: JudgedClaim, evidence: Evidence) -> JudgedClaim:
    anew = claim.saying(old.claim, claim.short).judged(evidence.numbers)
    if (anew.status, anew.numbers) != (old.status, old.numbers):
        raise ValueError(
            f"the claim {old.claim!r} is {anew.status} by today's code, and was {old.status}: make the case anew"
        )
    return anew


def _headlines(study: Study, said: dict[str, str], evidence: Evidence) -> dict[str, str]:
    charts = {chart.name: chart for chart in study.charts}
    says = [claim.says for claim in study.claims]
    return {name: _title(said[says[i]] for i in charts[name].claims if says[i] in said) for name in evidence.headlines}


def make_anew(figures: Sequence[str]) -> None:
    """The report folder, in place, and the table of README.md."""
    every, about = sections(), earlier_report.kept_provenance(REFERENCE)
    about = with_kept({**about, "commit": _commit()}, about, every)
    drawn = {
        name: draw_figure(name, section.evidence, "full")
        if name in figures or "all" in figures
        else (REFERENCE / FIGURES / f"{name}.svg").read_bytes()
        for section in every
        if section.evidence
        for name in section.evidence.captions
    }
    with Folder(REFERENCE) as folder:
        folder.replace(_files(every, drawn, "full", about, None))
    runpy.run_path(str(ROOT / ".ci" / "readme.py"), run_name="__main__")


if __name__ == "__main__":
    make_anew(sys.argv[1:])
