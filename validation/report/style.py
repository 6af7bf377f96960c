"""The style of figures: readable without colour, and the same bytes every time."""

import io
import textwrap
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any, Literal

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.text import Text
from matplotlib.ticker import LogFormatter

from validation.analysis.evidence import Evidence, Table
from validation.report.compact import compact

Style = dict[str, Any]

# Okabe and Ito: apart for colour-blind readers; each with a marker and a dash of its own for print without colour
EXACT: Style = {"color": "#000000", "linestyle": "-", "linewidth": 1.0}
BEM: Style = {"color": "#0072B2", "marker": "o", "markersize": 4, "linestyle": "none"}
MDR: Style = {"color": "#D55E00", "marker": "s", "markersize": 4, "markerfacecolor": "none", "linestyle": "none"}
MDR_LINE: Style = {"color": "#D55E00", "linestyle": "-", "linewidth": 1.4}
MDR_OTHER: Style = {"color": "#009E73", "linestyle": "--", "linewidth": 1.4}
MARKERS = "osD^v<>ph*"
GUIDE: Style = {"color": "#555555", "linestyle": ":", "linewidth": 1.3}


def graded(i: int, count: int) -> Style:
    """The i-th of several curves in their order: from dark to light, each with a marker of its own."""
    color = matplotlib.colormaps["cividis"](0.78 * i / max(count - 1, 1))
    return {"color": color, "marker": MARKERS[i % len(MARKERS)], "markersize": 4, "linewidth": 1.0}


CURVES: tuple[Style, ...] = (
    {**EXACT, "linewidth": 2.2},
    {**BEM, "linestyle": "-", "markersize": 5.5, "markerfacecolor": "none", "linewidth": 0.8},
    {"color": "#D55E00", "linestyle": "--", "marker": "s", "markersize": 3.5, "linewidth": 1.2},
    {"color": "#009E73", "linestyle": "-.", "marker": "^", "markersize": 4, "linewidth": 1.2},
    {"color": "#CC79A7", "linestyle": ":", "marker": "D", "markersize": 3.5, "linewidth": 1.4},
)


def curve(i: int) -> Style:
    """The i-th of up to five curves: apart in colour, and in grey by dash and marker."""
    return dict(CURVES[i % len(CURVES)])


def in_two_lines(words: str, most: int = 90) -> str:
    """A title or a name of any length, of so many characters a line: 90 are as wide as a figure."""
    return "\n".join(textwrap.wrap(words, most, max_lines=2, placeholder=" ..."))


FAMILIES = ("DejaVu Sans", "Verdana", "sans-serif")
"""The first lays a figure out; a page without it takes the next, which is as wide."""
SETTINGS: Any = {
    "svg.hashsalt": "validation",
    # text stays text: it can be found and copied, and takes a third of the bytes of its outlines
    "svg.fonttype": "none",
    "font.sans-serif": FAMILIES,
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
    sharey: Literal["none", "row", "all"] = "none",
    within: dict[str, float] | None = None,
) -> tuple[Figure, list[Axes]]:
    """A figure of lettered panels, row by row.

    within: left, right, bottom, top, wspace, hspace of the panels; by default they are laid out around their labels.
    """
    figure = Figure(figsize=(width, height), layout=None if within else "constrained")
    axes = list(figure.subplots(rows, columns, squeeze=False, sharey=sharey, gridspec_kw=within).flat)
    for letter, axis in zip("abcdefghijkl", axes, strict=False):
        axis.set_title(f"({letter})", loc="left")
    return figure, axes


def tick(axes: Axes, values: Iterable[float], *, up: bool = False) -> None:
    """Ticks of the horizontal axis, or of the vertical one, at these values alone."""
    values, axis = list(values), axes.yaxis if up else axes.xaxis
    axis.set_ticks(values, [f"{value:g}" for value in values])
    axis.minorticks_off()


def visible(values: np.ndarray, *, above: float = 0.0) -> np.ndarray:
    """NaN in place of what a logarithmic axis, or one that ends there, has no room for."""
    return np.where(np.isfinite(values) & (values > above), values, np.nan)


FORMATS = {"svg": "Date", "png": "Software", "pdf": "CreationDate"}
"""Of pictures, each with what would make their bytes differ from one time or version to the next."""


def plain(text: str) -> str:
    """A text of a user's in a figure, in which a $ is no mathematics."""
    return text.replace("$", r"\$")


def plain_figure(figure: Figure) -> None:
    """Make all of its texts `plain`, once; but for the numbers that a logarithmic axis makes."""
    for text in figure.findobj(Text):
        text.set_text(plain(text.get_text()))
    for axis in figure.findobj(Axis):
        labels = [label.get_text() for label in axis.get_majorticklabels()]
        if any("$" in label for label in labels) and not isinstance(axis.get_major_formatter(), LogFormatter):
            axis.set_ticklabels([plain(label) for label in labels])


def drawn(draw: Callable[[Evidence], Figure], evidence: Evidence, profile: str) -> Figure:
    """A case's figure in this style, stamped where it is not the real size. The texts of its tables are no markup."""

    def as_text(cells: Sequence[object]) -> list[object]:
        return [plain(cell) if isinstance(cell, str) else cell for cell in cells]

    tables = tuple(Table(t.name, {name: as_text(cells) for name, cells in t.columns.items()}) for t in evidence.tables)
    with matplotlib.rc_context(SETTINGS):
        figure = draw(replace(evidence, tables=tables))
        engine = figure.get_layout_engine()
        if profile != "full":
            if isinstance(engine, ConstrainedLayoutEngine):
                room = 0.12 / figure.get_figheight()
                engine.set(rect=(0, room, 1, 1 - room))
            figure.text(1, 0, f"profile: {profile} ", ha="right", va="bottom", fontsize=7, color="#555555")
    return figure


def picture(figure: Figure, form: str = "svg") -> bytes:
    """In one of the `FORMATS`: the same bytes for the same figure."""
    buffer = io.BytesIO()
    with matplotlib.rc_context(SETTINGS):
        figure.savefig(buffer, format=form, metadata={FORMATS[form]: None})
    return compact(buffer.getvalue().decode()).encode() if form == "svg" else buffer.getvalue()
