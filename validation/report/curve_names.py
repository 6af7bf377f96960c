"""The names of curves: at their ends where they fit, else in a legend beside the panels, never over data."""

import textwrap
from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.container import Container
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from validation.report.style import WIDTH, Style

LINE, ROW, LETTER, KEY = 9.0, 12.0, 4.2, 34.0
"""Height of a line of names, and of one of a legend, width of a letter, and of the sample before a name [points]."""
MOST, FARTHEST = 6, 1.5
"""Curves that are named at their ends; how far a name is moved, in lines."""
BESIDE = 14
"""Names for which a spare place of the grid has room."""
NEAR_THE_EDGE = 0.8
"""Part of the panel from which on a curve ends at its side."""


def name_curves(figure: Figure, axes: Sequence[Axes], columns: int, spare: Sequence[Axes] = ()) -> None:
    """Each name once; the legend is in a spare place of the grid where there is one, else below all panels."""
    named = [dict(zip(*axis.get_legend_handles_labels()[::-1], strict=True)) for axis in axes]
    every = {name: handle for one in named for name, handle in one.items()}
    last = min(columns, len(axes)) - 1
    if not spare and len(named[last]) == len(every) <= MOST and _at_the_ends(axes[last], every):
        return
    if spare and len(every) <= BESIDE:
        names = [textwrap.fill(name, 30) for name in every]
        spare[0].legend(every.values(), names, loc="center", borderaxespad=0.0)
    elif every:
        widest = KEY + LETTER * max(map(len, every))
        most = max(1, min(len(every), int(72 * WIDTH / widest)))
        # the panels keep their height
        figure.set_figheight(figure.get_figheight() + ROW * -(-len(every) // most) / 72)
        figure.legend(every.values(), every.keys(), loc="outside lower center", ncols=most)


def _at_the_ends(axis: Axes, named: Mapping[str, Artist]) -> bool:
    """Draw them right of the panel, lowest first. False where they are no curves, end elsewhere, or are too near."""
    if len(named) < 2:
        return False
    axis.figure.draw_without_rendering()  # type: ignore[union-attr]
    step = LINE * axis.figure.dpi / 72 / axis.bbox.height
    ends = [(name, line, _end(axis, line)) for name, handle in named.items() for line in [_line_of(handle)] if line]
    if len(ends) < len(named) or any(x < NEAR_THE_EDGE or not 0 <= y <= 1 for _, _, (x, y) in ends):
        return False
    ends.sort(key=lambda end: end[2][1])
    at = np.array([y for _, _, (_, y) in ends])
    places = at.copy()
    for i in range(1, at.size):
        places[i] = max(places[i], places[i - 1] + step)
    places -= (places - at).max() / 2
    if np.abs(places - at).max() > FARTHEST * step:
        return False
    for (name, line, end), place in zip(ends, places, strict=True):
        ends_at = {"relpos": (0, 0.5), "shrinkA": 0, "shrinkB": 0}
        leader = {"arrowstyle": "-", "color": line.get_color(), "linewidth": 0.6, **ends_at}
        words: Style = {"va": "center", "fontsize": 7.5, "annotation_clip": False, "arrowprops": leader}
        axis.annotate(name, end, (1.04, place), xycoords="axes fraction", textcoords="axes fraction", **words)
    return True


def _line_of(handle: Artist | Container) -> Line2D | None:
    first = handle[0] if isinstance(handle, Container) else handle
    return first if isinstance(first, Line2D) else None


def _end(axis: Axes, line: Line2D) -> tuple[float, float]:
    """Of what is farthest on the right, in parts of the panel."""
    data = np.column_stack([np.asarray(values, dtype=np.float64) for values in line.get_data()])
    places = axis.transAxes.inverted().transform(axis.transData.transform(data[np.isfinite(data).all(axis=1)]))
    x, y = places[np.argmax(places[:, 0])].tolist() if places.size else (np.nan, np.nan)
    return x, y
