"""Figure of the smooth sphere."""

import numpy as np
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import BEM, EXACT, GUIDE, MDR, panels, tick


def draw(evidence: Evidence) -> Figure:
    """Load curve, pressure, and error of the force against the cells."""
    figure, (load_axis, pressure_axis, error_axis) = panels(1, 3)

    load = evidence.table("load")
    micrometres = 1e6 * load["approach [m]"]
    load_axis.plot(micrometres, load["hertz force [N]"], label="Hertz", **EXACT)
    load_axis.plot(micrometres, load["bem3d force [N]"], label="boundary elements", **BEM)
    load_axis.plot(micrometres, load["mdr force [N]"], label="MDR", **{**MDR, "markersize": 8})
    load_axis.set(xlabel="approach d [µm]", ylabel="force F [N]")
    load_axis.legend(loc="lower right")

    pressure = evidence.table("pressure")
    exact = evidence.table("exact-pressure")
    pressure_axis.plot(1e3 * exact["x [m]"], 1e-6 * exact["hertz pressure [Pa]"], label="Hertz", **EXACT)
    cells = 1e3 * pressure["x [m]"], 1e-6 * pressure["bem3d pressure [Pa]"]
    pressure_axis.plot(*cells, label="boundary elements", **BEM)
    pressure_axis.set(xlabel="distance from the centre [mm]", ylabel="pressure p [MPa]")
    pressure_axis.legend(loc="upper right")

    refinement = evidence.table("refinement")
    n = refinement["cells per contact radius"]
    error_axis.loglog(n, np.abs(refinement["bem3d force error"]), label="boundary elements", **BEM)
    error_axis.loglog(n, np.abs(refinement["mdr force error"]), label="MDR", **MDR)
    start = np.abs(refinement["bem3d force error"][0])
    error_axis.loglog(n, start * (n / n[0]) ** -2.0, label="second order", **GUIDE)
    error_axis.set(xlabel="cells per contact radius", ylabel="|F / F(Hertz) - 1|")
    tick(error_axis, n)
    error_axis.minorticks_off()
    error_axis.legend()
    return figure
