"""Figure of the fractal punch: Fig. 14.1 of the book and the means that belong to it."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.cases.fractal_punch_evidence import FEW_CELLS
from validation.evidence import Evidence, Table
from validation.report.style import BEM, GUIDE, MDR_LINE, MDR_OTHER, panels


def draw(evidence: Evidence) -> Figure:
    """A column for each Hurst exponent: mean stiffness above, relative standard deviation below."""
    curves = evidence.table("curves")
    hursts = np.unique(curves["H"])
    figure, axes = panels(2, len(hursts), height=5.6, sharex=True, sharey="row")
    for column, hurst in enumerate(hursts):
        mine = curves.where(H=hurst)
        above, below = axes[column], axes[len(hursts) + column]
        _compare(above, mine, "mean stiffness")
        _compare(below, mine, "relative deviation")
        above.set_title(f"H = {hurst:g}")
        below.set_xlabel("force Fbar = F / (E* h L)")
        force, stiffness = mine["Fbar"], mine["bem3d mean stiffness"]
        power = force ** (1 / (1 + hurst))
        pinned = np.argmin(np.abs(np.log(force / 0.1)))
        unsaturated = force <= 1
        guide = stiffness[pinned] * power / power[pinned]
        above.plot(force[unsaturated], guide[unsaturated], label="slope 1 / (1 + H)", **GUIDE)
    axes[0].set_ylabel("mean stiffness kbar = k / (E* L)")
    axes[len(hursts)].set(ylabel="relative standard deviation of k", ylim=(5e-4, 1))
    axes[0].legend(loc="lower right")
    return figure


def _compare(axis: Axes, curves: Table, name: str) -> None:
    force = curves["Fbar"]
    value, low, high = (_drawn(curves[f"bem3d {name}{end}"]) for end in ("", " low", " high"))
    for few, face in ((False, BEM["color"]), (True, "white")):
        drawn = (curves["bem3d cells in contact"] < FEW_CELLS) == few
        bars = [(value - low)[drawn], (high - value)[drawn]]
        label = "_" if few else "boundary elements"
        axis.errorbar(force[drawn], value[drawn], yerr=bars, capsize=2, label=label, markerfacecolor=face, **BEM)
    axis.plot(force, _drawn(curves[f"mdr {name}"]), label="MDR, L_1D = L", **MDR_LINE)
    low, high = _drawn(curves[f"mdr {name} low"]), _drawn(curves[f"mdr {name} high"])
    axis.fill_between(force, low, high, color=MDR_LINE["color"], alpha=0.25, linewidth=0)
    axis.plot(force, _drawn(curves[f"mdr 1.1523 L {name}"]), label="MDR, L_1D = 1.1523 L", **MDR_OTHER)
    axis.set(xscale="log", yscale="log")


def _drawn(values: np.ndarray) -> np.ndarray:
    """Zero, as in saturation, has no place on a logarithmic axis."""
    return np.where(np.isfinite(values) & (values > 0), values, np.nan)
