"""A label is text: worded anew, it changes what people read, and no file, no number and nothing that is looked up."""

import json

import pytest

from tests.copies import ROOT, copied

ANEW = {
    "validation/analysis/quantity.py": (
        'Quantity("mean_stiffness")',
        'Quantity("mean_stiffness", "average stiffness")',
    ),
    "validation/cases/exact/geike.py": (
        'Quantity("mean_square_height")',
        'Quantity("mean_square_height", "variance of the height")',
    ),
    "validation/judging/kinds/rolling.py": ('Quantity("force_level")', 'Quantity("force_level", "octave level")'),
}
"""Three definitions, each the only one."""
REFERENCES = """
from pathlib import Path
from validation.engine.engine import SERIAL
from validation.judging.kinds import from_report, references, rolling, stiffness

report = from_report.Report(Path({report!r}))
for quantity in (stiffness.MEAN, rolling.RMS, rolling.LEVEL):
    made = list(from_report.SOURCES[quantity].find(report, SERIAL))
    known = references.reference_rows(quantity)
    assert len(made) == len(known) > 0, quantity
    for one, other in zip(made, known):
        assert abs(one.value - other.value) <= 1e-6 * abs(one.value), quantity
print(stiffness.MEAN)
"""
MODEL = """
from validation import stiffness_model


@stiffness_model("in series")
def in_series(load, side, modulus, roughness):
    return 1 / (1 / (1.1523 * modulus * side) + 0.49 * roughness.rms / load)
"""


def read(folder):
    """Values of all numbers by the key of the case; names of the files of data."""
    cases = json.loads((folder / "results.json").read_text(encoding="utf-8"))["cases"]
    numbers = {name: [number["value"] for number in case["numbers"]] for name, case in cases.items()}
    return numbers, sorted(path.name for path in (folder / "data").iterdir())


@pytest.mark.slow
def test_labels_worded_anew_change_text_alone(tmp_path):
    """In a report, of `judge`, and where its references are found in a report from before."""
    run = copied(tmp_path)
    words = ["-m", "validation", "report", "--only", "geike", "--workers", "1", "--out"]
    run(*words, "as it is")
    for path, (before, after) in ANEW.items():
        code = (tmp_path / path).read_text(encoding="utf-8")
        assert code.count(before) == 1
        (tmp_path / path).write_text(code.replace(before, after), encoding="utf-8")
    run(*words, "worded anew")
    found, again = (read(tmp_path / folder) for folder in ("as it is", "worded anew"))
    assert found == again
    pages = "".join(page.read_text(encoding="utf-8") for page in (tmp_path / "worded anew").glob("*.html"))
    assert "variance of the height" in pages
    assert run("-c", REFERENCES.format(report=str(ROOT / "reports" / "reference"))).strip() == "average stiffness"
    (tmp_path / "model.py").write_text(MODEL, encoding="utf-8")
    assert "average stiffness" in run("-m", "validation", "judge", "model.py")
