"""The source code that a result depends on, and the libraries under it."""

import ast
import hashlib
import importlib.metadata
import importlib.util
import sys
import threading
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from pathlib import Path

from validation.engine.street import ROOT, houses, places

PACKAGES = ("mdr", "bem3d", "validation")
LIBRARIES = ("numpy", "scipy", "pyfftw")
NO_NUMERICS = "report"
"""The folder of a package that only draws and writes: its source changes no result."""
ENGINE = "validation.engine.engine"
"""It hands problems to their solves and keeps what they return: how it does so changes no result."""
FACE = "validation"
"""Imports by name for its users: who imports it may use anything."""
BY_NAME, LISTS = {"import_module", "__import__"}, "iter_modules"
"""Functions that import what no statement names; what lists the packages that its statements name."""
OBJECTS, FOLDERS = "objects_of_houses", "modules_in"
"""Functions of the street that import what houses bring."""
PARSING = threading.Lock()


@cache
def version_of_numerics() -> str:
    """Digest of all source but that which only draws and writes, and of the libraries under it."""
    return _digest(_source(path) for path in sorted(modules().values()))


@cache
def version_of(roots: tuple[str, ...], without: tuple[str, ...] = ()) -> str:
    """Digest of these modules and of all that they import, directly or not, but for comments and docstrings.

    without: packages and modules that are left out. Raises RuntimeError where no source is found.
    """
    starts = tuple(f"{name}." for name in without)
    left_out = frozenset(name for name in modules() if f"{name}.".startswith(starts))
    behind = {name for root in roots for name in modules_behind(root, left_out)}
    paths = sorted({path for name in behind for path in _files_of(name)})
    if not paths:
        raise RuntimeError(f"the source of {roots[0]} is not to be found")
    return _digest(_meaning(path) for path in paths)


def version_behind(module: str, problem: object) -> str:
    """Digest of what may change the result of a solve that this module defines, and of the libraries.

    That is the code of the module and of the classes of the problem and its parts, and of all that these import.
    Raises RuntimeError where no source is found.
    """
    return version_of((module, *sorted({type(value).__module__ for value in _values(problem)})))


@cache
def modules() -> dict[str, Path]:
    """The files of the project whose code may change a result, by the names of their modules.

    Raises RuntimeError for a package without source.
    """
    found = {package: importlib.util.find_spec(package) for package in PACKAGES}
    roots = {name: Path(spec.origin).parent for name, spec in found.items() if spec and spec.origin}
    if missing := set(PACKAGES) - set(roots):
        raise RuntimeError(f"the source of {missing} is not to be found: stored results could be of any version of it")
    return {
        ".".join([package, *path.relative_to(root).with_suffix("").parts]).removesuffix(".__init__"): path
        for package, root in roots.items()
        for path in sorted(root.rglob("*.py"))
        if NO_NUMERICS not in path.relative_to(root).parts
    }


@cache
def modules_behind(module: str, without: frozenset[str] = frozenset()) -> frozenset[str]:
    """The module itself and all of the project that it imports, directly or not, also inside of functions.

    All of it where a module imports by name. The engine and the modules without are left out, and what these import.
    """
    found, left = set[str](), {module}
    while left:
        name = left.pop()
        found.add(name)
        if _imports_by_name(name):
            return frozenset(found | set(modules())) - {ENGINE, *without}
        left |= (_imported(name) & set(modules())) - found - {ENGINE, *without}
    return frozenset(found)


def _digest(sources: Iterable[bytes]) -> str:
    versions = [f"{name} {importlib.metadata.version(name)}".encode() for name in LIBRARIES]
    return hashlib.sha256(b"".join([*sources, *versions])).hexdigest()


def _values(problem: object) -> Iterator[object]:
    """The problem and all that it is made of."""
    yield problem
    if is_dataclass(problem) and not isinstance(problem, type):
        parts = [getattr(problem, field.name) for field in fields(problem)]
    elif isinstance(problem, Mapping):
        parts = [*problem.keys(), *problem.values()]
    else:
        parts = list(problem) if isinstance(problem, tuple | list | set | frozenset) else []
    for part in parts:
        yield from _values(part)


def _path(module: str) -> Path | None:
    """Of the project, or of the user's own script; None for a library."""
    if module in modules():
        return modules()[module]
    loaded = getattr(sys.modules.get(module), "__file__", None)
    if loaded is None or "site-packages" in loaded or Path(loaded).is_relative_to(sys.base_prefix):
        return None
    return Path(loaded)


def _files_of(module: str) -> list[Path]:
    """Its source, and the data beside it where it asks for its own place."""
    path = _path(module)
    if path is None:
        return []
    asks = "__file__" in _words(path) or "importlib.resources" in _imported(module)
    data = (file for file in path.parent.rglob("*") if file.is_file() and file.suffix not in (".py", ".pyc"))
    return [path, *sorted(data if asks else ())]


@cache
def _source(path: Path) -> bytes:
    return path.read_bytes()


@cache
def _tree(path: Path) -> ast.Module:
    # Python 3.11 counts the depth of trees for all threads together
    with PARSING:
        return ast.parse(_source(path))


@cache
def _meaning(path: Path) -> bytes:
    """Of code: without its comments and docstrings, which are constants by themselves. Of data: the file."""
    if path.suffix != ".py":
        return _source(path)
    # another tree, which is changed; a copy of the first takes ten times as long
    with PARSING:
        tree = ast.parse(_source(path))
    return ast.dump(_WithoutDocstrings().visit(tree)).encode()


class _WithoutDocstrings(ast.NodeTransformer):
    def visit_Expr(self, node: ast.Expr) -> ast.Expr | None:
        return None if isinstance(node.value, ast.Constant) else node


@cache
def _words(path: Path) -> frozenset[str]:
    """All names and attributes that its code uses."""
    nodes = list(ast.walk(_tree(path)))
    names = {node.id for node in nodes if isinstance(node, ast.Name)}
    return frozenset(names | {node.attr for node in nodes if isinstance(node, ast.Attribute)})


def _imports_by_name(module: str) -> bool:
    path = _path(module)
    if path is None or module == FACE:
        return False
    return FACE in _named(module) or (bool(_words(path) & BY_NAME) and LISTS not in _words(path))


def _imported(module: str) -> set[str]:
    """Names that may be modules, and the packages around them."""
    parts = [name.split(".") for name in _named(module) | {module}]
    return {".".join(part[:length]) for part in parts for length in range(1, len(part) + 1)}


def _named(module: str) -> frozenset[str]:
    """What its import statements name, and the modules of packages that it lists."""
    return _named_in(module, _path(module))


@cache
def _named_in(module: str, path: Path | None) -> frozenset[str]:
    found = set[str]()
    for node in ast.walk(_tree(path)) if path else ():
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = module.rsplit(".", node.level)[0] + "." if node.level else ""
            start = (above + (node.module or "")).rstrip(".")
            found |= {start, *(f"{start}.{alias.name}" for alias in node.names)}
    found |= _of_houses(path)
    if path and LISTS in _words(path):
        listed = found - {module.rpartition(".")[0]}
        found |= {name for name in modules() if name.rpartition(".")[0] in listed}
    return frozenset(found)


@cache
def _of_houses(path: Path | None) -> frozenset[str]:
    """Modules of the houses that `objects_of_houses` and `modules_in` find for it, by the texts that it gives them."""
    uses: dict[str, set[str]] = {OBJECTS: set(), FOLDERS: set()}
    for node in ast.walk(_tree(path)) if path else ():
        match node:
            case ast.Call(func=ast.Name(id=name), args=[ast.Constant(value=str(text))]) if name in uses:
                uses[name].add(text)
    found = {place.partition(":")[0] for use in uses[OBJECTS] for place in places(use)}
    folders = {f"{ROOT}.{house}.{folder}" for folder in uses[FOLDERS] for house in houses()}
    return frozenset(found | {name for name in modules() if name.rpartition(".")[0] in folders})


# read when the code is loaded: an edit during a run does not make old results new
version_of_numerics()
