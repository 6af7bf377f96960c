"""The contact of the wheel as the simulation has it."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from validation.analysis.evidence import Table
from validation.report.style import GUIDE, Style, panels, visible


def draw_contact(springs: Table, pressure: Table) -> Figure:
    place = {"left": 0.07, "right": 0.9, "bottom": 0.14, "top": 0.92, "wspace": 0.22}
    figure, (left, right) = panels(1, 2, width=10.0, height=3.9, within=place)
    _springs(left, springs)
    x, y = np.unique(pressure["x / a"]), np.unique(pressure["y / a"])
    p = pressure["p / p0"].reshape(x.size, y.size)
    image = right.pcolormesh(x, y, visible(p).T, cmap="cividis", shading="nearest", rasterized=True)
    turn = np.linspace(0, 2 * np.pi, 200)
    right.plot(np.cos(turn), np.sin(turn), **{**GUIDE, "color": "#000000"})
    right.set(xlabel="x / a from below the wheel, along the track", ylabel="y / a", aspect="equal")
    right.set(xlim=(-1.35, 1.35), ylim=(-1.35, 1.35))
    beside = figure.add_axes((0.92, 0.2, 0.015, 0.64))
    figure.colorbar(image, cax=beside, label="p / p₀")
    return figure


def _springs(axis: Axes, table: Table) -> None:
    x, wheel, track, compression = (table[name] for name in ("x / a", "wheel / d", "track / d", "compression / d"))
    step = max(1, round(x.size / 130))
    for i in range(0, x.size, step):
        carries = compression[i] > 0
        style: Style = {"color": "#000000", "linewidth": 0.9} if carries else {"color": "#bbbbbb", "linewidth": 0.5}
        # a spring ends under the wheel where it carries, else at the height of the track
        axis.plot([x[i], x[i]], [-1.6, track[i] - compression[i]], **style)
    axis.fill_between(x, -2.8, -2.8 + compression, color="#0072B2", alpha=0.55, linewidth=0)
    axis.plot(x, wheel, color="#D55E00", linewidth=1.8, label="wheel, x²/R - d")
    axis.plot(x, track, color="#000000", linewidth=0.9, linestyle="--", label="track before contact")
    axis.set(xlabel="x / a", ylabel="height / d; blue: compression", ylim=(-2.8, 0.95), xlim=(-1.4, 1.4))
    axis.legend(loc="upper center")
