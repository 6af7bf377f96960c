"""Figures of rolling over isotropic roughness: Fig. 14.3, four curves, coherence, the map of validity."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.cases.rolling.force_spectrum_levels import LINEAR_1D, LINEAR_3D, MODELS, SPRINGS
from validation.report.style import BEM, EXACT, GUIDE, MDR, MDR_OTHER, graded, panels, tick, visible

POINTS_PER_CELL = 12
"""Of the map, for its border lines."""
LARGEST = 12.0
"""dB at which the colours of the map end."""


def draw_line(evidence: Evidence) -> Figure:
    found = evidence.table("spectrum")
    figure, (axis,) = panels(1, 1, width=6.4, height=4.2)
    q = found["q a"]
    axis.plot(q, found["linear 3D"], color="#999999", linewidth=3.0, label="linear theory, 3D")
    axis.plot(q, found["springs"], color=MDR["color"], marker=".", markersize=2.5, linestyle="none", label="springs")
    for formula, style in (("(14.12)", EXACT), ("(14.14)", {**MDR_OTHER, "linewidth": 1.8})):
        axis.plot(q, visible(found[formula]), label=formula, **style)
    top = float(found["linear 3D"].max())
    axis.set(xscale="log", yscale="log", ylim=(1e-7 * top, 6 * top))
    axis.set(xlabel="q a", ylabel="C_F / (F_Hertz² a (h/d)²)")
    _ticks(axis, q)
    axis.legend(loc="lower left")
    return figure


def draw(evidence: Evidence) -> Figure:
    """One panel a height: boundary elements, springs, linear theory in 1D and in 3D."""
    levels = evidence.table("levels")
    heights = np.unique(levels["h/d"])
    columns = min(3, heights.size)
    rows = -(-heights.size // columns)
    figure, axes = panels(rows, columns, height=0.8 + 2.5 * rows, sharex=True, sharey="all")
    top = float(levels[f"{LINEAR_3D} [dB]"].max())
    for axis, height in zip(axes, heights, strict=False):
        mine = levels.where(**{"h/d": height})
        q = mine["q a"]
        axis.plot(q, mine[f"{LINEAR_3D} [dB]"], label="linear theory, 3D", **EXACT)
        axis.plot(q, visible(mine[f"{LINEAR_1D} [dB]"], above=top - 60), label="linear theory, 1D (14.12)", **MDR_OTHER)
        axis.plot(q, visible(mine[f"{SPRINGS} [dB]"], above=top - 60), label="springs", **MDR)
        bars = mine["± sample [dB]"] + mine["± grid [dB]"]
        axis.errorbar(q, mine["bem3d [dB]"], yerr=bars, capsize=2, label="boundary elements", **BEM)
        axis.axvspan(0.9 * q[0], 1.0, color="#000000", alpha=0.06, linewidth=0)
        axis.set(xscale="log", ylim=(top - 55, top + 6), xlim=(0.9 * q[0], 1.1 * q[-1]))
        axis.set_title(f"h/d = {height:g}")
        _ticks(axis, q)
    for axis in axes[heights.size :]:
        axis.set_visible(False)
    for axis in axes[::columns]:
        axis.set_ylabel("one-third octave level [dB]")
    for axis in axes[(rows - 1) * columns :]:
        axis.set_xlabel("q a")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def draw_coherence(evidence: Evidence) -> Figure:
    """Coherence with linear theory, change of level by nonlinearity, and the force itself."""
    levels, forces = evidence.table("levels"), evidence.table("forces")
    heights = np.unique(levels["h/d"])
    figure, (coherence, departure, force) = panels(1, 3, width=10.5, height=3.6)
    for i, height in enumerate(heights):
        mine, style = levels.where(**{"h/d": height}), graded(i, heights.size)
        q, inside = mine["q a"], np.isfinite(mine[f"{LINEAR_1D} [dB]"]) & (mine["q a"] > 1)
        open_ = {**style, "markerfacecolor": "white", "linestyle": ":"}
        coherence.plot(q, mine["coherence of bem3d"], label=f"h/d = {height:g}", **style)
        coherence.plot(q[inside], mine["coherence of springs"][inside], **open_)
        departure.plot(q, -mine[f"{LINEAR_3D} over bem3d [dB]"], **style)
        springs = mine[f"{SPRINGS} [dB]"] - mine[f"{LINEAR_1D} [dB]"]
        departure.plot(q[inside], springs[inside], **open_)
    coherence.set(xscale="log", xlabel="q a", ylabel="coherence", ylim=(-0.03, 1.05), title="with linear theory")
    departure.set(xscale="log", xlabel="q a", ylabel="nonlinear over linear [dB]", title="level")
    for axis in (coherence, departure):
        _ticks(axis, levels["q a"])
    coherence.legend(fontsize=7, loc="lower left")
    for i, height in enumerate(heights[[0, heights.size // 2, -1]]):
        mine = forces.where(**{"h/d": height})
        x, of_bem, of_linear = mine["x / a"], mine["bem3d"], mine["linear 3D"]
        step = 3.2 * (2 - i)
        force.plot(x, (of_bem - of_bem.mean()) / height + step, color=BEM["color"], linewidth=1.2)
        force.plot(x, (of_linear - of_linear.mean()) / height + step, **{**EXACT, "linestyle": ":", "linewidth": 1.2})
        force.text(x[0], step + 1.1, f"h/d = {height:g}", fontsize=7)
    force.set(xlabel="x / a", ylabel="(F - mean) / (F_Hertz h/d), shifted", title="force along the track", yticks=[])
    return figure


def draw_map(evidence: Evidence) -> Figure:
    levels = evidence.table("levels")
    place = {"left": 0.08, "right": 0.8, "bottom": 0.08, "top": 0.95, "wspace": 0.06, "hspace": 0.14}
    figure, axes = panels(2, 2, height=6.6, sharex=True, sharey="all", within=place)
    heights, q = np.unique(levels["h/d"]), np.unique(levels["q a"])
    across = np.unique(np.append(levels["from"], levels["to"][-1]))
    up = _cell_edges(heights)
    fine_q, fine_h = _points_in_cells(across), _points_in_cells(up)
    for axis, model in zip(axes, MODELS, strict=True):
        errors = levels[f"{model} over bem3d [dB]"].reshape(heights.size, q.size)
        shown = np.clip(np.where(np.isfinite(errors), errors, -99.0), -LARGEST, LARGEST)
        image = axis.pcolormesh(across, up, shown, cmap="PuOr", vmin=-LARGEST, vmax=LARGEST)
        cells = np.kron(shown, np.ones((POINTS_PER_CELL, POINTS_PER_CELL)))
        for border, dash in ((1.0, "solid"), (3.0, "dashed")):
            levels_at = [-border, border]
            axis.contour(fine_q, fine_h, cells, levels=levels_at, colors="black", linestyles=dash, linewidths=1.1)
        # too low and too high are alike without colour
        axis.contourf(fine_q, fine_h, cells, levels=[-2 * LARGEST, -3], colors="none", hatches=["//"])
        axis.axvline(1.0, **{**GUIDE, "color": "#000000"})
        axis.set(xscale="log", yscale="log", title=model)
        axis.set_yticks(heights, [f"{height:g}" for height in heights])
        axis.yaxis.minorticks_off()
        axis.grid(visible=False)
        _ticks(axis, q)
    slopes = [levels.where(**{"h/d": height})["h' a/d"][0] for height in heights]
    for left, right in zip(axes[::2], axes[1::2], strict=True):
        left.set_ylabel("h / d")
        # the same levels, named by the other parameter
        second = right.twinx()
        second.set(yscale="log", ylim=right.get_ylim(), ylabel="h' a / d")
        second.set_yticks(heights, [f"{slope:.2g}" for slope in slopes])
        second.yaxis.minorticks_off()
        second.grid(visible=False)
    for axis in axes[2:]:
        axis.set_xlabel("q a")
    beside = figure.add_axes((0.9, 0.25, 0.02, 0.55))
    figure.colorbar(image, cax=beside, label="level over boundary elements [dB]", extend="both")
    return figure


def _cell_edges(values: np.ndarray) -> np.ndarray:
    """Edges of cells around values on a logarithmic axis."""
    logs = np.log(values)
    middles = (logs[1:] + logs[:-1]) / 2
    first, last = logs[0] - (middles[0] - logs[0]), logs[-1] + (logs[-1] - middles[-1])
    return np.asarray(np.exp(np.concatenate([[first], middles, [last]])))


def _points_in_cells(borders: np.ndarray) -> np.ndarray:
    """So many in each cell that contours run along cells and not across them."""
    logs = np.log(borders)
    part = (np.arange(POINTS_PER_CELL) + 0.5) / POINTS_PER_CELL
    return np.asarray(np.exp((logs[:-1, np.newaxis] + np.diff(logs)[:, np.newaxis] * part).ravel()))


def _ticks(axis: Axes, q: np.ndarray) -> None:
    tick(axis, [qa for qa in (0.2, 0.5, 1, 2, 5, 10, 20) if 0.85 * q.min() <= qa <= 1.2 * q.max()])
