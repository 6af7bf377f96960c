"""The compact SVG draws what matplotlib's own does: mark by mark, place by place, look by look."""

import io
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.backends.backend_svg import FigureCanvasSVG

from validation.report.compact import compact
from validation.report.style import panels

LINK = "{http://www.w3.org/1999/xlink}href"
RULE = re.compile(r"\.(\w+)\{([^}]*)\}")
Properties = frozenset[tuple[str, str]]


@pytest.fixture(scope="module")
def plain() -> str:
    """Curves, marks, a clipped fill, a hatch, words with exponents."""
    figure, (left, right) = panels(1, 2)
    x = np.linspace(0.1, 10, 40)
    left.loglog(x, x**1.37, "o-", markersize=3, label="a line")
    left.errorbar(x, 2 * x, 0.3 * x, fmt="s", markerfacecolor="white", label=r"$F/E^*hL$")
    left.legend()
    right.fill_between(x, np.sin(x), alpha=0.4, hatch="//")
    right.plot(x, np.cos(x), ":")
    buffer = io.BytesIO()
    FigureCanvasSVG(figure).print_svg(buffer)
    return buffer.getvalue().decode()


def strokes(svg: str) -> list[tuple[str, list[float], Properties]]:
    """What is drawn, in order: the outline of each mark, its numbers and places, its look."""
    tree = ElementTree.fromstring(svg)
    rules = {
        name: rule for style in tree.iter() if style.tag.endswith("style") for name, rule in RULE.findall(_of(style))
    }
    named = {element.get("id"): element for element in tree.iter() if element.get("id")}

    def look(element: ElementTree.Element) -> Properties:
        said = rules[element.get("class", "")] if element.get("class") else element.get("style", "")
        pairs = [pair.split(":", 1) for pair in said.split(";") if pair]
        if element.get("clip-path"):
            pairs.append(["clip-path", element.get("clip-path", "")])
        return frozenset((name.strip(), frame(value) if "url(" in value else tenths(value)) for name, value in pairs)

    def frame(reference: str) -> str:
        """The first shape of what clips or fills, in words."""
        shape = named[reference.strip()[len("url(#") : -1]][0]
        return tenths(
            " ".join(f"{name}={value}" for name, value in sorted(shape.items()) if name not in ("class", "style"))
        )

    def outline(element: ElementTree.Element) -> tuple[str, list[float]]:
        reference = element.get(LINK) or element.get("href")
        target = named[reference[1:]] if reference and element.tag.endswith("use") else element
        path = target.get("d", "")
        commands = "".join(re.findall("[A-Za-z]", path))
        numbers = [float(number) for number in re.findall(r"-?[\d.]+", path)]
        place = (
            [float(element.get(axis, 0)) for axis in ("x", "y")] if "scale" not in element.get("transform", "") else []
        )
        moved = re.fullmatch(r"translate\((\S+) (\S+)\)", element.get("transform", ""))
        if moved:
            place = [float(number) for number in moved.groups()]
        return f"{commands} {target.get('transform', '')}", [*numbers, *place]

    drawn = []

    def walk(element: ElementTree.Element) -> None:
        for child in element:
            if child.tag.endswith(("path", "use")):
                drawn.append((*outline(child), look(child)))
            if not child.tag.endswith(("defs", "style")):
                walk(child)

    walk(tree)
    return drawn


def tenths(value: str) -> str:
    """A property, its numbers to a tenth of a point."""
    return re.sub(r"\d+\.\d+", lambda number: f"{float(number.group()):.1f}", value.strip().replace(", ", ","))


def _of(style: ElementTree.Element) -> str:
    return style.text or ""


def same(svg: str, plain: str) -> None:
    """Assert that both draw the same."""
    before, after = strokes(plain), strokes(svg)
    assert len(before) == len(after) > 200
    for (kind, places, look), (kind_after, places_after, look_after) in zip(before, after, strict=True):
        assert (kind, look) == (kind_after, look_after)
        # half of the last decimal kept: two of a point, one of a hundredth of the size of the type
        np.testing.assert_allclose(places_after, places, rtol=0, atol=0.0501)


def test_the_same_strokes_at_the_same_places_in_the_same_look(plain: str) -> None:
    same(compact(plain), plain)


@pytest.mark.parametrize("fault", ["a mark less", "another colour", "a point aside"])
def test_a_picture_that_is_not_the_same_is_noticed(plain: str, fault: str) -> None:
    svg = compact(plain)
    planted = {
        "a mark less": re.sub(r"<use [^>]*/>\n", "", svg, count=1),
        "another colour": svg.replace("fill:none;stroke:#", "fill:none;stroke:#1", 1),
        "a point aside": re.sub(r' x="(\d+)', lambda x: f' x="{int(x[1]) + 1}', svg, count=1),
    }[fault]
    with pytest.raises(AssertionError):
        same(planted, plain)


def test_half_of_the_bytes(plain: str) -> None:
    # a committed reference is to stay under 10 MB with each figure in it twice, in the page and beside it
    assert len(compact(plain)) < 0.6 * len(plain)
