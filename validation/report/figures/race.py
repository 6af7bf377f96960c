"""Figures of the solver comparison."""

import numpy as np
from matplotlib.figure import Figure

from validation.analysis.evidence import Table
from validation.report.style import Style, graded, panels, tick

MARKS: dict[str, Style] = {
    "bem3d": {"color": "#0072B2", "marker": "o"},
    "bem3d, Polonsky-Keer": {"color": "#56B4E9", "marker": "D", "markerfacecolor": "none"},
    "tamaas": {"color": "#D55E00", "marker": "s", "markerfacecolor": "none"},
    "ContactMechanics": {"color": "#009E73", "marker": "^"},
}
OTHER: Style = {"color": "#777777", "marker": "v", "markerfacecolor": "none"}
"""Of contact models that are found."""
LINES: tuple[Style, ...] = (
    {"color": "#000000", "marker": "*", "linestyle": "-"},
    {"color": "#CC79A7", "marker": "P", "linestyle": "--"},
    {"color": "#E69F00", "marker": "X", "linestyle": "-."},
)


def draw(heats: Table, scaling: Table) -> Figure:
    """Times, ratios, and how our own time and memory grow."""
    problems = list(dict.fromkeys(heats["problem"].tolist()))
    figure, (time_axis, growth_axis, ratio_axis, memory_axis) = panels(
        2, 2, width=11.0, height=2.4 + 0.6 * len(problems)
    )
    place = np.array([problems.index(name) for name in heats["problem"].tolist()])
    ours = {row: t for row, t, c in zip(place, heats["median [s]"], heats["solver"], strict=True) if c == "bem3d"}
    mine = np.array([ours[row] for row in place])
    spread = np.abs(np.array([heats["fastest [s]"], heats["slowest [s]"]]) - heats["median [s]"])
    names = list(dict.fromkeys(heats["solver"].tolist()))
    for shift, name in zip(np.linspace(-0.3, 0.3, len(names)), names, strict=True):
        style = MARKS.get(name, OTHER)
        rows = (heats["solver"] == name) & (heats["status"] == "finished")
        for axis, unit in ((time_axis, np.ones(place.size)), (ratio_axis, mine)):
            if rows.any() and (axis is time_axis or name != "bem3d"):
                x, bars = heats["median [s]"] / unit, spread / unit
                axis.errorbar(x[rows], place[rows] + shift, xerr=bars[:, rows], linestyle="none", label=name, **style)
    ratio_axis.axvline(1.0, color="#000000", linewidth=1.0)
    for axis, label in ((time_axis, "time to the residual [s]"), (ratio_axis, "time / median time of bem3d")):
        axis.set_yticks(range(len(problems)), problems)
        axis.set_xscale("log")
        axis.set_xlabel(label)
        axis.invert_yaxis()
    time_axis.legend(loc="lower center", bbox_to_anchor=(0.5, 1.03), ncols=2)

    for style, problem in zip(LINES, dict.fromkeys(scaling["problem"].tolist()), strict=False):
        rows = scaling.where(problem=problem)
        growth_axis.loglog(rows["cells"], rows["solve [s]"], label=problem, **style)
        memory_axis.loglog(rows["cells"], np.maximum(rows["peak memory less start [MiB]"], 0.1), label=problem, **style)
    free = scaling.where(problem="rough, free")
    n = free["cells"]
    guide = n**2 * np.log(n)
    growth_axis.loglog(n, free["solve [s]"][-1] * guide / guide[-1], color="#555555", linestyle=":", label="n² log n")
    for axis, label in ((growth_axis, "time of a solve [s]"), (memory_axis, "memory [MiB]")):
        axis.set(xlabel="cells along a side, n", ylabel=label)
        tick(axis, n)
        axis.minorticks_off()
        axis.legend(loc="upper left")
    return figure


def draw_wheel(wheel: Table) -> Figure:
    """Wheel-steps a second against springs to a radius."""
    heights = np.unique(wheel["h0/d"])
    figure, (axis,) = panels(1, 1, width=5.4)
    for i, height in enumerate(heights):
        mine, style = wheel.where(**{"h0/d": height}), graded(i, heights.size)
        springs = mine["a/dx"]
        axis.loglog(springs, mine["wheel-steps a second"], label=f"h₀/d = {height:g}", **style)
        open_ = {**style, "markerfacecolor": "white", "linestyle": "--"}
        axis.loglog(springs, mine["plain sums a second"], **open_)
        tick(axis, springs)
    axis.minorticks_off()
    axis.set(xlabel="springs to a contact radius, a / dx", ylabel="steps of one wheel a second")
    axis.legend()
    return figure
