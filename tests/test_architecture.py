"""Who may lean on whom, read from the imports; and what numerics must not do."""

import ast
import dataclasses
import functools
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from validation.engine.sources import modules_behind
from validation.engine.street import HOUSES
from validation.report import contents
from validation.report.figures import drawing

ROOT = Path(__file__).parents[1]
PACKAGES = ("mdr", "bem3d", "validation")


def sources(package):
    """Examples are scripts of users: they import what they like."""
    return sorted(path for path in (ROOT / package).rglob("*.py") if "examples" not in path.relative_to(ROOT).parts)


@functools.cache
def nodes(source):
    return list(ast.walk(ast.parse(source.read_text(encoding="utf-8"))))


def imported(source):
    """Modules and names that a file imports, with their dots."""
    names = set()
    for node in nodes(source):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{source}: imports are absolute"
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def rooms(source):
    return {name.partition(".")[0] for name in imported(source)}


def table():
    """Who may import whom, as ARCHITECTURE.md has it."""
    found = {}
    for some, others in re.findall(r"^\| (`.*`) \| (.*) \|$", PAGE, flags=re.MULTILINE):
        listed = set(re.findall(r"`(\w+)`", others))
        if "what it may import" in others:
            listed = listed.union(*(found[other] for other in listed))
        found |= dict.fromkeys(re.findall(r"`(\w+)`", some), listed)
    return found


PAGE = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
MAY_IMPORT = table()
BESIDE = {"__main__", "case", "conformance", "pytest_plugin"}
ROOMS = set(MAY_IMPORT) - {"mdr", "bem3d", *BESIDE}
LINES_OF_A_FILE, LINES_OF_A_FUNCTION, SCENES_BY_CLASS = 600, 60, 15
FOLDERS = {"scenes", "problems", "theory", "models", "kinds", "solvers", "cases", "commands"}
"""That a house may have."""


def room_of(name):
    """Of a module by its dotted name: a method, a room of validation, or a file beside the rooms."""
    parts = name.split(".")
    return parts[0] if parts[0] != "validation" else parts[1] if len(parts) > 1 else ""


def modules_imported(source):
    """Names of the project's own that a file imports."""
    return {name for name in imported(source) if name.split(".")[0] in PACKAGES}


def name_of(source):
    return ".".join(source.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


def arrows():
    """Who imports whom, room by room, with the files."""
    return {
        (room_of(name_of(source)), room_of(name)): source
        for package in PACKAGES
        for source in sources(package)
        for name in modules_imported(source)
        if room_of(name_of(source)) != room_of(name)
    }


def test_imports_run_downward():
    found = arrows()
    assert {room for room, _ in found} - {""} == {room for room, others in MAY_IMPORT.items() if others}
    wrong = {arrow: str(source) for arrow, source in found.items() if arrow[1] not in MAY_IMPORT.get(arrow[0], set())}
    assert wrong == {}
    # no circle: a room comes after all that it may import
    order = list(MAY_IMPORT)
    assert all(order.index(other) < order.index(room) for room, others in MAY_IMPORT.items() for other in others)


def test_a_house_has_folders_of_known_kinds_and_says_what_it_brings():
    assert set(HOUSES) < ROOMS and list(HOUSES) == [room for room in MAY_IMPORT if room in HOUSES]
    for house in HOUSES:
        folder = ROOT / "validation" / house
        folders = {path.parent.name for path in folder.glob("*/*.py")}
        assert folders <= FOLDERS, house
        assert {path.stem for path in (folder / "commands").glob("*.py")} - {"__init__"} == set(
            import_module(f"validation.{house}").COMMANDS
        )


def test_validation_is_made_of_rooms():
    folders = {path.name for path in (ROOT / "validation").iterdir() if path.is_dir() and path.name != "__pycache__"}
    assert folders == {*ROOMS, "examples"}
    assert {path.stem for path in (ROOT / "validation").glob("*.py")} == {"__init__", *BESIDE}


def test_matplotlib_is_imported_only_where_figures_are_drawn():
    """At the top of a module; a method that draws imports it when it is called."""
    packages = ("mdr", "bem3d", "validation")
    places = {str(s.relative_to(ROOT)) for p in packages for s in sources(p) if imports_at_once(s, "matplotlib")}
    drawing = {place for place in places if not place.startswith("validation/report/")}
    assert all(re.fullmatch(r"validation/(advice|judging)/figure\w*\.py", place) for place in drawing), drawing
    line = "import sys, mdr, bem3d, validation; validation.Comparison, validation.Judgement; print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", line], capture_output=True, encoding="utf-8", check=True)
    assert "bem3d.contact" in run.stdout and "matplotlib" not in run.stdout


def imports_at_once(source, package):
    """Whether a file imports a package when it is imported itself, neither in a function nor for types alone."""
    tree = ast.parse(source.read_text(encoding="utf-8"))
    imports = [node for node in tree.body if isinstance(node, ast.Import | ast.ImportFrom)]
    names = [node.module or "" if isinstance(node, ast.ImportFrom) else node.names[0].name for node in imports]
    return any(name.partition(".")[0] == package for name in names)


def test_no_chapter_of_cases_imports_another():
    for source in (ROOT / "validation" / "cases").rglob("*.py"):
        chapter = source.relative_to(ROOT / "validation" / "cases").parts[0]
        chapters = {name.split(".")[2] for name in modules_imported(source) if name.startswith("validation.cases.")}
        assert chapters <= {chapter}, source


def solves_of(source):
    """Functions of a file that it passes to an engine itself."""
    functions = {node.name for node in nodes(source) if isinstance(node, ast.FunctionDef)}
    calls = [node for node in nodes(source) if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)]
    passed = {ast.unparse(call.args[0]) for call in calls if call.func.attr in {"map", "map_groups"} and call.args}
    return passed & functions


def test_no_stored_solve_rests_on_the_names_of_a_declared_case():
    """`validation.case` imports claims and charts, which are worded anew without a solve made stale."""
    solving = [name_of(source) for source in sources("validation") if solves_of(source)]
    assert {"validation.advice.cases.model_selection", "validation.benchmarks.work_precision.figure_cost"} <= {*solving}
    assert [name for name in solving if "validation.case" in modules_behind(name)] == []


def test_architecture_has_a_line_for_every_room():
    for room in ("mdr", "bem3d", *ROOMS):
        assert re.search(rf"^- \*\*`{room}/`\*\* \S", PAGE, re.MULTILINE), room


def test_the_line_of_a_subpackage_names_modules_that_it_has():
    lines = re.findall(r"^- \*\*`(\w+)/`\*\* (.*)$", PAGE, flags=re.MULTILINE)
    assert len(lines) >= 12
    for name, line in lines:
        package = ROOT / name if name in PACKAGES else ROOT / "validation" / name
        there = {path.stem for path in package.rglob("*") if path.suffix == ".py" or path.is_dir()}
        missing = {word for word in re.findall(r"`(?:\w+/)?([a-z]\w*)/?`", line) if word not in there}
        assert not missing, f"{name}/ has no module {', '.join(sorted(missing))}"


def test_a_file_is_one_subject_and_a_function_is_read_at_a_glance():
    longest = {str(source): source.read_text(encoding="utf-8").count("\n") for p in PACKAGES for source in sources(p)}
    assert {name: lines for name, lines in longest.items() if lines > LINES_OF_A_FILE} == {}
    functions = {
        f"{source}:{node.name}": node.end_lineno - node.lineno + 1
        for p in PACKAGES
        for source in sources(p)
        for node in nodes(source)
        if isinstance(node, ast.FunctionDef)
    }
    assert {name: lines for name, lines in functions.items() if lines > LINES_OF_A_FUNCTION} == {}


def test_a_scene_is_asked_what_it_has_not_what_it_is():
    """Its class is looked at where a command or an example takes one kind alone."""
    asked = [
        str(source)
        for source in sources("validation")
        for node in nodes(source)
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "isinstance"
        if re.search(r"Scene\b", ast.unparse(node.args[1]))
    ]
    assert len(asked) <= SCENES_BY_CLASS, asked


def class_names():
    for package in PACKAGES:
        for source in sources(package):
            for node in nodes(source):
                if isinstance(node, ast.ClassDef):
                    yield node.name.lstrip("_"), source.relative_to(ROOT)


def test_no_two_classes_share_a_name():
    places = {}
    for name, source in class_names():
        places.setdefault(name, []).append(str(source))
    assert {name: found for name, found in places.items() if len(found) > 1} == {}


def test_no_number_is_found_by_its_label():
    """A label is for people; the key of a number is its quantity, model and where."""
    parsed = re.compile(r"label\.(?:startswith|endswith|split|removeprefix|removesuffix)|in \w+\.label\b")
    assert [str(s) for p in PACKAGES for s in sources(p) if parsed.search(s.read_text(encoding="utf-8"))] == []


def test_every_case_has_its_figure():
    for name in {**contents.CASES, **contents.TIMED}:
        assert callable(drawing(name)), name


def test_every_part_of_a_figure_has_a_caption():
    """A function `draw_PART` of the file of a case draws the figure "CASE-PART", which a caption names."""
    said = "".join(
        source.read_text(encoding="utf-8")
        for room in ("cases", "benchmarks", "advice/cases", "railway/cases")
        for source in sources(f"validation/{room}")
    )
    for source in sources("validation/report/figures"):
        for function in re.findall(r"^def (draw\w*)", source.read_text(encoding="utf-8"), flags=re.MULTILINE):
            name = source.stem + function.removeprefix("draw").replace("_", "-", 1)
            assert source.stem == "__init__" or re.search(f'"{name}"[:,)]', said) or f'captions["{name}"]' in said, name


def test_numerics_neither_print_nor_write():
    for source in sources("mdr") + sources("bem3d"):
        calls = {
            node.func.id for node in nodes(source) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
        }
        assert not calls & {"print", "open"}, source
        assert not rooms(source) & {"pathlib", "logging"}, source
        assert "os" not in rooms(source) or source.name == "threads.py", source
        assert "warnings" not in rooms(source) or source.name == "diagnostics.py", source
        assert not re.search(r"\bstd(out|err)\b", source.read_text(encoding="utf-8")) or source.name == "progress.py", (
            source
        )


def named_paths():
    """What pyproject.toml, the Makefile and the mutation tests name."""
    project, made, mutation, verdicts = (
        (ROOT / name).read_text(encoding="utf-8")
        for name in ("pyproject.toml", "Makefile", "tests/mutation/runner.py", "tests/mutation/verdicts.coveragerc")
    )
    text = made + project + mutation + verdicts
    folders = " ".join(re.findall(r"^(?:METHODS|GUARDS) := (.*)", made, flags=re.MULTILINE)).split()
    return {*re.findall(r"(?<![\w/])(?:mdr|bem3d|validation|tests)/[\w*/]*(?:\*|\.py)", text), *folders}


@pytest.mark.parametrize("path", sorted(named_paths()))
def test_checks_name_files_that_are_there(path):
    """A check of a file that has moved finds nothing, and is green."""
    assert list(ROOT.glob(path)), path


def test_oracles_share_no_code_with_what_they_check():
    assert not rooms(ROOT / "tests" / "oracles.py") & set(PACKAGES)


@pytest.mark.parametrize(("other", "said"), [({}, "name of its own, got twice: hertz"), ({"name": "my"}, "place")])
def test_two_cases_of_one_name_or_place_are_refused(monkeypatch, other, said):
    monkeypatch.setattr("validation.cases.exact.geike.CASE", dataclasses.replace(contents.CASES["hertz"], **other))
    with pytest.raises(ValueError, match=said):
        contents._cases_in_order()
