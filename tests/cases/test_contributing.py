"""The case that CONTRIBUTING.md shows, as somebody would use it: as a file of the package, by the command."""

import re

import pytest

from tests.copies import ROOT, copied


@pytest.mark.slow
def test_the_case_of_contributing_is_run_drawn_and_shown(tmp_path):
    page = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    (example,) = (code for code in re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL) if "CASE = Case(" in code)
    run = copied(tmp_path)
    (tmp_path / "validation" / "cases" / "exact" / "parabola.py").write_text(example, encoding="utf-8")
    run("-m", "validation", "report", "--only", "parabola", "--out", "made")
    made = tmp_path / "made"
    pages = "".join(path.read_text(encoding="utf-8") for path in made.glob("*.html"))
    assert "Springs under a parabola carry the force of Hertz." in pages and "Springs agree with Hertz" in pages
    drawn = (made / "figures" / "parabola.svg").read_text(encoding="utf-8")
    assert "springs" in drawn and "force over that of Hertz" in drawn
