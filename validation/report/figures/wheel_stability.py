"""Figures of where time stepping and springs fail: schemes about their limits; long runs, coarse springs, lift-off."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.report.style import BEM, EXACT, GUIDE, MDR, Style, graded, panels, tick, visible

SCHEMES: dict[str, Style] = {
    "explicit Euler": {"color": "#D55E00", "marker": "^"},
    "symplectic Euler": {"color": "#009E73", "marker": "s", "markersize": 6.5, "markerfacecolor": "none"},
    "velocity Verlet": {"color": "#0072B2", "marker": "o"},
    "Runge-Kutta": {"color": "#000000", "marker": "D"},
}
"""Symplectic Euler is open: it lies under another scheme."""
LIMITS = {"symplectic Euler": 2.0, "velocity Verlet": 2.0, "Runge-Kutta": 8**0.5}
FLOOR = 1e-17

PLACE = {"left": 0.09, "right": 0.97, "bottom": 0.06, "top": 0.96, "wspace": 0.24, "hspace": 0.42}
"""Of six panels, by hand: laid out around their labels they end with other last bits now and then."""


def draw(evidence: Evidence) -> Figure:
    """Period, energy and growth of a linear vibration; the period on a Hertz contact."""
    figure, (period, energy, growth, hertz) = panels(2, 2, height=6.6)
    found = evidence.table("linear vibration")
    for name in SCHEMES:
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


def _points(axis: Axes, x: np.ndarray, y: np.ndarray, name: str, **style: Any) -> None:
    axis.plot(x, y, **{"linestyle": "none", "markersize": 4, **SCHEMES[name], **style})


def _period(axis: Axes, name: str, rows: Table) -> None:
    x = rows["omega dt"]
    below = x < LIMITS.get(name, 2.0)
    # ten digits of an angle hold no smaller difference
    theory = visible(np.abs(x / rows["angle by theory [rad]"] - 1), above=1e-8)
    axis.plot(x[below], theory[below], color=SCHEMES[name]["color"], linewidth=0.8)
    _points(axis, x[below], rows["error of the period"][below], name, label=name)


def _energy(axis: Axes, name: str, rows: Table) -> None:
    """Of schemes that drift, the drift; of those that do not, swing and drift."""
    x, color = rows["omega dt"], SCHEMES[name]["color"]
    below = x < LIMITS.get(name, 2.0)
    drift = np.maximum(rows["drift of energy in a turn"], FLOOR)
    _points(axis, x[below], drift[below], name, label=name, markersize=4, markerfacecolor=color)
    axis.plot(x[x < 1], rows["change by theory"][x < 1], color=color, linewidth=0.8)
    if name in ("symplectic Euler", "velocity Verlet"):
        _points(axis, x[below], rows["change in a turn"][below], name, markersize=5, markerfacecolor="none")


def _growth(axis: Axes, name: str, rows: Table) -> None:
    x = rows["omega dt"]
    axis.plot(x, rows["growth by theory"], color=SCHEMES[name]["color"], linewidth=0.8)
    _points(axis, x, rows["growth of a step"], name, label=name)


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
    tick(axis, (0.01, 0.03, 0.1, 0.3))
    axis.legend(title="released at, over $d_N$", title_fontsize=8, loc="lower right", ncols=2)


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
        tick(axis, (0.2, 0.5, 1.0, 2.0, 5.0))
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
            growth = np.exp(rows[f"{what}, log over first tenth"])
            style = {**SCHEMES[name], "markersize": 4, "markerfacecolor": face, "linewidth": 0.8, "linestyle": "none"}
            axis.errorbar(rows["laps"], growth, growth * rows[f"{what}, half-width"], label=f"{name}, {what}", **style)
    rows = found.where(scheme="explicit Euler")
    axis.plot(rows["laps"], np.exp(rows["linear theory"]), **GUIDE)
    axis.set(xlabel="laps", ylabel="over the first tenth", title="springs, rough track")
    axis.legend(fontsize=7, loc="upper left")
