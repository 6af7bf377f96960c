"""Mutants: a module with one small change, made by rule. What mutation testing plants, one at a time.

Left as they are: annotations, decorators, imports, strings.
"""

import ast
from collections.abc import Callable, Iterator
from dataclasses import dataclass

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

    lines: of the statement it stands in; of the whole function for a default value of an argument; empty where it
    takes effect at import; name: of the constant that it changes, if any.
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
        Mutant(path, number, scope, _lines(statement), _constant(statement) if not scope else "", change)
        for number, (scope, statement, change, _) in enumerate(_planted(ast.parse(source)))
    ]


def mutated(mutant: Mutant, source: str) -> str:
    """The module with the change."""
    for number, (_, _, _, write) in enumerate(_planted(ast.parse(source))):
        if number == mutant.number:
            return write()
    raise ValueError(f"there is no mutant {mutant.number} in this source of {mutant.path}")


def _planted(tree: ast.Module) -> Iterator[tuple[str, ast.stmt, str, Callable[[], str]]]:
    """Each change in turn, which stands in the tree until the next is asked for."""
    for scope, statement, swaps in _statements(tree.body, ()):
        before = _header(statement)
        for holder, key, new in swaps:
            old = _put(holder, key, new)
            after = "..." if isinstance(new, ast.Pass) else _header(statement)
            yield scope, statement, _difference(before, after), lambda: ast.unparse(tree)
            _put(holder, key, old)


def _put(holder: object, key: str | int, new: object) -> object:
    """Put something in its place; returns what has stood there."""
    if isinstance(holder, list):
        old, holder[key] = holder[key], new
    else:
        old = getattr(holder, key)
        setattr(holder, key, new)
    return old


def _statements(body: list[ast.stmt], scope: tuple[str, ...]) -> Iterator[tuple[str, ast.stmt, list[Swap]]]:
    """Statements with the function they stand in, and what may be changed in them, blocks within them apart."""
    for place, statement in enumerate(body):
        swaps = [swap for part in _parts(statement) for swap in _swaps(part)]
        if _can_go(statement):
            swaps.append((body, place, ast.Pass()))
        yield ".".join(scope), statement, [*swaps, *_of_statement(statement)]
        inner = (*scope, statement.name) if isinstance(statement, ast.FunctionDef | ast.ClassDef) else scope
        for block in ("body", "orelse", "finalbody"):
            yield from _statements(getattr(statement, block, []), inner)
        for handler in getattr(statement, "handlers", []):
            yield from _statements(handler.body, scope)


def _parts(statement: ast.stmt) -> list[ast.expr]:
    """The expressions of a statement that are evaluated in its own lines."""
    match statement:
        case ast.FunctionDef():
            return [one for one in (*statement.args.defaults, *statement.args.kw_defaults) if one is not None]
        case ast.AnnAssign():
            return [statement.value] if statement.value is not None else []
        case ast.ClassDef() | ast.Import() | ast.ImportFrom():
            return []
        case ast.Expr(value=ast.Constant()):
            return []
    parts = [part for _, part in ast.iter_fields(statement)]
    flat = [one for part in parts for one in (part if isinstance(part, list) else [part])]
    return [one.context_expr if isinstance(one, ast.withitem) else one for one in flat if _is_expression(one)]


def _is_expression(part: object) -> bool:
    return isinstance(part, ast.expr | ast.withitem)


def _can_go(statement: ast.stmt) -> bool:
    """Whether it is a call, an assignment to a part of something, or a way out of a loop."""
    match statement:
        case ast.Expr(value=ast.Call()) | ast.Break() | ast.Continue():
            return True
        case ast.Assign(targets=[ast.Subscript() | ast.Attribute()]) | ast.AugAssign():
            return True
    return False


def _of_statement(statement: ast.stmt) -> list[Swap]:
    """Conditions turned round, operators of assignments, values that are not returned."""
    match statement:
        case ast.If(test=test) | ast.While(test=test):
            return _negated(statement, test)
        case ast.AugAssign(op=op) if type(op) in OPERATORS:
            return [(statement, "op", OPERATORS[type(op)]())]
        case ast.Return(value=value) if value is not None and not _is_none(value):
            return [(statement, "value", ast.Constant(None))]
    return []


def _negated(holder: ast.AST, test: ast.expr) -> list[Swap]:
    """A condition turned round, but for those which have their opposite among their own changes."""
    negation = isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not)
    if negation or (isinstance(test, ast.Compare) and len(test.ops) == 1):
        return []
    return [(holder, "test", ast.UnaryOp(ast.Not(), test))]


def _is_none(value: ast.expr) -> bool:
    return isinstance(value, ast.Constant) and value.value is None


def _swaps(expression: ast.expr) -> Iterator[Swap]:
    """What may be changed in an expression and all below it."""
    for node in ast.walk(expression):
        match node:
            case ast.Compare(ops=ops):
                yield from ((ops, i, other()) for i, op in enumerate(ops) for other in COMPARISONS[type(op)])
            case ast.BinOp(op=op) if type(op) in OPERATORS:
                yield node, "op", OPERATORS[type(op)]()
            case ast.BoolOp(op=op):
                yield node, "op", ast.Or() if isinstance(op, ast.And) else ast.And()
            case ast.UnaryOp(op=op, operand=operand):
                yield (
                    (node, "op", ast.UAdd())
                    if isinstance(op, ast.USub)
                    else (node, "operand", ast.UnaryOp(op, operand))
                )
            case ast.IfExp(test=test):
                yield from _negated(node, test)
            case ast.Constant(value=bool() | int() | float() as value):
                yield node, "value", _another(value)
            case ast.Call(func=ast.Name() | ast.Attribute() as function):
                yield from _renamed(function)


def _renamed(function: ast.Name | ast.Attribute) -> list[Swap]:
    """The least for the largest, and the like."""
    where = "id" if isinstance(function, ast.Name) else "attr"
    name = getattr(function, where)
    return [(function, where, NAMES[name])] if name in NAMES else []


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
    decorators = len(getattr(statement, "decorator_list", []))
    return text.splitlines()[decorators]


def _difference(before: str, after: str) -> str:
    """What changes, with a little of what stands around it."""
    start = _in_common(before, after)
    end = _in_common(before[start:][::-1], after[start:][::-1])
    first, last = max(start - CONTEXT, 0), min(end, CONTEXT)
    shown = [_short(text[first : len(text) - end + last]) for text in (before, after)]
    return " -> ".join(f"{'…' * (first > 0)}{text}{'…' * (end > last)}" for text in shown)


def _in_common(one: str, other: str) -> int:
    """Letters with which both begin."""
    return next((i for i, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), min(len(one), len(other)))


def _short(text: str) -> str:
    """Both ends of what is long."""
    return text if len(text) <= 4 * CONTEXT else f"{text[: 2 * CONTEXT]}…{text[-2 * CONTEXT :]}"
