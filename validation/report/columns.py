"""What the columns of the CSV files of a report mean: a file of its own beside them."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from pathlib import Path

from validation.analysis.contents import as_csv, csv_name, header_of, plain_name
from validation.analysis.evidence import Table
from validation.analysis.series import JUDGED, UNIT
from validation.report.section import Section, numbers_table, written_tables
from validation.report.symbols import SYMBOLS

COLUMNS = "columns.csv"
EVERY, NO_UNIT, WORST = "*", "-", ", the worst point of the range"
"""For a file: all that have such a column."""
_MEANINGS: Mapping[str, str] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
_SYMBOLS = {symbol.name: symbol.says for symbol in SYMBOLS}


def columns_file(sections: Sequence[Section]) -> bytes:
    """A row a column: file, column, unit, meaning; what means the same in all files has one row."""
    rows = [row for section in sections for table in _written(section) for row in described(section.name, table)]
    unique = list(dict.fromkeys(rows))
    names = ("file", "column", "unit", "meaning")
    return as_csv(Table(COLUMNS, {name: [row[i] for row in unique] for i, name in enumerate(names)}))


def _written(section: Section) -> Sequence[Table]:
    return (*written_tables(section.evidence), numbers_table(section.numbers)) if section.evidence else ()


def described(case: str, table: Table) -> Iterator[tuple[str, str, str, str]]:
    """File, column, unit and meaning of each column of a table; no meaning where nobody has given one."""
    file, judged = csv_name(case, table.name), table.name.endswith(JUDGED)
    of_file = file.removesuffix(".csv").removesuffix(plain_name(f"_{JUDGED}") if judged else "")
    for header in header_of(table):
        unit, name = UNIT.search(header), UNIT.sub("", header).strip()
        own = _matching(f"{of_file}: {name}") or (_quantity(table) if name == "value" else "")
        own += WORST if own and judged and name == "value" else ""
        meaning = own or _MEANINGS.get(name) or _SYMBOLS.get(name) or _matching(name)
        yield (file if own else EVERY, header, unit[1] if unit else NO_UNIT, meaning)


def _matching(name: str) -> str:
    """Of the first pattern that is one of a file, or of all files, as the name is."""
    of_file = ": " in name
    return next((says for key, says in _MEANINGS.items() if (": " in key) is of_file and fnmatchcase(name, key)), "")


def _quantity(table: Table) -> str:
    """What the values of a table are."""
    if "quantity" in table.columns:
        return "of the quantity that is named beside it"
    return UNIT.sub("", table.name.removesuffix(JUDGED)).strip()
