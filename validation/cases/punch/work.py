"""What a punch costs, counted: operator applications of boundary elements, springs of the 1D model."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from operator import attrgetter
from statistics import mean

import numpy as np

from validation.analysis.evidence import Table
from validation.analysis.multilevel import Linearised, moments, multilevel_moments, on_no_size
from validation.analysis.statistics import FloatArray
from validation.cases.punch.ensembles import DEVIATION, MEAN
from validation.engine.engine import Outcome

WORK, CELLS, SPRINGS = "work", "cells on a side", "springs of a profile"
APPLICATIONS = "operator applications a load"
LOGARITHMS = {MEAN: attrgetter("log_mean"), DEVIATION: attrgetter("log_relative_deviation")}


def worked(cells: int, springs: int, outcomes: Iterable[Outcome]) -> Table:
    """A contact with its stiffness on so many cells a side: the mean over loads, each the mean of what it took.

    outcomes: a row a surface and a column a load, NaN where a surface was not pressed: light loads have more.
    """
    found = [outcome["applications"] + outcome["frozen applications"] for outcome in outcomes]
    mean_of_loads = float(np.nanmean(np.concatenate([np.nanmean(values, axis=0) for values in found])))
    return Table(WORK, {CELLS: [cells], SPRINGS: [springs], APPLICATIONS: [mean_of_loads]})


OnGrids = Mapping[int, FloatArray]
"""Of each realisation, on each grid, cells on a side; coarse to fine; NaN where it was not pressed."""


def estimator(
    counts: Mapping[int, int], stiffness: Sequence[OnGrids], work: Sequence[OnGrids]
) -> list[dict[str, float]]:
    """What the multilevel estimate costs beside plain sampling that leaves the same error: a row a grid.

    counts: surfaces on each grid; stiffness, work: at each of several forces, work the operator applications.
    variance: what one surface adds to that of ln deviation, by the step from the next coarser grid or on the coarsest,
    four times that of the last step, which the extrapolation doubles; work: cells times operator applications of a
    surface, over that of the finest; best: surfaces ~ sqrt(variance / work), for the same work in all (Giles 2015);
    plain over multilevel: work of plain sampling on the two finest grids, on_no_size alike, at equal error.
    """
    cost = {n: mean(_cost(one[n], n) for one in work) for n in counts}
    steps = [_steps(one) for one in stiffness]
    variance = {n: mean(step[n] for step in steps) for n in counts}
    middle, finest = list(counts)[-2:]
    variance[finest] *= 4
    best = {n: (variance[n] / cost[n]) ** 0.5 for n in counts}
    multilevel = sum(counts[n] * cost[n] for n in counts)
    scale = multilevel / sum(best[n] * cost[n] for n in counts)
    plain = (cost[middle] + cost[finest]) / multilevel
    gains = {name: plain * mean(_plain_surfaces(one, name) for one in stiffness) for name in (MEAN, DEVIATION)}
    return [
        {
            "cells": float(n),
            "surfaces": float(counts[n]),
            "variance": variance[n],
            "work": cost[n] / cost[finest],
            "best": scale * best[n],
            **{f"plain over multilevel, {name}": gain for name, gain in gains.items()},
        }
        for n in counts
    ]


def _cost(applications: FloatArray, cells: int) -> float:
    """Of a surface: cells times operator applications."""
    return cells**2 * float(np.nanmean(applications))


def _steps(stiffness: OnGrids) -> dict[int, float]:
    """Variance of one surface's term of ln deviation on the coarsest grid, and of its change from grid to grid."""
    grids = list(stiffness)
    changes = {grids[0]: _plain(stiffness[grids[0]], stiffness[grids[0]])}
    for coarse, fine in pairwise(grids):
        changes[fine] = _plain(stiffness[fine], stiffness[fine]) - _plain(stiffness[coarse], stiffness[fine])
    return {n: change.error**2 * np.count_nonzero(change.influence) for n, change in changes.items()}


def _plain(values: FloatArray, known: FloatArray, name: str = DEVIATION) -> Linearised:
    """Of plain sampling, over the realisations that are known on a grid."""
    found: Linearised = LOGARITHMS[name](moments(values, np.isfinite(known) & np.isfinite(values)))
    return found


def _plain_surfaces(stiffness: OnGrids, name: str) -> float:
    """How many plain sampling needs, on_no_size from the two finest grids alike, for the error of all grids."""
    middle, fine = list(stiffness.values())[-2:]
    plain = 2.0 * _plain(fine, fine, name) - _plain(middle, fine, name)
    multilevel = on_no_size([LOGARITHMS[name](one) for one in multilevel_moments(list(stiffness.values()))])
    return float(np.isfinite(fine).sum() * (plain.error / multilevel.value.error) ** 2)
