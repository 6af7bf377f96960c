"""Figure of the periodic wave."""

import numpy as np
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import EXACT, GUIDE, Style, panels, tick

MARKS = ("o", "s", "^", "D", "v", "P")
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")

OPEN: Style = {"linestyle": "none", "markersize": 4, "markerfacecolor": "none"}


def draw(evidence: Evidence) -> Figure:
    """Pressure at each load, and its error against the cells."""
    figure, (pressure_axis, error_axis) = panels(1, 2)
    pressure, refinement = evidence.table("pressure"), evidence.table("refinement")
    for load, mark, colour in zip(np.unique(pressure["mean p / p*"]), MARKS, COLOURS, strict=False):
        style: Style = {**OPEN, "marker": mark, "color": colour}
        rows = pressure["mean p / p*"] == load
        x, exact = pressure["x / wavelength"][rows], pressure["westergaard p / p*"][rows]
        computed = pressure["bem3d p / p*"][rows]
        few = slice(None, None, max(1, x.size // 64))
        pressure_axis.plot(x, exact, **EXACT)
        pressure_axis.plot(x[few], computed[few], label=f"mean p = {load:g} p*", **style)
        rows = refinement["mean p / p*"] == load
        cells, error = refinement["cells per wavelength"][rows], refinement["relative L2 error"][rows]
        error_axis.loglog(cells, error, label=f"mean p = {load:g} p*", **style)
        if load == 0.5:
            error_axis.loglog(cells, error[0] * cells[0] / cells, label="first order", **GUIDE)
    pressure_axis.plot([], [], label="Westergaard", **EXACT)
    pressure_axis.set(xlabel="x / wavelength", ylabel="pressure p / p*", xlim=(-0.5, 0.85))
    pressure_axis.legend(loc="center right")
    error_axis.set(xlabel="cells per wavelength", ylabel="relative L2 error of the pressure", ylim=(2e-5, None))
    tick(error_axis, cells)
    error_axis.minorticks_off()
    error_axis.legend(loc="lower left", ncols=2)
    return figure
