"""The compact SVG draws what matplotlib's own does: element by element, to a tenth of a point, in the same style."""

import io
import re
from xml.etree import ElementTree

import matplotlib
import numpy as np
import pytest
from matplotlib.backends.backend_svg import FigureCanvasSVG

from validation.report.style import SETTINGS, compact, panels

RULE = re.compile(r"\.(\w+)\{([^}]*)\}")
NUMBER = re.compile(r"-?\d+\.?\d*")


@pytest.fixture(scope="module")
def plain():
    """Curves, marks, a clipped fill, a hatch, an image, words with digits and exponents."""
    with matplotlib.rc_context(SETTINGS):
        figure, (left, right) = panels(1, 2)
        x = np.linspace(0.1, 10, 40)
        left.loglog(x, x**1.37, "o-", markersize=3, label="L = 1.1523 a")
        left.errorbar(x, 2 * x, 0.3 * x, fmt="s", markerfacecolor="white", label=r"$F/E^*hL$")
        left.legend()
        right.fill_between(x, np.sin(x), alpha=0.4, hatch="//")
        right.plot(x, np.cos(x), ":")
        right.imshow([[0.0, 1.0]], extent=(2, 4, 0.2, 0.6))
        buffer = io.BytesIO()
        FigureCanvasSVG(figure).print_svg(buffer)
    return buffer.getvalue().decode()


def drawn(svg):
    """What is drawn, in order: kinds and attributes of the elements, their texts, and all numbers of the attributes."""
    named = set(re.findall(r"#([\w-]+)", svg)) & set(re.findall(r' id="([\w-]+)"', svg))
    for place, name in enumerate(sorted(named, key=lambda name: svg.index(f' id="{name}"'))):
        svg = re.sub(rf'( id="|#){name}\b', rf"\1one-{place}-", svg)
    rules, found, numbers = dict(RULE.findall(svg)), [], []
    for element in ElementTree.fromstring(svg).iter():
        if re.search("rdf|purl|creativecommons|metadata|style", element.tag):
            continue
        given = {name: value for name, value in element.items() if name != "id" or value.startswith("one-")}
        if name := given.pop("class", ""):
            given["style"] = rules[name]
        words = {name: re.sub(r"\s", "", NUMBER.sub("", value)) for name, value in given.items()}
        found.append((element.tag, words, (element.text or "").strip()))
        numbers += [float(number) for name in sorted(given) for number in NUMBER.findall(given[name])]
    return found, numbers


def same(svg, plain):
    (before, places), (after, places_after) = drawn(plain), drawn(svg)
    assert before == after and len(before) > 200
    np.testing.assert_allclose(places_after, places, rtol=0, atol=0.0501)


def test_a_compact_picture_is_the_same_in_fewer_bytes(plain):
    """Without it a committed report, with 3.5 MB of figures, exceeds 8 MB."""
    assert len(compact(plain)) < 0.6 * len(plain)
    same(compact(plain), plain)


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        (r"<use [^>]*>\s*<use", "<use"),
        ("stroke: #0", "stroke: #1"),
        (r' d="M(\d)', r' d="M1\1'),
        (r' clip-path="[^"]*"', ""),
        ("1.1523", "1.2"),
    ],
)
def test_a_picture_that_is_not_the_same_is_noticed(plain, right, wrong):
    """A mark less, another colour, a point aside, a clip forgotten, a number of a text rounded."""
    planted = re.sub(right, wrong, compact(plain), count=1)
    with pytest.raises(AssertionError):
        same(planted, plain)


def test_names_are_those_of_their_order(plain):
    """matplotlib's are digests of the last bits of places."""
    other = re.sub(r'( id="|#)(p[0-9a-f]{10})', r"\1\2f", plain)
    assert other != plain and compact(other) == compact(plain)
