"""Boundary elements for a body that is pressed: surfaces on a grid, and what coarser grids say of its error."""

import math
import warnings
from dataclasses import dataclass
from itertools import chain
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

import bem3d
from validation.scenes.indentation import IndentationScene
from validation.selection.hierarchy import (
    BOUNDARY_ELEMENTS,
    STUDENT,
    Answer,
    grid_error,
    mean_error,
    realisations,
)
from validation.simulation.calibrated_range import SCATTER
from validation.simulation.indentation import cells_wanted, ground_of, height_of, highest_of, holds_waves, side_of
from validation.simulation.method import Resolution, Values
from validation.simulation.model import Cost, ErrorEstimate
from validation.simulation.pressed import PressedGrid
from validation.simulation.resolution import too_few

FloatArray = NDArray[np.float64]

CELL, PRESS = 2.0e-8, 3.5e-3
"""Seconds that a cell takes in an application, and what else a contact, about."""
RESIDUAL = 1e-4
APPLICATIONS = 24
"""Of the operator, to a contact and its stiffness."""
SPHERE_SCATTER = 0.3
"""Relative deviation of the stiffness of one rough sphere, over h/d, about."""
EDGE = 0.35
"""Error of the stiffness of a flat square punch times its cells a side."""
FEWEST, MOST = 8, 1000
"""Surfaces: of which a deviation is estimated, and that are drawn at the most."""


@dataclass(frozen=True)
class IndentationOnGrid:
    """Surfaces on cells x cells, with the waves that those carry: what half as many a side change is the error.

    A measured surface is itself; on a coarser grid, the mean of its points in each cell.
    """

    kind: ClassVar = BOUNDARY_ELEMENTS

    scene: IndentationScene
    tolerance: float
    seed: int
    cells: int

    @property
    def name(self) -> str:
        """With the cells of its grid."""
        return f"{self.kind} {self.cells}²"

    @property
    def measured(self) -> bool:
        """Whether there is a single surface."""
        return ground_of(self.scene).is_single

    @property
    def count(self) -> int:
        """Surfaces that are expected to leave half of the tolerance."""
        return 1 if self.measured else realisations(self._scatter, self.tolerance / 2, least=FEWEST, most=MOST)

    @property
    def _scatter(self) -> float:
        """Of one drawn surface, relative, about."""
        return SCATTER if self.scene.shape == "punch" else SPHERE_SCATTER * self.scene.roughness_ratio

    def cost(self) -> Cost:
        """Operator applications times cells, on this grid and for some surfaces on the next coarser one."""
        return self._cost(self.count, min(self.count, FEWEST))

    def estimate(self) -> ErrorEstimate:
        """The sample's part: only a solve tells what the grid leaves."""
        if not holds_waves(self.scene, self._grids[-1]):
            return ErrorEstimate.out_of_range(
                f"a grid of {self._grids[-1]}² cells, the reference of its grid error, resolves no wave"
            )
        sample = 0.0 if self.measured else max(self.tolerance / 2, STUDENT * self._scatter / math.sqrt(MOST))
        return ErrorEstimate(
            error=sample, reason="sample only: the grid error is estimated from coarser grids after the solve"
        )

    def solve(self) -> Answer:
        """The mean stiffness, surface by surface until the sample leaves half of the tolerance."""
        found: list[StiffnessOnGrid] = []
        while not self._has_enough(found):
            found.append(self._pressed(len(found), self.cells))
        coarse = [[self._pressed(i, cells) for cells in self._grids] for i in range(min(len(found), FEWEST))]
        cost, contacts = self._cost(len(found), len(coarse)), [*found, *chain.from_iterable(coarse)]
        if lost := [contact.failed for contact in contacts if contact.failed]:
            failed = f"{len(lost)} of {len(contacts)} contacts {lost[0]}"
            return Answer(value=np.array([np.nan]), cost=cost, failed=failed)
        fine = np.array([contact.stiffness for contact in found])
        grid, reason = self._left_by_the_grid(found, coarse)
        return Answer(
            value=np.array([fine.mean()]),
            cost=cost,
            grid=grid,
            sample=0.0 if self.measured else mean_error(fine[:, np.newaxis] / fine.mean()),
            reason=f"{reason}, surfaces: {fine.size}",
            failed=too_few(float(np.median([contact.cells for contact in found])), "cells")
            or ("" if math.isfinite(grid) else f"{reason}, no less than the step before did: no error estimate"),
        )

    def _left_by_the_grid(
        self, found: "list[StiffnessOnGrid]", coarse: "list[list[StiffnessOnGrid]]"
    ) -> tuple[float, str]:
        """Half-width of 95 %, infinite where grids do not converge, and what it rests on."""
        levels = np.log(
            [[fine.stiffness, *(c.stiffness for c in row)] for fine, row in zip(found, coarse, strict=False)]
        )
        changes = levels[:, :-1] - levels[:, 1:]
        if self.measured:
            grid = self._grid_of_one(changes[0]) + self._hidden(found[0])
        else:
            grid = grid_error(changes[:, 1], changes[:, 0])
        last = math.expm1(float(changes[:, 0].mean()))
        return grid, f"{self.cells}² cells change {self.cells // 2}² by {last:+.1%}"

    @property
    def _grids(self) -> tuple[int, ...]:
        """Coarser ones, each of half as many cells a side: two, of a single surface three."""
        return tuple(self.cells // 2**i for i in range(1, 4 if self.measured else 3))

    def _cost(self, fine: int, coarse: int) -> Cost:
        """Of surfaces on this grid, and on the coarser ones."""
        work = APPLICATIONS * float(fine * self.cells**2 + coarse * sum(cells**2 for cells in self._grids))
        return Cost(
            work=work, unit="cell applications", seconds=CELL * work + PRESS * (fine + len(self._grids) * coarse)
        )

    def _grid_of_one(self, changes: FloatArray) -> float:
        """The largest of the last changes, those before halved for each doubling since, with half as much again.

        One face may hide any of them, but not the edge of a punch; and as much for each doubling that is left to the
        points of the face, which have waves that this one has not. Infinite where the last change is the largest.
        """
        last, *before = np.abs(changes)
        if last >= max(before):
            return math.inf if last > 0 else 0.0
        edge = EDGE / self.cells if self.scene.shape == "punch" else 0.0
        change = max(last, before[0] / 2, before[1] / 4, edge)
        return float(1.5 * change * (1 + math.log2(cells_wanted(self.scene) / self.cells)))

    def _hidden(self, found: "StiffnessOnGrid") -> float:
        """What the mean over cells may hide: the change of the logarithm by the highest point of each in its place."""
        highest = highest_of(self.scene, self.cells)
        if np.array_equal(highest, height_of(self.scene, self.cells, 0, self.seed)):
            return 0.0
        pressed = self._on(highest)
        return math.inf if pressed.failed else abs(math.log(pressed.stiffness / found.stiffness))

    def _has_enough(self, found: "list[StiffnessOnGrid]") -> bool:
        if self.measured or len(found) < FEWEST:
            return self.measured and len(found) == 1
        drawn = np.array([one.stiffness for one in found])
        left = mean_error(drawn[:, np.newaxis] / drawn.mean())
        return not left > self.tolerance / 2 or len(found) >= MOST

    def _pressed(self, realisation: int, cells: int) -> "StiffnessOnGrid":
        return self._on(height_of(self.scene, cells, realisation, self.seed))

    def _on(self, height: FloatArray) -> "StiffnessOnGrid":
        resolution = Resolution(size=len(height), residual=RESIDUAL)
        solve = PressedGrid(warm_up=False).prepare(RoughBody(self.scene, height), resolution)(0)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always", bem3d.ContactWarning)
            try:
                values = solve().values
            except bem3d.ConvergenceError:
                return StiffnessOnGrid(math.nan, 0, "did not converge")
        # too few cells are counted, and a punch ends where its grid does
        at_edge = self.scene.shape == "sphere" and any(issubclass(one.category, bem3d.EdgeWarning) for one in said)
        failed = "the contact reached the edge of the grid" * at_edge
        return StiffnessOnGrid(float(values["stiffness"]), int(values["cells"]), failed)


@dataclass(frozen=True, eq=False)
class RoughBody:
    """The body of a scene with given heights of its face."""

    scene: IndentationScene
    height: FloatArray

    def load(self, cells: int) -> dict[str, float]:
        """Its force."""
        return {"force": self.scene.load}

    def half_space(self, cells: int) -> bem3d.HalfSpace:
        """As wide as what it may touch."""
        spacing = side_of(self.scene) / cells
        return bem3d.HalfSpace(shape=(cells, cells), spacing=spacing, modulus=self.scene.modulus)

    def gap(self, cells: int, realisation: int) -> FloatArray:
        """Of the rough face, below a sphere with r^2 / 2R."""
        if self.scene.shape == "punch":
            return -self.height
        x = ((np.arange(cells) + 0.5) / cells - 0.5) * side_of(self.scene)
        return -self.height + (x[:, np.newaxis] ** 2 + x**2) / (2 * self.scene.size)

    def finish(self, contact: bem3d.Contact) -> bem3d.FixedContactArea:
        """The stiffness."""
        return bem3d.solve_fixed_area(contact.problem.half_space, contact.pressure > 0)

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values:
        """The stiffness, and the cells in contact."""
        assert fixed is not None
        return {"stiffness": np.array(fixed.stiffness), "cells": np.array(np.count_nonzero(contact.pressure))}


class StiffnessOnGrid(NamedTuple):
    """One contact: its stiffness [N/m], the cells in it, and why it is none."""

    stiffness: float
    cells: int
    failed: str = ""
