"""The style of figures: one colour a model in all of them, readable in grey, and the same bytes every time."""

import io
import re
import textwrap
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.text import Text
from matplotlib.ticker import Formatter, LogFormatter, ScalarFormatter

from validation.analysis.escapes import printable
from validation.analysis.evidence import Evidence, Table

REMARK = re.compile(r"\s*(<!--.*?-->|<metadata>.*?</metadata>)", re.DOTALL)
GROUP = re.compile(r'<g id="[^"]*"')
TAG = re.compile(r"<[^>]*>")
COMMAND = re.compile(r"\s*\b([MLQCz])\s+|\n")
DECIMALS = re.compile(r"(?<![\d.])([1-9]\d*)\.\d{3,}")
NAME, NAMED = re.compile(r' id="([^"]+)"'), re.compile(r'( id="|#)([\w-]+)')
STYLE = re.compile(r' style="([^"]*)"')
RULES_END = "</style>"


def compact(svg: str) -> str:
    """The same picture in about half of the bytes: places to a tenth of a point, short names, each style once."""
    classes: dict[str, str] = {}

    def named(style: re.Match[str]) -> str:
        return f' class="{classes.setdefault(style[1], f"c{len(classes)}")}"'

    svg = GROUP.sub("<g", REMARK.sub("", svg))
    # names are digests of places to the last bit, which is not the same in every process
    names = {name: f"n{i}" for i, name in enumerate(dict.fromkeys(NAME.findall(svg)))}
    svg = NAMED.sub(lambda match: match[1] + names.get(match[2], match[2]), svg)
    svg = STYLE.sub(named, TAG.sub(_shortened, svg))
    svg = "\n".join(line.lstrip() for line in svg.splitlines())
    rules = "".join(f".{name}{{{style}}}\n" for style, name in classes.items())
    return svg.replace(RULES_END, rules + RULES_END, 1)


def _shortened(tag: re.Match[str]) -> str:
    """A number below one, as a scale is, stays."""
    return DECIMALS.sub(lambda number: f"{float(number.group()):.1f}", COMMAND.sub(r"\1", tag.group()))


Style = dict[str, Any]

LETTERS = 26
WIDTH = 7.1
"""Of a figure [inches]: 180 mm, two columns of a journal, where its smallest text has 7 points."""
# Okabe and Ito: apart for colour-blind readers
INK, SOFT = "#000000", "#555555"
BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY = "#0072B2", "#D55E00", "#009E73", "#AA4499", "#E69F00", "#56B4E9"
MARKERS = "osD^v<>ph*"


def _style(color: str, marker: str, dash: str, *, open_: bool = False) -> Style:
    face = {"markerfacecolor": "white"} if open_ else {}
    return {"color": color, "marker": marker, "linestyle": dash, "markersize": 3.5, "linewidth": 1.1, **face}


MODELS: Mapping[str, Style] = {
    name: style
    for names, style in (
        (
            ("boundary elements", "boundary elements, punch", "BEM", "fine boundary elements", "sphere, b"),
            _style(BLUE, "o", "-"),
        ),
        (("boundary elements, ", "coarse boundary elements", "flat punches"), _style(BLUE, "o", "--", open_=True)),
        (("BEM, looser residual",), _style(BLUE, "d", ":", open_=True)),
        (("BEM, extrapolated", "boundary elements, 1/3", "wave"), _style(BLUE, "h", "--", open_=True)),
        (
            ("springs", "MDR", "L_1D", "sphere, s", "drawn profile", "no window"),
            _style(VERMILION, "s", "-", open_=True),
        ),
        (
            ("springs, ", "springs on", "springs over an area", "L_1D = 1", "Hann"),
            _style(VERMILION, "D", "--", open_=True),
        ),
        (("linear filter, 3D", "linear theory, 3D", "linear, ellipse", "linear contact"), _style(GREEN, "^", "-")),
        (("linear filter, 1D", "(14.12)", "linear, on", "linear theory"), _style(PURPLE, "v", "--")),
        (("(14.14)",), _style(PURPLE, "none", ":")),
        (("Greenwood",), _style(SKY, "D", "-.")),
        (("Bush-Gibson",), _style(GREEN, "^", "-", open_=True)),
        (("Gaussian tail", "bearing area"), _style(PURPLE, "v", "-")),
        (("spring bed", "one-sided bed"), _style(ORANGE, "p", "-.")),
        (("Remington",), _style(SKY, "P", "-.")),
        (("closed form",), _style(INK, "*", "-")),
        (("fit",), _style(INK, "x", ":")),
        (("Hertz", "Westergaard", "Persson", "theory", "second order", "sin("), _style(INK, "none", "-")),
        (("floor", "published", "1 / (1 + H)", "at the least"), _style(INK, "none", ":")),
    )
    for name in names
}
"""By the beginning of its name, the longest that there is."""


def _of_model(name: str) -> Style | None:
    beginning = max((begin for begin in MODELS if name.startswith(begin)), key=len, default=None)
    return MODELS[beginning] if beginning else None


CATEGORIES = ((INK, "-"), (BLUE, "--"), (VERMILION, "-."), (GREEN, ":"), (PURPLE, "-"), (ORANGE, "--"))


def styles_of(names: Iterable[str], users: Collection[str] = ()) -> dict[str, Style]:
    """Of models, in all figures the same, and of up to six other things without an order: apart in grey too.

    users: names that are not the package's own, however they begin: they always have a marker.
    """
    styles: dict[str, Style] = {}
    for i, name in enumerate(dict.fromkeys(names)):
        color, dash = CATEGORIES[i % len(CATEGORIES)]
        style = None if name in users else _of_model(name)
        style = style or _style(color, MARKERS[i % len(MARKERS)], dash, open_=True)
        # a second model of a kind has another marker and another dash
        again = {"marker": MARKERS[-1 - i % len(MARKERS)], "linestyle": CATEGORIES[i % 4][1]}
        styles[name] = {**style, **again} if style in styles.values() and style["marker"] != "none" else style
    return styles


def graded(i: int, count: int) -> Style:
    """The i-th of several curves in the order of a number: from dark to light, each with a marker of its own."""
    color = to_hex(matplotlib.colormaps["viridis"](0.85 * i / max(count - 1, 1)))
    return _style(color, MARKERS[i % len(MARKERS)], "-")


GUIDE: Style = {"color": SOFT, "linestyle": ":", "linewidth": 1.0, "marker": "none"}
BARS: Style = {"capsize": 0, "elinewidth": 0.6}
"""Of intervals."""


def legend_name(name: str) -> str:
    """Of a curve in a legend, which leaves out a name that begins with _."""
    return f" {name}" if name.startswith("_") else name


def in_two_lines(words: str, most: int = 90) -> str:
    """A title or a name of any length, of so many characters a line: 90 are as wide as a figure."""
    return "\n".join(textwrap.wrap(words, most, max_lines=2, placeholder=" ..."))


FAMILIES = ("DejaVu Sans", "Verdana", "sans-serif")
"""The first lays a figure out; a page without it takes the next, which is as wide."""
SETTINGS: Any = {
    "svg.hashsalt": "validation",
    # text stays text: it can be found and copied, and takes a third of the bytes of its outlines
    "svg.fonttype": "none",
    "font.sans-serif": FAMILIES,
    "pdf.fonttype": 42,
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.linewidth": 0.6,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.5,
    "legend.fontsize": 7.5,
    "legend.frameon": False,
}


def panels(
    rows: int,
    columns: int,
    *,
    heights: Sequence[float] = (),
) -> tuple[Figure, list[Axes]]:
    """A figure of lettered panels, row by row. heights: of each row [inch]; 0 for two thirds of its width and more."""
    default = 0.6 + 0.62 * WIDTH / max(columns, 2)
    heights = [height or default for height in heights or [0.0] * rows]
    figure = Figure(figsize=(WIDTH, sum(heights)), layout="constrained")
    axes = list(figure.subplots(rows, columns, squeeze=False, height_ratios=heights).flat)
    for i, axis in enumerate(axes if len(axes) > 1 else ()):
        axis.set_title(f"({_letters(i)})", loc="left")
    return figure, axes


def _letters(i: int) -> str:
    """a, b, ... z, aa, ab, ..."""
    return chr(ord("a") + i) if i < LETTERS else _letters(i // LETTERS - 1) + _letters(i % LETTERS)


def tick(axes: Axes, values: Iterable[float], *, up: bool = False) -> None:
    """Ticks of the horizontal axis, or of the vertical one, at these values alone."""
    values, axis = list(values), axes.yaxis if up else axes.xaxis
    axis.set_ticks(values, [f"{value:g}" for value in values])
    axis.minorticks_off()


def visible(values: np.ndarray, *, above: float = 0.0) -> np.ndarray:
    """NaN in place of what a logarithmic axis, or one that ends there, has no room for."""
    return np.where(np.isfinite(values) & (values > above), values, np.nan)


FORMATS = {"svg": "Date", "png": "Software", "pdf": "CreationDate"}
"""Of pictures, each with what would make their bytes differ from one time or version to the next."""


def plain(text: str) -> str:
    """A text of a user's in a figure, in which a $ is no mathematics, and no control character is drawn."""
    return printable(text, lines=True).replace("$", r"\$")


class EachNumber(Formatter):
    """Each number of an axis as it is, with digits that tell it from its neighbours.

    A factor or an offset in the corner of an axis is overlooked.
    """

    def format_ticks(self, values: Sequence[float]) -> list[str]:
        """Of all of them, with as few digits as leave a thousandth of their least distance."""
        distances = np.diff(np.unique(values))
        least = 1e-3 * float(distances.min() if distances.size else np.abs(values).max(initial=1.0))
        texts = [f"{value:.15g}" for value in values]
        for digits in range(1, 15):
            texts = [f"{0.0 if abs(value) < least else value:.{digits}g}" for value in values]
            if all(abs(float(text) - value) <= least for text, value in zip(texts, values, strict=True)):
                break
        texts = [f"{float(text):.15g}" if abs(float(text)) < LARGE else text for text in texts]
        return [POWER.sub(r"e\1\2", text).replace("-", "\N{MINUS SIGN}") for text in texts]

    def __call__(self, x: float, pos: int | None = None) -> str:
        """One of them."""
        return self.format_ticks([x])[0]


POWER = re.compile(r"e\+?(-?)0*(\d+)")
LARGE = 1e5
"""From here on a number is written with a power of ten."""


def plain_numbers(figure: Figure) -> None:
    """`EachNumber` on every axis whose numbers nobody has formatted."""
    for axis in figure.findobj(Axis):
        if type(axis.get_major_formatter()) is ScalarFormatter:
            axis.set_major_formatter(EachNumber())


def plain_figure(figure: Figure) -> None:
    """Make all of its texts `plain`, once, but for the numbers that a logarithmic axis makes, and its numbers, too."""
    plain_numbers(figure)
    for text in figure.findobj(Text):
        text.set_text(plain(text.get_text()))
    for axis in figure.findobj(Axis):
        labels = [label.get_text() for label in axis.get_majorticklabels()]
        if any("$" in label for label in labels) and not isinstance(axis.get_major_formatter(), LogFormatter):
            axis.set_ticklabels([plain(label) for label in labels])


def drawn(draw: Callable[[Evidence], Figure], evidence: Evidence, profile: str) -> Figure:
    """A case's figure in this style, stamped where it is not the real size. The texts of its tables are no markup."""

    def as_text(cells: Sequence[object]) -> list[object]:
        return [plain(cell) if isinstance(cell, str) else cell for cell in cells]

    tables = tuple(Table(t.name, {name: as_text(cells) for name, cells in t.columns.items()}) for t in evidence.tables)
    with matplotlib.rc_context(SETTINGS):
        figure = draw(replace(evidence, tables=tables))
        plain_numbers(figure)
        engine = figure.get_layout_engine()
        if profile != "full":
            if isinstance(engine, ConstrainedLayoutEngine):
                room = 0.12 / figure.get_figheight()
                engine.set(rect=(0, room, 1, 1 - room))
            figure.text(1, 0, f"profile: {profile} ", ha="right", va="bottom", fontsize=7, color="#555555")
    return figure


def picture(figure: Figure, form: str = "svg") -> bytes:
    """In one of the `FORMATS`: the same bytes for the same figure."""
    buffer = io.BytesIO()
    with matplotlib.rc_context(SETTINGS):
        figure.savefig(buffer, format=form, metadata={FORMATS[form]: None})
    return compact(buffer.getvalue().decode()).encode() if form == "svg" else buffer.getvalue()
