"""Hear it: what four models make of one rough rail, as sounds with one gain."""

import math

import numpy as np

from validation.analysis.spectra import Sound, Sounds
from validation.case import Case, Chapter, Chart, Curve, Panel, Quantity, Series, Study
from validation.railway.cases import rail_sound
from validation.railway.cases.rail_sound import SOUNDING, RailSound, RailSoundResult
from validation.railway.problems.rail_sound import GEIKE, ISOTROPIC
from validation.simulation.model_names import BEM, LINEAR, SPRINGS_THAT_READ

IN_BANDS = Quantity("level_in_one-third_octaves")
FORCE = Quantity("contact_force_less_its_mean")
PLACES = Quantity("places_in_frequency")
FREQUENCY, TIME = "f [Hz]", "t [ms]"
ENDS, OF_CONTACT = "an end of the band", "the wave as long as the contact"
TONE = 20.0
"""Repeats a second that are heard as a tone [Hz]."""
SHOWN = 0.02
"""Seconds of the waveforms that are drawn."""


def series(result: RailSoundResult) -> list[Series]:
    """What is drawn: the waveforms, their levels, and places in frequency."""
    case, drawn = result.case, list[Series]()
    f, time = result.bands.centres / (2 * math.pi), 1000 * np.arange(round(SHOWN * case.rate)) / case.rate
    for model in case.sounding:
        name, force = model, np.round(result.signal(model), 1)[: time.size]
        drawn += [
            Series(IN_BANDS, name, result.in_bands(model), along=FREQUENCY, at=f, unit="dB re 1 N"),
            Series(FORCE, name, force, along=TIME, at=time[: force.size], unit="N"),
        ]
    places = ((ENDS, case.band), (OF_CONTACT, (case.of_contact,)))
    return drawn + [Series(PLACES, name, at, along=FREQUENCY, at=at, unit="Hz") for name, at in places]


def sounds_of(result: RailSoundResult) -> Sounds:
    case = result.case
    return Sounds(
        table="samples",
        rate=case.rate,
        full_scale=result.full_scale,
        repeats=case.repeats,
        heard=" ".join(what_is_heard(result)),
        tracks=tuple(
            Sound(
                name=name,
                label=model[0].upper() + model[1:],
                column=rail_sound.column_of(model),
                says=f"{result.level(model):.1f} dB re 1 N.",
            )
            for name, model in SOUNDING.items()
            if model in case.sounding
        ),
    )


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
    metres = f"{case.metres:.3g} m of rail, {case.seconds:.3g} s"
    if case.repeats == 1:
        return f"Each is one passage over {metres}, with nothing repeated."
    rhythm = "as a tone" if 1 / case.seconds >= TONE else "as a rhythm, not as a tone"
    return (
        f"Each is a passage over {metres}, {case.repeats} times. The strip is periodic, so the joint is smooth, but it "
        f"repeats every {1000 * case.seconds:.0f} ms, {1 / case.seconds:.3g} times a second, which is heard {rhythm}."
    )


STUDY = Study(
    title="Hear it: a wheel on a rail by four models",
    method=(
        "One rough strip of {c.metres:.3g} m, isotropic, whose lines have the levels of {c.rail.levels.source}, under "
        "a wheel of {c.rail.load:g} N at {c.speed:.3g} m/s. The wheel keeps the approach of its smooth contact, as one "
        "that is too heavy to follow; the force along the track is the signal in time. All models roll over the same "
        "surface. Springs of Geike's spectrum have no surface: their profile is the middle line of this one with each "
        "wave scaled to that spectrum, so that it keeps its phase. Boundary elements have {c.cells} cells to the "
        "smaller semi-axis. A force has another weight than sound power: what a filter changes for the ear is in the "
        "case across."
    ),
    series=series,
    charts=(
        Chart("rail_sound", claims=()).of(
            "(a) The contact force less its mean over the first 20 ms, model by model, each 10 kN below the one "
            "before. (b) Its levels in one-third octaves. Dashed: the ends of the band in which the rail is rough "
            "along the track, {c.band[0]:.0f} and {c.band[1]:.0f} Hz; dotted: the wave as long as the contact, "
            "{c.of_contact:.0f} Hz. What sounds below the band are oblique waves, which a profile with Geike's "
            "spectrum has not.",
            Panel(TIME, "F, shifted [N]", log="", ylim=(-4e4, 1e4)).of(
                Curve(FORCE, style="lines", by=("model",), down=1e4)
            ),
            Panel(FREQUENCY, "level [dB re 1 N]", decades=45.0).of(
                Curve(IN_BANDS, BEM, "thick"),
                Curve(IN_BANDS, LINEAR, "marks"),
                Curve(IN_BANDS, SPRINGS_THAT_READ, "marks"),
                Curve(IN_BANDS, GEIKE, "lines"),
                Curve(PLACES, ENDS, "dashed guide", "_", upright=True),
                Curve(PLACES, OF_CONTACT, "guide", "_", upright=True),
            ),
        ),
    ),
    printed=("sounds",),
    tables=lambda result: (result.sounds_table(), result.samples_table()),
    sounds=sounds_of,
)
CASE = Case(
    name="rail_sound",
    chapter=Chapter.RAIL,
    place=6,
    answers="What a rough rail sounds like by each model: the contact force as WAV files with one gain",
    quick=RailSound(rail=rail_sound.shipped_rail(), seconds=0.25, repeats=5, cells=(4, 6)),
    full=RailSound(rail=rail_sound.shipped_rail(), seconds=2.0, repeats=1, cells=(6, 8), parts=8),
    run=rail_sound.run,
    study=STUDY,
    needs="linear theory of the ellipse",
)
