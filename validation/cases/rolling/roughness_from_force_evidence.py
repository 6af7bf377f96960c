"""What filters read backwards find of a known roughness: numbers, tables, sentences, and the case of the report."""

from collections.abc import Sequence

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.difference import difference
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Place, Role, Table, numbers_with, table_of
from validation.analysis.over_range import root_mean_square, signed_mean, worst
from validation.analysis.statistics import POWER_DECIBEL
from validation.analysis.wording import in_a_word, sentence
from validation.cases.rolling.claims import SLOPE_COUNTS, answered_up_to, from_to
from validation.cases.rolling.force_spectrum_numbers import (
    FORD_THOMPSON,
    ONE_DECIBEL,
    REPEATABLE,
    RMS,
    THREE_DECIBELS,
)
from validation.cases.rolling.roughness_from_force import (
    ASSUMED,
    FILTER_1D,
    FILTER_3D,
    FILTERS,
    MEAN_FILTER,
    RoughnessFromForce,
    RoughnessFromForceResult,
    below_the_band,
    force_levels,
    recovered,
    roughness,
    run,
    true_roughness,
)

LEVEL, BELOW = "roughness found in a one-third octave", "roughness found below the band"
BETWEEN, ZEROS = "between zeros of sin(q a)", "at zeros of sin(q a)"
CLAIM = "The roughness spectrum follows from the force spectrum by (14.14), read backwards."


def evidence(result: RoughnessFromForceResult) -> Evidence:
    """Found over true roughness by each filter, in bands with a zero of the filter and in others; below the band."""
    case = result.case
    points = {(h, by): _points(result, h, by) for h in case.heights for by in FILTERS}
    numbers = [number for found in points.values() for number in _judged(found)]
    numbers += [_below(result, height, by) for height in case.heights for by in FILTERS]
    table = _table(result, points)
    claims = _claims(case, numbers, points)
    return Evidence(
        title="Roughness from force: the filters of linear theory read backwards",
        method=(
            f"A wheel rolls at a fixed approach over {case.strips} surfaces of known roughness, H = {case.hurst:g}, "
            f"q a = {case.first:g} to {case.last:g}, {case.length:g} a long, with {case.cells} cells to a radius. From "
            "the level of the force of boundary elements in one-third octaves, three filters read backwards give "
            "the mean square height of the waves in each: (14.14), the mean of (14.12); (14.12) itself, averaged over "
            "a band; and the filter in 3D, by the heights of all bands together that have these levels, none negative. "
            f"C_2D is assumed to fall as q^-{ASSUMED:g} within a band, which the force does not tell. Intervals are of "
            f"the sample; the error of the grid is that of the case rolling. {SLOPE_COUNTS}. On the half-space a "
            "wave that crosses the track at an angle appears at a longer wavelength along it; Geike's rule gives a "
            "track the force that waves of all directions have at one place."
        ),
        numbers=tuple(numbers),
        tables=(table,),
        conclusions=(),
        claims=claims,
        finding=finding(claims),
        headlines={"roughness_from_force": headline(claims)},
        captions={
            "roughness_from_force": (
                "Mean square height of the waves in one-third octaves, found from the force of boundary elements over "
                "the true one, by filter; a panel a roughness. Shaded: within 3 dB; vertical lines: zeros of sin(q a). "
                "Bars: 95 %. -30 dB: nothing found."
            )
        },
        unconverged=result.unconverged,
    )


def _points(result: RoughnessFromForceResult, height: float, by: str) -> list[Number]:
    """Each band inside, with intervals that hold at once for all heights."""
    case = result.case
    where = zip(case.bands.centres[case.inside], case.zeros[case.inside], strict=True)
    found = recovered(case, result.levels[height], by)
    return [
        difference(
            estimate,
            quantity=LEVEL,
            model=by,
            where={"h/d": height, "bands": ZEROS if zero else BETWEEN, "q a": float(q)},
            source="the surface itself",
            tolerance=THREE_DECIBELS,
            reason=FORD_THOMPSON,
            among=len(found) * len(case.heights),
        )
        for estimate, (q, zero) in zip(found, where, strict=True)
    ]


def _judged(points: list[Number]) -> list[Number]:
    """Worst band and root mean square, of the bands with a zero of the filter and of those between."""
    numbers = []
    for kind in (BETWEEN, ZEROS):
        mine = numbers_with(points, bands=kind)
        if mine:
            numbers += [worst(mine, "q a"), root_mean_square(mine, "q a", ONE_DECIBEL, REPEATABLE)]
    return numbers


def _below(result: RoughnessFromForceResult, height: float, by: str) -> Number:
    estimate = below_the_band(result.case, result.levels[height], by)
    return Number(
        quantity=BELOW,
        model=by,
        where={"h/d": height},
        value=estimate.value,
        reference=0.0,
        source="the surface itself, over the mean square of its whole height",
        tolerance=0.05,
        reason="5 %: 0.2 dB of the mean square height",
        sample=estimate.half_width_among(len(result.case.heights) * len(FILTERS)),
        role=Role.FINDING,
    )


def _claims(
    case: RoughnessFromForce, numbers: list[Number], points: dict[tuple[float, str], list[Number]]
) -> tuple[JudgedClaim, ...]:
    slope = case.spectrum.slope_along

    def of(by: str, **where: Place) -> list[Number]:
        return [number for number in numbers_with(numbers, None, by, **where) if number.quantity != BELOW]

    def text(by: str, kind: str) -> str:
        parts = []
        for height in case.heights:
            place: dict[str, Place] = {"h/d": height, "bands": kind}
            (rms,) = numbers_with(numbers, RMS + LEVEL, by, **place)
            mean = signed_mean(numbers_with(points[height, by], bands=kind))
            parts.append(f"mean {mean:+.1f}, rms {rms.value:.1f} dB at h' a/d = {slope * height:.2g}")
        return f"{kind} {'; '.join(parts)}"

    below = [number for number in numbers if number.quantity == BELOW]
    return (
        answered_up_to(CLAIM, of(MEAN_FILTER), f"{text(MEAN_FILTER, BETWEEN)}.", slope=slope),
        answered_up_to(
            "The roughness spectrum follows from the force spectrum by (14.12), read backwards.",
            of(FILTER_1D),
            f"{text(FILTER_1D, BETWEEN)}.",
            slope=slope,
        ),
        answered_up_to(
            "Between the zeros of sin(q a) the roughness spectrum follows by the filter in 3D, read backwards.",
            of(FILTER_3D, bands=BETWEEN),
            f"{text(FILTER_3D, BETWEEN)}.",
            slope=slope,
        ),
        answered_up_to(
            "At the zeros of sin(q a) the roughness spectrum follows by the filter in 3D, read backwards.",
            of(FILTER_3D, bands=ZEROS),
            f"{text(FILTER_3D, ZEROS)}.",
            slope=slope,
        ),
        answered(
            "Filters that are read backwards find no roughness below the band, where there is none.",
            below,
            "; ".join(
                f"{by} finds {from_to([100 * n.value for n in numbers_with(below, model=by)])} %" for by in FILTERS
            )
            + " of the mean square height there.",
        ),
    )


def headline(claims: Sequence[JudgedClaim]) -> str:
    return f"Roughness from force: by (14.14) {in_a_word(claims[0])}, by the filter in 3D {in_a_word(claims[2])}"


def finding(claims: Sequence[JudgedClaim]) -> str:
    return sentence(f"{headline(claims)} between zeros of sin(q a), {in_a_word(claims[3])} at them")


def _table(result: RoughnessFromForceResult, points: dict[tuple[float, str], list[Number]]) -> Table:
    """A row a height, filter and band inside: found over true roughness [dB], both over h_rms^2."""
    case, rows = result.case, []
    true = true_roughness(case)[case.inside]
    for (height, by), found in points.items():
        levels, _ = force_levels(case, result.levels[height])
        values = roughness(case.bands, levels, by)[case.inside]
        for number, estimate, own, value in zip(
            found, recovered(case, result.levels[height], by), true, values, strict=True
        ):
            rows.append(
                {
                    "h/d": height,
                    "h' a/d": float(f"{height * case.spectrum.slope_along:.3g}"),
                    "filter": by,
                    "q a": number.where["q a"],
                    "zero of sin(q a)": number.where["bands"] == ZEROS,
                    "true": float(own),
                    "found": float(value),
                    "found over true [dB]": POWER_DECIBEL * estimate.value,
                    "± [dB]": POWER_DECIBEL * estimate.half_width,
                }
            )
    return table_of("roughness", rows)


CASE = Case(
    name="roughness_from_force",
    chapter=Chapter.ROLLING,
    place=5,
    claim=CLAIM,
    answers='"and vice versa" after (14.14): the roughness spectrum from a measured force spectrum',
    quick=RoughnessFromForce(strips=3),
    full=RoughnessFromForce(
        heights=(0.01, 0.03, 0.1, 0.3), last=20.0, lowest=0.22, length=128.0, width=24.0, cells=14, strips=6
    ),
    run=run,
    evidence=evidence,
    needs="linear filter, 3D",
)
