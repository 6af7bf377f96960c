"""Fixed or Gaussian amplitudes, the rms height of each draw or of the ensemble: three ways to draw rough punches."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import Literal

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, per_cent
from validation.analysis.series import Estimates, Margin, Series, Where
from validation.analysis.statistics import (
    THREE_PER_CENT,
    Sample,
    at_level,
    decade_weights,
    difference_of_halves,
    log_deviation_over,
    log_relative_deviation,
    paired_samples,
    sample,
)
from validation.analysis.study import Outcomes, Study
from validation.cases.punch.ensembles import FORCE, OVER, PunchEnsembles, press
from validation.engine.engine import SERIAL, Engine
from validation.engine.random_numbers import random_generator
from validation.selection import model_needed
from validation.simulation.rough_punch import BEM, BOOTSTRAP, MDR, METHODS, PunchRoughness, require_converged

FIXED, EACH, ENSEMBLE = "fixed amplitudes", "Gaussian, rms of each draw", "Gaussian, rms of the ensemble"
VARIANTS: dict[str, tuple[Literal["fixed", "gaussian"], Literal["each", "ensemble"]]] = {
    FIXED: ("fixed", "each"),
    EACH: ("gaussian", "each"),
    ENSEMBLE: ("gaussian", "ensemble"),
}


@dataclass(frozen=True, kw_only=True)
class Normalisation(PunchEnsembles):
    """The punches of Fig. 14.1 drawn in three ways, for each of `hursts`."""

    hursts: tuple[float, ...] = (0.4, 0.7, 1.0)
    cells: int = 64
    surfaces: int = 30
    profiles: int = 300
    per_decade: int = 2
    points: int = 1024
    seed: int = 141

    def roughness(self, hurst: float, variant: str) -> PunchRoughness:
        amplitudes, normalised = VARIANTS[variant]
        return replace(self.band(hurst), amplitudes=amplitudes, normalised=normalised)


def run(case: Normalisation, engine: Engine = SERIAL) -> Outcomes:
    """Press all of them with both methods: outcomes by Hurst exponent, variant and method."""
    ways = {(hurst, variant): case.roughness(hurst, variant) for hurst in case.hursts for variant in VARIANTS}
    surfaces = {way: case.surfaces_of(roughness, case.cells, case.surfaces) for way, roughness in ways.items()}
    profiles = {way: case.profiles_of(roughness, case.points) for way, roughness in ways.items()}
    bem, mdr, unconverged = press(engine, surfaces, profiles)
    outcomes = {(*way, method): found[way] for way in ways for method, found in ((BEM, bem), (MDR, mdr))}
    return Outcomes(case, outcomes, unconverged)


def scatter(case: Normalisation, hurst: float, method: str) -> float:
    """Relative standard deviation of the mean square height of Gaussian draws: sqrt(sum w^2) / sum w.

    w: the mean square of each independent wave, whose power is distributed exponentially; the few longest carry it.
    """
    last = case.cells // 4
    if method == MDR:
        power = np.arange(1, last + 1.0) ** (-2 * hurst - 1)
    else:
        i, j = np.meshgrid(np.arange(-last, last + 1.0), np.arange(0, last + 1.0), indexing="ij")
        waves = np.hypot(i, j)
        # of a wave and its mirror image, one
        independent = (waves > 0) & (waves <= last) & ((j > 0) | (i > 0))
        power = waves[independent] ** (-2 * hurst - 2)
    return float(np.sqrt((power**2).sum()) / power.sum())


PAIRS = 4
"""The spawn key of the bootstrap of pairs."""
WAY, FIRST = "drawn with", "Fbar, first of a decade"
DEVIATION, OVER_DECADE = "relative deviation of k", "relative deviation of k over a decade"
OF_MDR = "relative deviation of k over a decade, MDR over boundary elements"
SQUARE, SPREAD = "mean of h² over h0²", "relative deviation of h²"
GAUSSIAN, OF_ENSEMBLE = f"relative deviation, {EACH} over {FIXED}", f"relative deviation, {ENSEMBLE} over {EACH}"
NO_CHANGE = Margin(THREE_PER_CENT, "3 %, as in Fig. 14.1", source="no change")


def series(result: Outcomes) -> list[Series]:
    """The relative deviation of each way to draw over that of the one before; methods beside each other, no verdict.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    require_converged([o for (_, _, method), o in result.found.items() if method == BEM], result.unconverged)
    samples = {
        key: sample(outcome["stiffness"], random_generator(case.seed, BOOTSTRAP, i))
        for i, (key, outcome) in enumerate(result.found.items())
    }
    return [*_changes(result, samples), *_deviations(case, samples), *_heights(result)]


def _changes(result: Outcomes, samples: Mapping[tuple[float, str, str], Sample]) -> Iterator[Series]:
    """At the worst force of each decade; the two Gaussian ways on the same draws, resampled as pairs."""
    case = result.case
    # the intervals of a change hold at once everywhere, of both methods
    change = partial(case.in_decibels, margin=NO_CHANGE, family=case.family(len(case.hursts)))
    for (h, hurst), (m, method) in product(enumerate(case.hursts), enumerate(METHODS)):
        drawn = (samples[hurst, way, method] for way in (FIXED, EACH))
        fixed, each = (Estimates(one.by_level(log_relative_deviation)) for one in drawn)
        before, after = (result[hurst, way, method]["stiffness"] for way in (EACH, ENSEMBLE))
        pairs = paired_samples(before, after, random_generator(case.seed, PAIRS, h, m))
        levels = (at_level(level, log_relative_deviation) for level in range(len(case.forces)))
        changed = [pairs.estimate(difference_of_halves(level)) for level in levels]
        yield change(GAUSSIAN, method, each - fixed, where={"H": hurst})
        yield change(OF_ENSEMBLE, method, changed, where={"H": hurst})


def _deviations(case: Normalisation, samples: Mapping[tuple[float, str, str], Sample]) -> Iterator[Series]:
    """Force by force, and as the root mean square over decades, where MDR stands over boundary elements."""
    decades = [log_deviation_over(decade_weights(case.forces, first)) for first in case.first_forces]
    by_decade = partial(Series, along=FIRST, at=case.first_forces)
    for hurst in case.hursts:
        for way in VARIANTS:
            key: Where = {"H": hurst, WAY: way}
            found = {}
            for method in METHODS:
                mine = samples[hurst, way, method]
                values = mine.by_level(log_relative_deviation)
                yield Series(DEVIATION, method, values, where=key, along=FORCE, at=case.forces, shown=math.exp)
                found[method] = Estimates(map(mine.estimate, decades))
                yield by_decade(OVER_DECADE, method, found[method], where=key, shown=math.exp)
            yield by_decade(OF_MDR, OVER, found[MDR] - found[BEM], where=key, shown=math.exp)


def _heights(result: Outcomes) -> Iterator[Series]:
    """Mean and scatter of the mean square height, and the scatter by the number of waves that carry it."""
    case = result.case
    for way in VARIANTS:
        by_hurst = partial(Series, where={WAY: way}, along="H", at=case.hursts)
        for method in METHODS:
            squares = [(result[hurst, way, method]["height"] / case.height) ** 2 for hurst in case.hursts]
            yield by_hurst(SQUARE, method, [float(square.mean()) for square in squares])
            yield by_hurst(SPREAD, method, [float(square.std(ddof=1)) for square in squares])
            if way == ENSEMBLE:
                expected = [scatter(case, hurst, method) for hurst in case.hursts]
                yield by_hurst(SPREAD, f"{method}, expected", expected)


def _panel(way: str) -> Panel:
    of = partial(Curve, DEVIATION, of={WAY: way})
    both = of(BEM, "bem", "boundary elements", bars=True), of(MDR, "mdr line", "MDR, L_1D = L", band=True)
    return Panel(FORCE, f"{way}\n{DEVIATION}", facet="H", ylim=(0, None)).of(*both)


of_ratios = partial(Claim, printed=per_cent)
STUDY = Study(
    title="Normalisation: how fluctuations depend on the way heights are drawn",
    method=(
        "The punches of Fig. 14.1 drawn in three ways: amplitudes fixed by the spectrum as in (14.8), phases random, "
        "where every draw has the rms height h exactly; Gaussian amplitudes, each draw scaled to h; and Gaussian "
        "amplitudes with h as the rms of the ensemble. {c.surfaces} surfaces of {c.cells}² cells, {c.profiles} "
        "profiles of {c.points} springs; Fbar = F / (E* h L) with the h of the ensemble. The two Gaussian ways are "
        "compared on the same draws. Each method is compared with itself on one grid, and judged by the worst force of "
        "each decade. MDR over boundary elements is given without a verdict, since the grid error is known for Fig. "
        "14.1 alone. Fig. 14.1 has fixed amplitudes, as in (14.8): with another height in every draw, one Fbar is "
        "another load for each."
    ),
    series=series,
    claims=(
        of_ratios(
            says="Gaussian amplitudes in place of fixed ones leave the relative deviation of the stiffness as it is.",
            short="Fluctuation with Gaussian amplitudes over fixed ones",
            quantity=GAUSSIAN,
        ),
        of_ratios(
            says="The rms height of the ensemble in place of that of each draw leaves the relative deviation as it is.",
            short="with heights of the ensemble over those of each draw",
            quantity=OF_ENSEMBLE,
        ),
    ),
    charts=(
        Chart("normalisation", claims=(0, 1), columns=3, sharey=True, height=8.0).of(
            "Relative standard deviation of the stiffness, a row for each way to draw; 95 % intervals. Circles: "
            "boundary elements; line in a band: MDR. The first row is drawn like Fig. 14.1.",
            *tuple(map(_panel, VARIANTS)),
        ),
    ),
    printed=(OF_MDR, SPREAD),
)
CASE = Case(
    name="normalisation",
    chapter=Chapter.PRESSED,
    place=2,
    answers="Fixed or Gaussian amplitudes, height of each draw or of the ensemble: how the fluctuations depend on it",
    quick=Normalisation(surfaces=15, profiles=150),
    full=Normalisation(cells=128, surfaces=120, profiles=1000, points=2048, per_decade=3),
    run=run,
    study=STUDY,
    needs=model_needed.punches,
)
