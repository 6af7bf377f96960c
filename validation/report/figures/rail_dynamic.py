"""Figure of the contact filter of a wheel that moves."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.report.style import BEM, EXACT, GUIDE, MDR, graded, panels, tick

BEM3D, SPRINGS = "bem3d", "springs that read the surface"
SHADE = 1.5
"""Factor about the resonance."""
DECADES = 50, 100, 200, 500, 1000, 2000, 5000, 10000


def draw(evidence: Evidence) -> Figure:
    """Filters, and motion over constant load."""
    table = evidence.table("filters")
    figure, axes = panels(1, 2, height=4.2)
    _filters(axes[0], table.where(**{"dB over the curve": table["dB over the curve"].min()}))
    _changes(axes[1], table)
    for axis in axes:
        _frame(axis, table)
        axis.legend(loc="lower left")
    return figure


def _filters(axis: Axes, table: Table) -> None:
    f = table["f [Hz]"]
    axis.plot(f, table["linear theory [dB]"], color="#999999", linewidth=3, label="linear theory")
    axis.plot(f, table[f"{BEM3D}, constant [dB]"], **EXACT, label="bem3d, constant load")
    axis.plot(f, table[f"{BEM3D}, moving [dB]"], **BEM, label="bem3d, in motion")
    axis.plot(f, table[f"{SPRINGS}, moving [dB]"], **MDR, label="springs, in motion")
    axis.plot(f, table[f"{BEM3D}, inferred [dB]"], "x", color="#000000", markersize=5, label="from the force")
    axis.set(ylabel="contact filter A3 [dB]", ylim=(-30, 10))


def _changes(axis: Axes, table: Table) -> None:
    offsets = np.unique(table["dB over the curve"])
    for i, offset in enumerate(offsets):
        mine = table.where(**{"dB over the curve": offset})
        for model, fill, shift in ((BEM3D, {}, 0.985), (SPRINGS, {"markerfacecolor": "none"}, 1.015)):
            style = graded(i, len(offsets)) | {"linestyle": "-" if model == BEM3D else "none"} | fill
            axis.errorbar(
                mine["f [Hz]"] * shift,
                mine[f"{model}, change [dB]"],
                yerr=mine[f"{model}, ± change [dB]"],
                capsize=2,
                label=f"{'bem3d' if model == BEM3D else 'springs'}, {offset:+g} dB",
                **style,
            )
    for level in (-1, 1):
        axis.axhline(level, **GUIDE)
    axis.set(ylabel="in motion over constant load [dB]", ylim=(-15, 20))


def _frame(axis: Axes, table: Table) -> None:
    f, resonance = table["f [Hz]"], float(table["resonance [Hz]"][0])
    axis.axvspan(resonance / SHADE, resonance * SHADE, color="#eeeeee", zorder=0)
    last = float(f[table["judged"] == 1].max())
    axis.axvline(last * 10**0.05, color="#555555", linestyle="--", linewidth=1)
    axis.set(xscale="log", xlabel="f [Hz]", xlim=(f.min() / 1.15, f.max() * 1.15))
    tick(axis, [x for x in DECADES if f.min() / 1.15 <= x <= f.max() * 1.15])
