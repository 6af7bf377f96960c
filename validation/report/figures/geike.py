"""Figure of Geike's rule."""

import numpy as np
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import BEM, EXACT, MDR, MDR_OTHER, panels, visible


def draw(evidence: Evidence) -> Figure:
    """Spectra, and the moments that each rule keeps."""
    figure, (spectrum_axis, moment_axis) = panels(1, 2)
    spectra = evidence.table("spectra")
    q = spectra["q [rad/m]"]
    sparse = np.unique(np.geomspace(1, q.size, 60).astype(int)) - 1
    for column, label, style, some in (
        ("geike [m^3]", "Geike, π q C_2D", EXACT, slice(None)),
        ("line trace [m^3]", "line trace", MDR_OTHER, slice(None)),
        ("drawn profiles [m^3]", "drawn profiles", MDR, sparse),
        ("lines of drawn surfaces [m^3]", "lines cut from drawn surfaces", BEM, sparse),
    ):
        # outside the band, transforms have rounding alone
        values = visible(spectra[column], above=1e-9 * spectra[column].max())
        spectrum_axis.loglog(q[some], values[some], label=label, **style)
    spectrum_axis.set(xlabel="wavenumber q [rad/m]", ylabel="C_1D [m³]")
    spectrum_axis.legend()

    moments = evidence.table("moments")
    moment_axis.plot(moments["n"], moments["geike"], label="Geike", **{**MDR, "markersize": 7})
    moment_axis.plot(moments["n"], moments["line trace"], label="line trace", **BEM)
    moment_axis.plot(moments["n"], moments["exact"], label="mean of |cos φ|ⁿ", **EXACT)
    moment_axis.set(xlabel="moment n of |q|ⁿ", ylabel="share of the surface's moment", ylim=(0, 1.1))
    moment_axis.set_xticks(moments["n"])
    moment_axis.legend()
    return figure
