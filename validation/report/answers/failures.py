"""Where boundary elements fail, as the case `limits` has found it."""

from collections.abc import Sequence

from validation.cases.limits.limits import SUMMARY
from validation.report.answers.questions import BEM
from validation.report.section import Section


def failures(sections: Sequence[Section]) -> list[tuple[str, str]]:
    """The limit and the condition past which they fail, a pair each; none where the case was not run."""
    evidence = next((section.evidence for section in sections if section.name == "limits"), None)
    if not evidence or not evidence.has_table(SUMMARY):
        return []
    table = evidence.table(SUMMARY)
    rows = zip(table["limit"].tolist(), table["fails where"].tolist(), strict=True)
    return [
        (limit.removeprefix(BEM).lstrip(":, "), where.split(": ")[0]) for limit, where in rows if limit.startswith(BEM)
    ]
