"""Figure of the ridges: where one dimension is exact in three."""

from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.cases.rolling.ridges import BEM as BEM3D
from validation.cases.rolling.ridges import SPRINGS
from validation.report.style import BEM, EXACT, GUIDE, MDR, graded, panels


def draw(evidence: Evidence) -> Figure:
    """The response through its zeros, and the errors of every grid."""
    found, grids = evidence.table("responses"), evidence.table("errors")
    figure, (response, errors) = panels(1, 2)
    q = found["q a"]
    response.plot(q, found["sin(qa)/(qa)"] * q, label="(14.11)", **EXACT)
    cells, springs = (grids.where(method=method)["to a radius"] for method in (BEM3D, SPRINGS))
    for name, first, style, label in (
        (f"{BEM3D}, {cells[-1]:g}", 1, BEM, "boundary elements"),
        (f"{SPRINGS}, {springs[-1]:g}", 3, MDR, "springs"),
    ):
        some = slice(first, None, 4)
        response.plot(q[some], (found[f"{name}, real"] * q)[some], label=label, **style)
    response.set(xlabel="q a", ylabel="response times q a, over 2 E* a", title="amplitude and sign")
    response.set_ylim(-1.2, 1.6)
    response.legend(loc="upper right", ncols=3)
    for i, n in enumerate(cells):
        style = {**graded(i, cells.size), "linestyle": "none"}
        error = found[f"{BEM3D}, {n:g}, error"]
        errors.plot(q[i::4], error[i::4], label=f"boundary elements, {n:g} cells", **style)
        errors.plot(q, found[f"bound, {n:g}"], **{**GUIDE, "color": graded(i, cells.size)["color"]})
    for n, dash in zip(springs, ("-", "--", "-.", ":"), strict=False):
        style = {"color": MDR["color"], "linestyle": dash, "linewidth": 1.1}
        errors.plot(q, found[f"{SPRINGS}, {n:g}, error"], label=f"springs, {n:g} to a radius", **style)
    errors.set(
        xlabel="q a", ylabel="error over the envelope", title="errors", yscale="log", xscale="log", ylim=(1e-7, 1)
    )
    errors.legend(fontsize=7, loc="lower right")
    return figure
