"""Hear it: what four models make of one rough rail, as sounds with one gain."""

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Verdict, numbers_with
from validation.analysis.sound import Sound, Sounds
from validation.analysis.wording import decibels
from validation.cases.rail.rail_sound import LABELS, SOUNDING, RailSound, RailSoundResult, run, shipped_rail
from validation.cases.rail.rail_sound_levels import LOW, SILENT, WEIGHTED, SoundLevels, column_of
from validation.simulation.equivalent_displacement import BEM, LINEAR, SPRINGS_THAT_READ
from validation.simulation.rail_sound import GEIKE, ISOTROPIC

LEVEL = "level of the contact force"
FIELD = "a tolerance of the field"
TONE = 20.0
"""Repeats a second that are heard as a tone [Hz]."""
CLAIM = "Springs of Geike's spectrum sound as boundary elements do, within 1 dB, A-weighted and in each range."
CLAIM_LINEAR = "Linear theory in 3D sounds as boundary elements do, within 1 dB, A-weighted and in each range."
CLAIM_READ = "Springs that read the surface sound as boundary elements do, within 1 dB, A-weighted and in each range."


def evidence(result: RailSoundResult) -> Evidence:
    """Levels over boundary elements, and the sounds."""
    levels = SoundLevels(result)
    numbers = [
        over_boundary_elements(levels, model, part)
        for model in result.case.sounding
        if model != BEM
        for part in levels.gains
    ]
    judged = [_claim(claim, numbers_with(numbers, LEVEL, LABELS[model])) for model, claim in _claims(result.case)]
    table = levels.sounds_table()
    signals = levels.waveforms_table(), levels.samples_table()
    return Evidence(
        title="Hear it: a wheel on a rail by four models",
        method=_method(result.case),
        numbers=tuple(numbers),
        tables=(table, levels.bands_table(), levels.frequencies_table(), *signals),
        conclusions=(_below_the_band(levels),),
        captions={"rail_sound": _caption(levels)},
        headlines={"rail_sound": farthest(numbers)},
        finding=which_sound_alike(numbers),
        claims=tuple(judged),
        page_tables=(table,),
        sounds=sounds_of(levels),
    )


def over_boundary_elements(levels: SoundLevels, model: str, part: str) -> Number:
    """Both on the same strip; -30 dB where the model is silent."""
    found, grid = levels.over(model, part)
    case = levels.case
    return Number(
        quantity=LEVEL,
        model=LABELS[model],
        where={"part": part},
        value=found.value,
        reference=0.0,
        source=f"boundary elements on the same {case.speed * case.seconds:.3g} m of rail",
        tolerance=1.0,
        reason=FIELD,
        unit="dB",
        grid=grid,
        sample=found.half_width,
        role=Role.FINDING,
    )


def sounds_of(levels: SoundLevels) -> Sounds:
    """Of all models, with one gain."""
    result, case = levels.result, levels.case
    return Sounds(
        table="samples",
        rate=case.rate,
        full_scale=result.full_scale,
        repeats=case.repeats,
        heard=" ".join(what_is_heard(result)),
        tracks=tuple(
            Sound(
                name=name,
                label=LABELS[model][0].upper() + LABELS[model][1:],
                column=column_of(model),
                says=f"{levels.level(model, WEIGHTED):.1f} dB(A) re 1 N{_beside(levels, model)}.",
            )
            for name, model in SOUNDING.items()
            if model in case.sounding
        ),
    )


def _beside(levels: SoundLevels, model: str) -> str:
    if model == BEM or BEM not in levels.case.sounding:
        return ""
    return f", {signed(levels.over(model, WEIGHTED)[0].value)} dB over boundary elements"


def what_is_heard(result: RailSoundResult) -> list[str]:
    """In sentences: the signal, its frequencies, its gain and its length."""
    case = result.case
    first, last = case.band
    upper = min(last, case.rate / 2)
    sentences = [
        "What is heard is the contact force less its mean, of a wheel that is held at a constant height while it rolls "
        f"at {3.6 * case.speed:.3g} km/h. It is quasi-static and filtered by nothing: no inertia of the wheel, no "
        "resonance of wheel and track, no radiation, so a real wheel sounds otherwise.",
        f"The waves of the rail have {first:.0f} to {upper:.0f} Hz along the track. Longer ones, which lift the wheel "
        "as a whole, and shorter ones are left out"
        + ("; oblique ones among those kept are heard below that too." if case.across == ISOTROPIC else "."),
        f"All files have one gain: full scale is {result.full_scale:g} N. Levels are relative: differences between "
        "files are those of the forces, and how loud they are played has no meaning.",
        _length(case),
    ]
    if last > case.rate / 2:
        sentences.insert(2, f"Shorter waves, up to {last:.0f} Hz, are beyond what {case.rate} samples a second carry.")
    return sentences


def _length(case: RailSound) -> str:
    metres = f"{case.speed * case.seconds:.3g} m of rail, {case.seconds:.3g} s"
    if case.repeats == 1:
        return f"Each is one passage over {metres}, with nothing repeated."
    rhythm = "as a tone" if 1 / case.seconds >= TONE else "as a rhythm, not as a tone"
    return (
        f"Each is a passage over {metres}, {case.repeats} times. The strip is periodic, so the joint is smooth, but it "
        f"repeats every {1000 * case.seconds:.0f} ms, {1 / case.seconds:.3g} times a second, which is heard {rhythm}."
    )


def _claims(case: RailSound) -> list[tuple[str, str]]:
    """Of models that were heard."""
    claims = [(GEIKE, CLAIM), (LINEAR, CLAIM_LINEAR), (SPRINGS_THAT_READ, CLAIM_READ)]
    return [(model, claim) for model, claim in claims if model in case.sounding]


def _claim(claim: str, mine: list[Number]) -> JudgedClaim:
    return answered(claim, mine, "; ".join(f"{n.where['part']} {_found(n)}" for n in mine) + ".")


def _found(number: Number) -> str:
    if number.value <= SILENT:
        return f"{SILENT:g} dB or less"
    return decibels(number)


def signed(value: float) -> str:
    """To a tenth; zero has the sign +."""
    return f"{round(value, 1) + 0.0:+.1f}"


def which_sound_alike(numbers: list[Number]) -> str:
    """Models by the verdict of their A-weighted level."""
    weighted = numbers_with(numbers, LEVEL, part=WEIGHTED)
    said = {
        Verdict.AGREE: "Within 1 dB(A) of boundary elements: ",
        Verdict.DIFFER: "Farther off: ",
        Verdict.UNDECIDED: "Not decided: ",
    }
    parts = [
        text + ", ".join(f"{n.model} ({_found(n)})" for n in weighted if n.verdict is verdict) + "."
        for verdict, text in said.items()
        if any(n.verdict is verdict for n in weighted)
    ]
    return " ".join(parts)


def farthest(numbers: list[Number]) -> str:
    """The model and the range with the largest difference."""
    worst = max(numbers, key=lambda number: abs(number.value))
    size, side = abs(worst.value), "louder" if worst.value > 0 else "quieter"
    more = " or more" if worst.value <= SILENT else ""
    return f"Farthest from boundary elements: {worst.model}, {size:.1f} dB{more} {side} {worst.where['part']}"


def _below_the_band(levels: SoundLevels) -> str:
    parts = ", ".join(f"{levels.share(model, LOW):.1f} % by {LABELS[model]}" for model in levels.case.sounding)
    return f"Of the mean square of the force, so much lies below the band, where oblique waves sound: {parts}."


def _method(case: RailSound) -> str:
    scene, (coarse, fine) = case.rail, case.cells
    return (
        f"One rough strip of {case.speed * case.seconds:.3g} m, isotropic, whose lines have the levels of "
        f"{scene.levels.source}, under a wheel of {scene.load / 1000:g} kN at {3.6 * case.speed:.3g} km/h. The wheel "
        "keeps the approach of its smooth contact, as one that is too heavy to follow; the force along the track is "
        "the signal in time. All models roll over the same surface. Springs of Geike's spectrum have no surface: their "
        "profile is the middle line of this one with each wave scaled to that spectrum, so that it keeps its phase. "
        f"Sample: jackknife over {case.blocks} pieces of the strip. Grid: {coarse} and {fine} cells to the smaller "
        f"semi-axis, to first order. A model that is {-SILENT:g} dB quieter than boundary elements or more counts as "
        f"{SILENT:g} dB. The A-weighting of IEC 61672-1 is meant for sound pressure; here it weights a force, for "
        "comparison alone."
    )


def _caption(levels: SoundLevels) -> str:
    first, last = levels.case.band
    return (
        "(a) The contact force less its mean over the first 20 ms, model by model, all on one scale. (b) Its levels in "
        "one-third octaves. Dashed: the ends of the band in which the rail is rough along the track, "
        f"{first:.0f} and {last:.0f} Hz; dotted: the wave as long as the contact, {levels.case.of_contact:.0f} Hz. "
        "What sounds below the band are oblique waves, which a profile with Geike's spectrum has not."
    )


CASE = Case(
    name="rail_sound",
    chapter=Chapter.RAIL,
    place=6,
    claim=CLAIM,
    answers="What a rough rail sounds like by each model: the contact force as WAV files with one gain",
    quick=RailSound(rail=shipped_rail(), seconds=0.25, repeats=5, cells=(4, 6)),
    full=RailSound(rail=shipped_rail(), seconds=2.0, repeats=1, cells=(6, 8), parts=8),
    run=run,
    evidence=evidence,
    needs="linear theory of the ellipse",
)
