"""Who may lean on whom, read from the imports; and what numerics must not do."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = ("mdr", "bem3d", "validation")


def sources(package):
    return sorted((ROOT / package).rglob("*.py"))


def imported(source):
    names = set()
    for node in ast.walk(ast.parse(source.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{source}: imports are absolute"
            names.add(node.module)
    return names


def rooms(source):
    return {name.partition(".")[0] for name in imported(source)}


@pytest.mark.parametrize(("package", "others"), [("mdr", {"bem3d", "validation"}), ("bem3d", {"mdr", "validation"})])
def test_methods_stand_alone(package, others):
    for source in sources(package):
        assert not rooms(source) & others, source


@pytest.mark.parametrize(
    "referee", ["closed_forms.py", "rolling_theory.py", "spectra.py", "wheel_theory.py", "records.py", "regions.py"]
)
def test_referees_import_neither_method(referee):
    assert not rooms(ROOT / "validation" / referee) & {"mdr", "bem3d", "validation"}


def test_matplotlib_is_imported_only_where_figures_are_drawn():
    places = {s.relative_to(ROOT).parts[:2] for p in PACKAGES for s in sources(p) if "matplotlib" in rooms(s)}
    assert places == {("validation", "report")}


def test_numerics_neither_print_nor_write():
    for source in sources("mdr") + sources("bem3d"):
        calls = {
            node.func.id
            for node in ast.walk(ast.parse(source.read_text()))
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
        }
        assert not calls & {"print", "open"}, source
        assert not rooms(source) & {"os", "pathlib", "logging"}, source
        assert "warnings" not in rooms(source) or source.name == "doubts.py", source


def named_paths():
    """What pyproject.toml, the Makefile and the mutation tests name."""
    project, made, mutation, verdicts = (
        (ROOT / name).read_text()
        for name in ("pyproject.toml", "Makefile", "tests/mutation.py", "tests/verdicts.coveragerc")
    )
    text = made + project + mutation + verdicts
    paths = re.findall(r"(?<![\w/])(?:mdr|bem3d|validation|tests)/[\w*/]*(?:\*|\.py)", text)
    tests = " ".join(re.findall(r"^(?:AT_WORK|GUARDS) := ((?:.*\\\n)*.*)", made, flags=re.MULTILINE))
    moved = re.search(r"VERDICTS = \((.*?)\)", mutation, flags=re.DOTALL)
    return {
        *paths,
        *(f"tests/test_{name}.py" for name in re.findall(r"\w+", tests)),
        *(f"validation/{name}.py" for name in re.findall(r"\w+", moved[1] if moved else "")),
    }


@pytest.mark.parametrize("path", sorted(named_paths()))
def test_checks_name_files_that_are_there(path):
    """A check of a file that has moved finds nothing, and is green."""
    assert list(ROOT.glob(path)), path


def test_oracles_share_no_code_with_what_they_check():
    assert not rooms(ROOT / "tests" / "oracles.py") & set(PACKAGES)


def test_architecture_names_every_file():
    text = (ROOT / "ARCHITECTURE.md").read_text()
    for package in PACKAGES:
        for source in sources(package):
            if source.name not in ("__init__.py", "__main__.py"):
                assert source.name in text, f"{source.relative_to(ROOT)} is missing in ARCHITECTURE.md"
