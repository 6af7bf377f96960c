"""Stiffness of a rough punch whose surface is given, surface by surface, beside boundary elements on the same ones."""

import math
import time
from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np

from validation.analysis import judgement
from validation.analysis.judgement import RATIO
from validation.analysis.statistics import FloatArray, jackknifed, ratio_of_means, student
from validation.engine.engine import Engine
from validation.engine.offered import Caller, Failed
from validation.selection.judging.judge import Finding, ModelAnswer
from validation.selection.judging.references import Reference, curve
from validation.selection.judging.stiffness import DEVIATION, FORCE, HEIGHT, MEAN, MODULUS, SIDE, WAVES, H
from validation.simulation.light_punch import press_lightly
from validation.simulation.rough_punch import PunchRoughness, Surface, force_levels

CELLS, SEED, TOLERANCE = 256, 14, 1e-4
"""On a side, four to the shortest wave; of the surfaces of Fig. 14.1; residual of the solver."""
HURSTS, SURFACES = (0.4, 0.7, 1.0), 8
"""Surfaces of each H."""
FORCES = force_levels((-3, 1), 3)[::2]
SECONDS, FEWEST = 20.0, 3
"""After so long nothing more is asked; fewer surfaces have no error bar."""
OF_SURFACE, REALISATION = "stiffness of a surface", "surface"
Key = tuple[float, float]


def judged(model: Caller) -> Iterator[Finding]:
    """Each surface under each load; and mean and deviation over them, both on the same surfaces."""
    found: dict[Key, list[tuple[float, Reference]]] = {}
    end = time.perf_counter() + SECONDS
    # the first surface of each H, the second of each, and so on
    for (realisation, hurst), rows in groupby(sorted(curve(OF_SURFACE), key=_surface_of), _surface_of):
        height = SIDE * roughness(hurst).surface(CELLS, int(realisation.split()[-1]))
        for row in rows:
            if time.perf_counter() > end:
                yield Finding(OF_SURFACE, row, ModelAnswer(math.nan, reason=f"not asked: {SECONDS:g} s are over"))
                continue
            force = float(row.where[FORCE])
            load = force * MODULUS * HEIGHT * SIDE**2
            value = model.call(height=height, spacing=SIDE / CELLS, modulus=MODULUS, load=load)
            if not isinstance(value, Failed) and not value > 0:
                value = Failed(f"a stiffness of {value:.3g} N/m")
            if isinstance(value, Failed):
                yield Finding(OF_SURFACE, row, value)
                continue
            found.setdefault((hurst, force), []).append((float(value) / (MODULUS * SIDE), row))
            yield Finding(OF_SURFACE, row, ModelAnswer(found[hurst, force][-1][0]))
    for key, pairs in sorted(found.items()):
        if len(pairs) >= FEWEST:
            yield from _over_surfaces(key, pairs)


def _surface_of(row: Reference) -> tuple[str, float]:
    return str(row.where[REALISATION]), float(row.where[H])


def _over_surfaces(key: Key, pairs: Sequence[tuple[float, Reference]]) -> Iterator[Finding]:
    """Ratios of means and of deviations, whose scatter is that of the model beside the same surfaces."""
    both = np.array([(value, row.value) for value, row in pairs])
    where, grid = dict(zip((H, FORCE), key, strict=True)), float(np.mean([row.grid for _, row in pairs]))

    def log_ratio(rows: FloatArray) -> FloatArray:
        mine, other = rows.std(axis=0, ddof=1) / rows.mean(axis=0)
        return np.atleast_1d(np.log(max(mine, 1e-9)) - np.log(other))

    ratio, (apart,) = ratio_of_means(*both.T), jackknifed(log_ratio, both)
    for quantity, unit, (mine, known), half in (
        (MEAN, RATIO, both.mean(axis=0), ratio.half_width / ratio.value),
        (DEVIATION, judgement.DEVIATION, both.std(axis=0, ddof=1) / both.mean(axis=0), min(apart.half_width, 10.0)),
    ):
        yield Finding(quantity, Reference(where, float(known), 0.0, grid, unit), ModelAnswer(float(mine), half))


def roughness(hurst: float) -> PunchRoughness:
    """Of Fig. 14.1, in units of L = 1."""
    return PunchRoughness(hurst=hurst, waves=(1, WAVES), height=HEIGHT, seed=SEED, common=True)


def solved(engine: Engine) -> list[Reference]:
    """The references: k / (E* L) of each surface on the finer of two grids, in three minutes of one core.

    On single surfaces the error of the cells has either sign and is of no order, where few cells touch least of all:
    an answer on cells of no size cannot be told. As much is left as the finer grid and that which a model is given
    differ, by the root mean square over the surfaces of one H and load, with Student's quantile.
    """
    groups = {
        (hurst, cells): [
            Surface(roughness=roughness(hurst), realisation=i, cells=cells, forces=FORCES, tolerance=TOLERANCE)
            for i in range(SURFACES)
        ]
        for hurst in HURSTS
        for cells in (CELLS, 2 * CELLS)
    }
    found = engine.map_groups(press_lightly, groups)
    rows = []
    for hurst in HURSTS:
        coarse, fine = (np.log([one["stiffness"] for one in found[hurst, n]]) for n in (CELLS, 2 * CELLS))
        left = student(SURFACES) * np.sqrt(np.mean((fine - coarse) ** 2, axis=0))
        for (i, j), value in np.ndenumerate(fine):
            where: dict[str, float | str] = {H: hurst, REALISATION: f"surface {i}", FORCE: FORCES[j]}
            rows.append(Reference(where, math.exp(value), 0.0, float(left[j])))
    return rows
