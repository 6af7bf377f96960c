"""The figure of `compare`: levels with their error, or one number of each model, side by side."""

import io
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from validation.analysis.evidence import Table
from validation.report.style import SETTINGS, graded, pdf, plain_figure, svg, tick
from validation.selection.exported import levels_of_models
from validation.selection.one_or_several import OneOrSeveral, listed
from validation.selection.several import same_quantity, selected_of_several, table_of_several

FORMATS = ("svg", "png", "pdf")
TICKS = 12
"""Wavelengths on the axis, at the most."""


def to_figure(comparison: OneOrSeveral, *, form: str = "svg") -> bytes:
    """Picture of a comparison: the models that were solved, the selected one with its error.

    Parameters
    ----------
    comparison : Comparison or list of Comparison
        What `compare` returns; of a list, the selected model of each scene.
    form : str, optional
        "svg", "png" or "pdf".

    Returns
    -------
    bytes
        The file that ``mdr-validation compare --figure FILE`` writes.

    Raises
    ------
    ValueError
        For another form, and for a list of several quantities.

    Examples
    --------
    >>> picture = validation.to_figure(validation.compare(validation.load_scene("sphere")), form="png")
    >>> picture[1:4]
    b'PNG'
    """
    if form not in FORMATS:
        raise ValueError(f"form must be one of {', '.join(FORMATS)}, got {form!r}")
    found = listed(comparison)
    if not same_quantity(found):
        raise ValueError(f"comparison must be of one quantity, got {', '.join(one.quantity for one in found)}")
    if len(found) > 1:
        table = selected_of_several(table_of_several(found))
        return figure_of_models(table.name, table, form)
    table = levels_of_models(found[0])
    return figure_of_models(f"{found[0].scene.name}: {table.name}", table, form)


def figure_of_models(title: str, table: Table, form: str) -> bytes:
    """A picture in one of the `FORMATS`; the same bytes for the same table.

    table: columns wavelength_mm, frequency_hz, value, low, high, unit, model, selected.
    """
    models = list(dict.fromkeys(table["model"].tolist()))
    with matplotlib.rc_context(SETTINGS):
        spectra = bool(np.isfinite(table["wavelength_mm"]).all())
        figure = Figure(figsize=(7.0, 4.2 if spectra else 1.2 + 0.4 * len(models)), layout="constrained")
        axes = figure.subplots()
        axes.set_title(title, loc="left")
        (_spectra if spectra else _numbers)(axes, table, models)
        plain_figure(figure)
    return {"svg": svg, "pdf": pdf, "png": _png}[form](figure)


def _spectra(axes: Axes, table: Table, models: list[str]) -> None:
    """The selected model with the band of its error; the others beside it."""
    for i, model in enumerate(models):
        mine = table.where(model=model)
        x, style = mine["wavelength_mm"], graded(i, len(models))
        selected = bool(mine["selected"][0])
        if selected:
            style["linewidth"] = 2.5
        axes.plot(x, mine["value"], label=f"{model}, selected" if selected else model, **style)
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
    axes.legend()


def _add_frequencies(axes: Axes, speed: float) -> None:
    """A second axis on top; speed: [mm/s]."""

    def over(values: ArrayLike) -> np.ndarray:
        """Frequencies of wavelengths, and the other way round; matplotlib tries zero, too."""
        return speed / np.maximum(np.asarray(values, dtype=np.float64), 1e-12)

    above = axes.secondary_xaxis("top", functions=(over, over))
    above.xaxis.set_major_formatter("{x:g}")
    above.set_xlabel("frequency [Hz]")


def _numbers(axes: Axes, table: Table, models: list[str]) -> None:
    for i, (value, low, selected) in enumerate(zip(table["value"], table["low"], table["selected"], strict=True)):
        style: dict[str, Any] = graded(i, len(models))
        half = value - low if np.isfinite(low) else 0.0
        axes.errorbar(value, i, xerr=half, capsize=3 if half else 0, fmt=style["marker"], color=style["color"])
        if selected:
            models[i] += ",\nselected"
    axes.set_yticks(range(len(models)), models)
    axes.set_ylim(-0.6, len(models) - 0.4)
    axes.invert_yaxis()
    axes.set_xlabel(f"{table.name} [{table['unit'][0]}]")


def _png(figure: Figure) -> bytes:
    buffer = io.BytesIO()
    FigureCanvasAgg(figure).print_png(buffer, metadata={"Software": None})  # type: ignore[no-untyped-call]
    return buffer.getvalue()
