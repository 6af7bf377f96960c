"""List the cases, from their sources: no case is imported, which takes seconds."""

import argparse
import ast
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from validation import benchmarks
from validation import cases as chapters
from validation.analysis.case import Chapter
from validation.report.commands.exit_status import Exit

START = "\nCASE = Case("


def describe(listing: argparse.ArgumentParser) -> None:
    listing.set_defaults(command=cases)


def cases(arguments: argparse.Namespace) -> Exit:
    for name, answers in answers_of_cases().items():
        print(f"{name:20s} {answers}")
    return Exit.MET


def answers_of_cases() -> dict[str, str]:
    """Name and answer of every case that is not timed, in the order of the page."""
    order = [chapter.name for chapter in Chapter]
    found = [words for words in _definitions() if not words.get("timed")]
    found.sort(key=lambda words: (order.index(words["chapter"]), words["place"]))
    return {words["name"]: words["answers"] for words in found}


def _definitions() -> Iterator[dict[str, Any]]:
    """The literal arguments of every `CASE = Case(...)`, and of its chapter the name."""
    for source in sorted(source for room in (chapters, benchmarks) for source in Path(room.__path__[0]).rglob("*.py")):
        text = source.read_text(encoding="utf-8")
        if START in text:
            definition = ast.parse(text[text.index(START) :]).body[0]
            assert isinstance(definition, ast.Assign) and isinstance(definition.value, ast.Call)  # as it begins
            yield {word.arg or "": _literal(word.value) for word in definition.value.keywords}


def _literal(node: ast.expr) -> Any:
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.value if isinstance(node, ast.Constant) else None
