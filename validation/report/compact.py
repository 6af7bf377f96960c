"""An SVG of matplotlib without invisible parts: indentation, comments, unused names, digits beyond any printer."""

import re
from itertools import groupby

REMARK = re.compile(r"\s*(<!--.*?-->|<metadata>.*?</metadata>)", re.DOTALL)
UNUSED = re.compile(r'<g id="[^"]*">')
GROUPS, BARE, END = ("<g ", "<g>"), "<g>", "</g>"
PATH = re.compile(r'(?<= d=")[^"]*')
COMMAND = re.compile(r"\s*([MLQCZz])\s*")
DECIMALS = re.compile(r"(\d*)\.\d{3,}")
INDENTATION = re.compile(r"\n\s*")
LINK, SPACE = "xlink:href=", ' xmlns:xlink="http://www.w3.org/1999/xlink"'
"""SVG 2 needs neither the prefix nor its declaration."""
NAME = re.compile(r' id="([^"]+)"')
NAMED = re.compile(r'( id="|#)([\w-]+)')
PLACED = re.compile(r'(<use [^>]*)transform="translate\((\S+) (\S+)\)"/>')
"""A glyph at its place in a word, in hundredths of the size of the type."""
LOOK = re.compile(r'(?: (?:clip-path|style)="[^"]*")+')
PROPERTY = re.compile(r'(clip-path|style)="([^"]*)"')
RULES_END = "</style>"
MARK = re.compile(r'<use href="(#\w+)"(?: x="([^"]*)")?(?: y="([^"]*)")? class="(\w+)"/>\n')
CLIPPED = re.compile(r"\.(\w+)\{[^}]*clip-path")
FEW = 3
"""Marks that are as short one by one."""


def compact(svg: str) -> str:
    """The same picture in about half of the bytes."""
    svg = UNUSED.sub("<g>", REMARK.sub("", svg)).replace(LINK, "href=").replace(SPACE, "")
    svg = PATH.sub(lambda path: COMMAND.sub(r"\1", path.group()).strip(), svg)
    svg = INDENTATION.sub("\n", DECIMALS.sub(_printed, svg))
    return _marked(_ungrouped(_classed(_renamed(PLACED.sub(_place, svg)))))


def _printed(number: re.Match[str]) -> str:
    """A tenth of a point from one point on; a smaller number, as a scale is, stays."""
    return number.group() if number.group(1) in ("", "0") else f"{float(number.group()):.1f}"


def _place(glyph: re.Match[str]) -> str:
    start, *place = glyph.groups()
    at = [f"{float(number):.1f}".removesuffix(".0") for number in place]
    return start + " ".join(f'{axis}="{number}"' for axis, number in zip("xy", at, strict=True) if number != "0") + "/>"


def _renamed(svg: str) -> str:
    """Short names for what is drawn again and again: marks, glyphs, frames that clip."""
    short = {name: f"n{number}" for number, name in enumerate(dict.fromkeys(NAME.findall(svg)))}
    return NAMED.sub(lambda found: found[1] + short.get(found[2], found[2]), svg)


def _classed(svg: str) -> str:
    """Each combination of properties once, as a class, instead of at every mark."""
    classes: dict[str, str] = {}

    def named(look: re.Match[str]) -> str:
        found = PROPERTY.findall(look.group())
        text = "; ".join(value if name == "style" else f"{name}: {value}" for name, value in found)
        text = text.replace("; ", ";").replace(": ", ":")
        return f' class="{classes.setdefault(text, f"c{len(classes)}")}"'

    svg = LOOK.sub(named, svg)
    rules = "".join(f".{name}{{{rules}}}\n" for rules, name in classes.items())
    return svg.replace(RULES_END, rules + RULES_END, 1)


def _ungrouped(svg: str) -> str:
    """Without the groups that have no attributes; each tag has a line of its own."""
    lines, bare = [], []
    for line in svg.splitlines(keepends=True):
        tag = line.strip()
        if tag.startswith(GROUPS) and not tag.endswith("/>"):
            bare.append(tag == BARE)
            silent = bare[-1]
        else:
            silent = tag == END and bare.pop()
        if not silent:
            lines.append(line)
    return "".join(lines)


def _marked(svg: str) -> str:
    """A series of one mark as a path that has it at every point, but where each mark is clipped by itself."""
    clipped = set(CLIPPED.findall(svg))
    lines: list[str] = []
    for number, ((name, look), series) in enumerate(groupby(svg.splitlines(keepends=True), _mark_of)):
        marks = list(series)
        if len(marks) <= FEW or look in clipped or not name:
            lines += marks
            continue
        points = "L".join(f"{found[2] or 0} {found[3] or 0}" for found in map(MARK.fullmatch, marks) if found)
        lines.append(
            f'<marker id="m{number}" markerUnits="userSpaceOnUse" overflow="visible">'
            f'<use href="{name}" class="{look}"/></marker>\n'
            f'<path d="M{points}" style="fill:none;marker:url(#m{number})"/>\n'
        )
    return "".join(lines)


def _mark_of(line: str) -> tuple[str, str]:
    """Which mark a line draws, and how it looks; two empty words where it draws none."""
    found = MARK.fullmatch(line)
    return (found[1], found[4]) if found else ("", "")
