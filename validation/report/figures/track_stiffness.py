"""Figure of the stiffness along a track at constant load."""

import numpy as np
from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.cases.rolling.track_stiffness_evidence import DEVIATION, MEAN
from validation.report.style import graded, panels, tick


def draw(evidence: Evidence) -> Figure:
    """Mean and deviation over Fbar, wheel and punch; levels in bands."""
    moments, bands = evidence.table("moments"), evidence.table("bands")
    figure, (mean, deviation, level) = panels(1, 3, width=10.5, height=4.2)
    models = list(dict.fromkeys(moments.columns["model"]))
    for i, model in enumerate(models):
        mine = moments.where(model=model)
        style = {**graded(i, len(models)), "linestyle": ":" if str(model).startswith("punch") else "-"}
        if "bem3d" not in str(model):
            style["markerfacecolor"] = "white"
        for axis, quantity in ((mean, MEAN), (deviation, DEVIATION)):
            shown = mine[quantity] > 1e-6
            axis.errorbar(
                mine["Fbar"][shown],
                mine[quantity][shown],
                yerr=mine[f"± {quantity}"][shown],
                capsize=2,
                label=str(model),
                **style,
            )
    forces = np.unique(moments["Fbar"])
    for axis, name in ((mean, "mean stiffness"), (deviation, "relative deviation of stiffness")):
        axis.set(xscale="log", xlabel="Fbar = F / (E* h L)", ylabel=name, ylim=(0, None))
        tick(axis, forces)
    level.axhspan(-3, 3, color="#000000", alpha=0.07, linewidth=0)
    for i, force in enumerate(forces):
        mine = bands.where(Fbar=force)
        y, half = mine["Geike's spectrum [dB]"], mine["Geike's spectrum ± [dB]"]
        style = graded(i, forces.size)
        level.errorbar(mine["q a"], y, yerr=np.minimum(half, 20), capsize=2, label=f"Fbar = {force:g}", **style)
    level.set(xscale="log", xlabel="q a", ylabel="springs over boundary elements [dB]", ylim=(-25, 25))
    tick(level, [q for q in (2, 5, 10) if bands["q a"].min() <= q <= bands["q a"].max()])
    level.legend(fontsize=7)
    figure.legend(*mean.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure
