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
    """Rows of a table as a curve, or as a family of curves.

    Attributes
    ----------
    quantity : str
        Name of the table. A run that has no such table leaves the curve out.
    model : str or tuple of str
        Rows of these models; all where empty.
    style : str
        One of `STYLES`, over the style of the model.
    label : str
        In the legend; by default the values of ``by``, or the model; "_" for none.
    by : tuple of str
        Columns: a curve for each combination of their values. Colours go from dark to light in the order of the rows;
        by "model" alone each has its own.
    of : mapping of str to object
        Values of other columns that rows must have, one or a tuple; "first" for the first value of the rows that are
        left, "first of all" for that of the table.
    bars, band : bool
        Whether 95 % intervals are drawn, as bars or as a band.
    down : float
        How much each curve of a family is drawn below the one before, in the unit of the vertical axis.
    marker_spacing : float
        From marker to marker, as a fraction of the diagonal of the panel; 0 for a marker at each point, at 15 of many.
    x_factor : float
        Factor by which each curve with bars is moved along a logarithmic axis from the one before.
    upright : bool
        Whether the values are places on the horizontal axis, drawn as vertical lines across the panel, named by
        ``label`` in the legend or else at the lines by their models.
    named : bool
        Whether its name stands beside its points, and not in the legend.

    Raises
    ------
    ValueError
        If the style is none of `STYLES`.

    Examples
    --------
    >>> from validation.analysis.chart import Curve
    >>> curve = Curve("level", "MDR", "dashed", by=("h/d",), of={"lateral structure": "uniform"}, bars=True)
    >>> curve.quantity, curve.label, curve.band
    ('level', '', False)
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
    named: bool = False

    def __post_init__(self) -> None:
        if self.style not in STYLES:
            names = ", ".join(map(repr, STYLES))
            raise ValueError(f"style of {self.quantity!r} must be one of {names}, got {self.style!r}")


def by_model(quantity: str, styles: Mapping[str, str], *, bars: bool = False) -> tuple[Curve, ...]:
    """A curve of each model in a form of its own, by its name."""
    return tuple(Curve(quantity, model, style, bars=bars) for model, style in styles.items())


@dataclass(frozen=True)
class Panel:
    """Curves on one pair of axes, or on several that differ by a column.

    Attributes
    ----------
    x : str
        Column of the horizontal axis, which is its name too, unit included. Texts are equidistant, in the order of the
        rows.
    y : str
        Name of the vertical axis, unit included; curves have the columns value, low and high.
    curves : tuple of Curve
        From the first drawn to the last.
    title : str
        Above the panel; by default the values of ``facet``.
    facet : str or tuple of str
        Columns: a panel for each combination of their values; one panel where empty.
    rows : str
        Column of names that stand at the vertical axis, a row each, from the top; value, low and high are then
        horizontal. None where empty.
    log : {"", "x", "y", "xy"}
        Axes that are logarithmic.
    xlim, ylim : tuple of float or None, or None
        Ends of the axes; None where the data have them.
    decades : float
        Decades of y below its largest value, or units where y is linear; 0 for all.
    judged : str
        Quantity whose ranges are drawn with their worst points and verdicts; none where empty.
    shade : tuple of float, or None
        Band of y within tolerance.
    lines : tuple of float
        Values of y with a horizontal line.
    limits : mapping of str to float
        Values of y with a dotted line, by their names in the legend.
    at : tuple of float
        Values of x with a dotted line, where the panel reaches them.
    downward : bool
        Whether x falls to the right.
    ticked : bool
        Whether x has ticks at the values of the curves alone.
    least : tuple of float
        Least x and y: smaller values are drawn there, and stay as they are in their table.
    above : tuple of str and float, or None
        Name of a second horizontal axis, above, and the constant c of its values c / x, as of frequencies above
        wavelengths.
    own_y : bool
        Whether each panel has a vertical axis of its own, also beside others of its quantity.
    height : float
        Height [inch]; 0 for two thirds of its width and more.

    Examples
    --------
    >>> from validation.case import Curve, Panel
    >>> panel = Panel("h/d", "level [dB]", judged="level", shade=(-1.0, 1.0)).of(Curve("level", "MDR"))
    >>> [curve.model for curve in panel.curves]
    ['MDR']
    """

    x: str
    y: str
    curves: tuple[Curve, ...] = ()
    title: str = ""
    _: KW_ONLY
    facet: str | tuple[str, ...] = ()
    rows: str = ""
    log: str = "x"
    xlim: Bounds | None = None
    ylim: Bounds | None = None
    decades: float = 0.0
    judged: str = ""
    shade: tuple[float, float] | None = None
    lines: tuple[float, ...] = ()
    limits: Mapping[str, float] = field(default_factory=dict)
    at: tuple[float, ...] = ()
    downward: bool = False
    ticked: bool = False
    least: tuple[float, float] = (-math.inf, -math.inf)
    above: tuple[str, float] | None = None
    own_y: bool = False
    height: float = 0.0

    def of(self, *curves: Curve) -> "Panel":
        """The same with these curves."""
        return replace(self, curves=curves)


@dataclass(frozen=True)
class Chart:
    """A figure as data, drawn from tables alone.

    Attributes
    ----------
    name : str
        Of its file: the name of the case, or that with a part, "case-part".
    caption : str
        Whole sentences; in a study it may have settings in braces.
    panels : tuple of Panel
        In reading order; empty where ``report/figures`` has a function that draws it.
    claims : tuple of int
        Positions, in the study, of the claims that its headline states.
    title : str
        Above all panels; none where empty.
    columns : int
        Panels side by side; 0 for as many as suit their number.

    Examples
    --------
    >>> from validation.case import Chart, Curve, Panel
    >>> panel = Panel("h/d", "level [dB]", judged="level").of(Curve("level"))
    >>> Chart("rolling").of("Level of the force.", panel).tables
    ('level', 'level, judged')
    """

    name: str
    caption: str = ""
    panels: tuple[Panel, ...] = ()
    _: KW_ONLY
    claims: tuple[int, ...] = (0,)
    title: str = ""
    columns: int = 0

    def of(self, caption: str, *panels: Panel) -> "Chart":
        """The same with this caption and these panels."""
        return replace(self, caption=caption, panels=panels)

    @property
    def tables(self) -> tuple[str, ...]:
        """Names of those that it draws."""
        curves = [curve.quantity for panel in self.panels for curve in panel.curves]
        judged = [panel.judged + JUDGED for panel in self.panels if panel.judged]
        return tuple(dict.fromkeys([*curves, *judged]))
