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
        return plain(name) in {plain(label) for label in (self.name, str(self), self.written) if label}


def plain(text: str) -> str:
    """A name without what does not tell it from another: case, kinds of spaces, brackets and micro signs, quotes."""
    words = MICRO.sub("u", unicodedata.normalize("NFKC", text)).strip(' "').translate(BRACKETS)
    return " ".join(words.casefold().split())


def column_of(text: str) -> Column:
    """Name, unit and reference in a cell of a header. A unit in brackets need not be one of ours."""
    return replace(_parse_column(text), written=text.strip())


def _parse_column(text: str) -> Column:
    """Name, unit and reference; a unit that is known precedes others in brackets, or stands at the end."""
    words = MICRO.sub("u", text.strip().strip('"').strip())
    if PLACE.fullmatch(words):
        return Column(words)
    brackets = [(match, (match[1] or match[2] or "").strip()) for match in IN_BRACKETS.finditer(words)]
    unit_brackets = [(match, unit) for match, unit in brackets if _bracket_unit(unit) in KNOWN]
    if not unit_brackets and (ending := AT_THE_END.search(words)):
        return Column(words[: ending.start()].strip(" _/,"), KNOWN[ending[1]], _decibel_reference(words))
    if not brackets:
        return Column(words)
    match, unit = (unit_brackets or brackets[-1:])[0]
    name = " ".join(f"{words[: match.start()]} {words[match.end() :]}".partition(" re ")[0].split())
    return Column(name.strip(" /_"), KNOWN.get(_bracket_unit(unit), _bracket_unit(unit)), _decibel_reference(words))


def _bracket_unit(words: str) -> str:
    """The unit of the words in brackets, as "dB" of "dB re 1 um" and "mm" of "in mm"."""
    return words.removeprefix("in ").partition(" ")[0].rstrip(",;")


def _decibel_reference(words: str) -> str:
    """The words behind "re", "ref" or "rel", as "1 um"; empty where there are none."""
    match = REFERENCE.search(words)
    return match[1].strip() if match else ""


def columns_of(above: Sequence[str], count: int, delimiter: str) -> tuple[Column, ...]:
    """Columns by the nearest lines of a header, one with units or one of names; without names where none has any."""
    stripped = (line.strip().lstrip("#%/; ").strip() for line in above)
    # "Unit: nm" looks like two columns
    lines = [text for text in stripped if text and not UNIT_OF_ALL.match(text)][-3:]
    headers = [
        tuple(map(column_of, cells)) for line in reversed(lines) if (cells := _header_cells(line, count, delimiter))
    ]
    with_units = [i for i, columns in enumerate(headers) if any(column.unit for column in columns)]
    if not with_units:
        return headers[0] if headers else (Column(),) * count
    columns = headers[with_units[0]]
    if any(column.name for column in columns) or len(headers) == with_units[0] + 1:
        return columns
    # a line of units below one of names
    names = headers[with_units[0] + 1]
    return tuple(
        Column(name_cell.name, unit_cell.unit, unit_cell.reference, name_cell.written)
        for name_cell, unit_cell in zip(names, columns, strict=True)
    )


def _header_cells(line: str, count: int, delimiter: str) -> list[str] | None:
    """Cells of a line of a header, between the delimiter of the rows or another; None unless there are `count`."""
    if count == 1:
        return None if re.search(r"[;,\t]", line) else [line]
    for pattern in (re.escape(delimiter), r"\t", ";", ",", r"\s{2,}", r"\s+(?![\[(/])"):
        cells = re.split(pattern, line) if pattern else []
        if len(cells) == count or (len(cells) == count + 1 and not cells[-1].strip()):
            return cells[:count]
    return None


def unit_of_all(above: Sequence[str]) -> set[str]:
    """Units of length that lines of a header have for all numbers below: `z [um]` alone, or `Unit: um`."""
    units = set()
    for line in above:
        text = line.strip().lstrip("#%/; ").strip().strip('"')
        match = UNIT_OF_ALL.match(text)
        column = column_of(f"[{match[1].strip(' []()')}]" if match else text)
        is_unit_line = match or re.fullmatch(r"[^\s,;:\d]+[\s_/]*[\[(][^\])]*[\])]", text)
        if is_unit_line and column.unit in UNITS["length"]:
            units.add(column.unit)
    return units
