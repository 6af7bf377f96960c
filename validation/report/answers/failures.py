"""Where boundary elements fail, as the case `limits` has found it."""

import re
from collections.abc import Sequence

from validation.cases.limits.limits import SUMMARY
from validation.report.answers.question import BEM
from validation.report.section import Section

COLUMNS = {
    "limit": "limit",
    "they fail where": "fails where",
    "what is wrong there": "error",
    "message": "message of the software",
}
"""Of the front page, and of the case."""
REASON = re.compile("[:;] ")


def failures(sections: Sequence[Section]) -> list[dict[str, str]]:
    """A row a limit, without its reasons; none where the case was not run."""
    evidence = next((section.evidence for section in sections if section.name == "limits"), None)
    if not evidence or not evidence.has_table(SUMMARY):
        return []
    table = evidence.table(SUMMARY)
    rows = zip(*(table[name].tolist() for name in COLUMNS.values()), strict=True)
    shown = [
        (limit.removeprefix(BEM).lstrip(":, "), *(REASON.split(cell)[0] for cell in cells))
        for limit, *cells in rows
        if limit.startswith(BEM)
    ]
    return [dict(zip(COLUMNS, row, strict=True)) for row in shown]
