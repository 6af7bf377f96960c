"""How values, verdicts and the status of claims are written on a page: the filters of the templates."""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import jinja2
from markupsafe import Markup, escape

from validation.analysis.contents import csv_name
from validation.analysis.escapes import printable
from validation.analysis.evidence import ClaimStatus, Table, Verdict, VerdictCell, Whose
from validation.analysis.number_text import in_seconds
from validation.report.columns import SYMBOLS, symbols_in

SYMBOL = {Verdict.WITHIN: "✓", Verdict.OUTSIDE: "≠", Verdict.INCONCLUSIVE: "?"}
STATUS_SYMBOL = {
    ClaimStatus.SUPPORTED: "✓",
    ClaimStatus.LIMITED: "(✓)",
    ClaimStatus.REFUTED: "✗",
    ClaimStatus.INCONCLUSIVE: "?",
}
"""Each status also has a border of its own, so that it is known without colour."""
PANEL = re.compile(r"^\([a-z]\)(, \([a-z]\))* ")
SENTENCE_END = re.compile(r"(?<=[.;]) (?=[A-Z(])")


def templates(*folders: Path) -> jinja2.Environment:
    """Those beside this file and in other folders, with the filters below."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader([Path(__file__).parent / "templates", *folders]),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=_without_controls,
    )
    environment.filters |= {
        "format_cell": format_cell,
        "format_status": format_status,
        "format_field": format_field,
        "map_of": map_of,
        "capitalized": capitalized,
        "of_one": of_one,
        "symbols_in": symbols_in,
        "in_seconds": in_seconds,
        "in_four_digits": in_four_digits,
    }
    environment.globals |= {"zip": zip, "csv_name": csv_name, "all_symbols": SYMBOLS}
    return environment


def _without_controls(value: object) -> object:
    """A text of a user's; what is markup already is ours."""
    return printable(value, lines=True) if isinstance(value, str) and not isinstance(value, Markup) else value


def format_status(status: ClaimStatus | None) -> Markup:
    """The status of a claim with its symbol and colour."""
    if status is None:
        return Markup('<span class="verdict no-result">– no result</span>')
    return Markup('<span class="verdict {}">{} {}</span>').format(status.css, STATUS_SYMBOL[status], status)


def in_four_digits(cell: object) -> str:
    """A number that is no whole one; anything else as it is."""
    return f"{cell:.4g}" if isinstance(cell, float) else str(cell)


def format_cell(cell: object) -> Markup:
    """A cell of a table, with its verdict where it has one."""
    if not isinstance(cell, VerdictCell):
        return escape("–" if cell != cell else in_four_digits(cell))
    verdict = cell.verdict
    badge = Markup('<span class="verdict {}">{} {}</span>').format(verdict.css, SYMBOL[verdict], verdict)
    after = f"; {cell.after}" if cell.after else ""
    return Markup("{}<br>{}{}").format(cell.text, badge, after)


def format_field(cell: object) -> Markup:
    """A cell of a map: the symbol of its verdict, a dash where it has none."""
    symbol, css = (SYMBOL[cell.verdict], cell.verdict.css) if isinstance(cell, VerdictCell) else ("–", "none")
    return Markup('<td class="{}" title="{}">{}</td>').format(css, str(cell), symbol)


class VerdictMap(NamedTuple):
    """heads: names of the columns that place a row; columns: those of verdicts; rows: places, then cells; summary: how
    many cells have each verdict."""

    heads: tuple[str, ...]
    columns: tuple[str, ...]
    rows: list[tuple[Sequence[object], Sequence[object]]]
    summary: str


def map_of(table: Table) -> VerdictMap | None:
    """None for a table that has fewer than two columns of verdicts, or a single row: it is read faster as it stands."""
    cells = {name: [cell for cell in column if isinstance(cell, VerdictCell)] for name, column in table.columns.items()}
    names, judged = tuple(cells), tuple(name for name, column_cells in cells.items() if column_cells)
    if len(judged) < 2 or len(table.columns[judged[0]]) < 2 or names[0] in judged:
        return None
    heads = names[: names.index(judged[0])]
    rows = zip(
        *(zip(*(table.columns[name] for name in column_cells), strict=True) for column_cells in (heads, judged)),
        strict=True,
    )
    verdicts = [cell.verdict for column_cells in cells.values() for cell in column_cells]
    summary = ", ".join(f"{verdicts.count(verdict)} {verdict}" for verdict in Verdict if verdict in verdicts)
    return VerdictMap(heads, judged, list(rows), summary)


def first_sentence(text: str) -> str:
    """Without the letter of a panel before it, and the full stop that ends it."""
    return capitalized(SENTENCE_END.split(PANEL.sub("", text), maxsplit=1)[0].rstrip(".;"))


def capitalized(text: str) -> str:
    """With a capital first, the rest as it was."""
    return text[:1].upper() + text[1:]


def of_one(origin: Whose) -> str:
    """ "Statement of the book", "Our hypothesis"."""
    return "Our hypothesis" if origin is Whose.HYPOTHESIS else f"Statement of {origin}"
