"""What lies across a rail decides its contact filter: boundary elements and the filters in use, ridges to isotropic."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import product, starmap

import numpy as np
import scipy
from numpy.typing import NDArray

from validation.analysis.series import FIELD, THREE_DECIBELS, Estimates, Where, masked, only
from validation.analysis.statistics import POWER_DECIBEL, FloatArray, Interval, jackknifed
from validation.case import SERIAL, Engine, Quantity, Series
from validation.railway.cases import filters
from validation.railway.cases.filters import (
    GROUNDS,
    OFFSET,
    SPEEDS,
    RailWheel,
    counted,
    decibel,
    linear_filter,
    on_strips,
)
from validation.railway.cases.rolled_filters import (
    A3,
    OVER_BEM,
    WAVE,
    Key,
    RolledFilters,
    RolledFiltersResult,
    in_bands,
    solved,
)
from validation.railway.problems.rail_across import WideRail, roll_both_ways, wide_rail
from validation.railway.problems.rail_strip import StatedAcross, line_of, strip_bands, structure_of
from validation.railway.scenes.rail import RailScene
from validation.simulation.model_names import BED, BEM, LINEAR, LINEAR_ON_LINE
from validation.theory.half_space import EllipticContact

LINES = (LINEAR_ON_LINE, filters.LINES_APART, filters.LINES_NEAR)
BEDS = (BED, filters.BED_WIDER, filters.REMINGTON, filters.REMINGTON_THERE)
MODELS = (LINEAR, *LINES, *BEDS)
SHOWN = MODELS[:-1]
ON_ROUGHER = (LINEAR, LINEAR_ON_LINE, filters.BED_WIDER)
"""Judged over rougher rails too; a linear filter is the same there, and boundary elements are nearly so."""
TABLE = "published table"
WEIGHTED = Quantity("sound_power_re_boundary_elements_dB_A", "sound power relative to boundary elements [dB(A)]")
ONE_LINE = Quantity("A3_of_one_line_over_that_of_boundary_elements")
REACH = Quantity(
    "shortest_wave_within_1_dB_of_boundary_elements_mm", "shortest wave within 1 dB of boundary elements [mm]"
)
BORDER = Quantity("largest_alpha_for_one_line")
OFF = Quantity("one_line_over_boundary_elements_dB", "one line over boundary elements [dB]")
WITHIN = "within [dB]"
NEAREST = Quantity("nearest_to_boundary_elements")
LEFT = Quantity("worst_band_of_the_nearest_dB", "worst band of the nearest [dB]")
ALPHA_OF, FACTOR_OF, ALIKE = "alpha of Remington", "factor of the bed", "alpha that is alike"
WHEEL, GROUND, SPEED = "wheel", "across", "speed [km/h]"
TOLERANCES = (1.0, 2.0, 3.0)
WORST_BAND = "in the worst band that counts"
AT_SPEEDS = {speed: f"in sound power at {speed:g} km/h" for speed in SPEEDS}
WAYS = (WORST_BAND, *AT_SPEEDS.values())
FINE_ALPHAS = np.geomspace(0.05, 8.0, 70)


@dataclass(frozen=True, kw_only=True)
class Across(RolledFilters):
    """Ground that crosses the rail from ridges to isotropic; each strip is rolled over with both signs.

    rougher: dB over ISO 3095:2013 under the first wheels, how many these are, and strips there; across: names of
    `GROUNDS`.
    """

    rougher: tuple[float, int, int] = (10.0, 0, 3)
    across: tuple[str, ...] = tuple(GROUNDS)
    strips: int = 3
    seed: int = 34

    @property
    def labels(self) -> str:
        return "; ".join(RailWheel(*wheel).label for wheel in self.wheels)

    @property
    def smooth(self) -> list[Key]:
        """At the level of ISO 3095."""
        return super().keys

    @property
    def keys(self) -> list[Key]:
        offset, wheels, _ = self.rougher
        return [*self.smooth, *product(starmap(RailWheel, self.wheels[:wheels]), (offset,), self.across)]

    def problems(self, key: Key, cells: int) -> list[WideRail]:
        strips = range(self.rougher[2] if key[1] else self.strips)
        return [wide_rail(self.scene(key), GROUNDS[key[2]], cells, i, self.seed) for i in strips]


@dataclass(frozen=True)
class AcrossResult(RolledFiltersResult):
    """Band powers on all strips, by kind of strip and by cells."""

    case: Across

    def over(self, key: Key, model: str, other: str, cells: int | None = None) -> Estimates:
        """ln of the power of boundary elements over that of linear theory; linear models have no strips."""
        if model == other:
            return super().over(key, model, other)
        converged = [outcome for outcome in self[key, cells or self.case.cells[1]] if not outcome["failed"]]
        rows = np.array([[outcome[model], outcome[other]] for outcome in converged])
        return Estimates(jackknifed(lambda powers: np.log(np.divide(*powers.sum(axis=0))), rows))

    def beyond_linear(self, key: Key, sign: int = 0) -> FloatArray:
        """Of boundary elements over linear theory, or an end of its interval; zero where strips have no waves [dB]."""
        scene, over = self.case.scene(key), self.over_twin(key, BEM)
        half = np.array([estimate.half_width for estimate in over]) + self.left_by_grid(key, BEM, LINEAR)
        excess = np.zeros(len(scene.levels.bands))
        on_strips(scene, excess)[:] = POWER_DECIBEL * (over.values + sign * half)
        return excess

    def a3(self, key: Key, sign: int = 0) -> FloatArray:
        """Of boundary elements in all bands, with linear theory where strips have no waves [dB]."""
        return linear_filter(self.case.scene(key), LINEAR, GROUNDS[key[2]]) + self.beyond_linear(key, sign)

    @cached_property
    def series(self) -> list[Series]:
        """All that is shown; tables read it again."""
        return _series(self)


def run(case: Across, engine: Engine = SERIAL) -> AcrossResult:
    return solved(case, engine, roll_both_ways, AcrossResult)


def _series(result: AcrossResult) -> list[Series]:
    case = result.case
    by_key = [series for key in case.keys for series in (*_filters(result, key), *_over_bem(result, key))]
    wheels = dict.fromkeys(key[0] for key in case.smooth)
    return [
        *by_key,
        *(series for key in case.smooth for series in (*_weighted(result, key), *_nearest(result, key))),
        *(series for wheel in wheels for series in _of_wheel(result, wheel)),
    ]


def where_of(key: Key) -> Where:
    return {WHEEL: key[0].label, OFFSET: key[1], GROUND: key[2]}


def _filters(result: AcrossResult, key: Key) -> Iterator[Series]:
    """A3 of linear theory in all bands, and of boundary elements in those of the strips."""
    scene, in_strips = result.case.scene(key), in_bands(result.case, key)
    at = filters.millimetres(scene.levels.bands)
    linear = linear_filter(scene, LINEAR, GROUNDS[key[2]])
    yield Series(A3, LINEAR, linear, where=where_of(key), along=WAVE, at=at, unit="dB")
    a3 = Estimates.exact(result.linear(key) / POWER_DECIBEL) + result.over_linear(key, BEM)
    yield in_strips(A3, BEM, a3, grid=result.left_by_grid(key, BEM, LINEAR))


def _over_bem(result: AcrossResult, key: Key) -> Iterator[Series]:
    """In the bands that count, and how far down each filter holds."""
    case, bem, keep = result.case, result.over_linear(key, BEM), counted(result.linear(key))
    at, grid = filters.millimetres(strip_bands(case.scene(key))), result.left_by_grid(key, BEM, LINEAR)
    near, three = (
        margin.with_source(f"boundary elements on strips of both signs, {key[0].label}")
        for margin in (FIELD, replace(THREE_DECIBELS, rms=None))
    )
    judged = partial(in_bands(case, key), grid=grid, ranges=only(at, keep))
    for model in MODELS if key in case.smooth else ON_ROUGHER:
        off = result.over_linear(key, model) - bem
        yield judged(OVER_BEM, model, masked(off, keep), margin=near)
        if model == LINEAR_ON_LINE:
            yield judged(ONE_LINE, model, masked(off, keep), margin=three)
        within = np.logical_and.accumulate(POWER_DECIBEL * np.abs(off.values) <= FIELD.tolerance)
        reach = float(at[within].min()) if within.any() else np.nan
        yield Series(REACH, model, (reach,), where=where_of(key), unit="mm")


def _weighted(result: AcrossResult, key: Key) -> Iterator[Series]:
    """Sound power per axle by each filter, relative to that by the filter of boundary elements."""
    scene, ground = result.case.scene(key), GROUNDS[key[2]]
    for model in MODELS:
        a3 = linear_filter(scene, model, ground)
        ends = [filters.over_in_decibel_a(scene, a3, result.a3(key, sign), SPEEDS) for sign in (0, 1, -1)]
        intervals = [Interval(value, (most - least) / 2) for value, least, most in zip(*ends, strict=True)]
        yield Series(WEIGHTED, model, intervals, where=where_of(key), along=SPEED, at=SPEEDS, unit="dB(A)")


def _nearest(result: AcrossResult, key: Key) -> Iterator[Series]:
    """Which alpha of Remington and which factor of the bed stand for a ground, which alpha is alike; what is left."""
    scene, ground, contact = result.case.scene(key), GROUNDS[key[2]], result.case.scene(key).contact
    assessed = counted(linear_filter(scene, LINEAR, ground))

    def wider(factor: float) -> FloatArray:
        larger = replace(contact, along=factor * contact.along, across=factor * contact.across)
        return a3_in_assessed_bands(scene, BED, ground, assessed, larger)

    def with_alpha(model: str) -> Callable[[float], FloatArray]:
        return lambda alpha: a3_in_assessed_bands(scene, model, alpha, assessed)

    of = {FACTOR_OF: wider, ALPHA_OF: with_alpha(filters.REMINGTON_THERE)}
    if ground == "isotropic":
        of[ALIKE] = with_alpha(LINEAR)
    for name, filtered in of.items():
        middle, *ends = (_least_off(filtered, result.a3(key, sign)[assessed]) for sign in (0, 1, -1))
        interval = Interval(middle[0], max(abs(end[0] - middle[0]) for end in ends))
        yield Series(NEAREST, name, (interval,), where=where_of(key))
        yield Series(LEFT, name, (middle[1],), where=where_of(key), unit="dB")


def a3_in_assessed_bands(
    scene: RailScene,
    model: str,
    ground: StatedAcross,
    assessed: NDArray[np.bool_],
    contact: EllipticContact | None = None,
) -> FloatArray:
    """A3 of a linear model in the assessed bands alone [dB]; assessed: a mask of the bands, true for the first ones."""
    line, edges = line_of(scene), scene.levels.bands.edges[: np.count_nonzero(assessed) + 1]
    transfer, axes = filters.filter_of(model, contact or scene.contact)
    return decibel(structure_of(ground, line).band_power(line, transfer, edges=edges, semi_axes=axes))


def _least_off(filtered: Callable[[float], FloatArray], reference: FloatArray) -> tuple[float, float]:
    """The parameter, from a twentieth to twenty, whose worst band is nearest, and that [dB]."""

    def worst(log: float) -> float:
        return float(np.abs(filtered(float(np.exp(log))) - reference).max())

    grid = np.linspace(np.log(0.05), np.log(20), 13)
    best = int(np.argmin([worst(log) for log in grid]))
    ends = grid[max(best - 1, 0)], grid[min(best + 1, grid.size - 1)]
    minimum = scipy.optimize.minimize_scalar(worst, bounds=ends, method="bounded", options={"xatol": 3e-3})
    return float(np.exp(minimum.x)), float(minimum.fun)


def _of_wheel(result: AcrossResult, wheel: RailWheel) -> Iterator[Series]:
    """Up to which alpha one line is enough, in bands that count and in sound power; the published table beside A3."""
    where: Where = {WHEEL: wheel.label}
    if (of_table := filters.columns_of_table().get(wheel)) is not None:
        yield Series(A3, TABLE, list(of_table.values()), where=where, along=WAVE, at=list(of_table), unit="dB")
    keys = [(wheel, 0.0, name) for name in result.case.across if isinstance(GROUNDS[name], float)]
    if len(keys) < 2:
        return
    off, *ends = (_one_line_off(result, keys, sign) for sign in (0, 1, -1))
    for i, name in enumerate(WAYS):
        near, far = (np.abs(end - off)[:, i] for end in ends)
        intervals = [Interval(*pair) for pair in zip(off[:, i].tolist(), np.maximum(near, far).tolist(), strict=True)]
        yield Series(OFF, name, intervals, where=where, along="alpha", at=FINE_ALPHAS, unit="dB")
        borders = [[_crossing(levels[:, i], tolerance) for levels in (off, *ends)] for tolerance in TOLERANCES]
        intervals = [Interval(middle, max(abs(end - middle) for end in both)) for middle, *both in borders]
        yield Series(BORDER, name, intervals, where=where, along=WITHIN, at=TOLERANCES)


def _one_line_off(result: AcrossResult, keys: Sequence[Key], sign: int) -> FloatArray:
    """Worst band that counts, and sound power at each speed, of one line over boundary elements, (alphas, ways).

    Linear theory of the ellipse on a fine grid of alpha, with what boundary elements are over it between the alphas at
    which they rolled.
    """
    scene = result.case.scene(keys[0])
    rolled = np.log([float(GROUNDS[key[2]]) for key in keys])
    over = scipy.interpolate.make_interp_spline(rolled, [result.beyond_linear(key, sign) for key in keys], k=1)
    line, rows = linear_filter(scene, LINEAR_ON_LINE, "ridges"), []
    for alpha in FINE_ALPHAS.tolist():
        linear = linear_filter(scene, LINEAR, alpha)
        a3 = linear + over(np.clip(np.log(alpha), rolled[0], rolled[-1]))
        worst = float(np.abs(line - a3)[counted(linear)].max())
        rows.append([worst, *filters.over_in_decibel_a(scene, line, a3, SPEEDS)])
    return np.array(rows)


def _crossing(off: FloatArray, tolerance: float) -> float:
    """The first alpha beyond which it is more, an end of the grid where that is none."""
    beyond = np.flatnonzero(off > tolerance)
    if not beyond.size or beyond[0] == 0:
        return float(FINE_ALPHAS[0 if beyond.size else -1])
    i = beyond[0]
    return float(np.exp(np.interp(tolerance, off[i - 1 : i + 1], np.log(FINE_ALPHAS[i - 1 : i + 1]))))
