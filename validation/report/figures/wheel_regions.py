"""Region 2: its second-order force, and its end at low speed."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence, Table
from validation.report.style import EXACT, GUIDE, MDR, graded, panels, tick, visible

RATIO = "q_min v₀ / ω_eigen"


def draw(evidence: Evidence) -> Figure:
    figure, (short, long, spectra, valley) = panels(2, 2, width=10.5, height=7.2)
    _plateau(short, evidence.table("plateau of short waves"))
    _plateau(long, evidence.table("plateau of long waves"))
    table = evidence.table("spectra")
    ratios = list(dict.fromkeys(table[RATIO].tolist()))
    for i, ratio in enumerate(ratios):
        rows, style = table.where(**{RATIO: ratio}), graded(i, len(ratios))
        x, a = rows["omega / omega_eigen"], rows["A [(m/s2)2 s]"]
        spectra.plot(x, a, label=f"{ratio:g}", **{**style, "markersize": 3, "markevery": max(len(x) // 8, 1)})
    spectra.set(xscale="log", yscale="log", xlabel="ω / ω_eigen", ylabel="A [(m/s²)² s]")
    spectra.legend(title=RATIO, title_fontsize=7, fontsize=6, ncols=2, loc="lower right")
    _valley(valley, evidence)
    return figure


def _plateau(axis: Axes, table: Table) -> None:
    omega = table["omega [rad/s]"] / 1e3
    seen = visible(table["second order"])
    axis.plot(omega, seen, label="second-order force", **EXACT)
    axis.plot(omega, table["steady-state"], label="springs, steady-state", **{**MDR, "marker": "o"})
    if "open" in table.columns:
        axis.plot(omega, table["open"], label="springs, open tracks", **{**GUIDE, "color": "#0072B2"})
    axis.set(yscale="log", xlabel="ω [1000 rad/s]", ylabel="A [(m/s²)² s]")
    axis.legend(loc="upper left", fontsize=7)


def _valley(axis: Axes, evidence: Evidence) -> None:
    speeds = evidence.table("speeds")
    axis.plot(speeds[RATIO], speeds["valley [dB]"], **{**MDR, "marker": "o", "linestyle": "-"})
    axis.axvline(speeds["merges at"][0], **{**EXACT, "linestyle": "--"})
    axis.axhline(3.0, **GUIDE)
    axis.set(xscale="log", xlabel=RATIO, ylabel="valley before the jump [dB]")
    tick(axis, (1, 1.2, 1.5, 2, 3, 6))
