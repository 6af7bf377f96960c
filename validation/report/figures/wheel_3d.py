"""The acceleration of the wheel in three dimensions, beside everything cheaper."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import BEM, EXACT, GUIDE, MDR, Style, panels, visible

STYLES: dict[str, Style] = {
    "linear, 3D": {"color": "#aaaaaa", "linewidth": 3.0},
    "linear, 1D (14.12)": {**EXACT, "linestyle": "--"},
    "springs, Geike spectrum": MDR,
    "springs, rolling spectrum": {**MDR, "color": "#009E73", "marker": "^"},
}
LOWEST = -45.0
"""Decibels under boundary elements that are shown."""


def draw(evidence: Evidence) -> Figure:
    figure, (levels, differences, oscillation, contrast) = panels(2, 2, width=11.0, height=7.4)
    table = evidence.table("levels")
    omega, bem = table["omega [rad/s]"], table["bem3d [dB]"]
    open_ = table["± sample [dB]"] + table["± grid [dB]"] + np.nan_to_num(table["± solver [dB]"])
    below = ~np.isfinite(table["linear, 1D (14.12) over bem3d [dB]"])
    if below.any():
        plateau = 0.9 * float(omega[0]), float(table["to [rad/s]"][below][-1])
        levels.axvspan(*plateau, color="#000000", alpha=0.06, linewidth=0)
    for name, style in STYLES.items():
        off = visible(table[f"{name} over bem3d [dB]"], above=LOWEST)
        levels.plot(omega, bem + off, label=name, **style)
        differences.plot(omega, off, **style)
    levels.errorbar(omega, bem, yerr=open_, capsize=2, label="boundary elements", **BEM)
    levels.set(xscale="log", xlabel="ω [rad/s]", ylabel="one-third octave level [dB over (m/s²)²]")
    levels.legend(loc="upper right", fontsize=7)
    levels.set_ylim(top=float(bem.max()) + 32)
    differences.fill_between(omega, -open_, open_, color=BEM["color"], alpha=0.2, linewidth=0)
    for border in (-3, -1, 1, 3):
        differences.axhline(border, **GUIDE)
    differences.set(xscale="log", xlabel="ω [rad/s]", ylabel="over boundary elements [dB]", ylim=(-12, 12))
    missing = table["springs, Geike spectrum over bem3d [dB]"][below]
    if missing.size:
        note = f"springs, Geike spectrum: {missing.max():.0f} dB and less"
        differences.annotate(note, (omega[0], -11.8), (omega[0], -10), fontsize=7, arrowprops={"arrowstyle": "->"})
    near = evidence.table("oscillation")
    x = near["omega [rad/s]"] / 1e3
    oscillation.plot(x, near["linear, 3D"], label="linear contact, 3D", **STYLES["linear, 3D"])
    oscillation.plot(
        x, near["springs, Geike spectrum"], color=MDR["color"], linewidth=1.0, label="springs, Geike spectrum"
    )
    oscillation.plot(
        x, near["bem3d"], color=BEM["color"], linewidth=1.2, linestyle=(0, (2, 1)), label="boundary elements"
    )
    oscillation.set(yscale="log", xlabel="ω [1000 rad/s]", ylabel="A [(m/s²)² s]")
    oscillation.legend(loc="upper right", fontsize=7)
    _contrast(contrast, evidence)
    return figure


def _contrast(axis: Axes, evidence: Evidence) -> None:
    """None where region 3 has no whole period."""
    if evidence.has_table("contrast"):
        table = evidence.table("contrast")
        omega = table["omega [rad/s]"] / 1e3
        axis.plot(omega, table["linear, 1D (14.12)"], label="sin²(q a), (14.12)", **STYLES["linear, 1D (14.12)"])
        for name, style in (("linear, 3D", {**GUIDE, "marker": "x"}), ("springs, Geike spectrum", MDR), ("bem3d", BEM)):
            ends = np.array([table[f"{name}, from"], table[f"{name}, to"]])
            bars = np.abs(ends - table[name])
            axis.errorbar(omega, table[name], yerr=bars, capsize=2, label=name, **style)
        axis.axhline(1.0, **GUIDE)
        axis.set(yscale="log", xlabel="ω [1000 rad/s]", ylabel="maxima over zeros of sin²(q a)")
        axis.set_ylim(top=3000)
        axis.legend(loc="upper center", fontsize=7, ncols=2)
