"""What each case answers, read from the sources: a list of the cases without their imports, which take seconds."""

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from validation import benchmarks, cases
from validation.analysis.case import Chapter

START = "\nCASE = Case("


def answers_of_cases() -> dict[str, str]:
    """Name and answer of every case that is not timed, in the order of the page."""
    chapters = [chapter.name for chapter in Chapter]
    found = [words for words in _definitions() if not words.get("timed")]
    found.sort(key=lambda words: (chapters.index(words["chapter"]), words["place"]))
    return {words["name"]: words["answers"] for words in found}


def _definitions() -> Iterator[dict[str, Any]]:
    """The literal arguments of every `CASE = Case(...)`, and of its chapter the name."""
    for room in (cases, benchmarks):
        for source in sorted(Path(room.__path__[0]).rglob("*.py")):
            text = source.read_text(encoding="utf-8")
            if START in text:
                definition = ast.parse(text[text.index(START) :]).body[0]
                assert isinstance(definition, ast.Assign) and isinstance(definition.value, ast.Call)  # as it begins
                yield {word.arg or "": _literal(word.value) for word in definition.value.keywords}


def _literal(node: ast.expr) -> Any:
    if isinstance(node, ast.Attribute):
        return node.attr
    return ast.literal_eval(node) if isinstance(node, ast.Constant) else None
