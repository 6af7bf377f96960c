"""The figure of `compare`: levels with their error, or one number of each model, side by side."""

import io
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from validation.analysis.evidence import Table
from validation.report.style import SETTINGS, graded, pdf, svg, tick

FORMATS = ("svg", "png", "pdf")
TICKS = 12
"""Wavelengths on the axis, at the most."""


def figure_of_models(title: str, table: Table, form: str) -> bytes:
    """A picture in one of the `FORMATS`; the same bytes for the same table.

    table: columns wavelength_mm, frequency_hz, value, low, high, unit, model, selected.
    """
    models = list(dict.fromkeys(table["model"].tolist()))
    with matplotlib.rc_context(SETTINGS):
        figure = Figure(figsize=(7.0, 4.2), layout="constrained")
        axes = figure.subplots()
        axes.set_title(title, loc="left")
        draw = _spectra if np.isfinite(table["wavelength_mm"]).all() else _numbers
        draw(axes, table, models)
    return {"svg": svg, "pdf": pdf, "png": _png}[form](figure)


def _spectra(axes: Axes, table: Table, models: list[str]) -> None:
    """The selected model with the band of its error; the others beside it."""
    for i, model in enumerate(models):
        mine = table.where(model=model)
        x, style = mine["wavelength_mm"], graded(i, len(models))
        selected = bool(mine["selected"][0])
        axes.plot(x, mine["value"], label=f"{model}, selected" if selected else model, **style)
        if selected:
            axes.fill_between(x, mine["low"], mine["high"], color=style["color"], alpha=0.2, linewidth=0)
    axes.set_xscale("log")
    waves = table.where(model=models[0])["wavelength_mm"]
    tick(axes, (float(f"{wave:.3g}") for wave in waves[:: 1 + len(waves) // TICKS]))
    axes.invert_xaxis()
    axes.set_xlabel("wavelength [mm]")
    axes.set_ylabel(f"{table.name} [{table['unit'][0]}]")
    axes.legend()


def _numbers(axes: Axes, table: Table, models: list[str]) -> None:
    for i, (value, low, selected) in enumerate(zip(table["value"], table["low"], table["selected"], strict=True)):
        style: dict[str, Any] = graded(i, len(models))
        axes.errorbar(value, i, xerr=value - low, capsize=3, fmt=style["marker"], color=style["color"])
        if selected:
            models[i] += ",\nselected"
    axes.set_yticks(range(len(models)), models)
    axes.invert_yaxis()
    axes.set_xlabel(f"{table.name} [{table['unit'][0]}]")


def _png(figure: Figure) -> bytes:
    buffer = io.BytesIO()
    FigureCanvasAgg(figure).print_png(buffer, metadata={"Software": None})  # type: ignore[no-untyped-call]
    return buffer.getvalue()
