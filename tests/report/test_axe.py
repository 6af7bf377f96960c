"""The pages of a report pass axe-core, in windows wide and narrow; `make accessibility` installs what it needs."""

import html
import json
import re
import shutil
import subprocess
from dataclasses import replace
from importlib.resources import files
from importlib.util import find_spec

import pytest

from tests.report.remade import remade
from tests.report.test_page import MATRIX, section_of
from tests.report.test_printed import ABOUT
from validation.report import page

PACKAGE = "axe_core_python"
BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
LACKING = [name for name, there in (("a chromium", BROWSER), (PACKAGE, find_spec(PACKAGE))) if not there]
RUN = """
const audit = async (name, page) => {
  const frame = document.createElement("iframe");
  frame.style = "border: 0; width: 100vw; height: 100vh";
  frame.srcdoc = page;
  const loaded = new Promise(resolve => { frame.onload = resolve; });
  document.body.replaceChildren(frame);
  await loaded;
  const inside = frame.contentDocument;
  inside.querySelectorAll("details").forEach(details => { details.open = true; });
  const result = await frame.contentWindow.axe.run(inside, {resultTypes: ["violations"]});
  return {
    passed: result.passes.map(rule => rule.id),
    violated: result.violations.map(rule => [rule.id, rule.nodes.slice(0, 3).map(node => node.html.slice(0, 150))]),
  };
};
const auditAll = async () => {
  const found = {};
  for (const [name, page] of Object.entries(PAGES)) {
    found[name] = await audit(name, page).catch(error => ({failed: String(error)}));
  }
  const shown = document.createElement("pre");
  shown.id = "found";
  shown.textContent = JSON.stringify(found);
  document.body.replaceChildren(shown);
};
auditAll();
"""
"""All is unfolded, as what is folded is not looked at; what was found takes the place of the pages, which are looked at
one by one in a window of one browser: it takes longer to start than to look."""

pytestmark = [pytest.mark.slow, pytest.mark.skipif(bool(LACKING), reason=f"not there: {', '.join(LACKING)}")]
WIDE, NARROW = 1300, 400
FAULTS = {
    "color-contrast": ("--soft: #5a5a5a", "--soft: #9a9a9a"),
    "image-alt": (' alt="', ' data-alt="'),
    "html-has-lang": (' lang="en"', ""),
    "aria-roles": ('role="region"', 'role="area"'),
}


def violations(pages: dict[str, str], folder, width: int) -> dict[str, dict[str, list[str]]]:
    """Of pages in a window of this width [px]: by page and rule, the first elements that violate it."""
    assert not LACKING, f"axe needs {LACKING}"
    axe = files(PACKAGE).joinpath("axe.min.js").read_text(encoding="utf-8")
    with_axe = {name: f"<script>{axe}</script></body>".join(page.rsplit("</body>", 1)) for name, page in pages.items()}
    told = json.dumps(with_axe).replace("</", "<\\/")
    copy = folder / f"{width}.html"
    script = f"<script>const PAGES = {told};{RUN}</script>"
    copy.write_text(f'<!doctype html><meta charset="utf-8"><body style="margin: 0">{script}</body>', encoding="utf-8")
    command = (BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=600000", "--dump-dom")
    done = subprocess.run(
        [*command, f"--window-size={width},2000", copy.as_uri()],
        capture_output=True,
        encoding="utf-8",
        timeout=600,
        check=True,
    )
    shown = re.search(r'<pre id="found">(.*?)</pre>', done.stdout, re.DOTALL)
    assert shown, f"axe has not finished: {done.stderr[-1000:]}"
    found = json.loads(html.unescape(shown[1]))
    assert found.keys() == pages.keys()
    for each in found.values():
        assert "document-title" in each.get("passed", ()), each
    return {name: dict(each["violated"]) for name, each in found.items()}


def titled(name, **changes):
    """Its title and its table have names that no other case has."""
    return section_of(name, title=name, page_tables=[replace(MATRIX, name=f"Deviation of {name}")], **changes)


def whole():
    """With numbers, tables, figures, a criterion that is missed, and a figure of the front page."""
    models = replace(titled("rolling").evidence, captions={"rolling": "How far models carry."})
    sections = [titled("geike"), titled("hertz", criterion=9.0), replace(titled("rolling"), evidence=models)]
    return {name: text.decode() for name, text in page.pages(sections, "full", ABOUT, None).items()}


@pytest.mark.parametrize("width", [WIDE, NARROW])
def test_no_rule_is_violated(tmp_path, width):
    pages = whole()
    assert violations(pages, tmp_path, width) == {name: {} for name in pages}


@pytest.mark.parametrize("part", [0, 1])
def test_no_rule_is_violated_by_the_reference_report(tmp_path, part):
    """In a narrow window, where more scrolls; half of the pages on each of two cores."""
    found = violations(dict(list(remade().items())[part::2]), tmp_path, NARROW)
    assert found and not any(found.values()), found


def test_what_violates_rules_is_found(tmp_path):
    wrong = "".join(whole().values())
    for right, planted in (*FAULTS.values(), ('href="#figure-rolling-large"', "")):
        assert right in wrong
        wrong = wrong.replace(right, planted)
    found = violations({"wrong": wrong}, tmp_path, NARROW)["wrong"]
    assert {*FAULTS, "scrollable-region-focusable"} <= set(found)
