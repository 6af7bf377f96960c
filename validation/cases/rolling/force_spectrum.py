"""Rolling over isotropic roughness: the force along the track by boundary elements, springs and linear theory."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Map, Panel
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import Role
from validation.analysis.margins import THREE_DECIBELS
from validation.analysis.series import Estimates, Margin, Ranges, Series, masked
from validation.analysis.statistics import DECIBEL, POWER_DECIBEL, Estimate, mean_estimate, ratio_of_means
from validation.analysis.study import Outcomes, Study
from validation.cases.rolling.settings import HEIGHT, SLOPE, SLOPE_COUNTS, Q, SelfAffineSettings, slopes_of
from validation.engine.convergence import require_realisations
from validation.engine.engine import SERIAL, Engine
from validation.selection import model_needed
from validation.simulation import rolling_strip
from validation.simulation.rolling_strip import HERTZ, ROUNDING, level_1d, level_3d, strip_levels
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
    levels = {(name, h): strip_levels(one, 1 / grids[name], case.bands) for (name, h), one in strips.items()}
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
    0.1, "10 %: 0.4 dB of a variance", source="Geike's rule keeps the variance of the force at one position"
)
OF_MEAN = Margin(tolerance=0.02, reason="2 %: uncertainty of the load of a wheel", source="bem3d")
OF_WHOLE = Margin(
    DECIBEL * math.log(1.1),
    "10 %: 0.8 dB of the whole force, less than what is repeatable",
    source="bem3d, extrapolated, all over linear theory on the same roughness",
)
OF_LIMIT = Margin(
    0.5,
    "0.5 dB: the band is bounded and q a is finite",
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
    in_1d, in_3d = level_1d(case.spectrum, "geike", case.bands)[inside], level_3d(case.spectrum, case.bands)[inside]
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


LEVELS, CHANGES = (LEVEL, "rms of " + LEVEL), (NONLINEAR, "rms of " + NONLINEAR)
BY_HEIGHT = partial(Curve, by=(HEIGHT,))
up_to = partial(Claim, along=HEIGHT)
has_levels = partial(up_to, quantity=LEVELS)
of_bands = partial(Matrix, rows=(HEIGHT, Q), columns="model")
STUDY = Study(
    title="Rolling over isotropic roughness: levels of 1D models against boundary elements",
    method=(
        "A wheel rolls at a fixed approach d over self-affine roughness, H = {c.hurst:g}, q a = {c.first:g} to "
        "{c.last:g}, h_rms / d = {c.heights:g}. Boundary elements: {c.strips} surfaces {c.length:g} a long "
        "({c.rough_strips} from h/d = 0.3 on), {c.cells} cells to a contact radius; {c.refined} of them again with "
        "twice as many. Levels are extrapolated to first order; ± grid is half of the extrapolation, plus its sampling "
        "interval. Springs: {c.tracks} tracks as long, with Geike's spectrum, and with the rolling-equivalent "
        "spectrum, which has the level of linear theory in 3D along the track (case rolling_input). Linear theory: "
        "(14.12) in 1D, and the same filter on the surface in 3D, both by quadrature. Levels of the force in one-third "
        "octaves of q a are powers, in dB. Boundary elements are taken over linear theory on the same surfaces, which "
        "removes most of the scatter. A range of bands is judged by its worst one-third octave, within 3 dB, and by "
        "the root mean square over its bands, within 1 dB. Errors of both signs do not cancel in either. "
        + SLOPE_COUNTS
        + "; √2 times that is the rms gradient g of the surface, and the rms slope of Geike's profile."
    ),
    series=series,
    claims=(
        has_levels(model=(LINEAR_1D + OVER, SPRINGS + OVER)).saying(
            "Springs with Geike's spectrum have the force spectrum of a wheel that rolls over isotropic roughness "
            "(Fig. 14.3).",
            short="Springs with Geike's spectrum, level over boundary elements",
        ),
        has_levels(model=ROLLING_SPRINGS + OVER).saying(
            "With the rolling-equivalent spectrum, springs have the level of boundary elements in each one-third "
            "octave."
        ),
        has_levels(model=LINEAR_3D + OVER).saying(
            "Linear theory in 3D has the level of boundary elements in each one-third octave.",
            short="Linear theory in 3D, level over boundary elements",
        ),
        up_to(quantity=CHANGES).saying(
            "Nonlinearity changes the level of springs as it changes that of boundary elements.",
            short="Nonlinearity, springs beside boundary elements",
        ),
        up_to(quantity=VARIANCE).saying(
            "The force at one position has the variance of linear theory, which Geike's rule keeps."
        ),
        up_to(says="Springs have the mean force of boundary elements.", quantity=MEAN),
    ),
    charts=(
        Chart("rolling-line", claims=(), width=6.4).of(
            "Fig. 14.3, H = {c.hurst:g}: spectrum of the normal force over wavenumber. Line: (14.12); dashed: its mean "
            "(14.14); dots: one-sided springs at h/d = {c.heights[0]:g}; thick grey: linear theory in 3D.",
            Panel(Q, "C_F / (F_Hertz² a (h/d)²)", log="xy", decades=7.8, legend="lower left").of(
                Curve(SPECTRUM, LINEAR_3D, "thick", "linear theory, 3D"),
                Curve(SPECTRUM, SPRINGS, "dots", "springs"),
                Curve(SPECTRUM, "(14.12)", "exact", "(14.12)"),
                Curve(SPECTRUM, "(14.14)", "other", "(14.14)"),
            ),
        ),
        Chart("rolling", columns=3, sharey=True, width=9.0, height=5.8).of(
            "Level of the force in one-third octaves, over (h/d)² and the square of Hertz's force. Circles: boundary "
            "elements, 95 % of sample and grid; squares: one-sided springs, Geike's spectrum; solid: linear theory in "
            "3D; dashed: (14.12), which is zero below the band, left of the vertical line.",
            Panel(Q, "one-third octave level [dB]", facet=HEIGHT, ylim=(-66.0, -2.0), at=(1.0,)).of(
                Curve(SHOWN, LINEAR_3D, "exact", "linear theory, 3D"),
                Curve(SHOWN, LINEAR_1D, "other", "linear theory, 1D (14.12)"),
                Curve(SHOWN, SPRINGS, "mdr", "springs"),
                Curve(SHOWN, "bem3d", "bem", "boundary elements", bars=True),
            ),
        ),
        Chart("rolling-coherence", claims=(3,)).of(
            "(a) Coherence with linear theory: filled, boundary elements; open, springs. (b) Nonlinear over linear "
            "level. Dark to light: h/d. (c) Force along the track at three h/d, about its mean: line, boundary "
            "elements; dotted, linear theory.",
            Panel(Q, "coherence", title="with linear theory", ylim=(-0.03, 1.05)).of(
                BY_HEIGHT(COHERENCE, "bem3d"), BY_HEIGHT(COHERENCE, SPRINGS, "open", "_")
            ),
            Panel(Q, "nonlinear over linear [dB]", title="level").of(
                BY_HEIGHT(NONLINEAR, "bem3d", label="_"), BY_HEIGHT(NONLINEAR, BOTH, "open", "_")
            ),
            Panel("x / a", "(F - mean) / (F_Hertz h/d), shifted", title="force along the track", log="").of(
                BY_HEIGHT(FORCE, "bem3d", "lines", "_", down=3.2), BY_HEIGHT(FORCE, LINEAR_3D, "dotted", "_", down=3.2)
            ),
        ),
        Chart("rolling-map", claims=(2,)).of(
            "Level of each model over that of boundary elements, over q a and h/d. Solid lines: ± 1 dB; dashed: ± 3 "
            "dB; hatched: more than 3 dB too low. Left of the vertical line: below the band.",
            over=Map(LEVEL, Q, HEIGHT, "model", "level over boundary elements [dB]", at=(1.0,)),
        ),
    ),
    matrices=(
        of_bands(name="worst one-third octave over boundary elements", quantity=LEVEL),
        of_bands(name="root mean square over the bands", quantity="rms of " + LEVEL),
    ),
    printed=(SLOPE, CORRELATION, VARIANCE, MEAN, APPLICATIONS),
)
CASE = Case(
    name="rolling",
    chapter=Chapter.ROLLING,
    place=2,
    answers="Fig. 14.3: rolling force over isotropic roughness, where each model holds",
    quick=ForceSpectrum(
        heights=(0.01, 0.3, 1.0),
        last=5.7,
        lowest=0.55,
        length=48.0,
        cells=6,
        strips=8,
        rough_strips=3,
        refined=8,
        tracks=40,
    ),
    full=ForceSpectrum(
        heights=(0.003, 0.01, 0.03, 0.1, 0.3, 1.0),
        last=20.0,
        lowest=0.22,
        length=256.0,
        width=32.0,
        cells=16,
        strips=6,
        rough_strips=8,
        refined=4,
        tracks=400,
    ),
    run=run,
    study=STUDY,
    needs=model_needed.rolling,
)
