"""Figures of where time stepping and springs fail: schemes about their limits; long runs, coarse springs, lift-off."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from validation.analysis.evidence import Evidence, Table
from validation.report.style import BEM, EXACT, GUIDE, MDR, graded, panels

COLORS = {
    "explicit Euler": ("#D55E00", "^"),
    "symplectic Euler": ("#009E73", "s"),
    "velocity Verlet": ("#0072B2", "o"),
    "Runge-Kutta": ("#000000", "D"),
}
LIMITS = {"symplectic Euler": 2.0, "velocity Verlet": 2.0, "Runge-Kutta": 8**0.5}
FLOOR = 1e-17

PLACE = {"left": 0.09, "right": 0.97, "bottom": 0.06, "top": 0.96, "wspace": 0.24, "hspace": 0.42}
"""Of six panels, by hand: laid out around their labels they end with other last bits now and then."""


def draw(evidence: Evidence) -> Figure:
    """Period, energy and growth of a linear vibration; the period on a Hertz contact."""
    figure, (period, energy, growth, hertz) = panels(2, 2, height=6.6)
    found = evidence.table("linear vibration")
    for name in COLORS:
        rows = found.where(scheme=name)
        _period(period, name, rows)
        _energy(energy, name, rows)
        _growth(growth, name, rows)
    period.set(xlabel="$\\omega\\,dt$", ylabel="relative error", title="period, linear", xscale="log", yscale="log")
    period.legend(loc="lower right")
    energy.set(xlabel="$\\omega\\,dt$", ylabel="relative change in one period", title="energy, linear")
    energy.set(xscale="log", yscale="log", ylim=(FLOOR, 30))
    energy.legend(loc="lower right", title="filled: drift, open: swing", title_fontsize=8)
    for limit in sorted(set(LIMITS.values())):
        growth.axvline(limit, **GUIDE)
    growth.set(xlabel="$\\omega\\,dt$", ylabel="growth in one step", title="near the limits", yscale="log")
    growth.set(xlim=(0.4, 3.3), ylim=(0.2, 10))
    growth.legend(loc="upper left")
    _hertz(hertz, evidence.table("Hertz vibration"))
    return figure


def _period(axis: Axes, name: str, rows: Table) -> None:
    color, marker = COLORS[name]
    x = rows["omega dt"]
    below = x < LIMITS.get(name, 2.0)
    theory = np.abs(x / rows["angle by theory [rad]"] - 1)
    axis.plot(x[below], theory[below], color=color, linewidth=0.8)
    axis.plot(x[below], rows["error of the period"][below], linestyle="none", color=color, marker=marker, label=name)
    axis.lines[-1].set(markersize=6 if name == "symplectic Euler" else 4, markerfacecolor=_face(name, color))


def _face(name: str, color: str) -> str:
    """Open where it lies under another scheme's."""
    return "none" if name == "symplectic Euler" else color


def _energy(axis: Axes, name: str, rows: Table) -> None:
    """Of schemes that drift, the drift; of those that do not, swing and drift."""
    color, marker = COLORS[name]
    x = rows["omega dt"]
    below = x < LIMITS.get(name, 2.0)
    drift = np.maximum(rows["drift of energy in a turn"], FLOOR)
    axis.plot(x[below], drift[below], linestyle="none", color=color, marker=marker, markersize=4, label=name)
    axis.plot(x[x < 1], rows["change by theory"][x < 1], color=color, linewidth=0.8)
    if name in ("symplectic Euler", "velocity Verlet"):
        swing = rows["change in a turn"][below]
        axis.plot(x[below], swing, linestyle="none", color=color, marker=marker, markersize=5, markerfacecolor="none")


def _growth(axis: Axes, name: str, rows: Table) -> None:
    color, marker = COLORS[name]
    x = rows["omega dt"]
    size = 7 if name == "symplectic Euler" else 4
    axis.plot(x, rows["growth by theory"], color=color, linewidth=0.8)
    axis.plot(x, rows["growth of a step"], linestyle="none", color=color, marker=marker, markersize=size, label=name)
    axis.lines[-1].set_markerfacecolor(_face(name, color))


def _hertz(axis: Axes, found: Table) -> None:
    releases = sorted(set(found["released at [d_N]"].tolist()))
    for name, dash in (("velocity Verlet", "-"), ("Runge-Kutta", "--")):
        for i, release in enumerate(releases):
            rows = found.where(**{"scheme": name, "released at [d_N]": release})
            label = f"{release:g}" if dash == "-" else None
            style = {**graded(i, len(releases)), "linestyle": dash}
            axis.plot(rows["omega dt"], rows["error of the period"], label=label, **style)
    axis.set(xlabel="$\\omega\\,dt$", ylabel="relative error", title="period, Hertz contact")
    axis.set(xscale="log", yscale="log")
    _marked(axis, (0.01, 0.03, 0.1, 0.3))
    axis.legend(title="released at, over $d_N$", title_fontsize=8, loc="lower right", ncols=2)


def _marked(axis: Axes, ticks: tuple[float, ...]) -> None:
    """Ticks of a logarithmic axis that spans little more than a decade."""
    axis.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axis.xaxis.set_minor_formatter(NullFormatter())


def draw_rough(evidence: Evidence) -> Figure:
    figure, axes = panels(3, 2, height=9.2, within=PLACE)
    _long(axes[0], evidence.table("long runs"))
    _spacing(axes[1], axes[2], evidence.table("spacing"))
    _lift(axes[3], axes[4], evidence.table("lift-off"))
    _laps(axes[5], evidence.table("rounds"))
    return figure


def _long(axis: Axes, found: Table) -> None:
    releases = sorted(set(found["released at [d_N]"].tolist()))
    for i, release in enumerate(releases):
        for name, dash in (("velocity Verlet", "-"), ("explicit Euler", "--")):
            rows = found.where(**{"scheme": name, "released at [d_N]": release})
            change = np.abs(rows["change of conserved quantity" if dash == "-" else "change of energy"])
            label = f"{name}, {release:.4g}"
            style = {**graded(i, len(releases)), "linestyle": dash}
            axis.plot(rows["steps"], np.maximum(change, FLOOR), label=label, **style)
    theory = found.where(scheme="explicit Euler", **{"released at [d_N]": releases[0]})
    axis.plot(theory["steps"], theory["linear theory"], **{**GUIDE, "linewidth": 2.0})
    axis.set(xlabel="steps", ylabel="|change of energy|", title="very long runs", yscale="log", ylim=(1e-15, 1e4))
    axis.legend(fontsize=7, ncols=2, loc="center right", bbox_to_anchor=(1.0, 0.55))


def _spacing(level: Axes, error: Axes, found: Table) -> None:
    heights = sorted(set(found["height [d_N]"].tolist()))
    for i, height in enumerate(heights):
        rows = found.where(**{"height [d_N]": height})
        style, carried = graded(i, len(heights)), rows["carried"] > 0
        x = rows["q_max dx"]
        level.plot(x[carried], rows["error of the last one-third octave [dB]"][carried], label=f"{height:g}", **style)
        level.plot(x[carried], rows["by linear theory [dB]"][carried], color=style["color"], linestyle=":")
        error.plot(x, rows["error of force over its fluctuation"], label=f"{height:g}", **style)
    for axis in (level, error):
        axis.axvline(np.pi / 2, **GUIDE)
        axis.axvline(np.pi, **GUIDE)
        axis.set(xlabel="$q_{max}\\,dx$", xscale="log")
        _marked(axis, (0.2, 0.5, 1.0, 2.0, 5.0))
        axis.legend(title="$h_{rms}/d_N$", title_fontsize=8, loc="upper left" if axis is level else "lower right")
    level.set(ylabel="error [dB]", title="last one-third octave")
    error.set(ylabel="error over fluctuation", title="force against spacing", yscale="log")


def _lift(airborne: Axes, highest: Axes, found: Table) -> None:
    sweeps = (("height", BEM, "height changed"), ("load", MDR, "load changed"))
    for sweep, style, label in sweeps:
        rows = found.where(sweep=sweep)
        airborne.plot(rows["height [d_N]"], rows["time airborne"], label=label, **style)
        highest.plot(rows["height [d_N]"], rows["highest force [F_N]"], label=label, **style)
    for sweep, dash in (("height", "-"), ("load", "--")):
        rows = found.where(sweep=sweep)
        x, pull, style = rows["height [d_N]"], 1 + rows["deepest linear pull [F_N]"], {**EXACT, "linestyle": dash}
        airborne.plot(x, rows["time airborne, linear"], label=f"linear force below zero, {sweep}", **style)
        highest.plot(x, pull, label=f"1 + largest linear tension, {sweep}", **style)
    airborne.set(xlabel="$h_{rms}/d_N$", ylabel="share of the time", title="in the air", xscale="log")
    airborne.set_yscale("symlog", linthresh=1e-4)
    airborne.set_ylim(-2e-5, 1)
    highest.set(xlabel="$h_{rms}/d_N$", ylabel="highest force / load", title="impacts", xscale="log", yscale="log")
    for axis in (airborne, highest):
        axis.legend(loc="upper left")


def _laps(axis: Axes, found: Table) -> None:
    for name in ("velocity Verlet", "explicit Euler"):
        rows = found.where(scheme=name)
        for what, face in (("free vibration", None), ("mean square acceleration", "none")):
            axis.errorbar(
                rows["laps"],
                np.exp(rows[f"{what}, log over first tenth"]),
                np.exp(rows[f"{what}, log over first tenth"]) * rows[f"{what}, half-width"],
                color=COLORS[name][0],
                marker=COLORS[name][1],
                markersize=4,
                markerfacecolor=face,
                linewidth=0.8,
                linestyle="none",
                label=f"{name}, {what}",
            )
    rows = found.where(scheme="explicit Euler")
    axis.plot(rows["laps"], np.exp(rows["linear theory"]), **GUIDE)
    axis.set(xlabel="laps", ylabel="over the first tenth", title="springs, rough track")
    axis.legend(fontsize=7, loc="upper left")
