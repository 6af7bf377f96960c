"""Rolling over isotropic roughness: the force along the track by springs, linear theory and boundary elements.

Units: contact radius a = 1 of the smooth wheel, approach d = 1, E* = 1.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from validation.analysis.evidence import Place, Role
from validation.analysis.quantity import MEAN_FORCE, RMS_FORCE
from validation.analysis.series import REPEATABLE, Counted, Estimates, Margin
from validation.analysis.spectra import Bands
from validation.analysis.statistics import DECIBEL, POWER_DECIBEL, FloatArray, jackknifed
from validation.case import SERIAL, Engine, Outcomes, Quantity, Series
from validation.engine.realisations import require_realisations
from validation.simulation import rolling_strip
from validation.simulation.model_names import FILTER_3D, SPRINGS_ROLLING
from validation.simulation.rolling_strip import (
    HERTZ,
    RoughStrip,
    Tracks,
    by_filter_3d,
    by_mean_filter,
    level_1d,
    level_3d,
    over_bands,
    strip_levels,
)
from validation.simulation.track_spectrum import (
    INPUT_NAMES,
    INPUT_SPECTRA,
    PiecewisePowerLaw,
    TrackSpectrum,
    self_affine,
)
from validation.theory.rolling import force_spectrum_1d, level_ratio, mean_force_spectrum_1d

ROUGH = 0.3
"""h/d from which on linear theory on the same surface no longer removes the scatter."""


@dataclass(frozen=True, kw_only=True)
class ForceSpectrum:
    """A wheel at the approach d over self-affine roughness, contact radius a.

    heights: h_rms / d, ascending; hurst; first, last: q a of the ends of the roughness; lowest: q a of the first
    one-third octave; length, width: of the periodic surfaces over a; cells: to a contact radius; strips: realisations
    of boundary elements, rough_strips: where h/d is ROUGH or more; refined: how many of them are rolled again on cells
    half as wide; tracks: realisations on springs; springs: to a radius; seed: zero or more.
    """

    heights: tuple[float, ...] = (0.01, 0.1, 1.0)
    hurst: float = 0.7
    first: float = 1.0
    last: float = 10.0
    lowest: float = 0.4
    length: float = 64.0
    width: float = 16.0
    cells: int = 8
    strips: int = 6
    rough_strips: int = 6
    refined: int = 6
    tracks: int = 60
    springs: int = 32
    seed: int = 144

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips, rough_strips=self.rough_strips, refined=self.refined)

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        return self_affine(self.hurst, self.first, self.last)

    @property
    def spectra(self) -> dict[str, PiecewisePowerLaw]:
        """Of surfaces for which input spectra of springs are compared; the narrow band ends before `last`."""
        return {
            **{f"H = {hurst:g}": self_affine(hurst, 1.0, self.last) for hurst in (0.4, 0.7, 1.0)},
            "roll-off": PiecewisePowerLaw(edges=(0.25, 2.0, self.last), exponents=(0.0, 3.4)),
            "two power laws": PiecewisePowerLaw(edges=(1.0, 4.0, self.last), exponents=(2.4, 4.0)),
            "narrow band": PiecewisePowerLaw(edges=(4.0, 6.0), exponents=(0.0,)),
        }

    @property
    def bands(self) -> Bands:
        """One-third octaves from the lowest to the last, one of them around the first zero of sin(q a)."""
        return Bands.around(math.pi, self.lowest, self.last).on(self.length)

    @property
    def between_zeros(self) -> NDArray[np.bool_]:
        """One-third octaves in the band of the roughness in which sin(q a) has no zero."""
        edges = np.array(self.bands.edges)
        return np.asarray((np.diff(np.floor(edges / np.pi)) == 0) & (edges[:-1] > self.first * (1 - 1e-9)))

    def rough_strip(self, height: float) -> RoughStrip:
        return RoughStrip(spectrum=self.spectrum, height=height, length=self.length, width=self.width, seed=self.seed)

    def strips_of(self, height: float, cells: int) -> list[rolling_strip.Strip]:
        """On one grid. The lower the roughness, the less the force fluctuates and the smaller the tolerance."""
        strips = self.rough_strips if height >= ROUGH else self.strips
        count = strips if cells == self.cells else min(self.refined, strips)
        return self.rough_strip(height).strips(cells, 1e-4 * height, count)

    def tracks_of(self, height: float, model: str) -> Tracks:
        """On springs, by Geike's rule or with the rolling-equivalent spectrum."""
        return Tracks(
            scene=self.rough_strip(height),
            input_spectrum="geike" if model == SPRINGS else "rolling",
            realisations=self.tracks,
            springs=self.springs,
            bands=self.bands,
        )


def run(case: ForceSpectrum, engine: Engine = SERIAL) -> Outcomes:
    """Roll all strips and tracks. Raises NotConvergedError where fewer than three strips at a height converge."""
    grids = {BEM: case.cells, REFINED: 2 * case.cells}
    groups = {(name, h): case.strips_of(h, cells) for name, cells in grids.items() for h in case.heights}
    strips, unconverged = rolling_strip.roll_strips(groups, engine)
    tracks = {(model, h): case.tracks_of(h, model) for model in (SPRINGS, SPRINGS_ROLLING) for h in case.heights}
    levels = {(name, h): strip_levels(outcome, 1 / grids[name], case.bands) for (name, h), outcome in strips.items()}
    rolled = dict(zip(tracks, engine.map(rolling_strip.roll_tracks, list(tracks.values())), strict=True))
    return Outcomes(case, {**levels, **rolled}, unconverged)


BEM, REFINED = "boundary elements", "boundary elements, half of the cell"
SPRINGS, LINEAR_1D, LINEAR_3D, MEAN_1D = "springs", "(14.12)", FILTER_3D, "(14.14)"
OVER, UNBOUNDED = " over boundary elements", "(14.14) over linear theory in 3D, unbounded power law"
CURVE = Quantity("level_of_a_one-third_octave_over_the_curve")
MEAN_LEVEL = Quantity("mean_level_for_q_a_4", "mean level for q a > 4")
LEVEL = Quantity("level_of_an_octave")
RMS_LEVEL = "rms of " + LEVEL
SHOWN, SPECTRUM = Quantity("level_of_the_force_in_a_one-third_octave"), Quantity("spectrum_of_the_force")
INPUT_LEVEL = Quantity("level_of_a_one-third_octave_by_input_spectrum")
INPUT = Quantity("level_of_an_octave_by_input_spectrum")
FOUND = Quantity("roughness_found_in_a_one-third_octave")
HEIGHT, SLOPE, Q, SURFACE = "h/d", "h' a/d", "q a", "surface"
SLOPE_COUNTS = "h' is the rms slope along the track, in one direction, of all waves"
SHORT_WAVES = 4.0
"""q a of where q a >> 1 begins."""
BESIDE_BEM = REPEATABLE.with_source("boundary elements, extrapolated, on the same surfaces as linear theory in 3D")
IN_OCTAVES = replace(BESIDE_BEM, worst=False, rms=(REPEATABLE.tolerance, REPEATABLE.reason))
OF_FORCE = Margin(
    DECIBEL * math.log(1.1), "10 %: 0.8 dB of the whole force, less than what is repeatable", source=BESIDE_BEM.source
)
LOW = 0.03
"""h/d up to which h is "much smaller than" d."""
MUST_BE_LINEAR = 0.01
"""h/d up to which boundary elements must agree with linear theory, or something is wrong with them."""


def series(result: Outcomes) -> list[Series]:
    heights = result.case.heights
    by_height = (_curve, _levels, _force, _roughness)
    return [
        *(series for of in by_height for height in heights for series in of(result, height)),
        *_inputs(result.case),
        *_spectrum(result, heights[0]),
    ]


def at(case: ForceSpectrum, height: float) -> dict[str, Place]:
    return {HEIGHT: height, SLOPE: float(f"{height * case.spectrum.slope_along:.3g}")}


def octaves_of(bands: Bands, spectrum: PiecewisePowerLaw) -> NDArray[np.intp]:
    """Whole octaves from the first one-third octave with waves on: rows of three of their places."""
    edges = np.array(bands.edges)
    inside = np.flatnonzero((edges[1:] > spectrum.edges[0] * 1.001) & (edges[:-1] < spectrum.edges[-1] * 0.999))
    return inside[: inside.size // 3 * 3].reshape(-1, 3)


def of_bem(
    result: Outcomes, height: float, summed: Callable[[FloatArray], FloatArray] = np.asarray
) -> tuple[Estimates, Estimates]:
    """ln of the level of boundary elements over linear theory at zero cell size, and the change to finer cells.

    summed: from levels in one-third octaves to those that are compared.
    """
    bem, fine = result[BEM, height], summed(result[REFINED, height]["level"])
    level, linear = (summed(bem[name]) for name in ("level", "linear level"))
    finer = Estimates.ratios(fine, level[: len(fine)])
    return Estimates.ratios(level, linear).extrapolate_to_zero(finer), finer


def _curve(result: Outcomes, height: float) -> Iterator[Series]:
    """Springs over (14.12) in one-third octaves, and over (14.14) in the mean; (14.14) over boundary elements.

    Judged where the book says so, at low roughness.
    """
    case, springs, where = result.case, result[SPRINGS, height]["level"] / height**2, at(result.case, height)
    edges = np.array(case.bands.edges)
    inside, short = ((edges[:-1] > q * (1 - 1e-9)) & (edges[1:] < case.last) for q in (case.first, SHORT_WAVES))
    decibels = partial(Series, where=where, scale=POWER_DECIBEL, unit="dB")
    filters = partial(force_spectrum_1d, contact_radius=1.0, modulus=1.0), partial(mean_force_spectrum_1d, modulus=1.0)
    book, mean = (levels_on_track(case, spectrum) for spectrum in filters)
    curve = Estimates.ratios(springs[:, inside], book[inside])
    margin = REPEATABLE.with_source("(14.12), (14.14), on the waves of a track") if height <= LOW else None
    yield decibels(CURVE, SPRINGS, curve, along=Q, at=case.bands.centres[inside], margin=margin)
    if np.count_nonzero(short) < 3:
        return  # no octave, which holds a period of sin^2(q a)
    weights = short / short.sum()
    over = Estimates.ratio(np.maximum(springs, rolling_strip.ROUNDING), mean, weights)
    yield decibels(MEAN_LEVEL, f"{SPRINGS} over {MEAN_1D}", over, margin=margin)
    bem, fine = (result[grid, height] for grid in (BEM, REFINED))
    finer = Estimates.ratio(fine["level"], bem["level"][: len(fine["level"])], weights)
    linear = Estimates.ratio(bem["level"], bem["linear level"], weights).extrapolate_to_zero(finer)
    yield decibels(MEAN_LEVEL, UNBOUNDED, (-math.log(level_ratio(case.hurst)),))
    of_band = over_bands(lambda q: filters[1](q, TrackSpectrum(case.spectrum, "geike")), case.bands) / HERTZ**2
    exact = np.log((of_band / level_3d(case.spectrum, case.bands))[short]).mean()
    yield decibels(
        MEAN_LEVEL, MEAN_1D + OVER, Estimates.exact(exact) - linear, grid=finer, margin=margin and BESIDE_BEM
    )


def levels_on_track(case: ForceSpectrum, spectrum: Callable[..., FloatArray]) -> FloatArray:
    """Of (14.12) or (14.14) in each one-third octave, on the waves of a track with Geike's spectrum, h_rms = d."""
    geike, step = TrackSpectrum(case.spectrum, "geike"), 2 * math.pi / case.length
    q = step * np.arange(1, math.floor(case.last * (1 + 1e-9) / step) + 1)
    square = 2 * step * geike(q).sum()
    return np.asarray(case.bands.sums(q, step * spectrum(q, geike)).real / square / HERTZ**2)


def _levels(result: Outcomes, height: float) -> Iterator[Series]:
    """In octaves each model over boundary elements, which are over linear theory on the same surfaces."""
    case = result.case
    springs, rolling = (result[model, height]["level"] / height**2 for model in (SPRINGS, SPRINGS_ROLLING))
    octaves = octaves_of(case.bands, case.spectrum)

    def summed(levels: FloatArray) -> FloatArray:
        return np.asarray(levels[..., octaves].sum(axis=-1))

    exact, book = level_3d(case.spectrum, case.bands), level_1d(case.spectrum, "geike", case.bands)
    bem, finer = of_bem(result, height, summed)
    models = {
        LINEAR_1D: Estimates.exact(np.log(summed(book) / summed(exact))),
        SPRINGS: Estimates.ratios(summed(springs), summed(exact)),
        SPRINGS_ROLLING: Estimates.ratios(summed(rolling), summed(exact)),
        LINEAR_3D: Estimates.exact(np.zeros(len(octaves))),
    }
    in_decibels = partial(Series, where=at(case, height), along=Q, scale=POWER_DECIBEL, unit="dB")
    for model, level in models.items():
        must = model == LINEAR_3D and height <= MUST_BE_LINEAR
        yield in_decibels(
            LEVEL,
            model + OVER,
            level - bem,
            at=case.bands.centres[octaves[:, 1]],
            grid=finer,
            margin=replace(IN_OCTAVES, worst=True, role=Role.CRITERION) if must else IN_OCTAVES,
        )
    shown = partial(in_decibels, SHOWN, at=case.bands.centres)
    over_linear, finer = of_bem(result, height)
    yield shown(BEM, over_linear + Estimates.exact(np.log(exact)), grid=finer)
    with np.errstate(divide="ignore"):
        for model, of_bands in ((LINEAR_1D, book), (LINEAR_3D, exact), (SPRINGS, springs.mean(axis=0))):
            yield shown(model, np.log(of_bands))


def _force(result: Outcomes, height: float) -> Iterator[Series]:
    """Mean and rms of the force over those of boundary elements, the latter all over linear theory.

    Geike's rule keeps the variance of linear theory in 3D.
    """
    bem, springs, fine = (result[name, height] for name in (BEM, SPRINGS, REFINED))
    in_3d, in_1d = (Estimates.ratios(rows["variance"], rows["linear variance"]) for rows in (bem, springs))
    finer = Estimates.ratios(fine["variance"], bem["variance"][: len(fine["variance"])])
    over = partial(Series, where=at(result.case, height), unit="dB", margin=OF_FORCE)
    of_rms = partial(over, RMS_FORCE, scale=POWER_DECIBEL, grid=finer)
    for model, level in ((SPRINGS, in_1d), (LINEAR_3D, Estimates.exact(0.0, in_3d[0].samples))):
        yield of_rms(model + OVER, level - in_3d.extrapolate_to_zero(finer))
    mean, in_1d = (Estimates.ratios(rows["mean"], np.ones(1)) for rows in (bem, springs))
    finer = Estimates.ratios(fine["mean"], bem["mean"][: len(fine["mean"])])
    yield over(MEAN_FORCE, SPRINGS + OVER, in_1d - mean.extrapolate_to_zero(finer), scale=DECIBEL, grid=finer)


def _roughness(result: Outcomes, height: float) -> Iterator[Series]:
    """Read back from the force of boundary elements, over the true one, in bands between the zeros of sin(q a)."""
    case, bem, kept = result.case, result[BEM, height], result.case.between_zeros
    true, exact = over_bands(TrackSpectrum(case.spectrum, "geike"), case.bands), level_3d(case.spectrum, case.bands)
    rows = np.stack([bem["level"], bem["linear level"]], axis=1)
    _, finer = of_bem(result, height)
    for name, read in ((MEAN_1D, by_mean_filter), (LINEAR_3D, by_filter_3d)):

        def over_true(
            levels: FloatArray, read: Callable[[Bands, FloatArray], FloatArray] = read, least: float = 0.0
        ) -> FloatArray:
            level, linear = levels.mean(axis=0)
            power = read(case.bands, exact * level / linear * np.exp(2 * finer.values))
            return np.asarray(np.log(np.maximum(power[kept] / true[kept], least)))

        left = [change for change, inside in zip(finer, kept, strict=True) if inside]
        yield Series(
            FOUND,
            name,
            jackknifed(over_true, rows),
            where=at(case, height),
            along=Q,
            at=case.bands.centres[kept],
            grid=left,
            counted=Counted(jackknifed(partial(over_true, least=LEAST), rows), left, RULE),
            scale=POWER_DECIBEL,
            unit="dB",
            margin=replace(IN_OCTAVES, source="the surface itself"),
        )


LEAST = 1e-3
RULE = "less than -30 dB of the true roughness is judged as -30 dB"
"""Of verdicts alone: where no roughness is found, data have no level."""


def _inputs(case: ForceSpectrum) -> Iterator[Series]:
    """(14.12) by each input spectrum over linear theory in 3D, both by quadrature."""
    margin = replace(IN_OCTAVES, source="linear theory in 3D, by quadrature")
    for name, spectrum in case.spectra.items():
        exact, octaves = level_3d(spectrum, case.bands), octaves_of(case.bands, spectrum)
        for rule in INPUT_SPECTRA:
            of_rule, model = level_1d(spectrum, rule, case.bands), INPUT_NAMES[rule]
            decibels = partial(Series, where={SURFACE: name}, along=Q, scale=POWER_DECIBEL, unit="dB")
            levels = np.log(of_rule[octaves].sum(axis=1) / exact[octaves].sum(axis=1))
            yield decibels(INPUT, model, levels, at=case.bands.centres[octaves[:, 1]], margin=margin)
            positive = (of_rule > 0) & (exact > 0)
            yield decibels(
                INPUT_LEVEL, model, np.log(of_rule[positive] / exact[positive]), at=case.bands.centres[positive]
            )


def _spectrum(result: Outcomes, height: float) -> Iterator[Series]:
    """Fig. 14.3: C_F over F_Hertz^2 a (h/d)^2, wave by wave."""
    case, springs = result.case, result[SPRINGS, height]
    geike = TrackSpectrum(case.spectrum, "geike")
    inside = (springs["wavenumber"] > case.first / 2) & (springs["wavenumber"] < case.last)
    q = springs["wavenumber"][inside]
    wave = partial(Series, SPECTRUM, along=Q, at=q)
    yield wave(LINEAR_1D, force_spectrum_1d(q, geike, contact_radius=1.0, modulus=1.0) / HERTZ**2)
    yield wave(MEAN_1D, mean_force_spectrum_1d(q, geike, modulus=1.0) / HERTZ**2)
    yield wave(LINEAR_3D, rolling_strip.force_3d(q, case.spectrum) / HERTZ**2)
    yield wave(SPRINGS, springs["spectrum"][inside] / height**2)
