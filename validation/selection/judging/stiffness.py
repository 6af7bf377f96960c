"""Stiffness of a rough square punch by a formula, or one of its realisations a call, beside boundary elements."""

import math
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

import mdr
from validation.analysis.judgement import FAILED, REFUSED, JudgedPoint, compared, compared_deviations, not_compared
from validation.analysis.multilevel import Moments, moments
from validation.engine.offered import Caller, Failed, FloatArray
from validation.engine.random_numbers import random_generator
from validation.selection.judging.references import Reference, curve
from validation.simulation.rough_punch import PlateauSpectrum

SIDE, MODULUS, HEIGHT = 1e-2, 1e9, 1e-3
"""L [m], E* [Pa] and h / L at which a model is asked: k / (E* L) is that of any others."""
WAVES = 64
"""q_max / q_min of Fig. 14.1, and where nothing else is said."""
MOST, SECONDS, BATCH, FEWEST = 1000, 25.0, 20, 8
"""Realisations under one load, or as many as come in so many seconds, whole batches of them; fewer have no error."""
SEED, DRAWS = 14, 3
H, FORCE, ROLL_OFF, BAND = "H", "Fbar", "q_r L / 2π", "q_max / q_min"
MEAN, DEVIATION = "mean stiffness", "deviation of the stiffness"
ROLLED_OFF, BY_BAND = "mean stiffness with a roll-off", "deviation of the stiffness, by bandwidth"


@dataclass(frozen=True, kw_only=True)
class PlateauRoughness(PlateauSpectrum):
    """What a stranger gets: with its own rms height, constant below the roll-off."""

    def c2d(self, q: ArrayLike) -> FloatArray:
        """C_2D [m^4], whose integral is the mean square height."""
        return np.asarray(self._share * super().c2d(q))

    @property
    def _share(self) -> float:
        """The mean square height of the band without a plateau over that with it, at one level."""
        n, first, last, bend = -2 * self.hurst, self.q_min, self.q_max, self.q_roll_off
        tail = (last**n - bend**n) / n
        plateau = bend ** (n - 2) * (bend**2 - first**2) / 2
        return float(((last**n - first**n) / n) / (plateau + tail))


@dataclass(frozen=True)
class AskedPunch:
    """One punch: H, Fbar, waves from the first of the band to the last on a side, and where it rolls off."""

    hurst: float
    force: float
    waves: int = WAVES
    roll_off: int = 0
    scale: tuple[float, float] = (1.0, 1.0)

    @classmethod
    def at(cls, where: Mapping[str, float | str]) -> "AskedPunch":
        waves, roll_off = int(where.get(BAND, WAVES)), int(where.get(ROLL_OFF, 0))
        return cls(float(where[H]), float(where[FORCE]), waves, roll_off)

    @property
    def arguments(self) -> dict[str, object]:
        """Of a model, in SI units; scale: of lengths and of the modulus."""
        side, modulus = SIDE * self.scale[0], MODULUS * self.scale[1]
        band = {"q_min": 2 * math.pi / side, "q_max": 2 * math.pi * self.waves / side, "rms": HEIGHT * side}
        rough = mdr.SelfAffine(hurst=self.hurst, **band)
        if self.roll_off:
            rough = PlateauRoughness(hurst=self.hurst, **band, q_roll_off=2 * math.pi * self.roll_off / side)
        return {"load": self.force * modulus * HEIGHT * side**2, "side": side, "modulus": modulus, "roughness": rough}

    @property
    def unit(self) -> float:
        """E* L [N/m]."""
        return SIDE * self.scale[0] * MODULUS * self.scale[1]


@dataclass(frozen=True)
class Found:
    """Mean and relative deviation of k / (E* L), NaN where a model has none, and their relative half-widths of 95 %."""

    mean: float
    deviation: float = math.nan
    mean_half: float = 0.0
    deviation_half: float = 0.0
    sample: str = ""


Answers = dict[AskedPunch, Found | Failed]


def judged(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """Mean and deviation over Fbar and H, with a roll-off, over the bandwidth; and what every stiffness must do."""
    known = {quantity: curve(quantity) for quantity in (MEAN, DEVIATION, ROLLED_OFF, BY_BAND)}
    if drawn := "rng" in model.asks:
        known = {quantity: _fewer(rows) for quantity, rows in known.items()}
    asked = {
        quantity: list(dict.fromkeys(AskedPunch.at(row.where) for row in rows)) for quantity, rows in known.items()
    }
    first = list(dict.fromkeys(asked[MEAN] + asked[ROLLED_OFF]))
    if drawn:
        found = _drawn(model, list(dict.fromkeys(first + asked[BY_BAND])))
    else:
        found = {one: _formula(model, one) for one in first}
        if any(isinstance(one, Found) and math.isfinite(one.deviation) for one in found.values()):
            found |= {one: _formula(model, one) for one in asked[BY_BAND]}
    for quantity in (MEAN, ROLLED_OFF):
        yield from means(known[quantity], found, quantity, tolerance)
    for quantity in (DEVIATION, BY_BAND):
        yield from deviations(known[quantity], found, quantity, tolerance)
    if not drawn:
        yield from _properties(model, found, tolerance)


def _fewer(rows: Sequence[Reference]) -> list[Reference]:
    """Of the lowest, the middle and the highest H; of several bandwidths every second load: each takes many calls."""
    hursts = sorted({row.where[H] for row in rows})
    forces = sorted({row.where[FORCE] for row in rows})
    kept = {hursts[0], hursts[len(hursts) // 2], hursts[-1]}
    loads = forces[::2] if BAND in rows[0].where else forces
    return [row for row in rows if row.where[H] in kept and row.where[FORCE] in loads]


def means(rows: Iterable[Reference], found: Answers, quantity: str, tolerance: float) -> Iterator[JudgedPoint]:
    """Means, point by point."""
    for row in rows:
        one = found[AskedPunch.at(row.where)]
        if isinstance(one, Failed):
            yield not_compared(quantity, row.where, REFUSED if one.refused else FAILED, one.reason, reference=row.value)
            continue
        half = row.grid + math.hypot(row.sample, one.mean_half)
        yield compared(quantity, row.where, one.mean, row.value, half, tolerance, reason=one.sample)


def deviations(rows: Iterable[Reference], found: Answers, quantity: str, tolerance: float) -> Iterator[JudgedPoint]:
    """Deviations, of models that have them."""
    for row in rows:
        one = found.get(AskedPunch.at(row.where))
        if isinstance(one, Found) and math.isfinite(one.deviation):
            half = row.grid + math.hypot(row.sample, one.deviation_half)
            yield compared_deviations(quantity, row.where, one.deviation, row.value, half, tolerance)


def _formula(model: Caller, asked: AskedPunch) -> Found | Failed:
    value = model.call(**asked.arguments)
    if isinstance(value, Failed):
        return value
    mean, deviation = (float(value), math.nan) if value.ndim == 0 else (float(value[0]), float(value[1]))
    if not mean > 0:
        return Failed(f"a stiffness of {mean:.3g} N/m")
    if deviation < 0:
        return Failed(f"a deviation of {deviation:.3g} N/m")
    return Found(mean / asked.unit, deviation / mean)


def _drawn(model: Caller, asked: Sequence[AskedPunch]) -> Answers:
    """Realisations of each, in turn, until there are enough, or the time is over; one that fails is not asked again."""
    values: dict[AskedPunch, list[float]] = {one: [] for one in asked}
    lost: dict[AskedPunch, Failed] = {}
    given = {one: one.arguments for one in asked}
    end = time.perf_counter() + SECONDS
    for first in range(0, MOST, BATCH):
        for one in asked:
            if one in lost or (time.perf_counter() > end and first):
                continue
            count = BATCH if time.perf_counter() < end else FEWEST
            some = model.calls("rng", [random_generator(SEED, DRAWS, first + i) for i in range(count)], given[one])
            if failed := next((value for value in some if isinstance(value, Failed)), None):
                lost[one] = failed
            values[one] += [float(value) / one.unit for value in some if not isinstance(value, Failed)]
    return {one: lost[one] if one in lost else sampled(np.array(values[one])) for one in asked}


def sampled(values: FloatArray) -> Found | Failed:
    """Mean and deviation of a sample with their errors, by the moments of the realisations."""
    if values.mean() <= 0:
        return Failed(f"a mean stiffness of {values.mean():.3g} E* L")
    of: Moments = moments(values, np.isfinite(values))
    mean, deviation = of.log_mean, of.log_relative_deviation
    halves = mean.half_width, deviation.half_width
    return Found(float(values.mean()), math.exp(deviation.value), *halves, f"{values.size} realisations")


def _properties(model: Caller, found: Answers, tolerance: float) -> Iterator[JudgedPoint]:
    """k goes with E* at one load over E*, with L at one shape, and does not fall under a load that grows."""
    curves: dict[float, list[tuple[float, float]]] = {}
    for one, value in found.items():
        if isinstance(value, Found) and one.waves == WAVES and not one.roll_off:
            curves.setdefault(one.hurst, []).append((one.force, value.mean))
    for hurst, points in curves.items():
        rises = [after[1] / before[1] for before, after in pairwise(sorted(points))]
        falls = min(rises, default=1.0)
        yield compared("rise with the load, at the least", {H: hurst}, min(falls, 1.0), 1.0, 0.0, 1e-9)
    middle = [one for one in found if one.force == 0.1 and one.waves == WAVES and not one.roll_off]
    for one in middle:
        here = found[one]
        if isinstance(here, Failed):
            continue
        for quantity, scale in (("scaling with the modulus", (1.0, 10.0)), ("scaling with the length", (2.0, 1.0))):
            there = _formula(model, replace(one, scale=scale))
            if isinstance(there, Failed):
                yield not_compared(quantity, {H: one.hurst}, FAILED, there.reason, reference=1.0)
            else:
                yield compared(quantity, {H: one.hurst}, there.mean / here.mean, 1.0, 0.0, tolerance)
