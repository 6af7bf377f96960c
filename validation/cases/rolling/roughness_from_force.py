"""Roughness from force: filters read backwards on the force of boundary elements, over surfaces that are known."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim
from validation.analysis.margins import THREE_DECIBELS
from validation.analysis.series import Margin, Series
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL, FloatArray, jackknifed
from validation.analysis.study import Outcomes, Study
from validation.cases.rolling.settings import HEIGHT, SLOPE, SLOPE_COUNTS, Q, SelfAffineSettings, slopes_of
from validation.engine.engine import SERIAL, Engine
from validation.simulation.rolling_strip import HERTZ, level_3d, over_bands, roll_strips, strip_levels
from validation.simulation.track_spectrum import PiecewisePowerLaw, TrackSpectrum
from validation.theory.rolling import force_spectrum_1d, mean_force_spectrum_1d

MEAN_FILTER, FILTER_1D, FILTER_3D = "(14.14)", "(14.12)", "filter in 3D"
FILTERS = (MEAN_FILTER, FILTER_1D, FILTER_3D)
LEAST = 1e-3
"""Of the true level, -30 dB: less is nothing that was found."""
ASSUMED = 3.0
"""Exponent of C_2D within a one-third octave, which a measured force does not tell; the true one is 2 H + 2."""


@dataclass(frozen=True, kw_only=True)
class RoughnessFromForce(SelfAffineSettings):
    """Surfaces whose roughness is found from the force of boundary elements."""

    heights: tuple[float, ...] = (0.03, 0.3)
    strips: int = 8
    tracks: int = 0
    seed: int = 152

    @property
    def inside(self) -> NDArray[np.bool_]:
        """Which one-third octaves lie in the band of the roughness; the others lie below or on its first wave."""
        return np.array(self.bands.edges[:-1]) > self.first * (1 - 1e-9)

    @property
    def zeros(self) -> NDArray[np.bool_]:
        """In which one-third octaves sin(q a) has a zero."""
        turns = np.floor(np.array(self.bands.edges) / np.pi)
        return np.diff(turns) > 0


def run(case: RoughnessFromForce, engine: Engine = SERIAL) -> Outcomes:
    """Roll over all strips; levels of the force by h/d.

    Raises NotConvergedError where fewer than three strips at a height converge.
    """
    groups = {
        height: case.rough_strip(case.spectrum, height).strips(case.cells, 1e-4 * height, case.strips)
        for height in case.heights
    }
    strips, unconverged = roll_strips(groups, engine)
    levels = {height: strip_levels(found, 1 / case.cells, case.bands) for height, found in strips.items()}
    return Outcomes(case, levels, unconverged)


def true_roughness(case: RoughnessFromForce) -> FloatArray:
    """int C_1D dq over each band, Geike's: half of the mean square height of its waves, h_rms = 1."""
    return over_bands(TrackSpectrum(case.spectrum, "geike"), case.bands)


def roughness(bands: Bands, levels: FloatArray, by: str) -> FloatArray:
    """The same from levels of the force in the bands, by a filter that is read backwards.

    "(14.14)": C_1D = q^2 C_F / (2 E*^2); "(14.12)": C_1D = q^2 C_F / (4 E*^2 sin^2(q a)); both by the mean of the
    filter over a band. "filter in 3D": the heights of all bands, none negative, that have these levels, since a wave s
    of the surface has a part of its force in each band below s.
    """
    if by == FILTER_3D:
        # each level is met as well as all others, however small
        return np.asarray(nnls(filter_3d(bands) / levels[:, np.newaxis], np.ones(levels.size))[0])
    if by == FILTER_1D:
        return levels * over_bands(flat, bands) / mean_filter(bands, force_spectrum_1d, contact_radius=1.0)
    return levels * over_bands(flat, bands) / mean_filter(bands, mean_force_spectrum_1d)


def flat(q: FloatArray) -> FloatArray:
    """C_1D = pi q C_2D within a band, times any constant."""
    return np.asarray(q ** (1 - ASSUMED))


def mean_filter(bands: Bands, spectrum: Callable[..., FloatArray], **settings: float) -> FloatArray:
    """Levels of the force of C_1D = `flat`."""
    return over_bands(lambda q: spectrum(q, flat, modulus=1.0, **settings), bands) / HERTZ**2


@cache
def filter_3d(bands: Bands) -> FloatArray:
    """Level of the force in each band (rows) of int C_1D dq = 1 in each band (columns): zero above the waves' own."""
    edges = zip(bands.edges, bands.edges[1:], strict=False)
    # a piece of unit height has int C_1D dq = 1/2 over positive q
    pieces = [PiecewisePowerLaw(edges=pair, exponents=(ASSUMED,)) for pair in edges]
    return np.stack([2 * level_3d(piece, bands) for piece in pieces], axis=1)


LEVEL, BELOW = "roughness found in a one-third octave", "roughness found below the band"
FOUND, OVER_TRUE = "mean square height in a one-third octave, over that of all", "roughness found over the true one"
BETWEEN, ZEROS = "between zeros of sin(q a)", "at zeros of sin(q a)"
NEAR = THREE_DECIBELS.beside("the surface itself")
LITTLE = Margin(
    0.05, "5 %: 0.2 dB of the mean square height", source="the surface itself, over the mean square of its whole height"
)


def series(result: Outcomes) -> list[Series]:
    """Found over true roughness by each filter, in bands with a zero of the filter and in others; below the band."""
    case = result.case
    found = [one for height in case.heights for by in FILTERS for one in _recovered(result, height, by)]
    return [slopes_of(case), *found]


def _recovered(result: Outcomes, height: float, by: str) -> Iterator[Series]:
    """By one filter. Intervals of all bands inside hold at once for all heights."""
    case, inside = result.case, result.case.inside
    below = np.array(case.bands.edges[1:]) < case.first * (1 + 1e-9)
    strips = np.stack([result[height][name] for name in ("level", "linear level")], axis=1)
    true, exact = true_roughness(case)[inside], level_3d(case.spectrum, case.bands)
    q, zeros = case.bands.centres[inside], case.zeros[inside]

    def found(some: FloatArray) -> FloatArray:
        """From the level over linear theory on the same surfaces, times that of the spectrum: little scatter."""
        level, linear = some.mean(axis=0)
        return roughness(case.bands, exact * level / linear, by)

    over_true = jackknifed(lambda some: np.log(np.maximum(found(some)[inside] / true, LEAST)), strips)
    along = partial(Series, model=by, along=Q, unit="dB", scale=POWER_DECIBEL)
    yield along(OVER_TRUE, found=over_true, at=q, where={HEIGHT: height})
    for bands, some in ((BETWEEN, ~zeros), (ZEROS, zeros)):
        if kept := np.flatnonzero(some).tolist():
            every = q.size * len(case.heights)
            yield along(
                LEVEL,
                found=[over_true[i] for i in kept],
                at=q[some],
                where={HEIGHT: height, "bands": bands},
                margin=NEAR,
                family=every / len(kept),
                rms_family=every,
            )
    share = jackknifed(lambda some: found(some)[below].sum() / true.sum(), strips)
    family = len(case.heights) * len(FILTERS)
    yield Series(BELOW, by, share, where={HEIGHT: height}, margin=LITTLE, family=family)
    known = strips[np.isfinite(strips).all(axis=(1, 2))]
    for model, height_in_band in ((by, found(known)[inside]), ("surface", true)):
        yield Series(FOUND, model, height_in_band, where={HEIGHT: height, "filter": by}, along=Q, at=q)


LEVELS = (LEVEL, "rms of " + LEVEL)
STUDY = Study(
    title="Roughness from force: the filters of linear theory read backwards",
    method=(
        "A wheel rolls at a fixed approach over {c.strips} surfaces of known roughness, H = {c.hurst:g}, "
        "q a = {c.first:g} to {c.last:g}, {c.length:g} a long, with {c.cells} cells to a radius. From "
        "the level of the force of boundary elements in one-third octaves, three filters read backwards give "
        "the mean square height of the waves in each: (14.14), the mean of (14.12); (14.12) itself, averaged over "
        "a band; and the filter in 3D, by the heights of all bands together that have these levels, none negative. "
        f"C_2D is assumed to fall as q^-{ASSUMED:g} within a band, which the force does not tell. Intervals are of "
        f"the sample; the error of the grid is that of the case rolling. {SLOPE_COUNTS}. On the half-space a "
        "wave that crosses the track at an angle appears at a longer wavelength along it; Geike's rule gives a "
        "track the force that waves of all directions have at one place."
    ),
    series=series,
    claims=(
        *(
            Claim(quantity=LEVELS, model=by, along=HEIGHT).saying(
                f"The roughness spectrum follows from the force spectrum by {by}, read backwards.",
                short=f"Roughness from force by {by}, in one-third octaves",
            )
            for by in (MEAN_FILTER, FILTER_1D)
        ),
        *(
            Claim(quantity=LEVELS, model=FILTER_3D, where={"bands": bands}, along=HEIGHT).saying(
                f"{where} of sin(q a) the roughness spectrum follows by the filter in 3D, read backwards.",
                short=f"Roughness from force by the filter in 3D, {bands}",
            )
            for where, bands in (("Between the zeros", BETWEEN), ("At the zeros", ZEROS))
        ),
        Claim(quantity=BELOW).saying(
            "Filters that are read backwards find no roughness below the band, where there is none."
        ),
    ),
    charts=(
        Chart("roughness_from_force", claims=(0, 2), sharey=True, height=3.6).of(
            "Mean square height of the waves in one-third octaves, found from the force of boundary elements over "
            "the true one, by filter; a panel a roughness. Shaded: within 3 dB; vertical lines: zeros of sin(q a). "
            "Bars: 95 %. -30 dB: nothing found.",
            Panel(
                Q,
                "roughness found over true [dB]",
                facet=HEIGHT,
                ylim=(-16.0, 10.0),
                shade=(-3.0, 3.0),
                at=tuple(math.pi * n for n in range(1, 10)),
            ).of(Curve(OVER_TRUE, by=("model",), bars=True)),
        ),
    ),
    printed=(SLOPE,),
)
CASE = Case(
    name="roughness_from_force",
    chapter=Chapter.ROLLING,
    place=5,
    answers='"and vice versa" after (14.14): the roughness spectrum from a measured force spectrum',
    quick=RoughnessFromForce(strips=3),
    full=RoughnessFromForce(
        heights=(0.01, 0.03, 0.1, 0.3), last=20.0, lowest=0.22, length=128.0, width=24.0, cells=14, strips=6
    ),
    run=run,
    study=STUDY,
    needs="linear filter, 3D",
)
