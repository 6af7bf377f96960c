"""Boundary elements on a chart of speed against accuracy: along cells, along residuals, and two finest grids beyond."""

from dataclasses import dataclass
from typing import Any, ClassVar

from validation.benchmarks.work_precision.measurement import BEM, LOOSE, PLAIN, Configuration


@dataclass(frozen=True, kw_only=True)
class OnGrids:
    """A scene that boundary elements solve on several grids.

    cells: on a length of the scene, ascending; plain: those of them for the textbook's iteration; tight: residual on
    all of these; tolerances: residuals on the grid `fixed`.
    """

    cells: tuple[int, ...]
    plain: tuple[int, ...] = ()
    fixed: int
    tight: float = 1e-5
    tolerances: tuple[float, ...] = (0.1, 1e-2, 1e-3)
    per: ClassVar[str] = "a side"
    """The length."""

    def on_grid(self, **settings: Any) -> Configuration:
        """An attempt with its line, knob, value, cells and tolerance."""
        raise NotImplementedError

    def grids(self) -> tuple[Configuration, ...]:
        """Plain and fast boundary elements along cells, and along the residual on one grid."""
        return (
            *(self._along_cells(PLAIN, n) for n in self.plain),
            *(self._along_cells(BEM, n) for n in self.cells),
            *(
                self.on_grid(
                    line=LOOSE,
                    knob=f"residual #, {self.fixed} cells {self.per}",
                    value=tolerance,
                    cells=self.fixed,
                    tolerance=tolerance,
                )
                for tolerance in self.tolerances
            ),
        )

    def pairs(self) -> tuple[tuple[Configuration, Configuration], ...]:
        """Grids of which one has twice the cells of the other."""
        doubled = [n for n in self.cells if 2 * n in self.cells]
        return tuple((self._along_cells(BEM, n), self._along_cells(BEM, 2 * n)) for n in doubled)

    def _along_cells(self, line: str, cells: int) -> Configuration:
        return self.on_grid(line=line, knob=f"# cells {self.per}", value=cells, cells=cells, tolerance=self.tight)


@dataclass(frozen=True, kw_only=True)
class Refined(OnGrids):
    """A scene whose answer nobody knows: its two finest grids give the reference."""

    def reference(self) -> tuple[Configuration, Configuration]:
        """The two finest grids."""
        coarse, fine = (self._along_cells(BEM, n) for n in self.cells[-2:])
        return coarse, fine

    def pairs(self) -> tuple[tuple[Configuration, Configuration], ...]:
        """Grids of which one has twice the cells of the other; not those of the reference."""
        return tuple(pair for pair in super().pairs() if pair != self.reference())
