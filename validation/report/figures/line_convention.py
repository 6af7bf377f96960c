"""Figure of the conventions of a line: mean of heights, energy mean, and their scatter."""

from matplotlib.figure import Figure

from validation.analysis.evidence import Evidence
from validation.report.style import BEM, GUIDE, MARKERS, graded, panels, tick

ISOTROPIC = "isotropic ground"


def draw(evidence: Evidence) -> Figure:
    """A panel a spacing, and the scatter."""
    lines = evidence.table("lines")
    spacings = list(dict.fromkeys(lines.columns["spacing [mm]"]))
    grounds = list(dict.fromkeys(lines.columns["across"]))
    figure, axes = panels(1, len(spacings) + 1, width=10.5, height=4.0)
    for axis, spacing in zip(axes, spacings, strict=False):
        axis.axhspan(-1, 1, color="#000000", alpha=0.07, linewidth=0)
        for i, ground in enumerate(grounds):
            mine = lines.where(**{"spacing [mm]": spacing, "across": ground})
            axis.plot(
                mine["wavelength [mm]"],
                mine["mean of heights [dB]"],
                label=f"mean of heights, {ground}",
                **{**graded(i, len(grounds)), "marker": MARKERS[i + 1]},
            )
        axis.plot(mine["wavelength [mm]"], mine["ellipse over line [dB]"], label="ellipse over row of springs", **GUIDE)
        energy = lines.where(**{"spacing [mm]": spacing, "across": ISOTROPIC})
        axis.errorbar(
            energy["wavelength [mm]"],
            energy["energy mean [dB]"],
            yerr=energy["energy mean ± [dB]"],
            capsize=2,
            label=f"energy mean, {ISOTROPIC}",
            **BEM,
        )
        axis.set(ylabel="over the level of one line [dB]", title=f"{spacing:g} mm apart", ylim=(-8, 2))
    for i, (name, spacing) in enumerate(
        [("scatter of one line [dB]", spacings[0]), *(("scatter of energy mean [dB]", one) for one in spacings)]
    ):
        mine = lines.where(**{"spacing [mm]": spacing, "across": ISOTROPIC})
        label = "one line" if i == 0 else f"energy mean, {spacing:g} mm apart"
        axes[-1].plot(mine["wavelength [mm]"], mine[name], label=label, **graded(i, 1 + len(spacings)))
    axes[-1].set(ylabel="deviation from strip to strip [dB]", ylim=(0, None), title=ISOTROPIC)
    axes[-1].legend(fontsize=7)
    for axis in axes:
        axis.set(xscale="log", xlabel="wavelength [mm]")
        axis.invert_xaxis()
        tick(axis, mine["wavelength [mm]"])
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure
