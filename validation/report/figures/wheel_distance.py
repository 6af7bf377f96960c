"""Fig. 14.5, the law of the break, and the causes of regions 2 and 4."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import EXACT, GUIDE, Style, graded, panels, tick

ENDINGS: dict[str, Style] = {
    "springs, steady-state": {"color": "#bbbbbb", "linewidth": 3.5},
    "springs, open": {"color": "#D55E00", "linewidth": 1.4},
    "springs, periodic": {"color": "#009E73", "linewidth": 1.2, "linestyle": "-."},
    "springs, open, Hann": {"color": "#000000", "linewidth": 1.0, "linestyle": "--"},
    "linear, open": {**GUIDE, "color": "#0072B2", "linewidth": 1.6},
}
PARTS: dict[str, tuple[str, Style]] = {
    "springs, open": ("springs, open", {"marker": "o", "color": "#D55E00"}),
    "linear, open": ("linear, open: leakage", {"marker": "x", "color": "#0072B2"}),
    "springs, steady-state": (
        "springs, steady-state: nonlinearity",
        {"marker": "s", "color": "#777777", "markerfacecolor": "none"},
    ),
}
"""Of region 2: label and style."""


def draw(evidence: Evidence) -> Figure:
    figure, (spectra, law) = panels(1, 2, width=10.5, height=4.0)
    _spectra(spectra, evidence)
    breaks, line = evidence.table("breaks"), evidence.table("law")
    t, found, half = (breaks[name] for name in ("duration [s]", "break [rad/s]", "± break [rad/s]"))
    law.errorbar(t, found, yerr=half, fmt="o", color="#0072B2", capsize=2, label="found")
    law.plot(t, breaks["break by its jumps [rad/s]"], "x", color="#000000", label="by the jumps of the records")
    law.plot(line["duration [s]"], line["break [rad/s]"], label=f"T^{line['exponent'][0]:.3f}", **EXACT)
    law.set(xscale="log", yscale="log", xlabel="T [ms]", ylabel="ω_break [rad/s]")
    law.set_xticks(t, [f"{1e3 * one:.3g}" for one in t])
    law.xaxis.minorticks_off()
    law.legend(loc="upper left")
    return figure


def _spectra(axis: Axes, evidence: Evidence) -> None:
    table, breaks = evidence.table("distances"), evidence.table("breaks")
    distances = breaks["distance [m]"]
    for i, distance in enumerate(distances):
        mine, style = table.where(**{"distance [m]": distance}), graded(i, distances.size)
        omega, a = mine["omega [rad/s]"], mine["A [(m/s2)2 s]"]
        axis.plot(omega, a, label=f"{distance:.2g} m", **{**style, "markersize": 3, "markevery": 7})
        at = breaks["break [rad/s]"][i]
        level = np.exp(np.interp(np.log(at), np.log(omega), np.log(a)))
        axis.plot([at], [level], "o", markersize=8, markerfacecolor="none", color=style["color"])
    axis.set(xscale="log", yscale="log", xlabel="ω [rad/s]", ylabel="A [(m/s²)² s]")
    axis.legend(loc="lower left", fontsize=7, ncols=2)


def draw_cause(evidence: Evidence) -> Figure:
    figure, (endings, plateau, peak) = panels(1, 3, width=12.5, height=4.0)
    table = evidence.table("endings")
    for name, style in ENDINGS.items():
        endings.plot(table["omega [rad/s]"], table[name], label=name, **style)
    lowest, highest = np.nanmin(table["springs, steady-state"]), np.nanmax(table["springs, open"])
    endings.set(xscale="log", yscale="log", xlabel="ω [rad/s]", ylabel="A [(m/s²)² s]")
    endings.set(ylim=(0.1 * lowest, 1e3 * highest))
    endings.legend(loc="upper right", fontsize=7)
    _plateau(plateau, evidence)
    _peak(peak, evidence)
    return figure


def _plateau(axis: Axes, evidence: Evidence) -> None:
    table = evidence.table("plateau")
    height = table["h / d"]
    for kind, (label, style) in PARTS.items():
        bars = table[f"± {kind} [dB]"]
        axis.errorbar(height, table[f"{kind} [dB]"], yerr=bars, linestyle="none", capsize=2, label=label, **style)
    for kind, order, dash in (("linear, open", 2, "-"), ("springs, steady-state", 4, "--")):
        level = table[f"{kind} [dB]"][0] + 10 * order * np.log10(height / height[0])
        axis.plot(height, level, label=f"h^{order}", **{**EXACT, "linestyle": dash})
    axis.set(xscale="log", xlabel="h / d", ylabel="mean of A in region 2 [dB over (m/s²)² s]")
    tick(axis, np.round(height, 3))
    axis.legend(loc="lower right", fontsize=7)


def _peak(axis: Axes, evidence: Evidence) -> None:
    found, hertz = evidence.table("vibrations"), evidence.table("hertz")
    x, y = "release / d", "peak over omega_eigen"
    axis.plot(hertz[x], hertz[y], label="Hertz, quadrature", **EXACT)
    axis.errorbar(found[x], found[y], yerr=found["± sample"], fmt="o", capsize=2, color="#D55E00")
    axis.set(xlabel="release below equilibrium / d", ylabel="peak / ω_eigen")
    axis.legend(loc="lower left")
    axis.set_xlim(-0.04 * hertz[x][-1], hertz[x][-1])
