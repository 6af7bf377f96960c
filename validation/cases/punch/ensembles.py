"""Ensembles of rough square punches: the settings that all cases about them share, and how they are pressed."""

import math
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

import numpy as np

from validation.analysis.evidence import Table
from validation.analysis.quantity import MEAN_STIFFNESS, RELATIVE_DEVIATION
from validation.analysis.series import Estimates, Ranges, spans
from validation.analysis.statistics import DECIBEL, Estimate, FloatArray, Statistic, jackknifed
from validation.case import Engine, Series
from validation.engine.engine import Outcome
from validation.simulation.rough_punch import (
    Profiles,
    PunchRoughness,
    Surface,
    describe_failures,
    force_levels,
    left_by_solver,
    press_profiles,
    press_surface,
    stacked,
)

WORK, CELLS, SPRINGS = "work", "cells on a side", "springs of a profile"
APPLICATIONS = "operator applications a load"


def worked(cells: int, springs: int, outcomes: Iterable[Outcome]) -> Table:
    """A contact with its stiffness on so many cells a side: the mean over loads, each the mean of what it took.

    outcomes: a row a surface and a column a load, NaN where a surface was not pressed: light loads have more.
    """
    counts = [outcome["applications"] + outcome["frozen applications"] for outcome in outcomes]
    mean_of_loads = float(np.nanmean(np.concatenate([np.nanmean(values, axis=0) for values in counts])))
    return Table(WORK, {CELLS: [cells], SPRINGS: [springs], APPLICATIONS: [mean_of_loads]})


MEAN, DEVIATION = MEAN_STIFFNESS, RELATIVE_DEVIATION
FORCE, OVER, FEW = "Fbar", "springs over boundary elements", "boundary elements, few cells"
K = TypeVar("K", bound=Hashable)
J = TypeVar("J", bound=Hashable)


@dataclass(frozen=True, kw_only=True)
class PunchEnsembles:
    """Rigid square punches of side L under equal forces, by both methods.

    Both are normalised alike, in units of L = E* = 1: Fbar = F / (E* h L), kbar = k / (E* L), h the rms height.

    cells: on a side; profiles: realisations; decades: powers of ten of the first and the last Fbar;
    per_decade: steps of force in one; points: springs of a profile; height: h / L; tolerance: residual of the solver;
    seed: zero or positive.
    """

    cells: int = 128
    profiles: int = 200
    decades: tuple[int, int] = (-2, 0)
    per_decade: int = 3
    points: int = 2048
    height: float = 1e-3
    tolerance: float = 1e-4
    seed: int

    @property
    def forces(self) -> tuple[float, ...]:
        """Levels of Fbar, ascending."""
        return force_levels(self.decades, self.per_decade)

    @property
    def first_forces(self) -> tuple[float, ...]:
        """The first Fbar of each decade."""
        return tuple(10.0**power for power in range(*self.decades))

    @property
    def by_decade(self) -> Ranges:
        """Levels of force of each decade, both ends with it."""
        return spans(self.forces, *((first, 10 * first) for first in self.first_forces))

    @property
    def in_decibels(self) -> partial[Series]:
        """Of natural logarithms at each force, judged decade by decade."""
        return partial(Series, along=FORCE, at=self.forces, scale=DECIBEL, unit="dB", ranges=self.by_decade)

    def family(self, count: int) -> int:
        """Numbers of a claim at most, whose intervals hold at once: decades of so many curves, of two quantities."""
        return 2 * len(self.first_forces) * count

    def band(self, hurst: float) -> PunchRoughness:
        """Self-affine from one wave on a side to four cells a wave, the same on every grid and by both methods."""
        return PunchRoughness(hurst=hurst, waves=(1, self.cells // 4), height=self.height, seed=self.seed)

    def surface_of(self, roughness: PunchRoughness, realisation: int, cells: int, forces: tuple[float, ...]) -> Surface:
        return Surface(
            roughness=roughness, realisation=realisation, cells=cells, forces=forces, tolerance=self.tolerance
        )

    def surfaces_of(self, roughness: PunchRoughness, cells: int, count: int, first: int = 0) -> list[Surface]:
        """So many realisations from the first on, at all forces."""
        return [self.surface_of(roughness, first + i, cells, self.forces) for i in range(count)]

    def profiles_of(self, roughness: PunchRoughness, points: int, length: float = 1.0) -> Profiles:
        """All profiles, to be pressed in a 1D model of length L_1D."""
        return Profiles(
            roughness=roughness, realisations=self.profiles, points=points, length=length, forces=self.forces
        )


def press(
    engine: Engine,
    surfaces: Mapping[K, Sequence[Surface]],
    profiles: Mapping[J, Profiles],
    solve: Callable[[Surface], Outcome] = press_surface,
) -> tuple[dict[K, Outcome], dict[J, Outcome], tuple[str, ...]]:
    """Outcomes of each group, one row a realisation; a line for each load that did not converge."""
    pressed = engine.map_groups(solve, surfaces)
    unconverged = [line for key, group in surfaces.items() for line in describe_failures(list(group), pressed[key])]
    springs = zip(profiles, engine.map(press_profiles, list(profiles.values())), strict=True)
    return {key: stacked(rows) for key, rows in pressed.items()}, dict(springs), tuple(unconverged)


def of_rows(statistic: Statistic, rows: FloatArray) -> FloatArray:
    """Of realisations, one a row."""
    return statistic(rows.mean(axis=0), rows.std(axis=0, ddof=1))


def change(statistic: Statistic, before: FloatArray, after: FloatArray) -> Estimates:
    """From one to another of the first realisations that both have, by the jackknife, since they are few."""
    count = min(len(before), len(after))
    pairs = np.stack([before[:count], after[:count]], axis=1)
    return Estimates(jackknifed(lambda rows: of_rows(statistic, rows[:, 1]) - of_rows(statistic, rows[:, 0]), pairs))


def with_solver(finer: Estimate | float) -> Estimate | float:
    """A change to half as long cells, with what the solver leaves of a mean at zero cell size in quadrature; a float,
    of springs or theory, as it is."""
    if not isinstance(finer, Estimate):
        return finer
    return replace(finer, value=math.hypot(finer.value, left_by_solver()))
