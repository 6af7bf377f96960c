"""The symbols of the pages: one list, and which of them a text uses."""

import re
import tomllib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from validation.analysis.contents import plain_name


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
        return re.compile(rf"(?<!\w)(?:{'|'.join(map(re.escape, self.forms or (self.name,)))})(?![\w'*])")

    def stands_in(self, text: str) -> bool:
        """As a word of its own: h' is no h."""
        return self._pattern.search(text) is not None


_LIST = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))["symbol"]
SYMBOLS = tuple(Symbol(**{**row, "forms": tuple(row.get("forms", ()))}) for row in _LIST)


def symbols_in(text: str) -> list[Symbol]:
    """Those that a text uses, in the order of the list."""
    return [symbol for symbol in SYMBOLS if symbol.stands_in(text)]
