"""A table of verdicts as a map: a lettered and coloured field for each verdict, small enough to see them at once."""

from collections.abc import Sequence
from dataclasses import dataclass

from validation.analysis.evidence import Table, Verdict, VerdictCell

LETTER = {Verdict.AGREE: "A", Verdict.DIFFER: "D", Verdict.UNDECIDED: "?"}


@dataclass(frozen=True)
class Field:
    """letter, kind: of its verdict, "–" and "none" where there is none; text: the cell of the table."""

    letter: str
    kind: str
    text: str


@dataclass(frozen=True)
class VerdictMap:
    """heads: names of the columns that place a row; columns: those of verdicts; rows: places, then fields."""

    heads: tuple[str, ...]
    columns: tuple[str, ...]
    rows: tuple[tuple[tuple[str, ...], tuple[Field, ...]], ...]

    @property
    def summary(self) -> str:
        """How many fields have each verdict."""
        kinds = [field.kind for _, fields in self.rows for field in fields]
        return ", ".join(f"{kinds.count(v)} {v}" for v in Verdict if v in kinds)


def map_of(table: Table) -> VerdictMap | None:
    """None for a table that has fewer than two columns of verdicts, or a single row: it is read faster as it stands."""
    judged = [name for name, column in table.columns.items() if _has_verdicts(column)]
    names = list(table.columns)
    if len(judged) < 2 or len(table.columns[judged[0]]) < 2 or names[0] in judged:
        return None
    heads = names[: names.index(judged[0])]
    places = list(zip(*(table.columns[name] for name in heads), strict=True))
    fields = list(zip(*(table.columns[name] for name in judged), strict=True))
    rows = tuple(
        (tuple(_printed(cell) for cell in place), tuple(_field(cell) for cell in found))
        for place, found in zip(places, fields, strict=True)
    )
    return VerdictMap(tuple(heads), tuple(judged), rows)


def _has_verdicts(column: Sequence[object]) -> bool:
    return any(isinstance(cell, VerdictCell) for cell in column)


def _field(cell: object) -> Field:
    if isinstance(cell, VerdictCell):
        return Field(LETTER[cell.verdict], str(cell.verdict), str(cell))
    return Field("–", "none", str(cell))


def _printed(cell: object) -> str:
    return f"{cell:.4g}" if isinstance(cell, float) else str(cell)
