"""Figure of the solver comparison."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from validation.analysis.evidence import Table
from validation.report.drawing import name_curves
from validation.report.style import BARS, BLUE, GREEN, PURPLE, SKY, Style, panels

MARKS: dict[str, Style] = {
    "bem3d": {"color": BLUE, "marker": "o"},
    "bem3d, Polonsky-Keer": {"color": SKY, "marker": "D", "markerfacecolor": "none"},
    "tamaas": {"color": PURPLE, "marker": "s", "markerfacecolor": "none"},
    "ContactMechanics": {"color": GREEN, "marker": "^"},
}
STRANGER: Style = {"color": "#777777", "markerfacecolor": "none"}
MARKERS_OF_STRANGERS = "vP*Xpd"
"""Of solvers that have no style of their own, in turn."""


def styles_of(names: Sequence[str]) -> dict[str, Style]:
    """By name: with threads as without, larger and open; those without a style of their own in turn."""
    strangers = [name for name in names if name not in MARKS and not name.endswith(" threads")]
    base_styles = MARKS | {
        name: {**STRANGER, "marker": MARKERS_OF_STRANGERS[i % len(MARKERS_OF_STRANGERS)]}
        for i, name in enumerate(strangers)
    }
    threads: Style = {"markersize": 9, "markerfacecolor": "none"}
    styles = {name: base_styles.get(name) or {**base_styles[name.rpartition(", ")[0]], **threads} for name in names}
    return {name: {**style, "linestyle": "none", "label": name} for name, style in styles.items()}


def draw(heats: Table) -> Figure:
    """Times, operator applications, times relative to ours, and how times grow."""
    problems, names = (list(dict.fromkeys(heats[name].tolist())) for name in ("problem", "solver"))
    figure, (time, work, ratio, growth) = panels(2, 2, heights=2 * [1.6 + 0.16 * len(problems)])
    by_problem = (time, work, ratio)
    ours = heats.where(solver="bem3d")
    our_seconds = dict(zip(ours["problem"], ours["median [s]"], strict=True))
    styles = styles_of(names)
    for shift, name in zip(np.linspace(-0.3, 0.3, len(names)), names, strict=True):
        rows = heats.where(solver=name, status="finished")
        unit = np.array([our_seconds[problem] for problem in rows["problem"]])
        place = np.array([problems.index(problem) for problem in rows["problem"]]) + shift
        bars = np.abs(np.array([rows["fastest [s]"], rows["slowest [s]"]]) - rows["median [s]"])
        # one that finishes nowhere is in the table alone
        style: Style = {"markersize": 4, **styles[name], "label": name if place.size else "_"}
        time.errorbar(rows["median [s]"], place, xerr=bars, **style, **BARS)
        # NaN where a solver does not count
        work.plot(rows["operator applications"], place, **style)
        if name != "bem3d" and place.size:
            ratio.errorbar(rows["median [s]"] / unit, place, xerr=bars / unit, **style, **BARS)
    ratio.axvline(1.0, color="#000000", linewidth=1.0)
    time.set(xlabel="time [s]")
    work.set(xlabel="operator applications")
    ratio.set(xlabel="time / time of bem3d")
    for axis in by_problem:
        axis.set(xscale="log", ylim=(len(problems) - 0.5, -0.5))
        axis.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if axis is work else (1.0,)))
        axis.xaxis.set_major_formatter("{x:g}")
        axis.minorticks_off()
        axis.set_yticks(range(len(problems)), problems if axis is not work else [])
    _draw_growth(growth, heats, styles)
    name_curves(figure, [time], 1)
    return figure


def _draw_growth(axis: Axes, heats: Table, styles: Mapping[str, Style]) -> None:
    """Of the light rough contact in free space, which the largest grids have; t ~ n^exponent over the cells n."""
    free = heats.where(surface="rough", **{"half-space": "free", "status": "finished"})
    rows = free.where(name=free["name"][0]) if len(free["name"]) else free
    for name in dict.fromkeys(rows["solver"].tolist()):
        of_solver = rows.where(solver=name)
        cells, seconds, style = of_solver["cells"].astype(float) ** 2, of_solver["median [s]"], styles[name]
        line = axis.plot(cells, seconds, **{**style, "linestyle": "-", "linewidth": 0.8})
        if len(cells) > 1:
            exponent = np.polyfit(np.log(cells), np.log(seconds), 1)[0]
            end, color = (cells[-1], seconds[-1]), line[0].get_color()
            axis.annotate(f"{exponent:.2f}", end, (6, 0), textcoords="offset points", va="center", color=color)
    axis.set(xscale="log", yscale="log", xlabel="cells", ylabel="time to the residual [s]")
