"""What the multilevel estimate of Fig. 14.1 costs, beside plain sampling that leaves the same error."""

from collections.abc import Mapping
from itertools import pairwise
from statistics import mean

import numpy as np

from validation.analysis.multilevel import Linearised, moments
from validation.analysis.statistics import FloatArray
from validation.cases.punch.ensembles import Row
from validation.cases.punch.fractal_punch import Ensemble
from validation.cases.punch.fractal_punch_decades import DEVIATION, MEAN, PunchStatistics, stiffness_on_grids
from validation.simulation.rough_punch import BEM


def estimator(found: PunchStatistics) -> list[Row]:
    """One row a part of the forces and grid: surfaces, and what their best number follows from; NaN without any.

    variance: what one surface adds to that of ln deviation, by the step from the next coarser grid or on the coarsest,
    four times that of the last step, which the extrapolation doubles; work: cells times operator applications of a
    surface at these forces, over that of the finest; best: surfaces ~ sqrt(variance / work), for the same
    work in all (Giles 2015).
    """
    case = found.case
    rows = []
    for part, (first, last) in enumerate(case.parts):
        levels = [i for i, force in enumerate(case.forces) if case.part_of(force) == part]
        used = case.grids_at(case.forces[levels[0]])
        pairs = [(ensemble, level) for ensemble in found.result.ensembles for level in levels]
        work = {cells: mean(_work(ensemble, cells, level) for ensemble, level in pairs) for cells in used}
        steps = [_steps(stiffness_on_grids(ensemble, BEM, level)) for ensemble, level in pairs]
        variance = {cells: mean(step[cells] for step in steps) for cells in used}
        variance[used[-1]] *= 4
        counts = dict(zip(case.grids, case.surfaces[part], strict=True))
        best = {cells: (variance[cells] / work[cells]) ** 0.5 for cells in used}
        total = sum(counts[cells] * work[cells] for cells in used) / sum(best[cells] * work[cells] for cells in used)
        gains = {name: mean(_gain(found, name, e, level, work) for e, level in pairs) for name in (MEAN, DEVIATION)}
        for cells in used:
            row: Row = {"Fbar from": first, "Fbar to": last, "cells": float(cells), "surfaces": float(counts[cells])}
            row |= {"variance": variance[cells], "work": work[cells] / work[used[-1]], "best": total * best[cells]}
            rows.append(row | {f"plain over multilevel, {name}": gain for name, gain in gains.items()})
    return rows


def _work(ensemble: Ensemble, cells: int, level: int) -> float:
    """Cells times operator applications of a contact and its stiffness."""
    outcome = ensemble.outcomes[BEM][cells]
    applications = outcome["applications"][:, level] + outcome["frozen applications"][:, level]
    return cells**2 * float(np.nanmean(applications))


def _steps(pressed: Mapping[int, FloatArray]) -> dict[int, float]:
    """Variance of one surface's term of ln deviation on the coarsest grid, and of its change from grid to grid."""
    grids = list(pressed)
    changes = {grids[0]: _terms(pressed[grids[0]], pressed[grids[0]])}
    for coarse, fine in pairwise(grids):
        changes[fine] = _terms(pressed[fine], pressed[fine]) - _terms(pressed[coarse], pressed[fine])
    return {cells: change.error**2 * np.count_nonzero(change.influence) for cells, change in changes.items()}


def _terms(values: FloatArray, known: FloatArray, name: str = DEVIATION) -> Linearised:
    """Of plain sampling, over the realisations that are known on a grid."""
    plain = moments(values, np.isfinite(known) & np.isfinite(values))
    return plain.log_mean if name == MEAN else plain.log_relative_deviation


def _gain(found: PunchStatistics, name: str, ensemble: Ensemble, level: int, work: Mapping[int, float]) -> float:
    """Work of plain sampling, extrapolated from the two finest grids alike, over that of all grids, at equal error."""
    pressed = stiffness_on_grids(ensemble, BEM, level)
    middle, fine = list(pressed)[-2:]
    plain = 2.0 * _terms(pressed[fine], pressed[fine], name) - _terms(pressed[middle], pressed[fine], name)
    surfaces = (
        np.isfinite(pressed[fine]).sum() * (plain.error / found.at(ensemble.hurst, BEM, name, level).value.error) ** 2
    )
    force = found.case.forces[level]
    multilevel = sum(found.case.count(force, cells) * work[cells] for cells in pressed)
    return float(surfaces * (work[middle] + work[fine]) / multilevel)
