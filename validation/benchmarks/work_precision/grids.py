"""Boundary elements on the charts: along cells, along residuals, and the two finest grids, which are extrapolated."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

from validation.benchmarks.timing import Configuration
from validation.benchmarks.work_precision.problem import BEM, LOOSE, POLONSKY_KEER
from validation.simulation.method import Method, Resolution


@dataclass(frozen=True, kw_only=True)
class Grids:
    """Resolutions of boundary elements.

    cells: on a length of the problem, ascending; polonsky_keer: those of them for the published iteration; tight:
    residual on all of these; tolerances: residuals on the grid `fixed`; per: the length.
    """

    cells: tuple[int, ...]
    fixed: int
    polonsky_keer: tuple[int, ...] = ()
    tight: float = 1e-5
    tolerances: tuple[float, ...] = (0.1, 1e-2, 1e-3)
    per: str = "a side"


@dataclass(frozen=True, kw_only=True)
class GridSeries:
    """Configurations of a problem along its grids. settings: of each of them."""

    grids: Grids
    scene: Any
    method: Method
    published: Method | None = None
    realisations: int = 0

    def configurations(self) -> tuple[Configuration, ...]:
        """The published iteration and ours along cells, and ours along the residual on one grid."""
        grids = self.grids
        published = self.published or self.method
        loose = f"residual #, {grids.fixed} cells {grids.per}"
        return (
            *(self._at(published, n, grids.tight, POLONSKY_KEER) for n in grids.polonsky_keer),
            *(self.on(n) for n in grids.cells),
            *(self._at(self.method, grids.fixed, residual, LOOSE, loose, residual) for residual in grids.tolerances),
        )

    def on(self, cells: int) -> Configuration:
        """Our solver on one grid."""
        return self._at(self.method, cells, self.grids.tight, BEM)

    def finest(self) -> tuple[Configuration, Configuration]:
        """The two finest grids."""
        coarse, fine = (self.on(n) for n in self.grids.cells[-2:])
        return coarse, fine

    def pairs(self) -> tuple[tuple[Configuration, Configuration], ...]:
        """Grids of which one has twice the cells of the other."""
        return tuple((self.on(n), self.on(2 * n)) for n in self.grids.cells if 2 * n in self.grids.cells)

    def _at(
        self, method: Method, cells: int, residual: float, label: str, parameter: str = "", value: float = 0.0
    ) -> Configuration:
        return Configuration(
            method=method,
            scene=self.scene,
            resolution=Resolution(size=cells, residual=residual),
            label=label,
            parameter=parameter or f"# cells {self.grids.per}",
            value=value or cells,
            realisations=self.realisations,
        )


class ExtrapolatedProblem(ABC):
    """A problem whose reference is extrapolated from its two finest grids."""

    @property
    @abstractmethod
    def grid_series(self) -> GridSeries:
        """Boundary elements along its grids."""

    def reference(self) -> tuple[Configuration, Configuration]:
        """The two finest grids."""
        return self.grid_series.finest()

    def pairs(self) -> tuple[tuple[Configuration, Configuration], ...]:
        """Other grids of which one has twice the cells of the other."""
        return tuple(pair for pair in self.grid_series.pairs() if pair != self.reference())
