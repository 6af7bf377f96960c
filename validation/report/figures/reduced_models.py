"""Figures of the reduced models of a rolling wheel: how far each is off boundary elements, and for what work."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.cases.rolling.reduced_models import BED, COARSEST, LAYER, LINE, LINEAR, READ
from validation.report.style import GUIDE, graded, panels, tick

SHOWN = (LINE, LINEAR, BED, READ, LAYER, COARSEST)
"""As curves; all models have a point in (d)."""


def draw(evidence: Evidence) -> Figure:
    """Over h' a/d, over the wavenumber, and over the work."""
    table, bands = evidence.table("reduced_models"), evidence.table("one_third_octaves")
    figure, (over_slope, level, coherence, cost) = panels(2, 2, height=6.4)
    for i, model in enumerate(SHOWN):
        style = graded(i, len(SHOWN))
        mine, of_bands = table.where(model=model), bands.where(model=model)
        order = mine["h' a/d"].argsort()
        x, y, half = (mine[name][order] for name in ("h' a/d", "rms [dB]", "± rms [dB]"))
        over_slope.errorbar(x, y, yerr=half, capsize=2, label=model, **style)
        level.errorbar(of_bands["q a"], of_bands["over bem3d [dB]"], yerr=of_bands["± [dB]"], capsize=2, **style)
        coherence.plot(of_bands["q a"], of_bands["coherence"], **style)
    _draw_cost(cost, table.where(**{"h' a/d": bands["h' a/d"][0]}))
    over_slope.set(xlabel="h' a/d", ylabel="rms over octaves [dB]", title="over roughness", xscale="log")
    over_slope.set_ylim(bottom=0)
    level.set(xlabel="q a", ylabel="level over boundary elements [dB]", title="in one-third octaves", xscale="log")
    coherence.set(xlabel="q a", ylabel="coherence", title="position by position", xscale="log", ylim=(0, 1.02))
    slopes, q = table["h' a/d"], bands["q a"]
    tick(over_slope, [x for x in (0.03, 0.1, 0.3, 1, 3) if slopes.min() / 1.5 <= x <= 1.5 * slopes.max()])
    for axis in (level, coherence):
        tick(axis, [x for x in (0.3, 1, 2, 4, 8) if q.min() / 1.3 <= x <= 1.3 * q.max()])
    for axis, at in ((over_slope, 1.0), (cost, 1.0), (level, 0.0)):
        axis.axhline(at, **GUIDE)
    figure.legend(*over_slope.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _draw_cost(axis: Axes, table: Table) -> None:
    """A point a model but for boundary elements themselves, the first of the table."""
    for model in table["model"][1:]:
        mine = table.where(model=model)
        shown = graded(SHOWN.index(model), len(SHOWN)) if model in SHOWN else {"color": "0.5", "marker": "x"}
        x, y = mine["work over springs on a line"][:1], mine["rms [dB]"][:1]
        axis.plot(x, y, **{**shown, "linestyle": "none"})
        if model not in SHOWN:
            side = {"xytext": (4, 3)} if x[0] < 100 else {"xytext": (-4, 3), "ha": "right"}
            axis.annotate(str(model), (x[0], y[0]), textcoords="offset points", fontsize=6, **side)
    axis.set(xlabel="work over springs on a line", ylabel="rms over octaves [dB]", title="error over work")
    axis.set(xscale="log", yscale="log")


def draw_map(evidence: Evidence) -> Figure:
    """The error of each model over h' a/d, and the largest up to there."""
    table = evidence.table("reduced_models")
    slopes = table["h' a/d"]
    figure, (axis,) = panels(1, 1, height=4.4)
    axis.set_title("", loc="left")
    largest = []
    for i, model in enumerate(SHOWN):
        mine = table.where(model=model)
        order = mine["h' a/d"].argsort()
        x, y, half = (mine[name][order] for name in ("h' a/d", "rms [dB]", "± rms [dB]"))
        style = graded(i, len(SHOWN))
        axis.errorbar(x, y, yerr=[np.minimum(half, 0.9 * y), half], capsize=2, **{**style, "linestyle": "none"})
        axis.plot(x, np.maximum.accumulate(y), color=style["color"], linewidth=1.4)
        largest.append(float(y.max()))
    for model, at, error in zip(SHOWN, _apart(largest), largest, strict=True):
        end, place = (slopes.max(), error), (1.25 * slopes.max(), at)
        axis.annotate(model, end, place, va="center", fontsize=8, arrowprops={"arrowstyle": "-", "linewidth": 0.5})
    axis.axhspan(1e-9, 1.0, color="#eeeeee", zorder=0)
    lowest = min(float(table.where(model=model)["rms [dB]"].min()) for model in SHOWN)
    axis.set(xscale="log", yscale="log", ylim=(0.6 * lowest, 1.6 * max(_apart(largest))))
    axis.set(xlim=(slopes.min() / 1.2, 4 * slopes.max()), xlabel="h' a/d", ylabel="rms over octaves [dB]")
    tick(
        axis,
        [
            x
            for x in (0.03, 0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2, 3, 5, 8)
            if slopes.min() / 1.2 <= x <= 1.2 * slopes.max()
        ],
    )
    errors = [y for y in (0.03, 0.1, 0.3, 1, 3, 10, 30) if axis.get_ylim()[0] <= y <= axis.get_ylim()[1]]
    axis.set_yticks(errors, [f"{error:g}" for error in errors])
    axis.yaxis.minorticks_off()
    return figure


def _apart(values: list[float], ratio: float = 1.35) -> list[float]:
    """Places for labels on a logarithmic axis, in the order of the values, each so many times the one below."""
    places, below = values.copy(), 0.0
    for i in sorted(range(len(values)), key=values.__getitem__):
        places[i] = below = max(values[i], ratio * below)
    return places
