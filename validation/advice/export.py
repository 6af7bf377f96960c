"""A file of one quantity that a house beside writes for other programs."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pkgutil import resolve_name

from validation.advice.compare import Comparison
from validation.analysis.evidence import Table


@dataclass(frozen=True, kw_only=True)
class Export:
    """A file of one quantity for other programs, as an option of the command `compare`.

    option: as "--name"; quantity: its key; of: what has that quantity, in words; help: what it writes; place: of the
    function that makes the table of a comparison of that quantity, "module:function", imported when it is used.
    """

    option: str
    quantity: str
    of: str
    help: str
    place: str

    @property
    def name(self) -> str:
        return self.option.strip("-").replace("-", "_")

    def check(self, quantities: Iterable[str]) -> None:
        """Raises ValueError where it is not among those that are asked."""
        if self.quantity not in quantities:
            raise ValueError(
                f"{self.option} is for the quantity {self.quantity} of {self.of}, got {', '.join(quantities)}"
            )

    def written(self, comparisons: Iterable[Comparison]) -> bytes:
        """The rows of all scenes, as CSV."""
        table_of: Callable[[Comparison], Table] = resolve_name(self.place)
        # imported where a file is asked for
        from validation.analysis.contents import as_csv

        tables = [table_of(comparison) for comparison in comparisons if comparison.quantity == self.quantity]
        rows = {name: [value for table in tables for value in table.columns[name]] for name in tables[0].columns}
        return as_csv(Table(self.quantity, rows))
