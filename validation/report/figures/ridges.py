"""Figure of the ridges: where one dimension is exact in three."""

from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.cases.rolling.ridges import BEM as BEM3D
from validation.cases.rolling.ridges import SPRINGS
from validation.report.style import BEM, EXACT, GUIDE, MDR, graded, panels


def draw(evidence: Evidence) -> Figure:
    """The response through its zeros, and the errors of every grid."""
    found = evidence.table("responses")
    figure, (response, errors) = panels(1, 2)
    q = found["q a"]
    response.plot(q, found["sin(qa)/(qa)"] * q, label="(14.11)", **EXACT)
    errors_of = [name.rsplit(", ", 1)[0] for name in found.columns if name.endswith(", error")]
    finest = {method: [name for name in errors_of if name.startswith(method)][-1] for method in (BEM3D, SPRINGS)}
    for method, style, label in ((BEM3D, BEM, "boundary elements"), (SPRINGS, MDR, "springs")):
        some = slice(1 if method == BEM3D else 3, None, 4)
        response.plot(q[some], (found[f"{finest[method]}, real"] * q)[some], label=label, **style)
    response.set(xlabel="q a", ylabel="response times q a, over 2 E* a", title="amplitude and sign")
    response.set_ylim(-1.2, 1.6)
    response.legend(loc="upper right", ncols=3)
    grids = [name for name in errors_of if name.startswith(BEM3D)]
    for i, name in enumerate(grids):
        cells = name.split(", ")[1]
        style = {**graded(i, len(grids)), "linestyle": "none"}
        errors.plot(q[i::4], found[f"{name}, error"][i::4], label=f"boundary elements, {cells} cells", **style)
        bound = found[f"bound, {cells}"]
        errors.plot(q, bound, **{**GUIDE, "color": graded(i, len(grids))["color"]})
    springs = [name for name in errors_of if name.startswith(SPRINGS)]
    for name, dash in zip(springs, ("-", "--", "-.", ":"), strict=False):
        label = f"springs, {name.rsplit(', ', 1)[1]} to a radius"
        errors.plot(q, found[f"{name}, error"], color=MDR["color"], linestyle=dash, linewidth=1.1, label=label)
    errors.set(
        xlabel="q a", ylabel="error over the envelope", title="errors", yscale="log", xscale="log", ylim=(1e-7, 1)
    )
    errors.legend(fontsize=7, loc="lower right")
    return figure
