"""Write the table of answers of README.md from the results of the committed report: `python .ci/readme.py`."""

import json
import re
from collections.abc import Mapping
from itertools import groupby
from pathlib import Path
from typing import Any

from validation.analysis.claims import listed

ROOT = Path(__file__).resolve().parents[1]
TABLE = re.compile(r"(<!-- answers: .*? -->\n).*?(<!-- end of answers -->)", flags=re.DOTALL)
HEAD = "\n| question | is MDR enough? | over | what else is enough |\n|---|---|---|---|\n"


def with_answers(text: str, results: Mapping[str, Any]) -> str:
    """The page with a row a question between its marks."""
    rows = "".join(f"| {' | '.join(cells(row))} |\n" for row in results["when MDR is enough"])
    return TABLE.sub(lambda found: found[1] + HEAD + rows + "\n" + found[2], text)


def cells(row: Mapping[str, Any]) -> list[str]:
    """Neighbouring places with the same answer are one range; what a model costs is left to the report."""
    places: dict[str, list[str]] = {}
    for word, some in groupby(row["strip"], key=lambda cell: cell["enough"]):
        ends = [end for cell in some for end in cell["place"].split(" to ")]
        places.setdefault(word, []).append(" to ".join(dict.fromkeys((ends[0], ends[-1]))))
    measured = [word for word in ("yes", "open", "no") if word in places]
    where = "; ".join(f"{f'{word}: ' if measured[1:] else ''}{listed(places[word])}" for word in measured)
    instead = "; ".join(model["model"] for model in row["instead"])
    said = [row["question"], f"**{row['answer']}.** {where}", row["number that decides"], instead]
    return [text.replace("|", r"\|") for text in said]


if __name__ == "__main__":
    page = ROOT / "README.md"
    results = json.loads((ROOT / "reports" / "reference" / "results.json").read_text(encoding="utf-8"))
    page.write_text(with_answers(page.read_text(encoding="utf-8"), results), encoding="utf-8")
