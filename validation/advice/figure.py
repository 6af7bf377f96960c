"""The figures of `compare`: spectra with their error, or one number of each model, side by side."""

from collections.abc import Collection, Sequence
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from validation.advice.compare import Comparison, OneOrSeveral, listed
from validation.advice.exported import by_quantity, table_of_several
from validation.advice.figure_of_sweep import draw_sweep, names_of_users
from validation.advice.side_by_side import shown_models
from validation.analysis.evidence import Table
from validation.report.style import (
    BLUE,
    FORMATS,
    INK,
    MARKERS,
    SETTINGS,
    Style,
    in_two_lines,
    legend_name,
    picture,
    plain_figure,
    styles_of,
    tick,
)

TICKS = 12
"""Wavelengths on the axis, at the most."""
NAME = 48
"""Characters of a line of a name in a figure, at the most."""
MOST = 5
"""Curves in one panel: of more, none is told from the others."""


def to_figure(comparison: OneOrSeveral, *, form: str = "svg") -> bytes:
    """Picture of a comparison: the models that were solved, the selected one with its error.

    Of spectra at most five: the selected model, the reference, springs of MDR, and what is nearest to the selected.

    Parameters
    ----------
    comparison : Comparison or list of Comparison
        What `compare` returns; of a list a panel a quantity, of a sweep or with the selected model of each scene.
    form : str, optional
        "svg", "png" or "pdf".

    Returns
    -------
    bytes
        The file that ``mdr-validation compare --figure FILE`` writes.

    Raises
    ------
    ValueError
        For another form.

    Examples
    --------
    >>> picture = validation.to_figure(validation.compare(validation.load_scene("sphere")), form="png")
    >>> picture[1:4]
    b'PNG'
    """
    if form not in FORMATS:
        raise ValueError(f"form must be one of {', '.join(FORMATS)}, got {form!r}")
    panels = list(by_quantity(listed(comparison)).values())
    with matplotlib.rc_context(SETTINGS):
        heights = [_height(found) for found in panels]
        figure = Figure(figsize=(7.0, sum(heights)), layout="constrained")
        parts = figure.subfigures(len(panels), 1, squeeze=False, height_ratios=heights)
        for part, found in zip(parts[:, 0], panels, strict=True):
            if _is_sweep(found):
                draw_sweep(part, found, MOST)
                continue
            title, table = _shown(found)
            axes = part.subplots()
            axes.set_title(in_two_lines(title), loc="left")
            spectra = found[0].is_level and np.isfinite(table["wavelength_mm"]).all()
            users = names_of_users(found, table["model"].tolist())
            if spectra and len(table["model"]):
                _spectra(axes, table, users)
            else:
                _numbers(axes, table)
    plain_figure(figure)
    return picture(figure, form)


def _is_sweep(found: Sequence[Comparison]) -> bool:
    return len(found) > 1 and found[0].swept is not None


def _height(found: Sequence[Comparison]) -> float:
    rows = len(found[0].selection.solved) if len(found) == 1 else len(found)
    if _is_sweep(found):
        return 5.5 if found[0].is_level else 4.2
    return 4.2 if found[0].is_level else 1.2 + 0.4 * rows


def _shown(found: Sequence[Comparison]) -> tuple[str, Table]:
    """Title and rows, of spectra in the order in which curves are drawn."""
    one, table = found[0], table_of_several(found)
    if len(found) > 1:
        return one.quantity, _selected(table)
    title = f"{one.scene.name}: {one.quantity}"
    if not one.is_level or not one.selection.solved:
        return title, table
    order = shown_models(one)
    rows = sorted(range(len(table["model"])), key=lambda row: order.index(str(table["model"][row])))
    return title, Table(table.name, {name: [column[row] for row in rows] for name, column in table.columns.items()})


def _selected(table: Table) -> Table:
    """The selected model of each scene alone, named by its scene."""
    selected = table.where(selected=True)
    names = [legend_name(str(name)) for name in selected.columns["scene"]]
    return Table(table.name, {**selected.columns, "model": names, "selected": [False] * len(names)})


def _spectra(axes: Axes, table: Table, users: Collection[str] = ()) -> None:
    """The selected model with the band of its error; the others beside it. users: names that are no models of ours."""
    models = list(dict.fromkeys(table["model"].tolist()))
    for model, style in styles_of(models[:MOST], users).items():
        mine = table.where(model=model)
        x, selected = mine["wavelength_mm"], bool(mine["selected"][0])
        name = legend_name(f"{model}, selected" if selected else model)
        axes.plot(x, mine["value"], label=in_two_lines(name, NAME), **style)
        if selected:
            axes.fill_between(x, mine["low"], mine["high"], color=style["color"], alpha=0.2, linewidth=0)
    axes.set_xscale("log")
    waves = table.where(model=models[0])["wavelength_mm"]
    tick(axes, (float(f"{wave:.3g}") for wave in waves[:: 1 + len(waves) // TICKS]))
    axes.invert_xaxis()
    axes.set_xlabel("wavelength [mm]")
    if np.isfinite(table["frequency_hz"]).all():
        _add_frequencies(axes, float(table["wavelength_mm"][0] * table["frequency_hz"][0]))
    axes.set_ylabel(f"{table.name} [{table['unit'][0]}]")
    more = len(models) - MOST
    axes.legend(title=f"and {more} more in the CSV" if more > 0 else None, title_fontsize=8)


def _add_frequencies(axes: Axes, speed: float) -> None:
    """A second axis on top; speed: [mm/s]."""

    def over(values: ArrayLike) -> np.ndarray:
        """Frequencies of wavelengths, and the other way round; matplotlib tries zero, too."""
        return speed / np.maximum(np.asarray(values, dtype=np.float64), 1e-12)

    above = axes.secondary_xaxis("top", functions=(over, over))
    above.xaxis.set_major_formatter("{x:g}")
    above.set_xlabel("frequency [Hz]")


def _numbers(axes: Axes, table: Table) -> None:
    """A row a model, or a scene."""
    names = [in_two_lines(name, NAME) for name in table["model"].tolist()]
    for i, (value, low, selected) in enumerate(zip(table["value"], table["low"], table["selected"], strict=True)):
        style: Style = {"color": BLUE if selected else INK, "fmt": MARKERS[i % len(MARKERS)]}
        half: Any = value - low if np.isfinite(low) else 0.0
        axes.errorbar(value, i, xerr=half, capsize=3 if half else 0, markersize=4, **style)
        if selected:
            names[i] += ",\nselected"
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.set_xlabel(f"{table.name} [{table['unit'][0]}]" if names else "no model has a result with a known error")
