"""The source code that a result depends on, and the libraries under it."""

import ast
import hashlib
import importlib.metadata
import importlib.util
import sys
import threading
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass
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
    return _digest(_file_digest(path) for path in paths)


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
    behind, ahead = set[str](), {module}
    while ahead:
        name = ahead.pop()
        behind.add(name)
        if _imports_by_name(name):
            return frozenset(behind | set(modules())) - {ENGINE, *without}
        ahead |= _next(name, _source_path(name)) - behind - {ENGINE, *without}
    return frozenset(behind)


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


def _source_path(module: str) -> Path | None:
    """The source file of a module of the project, or of the user's own script; None for a library."""
    if module in modules():
        return modules()[module]
    loaded = getattr(sys.modules.get(module), "__file__", None)
    if loaded is None or "site-packages" in loaded or Path(loaded).is_relative_to(sys.base_prefix):
        return None
    return Path(loaded)


def _files_of(module: str) -> tuple[Path, ...]:
    """Its source, and the data beside it where it asks for its own place."""
    path = _source_path(module)
    return () if path is None else (path, *_data_beside(module, path))


@cache
def _data_beside(module: str, path: Path) -> tuple[Path, ...]:
    if "__file__" not in _code(path).words and "importlib.resources" not in _imported(module, path):
        return ()
    files = (file for file in path.parent.rglob("*") if file.is_file() and file.suffix not in (".py", ".pyc"))
    return tuple(sorted(files))


@cache
def _source(path: Path) -> bytes:
    return path.read_bytes()


@dataclass(frozen=True, eq=False)
class Code:
    """Of a file, by one pass over its tree, which is not kept.

    digest: of the tree without comments, and without docstrings, which are constants by themselves; words: all names
    and attributes; imports: level, module and names of each import statement; hooks: texts that `objects_of_houses`
    and `modules_in` are called with.
    """

    digest: bytes
    words: frozenset[str]
    imports: tuple[tuple[int, str, tuple[str, ...]], ...]
    hooks: frozenset[tuple[str, str]]


@cache
def _code(path: Path) -> Code:
    # Python 3.11 counts the depth of trees for all threads together
    with PARSING:
        tree = ast.parse(_source(path))
    words, hooks = set[str](), set[tuple[str, str]]()
    imports: list[tuple[int, str, tuple[str, ...]]] = []
    for node in ast.walk(tree):
        match node:
            case ast.Name(id=word) | ast.Attribute(attr=word):
                words.add(word)
            case ast.Import(names=names):
                imports += [(0, alias.name, ()) for alias in names]
            case ast.ImportFrom(module=module, names=names, level=level):
                imports.append((level, module or "", tuple(alias.name for alias in names)))
            case ast.Call(func=ast.Name(id=hook), args=[ast.Constant(value=str(text))]) if hook in (OBJECTS, FOLDERS):
                hooks.add((hook, text))
    digest = hashlib.sha256(ast.dump(_WithoutDocstrings().visit(tree)).encode()).digest()
    return Code(digest, frozenset(words), tuple(imports), frozenset(hooks))


class _WithoutDocstrings(ast.NodeTransformer):
    def visit_Expr(self, node: ast.Expr) -> ast.Expr | None:
        return None if isinstance(node.value, ast.Constant) else node


@cache
def _file_digest(path: Path) -> bytes:
    """The digest of a file: of code without comments and docstrings, of data all bytes."""
    return _code(path).digest if path.suffix == ".py" else hashlib.sha256(_source(path)).digest()


def _imports_by_name(module: str) -> bool:
    path = _source_path(module)
    if path is None or module == FACE:
        return False
    words = _code(path).words
    return FACE in _named(module, path) or (bool(words & BY_NAME) and LISTS not in words)


@cache
def _next(module: str, path: Path | None) -> frozenset[str]:
    """Modules of the project that it imports."""
    return _imported(module, path) & modules().keys()


@cache
def _imported(module: str, path: Path | None) -> frozenset[str]:
    """Names that may be modules, and the packages around them."""
    parts = [name.split(".") for name in _named(module, path) | {module}]
    return frozenset(".".join(part[:length]) for part in parts for length in range(1, len(part) + 1))


@cache
def _named(module: str, path: Path | None) -> frozenset[str]:
    """What its import statements name, the modules of packages that it lists, and those of houses."""
    if path is None:
        return frozenset()
    names = set[str]()
    for level, start, members in _code(path).imports:
        above = module.rsplit(".", level)[0] + "." if level else ""
        package = (above + start).rstrip(".")
        names |= {package, *(f"{package}.{member}" for member in members)}
    names |= _of_houses(path)
    if LISTS in _code(path).words:
        listed = names - {module.rpartition(".")[0]}
        names |= {name for name in modules() if name.rpartition(".")[0] in listed}
    return frozenset(names)


def _of_houses(path: Path) -> frozenset[str]:
    """Modules of the houses that `objects_of_houses` and `modules_in` find for it, by the texts that it gives them."""
    hooks = _code(path).hooks
    names = {place.partition(":")[0] for hook, use in hooks if hook == OBJECTS for place in places(use)}
    folders = {f"{ROOT}.{house}.{folder}" for hook, folder in hooks if hook == FOLDERS for house in houses()}
    return frozenset(names | {name for name in modules() if name.rpartition(".")[0] in folders})


# read when the code is loaded: an edit during a run does not make old results new
version_of_numerics()
