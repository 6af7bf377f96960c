"""A page of the site for each page of the committed report: its body, under navigation and search of the site."""

import re
import shutil
from html import unescape
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.util.typing import ExtensionMetadata

REPORT = Path(__file__).parents[2] / "reference"
NAME = "report"
"""Of the folder in the site: links between pages, and to figures, data and sounds, are those of the report."""
PAGE = """# {title}

``````{{raw}} html
<style>.report {{ {style} }}</style>
<div class="report" id="top">
{body}
</div>
``````
"""
BELOW = """
```{{toctree}}
:hidden:

{names}
```
"""


def write(app: Sphinx) -> None:
    """A page of Markdown for each page; the front page has the others below it, in the order of its navigation."""
    folder = Path(app.srcdir) / NAME
    folder.mkdir(exist_ok=True)
    html = {path.stem: path.read_text(encoding="utf-8") for path in REPORT.glob("*.html")}
    for gone in {path.stem for path in folder.glob("*.md")} - set(html):
        (folder / f"{gone}.md").unlink()
    others = dict.fromkeys(name for name in re.findall(r'href="(\w+)\.html', html["index"]) if name != "index")
    for name, text in html.items():
        made = page(text) + (BELOW.format(names="\n".join(others)) if name == "index" else "")
        path = folder / f"{name}.md"
        # Sphinx reads again what is younger
        if not path.exists() or path.read_text(encoding="utf-8") != made:
            path.write_text(made, encoding="utf-8")


def point_at_pages(_app: Sphinx, name: str, source: list[str]) -> None:
    """A link to a page of the committed report becomes one to its page of the site."""
    if "/" not in name:
        source[0] = re.sub(r"\]\(\.\./reference/(\w+)\.html\)", rf"]({NAME}/\1.md)", source[0])


def page(html: str) -> str:
    """The first heading is the title; all else in the body, but the navigation, is taken as it is."""
    body = html.partition('<main id="top">')[2].partition("</body>")[0].replace("</main>", "")
    # what stands outside of the report is the documentation
    body = re.sub(r'href="\.\./[^"]*"', 'href="../index.html"', body)
    before, title, after = re.split(r"<h1[^>]*>(.*?)</h1>", body, maxsplit=1, flags=re.DOTALL)
    (style,) = re.findall(r"<style>(.*?)</style>", html, flags=re.DOTALL)
    # styles are nested in those of the body: they change nothing around it
    style = style.replace(":root", "&").replace("body {", "& {", 1)
    return PAGE.format(title=plain(title), style=style, body=before + after)


def headings(app: Sphinx, name: str, _template: str, context: dict[str, Any], _tree: object) -> None:
    """The contents beside a page of the report: its headings of the second level."""
    if name.startswith(f"{NAME}/"):
        text = (Path(app.srcdir) / f"{name}.md").read_text(encoding="utf-8")
        found = re.findall(r'<h2 id="([^"]+)"[^>]*>(.*?)</h2>', text, flags=re.DOTALL)
        entries = "".join(f'<li><a href="#{place}">{plain(heading)}</a></li>' for place, heading in found)
        context["toc"] = f'<ul><li><a href="#">{context["title"]}</a><ul>{entries}</ul></li></ul>'
        context["furo_hide_toc"] = not found  # the theme has looked for headings of Sphinx


def plain(heading: str) -> str:
    """Without tags."""
    return unescape(re.sub(r"<[^>]+>", "", heading)).strip()


def copy(app: Sphinx, error: Exception | None) -> None:
    """What the pages link to."""
    if error is None:
        left_out = shutil.ignore_patterns("*.html", "realisations")
        shutil.copytree(REPORT, Path(app.outdir) / NAME, ignore=left_out, dirs_exist_ok=True)


def setup(app: Sphinx) -> ExtensionMetadata:
    """Write the pages before Sphinx looks for them."""
    app.connect("builder-inited", write)
    app.connect("source-read", point_at_pages)
    app.connect("html-page-context", headings, priority=600)
    app.connect("build-finished", copy)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
