"""Figures of where each method fails: one panel a limit; iterations on finer grids; residual against true error."""

import textwrap

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter, NullLocator

from validation.analysis.evidence import Evidence, Table
from validation.report.style import BEM, EXACT, GUIDE, MDR, Style, graded, panels

MANY = {"left": 0.06, "right": 0.985, "bottom": 0.055, "top": 0.91, "wspace": 0.34, "hspace": 0.55}
FEWER = {"left": 0.06, "right": 0.985, "bottom": 0.08, "top": 0.87, "wspace": 0.34, "hspace": 0.55}
FOUR = {"left": 0.08, "right": 0.985, "bottom": 0.08, "top": 0.95, "wspace": 0.24, "hspace": 0.32}
COUNTS = (10, 20, 50, 100, 200)
OPEN = {"markerfacecolor": "white", "linestyle": "--"}
THRESHOLD: Style = {"color": "#000000", "linestyle": "--", "linewidth": 1.0}
FLOOR = 1e-3
"""Errors so far below the tolerance are drawn there."""


def draw(evidence: Evidence) -> Figure:
    figure, axes = panels(3, 4, width=13.0, height=9.6, within=MANY)
    _draw_all(evidence, "limits", axes)
    return figure


def draw_bem(evidence: Evidence) -> Figure:
    figure, axes = panels(2, 4, width=13.0, height=6.6, within=FEWER)
    _draw_all(evidence, "limits-bem", axes)
    return figure


def _draw_all(evidence: Evidence, figure: str, axes: list[Axes]) -> None:
    limits, sweeps = evidence.table("limits").where(figure=figure), evidence.table("sweeps")
    for name, axis in zip(limits["name"], axes, strict=True):
        _panel(axis, limits.where(name=name), sweeps.where(limit=name))
    _explain(axes[0].figure)  # type: ignore[arg-type]


def _explain(figure: Figure) -> None:
    """What all panels have in common, above them."""
    mark: Style = {"linestyle": "none", "marker": "o", "markersize": 5, "color": "#333333"}
    handles = [
        Line2D([], [], **mark, label="no message"),
        Line2D([], [], **{**mark, "markerfacecolor": "white"}, label="warning or error message"),
        Line2D([], [], **{**mark, "marker": "x"}, label="no answer"),
        Line2D([], [], **THRESHOLD, label="predicted threshold"),
        Patch(color="#000000", alpha=0.08, linewidth=0, label="factor of the prediction"),
        Patch(color="#D55E00", alpha=0.12, linewidth=0, label="must fail"),
        Line2D([], [], **GUIDE, label="tolerance"),
    ]
    figure.legend(handles=handles, loc="upper center", ncols=len(handles), fontsize=8.5, frameon=False)


def _panel(axis: Axes, limit: Table, rows: Table) -> None:
    """Error against the parameter; open marks where the software warned."""
    (method,), (title,), (parameter,), (error,) = (limit[name] for name in ("method", "title", "parameter", "error"))
    (threshold,), (side,) = limit["predicted threshold"], limit["failing_side"]
    (tolerance,), (factor,) = limit["tolerance"], limit["factor"]
    x, y, warned = rows["value"], rows["error"], rows["warned"] > 0
    answered = np.isfinite(y)
    low, high = _range(y[answered], tolerance)
    drawn = np.clip(np.where(answered, y, high), low, high)
    style = MDR if method.startswith("MDR") else BEM
    color, marker = style["color"], style["marker"]
    axis.plot(x[answered], drawn[answered], color=color, linewidth=0.9)
    for some, face in ((answered & ~warned, color), (answered & warned, "white")):
        axis.plot(
            x[some], drawn[some], linestyle="none", marker=marker, color=color, markerfacecolor=face, markersize=5
        )
    axis.plot(x[~answered], drawn[~answered], **{**EXACT, "linestyle": "none", "marker": "x", "markersize": 6})
    axis.axhline(tolerance, **GUIDE)
    axis.axvline(threshold, **THRESHOLD)
    axis.axvspan(threshold / factor, threshold * factor, color="#000000", alpha=0.06, linewidth=0)
    axis.set(xscale="log", yscale="log", ylim=(low / 1.6, high * 1.6))
    first, last = axis.get_xlim()
    ends = (threshold, last) if side == "above" else (first, threshold)
    axis.axvspan(*ends, color="#D55E00", alpha=0.08, linewidth=0)
    axis.set_xlim(first, last)
    _ticks(axis, last / first)
    axis.set_xlabel(textwrap.fill(parameter, 34), fontsize=8)
    axis.set_ylabel(textwrap.fill(error, 30), fontsize=8)
    axis.set_title(f"{method}:\n{title}", fontsize=8.5)
    axis.tick_params(labelsize=7.5)


def _range(errors: np.ndarray, tolerance: float) -> tuple[float, float]:
    """Of the errors and the tolerance, but for what is far below that."""
    shown = np.append(errors[errors > FLOOR * tolerance], [tolerance / 6, 6 * tolerance])
    return max(float(shown.min()), FLOOR * tolerance), float(shown.max())


def _ticks(axis: Axes, span: float) -> None:
    """Plain numbers where the parameter spans little more than a decade; of the error, powers of ten alone."""
    axis.yaxis.set_minor_formatter(NullFormatter())
    if span > 200:
        return
    if span < 4:
        axis.set_xscale("linear")
        return
    axis.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if span < 60 else (1.0,)))
    axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.xaxis.set_minor_locator(NullLocator())
    axis.xaxis.set_minor_formatter(NullFormatter())


def draw_solver(evidence: Evidence) -> Figure:
    """Iterations against cells; true errors against the residual."""
    figure, axes = panels(2, 2, height=6.6, within=FOUR)
    _iterations(axes[0], evidence.table("iterations"))
    for axis, measure in zip(axes[1:], ("load", "stiffness", "pressure"), strict=True):
        _residual(axis, evidence.table("residual"), measure)
    axes[1].legend(*axes[0].get_legend_handles_labels(), loc="lower right", fontsize=7)
    return figure


def _iterations(axis: Axes, found: Table) -> None:
    for solver, scene, style in _styles(found):
        rows = found.where(scene=scene, solver=solver)
        axis.plot(rows["cells"], rows["iterations"], label=f"{solver}, {scene}", **style)
    cells = np.unique(found["cells"])
    axis.set(xscale="log", yscale="log", xlabel="cells on a side", ylabel="iterations", title="to a residual of 1e-8")
    axis.set_xticks(cells, [str(n) for n in cells])
    axis.set_yticks(COUNTS, [str(n) for n in COUNTS])
    for side in (axis.xaxis, axis.yaxis):
        side.set_minor_locator(NullLocator())


def _residual(axis: Axes, found: Table, measure: str) -> None:
    for solver, scene, style in _styles(found):
        rows = found.where(scene=scene, solver=solver)
        residual, error = rows["residual"], rows[f"error of the {measure}"]
        shown = error > 0
        axis.plot(residual[shown], error[shown], **{**style, "linewidth": 0.7})
    known = found["residual"][found[f"error of the {measure}"] > 0]
    ends = np.array([known.min(), known.max()])
    axis.plot(ends, ends, **GUIDE)
    axis.set(xscale="log", yscale="log", xlabel="residual", ylabel="relative error", title=f"true error: {measure}")


def _styles(found: Table) -> list[tuple[str, str, Style]]:
    solvers, scenes = (list(dict.fromkeys(found[name].tolist())) for name in ("solver", "scene"))
    return [
        (solver, scene, {**graded(i, len(scenes)), **(OPEN if j else {})})
        for j, solver in enumerate(solvers)
        for i, scene in enumerate(scenes)
    ]
