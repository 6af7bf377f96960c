"""Fig. 14.5, the law of the break, and the causes of regions 2 and 4."""

import numpy as np
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import EXACT, GUIDE, Style, graded, panels
from validation.theory.wheel import hertz_period


def draw(evidence: Evidence) -> Figure:
    """Spectra by distance; the break by duration."""
    figure, (spectra, law) = panels(1, 2, width=10.5, height=4.0)
    table, breaks = evidence.table("distances"), evidence.table("breaks")
    distances = breaks["distance [m]"]
    for i, distance in enumerate(distances):
        mine, style = table.where(**{"distance [m]": distance}), graded(i, distances.size)
        omega, a = mine["omega [rad/s]"], mine["A [(m/s2)2 s]"]
        spectra.plot(omega, a, label=f"{distance:.2g} m", **{**style, "markersize": 3, "markevery": 7})
        at = breaks["break [rad/s]"][i]
        level = np.exp(np.interp(np.log(at), np.log(omega), np.log(a)))
        spectra.plot([at], [level], "o", markersize=8, markerfacecolor="none", color=style["color"])
    spectra.set(xscale="log", yscale="log", xlabel="ω [rad/s]", ylabel="A [(m/s²)² s]")
    spectra.legend(loc="lower left", fontsize=7, ncols=2)
    t, found, half = (breaks[name] for name in ("duration [s]", "break [rad/s]", "± break [rad/s]"))
    law.errorbar(t, found, yerr=half, fmt="o", color="#0072B2", capsize=2, label="found")
    law.plot(t, breaks["break by its jumps [rad/s]"], "x", color="#000000", label="by the jumps of the records")
    exponent = next(n.reference for n in evidence.numbers if n.label.startswith("break against duration"))
    middle = np.exp(np.mean(np.log(found) - exponent * np.log(t)))
    law.plot(t, middle * t**exponent, label=f"T^{exponent:.3f}", **EXACT)
    law.set(xscale="log", yscale="log", xlabel="T [ms]", ylabel="ω_break [rad/s]")
    law.set_xticks(t, [f"{1e3 * one:.3g}" for one in t])
    law.xaxis.minorticks_off()
    law.legend(loc="upper left")
    return figure


def draw_cause(evidence: Evidence) -> Figure:
    """Ways to end a record; region 2 by height; the peak by amplitude."""
    figure, (ways, plateau, peak) = panels(1, 3, width=12.5, height=4.0)
    ends = evidence.table("endings")
    omega = ends["omega [rad/s]"]
    styles: dict[str, Style] = {
        "springs, repeating": {"color": "#bbbbbb", "linewidth": 3.5},
        "springs, open": {"color": "#D55E00", "linewidth": 1.4},
        "springs, whole turns": {"color": "#009E73", "linewidth": 1.2, "linestyle": "-."},
        "springs, open, Hann": {"color": "#000000", "linewidth": 1.0, "linestyle": "--"},
        "linear, open": {**GUIDE, "color": "#0072B2", "linewidth": 1.6},
    }
    for name, style in styles.items():
        ways.plot(omega, ends[name], label=name, **style)
    ways.set(xscale="log", yscale="log", xlabel="ω [rad/s]", ylabel="A [(m/s²)² s]")
    ways.set(ylim=(0.1 * np.nanmin(ends["springs, repeating"]), 1e3 * np.nanmax(ends["springs, open"])))
    ways.legend(loc="upper right", fontsize=7)
    table = evidence.table("plateau")
    height = table["h / d"]
    marks: dict[str, Style] = {
        "springs, open": {"marker": "o", "color": "#D55E00"},
        "linear, open": {"marker": "x", "color": "#0072B2"},
        "springs, steady": {"marker": "s", "color": "#777777", "markerfacecolor": "none"},
    }
    labels = ("springs, open", "linear, open: leakage", "springs, repeating: nonlinearity")
    for (kind, style), label in zip(marks.items(), labels, strict=True):
        bars = table[f"± {kind} [dB]"]
        plateau.errorbar(height, table[f"{kind} [dB]"], yerr=bars, linestyle="none", capsize=2, label=label, **style)
    for kind, order, dash in (("linear, open", 2, "-"), ("springs, steady", 4, "--")):
        level = table[f"{kind} [dB]"][0] + 10 * order * np.log10(height / height[0])
        plateau.plot(height, level, label=f"h^{order}", **{**EXACT, "linestyle": dash})
    plateau.set(xscale="log", xlabel="h / d", ylabel="mean of A in region 2 [dB over (m/s²)² s]")
    plateau.set_xticks(height, [f"{h:.2g}" for h in height])
    plateau.xaxis.minorticks_off()
    plateau.legend(loc="lower right", fontsize=7)
    vibrations = evidence.table("vibrations")
    release = vibrations["release / d"]
    fine = np.linspace(0.02, 1.15 * max(release.max(), 0.1), 60)
    peak.plot(fine, [1 / hertz_period(1 + r) for r in fine], label="Hertz, quadrature", **EXACT)
    peak.errorbar(
        release, vibrations["peak over omega_eigen"], yerr=vibrations["± sample"], fmt="o", capsize=2, color="#D55E00"
    )
    peak.set(xlabel="release below equilibrium / d", ylabel="peak / ω_eigen")
    peak.legend(loc="lower left")
    peak.set_xlim(-0.04 * fine[-1], fine[-1])
    return figure
