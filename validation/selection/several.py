"""Comparisons of several scenes in one table."""

from collections.abc import Sequence

from validation.analysis.evidence import Table
from validation.selection.compare import Comparison
from validation.selection.contact_force import contact_force
from validation.selection.exported import by_quantity
from validation.selection.summary import WIDTH, label, scaled, what_would_help, wrapped


def overview(comparisons: Sequence[Comparison]) -> list[str]:
    """A line a scene, of the columns of `overview_of`; two lines a scene where names are long."""
    scenes, *others = ([name, *column] for name, column in overview_of(comparisons).items())
    model, error, mdr = (max(map(len, column)) for column in others[:3])
    rests = [
        f"{row[0]:{model}s}  {row[1]:>{error}s}  {row[2]:>{mdr}s}   {row[3]}".rstrip()
        for row in zip(*others, strict=True)
    ]
    width = max(map(len, scenes))
    if width + 2 + max(map(len, rests)) <= WIDTH:
        return [f"{scene:{width}s}  {rest}" for scene, rest in zip(scenes, rests, strict=True)]
    head, *pairs = zip(scenes, rests, strict=True)
    return [head[0], f"  {head[1]}", *(line for scene, rest in pairs for line in (scene, f"  {rest}"))]


def help_with(comparisons: Sequence[Comparison]) -> list[str]:
    """What would help each scene whose tolerance is not met."""
    lines = [f"{one.scene.name}: {line}" for one in comparisons for line in what_would_help(one)]
    return list(wrapped(lines, indent=4))


def overview_of(comparisons: Sequence[Comparison]) -> dict[str, list[str]]:
    """A row a scene: the model that is enough, its error, that of MDR, and the result, one number or the force."""
    columns: dict[str, list[str]] = {"scene": [], "model": [], "error": [], "MDR": [], "result": []}
    several = len(by_quantity(comparisons)) > 1
    for one in comparisons:
        best, shown = one.selection.best, one.tolerance.shown
        mdr = min((springs.error for springs in one.models if springs.model.is_mdr), default=None)
        row = (
            f"{one.scene.name}: {one.quantity}" if several else one.scene.name,
            "none is enough" if best is None or not one.met else label(best),
            "none" if best is None else shown(best.error),
            "—" if mdr is None else shown(mdr),
            _result(one),
        )
        for column, cell in zip(columns.values(), row, strict=True):
            column.append(cell)
    return columns


def _result(comparison: Comparison) -> str:
    best = comparison.selection.best
    if best is None:
        return ""
    if force := contact_force(comparison):
        return force.shown
    if comparison.is_level:
        return f"{comparison.value.size} bands"
    (value,), (half,) = comparison.value, comparison.errors_of(best)
    return f"{scaled(float(value), float(half))} {comparison.unit}"


def selected_of_several(table: Table) -> Table:
    """The selected model of each scene alone, named by its scene: what a figure of several scenes shows."""
    selected = table.where(selected=True)
    # a label that begins with _ is left out of a legend
    names = [f" {name}" if name.startswith("_") else name for name in map(str, selected.columns["scene"])]
    others: dict[str, Sequence[object]] = {"model": names, "selected": [False] * len(names)}
    return Table(table.name, {**selected.columns, **others})
