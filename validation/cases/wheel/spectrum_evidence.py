"""Fig. 14.4: the regions of the spectrum and what moves them, in words."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, Verdict, with_reference
from validation.analysis.over_range import root_mean_square, signed_mean, worst
from validation.analysis.wording import by_status, sentence, share, title
from validation.cases.wheel import spectrum_tables as tables
from validation.cases.wheel.contrast import period_range, worst_contrast
from validation.cases.wheel.features import BREAK, FLOOR, JUMP, PEAK, PEAK_LAST, PERIOD, PREDICTED, SLOPE, Spectrum
from validation.cases.wheel.spectrum import TABLE, WheelResult, WheelSpectrum, run
from validation.cases.wheel.spectrum_numbers import (
    FEATURES,
    IDENTITIES,
    OF_FIGURE,
    OMEGA,
    contrasts_beside_linear,
    feature_numbers,
    identities,
    levels_over_linear,
    worst_scene,
)
from validation.engine.engine import Outcome
from validation.scenes.dynamic_wheel import WheelScene
from validation.selection import model_needed
from validation.simulation.wheel_on_springs import WAVES_APART

CLAIM = "On springs the peak and the regions of Fig. 14.4 lie where theory has them; region 3 has its level and slope."
PERIOD_IS_CONSTANT = "Region 3 oscillates with the constant period π v₀ / a."
DOWN_TO_ZEROS = "Region 3 oscillates as sin²(q a), down to its zeros."
MOVED = {
    PEAK: "The frequency of the peak depends on none of q_min, q_max, v₀, H and h₀, only on the contact.",
    JUMP: "Region 3 begins at q_min v₀, whatever the speed and the cut-off.",
    SLOPE: "The slope of region 3 is -2 H - 3, whatever the parameters.",
    BREAK + PREDICTED: "The break lies where region 3 meets the predicted floor, whatever the parameters.",
}
"""Claims about one parameter changed at a time."""
Features = dict[str, Number]


def evidence(result: WheelResult) -> Evidence:
    """Features beside theory for the scene and for each variation; balance of forces and Parseval as identities."""
    case = result.case
    spectra = {name: Spectrum.of(varied, result.batches[name]) for name, varied in case.variations().items()}
    base = case.scene.name
    mine = feature_numbers(base, spectra[base], among=OF_FIGURE)
    varied = {n: feature_numbers(n, s, among=len(spectra) - 1) for n, s in spectra.items() if n != base}
    levels, contrasts = levels_over_linear(spectra[base]), contrasts_beside_linear(spectra[base])
    ranges = _over_ranges(levels, contrasts)
    moved = _over_scenes(varied)
    found = {key: number for key, number in mine.items() if number.role is not Role.IDENTITY}
    batches = [batch for group in result.batches.values() for batch in group]
    shown = (
        tables.shown_scene(case.scene),
        tables.shown_regions(mine),
        *([tables.shown_contrasts(case.scene, contrasts)] if contrasts else []),
        *([tables.shown_parameters({base: mine, **varied})] if varied else []),
    )
    claims, captions = _claims(found, ranges, moved, levels, case.scene), _captions(case)
    drawn = tables.tables_of(result, spectra)
    return Evidence(
        title="Fig. 14.4: the acceleration of a rolling wheel, on springs",
        method=_method(case.scene, spectra[base]),
        numbers=(*identities(batches), *found.values(), *ranges.values(), *moved.values()),
        tables=drawn,
        page_tables=shown,
        claims=claims,
        finding=finding(claims),
        headlines={name: text for name, text in (_touching(drawn) | headlines(claims)).items() if name in captions},
        conclusions=(
            *_hidden(case.scene),
            *conclusions(mine),
            _flight(result.batches[base]),
            *filter(None, (case.scene.no_steady_answer(), *case.scene.diagnose())),
        ),
        captions=captions,
    )


def _over_ranges(levels: Sequence[Number], contrasts: list[Number]) -> Features:
    """The worst band, and the root mean square over bands, of the level of region 3; the worst contrast."""
    found = {}
    if levels:
        found["worst level"] = worst(levels, OMEGA)
        found["level"] = root_mean_square(levels, OMEGA, levels[0].tolerance, levels[0].reason)
    return found | ({"contrast": worst_contrast(contrasts)} if contrasts else {})


def _over_scenes(varied: Mapping[str, Features]) -> Features:
    """Of each feature the scene, with one parameter changed, whose verdict is that of all."""
    numbers = {key: [one[key] for one in varied.values() if key in one] for key in FEATURES if key not in IDENTITIES}
    return {key: worst_scene(some) for key, some in numbers.items() if some}


def _claims(
    mine: Features, ranges: Features, moved: Features, levels: Sequence[Number], scene: WheelScene
) -> tuple[JudgedClaim, ...]:
    """The claim of the figure, and what the chapter says of the oscillation and of the parameters."""

    def beside(number: Number) -> str:
        return f"{number.value:.5g} beside {number.reference:.5g}"

    names = {
        PEAK: "the peak lies at {} rad/s",
        JUMP: "region 3 begins at {} rad/s",
        SLOPE: "its slope is {}",
        BREAK + PREDICTED: "the break over predicted is {}",
    }
    parts = [text.format(beside(mine[key])) for key, text in names.items() if key in mine]
    if levels:
        parts.append(
            f"the level of region 3 is {ranges['worst level'].value:+.1f} dB off linear theory in the worst one-third "
            f"octave, {signed_mean(levels):+.1f} dB in the mean"
        )
    of_figure = [mine[key] for key in names if key in mine] + [ranges[key] for key in ("worst level",) if key in ranges]
    claims = [answered(CLAIM, of_figure, f"on springs {', '.join(parts)}.")]
    if PERIOD in mine:
        claims.append(
            of_period(
                mine[PERIOD],
                moved.get(PERIOD),
                f"the period is {beside(mine[PERIOD])} rad/s {period_range(scene)}",
                scene.name,
            )
        )
    if "contrast" in ranges:
        worst_one = ranges["contrast"]
        claims.append(
            answered(
                DOWN_TO_ZEROS,
                [worst_one],
                f"at zero {worst_one.where['worst at']:g} the maxima are {worst_one.value:.1f} dB above it, "
                f"{worst_one.reference:.1f} dB in linear theory; each end of the contact moves by R h₀ / 2a = "
                f"{1e6 * scene.radius * scene.rms / (2 * scene.contact_radius):.3g} µm.",
            )
        )
    return (
        *claims,
        *(
            answered(saying, [moved[key]], f"{moved[key].conditions}: {with_reference(moved[key])}.")
            for key, saying in MOVED.items()
            if key in moved
        ),
    )


def of_period(mine: Number, moved: Number | None, found: str, scene: str) -> JudgedClaim:
    """Of the scene, and of the worst scene with one parameter changed, if there are any: the claim names none."""
    if moved is None:
        return answered(PERIOD_IS_CONSTANT, [mine], f"{found}.")
    return answered(
        PERIOD_IS_CONSTANT,
        [mine, moved],
        f"{found}; {moved.conditions}: {with_reference(moved)}.",
        limits=scene,
        inside=[mine],
    )


def _method(scene: WheelScene, spectrum: Spectrum) -> str:
    ours = "Table 14.1 prints E, ν, R, M and h₀; all else is our choice, see the table of the scene. "
    return (
        f"{spectrum.jumps.size} wheels, M z'' = F - F_N by velocity Verlet in steps of dx / v₀, {scene.springs} "
        f"springs to a contact radius a = {1e3 * scene.contact_radius:.4g} mm, h₀/d = "
        f"{scene.rms / scene.approach:.3g}, {len(spectrum.omega) * 2} steps from static equilibrium; the end of a "
        f"track is {WAVES_APART} longest waves from its beginning. {ours if tables.is_of_the_book(scene) else ''}"
        "Nothing damps the wheel. Its initial free vibration stays and sets the level of region 1; the contact sets "
        "the frequency of that region. A is two-sided over the frequency f, <a²> = int A df. It has no window, as in "
        "the book, or Hann's where leakage would hide a feature. The peak is interpolated between lines of Hann's "
        "spectrum. The jump is where that spectrum reaches half of the level above it. Slope and break come from "
        "means over periods of the oscillation; the floor is measured beyond q_max v₀. Errors: jackknife over groups "
        "of wheels."
    )


def _hidden(scene: WheelScene) -> list[str]:
    if scene.jump > PEAK_LAST * scene.eigenfrequency:
        return []
    return [
        f"q_min v₀ = {scene.jump:.4g} rad/s is not above ω_eigen = {scene.eigenfrequency:.4g} rad/s by a factor of "
        f"{PEAK_LAST:g}: the roughness excites the resonance itself, and there is no plateau and no jump to find."
    ]


def _flight(batches: list[Outcome]) -> str:
    lowest, highest = min(float(b["lowest"].min()) for b in batches), max(float(b["highest"].max()) for b in batches)
    airborne = float(np.mean(np.concatenate([b["airborne"] for b in batches])))
    return (
        f"Approaches of all wheels lay between {lowest:.3g} and {highest:.3g} d; wheels had no contact for "
        f"{100 * airborne:.2g} % of the time."
    )


def conclusions(mine: Features) -> list[str]:
    """What a scene has no room for, and the floor, which no claim counts."""
    always = (
        ("Region 1: the peak is the wheel on its contact spring", PEAK),
        ("Region 3 begins at q_min v₀", JUMP),
        ("The period of its oscillation is that of sin²(q a)", PERIOD),
    )
    found = [f"None stands out in this run: {text[0].lower()}{text[1:]}." for text, key in always if key not in mine]
    if floor := mine.get(FLOOR + PREDICTED):
        found.append(
            f"Region 4 is {floor.value:.3f} ± {floor.sample:.3f} times the floor J² / (ω² T) of the jump at the end of "
            "the records. A record without waves beyond q_max v₀ has this floor by construction, so it is counted as "
            "no evidence."
        )
    return found


def finding(claims: Sequence[JudgedClaim]) -> str:
    return sentence(f"on springs, {_predicted(claims[0])}", *_oscillation(claims))


def _touching(drawn: Sequence[Table]) -> dict[str, str]:
    """What the roughness does to the contact at the moment that is drawn."""
    springs, pressure = (next(table for table in drawn if table.name == name) for name in ("springs", "pressure"))
    inside = np.abs(springs["x / a"]) < 1
    carrying = np.mean(springs["compression / d"][inside] > 0)
    largest = np.nanmax(pressure["p / p0"])
    return {
        "wheel-contact": (
            f"At one moment {100 * carrying:.0f} % of the springs inside Hertz's contact carry load; the largest "
            f"pressure of boundary elements is {largest:.2f} times Hertz's"
        )
    }


def headlines(claims: Sequence[JudgedClaim]) -> dict[str, str]:
    found = {"wheel": title(_predicted(claims[0]), *_oscillation(claims))}
    moved = [(name, claim) for claim in claims for name, text in MOVED.items() if claim.claim == text]
    if moved:
        said = [
            f"{FEATURES[name].name.split(' [')[0]} {by_status(c, holds='agrees', fails='differs', undecided='open')}"
            for name, c in moved
        ]
        found["wheel-parameters"] = f"One parameter changed, worst case: {', '.join(said)}"
    return found


def _predicted(claim: JudgedClaim) -> str:
    """How many features of the figure are where theory has them."""
    return f"{share(claim.numbers, Verdict.AGREE)} features of Fig. 14.4 are as predicted"


def _oscillation(claims: Sequence[JudgedClaim]) -> list[str]:
    """At its worst zero; nothing where it was not measured."""
    return [
        by_status(
            claim,
            holds="the oscillation of region 3 is that of sin²(q a)",
            fails=f"at zero {worst_one.where['worst at']:g} the oscillation has "
            f"{round(worst_one.value, 1) + 0.0} dB of {worst_one.reference:.0f}",
            undecided=f"whether the oscillation lasts to zero {worst_one.where['worst at']:g} is open",
        )
        for claim in claims
        if claim.claim == DOWN_TO_ZEROS
        for worst_one in claim.numbers
    ]


def _captions(case: WheelSpectrum) -> dict[str, str]:
    captions = {
        "wheel-contact": (
            "The wheel in the simulation. (a) As in Fig. 14.2: the profile x²/R over springs at the height of the "
            "track; dark springs are in contact, with their compression below. (b) Boundary elements in the time loop: "
            "pressure over Hertz's largest; circle: Hertz."
        ),
        "wheel": (
            f"Fig. 14.4. (a) Spectrum of the acceleration, (14.17), mean of {case.realisations} wheels: line, no "
            "window; band, tenth to ninetieth percentile; dashed, Hann's window; thick grey, linear theory; dotted, "
            "predicted floor. Vertical lines: ω_eigen, q_min v₀, predicted break, q_max v₀. (b) Region 3 over "
            "ω^(-2H-3). (c) Contrast of the oscillation at each zero of sin²(q a): circles, Hann's window, 95 %; grey, "
            f"linear theory. The period is sought {period_range(case.scene)}."
        ),
    }
    if case.parameters:
        captions["wheel-parameters"] = (
            f"One parameter at a time, mean of {case.varied} wheels each, without window; thick grey: "
            f"{case.scene.name}."
        )
    return captions


CASE = Case(
    name="wheel",
    chapter=Chapter.WHEEL,
    place=1,
    claim=CLAIM,
    answers=(
        "Fig. 14.4: the acceleration of a rolling wheel on springs, its regions, and how they depend on the parameters"
    ),
    quick=WheelSpectrum(scene=replace(TABLE, distance=0.4), realisations=30, varied=10),
    full=WheelSpectrum(realisations=300, varied=100, cells=24, snapshot_steps=64),
    run=run,
    evidence=evidence,
    needs=model_needed.wheel,
)
