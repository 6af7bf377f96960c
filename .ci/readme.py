"""Write the table of answers of README.md from the results of the committed report: `python .ci/readme.py`."""

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from validation.analysis.evidence import Verdict
from validation.analysis.number_text import enumeration, half_open_text
from validation.analysis.ranges import verdict_ranges

ROOT = Path(__file__).resolve().parents[1]
TABLE = re.compile(r"(<!-- answers: .*? -->\n).*?(<!-- end of answers -->)", flags=re.DOTALL)
HEAD = "\n| question | MDR within tolerance? | as a function of | what else is accurate enough |\n|---|---|---|---|\n"
VERDICTS = ("within tolerance", "inconclusive", "outside tolerance")


def with_answers(text: str, results: Mapping[str, Any]) -> str:
    """The page with a row a question between its marks."""
    rows = "".join(f"| {' | '.join(cells(row))} |\n" for row in results["when_mdr_is_accurate_enough"])
    return TABLE.sub(lambda found: found[1] + HEAD + rows + "\n" + found[2], text)


def cells(row: Mapping[str, Any]) -> list[str]:
    """Neighbouring places with the same answer are one range; what a model costs is left to the report."""
    measured = [cell for cell in row["strip"] if cell["verdict"] in VERDICTS]
    verdicts, conditions = ([cell.get(name, "") for cell in measured] for name in ("verdict", "alone"))
    ranges = verdict_ranges(
        [cell["place"] for cell in measured], [Verdict(verdict) for verdict in verdicts], conditions
    )
    places: dict[str, list[str]] = {}
    for part in ranges:
        neighbours = part.items(measured)
        where = _range(neighbours, row["deciding_number"], closed=neighbours[-1] is measured[-1])
        places.setdefault(part.verdict, []).append(f"{where} ({part.split})" if part.split else where)
    where = "; ".join(f"{verdict}: {enumeration(places[verdict])}" for verdict in VERDICTS if verdict in places)
    instead = "; ".join(model["model"] for model in row["instead"])
    # one verdict throughout is said once
    answer = f"**{row['answer']}.** {where}"
    if list(places) == [row["answer"].lower()]:
        answer = f"**{row['answer']}**{where.removeprefix(row['answer'].lower())}"
    said = [row["question"], answer, row["deciding_number"], instead]
    return [text.replace("|", r"\|") for text in said]


def _range(cells: Sequence[Mapping[str, Any]], over: str, *, closed: bool) -> str:
    """Of ranges "0.01 ≤ Fbar < 0.1", the last of them closed; of points "0.024 to 0.73", "ridges to alpha = 0.25"."""
    ends = [cell.get("ends") for cell in (cells[0], cells[-1])]
    if all(ends):
        return half_open_text(over, ends[0][0], ends[1][1], closed=closed)
    return " to ".join(dict.fromkeys((cells[0]["place"], cells[-1]["place"])))


if __name__ == "__main__":
    page = ROOT / "README.md"
    results = json.loads((ROOT / "reports" / "reference" / "results.json").read_text(encoding="utf-8"))
    page.write_text(with_answers(page.read_text(encoding="utf-8"), results), encoding="utf-8")
