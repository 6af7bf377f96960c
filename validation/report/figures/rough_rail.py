"""Figure of rougher rails: models over boundary elements on the same strips."""

import numpy as np
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import GUIDE, MARKERS, graded, panels, tick

REFERENCE = "boundary elements"
SHOWN = ("linear, ellipse", "springs that read the surface", "spring bed (DPRS), one-sided")


def draw(evidence: Evidence) -> Figure:
    """A panel a roughness; the shortest two bands are left out, where oblique waves are missing."""
    bands = evidence.table("bands")
    offsets = list(dict.fromkeys(bands.columns["offset [dB]"]))
    figure, axes = panels(1, len(offsets), width=10.5, height=4.0, sharey="all")
    for axis, offset in zip(axes, offsets, strict=True):
        found = bands.where(**{"offset [dB]": offset})
        bem = found.where(model=REFERENCE)
        wave, half = bem["wavelength [mm]"][:-2], bem["± [dB]"][:-2]
        axis.axhspan(-1, 1, color="#000000", alpha=0.07, linewidth=0)
        axis.fill_between(wave, -half, half, color="#000000", alpha=0.25, linewidth=0, label="95 %, boundary elements")
        for i, model in enumerate(SHOWN):
            over = (found.where(model=model)["A3 [dB]"] - bem["A3 [dB]"])[:-2]
            axis.plot(wave, over, label=model, **{**graded(i, len(SHOWN)), "marker": MARKERS[i]})
        last = wave[bem["counted"][:-2]][-1]
        axis.axvline(last * 10**-0.05, **GUIDE)
        title = "ISO 3095:2013" if offset == 0 else f"{offset:+g} dB"
        axis.set(xscale="log", xlabel="wavelength [mm]", title=title, ylim=(-6, 9))
        axis.invert_xaxis()
        tick(axis, wave[::2] if len(offsets) > 3 else [w for w in wave if not np.isclose(w, 31.5)][::2])
    axes[0].set_ylabel("A3 over that of boundary elements [dB]")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure
