"""Figure of the race."""

import numpy as np
from matplotlib.figure import Figure

from validation.evidence import Evidence
from validation.report.style import Style, panels

MARKS: dict[str, Style] = {
    "bem3d": {"color": "#0072B2", "marker": "o"},
    "bem3d, textbook": {"color": "#56B4E9", "marker": "D", "markerfacecolor": "none"},
    "tamaas": {"color": "#D55E00", "marker": "s", "markerfacecolor": "none"},
    "ContactMechanics": {"color": "#009E73", "marker": "^"},
}
SCALES = (("o", "#0072B2", "-"), ("s", "#D55E00", "--"), ("^", "#009E73", ":"))


def draw(evidence: Evidence) -> Figure:
    """Times, ratios, and how our own cost grows."""
    heats, scaling = evidence.table("heats"), evidence.table("scaling")
    problems = list(dict.fromkeys(heats["problem"].tolist()))
    figure, (time_axis, ratio_axis, growth_axis) = panels(1, 3, width=13.0, height=2.2 + 0.24 * len(problems))
    place = np.array([problems.index(name) for name in heats["problem"].tolist()])
    ours = {row: t for row, t, c in zip(place, heats["median [s]"], heats["contestant"], strict=True) if c == "bem3d"}
    ratio = heats["median [s]"] / np.array([ours[row] for row in place])
    for name, style in MARKS.items():
        mine = (heats["contestant"] == name) & (heats["status"] == "finished")
        if not mine.any():
            continue
        median = heats["median [s]"][mine]
        spread = np.abs(np.array([heats["fastest [s]"][mine], heats["slowest [s]"][mine]]) - median)
        time_axis.errorbar(median, place[mine], xerr=spread, linestyle="none", label=name, **style)
        if name != "bem3d":
            ratio_axis.plot(ratio[mine], place[mine], linestyle="none", label=name, **style)
    time_axis.set_yticks(range(len(problems)), problems)
    ratio_axis.set_yticks(range(len(problems)), [""] * len(problems))
    ratio_axis.axvline(1.0, color="#000000", linewidth=1.0)
    for axis, label in ((time_axis, "time to the residual [s]"), (ratio_axis, "time beside bem3d's")):
        axis.set_xscale("log")
        axis.set_xlabel(label)
        axis.invert_yaxis()
    figure.legend(*time_axis.get_legend_handles_labels(), loc="outside lower left", ncols=4)

    memory_axis = growth_axis.twinx()
    for (marker, color, line), problem in zip(SCALES, dict.fromkeys(scaling["problem"].tolist()), strict=False):
        rows = scaling.where(problem=problem)
        n = rows["cells"]
        growth_axis.loglog(n, rows["solve [s]"], color=color, marker=marker, linestyle=line, label=problem)
        memory = np.maximum(rows["peak memory less start [MiB]"], 0.1)
        memory_axis.loglog(n, memory, color=color, marker=marker, linestyle=line, markerfacecolor="none", alpha=0.7)
    guide = n**2 * np.log(n)
    growth_axis.loglog(n, rows["solve [s]"][-1] * guide / guide[-1], color="#555555", linewidth=1, label="n² log n")
    growth_axis.set(xlabel="cells along a side", ylabel="solve [s], filled")
    growth_axis.set_xticks(n, [str(value) for value in n])
    growth_axis.minorticks_off()
    memory_axis.set_ylabel("memory [MiB], open")
    memory_axis.grid(False)
    growth_axis.legend(loc="upper left")
    return figure
