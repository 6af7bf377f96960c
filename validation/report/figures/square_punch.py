"""Figure of the flat punches."""

from matplotlib.figure import Figure

from validation.evidence import Evidence
from validation.report.style import BEM, EXACT, GUIDE, MDR_LINE, MDR_OTHER, panels


def draw(evidence: Evidence) -> Figure:
    """Stiffness of the square against the cell size, and the pressure along its middle."""
    figure, (stiffness_axis, pressure_axis) = panels(1, 2)
    numbers = {number.label: number for number in evidence.numbers}
    limit = numbers["bem3d: square punch, k / (E* L), extrapolated"]
    short = numbers["mdr: full contact with L_1D = L, k / (E* L)"]
    long = numbers["mdr: full contact with L_1D = 1.1523 L, k / (E* L)"]

    refinement = evidence.table("refinement")
    size = 1 / refinement["cells per side"]
    stiffness_axis.axhline(limit.reference, label="closed form", **EXACT)
    stiffness_axis.plot(size, refinement["square k / (E* L)"], label="boundary elements", **BEM)
    stiffness_axis.plot(
        [0, size[-2]], [limit.value, refinement["square k / (E* L)"][-2]], label="first-order extrapolation", **GUIDE
    )
    stiffness_axis.axhline(short.value, label="MDR, L_1D = L", **MDR_LINE)
    stiffness_axis.axhline(long.value, label="MDR, L_1D = 1.1523 L", **MDR_OTHER)
    stiffness_axis.set(xlabel="cell size dx / L", ylabel="stiffness k / (E* L)", xlim=(0, None))
    stiffness_axis.legend()

    pressure = evidence.table("pressure")
    pressure_axis.semilogy(
        pressure["x / L"], pressure["p / mean p"], label="boundary elements", **{**BEM, "markersize": 2}
    )
    pressure_axis.set(xlabel="x / L, along the middle", ylabel="pressure p / mean(p)")
    pressure_axis.legend()
    return figure
