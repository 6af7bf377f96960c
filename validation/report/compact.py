"""An SVG of matplotlib without invisible parts: comments, indentation, names of groups, digits beyond any printer."""

import re

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
    svg = NAMED.sub(lambda found: found[1] + names.get(found[2], found[2]), svg)
    svg = STYLE.sub(named, TAG.sub(_shortened, svg))
    svg = "\n".join(line.lstrip() for line in svg.splitlines())
    rules = "".join(f".{name}{{{style}}}\n" for style, name in classes.items())
    return svg.replace(RULES_END, rules + RULES_END, 1)


def _shortened(tag: re.Match[str]) -> str:
    """A number below one, as a scale is, stays."""
    return DECIMALS.sub(lambda number: f"{float(number.group()):.1f}", COMMAND.sub(r"\1", tag.group()))
