"""What rolling over isotropic roughness shows: its numbers and tables in sentences, and the case of the report."""

from collections.abc import Sequence

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, number_with, numbers_with, with_reference
from validation.analysis.wording import farthest_off
from validation.cases.rolling import force_spectrum_levels as levels
from validation.cases.rolling import force_spectrum_numbers as measured
from validation.cases.rolling import force_spectrum_tables as tables
from validation.cases.rolling.claims import SLOPE_COUNTS, answered_up_to, from_to, height_of
from validation.cases.rolling.force_spectrum import ROUGH, ForceSpectrum, RollingResult, run
from validation.cases.rolling.force_spectrum_headlines import LINEAR_CLAIM, finding, headlines
from validation.selection import model_needed

CLAIM = (
    "Springs with Geike's spectrum have the force spectrum of a wheel that rolls over isotropic roughness (Fig. 14.3)."
)


def evidence(result: RollingResult) -> Evidence:
    """Levels in one-third octaves and in regions of them; coherence, variance, mean; the map of validity."""
    case = result.case
    found = [levels.LevelsAtHeight(result, height) for height in case.heights]
    numbers, within, summary = measured.numbers_of(case, found), tables.bands_within(case, found), tables.summary(found)
    judged, shown, spectrum = tables.judged_levels(found, numbers), tables.levels(found), tables.spectrum(result)
    claims = _claims(case, found, numbers)
    return Evidence(
        title="Rolling over isotropic roughness: levels of 1D models against boundary elements",
        method=_method(case),
        numbers=tuple(numbers),
        tables=(shown, summary, spectrum, tables.forces(result)),
        conclusions=(_excess(numbers),),
        claims=claims,
        finding=finding(case, numbers, claims),
        headlines=headlines(case, numbers, claims, spectrum, shown),
        captions=_captions(case),
        unconverged=result.unconverged,
        page_tables=(judged, within, summary),
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
        "scatter. A range of bands is judged by its worst one-third octave, within 3 dB, and by the root mean square "
        "over its bands, within 1 dB. Errors of both signs cancel in the mean, which stands beside them and is not "
        f"judged. {SLOPE_COUNTS}; √2 times that is the rms gradient g of the surface, and the rms slope of Geike's "
        "profile."
    )


def _claims(case: ForceSpectrum, found: list[levels.LevelsAtHeight], numbers: list[Number]) -> tuple[JudgedClaim, ...]:
    """Of the book and of what follows from it, each with the numbers that test it."""
    slope = case.spectrum.slope_along
    means, variances = (numbers_with(numbers, quantity) for quantity in (measured.MEAN, measured.VARIANCE))
    return (
        *_claims_of_levels(case, found, numbers),
        answered_up_to(
            "The force at one position has the variance of linear theory, which Geike's rule keeps.",
            variances,
            f"{_variances(variances)}.",
            slope=slope,
        ),
        answered_up_to("Springs have the mean force of boundary elements.", means, f"{_means(means)}.", slope=slope),
    )


def _claims_of_levels(
    case: ForceSpectrum, found: list[levels.LevelsAtHeight], numbers: list[Number]
) -> list[JudgedClaim]:
    """By the worst one-third octave and by the root mean square; the signed mean is only told."""
    below, *_, band = measured.regions(case)
    lowest, ends = found[0], [found[0], *found[1:][-1:]]

    def of(*models: str) -> list[Number]:
        over = [number for model in models for number in numbers_with(numbers, model=f"{model} over bem3d")]
        return [number for number in over if number.quantity not in (measured.EXCESS, measured.RMS_FORCE)]

    def mean(model: str, region: levels.Region) -> str:
        return f"{from_to([mine.decibels_over_bem(model, mine.weights(region)) for mine in found])} dB"

    def at(model: str, mine: levels.LevelsAtHeight) -> str:
        where, over = measured.place(mine.height, band), f"{model} over bem3d"
        worst, rms = (number_with(numbers, name, over, **where) for name in (measured.LEVEL, measured.IN_RMS))
        worst_at = f"the worst band {worst.value:+.1f} dB off, at q a = {worst.where['worst at']:.2g}"
        return f"at h' a/d = {mine.slope:.2g} the rms over bands is {rms.value:.1f} dB and {worst_at}"

    geike, equivalent, linear = levels.SPRINGS, levels.ROLLING_SPRINGS, levels.LINEAR_3D
    nonlinear = [number for number in numbers if number.quantity in (measured.NONLINEAR, measured.RMS_NONLINEAR)]
    changes = "; ".join(
        f"at h/d = {height_of(n):g} the changes differ by {n.value:.1f} dB in the rms over bands"
        for n in numbers_with(nonlinear, measured.RMS_NONLINEAR)
        if height_of(n) in {mine.height for mine in ends}
    )
    tested = {
        CLAIM: (
            of(levels.LINEAR_1D, geike),
            f"springs are {mean(geike, band)} off boundary elements in the mean over the bands of q a = "
            f"{_named(band)} and {mean(geike, below)} in those below; {at(geike, lowest)}",
        ),
        "With the rolling-equivalent spectrum, springs have the level of boundary elements in each one-third octave.": (
            of(equivalent),
            f"the mean over the bands of q a = {_named(band)} is {mean(equivalent, band)} off, but "
            f"{at(equivalent, lowest)}",
        ),
        LINEAR_CLAIM: (
            of(linear),
            "; ".join(at(linear, mine) for mine in ends),
        ),
        "Nonlinearity changes the level of springs as it changes that of boundary elements.": (nonlinear, changes),
    }
    return [
        answered_up_to(claim, mine, f"{answer}.", slope=case.spectrum.slope_along)
        for claim, (mine, answer) in tested.items()
    ]


def _excess(numbers: list[Number]) -> str:
    excess = number_with(numbers, measured.EXCESS)
    return (
        f"By linear theory Geike's spectrum is too loud in the mean over one-third octaves, {excess.conditions}: "
        f"{with_reference(excess)}; the reference is the limit for q a >> 1."
    )


def _named(region: levels.Region) -> str:
    return f"{region[0]:g} to {region[1]:g}"


def _variances(variances: Sequence[Number]) -> str:
    """The farthest of each model."""
    worst = [farthest_off(numbers_with(variances, model=model)) for model in dict.fromkeys(n.model for n in variances)]
    return "farthest are " + ", ".join(
        f"{n.model} {n.value:.3f} ± {n.uncertainty:.3f} at h/d = {height_of(n):g} ({n.verdict})" for n in worst
    )


def _means(means: Sequence[Number]) -> str:
    """The farthest height."""
    n = farthest_off(means)
    return (
        f"farthest, at h/d = {height_of(n):g}, springs have {n.value:.3f} and boundary elements {n.reference:.3f} of "
        f"Hertz's ({n.verdict})"
    )


def _captions(case: ForceSpectrum) -> dict[str, str]:
    return {
        "rolling-line": (
            f"Fig. 14.3, H = {case.hurst:g}: spectrum of the normal force over wavenumber. Line: (14.12); dashed: its "
            f"mean (14.14); dots: one-sided springs at h/d = {case.heights[0]:g}; thick grey: linear theory in 3D."
        ),
        "rolling": (
            "Level of the force in one-third octaves, over (h/d)² and the square of Hertz's force. Circles: boundary "
            "elements, 95 % of sample and grid; squares: one-sided springs, Geike's spectrum; solid: linear theory in "
            "3D; dashed: (14.12), which is zero below the band (shaded)."
        ),
        "rolling-coherence": (
            "(a) Coherence with linear theory: filled, boundary elements; open, springs. (b) Nonlinear over linear "
            "level. Dark to light: h/d. (c) Force along the track at three h/d, about its mean: line, boundary "
            "elements; dotted, linear theory."
        ),
        "rolling-map": (
            "Level of each model over that of boundary elements, over q a and h/d; right axis: h' a/d along the track. "
            "Solid lines: ± 1 dB; dashed: ± 3 dB; hatched: more than 3 dB too low. Left of the vertical line: below "
            "the band."
        ),
    }


CASE = Case(
    name="rolling",
    chapter=Chapter.ROLLING,
    place=2,
    claim=CLAIM,
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
    evidence=evidence,
    needs=model_needed.rolling,
)
