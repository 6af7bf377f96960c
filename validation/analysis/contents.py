"""Results and tables as the contents of files, and back: strict JSON, and CSV."""

import csv
import hashlib
import io
import math
import re
import unicodedata
from collections.abc import Callable, Mapping, Sequence
from html import escape
from typing import Any

from validation.analysis.escapes import cell_text, json_text, printable
from validation.analysis.evidence import Table

LEVELS = 4
"""Of a JSON file, that are written a line a part: results, cases, what a case has, its numbers."""
BOOLEAN = {"True": True, "False": False}
INTEGER = re.compile(r"-?\d+")
INTERVAL = ("low", "high")
VALUES = (*INTERVAL, "value")
VALUE = re.compile(r"value \[(.+)\]")
NO_NAME = re.compile(r"[^\w.+'-]+")
"""What a file name is better without."""
NO_KEY = re.compile(r"\W+", re.ASCII)
CONDITION_KEYS = {"H": "hurst", "Fbar": "normalised_load"}
"""Of the conditions whose name is a symbol."""
GREEK = {
    "α": "alpha",
    "β": "beta",
    "ζ": "zeta",
    "λ": "lambda",
    "μ": "u",
    "ν": "nu",
    "π": "pi",
    "ρ": "rho",
    "ω": "omega",
}
LONGEST_STEM, DIGITS = 55, 6
"""Of a file below `data`, without its ending; of the digest in one that was longer."""
LONGEST_NAME = 120
"""Bytes of the name of a folder; a file system takes 255 of each."""
RESERVED = {"con", "prn", "aux", "nul", "conin$", "conout$", "clock$"} | {
    f"{port}{number}" for port in ("com", "lpt") for number in "0123456789\u00b9\u00b2\u00b3"
}
"""Names that Windows keeps for devices."""


def as_json(value: object) -> bytes:
    """Strict JSON in UTF-8, keys in their order, a row of a table on one line; NaN and infinity raise ValueError."""
    return (_nested(value, LEVELS) + "\n").encode()


def finite_or_none(value: float) -> float | None:
    """JSON has neither NaN nor infinity."""
    return float(value) if math.isfinite(value) else None


def _nested(value: object, levels: int) -> str:
    if not levels or not value or not isinstance(value, dict | list | tuple):
        return json_text(value)
    indent = "\n" + " " * (LEVELS - levels)
    if isinstance(value, dict):
        parts = [f"{json_text(name)}: {_nested(part, levels - 1)}" for name, part in value.items()]
        return f"{{{','.join(f'{indent} {part}' for part in parts)}{indent}}}"
    return f"[{','.join(f'{indent} {_nested(part, levels - 1)}' for part in value)}{indent}]"


def plain_name(text: str) -> str:
    """The text as a part of a file name or an address: "k / (E* L)" becomes "k_E_L"."""
    return NO_NAME.sub("_", text).strip("_")


def ascii_text(text: str) -> str:
    """Greek letters by their names, superscripts as digits, letters without marks; any other letter is left out."""
    named = "".join(GREEK.get(letter, letter) for letter in unicodedata.normalize("NFKD", text))
    return named.encode("ascii", errors="ignore").decode()


def condition_key(name: str) -> str:
    """The key of a condition in JSON and CSV: "wavelength [mm]" becomes wavelength_mm, "q_r L / 2π" q_r_L_2pi."""
    return CONDITION_KEYS.get(name) or NO_KEY.sub("_", ascii_text(name).replace("'", "")).strip("_")


def conditions_in_json(where: Mapping[str, Any]) -> dict[str, Any]:
    """The same conditions, each name replaced by its `condition_key`."""
    return {condition_key(name): value for name, value in where.items()}


def folder_names(texts: Sequence[str]) -> list[str]:
    """A folder name for each text, valid on every file system and unique on those that ignore case.

    "law (1)" and "Law [1]" are "law_1" and "Law_1-2". Letters of any script stay, an empty name is "model", one that a
    system reserves begins with _. No name is longer than `LONGEST_NAME` bytes.
    """
    names: list[str] = []
    for text in texts:
        name = NO_NAME.sub("_", unicodedata.normalize("NFC", text)).strip("_.") or "model"
        if name.partition(".")[0].casefold() in RESERVED:
            name = f"_{name}"
        taken, number = {_as_stored(other) for other in names}, 1
        while _as_stored(numbered := _shortened(name, f"-{number}" if number > 1 else "")) in taken:
            number += 1
        names.append(numbered)
    return names


def _as_stored(name: str) -> str:
    """Equal for names that some file system takes for one."""
    return unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", name).casefold())


def _shortened(name: str, end: str) -> str:
    kept = name.encode()[: LONGEST_NAME - len(end)].decode(errors="ignore")
    return kept.rstrip("_.") + end


def data_name(case: str, table: str) -> str:
    """The name "case-table" by which lists of columns find a table; a table of a quantity has the key of that."""
    return f"{case}-{getattr(table, 'key', '') or plain_name(table)}"


def csv_name(case: str, table: str) -> str:
    """The file name of a table: `data_name` in ASCII; a long one is cut, and ends with a digest that keeps it apart."""
    name = plain_name(ascii_text(data_name(case, table)))
    if len(name) > LONGEST_STEM:
        digest = hashlib.sha256(name.encode()).hexdigest()[:DIGITS]
        beginning = name[: LONGEST_STEM - DIGITS].rpartition("_")[0]
        name = f"{beginning}-{digest}"
    return f"{name}.csv"


def header_of(table: Table) -> list[str]:
    """Names of its columns, those of values with the unit of the table."""
    return [f"{name} [{table.unit}]" if table.unit and name in VALUES else name for name in table.columns]


MOST_ROWS = 12
"""Of a table in a notebook."""
CELL = "text-align: left; padding: 0.1em 1em 0.1em 0; border-bottom: 1px solid currentColor"


def as_html(answer: str, columns: Mapping[str, Sequence[object]]) -> str:
    """An answer and a small table for a notebook: texts are no markup, colours are those of the page, also dark.

    columns: of equal length, by their heads; rows from `MOST_ROWS` on are counted.
    """
    rows = list(zip(*columns.values(), strict=True))
    more = f"<p>and {len(rows) - MOST_ROWS} more</p>" if len(rows) > MOST_ROWS else ""
    head = "".join(f'<th style="{CELL}">{escape(name)}</th>' for name in columns)
    lines = [
        "<tr>" + "".join(f'<td style="{CELL}">{escape(printable(str(cell)))}</td>' for cell in row) + "</tr>"
        for row in rows[:MOST_ROWS]
    ]
    table = f'<table style="border-collapse: collapse; color: inherit"><tr>{head}</tr>{"".join(lines)}</table>'
    return f"<div><p><strong>{escape(printable(answer))}</strong></p>{table}{more}</div>"


def as_csv(table: Table, *, drawn: bool = False) -> bytes:
    """Numbers to ten digits; what is not finite is left empty; the unit of values in their header; a text that a
    spreadsheet would compute begins with a quote.

    drawn: of a figure, to seven digits, more than a curve shows, without the interval of a value that does not scatter.
    Its texts are those of the package, and stay as they are.
    """
    digits, as_text = (7, printable) if drawn else (10, cell_text)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(map(as_text, header_of(table)))
    columns = {name: [_csv_cell(value, digits, as_text) for value in values] for name, values in table.columns.items()}
    if drawn and columns.keys() >= {*VALUES}:
        ends = zip(*(columns[name] for name in INTERVAL), columns["value"], strict=True)
        exact = [low == high == value for low, high, value in ends]
        columns |= {n: ["" if e else c for c, e in zip(columns[n], exact, strict=True)] for n in INTERVAL}
    writer.writerows(zip(*columns.values(), strict=True))
    return text.getvalue().encode()


def _csv_cell(value: object, digits: int, as_text: Callable[[str], str]) -> object:
    if isinstance(value, str):
        return as_text(value)
    if not isinstance(value, float):
        return value
    return f"{value:.{digits}g}" if math.isfinite(value) else ""


def from_csv(name: str, text: str) -> Table:
    """What `as_csv` wrote: numbers, NaN where a column of numbers is empty, True and False, else text."""
    header, *rows = csv.reader(io.StringIO(text))
    unit = next((match[1] for name in header if (match := VALUE.fullmatch(name))), "")
    names = [name.removesuffix(f" [{unit}]") if name.startswith(VALUES) else name for name in header]
    columns = dict(zip(names, zip(*rows, strict=True) if rows else [()] * len(names), strict=True))
    if columns.keys() >= {*VALUES}:
        columns |= {n: tuple(map(_cell_or_value, columns[n], columns["value"])) for n in INTERVAL}
    return Table(name, {column: _typed_column(cells) for column, cells in columns.items()}, unit)


def _cell_or_value(cell: str, value: str) -> str:
    return cell or value


def as_written(table: Table) -> Table:
    """What a reader of its CSV file has."""
    return from_csv(table.name, as_csv(table, drawn=True).decode())


def _typed_column(cells: Sequence[str]) -> Sequence[object]:
    """The cells as booleans, integers, floats (an empty cell is NaN) or texts: the first type that all of them have."""
    if all(cell in BOOLEAN for cell in cells):
        return [BOOLEAN[cell] for cell in cells]
    if all(INTEGER.fullmatch(cell) for cell in cells):
        return [int(cell) for cell in cells]
    try:
        return [float(cell) if cell else math.nan for cell in cells]
    except ValueError:
        return cells
