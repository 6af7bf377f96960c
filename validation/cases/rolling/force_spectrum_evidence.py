"""What rolling over isotropic roughness shows: its numbers and tables in sentences, and the case of the report."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Place, Verdict, number_with, numbers_with
from validation.analysis.statistics import POWER_DECIBEL
from validation.cases.rolling import force_spectrum_levels as levels
from validation.cases.rolling import force_spectrum_numbers as measured
from validation.cases.rolling import force_spectrum_tables as tables
from validation.cases.rolling.force_spectrum import ROUGH, ForceSpectrum, RollingResult, run
from validation.selection import model_needed


def evidence(result: RollingResult) -> Evidence:
    """Levels in one-third octaves and in regions of them; coherence, variance, mean; the map of validity."""
    case = result.case
    found = [levels.LevelsAtHeight(result, height) for height in case.heights]
    numbers, within, summary = measured.numbers_of(case, found), tables.bands_within(case, found), tables.summary(found)
    return Evidence(
        title="Rolling over isotropic roughness: levels of 1D models against boundary elements",
        method=_method(case),
        numbers=tuple(numbers),
        tables=(tables.levels(found), summary, tables.spectrum(result), tables.forces(result)),
        conclusions=tuple(_conclusions(case, found, numbers)),
        captions=_captions(case),
        unconverged=result.unconverged,
        page_tables=(within, summary),
    )


def _method(case: ForceSpectrum) -> str:
    return (
        f"A wheel rolls at a fixed approach d over self-affine roughness, H = {case.hurst:g}, q a = {case.first:g} to "
        f"{case.last:g}, h_rms / d = {', '.join(f'{h:g}' for h in case.heights)}. Boundary elements: {case.strips} "
        f"surfaces {case.length:g} a long ({case.rough_strips} from h/d = {ROUGH:g} on), {case.cells} cells to a "
        f"contact radius; {case.refined} of them again with {2 * case.cells}. Levels are extrapolated to first order; "
        "± grid is half of the extrapolation, plus its sampling interval. Springs: "
        f"{case.tracks} tracks as long, with Geike's spectrum, and with the rolling-equivalent spectrum, which has the "
        "level of linear theory in 3D along the track (case rolling_input). Linear theory: (14.12) in 1D, and the same "
        "filter on the surface in 3D, both by quadrature. Levels of the force in one-third octaves of q a are powers, "
        "in dB. Boundary elements are taken over linear theory on the same surfaces, which removes most of the "
        "scatter. The mean over the bands of a region is resampled as one number. Errors of single bands, as at the "
        "zeros of sin(q a), may cancel in it: the first table below and the map show them."
    )


def _conclusions(case: ForceSpectrum, found: list[levels.LevelsAtHeight], numbers: list[Number]) -> list[str]:
    def level(model: str, region: levels.Region, height: float) -> str:
        return _signed(number_with(numbers, measured.LEVEL, f"{model} over bem3d", **measured.place(height, region)))

    def both_springs(region: levels.Region, height: float) -> str:
        return f"{level(levels.SPRINGS, region, height)} and {level(levels.ROLLING_SPRINGS, region, height)}"

    def nonlinear(region: levels.Region, height: float) -> str:
        n = number_with(numbers, measured.NONLINEAR, measured.BOTH, **measured.place(height, region))
        return f"{n.value:+.1f} and {n.reference:+.1f} dB ({n.verdict})"

    def sentence(what: str, region: levels.Region, said: Callable[[levels.Region, float], str]) -> str:
        return _by_height(f"{what}, {_named(region)}", [(height, said(region, height)) for height in case.heights])

    below, *inside = measured.regions(case)
    springs = "Springs over boundary elements, with Geike's spectrum and with the rolling-equivalent spectrum"
    change = "Level of the nonlinear over the linear force, of springs and of boundary elements"
    return [
        *(_holds(model, case.heights, numbers, [below, *inside]) for model in levels.MODELS),
        *(
            sentence("Linear theory in 3D over boundary elements", region, partial(level, levels.LINEAR_3D))
            for region in (below, *inside)
        ),
        *(sentence(springs, region, both_springs) for region in inside),
        *(sentence(change, region, nonlinear) for region in inside),
        "Linear theory fails position by position at a lower roughness than in its level. "
        + _by_height(
            "Bands in which boundary elements have a coherence of 0.9 and more with it, and correlation over all bands",
            [(mine.height, _coherent(mine)) for mine in found],
        ),
        _variances(numbers),
        _means(numbers),
        _by_height(
            "Standard error of the sample in single one-third octaves of boundary elements, largest",
            [(mine.height, _scatter(mine)) for mine in found],
        ),
    ]


def _named(region: levels.Region) -> str:
    return f"q a = {region[0]:g} to {region[1]:g}"


def _signed(number: Number) -> str:
    return f"{number.value:+.1f} ± {number.uncertainty:.1f} dB ({number.verdict})"


def _holds(model: str, heights: Sequence[float], numbers: Sequence[Number], where: Sequence[levels.Region]) -> str:
    """Up to which height a model is within 1 dB of boundary elements, in the mean over each region."""
    parts = []
    for region in where:
        last = "at no height"
        for height in heights:
            mine = numbers_with(numbers, measured.LEVEL, f"{model} over bem3d", **measured.place(height, region))
            if [number.verdict for number in mine] != [Verdict.AGREE]:
                break
            last = f"up to h/d = {height:g}"
        parts.append(f"{_named(region)}: {last}")
    return (
        f'Within {measured.ONE_DECIBEL:g} dB of boundary elements in the mean over bands, the model "{model}": '
        f"{'; '.join(parts)}."
    )


def _by_height(what: str, found: Sequence[tuple[Place, str]]) -> str:
    return f"{what}, by h/d: {'; '.join(f'{height:g}: {text}' for height, text in found)}."


def _coherent(mine: levels.LevelsAtHeight) -> str:
    """Whether the force is that of linear theory position by position, not only in its level."""
    bands = np.count_nonzero(levels.coherence(mine.bem) >= 0.9)
    return f"{bands} of {len(mine.single_bands)} bands, correlation {levels.correlation(mine.bem)[0]:.3f}"


def _variances(numbers: Sequence[Number]) -> str:
    found = [
        (n.where["h/d"], f"{n.model} {n.value:.3f} ± {n.uncertainty:.3f} ({n.verdict})")
        for n in numbers_with(numbers, measured.VARIANCE)
    ]
    return _by_height("Variance of the force over that of linear theory", found)


def _means(numbers: Sequence[Number]) -> str:
    mine = numbers_with(numbers, measured.MEAN)
    found = [(n.where["h/d"], f"{n.value:.3f} and {n.reference:.3f} ({n.verdict})") for n in mine]
    agree = sum(n.verdict is Verdict.AGREE for n in mine)
    return (
        _by_height("Mean force over that of Hertz at the same approach, springs and boundary elements", found)
        + f" They agree within 2 % at {agree} of {len(mine)} heights."
    )


def _scatter(mine: levels.LevelsAtHeight) -> str:
    errors = [POWER_DECIBEL * mine.bem_level(weights)[0].error for weights in mine.single_bands]
    return f"{max(errors):.2f} dB, median {float(np.median(errors)):.2f} dB"


def _captions(case: ForceSpectrum) -> dict[str, str]:
    return {
        "rolling-line": (
            f"Fig. 14.3 of the book, H = {case.hurst:g}: spectrum of the normal force over wavenumber. Line: (14.12); "
            f"dashed: its mean (14.14); dots: one-sided springs, mean of {case.tracks} tracks at h/d = "
            f"{case.heights[0]:g}; thick grey: linear theory in 3D of the isotropic surface, in which the zeros are "
            "filled."
        ),
        "rolling": (
            "Level of the force in one-third octaves, over (h/d)² and the square of Hertz's force. Circles: boundary "
            "elements with 95 % intervals of sample and grid; squares: one-sided springs with Geike's spectrum; solid "
            "line: linear theory in 3D; dashed: linear theory in 1D, (14.12), which is zero below the band (shaded)."
        ),
        "rolling-coherence": (
            "(a) Coherence of the force with linear theory on the same roughness: filled, boundary elements; open, "
            "springs. (b) Change of the level by nonlinearity: boundary elements over linear theory in 3D (filled), "
            "springs over (14.12) (open). Dark to light: h/d. (c) Force along a part of one strip at the lowest, a "
            "middle and the largest h/d, about its mean, in units of h/d: line, boundary elements; dotted, linear "
            "theory."
        ),
        "rolling-map": (
            "Validity: level of each model over that of boundary elements, in dB, over h/d and q a. Solid lines: ± 1 "
            "dB; dashed: ± 3 dB; hatched: more than 3 dB too low. Left of the vertical line, below the band, springs "
            "with Geike's spectrum have almost no power."
        ),
    }


CASE = Case(
    name="rolling",
    chapter=Chapter.ROLLING,
    place=2,
    claim="A one-dimensional model has the force spectrum of a rolling wheel (Fig. 14.3).",
    answers="Fig. 14.3: rolling force over isotropic roughness, where each model holds",
    quick=ForceSpectrum(),
    full=ForceSpectrum(
        heights=(0.003, 0.01, 0.03, 0.1, 0.3, 1.0),
        last=20.0,
        lowest=0.22,
        length=256.0,
        width=32.0,
        cells=16,
        strips=6,
        rough_strips=8,
        refined=3,
        tracks=400,
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.rolling,
)
