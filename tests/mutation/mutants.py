"""Mutants: a module with one small change, made by rule. What mutation testing plants, one at a time.

Left as they are: annotations, decorators, imports, strings.
"""

import ast
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain, islice, takewhile

Swap = tuple[object, str | int, object]
"""Where a change is made: a node or a list of nodes, a name or an index in it, and what stands there instead."""

OPERATORS: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.Mult,
    ast.Pow: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
}
COMPARISONS: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
}
PAIRS = (("min", "max"), ("minimum", "maximum"), ("any", "all"), ("sin", "cos"))
NAMES = {one: other for pair in PAIRS for one, other in (pair, pair[::-1])}
CONTEXT = 24
"""Letters before and after a change that are shown with it."""


@dataclass(frozen=True)
class Mutant:
    """One change: which of its file, in which function and lines, from what to what.

    lines: of the statement it stands in; of the whole function for a default value of an argument; name: of the
    constant that it changes at import, if any.
    """

    path: str
    number: int
    scope: str
    lines: range
    name: str
    change: str

    @property
    def key(self) -> str:
        """What it is called in the list of survivors."""
        return f"{self.scope}: {self.change}"


def mutants_of(path: str, source: str) -> list[Mutant]:
    """All mutants of a module."""
    return [
        Mutant(path, number, scope, _lines(statement), "" if scope else _constant(statement), change)
        for number, (scope, statement, change, _) in enumerate(_planted(ast.parse(source)))
    ]


def mutated(mutant: Mutant, source: str) -> str:
    """The module with the change."""
    for _, _, _, write in islice(_planted(ast.parse(source)), mutant.number, None):
        return write()
    raise ValueError(f"there is no mutant {mutant.number} in this source of {mutant.path}")


def _planted(tree: ast.Module) -> Iterator[tuple[str, ast.stmt, str, Callable[[], str]]]:
    """Each change in turn, which stands in the tree until the next is asked for."""
    for scope, body, place in _places(tree.body, ()):
        statement = body[place]
        before = _header(statement)
        for holder, key, new in list(_swaps(body, place)):
            old = _put(holder, key, new)
            after = "..." if isinstance(new, ast.Pass) else _header(statement)
            yield scope, statement, _difference(before, after), lambda: ast.unparse(tree)
            _put(holder, key, old)


def _put(holder: object, key: str | int, new: object) -> object:
    """Put something in its place; returns what has stood there."""
    fields = holder if isinstance(holder, list) else vars(holder)
    old, fields[key] = fields[key], new
    return old


def _places(body: list[ast.stmt], scope: tuple[str, ...]) -> Iterator[tuple[str, list[ast.stmt], int]]:
    """Of all statements: the function they stand in, their block and their place in it."""
    for place, statement in enumerate(body):
        yield ".".join(scope), body, place
        inner = (*scope, statement.name) if isinstance(statement, ast.FunctionDef | ast.ClassDef) else scope
        for block in ("body", "orelse", "finalbody"):
            yield from _places(getattr(statement, block, []), inner)
        for handler in getattr(statement, "handlers", []):
            yield from _places(handler.body, scope)


def _parts(statement: ast.stmt) -> list[ast.expr]:
    """The expressions of a statement that are evaluated in its own lines."""
    match statement:
        case ast.FunctionDef(args=args):
            parts = [*args.defaults, *args.kw_defaults]
        case ast.AnnAssign(value=value):
            parts = [value]
        case ast.With(items=items):
            parts = [item.context_expr for item in items]
        case ast.ClassDef() | ast.Expr(value=ast.Constant()):
            parts = []
        case _:
            parts = chain(*(part if isinstance(part, list) else [part] for _, part in ast.iter_fields(statement)))
    return [part for part in parts if isinstance(part, ast.expr)]


def _can_go(statement: ast.stmt) -> bool:
    """Whether it is a call, an assignment to a part of something, or a way out of a loop."""
    match statement:
        case ast.Expr(value=ast.Call()) | ast.Break() | ast.Continue() | ast.AugAssign():
            return True
        case ast.Assign(targets=[ast.Subscript() | ast.Attribute()]):
            return True
    return False


def _swaps(body: list[ast.stmt], place: int) -> Iterator[Swap]:  # noqa: C901
    """What may be changed in a statement, blocks within it apart."""
    if _can_go(body[place]):
        yield body, place, ast.Pass()
    for node in chain([body[place]], *map(ast.walk, _parts(body[place]))):
        match node:
            case ast.Compare(ops=ops):
                yield from ((ops, i, other()) for i, op in enumerate(ops) for other in COMPARISONS[type(op)])
            case ast.BinOp(op=op) | ast.AugAssign(op=op) if type(op) in OPERATORS:
                yield node, "op", OPERATORS[type(op)]()
            case ast.BoolOp(op=op):
                yield node, "op", ast.Or() if isinstance(op, ast.And) else ast.And()
            case ast.UnaryOp(op=ast.USub()):
                yield node, "op", ast.UAdd()
            case ast.UnaryOp(op=op, operand=operand):
                yield node, "operand", ast.UnaryOp(op, operand)
            case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test) if not _has_its_opposite(test):
                yield node, "test", ast.UnaryOp(ast.Not(), test)
            case ast.Return(value=value) if value is not None and getattr(value, "value", ...) is not None:
                yield node, "value", ast.Constant(None)
            case ast.Constant(value=bool() | int() | float() as value):
                yield node, "value", _another(value)
            case ast.Call(func=ast.Name(id=name) as function) if name in NAMES:
                yield function, "id", NAMES[name]
            case ast.Call(func=ast.Attribute(attr=name) as function) if name in NAMES:
                yield function, "attr", NAMES[name]


def _has_its_opposite(test: ast.expr) -> bool:
    """Whether a condition is turned round by a change within it."""
    negation = isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not)
    return negation or (isinstance(test, ast.Compare) and len(test.ops) == 1)


def _another(value: bool | int | float) -> bool | int | float:
    """The other of two, one more of a whole number, twice as much of a real one."""
    if isinstance(value, bool):
        return not value
    return value + 1 if isinstance(value, int) or value == 0 else 2 * value


def _lines(statement: ast.stmt) -> range:
    """Of a statement without its blocks; of the body of a function, whose defaults are felt there."""
    body = getattr(statement, "body", None)
    if isinstance(statement, ast.FunctionDef):
        return range(body[0].lineno, statement.end_lineno + 1)
    return range(statement.lineno, max(body[0].lineno, statement.lineno + 1) if body else statement.end_lineno + 1)


def _constant(statement: ast.stmt) -> str:
    """The name that a statement assigns a value to, if it does."""
    match statement:
        case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
            return name
    return ""


def _header(statement: ast.stmt) -> str:
    """A statement on one line, without its blocks."""
    text = ast.unparse(statement)
    if not hasattr(statement, "body"):
        return " ".join(text.split())
    return text.splitlines()[len(getattr(statement, "decorator_list", []))]


def _difference(before: str, after: str) -> str:
    """What changes, with a little of what stands around it."""
    start = _in_common(before, after)
    end = _in_common(before[start:][::-1], after[start:][::-1])
    first, last = max(start - CONTEXT, 0), min(end, CONTEXT)
    shown = [_short(text[first : len(text) - end + last]) for text in (before, after)]
    return " -> ".join(f"{'…' * (first > 0)}{text}{'…' * (end > last)}" for text in shown)


def _in_common(one: str, other: str) -> int:
    """Letters with which both begin."""
    return sum(takewhile(bool, (a == b for a, b in zip(one, other, strict=False))))


def _short(text: str) -> str:
    """Both ends of what is long."""
    return text if len(text) <= 4 * CONTEXT else f"{text[: 2 * CONTEXT]}…{text[-2 * CONTEXT :]}"
