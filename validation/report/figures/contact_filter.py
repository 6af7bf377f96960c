"""Figure of the contact filters of the field, beside boundary elements and beside the published table."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.report.style import BEM, GUIDE, MARKERS, graded, panels, tick

REFERENCE, POINTS = "linear, ellipse", "boundary elements"
SHOWN = (
    "springs that read the surface",
    "linear, on the line",
    "linear, on the mean across",
    "spring bed (DPRS), linear",
    "Remington, alpha = 1",
    "springs, rolling spectrum",
    "springs, Geike's rule",
)
SHIFT = 10.0


def draw(evidence: Evidence) -> Figure:
    """Models over linear theory of the ellipse, ground by ground; the table and the band between both grounds."""
    bands = evidence.table("bands")
    figure, axes = panels(1, 3, width=10.5, height=4.4)
    grounds = list(dict.fromkeys(bands.columns["across"]))
    first = bands.columns["wheel"][0]
    for axis, ground in zip(axes, grounds, strict=False):
        _over_linear(axis, bands.where(across=ground, wheel=first), str(ground))
    for axis in axes[:2]:
        axis.set_ylim(-1.5, 6.5)
    _published(axes[-1], evidence.table("published"))
    named = dict(pair for axis in axes[:-1] for pair in zip(*axis.get_legend_handles_labels()[::-1], strict=True))
    figure.legend(named.values(), named.keys(), loc="outside lower center", ncols=3)
    return figure


def _over_linear(axis: Axes, found: Table, ground: str) -> None:
    reference = found.where(model=REFERENCE)
    keep = reference["counted"]
    wave = reference["wavelength [mm]"][keep]
    axis.axhspan(-1, 1, color="#000000", alpha=0.07, linewidth=0)
    known = set(found.columns["model"])
    for i, model in enumerate(SHOWN):
        if model in known:
            excess = found.where(model=model)["A3 [dB]"] - reference["A3 [dB]"]
            axis.plot(wave, excess[keep], label=model, **{**graded(i, len(SHOWN)), "marker": MARKERS[i + 1]})
    points = found.where(model=POINTS)
    excess, half = (points["A3 [dB]"] - reference["A3 [dB]"])[keep], points["± [dB]"][keep]
    axis.errorbar(wave, excess, yerr=half, label=POINTS, capsize=2, zorder=3, **BEM)
    axis.set(xscale="log", xlabel="wavelength [mm]", ylabel="A3 over linear theory of the ellipse [dB]", title=ground)
    axis.invert_xaxis()
    tick(axis, wave)


def _published(axis: Axes, found: Table) -> None:
    wheels = list(dict.fromkeys(found.columns["wheel"]))
    for i, wheel in enumerate(wheels):
        mine, down = found.where(wheel=wheel), -SHIFT * i
        keep = (mine["wavelength [mm]"] <= 200) & (mine["wavelength [mm]"] >= 8)
        wave, table, used = (mine[name][keep] for name in ("wavelength [mm]", "table [dB]", "compared"))
        style = graded(i, len(wheels))
        ends = np.stack([mine["ridges [dB]"], mine["isotropic [dB]"]])[:, keep] + down
        axis.fill_between(wave, ends.min(axis=0), ends.max(axis=0), color=style["color"], alpha=0.35, linewidth=0)
        axis.plot(wave, table + down, markerfacecolor="white", **{**style, "linestyle": "none"})
        axis.plot(wave[used], (table + down)[used], label=str(wheel), **{**style, "linestyle": "none"})
    axis.axhline(0, **GUIDE)
    axis.set(xscale="log", xlabel="wavelength [mm]", ylabel="A3, shifted [dB]", ylim=(-68, 4), title="published table")
    axis.invert_xaxis()
    tick(axis, (200, 100, 50, 25, 16, 10))
    axis.legend(fontsize=7, loc="lower left")
