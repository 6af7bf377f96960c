"""Stiffness of a rough punch whose surface is given, surface by surface, beside boundary elements on the same ones."""

import math
import time
from collections.abc import Iterator, Sequence
from itertools import groupby, product

import numpy as np

from validation.analysis.statistics import FloatArray, jackknifed, ratio_of_means, student
from validation.engine.engine import Engine, Outcome
from validation.judging import judgement
from validation.judging.judgement import RATIO, Conditions
from validation.judging.kinds import stiffness
from validation.judging.kinds.judge import Finding, ModelAnswer
from validation.judging.kinds.references import Reference, reference_rows
from validation.judging.kinds.stiffness import DEVIATION, FORCE, HEIGHT, MEAN, MODULUS, SIDE, WAVES, H, load_of
from validation.judging.registry import Caller, Failed
from validation.simulation.rough_punch import PunchRoughness, Surface, force_levels, press_lightly

CELLS, SEED, TOLERANCE = 256, 14, 1e-4
"""On a side, four to the shortest wave; of the surfaces of Fig. 14.1; residual of the solver."""
HURSTS, SURFACES = (0.4, 0.7, 1.0), 8
"""Surfaces of each H."""
FORCES = force_levels((-3, 1), 3)[::2]
SECONDS, FEWEST = 20.0, 3
"""After so long nothing more is asked; fewer surfaces have no error bar."""
OF_SURFACE, REALISATION = "stiffness of a surface", "surface"


def judged(model: Caller) -> Iterator[Finding]:
    """Each surface under each load; and mean and deviation over them, both on the same surfaces."""
    answers: dict[tuple[float, float], list[tuple[float, Reference]]] = {}
    end = time.perf_counter() + SECONDS
    # the first surface of each H, the second of each, and so on
    for (realisation, hurst), rows in groupby(sorted(reference_rows(OF_SURFACE), key=_surface_of), _surface_of):
        height = SIDE * roughness(hurst).surface(CELLS, int(realisation.split()[-1]))
        for row in rows:
            if time.perf_counter() > end:
                yield Finding(row, ModelAnswer(math.nan, reason=f"not asked: {SECONDS:g} s are over"))
                continue
            value = model.call(height=height, spacing=SIDE / CELLS, modulus=MODULUS, load=load_of(row[FORCE]))
            answer = stiffness.over_unit(value)
            if not isinstance(answer, Failed):
                answers.setdefault((hurst, row[FORCE]), []).append((answer, row))
            yield Finding(row, answer)
    for (hurst, force), pairs in sorted(answers.items()):
        if len(pairs) >= FEWEST:
            yield from _over_surfaces({H: hurst, FORCE: force}, pairs)


def _surface_of(row: Reference) -> tuple[str, float]:
    return str(row.where[REALISATION]), row[H]


def _over_surfaces(where: Conditions, pairs: Sequence[tuple[float, Reference]]) -> Iterator[Finding]:
    """Ratios of means and of deviations, whose scatter is that of the model beside the same surfaces."""
    both = np.array([(value, row.value) for value, row in pairs])
    grid = float(np.mean([row.grid for _, row in pairs]))

    def log_ratio(rows: FloatArray) -> FloatArray:
        value, exact = rows.std(axis=0, ddof=1) / rows.mean(axis=0)
        return np.atleast_1d(np.log(max(value, 1e-9)) - np.log(exact))

    ratio, (log_deviations,) = ratio_of_means(*both.T), jackknifed(log_ratio, both)
    deviations, of_deviation = both.std(axis=0, ddof=1) / both.mean(axis=0), min(log_deviations.half_width, 10.0)
    for quantity, unit, (value, exact), half in (
        (MEAN, RATIO, both.mean(axis=0), ratio.half_width / ratio.value),
        (DEVIATION, judgement.DEVIATION, deviations, of_deviation),
    ):
        row = Reference(where, float(exact), grid=grid, unit=unit, quantity=quantity)
        yield Finding(row, ModelAnswer(float(value), half))


def roughness(hurst: float) -> PunchRoughness:
    """Of Fig. 14.1, in units of L = 1."""
    return PunchRoughness(hurst=hurst, waves=(1, WAVES), height=HEIGHT, seed=SEED, common=True)


def solved(engine: Engine) -> Iterator[Reference]:
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
        for hurst, cells in product(HURSTS, (CELLS, 2 * CELLS))
    }
    outcomes = engine.map_groups(press_lightly, groups)
    for hurst in HURSTS:
        wheres: list[Conditions] = [{H: hurst, REALISATION: f"surface {i}"} for i in range(SURFACES)]
        yield from on_finer_grid(wheres, FORCES, *(outcomes[hurst, n] for n in (CELLS, 2 * CELLS)))


def on_finer_grid(
    wheres: Sequence[Conditions], forces: Sequence[float], coarse: Sequence[Outcome], fine: Sequence[Outcome]
) -> Iterator[Reference]:
    """Of each surface, under its conditions; as much is left as both grids differ, as in `solved`."""
    logs = [np.log([outcome["stiffness"] for outcome in outcomes]) for outcomes in (coarse, fine)]
    left = student(len(wheres)) * np.sqrt(np.mean((logs[1] - logs[0]) ** 2, axis=0))
    for (i, j), value in np.ndenumerate(logs[1]):
        yield Reference({**wheres[i], FORCE: forces[j]}, math.exp(value), grid=float(left[j]))
