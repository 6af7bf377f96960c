"""A page for each script of `validation/examples`, with what it prints and the picture that it draws."""

import ast
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.typing import ExtensionMetadata

ROOT = Path(__file__).parents[3]
EXAMPLES = ROOT / "validation" / "examples"
LONGEST = ("rolling_spectrum", "large_face", "own_draws")
"""They are started first: a core that waits for one of them has nothing else to do."""
PAGE = """# {title}

{purpose}

![The picture that {name}.py draws]({name}.png){{.example}}

```{{literalinclude}} {script}
:language: python
:lines: {lines}
```

It prints

```{{literalinclude}} {name}.txt
:language: text
```
"""
FIGURE = """:::{{figure}} {name}.png
:target: {name}.html
:alt: The picture that {name}.py draws

{{doc}}`{name}`
:::
"""
INDEX = """# Examples

Each is a script to copy: it runs as it stands, asserts its result and draws its picture. All lie in
`validation/examples/`, in the installed package, too.

::::{{container}} gallery

{figures}
::::

```{{toctree}}
:hidden:

{entries}
```
"""


def build(app: Sphinx) -> None:
    """Run each script whose picture is older than the code, and write the pages."""
    folder = Path(app.srcdir) / "examples"
    folder.mkdir(exist_ok=True)
    scripts = sorted(EXAMPLES.glob("*.py"))
    newest = max(path.stat().st_mtime for path in _sources())
    late = [script for script in scripts if not _is_younger(folder / f"{script.stem}.png", newest)]
    late.sort(key=lambda script: script.stem not in LONGEST)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(lambda script: run(script, folder), late))
    for script in scripts:
        _write(folder / f"{script.stem}.md", page(script, folder))
    _write(folder / "index.md", index([script.stem for script in scripts]))


def run(script: Path, folder: Path) -> None:
    """Run a script in a folder of its own, and keep what it prints and its picture."""
    paths = os.pathsep.join([str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])])
    with TemporaryDirectory() as place:
        done = subprocess.run(
            [sys.executable, str(script)],
            cwd=place,
            env={**os.environ, "PYTHONPATH": paths, "OMP_NUM_THREADS": "1"},
            capture_output=True,
            encoding="utf-8",
            check=False,
        )
        if done.returncode:
            raise ExtensionError(f"{script.name} ended with status {done.returncode}:\n{done.stderr}")
        (folder / f"{script.stem}.txt").write_text(done.stdout, encoding="utf-8")
        shutil.copyfile(Path(place) / f"{script.stem}.png", folder / f"{script.stem}.png")


def page(script: Path, folder: Path) -> str:
    """Its docstring up to the colon is the title, all of it is the first paragraph."""
    tree = ast.parse(script.read_text(encoding="utf-8"))
    purpose = ast.get_docstring(tree)
    if not purpose:
        raise ExtensionError(f"{script.name} must begin with a docstring")
    return PAGE.format(
        title=purpose.partition(":")[0],
        purpose=purpose,
        name=script.stem,
        script=os.path.relpath(script, folder),
        lines=f"{tree.body[1].lineno}-",
    )


def index(names: list[str]) -> str:
    """All pictures, each a link to its page."""
    return INDEX.format(figures="\n".join(FIGURE.format(name=name) for name in names), entries="\n".join(names))


def point_at_pages(_app: Sphinx, _name: str, source: list[str]) -> None:
    """A link to a script, which a checkout has, becomes one to its page, which the site has."""
    source[0] = re.sub(r"\]\(\.\./\.\./validation/examples/(\w+)\.py\)", r"](examples/\1.md)", source[0])
    source[0] = source[0].replace("](../../validation/examples)", "](examples/index.md)")


def _sources() -> list[Path]:
    """All that a script may read."""
    found = [path for package in ("mdr", "bem3d", "validation") for path in (ROOT / package).rglob("*.*")]
    return [path for path in found if path.suffix != ".pyc" and path.is_file()]


def _is_younger(picture: Path, newest: float) -> bool:
    return picture.exists() and picture.stat().st_mtime > newest


def _write(path: Path, text: str) -> None:
    """Leave a page alone that is up to date: Sphinx reads again what is younger."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def setup(app: Sphinx) -> ExtensionMetadata:
    """Build the pages before Sphinx looks for them."""
    app.connect("builder-inited", build)
    app.connect("source-read", point_at_pages)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
