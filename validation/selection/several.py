"""Comparisons of several scenes in one table."""

from collections.abc import Sequence

from validation.analysis.evidence import Table
from validation.selection.compare import Comparison
from validation.selection.exported import levels_of_models
from validation.selection.summary import label, scaled


def overview(comparisons: Sequence[Comparison]) -> list[str]:
    """A line a scene: the model that is enough, its error, the errors of MDR, the result where it is one number."""
    width = 2 + max(len(one.scene.name) for one in comparisons)
    lines = [f"{'scene':{width}s}{'model':36s}{'error':>9s}{'MDR':>9s}   result"]
    for one in comparisons:
        best, shown = one.selection.best, one.tolerance.shown
        error = "none" if best is None else shown(best.error)
        mdr = min((springs.error for springs in one.models if springs.model.is_mdr), default=None)
        name = "none is enough" if best is None or not one.met else label(best)
        columns = f"{name:36s}{error:>9s}{'—' if mdr is None else shown(mdr):>9s}"
        lines.append(f"{one.scene.name:{width}s}{columns}   {_result(one)}".rstrip())
    return lines


def _result(comparison: Comparison) -> str:
    best = comparison.selection.best
    if best is None:
        return ""
    if comparison.is_level:
        return f"{comparison.value.size} bands"
    (value,), (half,) = comparison.value, comparison.errors_of(best)
    return f"{scaled(float(value), float(half))} {comparison.unit}"


def table_of_several(comparisons: Sequence[Comparison]) -> Table:
    """The tables of all, one under another, with the name of the scene in front, as `to_csv` has them."""
    tables = [levels_of_models(one) for one in comparisons]
    scenes = [one.scene.name for one, table in zip(comparisons, tables, strict=True) for _ in table["value"]]
    columns = {name: [value for table in tables for value in table.columns[name]] for name in tables[0].columns}
    return Table(comparisons[0].quantity, {"scene": scenes, **columns})


def selected_of_several(table: Table) -> Table:
    """The selected model of each scene alone, named by its scene: what a figure of several scenes shows."""
    selected = table.where(selected=True)
    others = {"model": selected.columns["scene"], "selected": [False] * len(selected["scene"])}
    return Table(table.name, {**selected.columns, **others})
