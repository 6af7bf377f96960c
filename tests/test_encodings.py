"""What is read and written as text names its encoding: that of the system is another one elsewhere."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FOLDERS = ("mdr", "bem3d", "validation", "tests", ".ci", "reports/docs")
SOURCES = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]
PLACE_OF_ENCODING = {"read_text": 0, "write_text": 1, "loadtxt": None, "genfromtxt": None, "TextIOWrapper": 1}
"""Calls that are always of text, and where the encoding may stand without its name."""
OPENS = ("open", "fdopen", "NamedTemporaryFile", "TemporaryFile", "SpooledTemporaryFile")
OTHER_OPENS = ("os.open", "tarfile.open", "archive.open")
"""Of a descriptor and of archives: bytes."""


def lacks_its_encoding(call):
    name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    named = {keyword.arg: keyword.value for keyword in call.keywords}
    if "encoding" in named or ast.unparse(call.func) in OTHER_OPENS:
        return False
    if name in PLACE_OF_ENCODING:
        place = PLACE_OF_ENCODING[name]
        return place is None or len(call.args) <= place
    if name in OPENS:
        words = [node.value for node in [*call.args, *named.values()] if isinstance(node, ast.Constant)]
        binary = any(
            isinstance(word, str) and 1 < len(word) <= 3 and set(word) <= set("rwaxb+") and "b" in word
            for word in words
        )
        return not binary and not (name.endswith("TemporaryFile") and "mode" not in named and not call.args)
    texts = [named[option] for option in ("text", "universal_newlines") if option in named]
    return any(isinstance(text, ast.Constant) and text.value is True for text in texts)


def without_encoding(source):
    return [
        (node.lineno, ast.unparse(node))
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Call) and lacks_its_encoding(node)
    ]


def test_no_text_is_read_or_written_in_the_encoding_of_the_system():
    found = [
        f"{path.relative_to(ROOT)}:{line}: {call}"
        for path in SOURCES
        for line, call in without_encoding(path.read_bytes())
    ]
    assert found == []


@pytest.mark.parametrize(
    ("call", "lacks"),
    [
        ("path.read_text()", True),
        ('path.read_text(encoding="utf-8")', False),
        ('path.read_text("utf-8")', False),
        ("path.write_text(words)", True),
        ('path.write_text(words, "utf-8")', False),
        ('open("table.csv")', True),
        ('path.open("w")', True),
        ("path.open(mode)", True),
        ('path.open("rb")', False),
        ('path.open(mode="wb")', False),
        ('open("b")', True),
        ("os.open(path, flags)", False),
        ("run(words, text=True)", True),
        ('run(words, text=True, encoding="utf-8")', False),
        ("run(words)", False),
        ("TemporaryFile()", False),
        ('NamedTemporaryFile("w")', True),
        ('np.loadtxt(path, delimiter=",")', True),
    ],
)
def test_calls_that_lack_an_encoding_are_seen(call, lacks):
    assert bool(without_encoding(call)) == lacks
