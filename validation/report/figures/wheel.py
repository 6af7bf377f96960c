"""Fig. 14.4, what moves it, and the contact of the wheel as the simulation has it."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import GUIDE, MDR, Style, graded, panels, visible

GREY: Style = {"color": "#aaaaaa", "linewidth": 3.0}
INK: Style = {"color": "#D55E00", "linewidth": 1.2}
GROUPS = ("v₀", "F_N", "q_min", "q_max", "H", "h₀")


def draw_contact(evidence: Evidence) -> Figure:
    place = {"left": 0.07, "right": 0.9, "bottom": 0.14, "top": 0.92, "wspace": 0.22}
    figure, (springs, pressure) = panels(1, 2, width=10.0, height=3.9, within=place)
    _springs(springs, evidence)
    table = evidence.table("pressure")
    x, y = np.unique(table["x / a"]), np.unique(table["y / a"])
    p = table["p / p0"].reshape(x.size, y.size)
    image = pressure.pcolormesh(x, y, visible(p).T, cmap="cividis", shading="nearest", rasterized=True)
    turn = np.linspace(0, 2 * np.pi, 200)
    pressure.plot(np.cos(turn), np.sin(turn), **{**GUIDE, "color": "#000000"})
    pressure.set(xlabel="x / a from below the wheel, along the track", ylabel="y / a", aspect="equal")
    pressure.set(xlim=(-1.35, 1.35), ylim=(-1.35, 1.35))
    beside = figure.add_axes((0.92, 0.2, 0.015, 0.64))
    figure.colorbar(image, cax=beside, label="p / p₀")
    return figure


def _springs(axis: Axes, evidence: Evidence) -> None:
    table = evidence.table("springs")
    x, wheel, track, compression = (table[name] for name in ("x / a", "wheel / d", "track / d", "compression / d"))
    step = max(1, round(x.size / 130))
    for i in range(0, x.size, step):
        carries = compression[i] > 0
        style: Style = {"color": "#000000", "linewidth": 0.9} if carries else {"color": "#bbbbbb", "linewidth": 0.5}
        # a spring ends under the wheel where it carries, else at the height of the track
        axis.plot([x[i], x[i]], [-1.6, track[i] - compression[i]], **style)
    axis.fill_between(x, -2.8, -2.8 + compression, color="#0072B2", alpha=0.55, linewidth=0)
    axis.plot(x, wheel, color="#D55E00", linewidth=1.8, label="wheel, x²/R - d")
    axis.plot(x, track, color="#000000", linewidth=0.9, linestyle="--", label="track before contact")
    axis.set(xlabel="x / a", ylabel="height / d; blue: compression", ylim=(-2.8, 0.95), xlim=(-1.4, 1.4))
    axis.legend(loc="upper center")


def draw(evidence: Evidence) -> Figure:
    table = evidence.table("spectrum")
    figure, (whole, region, contrast) = panels(1, 3, width=13.5, height=4.2)
    omega, mean = table["omega [rad/s]"], table["A [(m/s2)2 s]"]
    floor, linear, hann = table["floor"], table["linear"], table["Hann"]
    whole.plot(omega, visible(linear), label="linear theory", **GREY)
    spread: Style = {"color": "#D55E00", "alpha": 0.2, "linewidth": 0, "label": "10th to 90th percentile"}
    whole.fill_between(omega, table["lowest tenth"], table["highest tenth"], **spread)
    whole.plot(omega, mean, label="no window, (14.17)", **INK)
    whole.plot(omega, hann, color="#000000", linestyle="--", linewidth=1.0, label="Hann")
    whole.plot(omega, floor, label="floor predicted", **{**GUIDE, "color": "#0072B2"})
    whole.set(xscale="log", yscale="log", xlabel="ω [rad/s]", ylabel="A [(m/s²)² s]")
    whole.set(ylim=(0.3 * np.nanmin(hann), 20 * np.nanmax(mean)), xlim=(0.9 * omega[0], omega[-1]))
    _marks(whole, evidence)
    whole.legend(loc="upper right", fontsize=7)
    near = evidence.table("oscillation")
    omega = near["omega [rad/s]"]
    region.plot(omega / 1e3, visible(near["linear"]), label="linear theory", **GREY)
    region.plot(omega / 1e3, near["springs"], label="no window", **INK)
    region.plot(omega / 1e3, near["springs, Hann"], color="#000000", linestyle="--", linewidth=1.0, label="Hann")
    region.set(yscale="log", ylim=(0.01, 30), xlabel="ω [1000 rad/s]", ylabel="A over its mean law ω^(-2H-3)")
    region.legend(loc="upper left", ncols=3)
    _contrast(contrast, evidence)
    return figure


def _contrast(axis: Axes, evidence: Evidence) -> None:
    """None where region 3 has no whole period."""
    if evidence.has_table("contrast"):
        table = evidence.table("contrast")
        omega, found = table["omega [rad/s]"] / 1e3, table["springs, Hann"]
        bars = np.abs([table["springs, Hann, from"], table["springs, Hann, to"]] - found)
        axis.plot(omega, table["linear"], label="linear theory", **GREY)
        axis.errorbar(omega, found, yerr=bars, capsize=2, label="springs, Hann", **{**MDR, "marker": "o"})
        axis.axhline(1.0, **GUIDE)
        axis.set(yscale="log", xlabel="ω [1000 rad/s]", ylabel="maxima over zeros of sin²(q a)")
        axis.set_ylim(top=1000)
        axis.legend(loc="upper right")


def _marks(axis: Axes, evidence: Evidence) -> None:
    bottom, marks = axis.get_ylim()[0], evidence.table("marks")
    for name, omega in zip(marks["mark"], marks["omega [rad/s]"], strict=True):
        axis.axvline(omega, **GUIDE)
        axis.text(omega, 2 * bottom, name, rotation=90, va="bottom", ha="right", fontsize=7)


def draw_parameters(evidence: Evidence) -> Figure:
    table = evidence.table("variations")
    names = list(dict.fromkeys(table["scene"].tolist()))
    figure, axes = panels(2, 3, width=11.0, height=6.0, sharex=True, sharey="all")
    base = table.where(scene=names[0])
    for axis, group in zip(axes, GROUPS, strict=True):
        axis.plot(base["omega [rad/s]"], base["A [(m/s2)2 s]"], **GREY)
        mine = [name for name in names[1:] if name.startswith(group)]
        for i, name in enumerate(mine):
            rows, style = table.where(scene=name), graded(i, len(mine))
            style = {**style, "markersize": 3, "markevery": 6}
            axis.plot(rows["omega [rad/s]"], rows["A [(m/s2)2 s]"], label=name, **style)
        axis.set(xscale="log", yscale="log")
        if mine:
            axis.legend(loc="lower left", fontsize=7)
    for axis in axes[3:]:
        axis.set_xlabel("ω [rad/s]")
    for axis in axes[::3]:
        axis.set_ylabel("A [(m/s²)² s]")
    return figure
