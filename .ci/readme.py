"""Write what pages quote, `python .ci/readme.py`: the answers of the committed report, and what commands print."""

import io
import json
import re
import shlex
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import chdir, redirect_stdout
from pathlib import Path
from typing import Any

from validation.__main__ import main
from validation.analysis.evidence import Verdict
from validation.analysis.number_text import enumeration, half_open_text
from validation.analysis.ranges import verdict_ranges

ROOT = Path(__file__).resolve().parents[1]
TABLE = re.compile(r"(<!-- answers: .*? -->\n).*?(<!-- end of answers -->)", flags=re.DOTALL)
HEAD = "\n| question | MDR within tolerance? | as a function of | what else is accurate enough |\n|---|---|---|---|\n"
VERDICTS = ("within tolerance", "inconclusive", "outside tolerance")
QUOTING = ("README.md", "reports/docs/start.md", "reports/docs/own_model.md")
"""Pages with the output of a command between marks, all of it or its first lines."""
OUTPUT = re.compile(
    r"(?P<head><!-- output of `mdr-validation (?P<words>[^`]+)`(?:, first (?P<lines>\d+) lines)?:[^\n]*-->\n```\n)"
    r"(?P<text>.*?)(?P<end>```\n<!-- end of output -->)",
    flags=re.DOTALL,
)
CODE = re.compile(r"```python\n(.*?)```", flags=re.DOTALL)
DURATION = re.compile(r"\d[\d.e+-]*\s?(?:µs|ms|s|min|h)\b")


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
    return [text.replace("|", r"\|").replace("Fbar", "F̄").replace("kbar", "k̄") for text in said]


def with_outputs(text: str) -> str:
    """The page with what its commands print now, in a folder with its first example as `my_model.py`."""

    def printed(quoted: re.Match[str]) -> str:
        lines = output_of(shlex.split(quoted["words"]), CODE.search(text)).splitlines()
        if quoted["lines"] and len(lines) > int(quoted["lines"]):
            lines = [*lines[: int(quoted["lines"])], "..."]
        now = "".join(f"{line}\n" for line in lines)
        # another duration is no other output
        now = quoted["text"] if timeless(now) == timeless(quoted["text"]) else now
        return quoted["head"] + now + quoted["end"]

    return OUTPUT.sub(printed, text)


def output_of(words: Sequence[str], code: re.Match[str] | None) -> str:
    """What a command prints, whatever the width of the terminal."""
    with tempfile.TemporaryDirectory() as folder, chdir(folder), redirect_stdout(io.StringIO()) as stream:
        if code:
            Path("my_model.py").write_text(code[1], encoding="utf-8")
        status = main(words)
    if status:
        raise RuntimeError(f"mdr-validation {shlex.join(words)} ended with status {status}")
    return stream.getvalue()


def timeless(text: str) -> list[str]:
    """Lines without durations and the widths of columns, which depend on the machine."""
    return [" ".join(DURATION.sub("TIME", line).split()) for line in text.splitlines()]


def _range(cells: Sequence[Mapping[str, Any]], over: str, *, closed: bool) -> str:
    """Of ranges "0.01 ≤ Fbar < 0.1", the last of them closed; of points "0.024 to 0.73", "ridges to alpha = 0.25"."""
    ends = [cell.get("ends") for cell in (cells[0], cells[-1])]
    if all(ends):
        return half_open_text(over, ends[0][0], ends[1][1], closed=closed)
    return " to ".join(dict.fromkeys((cells[0]["place"], cells[-1]["place"])))


if __name__ == "__main__":
    results = json.loads((ROOT / "reports" / "reference" / "results.json").read_text(encoding="utf-8"))
    for name in QUOTING:
        page = ROOT / name
        page.write_text(with_outputs(with_answers(page.read_text(encoding="utf-8"), results)), encoding="utf-8")
