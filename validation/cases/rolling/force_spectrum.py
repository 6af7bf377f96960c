"""Rolling over isotropic roughness: the force along the track by boundary elements, springs and linear theory.

Levels of boundary elements are taken over linear theory on the same surfaces, which removes most of the scatter.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from validation.analysis.evidence import Role
from validation.analysis.margins import THREE_DECIBELS
from validation.analysis.series import Estimates, Margin, Ranges, Series, masked
from validation.analysis.statistics import DECIBEL, POWER_DECIBEL, Estimate, mean_estimate, ratio_of_means
from validation.analysis.study import Outcomes
from validation.cases.rolling.settings import HEIGHT, Q, SelfAffineSettings, slopes_of
from validation.engine.convergence import require_realisations
from validation.engine.engine import SERIAL, Engine
from validation.simulation import rolling_strip
from validation.simulation.rolling_strip import HERTZ, ROUNDING, level_1d, level_3d
from validation.simulation.track_spectrum import InputSpectrum, TrackSpectrum
from validation.theory.rolling import force_spectrum_1d, level_ratio, mean_force_spectrum_1d

ROUGH = 0.3
"""h/d from which on linear theory on the same surface no longer removes the scatter."""


@dataclass(frozen=True, kw_only=True)
class ForceSpectrum(SelfAffineSettings):
    """rough_strips: realisations where h/d is ROUGH or more; refined: how many of them are rolled again on cells half
    as wide."""

    heights: tuple[float, ...] = (0.01, 0.1, 1.0)
    strips: int = 6
    rough_strips: int = 6
    refined: int = 6
    tracks: int = 60

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips, rough_strips=self.rough_strips, refined=self.refined)

    def strips_of(self, height: float, cells: int) -> list[rolling_strip.Strip]:
        """On one grid. The lower the roughness, the less the force fluctuates and the smaller the tolerance."""
        strips = self.rough_strips if height >= ROUGH else self.strips
        count = strips if cells == self.cells else min(self.refined, strips)
        return self.rough_strip(self.spectrum, height).strips(cells, 1e-4 * height, count)

    @property
    def ranges(self) -> Ranges:
        """Bands below that of the roughness, where springs with Geike's spectrum have no level; bands inside."""
        ends = (self.lowest, self.first), (self.first, self.last)
        return {(low, high): self.bands_in(low, high) for low, high in ends if low < high}

    def bands_in(self, low: float, high: float) -> NDArray[np.bool_]:
        edges = np.array(self.bands.edges)
        return (edges[:-1] > low * (1 - 1e-9)) & (edges[1:] < high * (1 + 1e-9))


def run(case: ForceSpectrum, engine: Engine = SERIAL) -> Outcomes:
    """Roll all strips and tracks. Raises NotConvergedError where fewer than three strips at a height converge."""
    grids = {"bem3d": case.cells, "refined": 2 * case.cells}
    groups = {(name, h): case.strips_of(h, cells) for name, cells in grids.items() for h in case.heights}
    strips, unconverged = rolling_strip.roll_strips(groups, engine)
    scenes = {h: case.rough_strip(case.spectrum, h) for h in case.heights}
    tracks = {(model, h): case.tracks_on(one, RULES[model]) for h, one in scenes.items() for model in RULES}
    of_strips = rolling_strip.strip_levels
    levels = {(name, h): of_strips(one, 1 / grids[name], case.bands) for (name, h), one in strips.items()}
    rolled = dict(zip(tracks, engine.map(rolling_strip.roll_tracks, list(tracks.values())), strict=True))
    return Outcomes(case, {**levels, **rolled, **{h: strips["bem3d", h][0] for h in case.heights}}, unconverged)


LINEAR_1D, SPRINGS, LINEAR_3D, ROLLING_SPRINGS = "linear 1D", "springs", "linear 3D", "rolling-equivalent springs"
RULES: dict[str, InputSpectrum] = {SPRINGS: "geike", ROLLING_SPRINGS: "rolling"}
OVER, BOTH = " over bem3d", "springs beside bem3d"
LEVEL, NONLINEAR = "level of a one-third octave", "nonlinear over linear level of a one-third octave"
VARIANCE, MEAN = "variance of the force over that of linear theory", "mean force over that of Hertz"
RMS_FORCE, EXCESS = "rms force over that of boundary elements", "mean level over its limit for q a >> 1"
SHOWN, SPECTRUM, COHERENCE, FORCE = "level of the force", "spectrum of the force", "coherence", "force along the track"
CORRELATION, REGRESSION = "correlation with linear theory", "slope of the force over that of linear theory"
APPLICATIONS, EXAMINED = "operator applications a position", "springs examined a position"
NEAR = THREE_DECIBELS.beside("bem3d, extrapolated, on the same surfaces as linear theory in 3D")
MUST = replace(NEAR, role=Role.CRITERION)
OF_VARIANCE = Margin(
    tolerance=0.1,
    reason="10 %: 0.4 dB of a variance",
    source="Geike's rule keeps the variance of the force at one position",
)
OF_MEAN = Margin(tolerance=0.02, reason="2 %: uncertainty of the load of a wheel", source="bem3d")
OF_WHOLE = Margin(
    tolerance=DECIBEL * math.log(1.1),
    reason="10 %: 0.8 dB of the whole force, less than what is repeatable",
    source="bem3d, extrapolated, all over linear theory on the same roughness",
)
OF_LIMIT = Margin(
    tolerance=0.5,
    reason="0.5 dB: the band is bounded and q a is finite",
    source="sqrt(π) Γ(H + 2) / Γ(H + 3/2), an unbounded power law in linear theory, whose sin² has the mean 1/2",
)
LINEAR_UP_TO = 0.01
"""h/d up to which boundary elements must agree with linear theory, or something is wrong with them."""


def series(result: Outcomes) -> list[Series]:
    heights = result.case.heights
    three = dict.fromkeys((heights[0], heights[len(heights) // 2], heights[-1]))
    return [
        slopes_of(result.case),
        *(one for of in (levels_at, moments_at, _whole) for height in heights for one in of(result, height)),
        _excess(result, heights[0]),
        *_spectrum(result, heights[0]),
        *(one for height in three for one in _force(result, height)),
    ]


def bem_over_linear(result: Outcomes, height: float) -> tuple[Estimates, Estimates]:
    """ln of the level of boundary elements over linear theory on cells of no size, and the change to finer cells."""
    bem, fine = result["bem3d", height], result["refined", height]["level"]
    finer = Estimates.ratios(fine, bem["level"][: len(fine)])
    return Estimates.ratios(bem["level"], bem["linear level"]).on_no_size(finer), finer


def levels_at(result: Outcomes, height: float) -> Iterator[Series]:
    """All that is found at one height of the roughness, band by band."""
    case, mine, bem = result.case, result[SPRINGS, height], result["bem3d", height]
    over_linear, finer = bem_over_linear(result, height)
    exact = level_3d(case.spectrum, case.bands)
    with np.errstate(divide="ignore"):
        in_1d = np.log(level_1d(case.spectrum, "geike", case.bands) / exact)
    springs = {name: Estimates.ratios(result[name, height]["level"], height**2 * exact) for name in RULES}
    linear = {LINEAR_1D: Estimates.exact(in_1d), LINEAR_3D: Estimates.exact(np.zeros(exact.size))}
    models = {name: (linear | springs)[name] for name in (LINEAR_1D, SPRINGS, LINEAR_3D, ROLLING_SPRINGS)}
    in_bands = partial(Series, where={HEIGHT: height}, along=Q, at=case.bands.centres)
    decibels = partial(in_bands, scale=POWER_DECIBEL, unit="dB")
    judged = partial(decibels, grid=finer, family=2 * len(case.heights) * len(case.ranges))
    unit = Estimates.exact(np.log(exact))
    yield decibels(SHOWN, "bem3d", over_linear + unit, grid=finer)
    for model, level in models.items():
        yield decibels(SHOWN, model, level + unit)
        must = {"margin": MUST, "family": 1} if model == LINEAR_3D and height <= LINEAR_UP_TO else {"margin": NEAR}
        yield judged(LEVEL, model + OVER, level - over_linear, ranges=case.ranges, **must)
    nonlinear = masked(Estimates.ratios(mine["level"], np.maximum(mine["linear level"], ROUNDING)), np.isfinite(in_1d))
    inside, margin = dict([*case.ranges.items()][-1:]), NEAR.beside("bem3d over linear theory in 3D")
    yield judged(NONLINEAR, BOTH, nonlinear, reference=over_linear, ranges=inside, margin=margin)
    yield decibels(NONLINEAR, "bem3d", over_linear)
    yield in_bands(COHERENCE, "bem3d", rolling_strip.coherence(bem))
    yield in_bands(COHERENCE, SPRINGS, np.where(np.isfinite(in_1d), rolling_strip.coherence(mine), np.nan))


def moments_at(result: Outcomes, height: float) -> Iterator[Series]:
    """Variance at one position over that of linear theory, the same in 1D and in 3D; the mean force."""
    heights, of = len(result.case.heights), {name: result[name, height] for name in ("bem3d", SPRINGS)}
    single = partial(Series, where={HEIGHT: height})
    for model, one in of.items():
        ratio = ratio_of_means(one["variance"], one["linear variance"])
        yield single(VARIANCE, model, (ratio,), reference=1.0, margin=OF_VARIANCE, family=2 * heights)
    bem, springs = ((mean_estimate(one["mean"]),) for one in of.values())
    yield single(MEAN, "bem3d", bem)
    yield single(MEAN, BOTH, springs, reference=bem, margin=OF_MEAN, family=heights)


def _whole(result: Outcomes, height: float) -> Iterator[Series]:
    """All bands together: the rms force, how alike it is to that of linear theory; and counted work.

    Geike's rule keeps the variance of linear theory in 3D, over which each one-sided model is taken.
    """
    bem, springs, fine = (result[name, height] for name in ("bem3d", SPRINGS, "refined"))
    single = partial(Series, where={HEIGHT: height})
    whole, in_1d = (Estimates.ratios(one["variance"], one["linear variance"]) for one in (bem, springs))
    finer = Estimates.ratios(fine["variance"], bem["variance"][: len(fine["variance"])])
    over = partial(single, grid=finer, scale=POWER_DECIBEL, unit="dB", margin=OF_WHOLE)
    for model, level in ((SPRINGS, in_1d), (LINEAR_3D, Estimates.exact(0.0, whole[0].samples))):
        rms = level - whole.on_no_size(finer)
        yield over(RMS_FORCE, model + OVER, rms, family=2 * len(result.case.heights))
    for model, one in (("bem3d", bem), (SPRINGS, springs)):
        for name, value in zip((CORRELATION, REGRESSION), rolling_strip.correlation(one), strict=True):
            yield single(name, model, (value,))
    yield single(APPLICATIONS, "bem3d", (float(result[height]["applications"].mean()),))
    yield single(EXAMINED, SPRINGS, (float(springs["examined"].mean()),))


def _excess(result: Outcomes, height: float) -> Series:
    """By how much Geike's spectrum is too loud along the track in the mean, beside the power law without ends."""
    case, bem, fine = result.case, result["bem3d", height], result["refined", height]["level"]
    short = 4 * case.first, case.last
    inside = case.bands_in(*short)
    mean = inside / inside.sum()
    levels = level_1d(case.spectrum, "geike", case.bands), level_3d(case.spectrum, case.bands)
    in_1d, in_3d = (level[inside] for level in levels)
    finer = Estimates.ratio(fine, bem["level"][: len(fine)], mean)
    over = Estimates.ratio(bem["level"], bem["linear level"], mean).on_no_size(finer)
    return Series(
        EXCESS,
        LINEAR_1D + OVER,
        Estimates.exact(np.log(in_1d / in_3d).mean()) - over,
        where={HEIGHT: height, Q: short},
        reference=(Estimate(-math.log(level_ratio(case.hurst)), 0.0, over[0].samples),),
        grid=finer,
        scale=POWER_DECIBEL,
        unit="dB",
        margin=OF_LIMIT,
    )


def _spectrum(result: Outcomes, height: float) -> Iterator[Series]:
    """Fig. 14.3: C_F over F_Hertz^2 a (h/d)^2, wave by wave."""
    case, springs = result.case, result[SPRINGS, height]
    geike = TrackSpectrum(case.spectrum, "geike")
    inside = (springs["wavenumber"] > case.first / 2) & (springs["wavenumber"] < case.last)
    q = springs["wavenumber"][inside]
    wave = partial(Series, SPECTRUM, along=Q, at=q)
    yield wave("(14.12)", force_spectrum_1d(q, geike, contact_radius=1.0, modulus=1.0) / HERTZ**2)
    yield wave("(14.14)", mean_force_spectrum_1d(q, geike, modulus=1.0) / HERTZ**2)
    yield wave(LINEAR_3D, rolling_strip.force_3d(q, case.spectrum) / HERTZ**2)
    yield wave(SPRINGS, springs["spectrum"][inside] / height**2)


def _force(result: Outcomes, height: float) -> Iterator[Series]:
    """Along a part of the first strip, about its mean, over F_Hertz h/d."""
    cells, rolled = result.case.cells, result[height]
    x = np.arange(min(12 * cells, round(result.case.length * cells)))
    for model, name in (("bem3d", "force"), (LINEAR_3D, "linear")):
        force = rolled[name][: x.size]
        yield Series(FORCE, model, (force - force.mean()) / height, where={HEIGHT: height}, along="x / a", at=x / cells)
