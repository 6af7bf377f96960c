"""Figure of Geike's rule."""

import numpy as np
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import BEM, EXACT, MDR, MDR_OTHER, panels


def draw(evidence: Evidence) -> Figure:
    """Spectra, and the moments that each rule keeps."""
    figure, (spectrum_axis, moment_axis) = panels(1, 2)
    spectra = evidence.table("spectra")
    q = spectra["q [rad/m]"]
    sparse = np.unique(np.geomspace(1, q.size, 60).astype(int)) - 1
    for column, label, style in (
        ("geike [m^3]", "Geike, π q C_2D", EXACT),
        ("line trace [m^3]", "line trace", MDR_OTHER),
    ):
        spectrum_axis.loglog(q, _positive(spectra[column]), label=label, **style)
    for column, label, style in (
        ("drawn profiles [m^3]", "drawn profiles", MDR),
        ("lines of drawn surfaces [m^3]", "lines cut from drawn surfaces", BEM),
    ):
        values = _positive(spectra[column])
        spectrum_axis.loglog(q[sparse], values[sparse], label=label, **style)
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


def _positive(values: np.ndarray) -> np.ndarray:
    """NaN outside the band, where transforms have rounding alone."""
    return np.where(values > 1e-9 * values.max(), values, np.nan)
