"""How figures look: read without colour, and drawn to the same bytes every time."""

import io
from collections.abc import Callable
from typing import Any, Literal

import matplotlib
from matplotlib.axes import Axes
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from validation.evidence import Evidence

Style = dict[str, Any]

# Okabe and Ito: apart for colour-blind readers; each with a marker and a dash of its own for print without colour
EXACT: Style = {"color": "#000000", "linestyle": "-", "linewidth": 1.0}
BEM: Style = {"color": "#0072B2", "marker": "o", "markersize": 4, "linestyle": "none"}
MDR: Style = {"color": "#D55E00", "marker": "s", "markersize": 4, "markerfacecolor": "none", "linestyle": "none"}
MDR_LINE: Style = {"color": "#D55E00", "linestyle": "-", "linewidth": 1.4}
MDR_OTHER: Style = {"color": "#009E73", "linestyle": "--", "linewidth": 1.4}
GUIDE: Style = {"color": "#555555", "linestyle": ":", "linewidth": 1.3}

SETTINGS: Any = {
    "svg.hashsalt": "validation",
    "svg.fonttype": "path",
    "pdf.fonttype": 42,
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.5,
    "legend.fontsize": 8,
    "legend.framealpha": 0.9,
}


def panels(
    rows: int,
    columns: int,
    *,
    width: float = 9.0,
    height: float = 3.4,
    sharex: bool = False,
    sharey: Literal["none", "row"] = "none",
) -> tuple[Figure, list[Axes]]:
    """A figure of lettered panels, row by row."""
    figure = Figure(figsize=(width, height), layout="constrained")
    axes = list(figure.subplots(rows, columns, squeeze=False, sharex=sharex, sharey=sharey).flat)
    for letter, axis in zip("abcdefghijkl", axes, strict=False):
        axis.set_title(f"({letter})", loc="left")
    return figure, axes


def drawn(draw: Callable[[Evidence], Figure], evidence: Evidence) -> Figure:
    """A case's figure in this style."""
    with matplotlib.rc_context(SETTINGS):
        return draw(evidence)


def svg(figure: Figure) -> bytes:
    """The same bytes for the same figure."""
    buffer = io.BytesIO()
    with matplotlib.rc_context(SETTINGS):
        FigureCanvasSVG(figure).print_svg(buffer, metadata={"Date": None})  # type: ignore[no-untyped-call]
    return buffer.getvalue()


def pdf(figure: Figure) -> bytes:
    """The same bytes for the same figure."""
    buffer = io.BytesIO()
    with matplotlib.rc_context(SETTINGS):
        FigureCanvasPdf(figure).print_pdf(  # type: ignore[no-untyped-call]
            buffer, metadata={"CreationDate": None}
        )
    return buffer.getvalue()
