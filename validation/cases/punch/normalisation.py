"""Fixed or Gaussian amplitudes, the rms height of each draw or of the ensemble: what the fluctuations owe to them."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, table_of
from validation.analysis.statistics import (
    DECIBEL,
    THREE_PER_CENT,
    Estimate,
    Sample,
    at_level,
    decade_weights,
    difference_of_halves,
    log_deviation_over,
    log_relative_deviation,
    mean_of,
    sample,
)
from validation.engine.engine import SERIAL, Engine, Outcome, random_generator
from validation.selection import model_needed
from validation.simulation.rough_punch import (
    BOOTSTRAP,
    METHODS,
    Profiles,
    PunchRoughness,
    Surface,
    describe_failures,
    force_levels,
    press_profiles,
    press_surface,
    require_converged,
    stacked,
)

Row = dict[str, float | str]
Amplitudes = Literal["fixed", "gaussian"]
Normalised = Literal["each", "ensemble"]

FIXED, EACH, ENSEMBLE = "fixed amplitudes", "Gaussian, rms of each draw", "Gaussian, rms of the ensemble"
VARIANTS: dict[str, tuple[Amplitudes, Normalised]] = {
    FIXED: ("fixed", "each"),
    EACH: ("gaussian", "each"),
    ENSEMBLE: ("gaussian", "ensemble"),
}
# the spawn key of what is drawn again of pairs
PAIRS = 4


@dataclass(frozen=True, kw_only=True)
class Normalisation:
    """The punches of Fig. 14.1 drawn in three ways.

    hursts; cells: on a side; surfaces, profiles: realisations; decades: powers of ten of the first and the last Fbar,
    per_decade: steps of force in one; points: springs of a profile; height: h / L; tolerance: residual of the solver;
    seed: zero or positive.
    """

    hursts: tuple[float, ...] = (0.4, 0.7, 1.0)
    cells: int = 64
    surfaces: int = 30
    profiles: int = 300
    decades: tuple[int, int] = (-2, 0)
    per_decade: int = 2
    points: int = 1024
    height: float = 1e-3
    tolerance: float = 1e-4
    seed: int = 141

    @property
    def forces(self) -> tuple[float, ...]:
        """Levels of Fbar, ascending."""
        return force_levels(self.decades, self.per_decade)

    def roughness(self, hurst: float, variant: str) -> PunchRoughness:
        """Of one way to draw."""
        amplitudes, normalised = VARIANTS[variant]
        return PunchRoughness(
            hurst=hurst,
            waves=(1, self.cells // 4),
            height=self.height,
            amplitudes=amplitudes,
            normalised=normalised,
            seed=self.seed,
        )


@dataclass(frozen=True)
class NormalisationResult:
    """Outcomes by Hurst exponent, variant and method: rows of their arrays are realisations, columns are forces."""

    case: Normalisation
    outcomes: dict[tuple[float, str, str], Outcome]
    unconverged: tuple[str, ...]


def run(case: Normalisation, engine: Engine = SERIAL) -> NormalisationResult:
    """Press all of them with both methods."""
    ways = [(hurst, variant, case.roughness(hurst, variant)) for hurst in case.hursts for variant in VARIANTS]
    surfaces = [
        Surface(roughness=roughness, realisation=i, cells=case.cells, forces=case.forces, tolerance=case.tolerance)
        for _, _, roughness in ways
        for i in range(case.surfaces)
    ]
    profiles = [
        Profiles(roughness=roughness, realisations=case.profiles, points=case.points, length=1.0, forces=case.forces)
        for _, _, roughness in ways
    ]
    pressed, springs = engine.map(press_surface, surfaces), engine.map(press_profiles, profiles)
    outcomes = {}
    for w, (hurst, variant, _) in enumerate(ways):
        outcomes[hurst, variant, "bem3d"] = stacked(pressed[w * case.surfaces : (w + 1) * case.surfaces])
        outcomes[hurst, variant, "mdr"] = springs[w]
    return NormalisationResult(case, outcomes, describe_failures(surfaces, pressed))


def evidence(result: NormalisationResult) -> Evidence:
    """The relative deviation of each way over that of the one before; methods side by side, without a verdict.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    require_converged([o for (_, _, method), o in result.outcomes.items() if method == "bem3d"], result.unconverged)
    samples = {
        key: sample(outcome["stiffness"], random_generator(case.seed, BOOTSTRAP, i))
        for i, (key, outcome) in enumerate(result.outcomes.items())
    }
    numbers = []
    for power in range(*case.decades):
        found = {key: _deviation(case, mine, 10.0**power) for key, mine in samples.items()}
        decade = f"Fbar = {10.0**power:g} to {10.0 ** (power + 1):g}"
        for hurst in case.hursts:
            where = f"H = {hurst:g}, {decade}"
            for m in METHODS:
                gaussian = found[hurst, EACH, m].minus(found[hurst, FIXED, m])
                numbers += [
                    _number(f"{where}, {m}: {EACH} over {FIXED}", gaussian),
                    _number(f"{where}, {m}: {ENSEMBLE} over {EACH}", _paired(case, result, hurst, m, 10.0**power)),
                ]
    return Evidence(
        title="Normalisation: what the fluctuations owe to the way of drawing",
        method=(
            "The punches of Fig. 14.1 drawn in three ways: amplitudes fixed by the spectrum as in (14.8), phases "
            "random, where every draw has the rms height h exactly; Gaussian amplitudes, scaled to h draw by draw; and "
            "Gaussian amplitudes that have h in the mean of the ensemble. "
            f"{case.surfaces} surfaces of {case.cells}² cells, {case.profiles} profiles of {case.points} springs; "
            "Fbar = F / (E* h L) with the h of the ensemble. The two Gaussian ways are compared on the same draws, "
            "and methods with themselves on one grid; where they stand beside each other, the grid error is that of "
            "Fig. 14.1, and no verdict is given here."
        ),
        numbers=tuple(numbers),
        tables=(_curves(case, samples), _heights(result)),
        page_tables=(_matrix(case, samples),),
        conclusions=tuple(_conclusions(result, samples)),
        captions={
            "normalisation": (
                "Relative standard deviation of the stiffness in three ways to draw, a column each; 95 % intervals. "
                "Circles: boundary elements; line in a band: MDR. Fig. 14.1 is the first column."
            )
        },
        unconverged=result.unconverged,
    )


def _paired(case: Normalisation, result: NormalisationResult, hurst: float, method: str, first: float) -> Estimate:
    """The same draws in two ways: ln of the deviation with the height of the ensemble, less that with their own."""
    each, whole = (result.outcomes[hurst, variant, method]["stiffness"] for variant in (EACH, ENSEMBLE))
    both = np.concatenate([each, whole], axis=1)
    lost_in_one = np.isnan(both).any(axis=1, keepdims=True)
    key = (case.hursts.index(hurst), METHODS.index(method))
    drawn = sample(np.where(lost_in_one, np.nan, both), random_generator(case.seed, PAIRS, *key))
    return drawn.estimate(difference_of_halves(log_deviation_over(decade_weights(case.forces, first))))


def _deviation(case: Normalisation, mine: Sample, first: float) -> Estimate:
    return mine.estimate(log_deviation_over(decade_weights(case.forces, first)))


def _number(label: str, apart: Estimate) -> Number:
    """A difference of logarithms in decibels."""
    return Number(
        quantity=label,
        value=DECIBEL * apart.value,
        reference=0.0,
        source="no change",
        tolerance=THREE_PER_CENT,
        unit="dB",
        reason="3 %, as in Fig. 14.1",
        sample=DECIBEL * apart.half_width,
        role=Role.FINDING,
    )


def _curves(case: Normalisation, samples: dict[tuple[float, str, str], Sample]) -> Table:
    rows: list[Row] = []
    for (hurst, variant, method), mine in samples.items():
        for level, force in enumerate(case.forces):
            value, low, high = map(math.exp, mine.estimate(at_level(level, log_relative_deviation)).interval)
            rows.append(
                {
                    "H": hurst,
                    "drawn with": variant,
                    "method": method,
                    "Fbar": force,
                    "relative deviation": value,
                    "low": low,
                    "high": high,
                }
            )
    return table_of("curves", rows)


def _heights(result: NormalisationResult) -> Table:
    """Scatter of the mean square height, measured and by the number of waves that carry it."""
    rows: list[Row] = []
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


def scatter(case: Normalisation, hurst: float, method: str) -> float:
    """Relative standard deviation of the mean square height of Gaussian draws: sqrt(sum w^2) / sum w.

    w: the mean square of each independent wave, whose power is distributed exponentially; the few longest carry it.
    """
    last = case.cells // 4
    if method == "mdr":
        power = np.arange(1, last + 1.0) ** (-2 * hurst - 1)
    else:
        i, j = np.meshgrid(np.arange(-last, last + 1.0), np.arange(0, last + 1.0), indexing="ij")
        waves = np.hypot(i, j)
        # of a wave and its mirror image, one
        independent = (waves > 0) & (waves <= last) & ((j > 0) | (i > 0))
        power = waves[independent] ** (-2 * hurst - 2)
    return float(np.sqrt((power**2).sum()) / power.sum())


def _matrix(case: Normalisation, samples: dict[tuple[float, str, str], Sample]) -> Table:
    """On the page: MDR over boundary elements, a row a Hurst exponent and a decade, a column a way to draw."""
    columns: dict[str, list[object]] = {"H": [], "Fbar": [], **{variant: [] for variant in VARIANTS}}
    for hurst in case.hursts:
        for power in range(*case.decades):
            columns["H"].append(hurst)
            columns["Fbar"].append(f"{10.0**power:g} to {10.0 ** (power + 1):g}")
            for variant in VARIANTS:
                bem, mdr = (_deviation(case, samples[hurst, variant, m], 10.0**power) for m in METHODS)
                columns[variant].append(
                    f"{math.exp(bem.value):.3f}, {math.exp(mdr.value):.3f}: {_percent(mdr.minus(bem))}"
                )
    return Table("relative deviation of boundary elements and MDR, and their difference", columns)


def _conclusions(result: NormalisationResult, samples: dict[tuple[float, str, str], Sample]) -> list[str]:
    """Means over the Hurst exponents, whose samples are independent, with their intervals."""
    case = result.case

    def over_hursts(first: float, one: tuple[str, str], other: tuple[str, str]) -> str:
        apart = [
            _deviation(case, samples[hurst, *one], first).minus(_deviation(case, samples[hurst, *other], first))
            for hurst in case.hursts
        ]
        return _percent(mean_of(apart))

    sentences = []
    for power in range(*case.decades):
        first = 10.0**power
        decade = f"Fbar = {first:g} to {10 * first:g}, mean over H"
        across = ", ".join(f"{over_hursts(first, (v, 'mdr'), (v, 'bem3d'))} with {v}" for v in VARIANTS)
        way = ", ".join(f"{over_hursts(first, (EACH, m), (FIXED, m))} ({m})" for m in METHODS)
        height = ", ".join(
            f"{_percent(mean_of([_paired(case, result, hurst, m, first) for hurst in case.hursts]))} ({m})"
            for m in METHODS
        )
        sentences.append(
            f"{decade}: Gaussian amplitudes for fixed ones change the deviation by {way}, a height that only the "
            f"ensemble has for one of each draw by {height}. MDR over boundary elements: {across}."
        )
    spread = "; ".join(
        f"H = {hurst:g}: {scatter(case, hurst, 'bem3d'):.2f} and {scatter(case, hurst, 'mdr'):.2f}"
        for hurst in case.hursts
    )
    return [
        *sentences,
        "With q_min = 2π/L the few longest waves carry the height, in one dimension fewer than in two: the mean square "
        f"height of Gaussian draws has a relative deviation, on surfaces and on profiles, of {spread}.",
        "Fig. 14.1 draws with fixed amplitudes, because (14.8) does, and because Fbar counts the force by the height: "
        "with a height of its own in every draw, one Fbar is another load for each, and its scatter, larger in one "
        "dimension, would be counted as one of the contact.",
    ]


def _percent(found: Estimate) -> str:
    middle, low, high = (f"{100 * math.expm1(value):+.0f}" for value in found.interval)
    return f"{middle} % ({low} to {high})"


CASE = Case(
    name="normalisation",
    chapter=Chapter.PRESSED,
    place=2,
    claim="The fluctuation depends on how heights are normalised.",
    answers="Fixed or Gaussian amplitudes, height of each draw or of the ensemble: what the fluctuations owe to it",
    quick=Normalisation(),
    full=Normalisation(cells=128, surfaces=120, profiles=1000, points=2048, per_decade=3),
    run=run,
    evidence=evidence,
    needs=model_needed.punches,
)
