"""Write the table of answers of README.md from the results of the committed report: `python .ci/readme.py`."""

import json
import re
from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

from validation.analysis.claims import listed
from validation.report.answers.strip import interval

ROOT = Path(__file__).resolve().parents[1]
TABLE = re.compile(r"(<!-- answers: .*? -->\n).*?(<!-- end of answers -->)", flags=re.DOTALL)
HEAD = "\n| question | is MDR enough? | over | what else is enough |\n|---|---|---|---|\n"
WORDS = ("within tolerance", "inconclusive", "outside tolerance")


def with_answers(text: str, results: Mapping[str, Any]) -> str:
    """The page with a row a question between its marks."""
    rows = "".join(f"| {' | '.join(cells(row))} |\n" for row in results["when_mdr_is_accurate_enough"])
    return TABLE.sub(lambda found: found[1] + HEAD + rows + "\n" + found[2], text)


def cells(row: Mapping[str, Any]) -> list[str]:
    """Neighbouring places with the same answer are one range; what a model costs is left to the report."""
    places: dict[str, list[str]] = {}
    measured = [cell for cell in row["strip"] if cell["verdict"] in WORDS]
    for (word, alone), group in groupby(measured, key=lambda cell: (cell["verdict"], cell.get("alone", ""))):
        some = list(group)
        where = _range(some, row["deciding_number"], closed=some[-1] is measured[-1])
        places.setdefault(word, []).append(f"{where} ({alone})" if alone else where)
    words = [word for word in WORDS if word in places]
    where = "; ".join(f"{word}: {listed(places[word])}" for word in words)
    instead = "; ".join(model["model"] for model in row["instead"])
    said = [row["question"], f"**{row['answer']}.** {where}", row["deciding_number"], instead]
    return [text.replace("|", r"\|") for text in said]


def _range(cells: Sequence[Mapping[str, Any]], over: str, *, closed: bool) -> str:
    """Of ranges "0.01 ≤ Fbar < 0.1", the last of them closed; of points "0.024 to 0.73", "ridges to alpha = 0.25"."""
    ends = [cell.get("ends") for cell in (cells[0], cells[-1])]
    if all(ends):
        return interval(over, ends[0][0], ends[1][1], closed=closed)
    return " to ".join(dict.fromkeys((cells[0]["place"], cells[-1]["place"])))


if __name__ == "__main__":
    page = ROOT / "README.md"
    results = json.loads((ROOT / "reports" / "reference" / "results.json").read_text(encoding="utf-8"))
    page.write_text(with_answers(page.read_text(encoding="utf-8"), results), encoding="utf-8")
