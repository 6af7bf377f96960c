"""The compact SVG draws what matplotlib's own does: mark by mark, place by place, look by look."""

import io
import re
from itertools import chain
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.backends.backend_svg import FigureCanvasSVG

from validation.report.compact import compact
from validation.report.style import panels

LINK = "{http://www.w3.org/1999/xlink}href"
RULE = re.compile(r"\.(\w+)\{([^}]*)\}")
Look = frozenset[tuple[str, str]]
Stroke = tuple[str, list[float], Look]


@pytest.fixture(scope="module")
def plain() -> str:
    """Curves, marks, a clipped fill, a hatch, an image, words with exponents."""
    figure, (left, right) = panels(1, 2)
    x = np.linspace(0.1, 10, 40)
    left.loglog(x, x**1.37, "o-", markersize=3, label="a line")
    left.errorbar(x, 2 * x, 0.3 * x, fmt="s", markerfacecolor="white", label=r"$F/E^*hL$")
    left.legend()
    right.fill_between(x, np.sin(x), alpha=0.4, hatch="//")
    right.plot(x, np.cos(x), ":")
    right.imshow([[0.0, 1.0]], extent=(2, 4, 0.2, 0.6))
    buffer = io.BytesIO()
    FigureCanvasSVG(figure).print_svg(buffer)
    return buffer.getvalue().decode()


def strokes(svg: str) -> list[Stroke]:
    """What is drawn, in order: its outline, its numbers and places from the whole picture inwards, its look."""
    tree = ElementTree.fromstring(svg)
    spell_out(tree)
    rules = dict(RULE.findall("".join(element.text or "" for element in tree.iter() if element.tag.endswith("style"))))
    named = {element.get("id"): element for element in tree.iter() if element.get("id")}

    def look(element: ElementTree.Element) -> Look:
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

    def place(element: ElementTree.Element) -> tuple[list[float], str]:
        """Where an element puts what is in it; a translation alone is a place."""
        said = element.get("transform", "")
        x, y = (float(element.get(axis, 0)) for axis in ("x", "y"))
        moved = re.fullmatch(r"translate\((\S+) (\S+)\)", said)
        if moved:
            return [x + float(moved[1]), y + float(moved[2])], ""
        return [x, y, *_numbers(said)], "".join(re.findall("[a-z]+", said))

    drawn: list[Stroke] = []

    def walk(element: ElementTree.Element, within: list[Stroke]) -> None:
        for child in element:
            if child.tag.endswith(("defs", "style", "metadata", "marker")):
                continue
            reference = child.get(LINK) or child.get("href") or ""
            target = named.get(reference[1:], child)
            (at, moves), path = place(child), target.get("d", "")
            outline = re.sub(r"[^A-Za-z]", "", path) + target.get("transform", "") * (target is not child)
            picture = reference * child.tag.endswith("image")
            around = [*within, (outline + picture + moves, [*_numbers(path), *at], look(child))]
            if child.tag.endswith(("path", "use", "image")):
                drawn.append(_joined(around))
            walk(child, around)

    walk(tree, [])
    return drawn


def spell_out(tree: ElementTree.Element) -> None:
    """A mark at each point of the paths that have marks."""
    markers = {element.get("id"): element[0].attrib for element in tree.iter() if element.tag.endswith("marker")}
    for path in [element for element in tree.iter() if "marker:" in element.get("style", "")]:
        mark = markers[path.attrib.pop("style").partition("#")[2].rstrip(")")]
        numbers = _numbers(path.attrib.pop("d"))
        path.tag = "g"
        for x, y in zip(numbers[::2], numbers[1::2], strict=True):
            ElementTree.SubElement(path, "use", {**mark, "x": str(x), "y": str(y)})


def _joined(around: list[Stroke]) -> Stroke:
    """An element in all its groups; those that say nothing leave nothing."""
    kinds, places, looks = zip(*around, strict=True)
    said = [number for kind, place in zip(kinds, places, strict=True) if kind or any(place) for number in place]
    return "".join(kinds), said, frozenset(chain(*looks))


def _numbers(text: str) -> list[float]:
    return [float(number) for number in re.findall(r"-?(?:\d+\.?\d*|\.\d+)", text)]


def tenths(value: str) -> str:
    """A property, its numbers to a tenth of a point."""
    return re.sub(r"\d+\.\d+", lambda number: f"{float(number.group()):.1f}", value.strip().replace(", ", ","))


def same(svg: str, plain: str) -> None:
    """Assert that both draw the same."""
    before, after = strokes(plain), strokes(svg)
    assert len(before) == len(after) > 200
    for (kind, places, look), (kind_after, places_after, look_after) in zip(before, after, strict=True):
        assert (kind, look) == (kind_after, look_after)
        # half of the last decimal kept: two of a point, one of a hundredth of the size of the type
        np.testing.assert_allclose(places_after, places, rtol=0, atol=0.0501)


@pytest.mark.slow
def test_the_same_strokes_at_the_same_places_in_the_same_look(plain: str) -> None:
    same(compact(plain), plain)


@pytest.mark.slow
@pytest.mark.parametrize(
    "fault",
    ["a mark less", "another colour", "a point aside", "another mark", "a word aside", "a clip forgotten"],
)
def test_a_picture_that_is_not_the_same_is_noticed(plain: str, fault: str) -> None:
    svg = compact(plain)
    planted = {
        "a mark less": re.sub(r'L[^L"]*(?=" style="fill:none;marker)', "", svg, count=1),
        "another colour": svg.replace("fill:none;stroke:#", "fill:none;stroke:#1", 1),
        "a point aside": re.sub(r' d="M(\d+)', lambda x: f' d="M{int(x[1]) + 1}', svg, count=1),
        "another mark": re.sub(r'(<marker .*?href="#n)(\d+)', lambda m: m[1] + str(int(m[2]) - 1), svg, count=1),
        "a word aside": re.sub(r"translate\((?=\S+ \S+\) scale)", "translate(1", svg, count=1),
        "a clip forgotten": re.sub(r'<g class="[^"]*"', "<g", svg, count=1),
    }[fault]
    with pytest.raises(AssertionError):
        same(planted, plain)


def test_half_of_the_bytes(plain: str) -> None:
    # a committed report is to stay under 8 MB
    assert len(compact(plain)) < 0.5 * len(plain)
