"""Fixed or Gaussian amplitudes, the rms height of each draw or of the ensemble: three ways to draw rough punches."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Literal

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.difference import difference
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Table, numbers_with, table_of
from validation.analysis.over_range import worst
from validation.analysis.statistics import (
    DECIBEL,
    THREE_PER_CENT,
    Estimate,
    FloatArray,
    Sample,
    Statistic,
    at_level,
    decade_weights,
    difference_of_halves,
    log_deviation_over,
    log_relative_deviation,
    paired_samples,
    sample,
)
from validation.analysis.wording import by_status
from validation.cases.punch.ensembles import PunchEnsembles, press
from validation.engine.engine import SERIAL, Engine, Outcome
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


@dataclass(frozen=True)
class NormalisationResult:
    """Outcomes by Hurst exponent, variant and method: rows of their arrays are realisations, columns are forces."""

    case: Normalisation
    outcomes: dict[tuple[float, str, str], Outcome]
    unconverged: tuple[str, ...]


def run(case: Normalisation, engine: Engine = SERIAL) -> NormalisationResult:
    """Press all of them with both methods."""
    ways = {(hurst, variant): case.roughness(hurst, variant) for hurst in case.hursts for variant in VARIANTS}
    surfaces = {
        way: [case.surface_of(roughness, i, case.cells, case.forces) for i in range(case.surfaces)]
        for way, roughness in ways.items()
    }
    profiles = {way: case.profiles_of(roughness, case.points) for way, roughness in ways.items()}
    bem, mdr, unconverged = press(engine, surfaces, profiles)
    outcomes = {(*way, method): found[way] for way in ways for method, found in ((BEM, bem), (MDR, mdr))}
    return NormalisationResult(case, outcomes, unconverged)


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


# the spawn key of the bootstrap of pairs
PAIRS = 4


@dataclass(frozen=True)
class Fluctuations:
    """Relative deviations of the stiffness, resampled, by Hurst exponent, variant and method."""

    result: NormalisationResult
    samples: dict[tuple[float, str, str], Sample]

    def over(self, first: float) -> Statistic:
        """Of a decade of force, its root mean square."""
        return log_deviation_over(decade_weights(self.result.case.forces, first))

    def of(self, hurst: float, variant: str, method: str, statistic: Statistic) -> Estimate:
        return self.samples[hurst, variant, method].estimate(statistic)

    def gaussian_over_fixed(self, hurst: float, method: str, statistic: Statistic) -> Estimate:
        """The change from fixed amplitudes to Gaussian ones with the rms of each draw; the samples are independent."""
        return self.of(hurst, EACH, method, statistic).minus(self.of(hurst, FIXED, method, statistic))

    def ensemble_over_each(self, hurst: float, method: str, statistic: Statistic) -> Estimate:
        """The change to the rms of the ensemble, on the same draws: resampled as pairs."""
        return self.pairs[hurst, method].estimate(difference_of_halves(statistic))

    @cached_property
    def pairs(self) -> dict[tuple[float, str], Sample]:
        """The levels of both Gaussian ways side by side; what one of them lacks counts in neither."""
        case, outcomes = self.result.case, self.result.outcomes
        keys = product(enumerate(case.hursts), enumerate(METHODS))

        def drawn(hurst: float, variant: str, method: str) -> FloatArray:
            return outcomes[hurst, variant, method]["stiffness"]

        return {
            (hurst, method): paired_samples(
                drawn(hurst, EACH, method),
                drawn(hurst, ENSEMBLE, method),
                random_generator(case.seed, PAIRS, h, m),
            )
            for (h, hurst), (m, method) in keys
        }

    def mdr_over_bem(self, hurst: float, variant: str, statistic: Statistic) -> Estimate:
        """The difference of the methods, of one way to draw."""
        return self.of(hurst, variant, MDR, statistic).minus(self.of(hurst, variant, BEM, statistic))


CHANGES = {
    f"{EACH} over {FIXED}": Fluctuations.gaussian_over_fixed,
    f"{ENSEMBLE} over {EACH}": Fluctuations.ensemble_over_each,
}
CLAIM = "Gaussian amplitudes in place of fixed ones leave the relative deviation of the stiffness as it is."
CLAIMS = {
    f"{EACH} over {FIXED}": CLAIM,
    f"{ENSEMBLE} over {EACH}": "The rms height of the ensemble in place of that of each draw leaves the relative "
    "deviation as it is.",
}


def evidence(result: NormalisationResult) -> Evidence:
    """The relative deviation of each way to draw over that of the one before; methods beside each other, no verdict.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    require_converged([o for (_, _, method), o in result.outcomes.items() if method == BEM], result.unconverged)
    samples = {
        key: sample(outcome["stiffness"], random_generator(case.seed, BOOTSTRAP, i))
        for i, (key, outcome) in enumerate(result.outcomes.items())
    }
    found = Fluctuations(result, samples)
    numbers = _numbers(found)
    claims = tuple(
        _judged(claim, numbers_with(numbers, f"relative deviation, {name}")) for name, claim in CLAIMS.items()
    )
    return Evidence(
        title="Normalisation: how fluctuations depend on the way heights are drawn",
        method=(
            "The punches of Fig. 14.1 drawn in three ways: amplitudes fixed by the spectrum as in (14.8), phases "
            "random, where every draw has the rms height h exactly; Gaussian amplitudes, each draw scaled to h; and "
            "Gaussian amplitudes with h as the rms of the ensemble. "
            f"{case.surfaces} surfaces of {case.cells}² cells, {case.profiles} profiles of {case.points} springs; "
            "Fbar = F / (E* h L) with the h of the ensemble. The two Gaussian ways are compared on the same draws. "
            "Each method is compared with itself on one grid, and judged by the worst force of each decade. MDR over "
            "boundary elements is given without a verdict, since the grid error is known for Fig. 14.1 alone. "
            "Fig. 14.1 has fixed amplitudes, as in (14.8): with another height in every draw, one Fbar is another load "
            "for each."
        ),
        numbers=tuple(numbers),
        claims=claims,
        finding=f"{headline(claims)}.",
        headlines={"normalisation": headline(claims)},
        tables=(_curves(found), _heights(result)),
        page_tables=(_methods(found),),
        conclusions=(_scatter_of_heights(case),),
        captions={
            "normalisation": (
                "Relative standard deviation of the stiffness, a column for each way to draw; 95 % intervals. "
                "Circles: boundary elements; line in a band: MDR. The first column is drawn like Fig. 14.1."
            )
        },
        unconverged=result.unconverged,
    )


def _numbers(found: Fluctuations) -> list[Number]:
    """Of each change, at the worst force of a decade."""
    case = found.result.case
    return [
        worst(points, "Fbar")
        for first in case.first_forces
        for hurst in case.hursts
        for method in METHODS
        for name in CHANGES
        if (points := _points(found, name, hurst, method, first))
    ]


def _points(found: Fluctuations, name: str, hurst: float, method: str, first: float) -> list[Number]:
    """At the forces of a decade, where there is a fluctuation; the intervals of a change hold at once everywhere."""
    case = found.result.case
    forces, cells = case.forces, len(case.first_forces) * len(case.hursts) * len(METHODS)
    inside = decade_weights(forces, first) > 0
    changes = [
        (force, CHANGES[name](found, hurst, method, at_level(level, log_relative_deviation)))
        for level, force in enumerate(forces)
        if inside[level]
    ]
    kept = [(force, change) for force, change in changes if math.isfinite(change.value + change.error)]
    return [
        difference(
            change,
            quantity=f"relative deviation, {name}",
            model=method,
            where={"H": hurst, "Fbar": force},
            source="no change",
            tolerance=THREE_PER_CENT,
            reason="3 %, as in Fig. 14.1",
            scale=DECIBEL,
            among=len(kept) * cells,
        )
        for force, change in kept
    ]


def _judged(claim: str, numbers: Sequence[Number]) -> JudgedClaim:
    """The change that stands out most beside its interval, of each method."""
    found = []
    for method in METHODS:
        n = max((n for n in numbers if n.model == method), key=lambda n: abs(n.value) - n.sample)
        middle, low, high = (100 * math.expm1(v / DECIBEL) for v in (n.value, n.value - n.sample, n.value + n.sample))
        where = f"H = {n.where['H']:g}, Fbar = {n.where['worst at']:.2g}"
        found.append(f"in {method} by {middle:+.0f} % ({low:+.0f} to {high:+.0f}) at {where}")
    return answered(claim, numbers, f"beside its interval it changes most {' and '.join(found)}.")


def _curves(found: Fluctuations) -> Table:
    rows = []
    for (hurst, variant, method), mine in found.samples.items():
        for level, force in enumerate(found.result.case.forces):
            value, low, high = map(math.exp, mine.estimate(at_level(level, log_relative_deviation)).interval)
            key = {"H": hurst, "drawn with": variant, "method": method, "Fbar": force}
            rows.append(key | {"relative deviation": value, "low": low, "high": high})
    return table_of("curves", rows)


def _heights(result: NormalisationResult) -> Table:
    """Scatter of the mean square height, measured and by the number of waves that carry it."""
    rows = []
    for (hurst, variant, method), outcome in result.outcomes.items():
        square = (outcome["height"] / result.case.height) ** 2
        rows.append(
            {
                "H": hurst,
                "drawn with": variant,
                "method": method,
                "mean of h² / h0²": float(square.mean()),
                "deviation of h² / h0²": float(square.std(ddof=1)),
                "expected": scatter(result.case, hurst, method) if variant == ENSEMBLE else 0.0,
            }
        )
    return table_of("heights", rows)


def _methods(found: Fluctuations) -> Table:
    """On the page: MDR over boundary elements, a row a Hurst exponent and a decade, a column a way to draw."""

    def cell(hurst: float, variant: str, first: float) -> str:
        bem, mdr = (math.exp(found.of(hurst, variant, method, found.over(first)).value) for method in METHODS)
        return f"{bem:.3f}, {mdr:.3f}: {_percent(found.mdr_over_bem(hurst, variant, found.over(first)))}"

    rows = [
        {"H": hurst, "Fbar": _decade(first), **{variant: cell(hurst, variant, first) for variant in VARIANTS}}
        for hurst in found.result.case.hursts
        for first in found.result.case.first_forces
    ]
    return table_of("relative deviation of boundary elements and MDR, and their difference", rows)


def headline(claims: Sequence[JudgedClaim]) -> str:
    gaussian, ensemble = (by_status(claim, holds="leave", fails="change", undecided="may change") for claim in claims)
    return f"Gaussian amplitudes {gaussian} the fluctuation; heights of the ensemble {ensemble} it"


def _scatter_of_heights(case: Normalisation) -> str:
    spread = "; ".join(f"H = {h:g}: {scatter(case, h, BEM):.2f} and {scatter(case, h, MDR):.2f}" for h in case.hursts)
    return (
        f"The mean square height of Gaussian draws has a relative deviation, on surfaces and on profiles, of {spread}."
    )


def _decade(first: float) -> str:
    return f"{first:g} to {10 * first:g}"


def _percent(found: Estimate) -> str:
    middle, low, high = (f"{100 * math.expm1(value):+.0f}" for value in found.interval)
    return f"{middle} % ({low} to {high})"


CASE = Case(
    name="normalisation",
    chapter=Chapter.PRESSED,
    place=2,
    claim=CLAIM,
    answers="Fixed or Gaussian amplitudes, height of each draw or of the ensemble: how the fluctuations depend on it",
    quick=Normalisation(surfaces=15, profiles=150),
    full=Normalisation(cells=128, surfaces=120, profiles=1000, points=2048, per_decade=3),
    run=run,
    evidence=evidence,
    needs=model_needed.punches,
)
