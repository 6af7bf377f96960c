"""How a text of numbers is written: encoding, delimiter, decimal sign, where its numbers begin, and names of columns.

Names of columns have units as tables of others have them: `x [mm]`, `height (um)`, `z/µm`, `level_dB`.
"""

import codecs
import csv
import math
import re
import unicodedata
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import accumulate, takewhile
from typing import IO

from validation.analysis.escapes import printable
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


MOST_LINES, LONGEST_LINE = 2**23, 2**25
"""Most lines of a file, and most characters of a line."""
MOST_HEADER, SAMPLE, RUN = 2000, 2**20, 3
"""Lines in which the first row of numbers is looked for, and characters; rows on end that make a table."""
MANY = 10
"""Rows to a line of a header that looks like one, at the least."""
CONTROL = re.compile(rb"[\x00-\x08\x0e-\x19\x1b-\x1f]")
"""Bytes that no text has."""
MARKS = ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16"))
COMMENTS = ("#", "%", "//", ";")
"""How a line begins that holds no numbers; one of a table between semicolons may have an empty first cell."""
WRITTEN = (
    *((sign, point) for sign in (";", "\t") for point in (".", ",")),
    *((",", "."), ("", "."), ("", ","), ("|", "."), ("|", ","), (",", ",")),
)
"""Delimiter, "" for white space, and decimal sign; commas for both stand between quotation marks."""
ERRORS = re.compile(
    r"#(?:div/0|value|n/a|ref|name|num|null|getting_data|spill|calc|overflow|wert|nv|bezug|zahl|error)[!?]?|#+|err:\d{3}"
    r"|[+-]?(?:1\.#)?inf(?:inity)?"
)
"""Cells of a formula without a result, in small letters, as spreadsheets write them, and what divides by zero."""
MISSING = frozenset(
    ("", "nan", "-nan", "nan(ind)", "-nan(ind)", "1.#qnan", "-1.#ind", "na", "n/a", "n.a.", "<na>", "null", "none")
) | {"nodata", "bad", "(null)", "n.d.", "nd", "missing", "error", "?", "-", "--", "---", "\N{EN DASH}", "\N{EM DASH}"}
"""Cells of points without data, in small letters; asterisks and `ERRORS` are, too."""
NO_DATA = re.compile(r"(?i)\bno data\b")
THOUSANDS = re.compile(r"[+-]?\d{1,3}(?:(?P<sign>[.,' \u00a0\u2009\u202f’])\d{3})(?:(?P=sign)\d{3})*(?P<rest>[.,]\d*)?")
"""Numbers with a sign between thousands."""
TIME = re.compile(
    r"\d{4}[-/.]\d{1,2}[-/.]\d{1,2}(?:[T ]\d{1,2}:.*)?|\d{1,2}[./-]\d{1,2}[./-]\d{2}(?:\d{2})?(?: \d{1,2}:.*)?"
    r"|\d{1,2}:\d{1,2}(?::\d{1,2}(?:[.,:]\d+)?)?(?: ?[aApP][mM])?(?:Z|[+-]\d{2}:?\d{2})?"
    r"|(?:[A-Za-z]{2,9}[.,]? )?(?:\d{1,2}\.?[ /-]?[A-Za-z]{3,9}\.?|[A-Za-z]{3,9}\.? \d{1,2},?)[ /-]\d{2,4}"
    r"(?:,?[ T]\d{1,2}:.*)?"
)
"""Dates, with names of months, too, and times of a day."""
FORTRAN = re.compile(r"[+-]?[\d.]+[dD][+-]?\d+")
COMMA = re.compile(r"[+-]?\d*,\d+")
STARTS = re.compile(r"\s*[-+]?\d").match
"""Whether a cell begins as a number does."""
SHOWN = 20
"""Characters of a cell that a message shows."""


@dataclass(frozen=True)
class Dialect:
    """delimiter: "" for white space; decimal: "." or ","; nodata: cells, in small letters, of points without data.

    numeric: cells of a row that are numbers, at the least, where others may be texts; None: all that have data; sure:
    whether the decimal sign is given, so that the other one stands between thousands.
    """

    delimiter: str
    decimal: str
    nodata: frozenset[str] = MISSING
    numeric: int | None = None
    sure: bool = False

    def cells(self, line: str) -> list[str]:
        """The cells of one line; quotation marks may stand around a delimiter."""
        if '"' in line and len(line) < csv.field_size_limit():
            return next(csv.reader([line.strip()], delimiter=self.delimiter or " ", skipinitialspace=True))
        return line.split(self.delimiter) if self.delimiter else line.split()

    def number(self, cell: str) -> float:
        """The number of one cell, NaN for one without data. Raises ValueError."""
        text = cell.strip().strip('"').strip()
        if self.says_missing(text):
            return math.nan
        text = self.without_thousands(text)
        if "_" in text or (self.decimal == "," and "." in text):
            raise ValueError(text)
        text = text.replace("\N{MINUS SIGN}", "-").replace(self.decimal, ".")
        return float(re.sub("[dD]", "e", text) if FORTRAN.fullmatch(text) else text)

    def says_missing(self, cell: str) -> bool:
        """Whether it is one without data."""
        text = cell.strip().strip('"').strip().lower()
        return text in self.nodata or bool(text and not text.strip("*")) or bool(ERRORS.fullmatch(text))

    def without_thousands(self, text: str) -> str:
        """A number without signs between its thousands, where these can be nothing else: any other text as it is.

        A comma or a point can be the decimal sign, unless it stands there twice or before the decimal sign.
        """
        match = THOUSANDS.fullmatch(text)
        if match is None or match["sign"] == self.decimal:
            return text
        sign, rest = match["sign"], match["rest"] or ""
        sure = rest[:1] == self.decimal or (not rest and (self.sure or sign not in ".," or text.count(sign) > 1))
        return text.replace(sign, "") if sure else text

    def numbers(self, cells: Sequence[str]) -> list[float]:
        """The numbers of the cells of a line, NaN for texts where `numeric` allows them. Raises ValueError."""
        if (plain := self.plain(cells)) is not None:
            return plain
        if self.numeric is None:
            return list(map(self.number, cells))
        values = [self.number(cell) if self.is_number(cell) else math.nan for cell in cells]
        if len(values) - sum(map(math.isnan, values)) < self.numeric:
            raise ValueError
        return values

    def plain(self, cells: Sequence[str]) -> list[float] | None:
        """Numbers of a line as Python writes them, as most are, but for the decimal sign; None of any other line."""
        # Python alone reads 1_000, and infinite ones are none
        if not any("_" in cell or (self.decimal == "," and "." in cell) for cell in cells):
            with suppress(ValueError):
                values = [float(cell.replace(self.decimal, ".")) for cell in cells]
                return None if any(map(math.isinf, values)) else values
        return None

    def is_number(self, cell: str) -> bool:
        """Whether a cell is one, and no point without data."""
        with suppress(ValueError):
            return not math.isnan(self.number(cell))
        return False

    def row(self, line: str, *, needs_data: bool = True) -> int:
        """How many columns a line of numbers has, 0 if it is none. needs_data: whether one at least must have data."""
        if self.delimiter == self.decimal and '"' not in line:
            return 0
        cells = self.cells(line)
        with suppress(ValueError):
            return len(cells) if not all(map(math.isnan, self.numbers(cells))) or not needs_data else 0
        return 0

    def says_nothing(self, line: str) -> bool:
        """Whether a line is blank, has nothing between its delimiters, or is a comment."""
        text = line.strip()
        if not text.strip(f'{self.delimiter}" \t'):
            return True
        return text.startswith(COMMENTS) and not (text.startswith(";") and self.delimiter == ";" and self.row(text))


def lines_of(file: IO[bytes], encoding: str | None) -> tuple[list[str], str]:
    """Lines of a text, and its encoding: `encoding`, that of its mark, UTF-8, or Windows-1252, which has Latin-1.

    Raises ValueError for what is no text, not in that encoding, or too long; the sentence shows nothing of the file.
    """
    contents = file.read()
    codec = encoding or next((name for mark, name in MARKS if contents.startswith(mark)), "")
    if codec and codecs.lookup(codec).name == "utf-8":
        codec = "utf-8-sig"
    for half, name in ((1, "utf-16-le"), (0, "utf-16-be")):
        if not codec and contents[half:4:2] == b"\x00\x00" and 0 not in contents[1 - half : 4 : 2]:
            codec = name
    if not re.search("16|32", codec) and CONTROL.search(contents):
        raise NoTextError("the file must be a text of numbers, got one with bytes that no text has")
    for candidate in (codec,) if codec else ("utf-8", "cp1252", "latin-1"):
        with suppress(UnicodeError):
            return _split_lines(contents.decode(candidate)), candidate
    raise NoTextError(f'the file must be a text in {codec}, got other bytes; encoding = "latin-1" is another')


class NoTextError(ValueError):
    """A file that holds no text."""


def _split_lines(text: str) -> list[str]:
    """Lines of bounded number and length, without comments behind numbers."""
    text = text.replace("\r\n", "\n").replace("\r", "\n").removesuffix("\n")
    lines = text.split("\n", MOST_LINES)
    if len(lines) > MOST_LINES or max(map(len, lines)) >= LONGEST_LINE:
        raise ValueError(
            f"the file must have at most {MOST_LINES} lines of at most {LONGEST_LINE} characters, got more"
        )
    # the two words of an interferometer, and the end of a file of DOS
    return [(NO_DATA.sub("nan", line) if "ata" in line else line).partition(" #")[0].rstrip("\x1a") for line in lines]


def sample_of(lines: Sequence[str], skip: int) -> Sequence[str]:
    """Lines from the top by which the dialect is recognised: those to skip, and at most `MOST_HEADER` below."""
    few = sum(characters <= SAMPLE for characters in accumulate(map(len, lines[skip : skip + MOST_HEADER])))
    return lines[: skip + min(max(few, RUN) + 1, MOST_HEADER)]


def recognise_dialect(
    lines: Sequence[str], skip: int, decimal: str | None, nodata: frozenset[str], numeric: int | None
) -> tuple[Dialect, int, int]:
    """How the first lines of a file are written, the index of its first row of numbers, and its number of columns.

    skip: lines at the top that are none of the table; numeric: as of a `Dialect`. Raises ValueError.
    """
    ways = [
        Dialect(sign, point, MISSING | nodata, numeric, sure=decimal is not None)
        for sign, point in WRITTEN
        if decimal in (None, point)
    ]
    starts = {way: start for way in ways if (start := _first_row(lines, skip, way))}
    if not starts:
        raise ValueError(_no_table_sentence(lines, skip, ways))
    first = min(starts.values())[0]
    # whole numbers are the same in any way of writing: later lines decide
    read = {way: _count_rows(lines[first:], way, width) for way, (start, width) in starts.items() if start == first}
    tied = {(way.delimiter, way.decimal, starts[way][1]): way for way in read if read[way] == max(read.values())}
    dialect, points = next(iter(tied.values())), tied.get((",", ".", 2))
    commas = next((way for (_, sign, width), way in tied.items() if (sign, width) == (",", 1)), None)
    if points and commas:
        dialect = commas if _has_decimal_commas(lines[skip:first], lines[first:], points) else points
    _check_above(lines, skip, first, dialect, starts[dialect][1])
    return dialect, *starts[dialect]


def _first_row(lines: Sequence[str], skip: int, dialect: Dialect) -> tuple[int, int] | None:
    """The index of the first of a few rows on end of equal length, and this length.

    Where cells may be texts, lines of a header look like rows: then it is the first of those up to the end.
    """
    first, columns, count = 0, 0, 0
    for i, line in enumerate(lines[skip:], skip):
        if dialect.says_nothing(line):
            continue
        width = dialect.row(line)
        first, columns, count = (first, columns, count + 1) if width == columns else (i, width, 1)
        if columns and count == RUN and dialect.numeric is None:
            break
    return (first, columns) if columns else None


def _count_rows(lines: Sequence[str], dialect: Dialect, columns: int) -> int:
    """How many lines a dialect reads as rows of so many columns before one that is none."""
    rows = (line for line in lines if not dialect.says_nothing(line))
    return sum(1 for _ in takewhile(lambda line: dialect.row(line, needs_data=False) == columns, rows))


def _has_decimal_commas(above: Sequence[str], rows: Sequence[str], points: Dialect) -> bool:
    """Whether lines as 1,25 are one column and not two, by the header or by the digits. Raises ValueError."""
    header = next((line for line in reversed(above) if line.strip()), "")
    if header:
        return header.count(",") != 1 or any(map(STARTS, header.split(",")))
    last = [points.cells(row)[1].strip() for row in rows if points.row(row) == 2]
    if all(text.isdigit() for text in last) and not any(text.startswith("0") and len(text) > 1 for text in last):
        raise ValueError(
            'rows as "1,25" must be two columns or one with decimal commas, got no header that tells it: say it, as: '
            'decimal = "," (or ".")'
        )
    return all(text.isdigit() for text in last)


def _check_above(lines: Sequence[str], skip: int, first: int, dialect: Dialect, columns: int) -> None:
    """Raises ValueError where a line of the table seems to stand above its first row."""
    header = [i for i in range(skip, first) if not dialect.says_nothing(lines[i])]
    if not header:
        return
    text_lines, last = [i for i in header if not dialect.row(lines[i]) == columns > 1], header[-1]
    alike = len(header) - len(text_lines)
    if alike and (dialect.numeric is None or MANY * alike > len(lines) - first):
        raise ValueError(about_row(lines[text_lines[-1]], text_lines[-1], dialect, columns))
    cells, before = dialect.cells(lines[last]), dialect.cells(lines[header[-2]]) if len(header) > 1 else []
    is_row = all(map(STARTS, cells)) or any(column_of(cell).unit for cell in before)
    if len(cells) == columns > 1 and any(map(dialect.is_number, cells)) and is_row:
        raise ValueError(about_row(lines[last], last, dialect, columns))
    if width := dialect.row(lines[last]):
        raise ValueError(
            f"rows must be of one length, got {width} numbers in line {last + 1} and {columns} in line {first + 1}:"
            f" lines above the numbers are left out, as: skip = {first}"
        )


def _no_table_sentence(lines: Sequence[str], skip: int, ways: Sequence[Dialect]) -> str:
    """Why these lines hold no table in any dialect, and the key that may mend it."""
    if not any(line.strip() for line in lines):
        return "the file must hold rows of numbers, got an empty file"
    if skip >= len(lines):
        return f"the file must hold rows of numbers, got no line below the {skip} to skip"
    last = max(i for i, line in enumerate(lines) if line.strip())
    numbers = {way: [_is_value(way, cell) for cell in way.cells(lines[last])] for way in ways}
    best = max(ways, key=lambda way: sum(numbers[way]))
    if 2 * sum(numbers[best]) >= len(numbers[best]):
        # the first of the lines above that are all like the last
        above = range(last, skip - 1, -1)
        alike = (i for i in above if [_is_value(best, cell) for cell in best.cells(lines[i])] != numbers[best])
        at = next(alike, skip - 1) + 1
        return about_row(lines[at], at, best, len(numbers[best]))
    if THOUSANDS.fullmatch(cell := best.cells(lines[last])[0].strip()):
        return about_thousands(cell, last)
    return (
        f"the file must hold rows of numbers, got none in its first {len(lines)} lines: skip leaves out more of them, "
        "encoding says how they are written"
    )


def _is_value(way: Dialect, cell: str) -> bool:
    """Whether a cell is a number or a time."""
    return way.is_number(cell) or bool(TIME.fullmatch(cell.strip().strip('"')))


def about_row(line: str, index: int, dialect: Dialect, columns: int) -> str:
    """Why a line is no row of a table of so many columns, and the key that may mend it, in a sentence."""
    cells = dialect.cells(line)
    for i, cell in enumerate(cells):
        try:
            dialect.number(cell)
        except ValueError:
            if THOUSANDS.fullmatch(cell.strip()):
                return about_thousands(cell, index)
            if TIME.fullmatch(cell.strip().strip('"')):
                return _time_sentence(cells, i, index, dialect)
            if dialect.decimal == "." and COMMA.fullmatch(cell.strip()):
                return f'decimal commas must be told, as: decimal = ",", got {token(cell)} in line {index + 1}'
            is_short = len(cell.strip()) <= SHOWN
            nodata_hint = f', a cell without data told, as: nodata = "{token(cell, bare=True)}"' if is_short else ""
            return (
                f"rows must be numbers, got {token(cell)} in column {i + 1} of line {index + 1}: a comment begins with "
                f"a #, a header is left out by skip, a column by columns{nodata_hint}"
            )
    return (
        f"rows must be of one length, got {len(cells)} {'cell' if len(cells) == 1 else 'cells'} in line {index + 1} of "
        f"a table of {columns}: lines above the numbers are left out by skip"
    )


def about_thousands(cell: str, index: int) -> str:
    """The sentence about a number whose sign may be decimal or stand between thousands, and the key that decides."""
    sign = '"."' if "," in cell else '","'
    return (
        f"a comma or a point must be a decimal sign or stand between thousands, got {token(cell)} in line {index + 1}, "
        f"which may be either: say it, as: decimal = {sign}"
    )


def _time_sentence(cells: Sequence[str], i: int, index: int, dialect: Dialect) -> str:
    """The sentence about a time stamp in a row, with the columns that can be read in its place."""
    readable_columns = [j + 1 for j, cell in enumerate(cells) if dialect.is_number(cell) or dialect.says_missing(cell)]
    return (
        f"columns must be numbers, got the time stamp {token(cells[i])} in column {i + 1} of line {index + 1}, "
        f"which is no place: it is left out, as: columns = {readable_columns or [2]}; of lines without a column of "
        'places spacing is told, too, as: spacing = "1 mm"'
    )


def token(cell: str, *, bare: bool = False) -> str:
    """The beginning of a cell, as a message may show it."""
    text = printable(cell.strip().strip('"'))
    text = text if len(text) <= SHOWN else f"{text[:SHOWN]}..."
    return text if bare else f"'{text}'"
