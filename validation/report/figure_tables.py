"""Which tables a figure draws, read from the source of the function that draws it."""

import ast
import inspect
from collections.abc import Iterator
from types import ModuleType

from validation.report.figures import declared, drawing


def tables_of(name: str) -> tuple[str, ...]:
    """Names of the tables, in the order in which its functions ask for them. Raises ValueError for no figure."""
    if chart := declared(name):
        return chart.tables
    draw = drawing(name)
    module = inspect.getmodule(draw)
    assert module is not None  # found by its import
    functions = _functions(module)
    reached, names = [draw.__name__], dict[str, None]()
    for function in reached:
        for node in ast.walk(functions[function]):
            names |= dict.fromkeys(_asked(node))
            if isinstance(node, ast.Name) and node.id in functions and node.id not in reached:
                reached.append(node.id)
    return tuple(names)


def _functions(module: ModuleType) -> dict[str, ast.FunctionDef]:
    tree = ast.parse(inspect.getsource(module))
    return {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}


def _asked(node: ast.AST) -> Iterator[str]:
    """The name in `evidence.table("name")` and `evidence.has_table("name")`."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in ("table", "has_table"):
        yield from (word.value for word in node.args if isinstance(word, ast.Constant) and isinstance(word.value, str))
