"""Figure of the ways to draw."""

from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import BEM, MDR_LINE, panels


def draw(evidence: Evidence) -> Figure:
    """Relative deviation: a row for each Hurst exponent, a column for each way to draw."""
    curves = evidence.table("curves")
    hursts = list(dict.fromkeys(curves["H"].tolist()))
    ways = list(dict.fromkeys(curves["drawn with"].tolist()))
    figure, axes = panels(len(hursts), len(ways), height=2.4 * len(hursts), sharex=True, sharey="all")
    for i, (hurst, way) in enumerate((hurst, way) for hurst in hursts for way in ways):
        axis = axes[i]
        bem, mdr = (curves.where(H=hurst, method=method, **{"drawn with": way}) for method in ("bem3d", "mdr"))
        value = bem["relative deviation"]
        bars = [value - bem["low"], bem["high"] - value]
        axis.errorbar(bem["Fbar"], value, yerr=bars, capsize=2, label="boundary elements", **BEM)
        axis.plot(mdr["Fbar"], mdr["relative deviation"], label="MDR, L_1D = L", **MDR_LINE)
        axis.fill_between(mdr["Fbar"], mdr["low"], mdr["high"], color=MDR_LINE["color"], alpha=0.25, linewidth=0)
        axis.set_xscale("log")
        if i < len(ways):
            axis.set_title(way)
        if i % len(ways) == 0:
            axis.set_ylabel(f"H = {hurst:g}\nrelative deviation of k")
        if i >= len(ways) * (len(hursts) - 1):
            axis.set_xlabel("force Fbar = F / (E* h L)")
    axes[0].set_ylim(0, 1.05 * curves["high"].max())
    axes[0].legend(loc="lower left")
    return figure
