"""Settings of the documentation, which `make docs` builds."""

import inspect
import sys
from importlib.metadata import version as version_of
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE / "extensions"), str(HERE.parents[1])]

project = "mdr-validation"
author = "The authors of mdr-validation"
version = release = version_of("mdr-validation")

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "myst_parser",
    "gallery",
    "report_pages",
    "mathml",
]
exclude_patterns = ["_build"]
nitpicky = True
smartquotes = False
default_role = "autolink"

myst_enable_extensions = ["attrs_inline", "colon_fence", "dollarmath"]
myst_heading_anchors = 4
autosummary_generate = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
numpydoc_validation_checks = {
    "all",
    "ES01",  # an extended summary
    "EX01",  # an example of every member: the public names have one, by a test
    "GL01",  # a summary on a line of its own
    "GL08",  # a docstring of every member: the public names have one, by a test
    "PR01",  # parameters: those of the public names are described, by a test; dataclasses have attributes
    "PR04",  # a type: "as in `solve`" has none
    "PR08",  # a capital letter: a description may begin with a formula
    "RT01",  # Returns: a property has none
    "RT03",  # a description beside a type that says it
    "RT04",  # a capital letter
    "SA01",  # See Also
    "SS02",  # a capital letter
    "SS05",  # an infinitive: a summary may be a noun
    "SS06",  # a summary on one line
}
numpydoc_validation_exclude = {r"^validation\.(railway\.)?theory\."}

html_theme = "furo"
html_title = f"mdr-validation {release}"
html_static_path = ["_static"]
html_css_files = ["docs.css"]
html_show_sphinx = html_show_copyright = False
html_copy_source = False


def is_left_out(_app: Sphinx, what: str, name: str, member: Any, _skip: bool, _options: object) -> bool | None:
    """Constants of a module, and names of an earlier release."""
    defined = inspect.isclass(member) or inspect.isfunction(member)
    return True if what == "module" and not (defined and member.__name__ == name) else None


def setup(app: Sphinx) -> None:
    """Connect the choice of names."""
    app.connect("autodoc-skip-member", is_left_out)
