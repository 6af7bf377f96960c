"""axe-core, which finds what keeps a page from being read, in a headless chromium."""

import html
import json
import re
import shutil
import subprocess
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path

PACKAGE = "axe_core_python"
BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
LACKING = [name for name, there in (("a chromium", BROWSER), (PACKAGE, find_spec(PACKAGE))) if not there]
RUN = """
document.querySelectorAll("details").forEach(details => { details.open = true; });
const show = found => {
  const shown = document.createElement("pre");
  shown.id = "found";
  shown.textContent = JSON.stringify(found);
  document.body.replaceChildren(shown);
};
axe.run(document, {resultTypes: ["violations"]}).then(
  result => show({
    passed: result.passes.map(rule => rule.id),
    violated: result.violations.map(rule => [rule.id, rule.nodes.slice(0, 3).map(node => node.html.slice(0, 150))]),
  }),
  error => show({failed: String(error)}),
);
"""
"""All is unfolded, as what is folded is not looked at; what was found takes the place of the page."""


def violations(page: str, folder: Path, width: int) -> dict[str, list[str]]:
    """Of a page in a window of this width [px]: by rule, the first elements that violate it."""
    assert not LACKING, f"axe needs {LACKING}"
    axe = files(PACKAGE).joinpath("axe.min.js").read_text(encoding="utf-8")
    before, after = page.rsplit("</body>", 1)
    copy = folder / f"{width}.html"
    copy.write_text(f"{before}<script>{axe}</script><script>{RUN}</script></body>{after}", encoding="utf-8")
    command = (BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=600000", "--dump-dom")
    done = subprocess.run(
        [*command, f"--window-size={width},2000", copy.as_uri()],
        capture_output=True,
        text=True,
        timeout=600,
        check=True,
    )
    shown = re.search(r'<pre id="found">(.*?)</pre>', done.stdout, re.DOTALL)
    assert shown, f"axe has not finished: {done.stderr[-1000:]}"
    found = json.loads(html.unescape(shown[1]))
    assert "document-title" in found.get("passed", ()), found
    return dict(found["violated"])
