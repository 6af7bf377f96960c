"""Figure of the sounds of a rail: 20 ms of each, and their levels."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.report.style import GUIDE, Style, tick

STYLES: tuple[Style, ...] = (
    {"color": "#0072B2", "linestyle": "-", "linewidth": 4.0},
    {"color": "#000000", "linestyle": "--", "linewidth": 1.0, "marker": "x", "markersize": 5},
    {"color": "#D55E00", "linestyle": "none", "marker": "s", "markersize": 6, "markerfacecolor": "none"},
    {"color": "#009E73", "linestyle": "-.", "linewidth": 1.2, "marker": "^", "markersize": 5},
)
DECADES = 50, 100, 200, 500, 1000, 2000, 5000, 10000


def draw(evidence: Evidence) -> Figure:
    """Waveforms, one under another, beside the levels."""
    waveforms = evidence.table("waveforms")
    figure = Figure(figsize=(9.0, 4.6), layout="constrained")
    names = list(waveforms.columns)[1:]
    axes = figure.subplot_mosaic([[name, "levels"] for name in names], width_ratios=(1.25, 1))
    _waveforms([axes[name] for name in names], waveforms)
    _levels(axes["levels"], evidence)
    axes[names[0]].set_title("(a)", loc="left")
    axes["levels"].set_title("(b)", loc="left")
    return figure


def _waveforms(axes: list[Axes], waveforms: Table) -> None:
    time, *names = waveforms.columns
    most = max(float(np.abs(waveforms[name]).max()) for name in names) / 1000
    for axis, name, style in zip(axes, names, STYLES, strict=False):
        axis.plot(waveforms[time], waveforms[name] / 1000, color=style["color"], linewidth=1.0)
        axis.set(ylim=(-1.1 * most, 1.1 * most), xlim=(0, waveforms[time][-1]), ylabel="F [kN]")
        axis.set_title(name.removesuffix(" [N]"), loc="right", pad=4)
        axis.tick_params(labelbottom=axis is axes[-1])
    axes[-1].set_xlabel("t [ms]")


def _levels(axis: Axes, evidence: Evidence) -> None:
    table, about = evidence.table("levels"), evidence.table("frequencies")
    f = table["f [Hz]"]
    for name, style in zip(list(table.columns)[1:], STYLES, strict=False):
        axis.plot(f, table[name], label=name.removesuffix(" [dB re 1 N]"), **style)
    for name, where in zip(about["what"], about["f [Hz]"], strict=True):
        axis.axvline(where, **(GUIDE if "contact" in name else GUIDE | {"linestyle": "--"}))
    highest = float(np.nanmax([table[name] for name in list(table.columns)[1:]]))
    axis.set(xscale="log", xlabel="f [Hz]", ylabel="level [dB re 1 N]", ylim=(highest - 45, highest + 5))
    tick(axis, [x for x in DECADES if f.min() / 1.15 <= x <= f.max() * 1.15])
    axis.legend(loc="lower left")
