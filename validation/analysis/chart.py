"""Figures as data: what each panel draws, from the tables that `Series` make; `report` draws them."""

import math
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, field, replace

from validation.analysis.series import JUDGED

Bounds = tuple[float | None, float | None]
STYLES = (
    *("", "lines", "marks", "dotted", "dashed", "open", "open marks", "around", "thick", "dots", "crosses", "black"),
    *("guide", "dashed guide", "interval"),
)
"""Forms of a curve; how each is drawn is said where figures are drawn."""


@dataclass(frozen=True)
class Curve:
    """Rows of a table as a curve.

    quantity: the table; model: one or several, all where empty; style: one of `STYLES`, over that of the model; label:
    by default the values, or the model, "_" for none; by: columns, a curve for each value of them, dark to light in
    their order but for models; of: values that other columns have, "first" for the first of its model, "first of all"
    for that of the table; bars, band: whether intervals are drawn; down: from curve to curve; marker_spacing: from
    marker to marker, of the diagonal of the panel, all markers where zero; x_factor: x of a curve with bars over that
    of the last one, on a logarithmic axis; upright: whether the values are places on the horizontal axis, drawn as
    lines across the panel, without a label by the names of their models.
    """

    quantity: str
    model: str | tuple[str, ...] = ()
    style: str = ""
    label: str = ""
    _: KW_ONLY
    by: tuple[str, ...] = ()
    of: Mapping[str, object] = field(default_factory=dict)
    bars: bool = False
    band: bool = False
    down: float = 0.0
    marker_spacing: float = 0.0
    x_factor: float = 1.03
    upright: bool = False

    def __post_init__(self) -> None:
        if self.style not in STYLES:
            names = ", ".join(map(repr, STYLES))
            raise ValueError(f"style of {self.quantity!r} must be one of {names}, got {self.style!r}")


def by_model(quantity: str, styles: Mapping[str, str], *, bars: bool = False) -> tuple[Curve, ...]:
    """A curve of each model in a form of its own, by its name."""
    return tuple(Curve(quantity, model, style, bars=bars) for model, style in styles.items())


@dataclass(frozen=True)
class Panel:
    """Curves on one axis.

    facet: a column, or several, a panel for each of their values; log: the axes that are logarithmic; decades: of y
    below the largest value, or its units where y is linear; judged: the quantity whose verdicts are drawn; shade:
    of y, the margin; lines: of y; at: of x, dotted, where the panel reaches it; downward: from the largest x on;
    ticked: at the values of x alone; least: of x and of y, where smaller values are drawn, which their table has.
    """

    x: str
    y: str
    curves: tuple[Curve, ...] = ()
    title: str = ""
    _: KW_ONLY
    facet: str | tuple[str, ...] = ()
    log: str = "x"
    xlim: Bounds | None = None
    ylim: Bounds | None = None
    decades: float = 0.0
    judged: str = ""
    shade: tuple[float, float] | None = None
    lines: tuple[float, ...] = ()
    at: tuple[float, ...] = ()
    downward: bool = False
    ticked: bool = False
    least: tuple[float, float] = (-math.inf, -math.inf)

    def of(self, *curves: Curve) -> "Panel":
        """The same with these curves."""
        return replace(self, curves=curves)


@dataclass(frozen=True)
class Chart:
    """A figure. name: "case" or "case-part"; panels: none where `report/figures` has a function that draws it; claims:
    numbers of those that its headline states.
    """

    name: str
    caption: str = ""
    panels: tuple[Panel, ...] = ()
    _: KW_ONLY
    claims: tuple[int, ...] = (0,)

    def of(self, caption: str, *panels: Panel) -> "Chart":
        """The same with this caption and these panels."""
        return replace(self, caption=caption, panels=panels)

    @property
    def tables(self) -> tuple[str, ...]:
        """Names of those that it draws."""
        curves = [curve.quantity for panel in self.panels for curve in panel.curves]
        judged = [panel.judged + JUDGED for panel in self.panels if panel.judged]
        return tuple(dict.fromkeys([*curves, *judged]))
