"""Names of columns with their units, as tables of others have them: `x [mm]`, `height (um)`, `z/µm`, `level_dB`."""

import math
import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from validation.scenes.units import UNITS

MICRO = re.compile("[\N{GREEK SMALL LETTER MU}\N{MICRO SIGN}]")
OTHER_WORDS = {"Å": "Å", "pm": "pm", "db": "dB", "DB": "dB", "dB": "dB", "micron": "um", "microns": "um"}
OTHER_WORDS |= {"MM": "mm", "UM": "um", "CM": "cm"}
OTHER_WORDS |= {f"{word}met{end}": unit for word, unit in (("micro", "um"), ("milli", "mm")) for end in ("er", "re")}
RADIANS = "rad/m"
WAVENUMBERS = {"1/m": 1.0, "m^-1": 1.0, "m-1": 1.0, "m⁻¹": 1.0, "1/cm": 1e2, "1/mm": 1e3, RADIANS: 1 / (2 * math.pi)}
"""Cycles over a length, in cycles over a metre."""
KNOWN = {unit: unit for unit in (*UNITS["length"], *WAVENUMBERS) if unit != "µm"} | OTHER_WORDS
AT_THE_END = re.compile(
    rf"(?:^|[\s_/,])({'|'.join(map(re.escape, sorted(KNOWN, key=len, reverse=True)))})(?:,?\s+\(?(?:re|ref|rel)\b.*)?$"
)
BRACKETS = str.maketrans("()", "[]")
IN_BRACKETS = re.compile(r"\[([^\[\]]*)\]|\(([^()]*)\)")
PLACE = re.compile(r"([+-]?\d+(?:[.,]\d+)?)(?:\s+(mm|cm|m))?")
"""A name that is the place of a line across the rail, whose unit is none of its heights."""
REFERENCE = re.compile(r"\b(?:re|ref|rel)\b\.?:?\s*([^\])]*)")
UNIT_OF_ALL = re.compile(
    r"(?i)^(?:z|height|heights|value|values|data|hoehe|höhe)?[\s_-]*(?:unit|units|einheit)s?\W+(.+)$"
)
"""A line of a header that has the unit of all numbers."""


@dataclass(frozen=True)
class Column:
    """What a table says about one of its columns, as far as it does; reference: of its decibels; written: its cell."""

    name: str = ""
    unit: str = ""
    reference: str = ""
    written: str = field(default="", compare=False)

    def __str__(self) -> str:
        return f"{self.name} [{self.unit}]".strip() if self.unit else self.name

    def is_called(self, name: str) -> bool:
        """Whether it has this name, without its unit or with it, as the file writes it or as it is printed."""
        return plain(name) in {plain(one) for one in (self.name, str(self), self.written) if one}


def plain(text: str) -> str:
    """A name without what does not tell it from another: case, kinds of spaces, brackets and micro signs, quotes."""
    words = MICRO.sub("u", unicodedata.normalize("NFKC", text)).strip(' "').translate(BRACKETS)
    return " ".join(words.casefold().split())


def column_of(text: str) -> Column:
    """Name, unit and reference in a cell of a header. A unit in brackets need not be one of ours."""
    return replace(_column_of(text), written=text.strip())


def _column_of(text: str) -> Column:
    words = MICRO.sub("u", text.strip().strip('"').strip())
    if PLACE.fullmatch(words):
        return Column(words)
    inside = [(found, (found[1] or found[2] or "").strip()) for found in IN_BRACKETS.finditer(words)]
    known = [(found, unit) for found, unit in inside if _unit(unit) in KNOWN]
    if not known and (last := AT_THE_END.search(words)):
        return Column(words[: last.start()].strip(" _/,"), KNOWN[last[1]], _reference(words))
    if not inside:
        return Column(words)
    found, unit = (known or inside[-1:])[0]
    name = " ".join(f"{words[: found.start()]} {words[found.end() :]}".partition(" re ")[0].split())
    return Column(name.strip(" /_"), KNOWN.get(_unit(unit), _unit(unit)), _reference(words))


def _unit(words: str) -> str:
    """Of what stands in brackets, as "dB re 1 um" or "in mm"."""
    return words.removeprefix("in ").partition(" ")[0].rstrip(",;")


def _reference(words: str) -> str:
    found = REFERENCE.search(words)
    return found[1].strip() if found else ""


def columns_of(above: Sequence[str], count: int, delimiter: str) -> tuple[Column, ...]:
    """Of the nearest lines above so many columns: one with units, or one of names; without names where none has."""
    stripped = (line.strip().lstrip("#%/; ").strip() for line in above)
    # "Unit: nm" looks like two columns
    lines = [text for text in stripped if text and not UNIT_OF_ALL.match(text)][-3:]
    found = [tuple(map(column_of, cells)) for line in reversed(lines) if (cells := _cells(line, count, delimiter))]
    with_units = [i for i, columns in enumerate(found) if any(column.unit for column in columns)]
    if not with_units:
        return found[0] if found else (Column(),) * count
    columns = found[with_units[0]]
    if any(column.name for column in columns) or len(found) == with_units[0] + 1:
        return columns
    # a line of units below one of names
    names = found[with_units[0] + 1]
    return tuple(
        Column(one.name, two.unit, two.reference, one.written) for one, two in zip(names, columns, strict=True)
    )


def _cells(line: str, count: int, delimiter: str) -> list[str] | None:
    """So many cells of a header, between the delimiter of the rows or another."""
    if count == 1:
        return None if re.search(r"[;,\t]", line) else [line]
    for pattern in (re.escape(delimiter), r"\t", ";", ",", r"\s{2,}", r"\s+(?![\[(/])"):
        cells = re.split(pattern, line) if pattern else []
        if len(cells) == count or (len(cells) == count + 1 and not cells[-1].strip()):
            return cells[:count]
    return None


def unit_of_all(above: Sequence[str]) -> set[str]:
    """Units of length that lines of a header have for all numbers below: `z [um]` alone, or `Unit: um`."""
    found = set()
    for line in above:
        text = line.strip().lstrip("#%/; ").strip().strip('"')
        told = UNIT_OF_ALL.match(text)
        one = column_of(f"[{told[1].strip(' []()')}]" if told else text)
        alone = told or re.fullmatch(r"[^\s,;:\d]+[\s_/]*[\[(][^\])]*[\])]", text)
        if alone and one.unit in UNITS["length"]:
            found.add(one.unit)
    return found
