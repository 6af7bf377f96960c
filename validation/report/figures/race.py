"""Figure of the solver comparison."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from validation.analysis.evidence import Table
from validation.report.style import Style, panels

MARKS: dict[str, Style] = {
    "bem3d": {"color": "#0072B2", "marker": "o"},
    "bem3d, Polonsky-Keer": {"color": "#56B4E9", "marker": "D", "markerfacecolor": "none"},
    "tamaas": {"color": "#D55E00", "marker": "s", "markerfacecolor": "none"},
    "ContactMechanics": {"color": "#009E73", "marker": "^"},
}
OTHER: Style = {"color": "#777777", "markerfacecolor": "none"}
OTHERS = "vP*Xpd"
"""Of solvers that have no style of their own, in turn."""


def draw(heats: Table) -> Figure:
    """Times, and their ratios to ours."""
    problems, names = (list(dict.fromkeys(heats[name].tolist())) for name in ("problem", "solver"))
    figure, (time, ratio) = panels(1, 2, width=11.0, height=1.4 + 0.3 * len(problems), sharey="all")
    ours = heats.where(solver="bem3d")
    mine = dict(zip(ours["problem"], ours["median [s]"], strict=True))
    others = [name for name in names if name not in MARKS]
    marks = MARKS | {name: {**OTHER, "marker": OTHERS[i % len(OTHERS)]} for i, name in enumerate(others)}
    for shift, name in zip(np.linspace(-0.3, 0.3, len(names)), names, strict=True):
        rows = heats.where(solver=name, status="finished")
        unit = np.array([mine[problem] for problem in rows["problem"]])
        place = np.array([problems.index(problem) for problem in rows["problem"]]) + shift
        bars = np.abs(np.array([rows["fastest [s]"], rows["slowest [s]"]]) - rows["median [s]"])
        # one that finishes nowhere is in the table alone
        style = {**marks[name], "linestyle": "none", "label": name if place.size else "_"}
        time.errorbar(rows["median [s]"], place, xerr=bars, **style)
        if name != "bem3d" and place.size:
            ratio.errorbar(rows["median [s]"] / unit, place, xerr=bars / unit, **style)
    ratio.axvline(1.0, color="#000000", linewidth=1.0)
    time.set(xscale="log", xlabel="time to the residual [s]")
    ratio.set(xscale="log", xlabel="time / median time of bem3d")
    for axis in (time, ratio):
        axis.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.xaxis.set_major_formatter("{x:g}")
        axis.minorticks_off()
    time.set_yticks(range(len(problems)), problems)
    time.invert_yaxis()
    figure.legend(*time.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure
