"""What a punch costs, counted: operator applications of boundary elements, springs of the 1D model."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from validation.analysis.evidence import Table
from validation.engine.engine import Outcome

WORK = "work"


@dataclass(frozen=True)
class Worked:
    """cells: on a side of the usual grid; springs: of a profile; applications: a contact with its stiffness."""

    cells: int
    springs: int
    applications: float

    @classmethod
    def of(cls, cells: int, springs: int, outcomes: Iterable[Outcome]) -> "Worked":
        """The mean over the loads, each the mean of what was found under it: light loads have more surfaces.

        outcomes: a row a surface and a column a load, NaN where a surface was not pressed.
        """
        found = [outcome["applications"] + outcome["frozen applications"] for outcome in outcomes]
        by_load = [np.nanmean(values, axis=0) for values in found]
        return cls(cells, springs, float(np.nanmean(np.concatenate(by_load))))

    @classmethod
    def read(cls, table: Table) -> "Worked":
        return cls(*(table[name][0].item() for name in cls._columns()))

    @property
    def table(self) -> Table:
        values = (self.cells, self.springs, self.applications)
        return Table(WORK, {name: [value] for name, value in zip(self._columns(), values, strict=True)})

    @staticmethod
    def _columns() -> tuple[str, ...]:
        return "cells on a side", "springs of a profile", "operator applications a load"
