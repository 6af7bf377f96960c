"""Stiffness of a rough square punch by a formula, a realisation a call, or of a surface, beside boundary elements."""

import math
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby, product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import mdr
from validation.analysis.quantity import MEAN_STIFFNESS, Quantity
from validation.analysis.statistics import jackknifed, moments, ratio_of_means, student
from validation.engine.engine import Engine, Outcome
from validation.engine.realisations import random_generator
from validation.judging import judgement
from validation.judging.judgement import RATIO, Conditions
from validation.judging.kinds.judge import Finding, LostError, ModelAnswer, attempted, compared, rule
from validation.judging.kinds.references import Reference, reference_rows
from validation.judging.registry import Caller, Failed, FloatArray
from validation.simulation.rough_punch import (
    STIFFNESS_ERROR,
    PlateauSpectrum,
    PunchRoughness,
    Surface,
    force_levels,
    press_lightly,
)

SIDE, MODULUS, HEIGHT = 1e-2, 1e9, 1e-3
"""L [m], E* [Pa] and h / L at which a model is asked: k / (E* L) is that of any others."""
UNIT = MODULUS * SIDE
"""E* L [N/m]."""
WAVES = 64
"""q_max / q_min of Fig. 14.1, and where nothing else is said."""
FEWEST, FAST = 8, 5e-3
REALISATIONS = {FAST: 100, 0.1: 20, math.inf: FEWEST}
"""Under one load, of a model whose calls take no longer than so many seconds, but for those of a busy machine: the
number is one of three, so that it hardly ever goes by the clock."""
TRIED, BETWEEN = 3, 10
"""Calls of which the fastest is counted; loads between two that are known, at which a formula must rise."""
SEED, DRAWS = 14, 3
EQUAL = 1e-6
"""Relative difference of draws that are equal, but for rounding in single precision."""
EQUAL_DRAWS, DIFFERENT_DRAWS = "rng is asked for and not used", "are different"
H, FORCE, ROLL_OFF, BAND, FIRST = "H", "Fbar", "q_r L / 2π", "q_max / q_min", "q_min L / 2π"
MEAN, DEVIATION = MEAN_STIFFNESS, Quantity("deviation_of_the_stiffness")
ROLLED_OFF = Quantity("mean_stiffness_with_a_roll-off")
BY_BAND = Quantity("deviation_of_the_stiffness_by_bandwidth", "deviation of the stiffness, by bandwidth")


@dataclass(frozen=True, kw_only=True)
class PlateauRoughness(PlateauSpectrum):
    """What a stranger gets: with its own rms height, constant below the roll-off."""

    def _density(self, q: FloatArray) -> FloatArray:
        """C_2D [m^4], whose integral is the mean square height; that of the draw has the level without a plateau."""
        n, first, last, bend = -2 * self.hurst, self.q_min, self.q_max, self.q_roll_off
        tail, plateau = (last**n - bend**n) / n, bend ** (n - 2) * (bend**2 - first**2) / 2
        return np.asarray((last**n - first**n) / n / (plateau + tail) * super()._density(q))


@dataclass(frozen=True)
class JudgedPunch:
    """One punch: H, Fbar, q_max / q_min, where it rolls off, and as many of the longest waves as are on a side."""

    hurst: float
    force: float
    waves: int = WAVES
    roll_off: int = 0
    first: int = 1

    @classmethod
    def at(cls, where: Conditions) -> "JudgedPunch":
        counts = (int(where.get(name, usual)) for name, usual in ((BAND, WAVES), (ROLL_OFF, 0), (FIRST, 1)))
        return cls(float(where[H]), float(where[FORCE]), *counts)

    @property
    def plain(self) -> bool:
        """Whether it is one of Fig. 14.1."""
        return self.waves == WAVES and not self.roll_off and self.first == 1

    @property
    def arguments(self) -> dict[str, Any]:
        """Of a model, in SI units."""
        q, rms = 2 * math.pi * self.first / SIDE, HEIGHT * SIDE
        band = {"hurst": self.hurst, "q_min": q, "q_max": q * self.waves, "rms": rms}
        rough = (
            PlateauRoughness(**band, q_roll_off=2 * math.pi / SIDE * self.roll_off)
            if self.roll_off
            else mdr.SelfAffine(**band)
        )
        return {"load": load_of(self.force), "side": SIDE, "modulus": MODULUS, "roughness": rough}


def load_of(force: float) -> float:
    """F = Fbar E* h L [N]."""
    return force * MODULUS * HEIGHT * SIDE**2


class Stiffness(NamedTuple):
    """Mean of k / (E* L), and its relative deviation where a model has one."""

    mean: ModelAnswer
    deviation: ModelAnswer | None = None


Answers = Mapping[JudgedPunch, Stiffness | Failed]


def judged(model: Caller) -> Iterator[Finding]:
    """Mean and deviation over Fbar and H, with a roll-off, over the bandwidth; and what every stiffness must do."""
    tables = [reference_rows(quantity) for quantity in (MEAN, ROLLED_OFF, DEVIATION, BY_BAND)]
    if drawn := "rng" in model.asks:
        tables = [_fewer(table) for table in tables]
    answers = answers_of(model, dict.fromkeys(JudgedPunch.at(row.where) for table in tables for row in table))
    for table in tables:
        yield from beside_punches(table, answers)
    if not drawn:
        yield from _rise(model, tables[0])


def _fewer(rows: Sequence[Reference]) -> list[Reference]:
    """Of the lowest, the middle and the highest H; of several bandwidths every second load: each takes many calls."""
    hursts, forces = (sorted({row[name] for row in rows}) for name in (H, FORCE))
    kept = {hursts[0], hursts[len(hursts) // 2], hursts[-1]}
    loads = forces[::2] if BAND in rows[0].where else forces
    return [row for row in rows if row[H] in kept and row[FORCE] in loads]


def beside_punches(rows: Sequence[Reference], answers: Answers) -> Iterator[Finding]:
    """Means, or deviations of models that have them."""
    return compared(
        rows, [_mean_or_deviation(answers[JudgedPunch.at(row.where)], row.unit == judgement.DEVIATION) for row in rows]
    )


def _mean_or_deviation(stiffness: Stiffness | Failed, deviates: bool) -> ModelAnswer | Failed | None:
    if isinstance(stiffness, Failed):
        return None if deviates else stiffness
    return stiffness.deviation if deviates else stiffness.mean


def answers_of(model: Caller, punches: Iterable[JudgedPunch], count: int = 0) -> Answers:
    """By a formula, or by so many realisations; by as many as its calls are fast for, where that is not said."""
    if "rng" not in model.asks:
        return {punch: _by_formula(model, punch) for punch in punches}
    punches = list(punches)
    count = count or next(n for seconds, n in REALISATIONS.items() if seconds_of(model, punches[0]) <= seconds)
    slow = "" if count == REALISATIONS[FAST] else ", since a call takes long"
    samples = {punch: attempted(draws, model, punch.arguments, count) for punch in punches}
    first_equal = first_equal_draws([sample for sample in samples.values() if not isinstance(sample, Failed)])
    return {
        punch: sample if isinstance(sample, Failed) else sampled(sample / UNIT, slow, first_equal)
        for punch, sample in samples.items()
    }


def first_equal_draws(samples: Sequence[FloatArray]) -> NDArray[np.intp]:
    """Number of the first draw that each one is equal to, under every load: of springs pressed flat all are equal.

    found: the same draws in each, one value a draw.
    """
    if not samples:
        return np.arange(0)
    rows = np.array(samples).T
    rows = rows / np.maximum(np.abs(rows).max(axis=0), np.finfo(float).tiny)
    return np.array([np.argmax(np.abs(rows - row).max(axis=1) <= EQUAL) for row in rows])


def seconds_of(model: Caller, punch: JudgedPunch) -> float:
    """Of the fastest of a few calls."""

    def once() -> float:
        begin = time.perf_counter()
        attempted(draws, model, punch.arguments, 1)
        return time.perf_counter() - begin

    return min(once() for _ in range(TRIED))


def draws(model: Caller, arguments: Mapping[str, Any], count: int) -> FloatArray:
    """Realisations [N/m], the same ones whatever is given. Raises LostError for one that fails."""
    answers = model.calls("rng", [random_generator(SEED, DRAWS, i) for i in range(count)], arguments)
    if lost := next((answer for answer in answers if isinstance(answer, Failed)), None):
        raise LostError(lost)
    return np.array(answers, dtype=float)


def over_unit(stiffness: FloatArray | float | Failed) -> float | Failed:
    """k / (E* L) of an answer [N/m], which must be positive."""
    if isinstance(stiffness, Failed):
        return stiffness
    return float(stiffness) / UNIT if stiffness > 0 else Failed(f"a stiffness of {stiffness:.3g} N/m")


def _by_formula(model: Caller, punch: JudgedPunch) -> Stiffness | Failed:
    value = model.call(**punch.arguments)
    if isinstance(value, Failed):
        return value
    mean, *deviation = np.atleast_1d(value).tolist()
    if isinstance(stiffness := over_unit(mean), Failed):
        return stiffness
    if min(deviation, default=0.0) < 0:
        return Failed(f"a deviation of {deviation[0]:.3g} N/m")
    return Stiffness(ModelAnswer(stiffness), *(ModelAnswer(value / mean) for value in deviation))


def sampled(values: FloatArray, so_few: str = "", first_equal: NDArray[np.intp] | None = None) -> Stiffness | Failed:
    """Mean and deviation of a sample with their errors, by the moments of the realisations.

    first_equal: number of the first draw that each is equal to, where any are. Equal draws are one: m of them, n_1 ...
    n_m times, have the error of n^2 / sum n_i^2 independent ones; that of one is not known.
    """
    if values.mean() <= 0:
        return Failed(f"a mean stiffness of {values.mean():.3g} E* L")
    first, times = np.unique(np.arange(values.size) if first_equal is None else first_equal, return_counts=True)
    if first.size == 1:
        equal = f"{values.size} equal realisations{so_few}: {EQUAL_DRAWS}"
        mean = ModelAnswer(float(values.mean()), math.inf, equal)
        return Stiffness(mean, ModelAnswer(math.nan, reason=f"{equal}; no deviation is known"))
    of, records = moments(values[first], np.isfinite(values[first])), values.size**2 / float((times**2).sum())
    deviation, count = of.log_relative_deviation, f"{values.size} realisations{so_few}"
    if first.size < values.size:
        count = f"{count}, of which {first.size} {DIFFERENT_DRAWS}"
    mean = ModelAnswer(float(values.mean()), of.log_mean.half_width * math.sqrt(first.size / records), count)
    if math.isfinite(deviation.value):
        value = math.exp(deviation.value)
        if first.size < FEWEST:
            # two draws are as far from their mean: the scatter of squares is zero, and that of a few says nothing
            return Stiffness(mean, ModelAnswer(value, math.inf, count))
        return Stiffness(mean, ModelAnswer(value, deviation.half_width))
    # one draw in a hundred that is apart may leave the others equal, too
    equal = f"{values.size} equal realisations{so_few}"
    return Stiffness(mean._replace(reason=equal), ModelAnswer(math.nan, reason=f"{equal}: no deviation is known"))


def _rise(model: Caller, rows: Sequence[Reference]) -> Iterator[Finding]:
    """A stiffness does not fall under a load that grows, at those that are known and, of what is fast, between them."""
    between = BETWEEN if seconds_of(model, JudgedPunch.at(rows[0].where)) <= FAST else 0
    for hurst in dict.fromkeys(row[H] for row in rows):
        forces = np.log([row[FORCE] for row in rows if row[H] == hurst])
        steps = np.linspace(0, forces.size - 1, (forces.size - 1) * (between + 1) + 1)
        arguments = JudgedPunch(hurst, 1.0).arguments
        loads = arguments["load"] * np.exp(np.interp(steps, np.arange(forces.size), forces))
        answers = model.calls("load", loads.tolist(), arguments)
        values = [float(np.ravel(answer)[0]) for answer in answers if not isinstance(answer, Failed)]
        if means := [value for value in values if value > 0]:
            least = float((means / np.maximum.accumulate(means)).min())
            yield rule("rise with the load, at the least", {H: hurst}, least, within=1e-9)


CELLS, SEED_OF_SURFACES, TOLERANCE = 256, 14, 1e-4
"""On a side, four to the shortest wave; of the surfaces of Fig. 14.1; residual of the solver."""
HURSTS, SURFACES = (0.4, 0.7, 1.0), 8
"""Surfaces of each H."""
FORCES = force_levels((-3, 1), 3)[::2]
SECONDS, FEWEST_SURFACES = 20.0, 3
"""After so long nothing more is asked; fewer surfaces have no error bar."""
OF_SURFACE, REALISATION = "stiffness of a surface", "surface"


def judged_surfaces(model: Caller) -> Iterator[Finding]:
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
            answer = over_unit(value)
            if not isinstance(answer, Failed):
                answers.setdefault((hurst, row[FORCE]), []).append((answer, row))
            yield Finding(row, answer)
    for (hurst, force), pairs in sorted(answers.items()):
        if len(pairs) >= FEWEST_SURFACES:
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
    return PunchRoughness(hurst=hurst, waves=(1, WAVES), height=HEIGHT, seed=SEED_OF_SURFACES, common=True)


def solved_surfaces(engine: Engine) -> Iterator[Reference]:
    """The references: k / (E* L) of each surface on the finer of two grids, in three minutes of one core.

    On single surfaces the error of the cells has either sign and is of no order, where few cells touch least of all:
    an answer at zero cell size cannot be told. As much is left as the finer grid and that which a model is given
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
    """Of each surface, under its conditions; what both grids differ is left, as in `solved`, and by residuals."""
    logs = [np.log([outcome["stiffness"] for outcome in outcomes]) for outcomes in (coarse, fine)]
    left = student(len(wheres)) * np.sqrt(np.mean((logs[1] - logs[0]) ** 2, axis=0))
    left = np.hypot(left, 5 * STIFFNESS_ERROR)
    for (i, j), value in np.ndenumerate(logs[1]):
        yield Reference({**wheres[i], FORCE: forces[j]}, math.exp(value), grid=float(left[j]))
