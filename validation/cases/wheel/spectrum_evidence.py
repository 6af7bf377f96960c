"""Fig. 14.4: the regions of the spectrum and what moves them, in words."""

from collections.abc import Mapping, Sequence

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Verdict, if_confirmed, with_reference
from validation.analysis.over_range import root_mean_square, signed_mean, worst
from validation.cases.wheel import spectrum_tables as tables
from validation.cases.wheel.contrast import ZERO, period_range, worst_contrast
from validation.cases.wheel.features import BREAK, FLOOR, JUMP, PEAK, PEAK_LAST, PERIOD, PREDICTED, SLOPE, Spectrum
from validation.cases.wheel.spectrum import WheelResult, WheelSpectrum, run
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

CLAIM = "The acceleration of a wheel has four regions, each of known level and slope (Fig. 14.4)."
FEW = 3
"""Names that a sentence lists."""
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
    return Evidence(
        title="Fig. 14.4: the acceleration of a rolling wheel, on springs",
        method=_method(case.scene, spectra[base]),
        numbers=(*identities(batches), *found.values(), *ranges.values(), *moved.values()),
        tables=tables.tables_of(result, spectra),
        page_tables=shown,
        claims=_claims(found, ranges, moved, levels, case.scene),
        conclusions=(
            *_hidden(case.scene),
            *conclusions(mine, ranges),
            *([_moves(varied)] if varied else []),
            _flight(result.batches[base]),
            *filter(None, (case.scene.no_steady_answer(), *case.scene.diagnose())),
        ),
        captions=_captions(case),
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
            answered(
                "Region 3 oscillates with the constant period π v₀ / a.",
                [mine[PERIOD]],
                f"the period is {beside(mine[PERIOD])} rad/s {period_range(scene)}.",
            )
        )
    if "contrast" in ranges:
        worst_one = ranges["contrast"]
        claims.append(
            answered(
                "Region 3 oscillates as sin²(q a), down to its zeros.",
                [worst_one],
                f"at zero {worst_one.where['worst at']:g} the maxima are {worst_one.value:.1f} dB above it, "
                f"{worst_one.reference:.1f} dB in linear theory; each end of the contact moves by R h₀ / 2a = "
                f"{1e6 * scene.radius * scene.rms / (2 * scene.contact_radius):.3g} µm.",
            )
        )
    sayings = {
        PEAK: "The frequency of the peak depends on none of q_min, q_max, v₀, H and h₀, only on the contact.",
        JUMP: "Region 3 begins at q_min v₀, whatever the speed and the cut-off.",
        SLOPE: "The slope of region 3 is -2 H - 3, whatever the parameters.",
    }
    return (
        *claims,
        *(
            answered(saying, [moved[key]], f"{moved[key].conditions}: {with_reference(moved[key])}.")
            for key, saying in sayings.items()
            if key in moved
        ),
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


def conclusions(mine: Features, ranges: Features) -> list[str]:
    """One sentence for each feature; a region that a scene has no room for is left out."""
    sentences = [
        ("Region 1: the peak is the wheel on its contact spring", mine.get(PEAK), True),
        ("Region 3 begins at q_min v₀", mine.get(JUMP), True),
        ("Its slope is that of linear theory", mine.get(SLOPE), False),
        ("The period of its oscillation is that of sin²(q a)", mine.get(PERIOD), True),
        ("The contrast of its oscillation is that of sin²(q a)", ranges.get("contrast"), False),
        ("Its level in every one-third octave is that of linear theory", ranges.get("worst level"), True),
        ("The break is where the floor of region 4 meets region 3", mine.get(BREAK + PREDICTED), False),
    ]
    found = [_confirmed(sentence, number) for sentence, number, always in sentences if number or always]
    if floor := mine.get(FLOOR + PREDICTED):
        found.append(
            f"Region 4 is {floor.value:.3f} ± {floor.sample:.3f} times the floor J² / (ω² T) of the jump at the end of "
            "the records. A record without waves beyond q_max v₀ has this floor by construction, so it is counted as "
            "no evidence."
        )
    return found


def _confirmed(sentence: str, number: Number | None) -> str:
    if number is None:
        return f"None stands out in this run: {sentence[0].lower()}{sentence[1:]}."
    at = f", {ZERO} {number.where['worst at']:g}" if ZERO in number.where else ""
    return if_confirmed(f"{sentence}{at}: {with_reference(number)}.", [number])


def _moves(varied: Mapping[str, Features]) -> str:
    """Which features follow theory through all variations."""
    parts = []
    for key, feature in FEATURES.items():
        if key in IDENTITIES:
            continue
        numbers = {name: mine[key] for name, mine in varied.items() if key in mine}
        agree = sum(n.verdict is Verdict.AGREE for n in numbers.values())
        differ = [name for name, n in numbers.items() if n.verdict is Verdict.DIFFER]
        missing = [name for name in varied if name not in numbers]
        text = f"{feature.name}: {agree} of {len(numbers)}"
        text += f", differs for {_listed(differ)}" if differ else ""
        text += f", none stands out for {_listed(missing)}" if missing else ""
        parts.append(text)
    return f"One parameter at a time, features that agree with theory: {'; '.join(parts)}."


def _listed(names: list[str]) -> str:
    return ", ".join(names) if len(names) <= FEW else f"{len(names)} scenes, see the table"


def _captions(case: WheelSpectrum) -> dict[str, str]:
    captions = {
        "wheel-contact": (
            f"The wheel in the simulation. (a) As in Fig. 14.2, after {4 * case.snapshot_steps} steps: the "
            "profile x²/R of the wheel over springs at the height of the track. Dark springs are in contact, "
            "with their "
            "compression below; light ones are not. (b) The same wheel in three dimensions, boundary elements in the "
            f"time loop after {case.snapshot_steps} steps of a / {case.cells}: pressure over Hertz's largest in the "
            "window that moves along, over an isotropic surface of the same spectrum (waves of four cells and more); "
            "circle: Hertz."
        ),
        "wheel": (
            "Fig. 14.4. (a) Spectrum of the acceleration, (14.17): line, mean over "
            f"{case.realisations} wheels without window, as in the book; band, tenth to ninetieth percentile of "
            "wheels; dashed: with Hann's window; thick grey: linear theory, (14.12) through the resonator; dotted: the "
            "floor that the jumps at the end of the records predict. Vertical lines: ω_eigen, q_min v₀, predicted "
            "break, q_max v₀. (b) Region 3 over ω^(-2H-3), over a linear ω: the oscillation of period π v₀ / a. (c) "
            "Contrast of the oscillation: mean of (b) about the maxima beside each zero of sin²(q a), over that about "
            "the zero; circles: Hann's window, 95 % intervals; grey: linear theory. "
            f"The period is sought {period_range(case.scene)}."
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
    quick=WheelSpectrum(),
    full=WheelSpectrum(realisations=300, varied=100, cells=24, snapshot_steps=64),
    run=run,
    evidence=evidence,
    needs=model_needed.wheel,
)
