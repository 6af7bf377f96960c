"""Figure of the fractal punch: Fig. 14.1 of the book and the means that belong to it."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.evidence import Evidence, Table
from validation.report.style import BEM, MDR_LINE, MDR_OTHER, panels


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
        below.set_xlabel("force F / (E* h L)")
    axes[0].set_ylabel("mean stiffness k / (E* L)")
    axes[len(hursts)].set(ylabel="relative standard deviation of k", ylim=(1e-3, 1))
    axes[0].legend(loc="lower right")
    return figure


def _compare(axis: Axes, curves: Table, name: str) -> None:
    force = curves["Fbar"]
    value, low, high = (_drawn(curves[f"bem3d {name}{end}"]) for end in ("", " low", " high"))
    axis.errorbar(force, value, yerr=[value - low, high - value], capsize=2, label="boundary elements", **BEM)
    axis.plot(force, _drawn(curves[f"mdr {name}"]), label="MDR, L_1D = L", **MDR_LINE)
    low, high = _drawn(curves[f"mdr {name} low"]), _drawn(curves[f"mdr {name} high"])
    axis.fill_between(force, low, high, color=MDR_LINE["color"], alpha=0.25, linewidth=0)
    axis.plot(force, _drawn(curves[f"mdr 1.1523 L {name}"]), label="MDR, L_1D = 1.1523 L", **MDR_OTHER)
    axis.set(xscale="log", yscale="log")


def _drawn(values: np.ndarray) -> np.ndarray:
    """Zero, as in saturation, has no place on a logarithmic axis."""
    return np.where(np.isfinite(values) & (values > 0), values, np.nan)
