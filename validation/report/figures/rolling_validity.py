"""Figure of the validity of linear theory and of reduced models over h/d and over h' a/d."""

from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.cases.rolling.validity_reduced import LAYER, READ
from validation.report.style import GUIDE, graded, panels, tick


def draw(evidence: Evidence) -> Figure:
    """Contact kept, level off linear theory, and reduced models off boundary elements, over both parameters."""
    table = evidence.table("validity")
    names = list(dict.fromkeys(table.columns["spectrum"]))
    figure, axes = panels(3, 2, height=8.6, sharey="row")
    columns = (
        ("contact kept", "± contact"),
        ("rms over linear [dB]", "± rms [dB]"),
        (f"{LAYER} over bem3d [dB]", f"± {LAYER} [dB]"),
    )
    for k, axis in enumerate(axes):
        value, bar = columns[k // 2]
        parameter = ("h/d", "h' a/d")[k % 2]
        for i, name in enumerate(names):
            mine = table.where(spectrum=name)
            order = mine[parameter].argsort()
            x, y, half = (mine[column][order] for column in (parameter, value, bar))
            axis.errorbar(x, y, yerr=half, capsize=2, label=str(name), **graded(i, len(names)))
            if k >= 4:
                axis.plot(x, mine[f"{READ} over bem3d [dB]"][order], **{**graded(i, len(names)), "linestyle": "--"})
        axis.set(xscale="log", xlabel=parameter)
        tick(
            axis, [x for x in (0.03, 0.1, 0.3, 1, 2) if table[parameter].min() <= 1.1 * x <= 2 * table[parameter].max()]
        )
    axes[0].set_ylabel("share of contact kept")
    axes[2].set(ylabel="rms over linear theory [dB]", ylim=(0, None))
    axes[4].set(ylabel="rms over bem3d [dB]", ylim=(0, None))
    for axis in axes[2:]:
        axis.axhline(1.0, **GUIDE)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure
