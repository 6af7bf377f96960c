"""Stiffness of a rough square punch by a formula, or one of its realisations a call, beside boundary elements."""

import math
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

import mdr
from validation.analysis import judgement
from validation.analysis.judgement import Conditions
from validation.analysis.multilevel import moments
from validation.engine.offered import Caller, Failed, FloatArray
from validation.engine.random_numbers import random_generator
from validation.selection.judging.judge import Finding, ModelAnswer, beside, rule
from validation.selection.judging.references import Reference, known
from validation.simulation.rough_punch import PlateauSpectrum

SIDE, MODULUS, HEIGHT = 1e-2, 1e9, 1e-3
"""L [m], E* [Pa] and h / L at which a model is asked: k / (E* L) is that of any others."""
WAVES = 64
"""q_max / q_min of Fig. 14.1, and where nothing else is said."""
MOST, SECONDS, BATCH, FEWEST = 300, 15.0, 20, 8
"""Realisations under one load, or as many as come in so many seconds, whole batches of them; fewer have no error."""
SEED, DRAWS = 14, 3
H, FORCE, ROLL_OFF, BAND = "H", "Fbar", "q_r L / 2π", "q_max / q_min"
MEAN, DEVIATION = "mean stiffness", "deviation of the stiffness"
ROLLED_OFF, BY_BAND = "mean stiffness with a roll-off", "deviation of the stiffness, by bandwidth"


@dataclass(frozen=True, kw_only=True)
class PlateauRoughness(PlateauSpectrum):
    """What a stranger gets: with its own rms height, constant below the roll-off."""

    def c2d(self, q: ArrayLike) -> FloatArray:
        """C_2D [m^4], whose integral is the mean square height; that of the draw has the level without a plateau."""
        n, first, last, bend = -2 * self.hurst, self.q_min, self.q_max, self.q_roll_off
        tail, plateau = (last**n - bend**n) / n, bend ** (n - 2) * (bend**2 - first**2) / 2
        return np.asarray((last**n - first**n) / n / (plateau + tail) * super().c2d(q))


@dataclass(frozen=True)
class AskedPunch:
    """One punch: H, Fbar, waves from the first of the band to the last on a side, and where it rolls off."""

    hurst: float
    force: float
    waves: int = WAVES
    roll_off: int = 0
    scale: tuple[float, float] = (1.0, 1.0)

    @classmethod
    def at(cls, where: Conditions) -> "AskedPunch":
        return cls(float(where[H]), float(where[FORCE]), int(where.get(BAND, WAVES)), int(where.get(ROLL_OFF, 0)))

    @property
    def plain(self) -> bool:
        """Whether it is one of Fig. 14.1."""
        return self.waves == WAVES and not self.roll_off

    @property
    def arguments(self) -> dict[str, Any]:
        """Of a model, in SI units."""
        side, modulus = SIDE * self.scale[0], MODULUS * self.scale[1]
        q, rms = 2 * math.pi / side, HEIGHT * side
        band = {"hurst": self.hurst, "q_min": q, "q_max": q * self.waves, "rms": rms}
        rough = PlateauRoughness(**band, q_roll_off=q * self.roll_off) if self.roll_off else mdr.SelfAffine(**band)
        load = self.force * modulus * HEIGHT * side**2
        return {"load": load, "side": side, "modulus": modulus, "roughness": rough}

    @property
    def unit(self) -> float:
        """E* L [N/m]."""
        return SIDE * self.scale[0] * MODULUS * self.scale[1]


class Stiffness(NamedTuple):
    """Mean of k / (E* L), and its relative deviation where a model has one."""

    mean: ModelAnswer
    deviation: ModelAnswer | None = None


Answers = Mapping[AskedPunch, Stiffness | Failed]


def judged(model: Caller) -> Iterator[Finding]:
    """Mean and deviation over Fbar and H, with a roll-off, over the bandwidth; and what every stiffness must do."""
    rows = [known(quantity) for quantity in (MEAN, ROLLED_OFF, DEVIATION, BY_BAND)]
    if drawn := "rng" in model.asks:
        rows = [_fewer(some) for some in rows]
    found = answers_of(model, dict.fromkeys(AskedPunch.at(row.where) for some in rows for row in some), MOST)
    for some in rows:
        yield from beside_punches(some, found)
    if not drawn:
        yield from _rules(model, found)


def _fewer(rows: Sequence[Reference]) -> list[Reference]:
    """Of the lowest, the middle and the highest H; of several bandwidths every second load: each takes many calls."""
    hursts, forces = (sorted({row[name] for row in rows}) for name in (H, FORCE))
    kept = {hursts[0], hursts[len(hursts) // 2], hursts[-1]}
    loads = forces[::2] if BAND in rows[0].where else forces
    return [row for row in rows if row[H] in kept and row[FORCE] in loads]


def beside_punches(rows: Sequence[Reference], found: Answers) -> Iterator[Finding]:
    """Means, or deviations of models that have them."""
    return beside(rows, [_answer(found[AskedPunch.at(row.where)], row.unit == judgement.DEVIATION) for row in rows])


def _answer(one: Stiffness | Failed, deviates: bool) -> ModelAnswer | Failed | None:
    if isinstance(one, Failed):
        return None if deviates else one
    return one.deviation if deviates else one.mean


def answers_of(model: Caller, punches: Iterable[AskedPunch], most: int) -> Answers:
    """By a formula, or by so many realisations at most."""
    drawn = "rng" in model.asks
    return _drawn(model, punches, most) if drawn else {one: _by_formula(model, one) for one in punches}


def _by_formula(model: Caller, punch: AskedPunch) -> Stiffness | Failed:
    value = model.call(**punch.arguments)
    if isinstance(value, Failed):
        return value
    mean, *deviation = np.atleast_1d(value).tolist()
    if not mean > 0:
        return Failed(f"a stiffness of {mean:.3g} N/m")
    if min(deviation, default=0.0) < 0:
        return Failed(f"a deviation of {deviation[0]:.3g} N/m")
    return Stiffness(ModelAnswer(mean / punch.unit), *(ModelAnswer(one / mean) for one in deviation))


def _drawn(model: Caller, punches: Iterable[AskedPunch], most: int) -> Answers:
    """Realisations of each, in turn, until there are enough, or the time is over; one that fails is not asked again."""
    values: dict[AskedPunch, list[float]] = {one: [] for one in punches}
    lost: dict[AskedPunch, Failed] = {}
    end = time.perf_counter() + SECONDS
    for first in range(0, most, BATCH):
        for one in values:
            late = time.perf_counter() > end
            if one in lost or (late and first):
                continue
            rngs = [random_generator(SEED, DRAWS, first + i) for i in range(FEWEST if late else min(BATCH, most))]
            for value in model.calls("rng", rngs, one.arguments):
                if isinstance(value, Failed):
                    lost.setdefault(one, value)
                else:
                    values[one].append(float(value) / one.unit)
    return {one: lost.get(one) or sampled(np.array(some)) for one, some in values.items()}


def sampled(values: FloatArray) -> Stiffness | Failed:
    """Mean and deviation of a sample with their errors, by the moments of the realisations."""
    if values.mean() <= 0:
        return Failed(f"a mean stiffness of {values.mean():.3g} E* L")
    of = moments(values, np.isfinite(values))
    deviation = of.log_relative_deviation
    half = deviation.half_width if math.isfinite(deviation.value) else 0.0
    mean = ModelAnswer(float(values.mean()), of.log_mean.half_width, f"{values.size} realisations")
    return Stiffness(mean, ModelAnswer(math.exp(deviation.value), half))


def _rules(model: Caller, found: Answers) -> Iterator[Finding]:
    """k goes with E* at one load over E*, with L at one shape, and does not fall under a load that grows."""
    plain = {one: mine.mean.value for one, mine in found.items() if one.plain and not isinstance(mine, Failed)}
    for hurst in sorted({one.hurst for one in plain}):
        means = [plain[one] for one in sorted(plain, key=lambda one: one.force) if one.hurst == hurst]
        least = min((after / before for before, after in pairwise(means)), default=1.0)
        yield rule("rise with the load, at the least", {H: hurst}, min(least, 1.0), within=1e-9)
    for one in (one for one in plain if one.force == 0.1):
        for quantity, scale in (("scaling with the modulus", (1.0, 10.0)), ("scaling with the length", (2.0, 1.0))):
            there = _by_formula(model, replace(one, scale=scale))
            ratio = there if isinstance(there, Failed) else there.mean.value / plain[one]
            yield rule(quantity, {H: one.hurst}, ratio)
