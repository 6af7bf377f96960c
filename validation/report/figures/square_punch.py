"""Figure of the flat punches."""

from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import BEM, EXACT, GUIDE, MDR_LINE, MDR_OTHER, panels


def draw(evidence: Evidence) -> Figure:
    """Stiffness of the square against the cell size, and the pressure along its middle."""
    figure, (stiffness_axis, pressure_axis) = panels(1, 2)
    levels = evidence.table("levels")
    level = dict(zip(levels["level"], levels["k / (E* L)"], strict=True))
    refinement = evidence.table("refinement")
    size = 1 / refinement["cells per side"]
    square = refinement["square k / (E* L)"]
    stiffness_axis.plot(size, square, label="boundary elements, square", **BEM)
    stiffness_axis.plot([0, size[-2]], [level["extrapolated"], square[-2]], label="first-order extrapolation", **GUIDE)
    stiffness_axis.plot(
        size, refinement["circle k / (2 E* a)"], label="boundary elements, circle", **{**BEM, "marker": "^"}
    )
    stiffness_axis.axhline(level["capacitance"], label="square, numerical capacitance", **EXACT)
    stiffness_axis.axhline(level["mdr L"], label="MDR, L_1D = L", **MDR_LINE)
    stiffness_axis.axhline(level["mdr 1.1523 L"], label="MDR, L_1D = 1.1523 L", **MDR_OTHER)
    stiffness_axis.set(xlabel="cell size dx / L", ylabel="stiffness k / (E* L); circle k / (2 E* a)", xlim=(0, None))
    stiffness_axis.legend(loc="center right")

    pressure = evidence.table("pressure")
    pressure_axis.semilogy(
        pressure["x / L"], pressure["p / mean p"], label="boundary elements", **{**BEM, "markersize": 2}
    )
    pressure_axis.set(xlabel="x / L, along the middle", ylabel="pressure p / mean(p)")
    pressure_axis.set_yticks([0.5, 1, 2, 4], ["0.5", "1", "2", "4"])
    pressure_axis.minorticks_off()
    pressure_axis.legend()
    return figure
