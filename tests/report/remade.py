"""The pages of the reference report, made anew from its results by the code that is there."""

import json
from functools import cache
from pathlib import Path

from validation.report import earlier_report, page
from validation.report.contents import TIMED

REFERENCE = Path(__file__).parents[2] / "reports" / "reference"


def sections():
    """Whatever code has made them: the pages alone are looked at."""
    files = [REFERENCE / "results.json", *(path for name in TIMED if (path := REFERENCE / f"{name}.json").exists())]
    cases = {
        name: case for file in files for name, case in json.loads(file.read_text(encoding="utf-8"))["cases"].items()
    }
    return [earlier_report._section(REFERENCE, name, case) for name, case in cases.items()]


@cache
def remade():
    """By their names."""
    about = earlier_report.kept_provenance(REFERENCE)
    about["timed"] = [name for name in TIMED if (REFERENCE / f"{name}.json").exists()]
    return {name: text.decode() for name, text in page.pages(sections(), "full", about, None).items()}
