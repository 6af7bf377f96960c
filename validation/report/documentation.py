"""Where the documentation of `make docs` is, seen from a report."""

from pathlib import Path

BUILT = "docs/_build/html/index.html"
"""Beside the report folders of a checkout."""


def documentation_beside(folder: Path) -> str:
    """Address of the documentation for the page of a report in this folder; empty where it is not built."""
    return f"../{BUILT}" if (folder.resolve().parent / BUILT).is_file() else ""
