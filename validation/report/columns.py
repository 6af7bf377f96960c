"""What the columns of the CSV files of a report mean: a file of its own beside them."""

import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cached_property
from pathlib import Path

from validation.analysis.contents import as_csv, csv_name, data_name, header_of, plain_name
from validation.analysis.evidence import Table
from validation.analysis.series import JUDGED, UNIT
from validation.engine.street import files_of_houses
from validation.report.section import Section, numbers_table, written_tables


@dataclass(frozen=True, kw_only=True)
class Symbol:
    """name: as it is printed; says: its meaning in a line; more: what the whole list has beside it; forms: what stands
    for it in a text, by default its name.
    """

    name: str
    says: str
    more: str = ""
    forms: tuple[str, ...] = ()

    @property
    def address(self) -> str:
        """On the page of all symbols."""
        return f"symbol-{plain_name(self.name)}"

    @cached_property
    def _pattern(self) -> re.Pattern[str]:
        """Any of its forms, or its name, where no letter or prime stands beside it."""
        return re.compile(rf"(?<!\w)(?:{'|'.join(map(re.escape, self.forms or (self.name,)))})(?![\w'*])")

    def stands_in(self, text: str) -> bool:
        """As a word of its own: h' is no h."""
        return self._pattern.search(text) is not None


_LIST = tomllib.loads(Path(__file__).with_name("symbols.toml").read_text(encoding="utf-8"))["symbol"]
SYMBOLS = tuple(Symbol(**{**row, "forms": tuple(row.get("forms", ()))}) for row in _LIST)


def symbols_in(text: str) -> list[Symbol]:
    """Those that a text uses, in the order of the list."""
    return [symbol for symbol in SYMBOLS if symbol.stands_in(text)]


COLUMNS = "columns.csv"
EVERY, NO_UNIT, WORST = "*", "-", ", the worst point of the range"
"""For a file: all that have such a column."""
_MEANINGS: Mapping[str, str] = {
    pattern: meaning
    for path in (Path(__file__).with_suffix(".toml"), *files_of_houses("columns.toml"))
    for pattern, meaning in tomllib.loads(path.read_text(encoding="utf-8")).items()
}
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
    of_file = data_name(case, table.name).removesuffix(plain_name(f"_{JUDGED}") if judged else "")
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
