"""The source code that a result depends on, and the libraries under it."""

import ast
import hashlib
import importlib.metadata
import importlib.util
import json
import sys
import threading
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from pathlib import Path

NUMERICS = ("mdr", "bem3d", "validation")
NOT_NUMERICS = "report"
"""The folder of a package that only draws and writes: its source changes no result."""
LIBRARIES = ("numpy", "scipy", "pyfftw")
BY_NAME = {"import_module", "__import__"}
"""Functions that import what no statement names."""
LISTS = "iter_modules"
"""What lists a package; a module that calls it imports by name from packages that its statements name."""
ENGINE = "validation.engine.engine"
"""It hands problems to their solves and keeps what they return: how it does so changes no result."""
PARSING = threading.Lock()
FACE = "validation"
"""Package that imports by name for its users: who imports it by itself may use anything."""
METHODS = ("mdr", "bem3d")
"""Packages whose first file only exports names of their modules."""
PRINTING, FORMATTING = {"__repr__", "__str__"}, "formatting"
"""Functions that only print, and the module of each method that they alone use."""


@cache
def version_of_numerics() -> str:
    """Digest of all source but that which only draws and writes, and of the libraries under it."""
    return _digest(b"".join(_source(path) for package in NUMERICS for path in sources_of(package)))


def version_of(modules: Iterable[str], without: Iterable[str] = ()) -> str:
    """Digest of what modules do, and of what they use of all that they import, directly or not.

    without: packages and modules that are left out, but where they are among the modules. Of a method that is imported
    as a whole the modules count whose names are used. Libraries, comments, docstrings and what only prints do not
    count. Raises RuntimeError where no source is found.
    """
    starts = tuple(f"{name}." for name in without)
    left_out = frozenset(name for name in _modules() if f"{name}.".startswith(starts))
    behind = {name for module in modules for name in modules_behind(module, left_out, by_names=True)}
    paths = [_modules()[name] for name in sorted(behind & set(_modules()))]
    if not paths:
        raise RuntimeError(f"the source of {', '.join(modules)} is not to be found")
    return hashlib.sha256(b"".join(_meaning(path) for path in paths)).hexdigest()


def version_behind(module: str, problem: object) -> str:
    """Digest of what may change the result of a solve that this module defines, and of the libraries.

    That is the code of the module, of the classes of the problem and its fields, and of all that these import, with
    the data files beside a module that asks for its own place. A module that imports by name may import anything; one
    that lists packages imports their modules. Comments and docstrings change no result.
    """
    classes = {type(value).__module__ for value in _values(problem)}
    return _of_modules(module, tuple(sorted(classes)))


def sources_of(package: str) -> list[Path]:
    """All files of a package whose code may change a result. Raises RuntimeError where it finds none."""
    found = importlib.util.find_spec(package)
    folders = [Path(folder) for folder in (found and found.submodule_search_locations) or ()]
    sources = [
        source
        for folder in folders
        for source in sorted(folder.rglob("*.py"))
        if NOT_NUMERICS not in source.relative_to(folder).parts
    ]
    if not sources:
        raise RuntimeError(f"the source of {package} is not to be found: stored results could be of any version of it")
    return sources


@cache
def modules_behind(module: str, without: frozenset[str] = frozenset(), *, by_names: bool = False) -> frozenset[str]:
    """The module itself and all of the numerics that it imports, directly or not, also inside of functions.

    The engine and the modules without are left out, and what these alone import. by_names: of a method that is
    imported as a whole, whether the modules count whose names are used, or all.
    """
    known, left_out = _modules(), {ENGINE, *without}
    found, left = set[str](), {module}
    while left:
        name = left.pop()
        found.add(name)
        if _imports_by_name(name):
            return frozenset((found | set(known)) - left_out)
        imported = _imported(name)
        if by_names:
            imported = (imported - {*METHODS, FACE}).union(*(_used_of(method, name) for method in METHODS))
        left |= (imported & set(known)) - found - left_out
    return frozenset(found)


@cache
def _of_modules(module: str, classes: tuple[str, ...]) -> str:
    behind = {name for root in (module, *classes) for name in modules_behind(root)}
    paths = sorted({path for name in behind for path in _files_of(name)})
    if not paths:
        raise RuntimeError(f"the source of {module} is not to be found: stored results could be of any version of it")
    return _digest(b"".join(_meaning(path) for path in paths))


def _digest(source: bytes) -> str:
    versions = json.dumps({name: importlib.metadata.version(name) for name in LIBRARIES}).encode()
    return hashlib.sha256(source + versions).hexdigest()


def _values(problem: object) -> Iterator[object]:
    """The problem and all that it is made of."""
    yield problem
    if is_dataclass(problem) and not isinstance(problem, type):
        parts = [getattr(problem, field.name) for field in fields(problem)]
    elif isinstance(problem, Mapping):
        parts = [*problem.keys(), *problem.values()]
    elif isinstance(problem, tuple | list | set | frozenset):
        parts = list(problem)
    else:
        return
    for part in parts:
        yield from _values(part)


@cache
def _modules() -> dict[str, Path]:
    """The files of the numerics by the names of their modules."""
    return {
        ".".join([package, *path.relative_to(root).with_suffix("").parts]).removesuffix(".__init__"): path
        for package in NUMERICS
        for root in [_root(package)]
        for path in sources_of(package)
    }


@cache
def _packages() -> frozenset[str]:
    """Those that the numerics are made of."""
    return frozenset(name for name, path in _modules().items() if path.name == "__init__.py")


def _root(package: str) -> Path:
    """The folder of a package, which has its first file."""
    return min(sources_of(package), key=lambda path: len(path.parts)).parent


def _files_of(module: str) -> list[Path]:
    """Its source, and the data beside it where it asks for its own place. Nothing for a library's module."""
    path = _path(module)
    if path is None:
        return []
    if "__file__" not in _names(path) and "importlib.resources" not in _imported(module):
        return [path]
    data = (file for file in path.parent.rglob("*") if file.is_file() and file.suffix not in (".py", ".pyc"))
    return [path, *sorted(data)]


def _path(module: str) -> Path | None:
    """Of the numerics, or of the user's own script."""
    if module in _modules():
        return _modules()[module]
    loaded = getattr(sys.modules.get(module), "__file__", None)
    if loaded is None or "site-packages" in loaded or Path(loaded).is_relative_to(sys.base_prefix):
        return None
    return Path(loaded)


@cache
def _source(path: Path) -> bytes:
    return path.read_bytes()


@cache
def _meaning(path: Path) -> bytes:
    """Of code: without its comments and docstrings. Of data: the file."""
    if path.suffix != ".py":
        return _source(path)
    tree = _parsed(path)
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            # a constant by itself does nothing
            node.value = ast.Constant(None)
        if isinstance(node, ast.ClassDef):
            node.body = [part for part in node.body if getattr(part, "name", "") not in PRINTING]
    tree.body = [part for part in tree.body if not _is_for_printing(part)]
    return ast.dump(tree).encode()


def _is_for_printing(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.ImportFrom) and (statement.module or "") in {f"{m}.{FORMATTING}" for m in METHODS}


@cache
def _names(path: Path) -> frozenset[str]:
    """All names and attributes that its code uses."""
    tree = _tree(path)
    return frozenset(
        [node.id for node in ast.walk(tree) if isinstance(node, ast.Name)]
        + [node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)]
    )


@cache
def _tree(path: Path) -> ast.Module:
    return _parsed(path)


def _parsed(path: Path) -> ast.Module:
    # Python 3.11 counts the depth of trees for all threads together
    with PARSING:
        return ast.parse(_source(path))


def _imports_by_name(module: str) -> bool:
    path = _path(module)
    if path is None or module == FACE:
        return False
    return FACE in _named(module) or (bool(_names(path) & BY_NAME) and LISTS not in _names(path))


def _imported(module: str) -> set[str]:
    """Names that may be modules, and the packages around them."""
    parts = [name.split(".") for name in _named(module) | {module}]
    return {".".join(part[:length]) for part in parts for length in range(1, len(part) + 1)}


def _named(module: str) -> set[str]:
    """What its import statements name, and the modules of packages that it lists."""
    path = _path(module)
    if path is None:
        return set()
    package = module if path.name == "__init__.py" else module.rpartition(".")[0]
    found = set[str]()
    for node in ast.walk(_tree(path)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = package.rsplit(".", node.level - 1)[0] + "." if node.level else ""
            start = (above + (node.module or "")).rstrip(".")
            found |= {start, *(f"{start}.{alias.name}" for alias in node.names)}
    if LISTS in _names(path):
        found |= {name for name in _modules() if name.rpartition(".")[0] in found & _packages() - {package}}
    return found


def _used_of(method: str, module: str) -> set[str]:
    """The modules of a method whose names a module takes from it; all where it takes it whole, or names not found."""
    path = _path(module)
    if path is None or module == method:
        return set()
    nodes = list(ast.walk(_tree(path)))
    names = [node.attr for node in nodes if isinstance(node, ast.Attribute) and _is_named(node.value, method)]
    whole = sum(_is_named(node, method) for node in nodes) > len(names)
    for node in nodes:
        if isinstance(node, ast.Import):
            whole |= any(alias.name == method and alias.asname for alias in node.names)
        if isinstance(node, ast.ImportFrom) and node.module == method:
            names += [alias.name for alias in node.names]
    exported = _exported(method)
    return set(exported.values()) if whole or not set(names) <= set(exported) else {exported[name] for name in names}


def _is_named(node: ast.AST, name: str) -> bool:
    return isinstance(node, ast.Name) and node.id == name


@cache
def _exported(method: str) -> dict[str, str]:
    """The modules of the names that a method exports."""
    return {
        alias.name: node.module
        for node in ast.walk(_tree(_modules()[method]))
        if isinstance(node, ast.ImportFrom) and (node.module or "") in _modules() and node.module
        for alias in node.names
    }


# read when the code is loaded: an edit during a run does not make old results new
version_of_numerics()
