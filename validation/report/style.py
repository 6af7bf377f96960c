"""How figures look: read without colour, and drawn to the same bytes every time."""

import io
from collections.abc import Sequence

import matplotlib
from matplotlib.axes import Axes
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

# Okabe and Ito: apart for colour-blind readers; each with a marker and a dash of its own for print without colour
EXACT = {"color": "#000000", "linestyle": "-", "linewidth": 1.0}
BEM = {"color": "#0072B2", "marker": "o", "markersize": 4, "linestyle": "none"}
MDR = {"color": "#D55E00", "marker": "s", "markersize": 4, "markerfacecolor": "none", "linestyle": "none"}
MDR_LINE = {"color": "#D55E00", "linestyle": "-", "linewidth": 1.4}
MDR_OTHER = {"color": "#009E73", "linestyle": "--", "linewidth": 1.4}
GUIDE = {"color": "#999999", "linestyle": ":", "linewidth": 1.0}

SETTINGS = {
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


def panels(rows: int, columns: int, *, width: float = 9.0, height: float = 3.4, **share: bool | str) -> tuple[Figure, list[Axes]]:
    """A figure of lettered panels, row by row."""
    with matplotlib.rc_context(SETTINGS):
        figure = Figure(figsize=(width, height), layout="constrained")
        axes: Sequence[Axes] = figure.subplots(rows, columns, squeeze=False, **share).ravel()
        for letter, axis in zip("abcdefghijkl", axes, strict=False):
            axis.set_title(f"({letter})", loc="left")
        return figure, list(axes)


def svg(figure: Figure) -> bytes:
    """The same bytes for the same figure."""
    buffer = io.BytesIO()
    with matplotlib.rc_context(SETTINGS):
        FigureCanvasSVG(figure).print_svg(buffer, metadata={"Date": None})
    return buffer.getvalue()


def pdf(figure: Figure) -> bytes:
    """The same bytes for the same figure."""
    buffer = io.BytesIO()
    with matplotlib.rc_context(SETTINGS):
        FigureCanvasPdf(figure).print_pdf(buffer, metadata={"CreationDate": None})
    return buffer.getvalue()
