"""Figure of the ellipse of contact: its axes over the crown, and what a circle in its place costs."""

import numpy as np
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import GUIDE, graded, panels, tick


def draw(evidence: Evidence) -> Figure:
    """Axes, the error in bands, and that at 16 mm over the crown."""
    rows = evidence.table("crowns")
    figure, (axes, bands, short) = panels(1, 3, width=10.5, height=3.6)
    one = rows.where(**{"across": "ridges", "wavelength [mm]": 16.0})
    crowns, along, across = one["crown [mm]"], one["a_x [mm]"], one["a_y [mm]"]
    axes.plot(crowns, along, label="a_x, along", **graded(0, 2))
    axes.plot(crowns, across, label="a_y, across", **graded(1, 2))
    axes.plot(crowns, np.sqrt(along * across), label="sqrt(a_x a_y)", **GUIDE)
    axes.set(xscale="log", xlabel="radius of the crown [mm]", ylabel="semi-axis [mm]", ylim=(0, None))
    axes.legend()
    bands.axhspan(-1, 1, color="#000000", alpha=0.07, linewidth=0)
    for i, crown in enumerate(crowns):
        mine = rows.where(**{"crown [mm]": crown, "across": "isotropic ground", "counted": True})
        wave, excess = mine["wavelength [mm]"], mine["circle [dB]"] - mine["ellipse [dB]"]
        shown = wave <= 125
        bands.plot(wave[shown], excess[shown], label=f"{crown:g} mm", **graded(i, crowns.size))
    bands.set(xscale="log", xlabel="wavelength [mm]", ylabel="circle over ellipse [dB]")
    bands.invert_xaxis()
    tick(bands, (100, 50, 25, 16))
    bands.legend(title="crown", fontsize=7, ncols=2)
    short.axhspan(-1, 1, color="#000000", alpha=0.07, linewidth=0)
    for i, name in enumerate(dict.fromkeys(rows.columns["across"])):
        mine = rows.where(**{"wavelength [mm]": 16.0, "across": name})
        short.plot(mine["crown [mm]"], mine["circle [dB]"] - mine["ellipse [dB]"], label=name, **graded(i, 2))
    short.set(xscale="log", xlabel="radius of the crown [mm]", ylabel="circle over ellipse at 16 mm [dB]")
    short.legend()
    for axis in (axes, short):
        tick(axis, (80, 200, 460, 1200))
    return figure
