"""Fig. 14.4: the regions of the spectrum and what moves them, in words."""

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Verdict, if_confirmed, with_reference
from validation.cases.wheel import spectrum_tables as tables
from validation.cases.wheel.features import BREAK, FLOOR, JUMP, PEAK, PEAK_LAST, PERIOD, PREDICTED, SLOPE, Spectrum
from validation.cases.wheel.spectrum import WheelResult, WheelSpectrum, run
from validation.cases.wheel.spectrum_numbers import FEATURES, exact_numbers, feature_numbers, level_over_linear
from validation.engine.engine import Outcome
from validation.scenes.dynamic_wheel import WheelScene
from validation.selection import model_needed
from validation.simulation.wheel_on_springs import WAVES_APART

FEW = 3
"""Names that a sentence lists."""


def evidence(result: WheelResult) -> Evidence:
    """Features beside theory for the scene and for each variation; balance of forces and Parseval as criteria."""
    case = result.case
    spectra = {name: Spectrum.of(varied, result.batches[name]) for name, varied in case.variations().items()}
    features = {name: feature_numbers(name, spectrum) for name, spectrum in spectra.items()}
    base = case.scene.name
    level = list(level_over_linear(spectra[base]))
    batches = [batch for group in result.batches.values() for batch in group]
    shown = (tables.shown_scene(case.scene), tables.shown_regions(features[base]))
    return Evidence(
        title="Fig. 14.4: the acceleration of a rolling wheel, on springs",
        method=_method(case.scene, spectra[base]),
        numbers=(*exact_numbers(batches), *features[base].values(), *level),
        tables=tables.tables_of(result, spectra),
        page_tables=(*shown, tables.shown_parameters(features)) if len(features) > 1 else shown,
        conclusions=(
            *_hidden(case.scene),
            *conclusions(features, base, level[0] if level else None),
            _flight(result.batches[base]),
            *filter(None, (case.scene.no_steady_answer(), *case.scene.diagnose())),
        ),
        captions=_captions(case),
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


def conclusions(features: dict[str, dict[str, Number]], base: str, level: Number | None) -> list[str]:
    """One sentence for each feature; a region that a scene has no room for is left out."""
    mine = features[base]
    sentences = [
        ("Region 1: the peak is the wheel on its contact spring", mine.get(PEAK), True),
        ("Region 3 begins at q_min v₀", mine.get(JUMP), True),
        ("Its slope is that of linear theory", mine.get(SLOPE), False),
        ("Its oscillation is sin²(q a)", mine.get(PERIOD), True),
        ("Its level is that of linear theory", level, True),
        (
            "Region 4 is a floor of ω⁻² which the jump at the end of the records makes, and not the contact",
            mine.get(FLOOR + PREDICTED),
            False,
        ),
        ("The break is where that floor meets region 3", mine.get(BREAK + PREDICTED), False),
    ]
    found = [_confirmed(sentence, number) for sentence, number, always in sentences if number or always]
    return [*found, _moves(features)] if len(features) > 1 else found


def _confirmed(sentence: str, number: Number | None) -> str:
    if number is None:
        return f"None stands out in this run: {sentence[0].lower()}{sentence[1:]}."
    return if_confirmed(f"{sentence}: {with_reference(number)}.", [number])


def _moves(features: dict[str, dict[str, Number]]) -> str:
    """Which features follow theory through all variations."""
    parts = []
    for key, feature in FEATURES.items():
        numbers = {name: mine[key] for name, mine in features.items() if key in mine}
        agree = sum(n.verdict is Verdict.AGREE for n in numbers.values())
        differ = [name for name, n in numbers.items() if n.verdict is Verdict.DIFFER]
        missing = [name for name in features if name not in numbers]
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
            "break, q_max v₀. (b) Region 3 over ω^(-2H-3), over a linear ω: the oscillation of period π v₀ / a."
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
    claim="The acceleration of a wheel has four regions, each of known level and slope (Fig. 14.4).",
    answers=(
        "Fig. 14.4: the acceleration of a rolling wheel on springs, its regions, and how they depend on the parameters"
    ),
    quick=WheelSpectrum(),
    full=WheelSpectrum(realisations=300, varied=100, cells=24, snapshot_steps=64),
    run=run,
    evidence=evidence,
    needs=model_needed.wheel,
)
