"""Stiffness of a rough punch whose surface is given, surface by surface, beside boundary elements on the same ones."""

import math
import time
from collections.abc import Iterator, Sequence

import numpy as np

from validation.analysis.judgement import FAILED, REFUSED, UNDECIDED, JudgedPoint, compared, compared_deviations
from validation.analysis.judgement import not_compared as without_number
from validation.analysis.statistics import FloatArray, jackknifed, ratio_of_means
from validation.engine.engine import Engine
from validation.engine.offered import Caller, Failed
from validation.selection.judging.references import Reference, curve
from validation.selection.judging.stiffness import DEVIATION, FORCE, HEIGHT, MEAN, MODULUS, SIDE, WAVES, H
from validation.simulation.light_punch import press_lightly
from validation.simulation.rough_punch import FEW_CELLS, PunchRoughness, Surface, force_levels

CELLS, SEED, TOLERANCE = 256, 14, 1e-4
"""On a side, four to the shortest wave; of the surfaces of Fig. 14.1; residual of the solver."""
HURSTS, SURFACES = (0.4, 0.7, 1.0), 8
"""Surfaces of each H."""
FORCES = force_levels((-3, 1), 3)[::2]
SECONDS, FEWEST = 40.0, 3
"""After so long nothing more is asked; fewer surfaces have no error bar."""
OF_SURFACE, REALISATION = "stiffness of a surface", "surface"
Key = tuple[float, float]


def judged(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """Each surface under each load; and mean and deviation over them, both on the same surfaces."""
    found: dict[Key, list[tuple[float, Reference]]] = {}
    end = time.perf_counter() + SECONDS
    rows = sorted(curve(OF_SURFACE), key=lambda row: str(row.where[REALISATION]))
    for (realisation, hurst), mine in _by_surface(rows):
        height = SIDE * roughness(hurst).surface(CELLS, int(realisation.split()[-1]))
        for row in mine:
            if time.perf_counter() > end:
                reason = f"not asked: {SECONDS:g} s are over"
                yield without_number(OF_SURFACE, row.where, UNDECIDED, reason, reference=row.value)
                continue
            force = float(row.where[FORCE])
            given = {"height": height, "spacing": SIDE / CELLS, "modulus": MODULUS}
            value = model.call(**given, load=force * MODULUS * HEIGHT * SIDE**2)
            if isinstance(value, Failed) or not value > 0:
                failed = value if isinstance(value, Failed) else Failed(f"a stiffness of {value:.3g} N/m")
                verdict = REFUSED if failed.refused else FAILED
                yield without_number(OF_SURFACE, row.where, verdict, failed.reason, reference=row.value)
                continue
            scaled = float(value) / (MODULUS * SIDE)
            yield compared(OF_SURFACE, row.where, scaled, row.value, row.sample + row.grid, tolerance)
            found.setdefault((hurst, force), []).append((scaled, row))
    for key in sorted(found):
        if len(found[key]) >= FEWEST:
            yield from _over_surfaces(key, found[key], tolerance)


def _by_surface(rows: Sequence[Reference]) -> Iterator[tuple[tuple[str, float], list[Reference]]]:
    """The first surface of each H, the second of each, and so on."""
    of: dict[tuple[str, float], list[Reference]] = {}
    for row in rows:
        of.setdefault((str(row.where[REALISATION]), float(row.where[H])), []).append(row)
    yield from sorted(of.items())


def _over_surfaces(key: Key, pairs: Sequence[tuple[float, Reference]], tolerance: float) -> Iterator[JudgedPoint]:
    """Ratios of means and of deviations, whose scatter is that of the model beside the same surfaces."""
    where = dict(zip((H, FORCE), key, strict=True))
    values, references = np.array([value for value, _ in pairs]), np.array([row.value for _, row in pairs])
    grid = float(np.mean([row.grid for _, row in pairs]))
    ratio = ratio_of_means(values, references)
    half = ratio.half_width / ratio.value + grid
    yield compared(MEAN, where, float(values.mean()), float(references.mean()), half, tolerance)

    def log_ratio(rows: FloatArray) -> FloatArray:
        mine, other = rows.std(axis=0, ddof=1) / rows.mean(axis=0)
        return np.atleast_1d(np.log(max(mine, 1e-9)) - np.log(other))

    (apart,) = jackknifed(log_ratio, np.stack([values, references], axis=1))
    mine, other = (float(x.std(ddof=1) / x.mean()) for x in (values, references))
    yield compared_deviations(DEVIATION, where, mine, other, min(apart.half_width, 10.0) + grid, tolerance)


def roughness(hurst: float) -> PunchRoughness:
    """Of Fig. 14.1, in units of L = 1."""
    return PunchRoughness(hurst=hurst, waves=(1, WAVES), height=HEIGHT, seed=SEED, common=True)


def solved(engine: Engine) -> list[Reference]:
    """The references: k / (E* L) of each surface on cells of no size, to first order, in three minutes of one core.

    As much as lies between the finer grid and no size is the grid error. Loads under which fewer than 30 cells touch
    are left out: an order of convergence cannot be told there.
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
        touching = CELLS**2 * np.mean([one["area"] for one in found[hurst, CELLS]], axis=0)
        for (i, j), finer in np.ndenumerate(fine - coarse):
            if touching[j] < FEW_CELLS:
                continue
            where: dict[str, float | str] = {H: hurst, REALISATION: f"surface {i}", FORCE: FORCES[j]}
            rows.append(Reference(where, math.exp(fine[i, j] + finer), 0.0, abs(finer)))
    return rows
