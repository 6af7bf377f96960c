"""What the input spectrum of springs changes: its numbers and tables in sentences, and the case of the report."""

from collections.abc import Sequence

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Table, Verdict, number_with
from validation.analysis.wording import by_verdict, in_a_word
from validation.cases.rolling import input_spectrum_numbers as measured
from validation.cases.rolling.claims import from_to
from validation.cases.rolling.force_spectrum_numbers import IN_RMS, LEVEL, THREE_DECIBELS
from validation.cases.rolling.input_spectrum import RollingInput, RollingInputResult, run
from validation.simulation.track_spectrum import INPUT_SPECTRA, InputSpectrum

CLAIMS: dict[InputSpectrum, str] = {
    "rolling": "Springs with the rolling-equivalent spectrum are within 3 dB of 3D in each one-third octave.",
    "line": "Springs on the trace of a line are within 3 dB of 3D in each one-third octave (Ford and Thompson 2006).",
    "geike": "Springs with Geike's spectrum are within 3 dB of 3D in each one-third octave.",
}


def evidence(result: RollingInputResult) -> Evidence:
    """Linear errors band by band; springs beside boundary elements; the punches of Fig. 14.1."""
    case, bands = result.case, measured.linear_bands(result.case)
    levels = [measured.InputLevels(result, *key, rule) for key in result.bem for rule in INPUT_SPECTRA]
    numbers = [
        *(number for name in case.spectra for number in measured.linear_numbers(bands, name)),
        *(number for one in levels for number in one.numbers),
        *(measured.punch_number(result, rule) for rule in INPUT_SPECTRA),
    ]
    rolled, within = measured.rolled_bands(result, levels), measured.bands_within(case, bands)
    claims = _claims(numbers, levels, bands)
    return Evidence(
        title="The input spectrum of springs for rolling",
        method=_method(case),
        numbers=tuple(numbers),
        tables=(bands, rolled, measured.punches(result), within),
        conclusions=(_correction(bands), *_punches(result, numbers)),
        claims=claims,
        finding=finding(claims),
        headlines=headlines(bands, rolled, number_with(numbers, measured.STIFFNESS, input=measured.NAMES["rolling"])),
        captions=_captions(case),
        unconverged=result.unconverged,
        page_tables=(within,),
    )


def _method(case: RollingInput) -> str:
    return (
        "Three input spectra of springs for one isotropic surface: Geike's spectrum; the line trace; and the "
        "rolling-equivalent spectrum C_1D(q) = ∫ (1 + q²a²) / (1 + s²a²) C_2D(s) dk, s² = q² + k². A wave s that "
        "crosses the track at an angle changes the force as a wave s does, and appears along the track as q. First, "
        "linear theory: (14.12) beside the spectrum in 3D, both by quadrature, in one-third octaves of q a, for power "
        "laws and for spectra of other shapes. Second, one-sided springs "
        f"beside boundary elements ({case.strips} surfaces, {case.cells} cells to a radius, {case.tracks} tracks) at "
        f"h_rms / d = {' and '.join(f'{h:g}' for h in case.heights)}, on one grid; the case rolling has the error of "
        "the grid. Third, the punches of Fig. 14.1 with each input spectrum. The bands of a spectrum are judged by the "
        "worst of them, within 3 dB, and by their root mean square, within 1 dB."
    )


def _claims(numbers: list[Number], levels: list[measured.InputLevels], bands: Table) -> tuple[JudgedClaim, ...]:
    """Of the input spectra one after the other, and whether one of them serves rolling and punches."""
    judged = {
        rule: [n for n in numbers if n.where.get("input") == name and n.quantity != measured.STIFFNESS]
        for rule, name in measured.NAMES.items()
    }

    def answer(rule: InputSpectrum) -> str:
        linear = [n.value for n in judged[rule] if (n.quantity, n.model) == (IN_RMS, measured.LINEAR)]
        worst = max((n for n in judged[rule] if n.quantity == LEVEL), key=lambda n: abs(n.value))
        mean = [one.mean for one in levels if one.rule == rule]
        near = np.abs(bands[f"{measured.NAMES[rule]} [dB]"]) <= THREE_DECIBELS
        return (
            f"in linear theory {near.sum()} of {near.size} one-third octaves are within {THREE_DECIBELS:g} dB, with an "
            f"rms of {min(linear):.1f} to {max(linear):.1f} dB in the bands of the spectra; one-sided springs are "
            f"{from_to(mean)} dB off boundary elements in the mean; the worst band is {worst.value:+.1f} dB off, "
            f"{worst.where['spectrum']}, q a = {worst.where['worst at']:.2g} ({worst.model})."
        )

    punch = {rule: number_with(numbers, measured.STIFFNESS, input=measured.NAMES[rule]) for rule in INPUT_SPECTRA}
    return (
        *(
            answered(claim, [n for n in judged[rule] if n.quantity == LEVEL], answer(rule))
            for rule, claim in CLAIMS.items()
        ),
        answered(
            "The rolling-equivalent spectrum serves punches too: their mean stiffness is that of boundary elements.",
            [punch["rolling"]],
            "; ".join(
                f"with {measured.NAMES[rule]} it is {100 * number.value:+.0f} ± {100 * number.uncertainty:.0f} % off "
                f"at Fbar = 0.1 ({number.verdict})"
                for rule, number in punch.items()
            )
            + ".",
        ),
    )


def finding(claims: Sequence[JudgedClaim]) -> str:
    names = (*(measured.NAMES[rule] for rule in CLAIMS),)
    within = ", ".join(f"{name} {in_a_word(claim)}" for name, claim in zip(names, claims, strict=False))
    return f"Springs within {THREE_DECIBELS:g} dB of 3D in each one-third octave: {within}."


def headlines(bands: Table, rolled: Table, punch: Number) -> dict[str, str]:
    """Bands within 3 dB by input spectrum, in linear theory and of one-sided springs; the punches."""

    def near(table: Table) -> str:
        inside = {name: np.abs(table[f"{name} [dB]"]) <= THREE_DECIBELS for name in measured.NAMES.values()}
        counts = ", ".join(f"{name} {some.sum()}" for name, some in inside.items())
        return f"Bands within {THREE_DECIBELS:g} dB of {next(iter(inside.values())).size}: {counts}"

    off = f"{100 * punch.value:+.0f} ± {100 * punch.uncertainty:.0f} %"
    return {
        "rolling_input": near(bands),
        "rolling_input-springs": near(rolled),
        "rolling_input-punch": by_verdict(
            [punch],
            agree="The rolling-equivalent spectrum keeps the mean stiffness of punches",
            differ=f"The rolling-equivalent spectrum is {off} off the mean stiffness of punches",
            undecided=f"The rolling-equivalent spectrum is {off} off punches: not decided",
        ),
    }


def _correction(bands: Table) -> str:
    """What a spectrum fitted band by band would have to add."""
    errors = bands[f"{measured.NAMES['rolling']} [dB]"]
    zero = bands["first zero"]
    return (
        "An input spectrum can be fitted band by band: the rolling-equivalent one, divided by its error in each "
        "one-third octave, has the level of linear theory in 3D in all of them, for this contact radius alone. It is "
        f"{from_to(-errors[zero])} dB higher in the band of q a = π, and {from_to(-errors[~zero])} dB in the others. "
        "Only at the zeros of sin(q a) themselves no input spectrum gives springs a force."
    )


def _punches(result: RollingInputResult, numbers: list[Number]) -> tuple[str, ...]:
    """Why one input spectrum does not serve rolling and Fig. 14.1."""
    found = {rule: number_with(numbers, measured.STIFFNESS, input=measured.NAMES[rule]) for rule in INPUT_SPECTRA}
    if found["rolling"].verdict is not Verdict.DIFFER or found["geike"].verdict is Verdict.DIFFER:
        return ()
    height = float(result.profiles["rolling"]["height"])
    return (
        "The rolling-equivalent spectrum does not serve punches. A punch needs the height of all waves that meet at "
        "one place, whatever their direction; this spectrum has "
        f"{height:.2f} of the height.",
    )


def _captions(case: RollingInput) -> dict[str, str]:
    return {
        "rolling_input": (
            "Level of (14.12) with each input spectrum over that of linear theory in 3D, in one-third octaves; shaded: "
            "within 3 dB."
        ),
        "rolling_input-springs": (
            "One-sided springs over boundary elements, by input spectrum, in one-third octaves, 95 % of the sample; "
            f"upper row h/d = {case.heights[0]:g}, lower row {case.heights[-1]:g}. Shaded: within 3 dB."
        ),
        "rolling_input-punch": (
            "Mean stiffness of punches, H = 0.7, MDR over boundary elements, by input spectrum, at three forces, 95 %; "
            "shaded: within 10 %."
        ),
    }


CASE = Case(
    name="rolling_input",
    chapter=Chapter.ROLLING,
    place=3,
    claim=CLAIMS["rolling"],
    answers="The input spectrum of MDR for rolling, and one-third octaves within 3 dB (Ford and Thompson 2006)",
    quick=RollingInput(cells=6, last=8.0, lowest=0.6, length=44.0, strips=3, tracks=20, surfaces=8, profiles=100),
    full=RollingInput(
        last=20.0,
        lowest=0.22,
        length=256.0,
        width=32.0,
        cells=16,
        strips=6,
        tracks=250,
        punch_cells=128,
        surfaces=60,
        profiles=500,
    ),
    run=run,
    evidence=evidence,
    needs="linear filter, 3D",
)
