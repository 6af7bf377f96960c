"""What the input spectrum of springs changes: its numbers and tables in sentences, and the case of the report."""

from collections.abc import Iterable

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Place, Table, Verdict, number_with
from validation.cases.rolling import input_spectrum_numbers as measured
from validation.cases.rolling.input_spectrum import RollingInput, RollingInputResult, run
from validation.simulation.track_spectrum import INPUT_SPECTRA


def evidence(result: RollingInputResult) -> Evidence:
    """Linear errors band by band; springs beside boundary elements; the punches of Fig. 14.1."""
    case, bands = result.case, measured.linear_bands(result.case)
    levels = [measured.InputLevels(result, *key, rule) for key in result.bem for rule in INPUT_SPECTRA]
    numbers = [
        *(number for name in case.spectra for number in measured.linear_numbers(bands, name)),
        *(one.number for one in levels),
        *(measured.punch_number(result, rule) for rule in INPUT_SPECTRA),
    ]
    rolled, within = measured.rolled_bands(result, levels), measured.bands_within(case, bands)
    return Evidence(
        title="The input spectrum of springs for rolling",
        method=_method(case),
        numbers=tuple(numbers),
        tables=(bands, rolled, measured.punches(result), within),
        conclusions=(*_levels(case, numbers), *_counts(case, bands, rolled), _punches(result, numbers)),
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
        "the grid. Third, the punches of Fig. 14.1 with each input spectrum."
    )


def _levels(case: RollingInput, numbers: list[Number]) -> list[str]:

    def chain(model: str, names: Iterable[str], where: dict[str, Place]) -> str:
        found = {name: number_with(numbers, measured.IN_BAND, model, spectrum=name, **where).value for name in names}
        return "; ".join(f"{name}: {value:+.1f} dB" for name, value in found.items())

    return [
        *(
            f"In linear theory, mean level in the band, springs over 3D, {name}: "
            f"{chain(measured.LINEAR, case.spectra, {'input': name})}."
            for name in measured.NAMES.values()
        ),
        *(
            f"One-sided springs over boundary elements at h/d = {height:g}, {name}: "
            f"{chain(measured.ONE_SIDED, case.rolled, {'h/d': height, 'input': name})}."
            for height in case.heights
            for name in measured.NAMES.values()
        ),
    ]


def _counts(case: RollingInput, bands: Table, rolled: Table) -> list[str]:

    def count(table: Table) -> str:
        near = {name: np.abs(table[f"{name} [dB]"]) <= measured.FORD_THOMPSON for name in measured.NAMES.values()}
        return "; ".join(f"{name}: {inside.sum()} of {inside.size} bands" for name, inside in near.items())

    return [
        "Springs within 3 dB of 3D in one-third octaves (Ford and Thompson 2006), both in linear theory: "
        f"{count(bands)}. The published 3 dB are about springs on the trace of a line along the track, not about "
        "Geike's rule.",
        *(
            f"One-sided springs within 3 dB of boundary elements at h/d = {height:g}: "
            f"{count(rolled.where(**{'h/d': height}))}."
            for height in case.heights
        ),
    ]


def _punches(result: RollingInputResult, numbers: list[Number]) -> str:
    """Whether one input spectrum serves rolling and Fig. 14.1."""
    names = measured.NAMES
    found = {rule: number_with(numbers, measured.STIFFNESS, input=names[rule]) for rule in INPUT_SPECTRA}
    parts = "; ".join(
        f"{names[rule]}, {float(result.profiles[rule]['height']):.2f} of the height: {100 * number.value:+.0f} ± "
        f"{100 * number.uncertainty:.0f} % ({number.verdict})"
        for rule, number in found.items()
    )
    answer = "Whether one input spectrum could serve both is not decided by this run."
    if found["rolling"].verdict is Verdict.DIFFER and found["geike"].verdict is not Verdict.DIFFER:
        answer = (
            "So no input spectrum serves both. A punch needs the height of all waves that meet at one place, whatever "
            "their direction. Rolling needs, at each wavenumber along the track, the force of the waves that appear "
            "there. One spectrum cannot have both."
        )
    return (
        "The punches of Fig. 14.1 at Fbar = 0.1, mean stiffness of MDR over boundary elements, by input spectrum: "
        f"{parts}. {answer}"
    )


def _captions(case: RollingInput) -> dict[str, str]:
    return {
        "rolling_input": (
            "Level of (14.12) with each input spectrum over that of linear theory in 3D, in one-third octaves; "
            "shaded: within 3 dB. No input spectrum can correct the bands of the first zeros of sin(q a), at q a = π "
            "and 2π: in 3D they are filled."
        ),
        "rolling_input-springs": (
            "One-sided springs over boundary elements, by input spectrum, in one-third octaves, with 95 % intervals of "
            f"the sample; upper row h/d = {case.heights[0]:g}, lower row {case.heights[-1]:g}. Shaded: within 3 dB."
        ),
        "rolling_input-punch": (
            "Fig. 14.1 with the same input spectra: mean stiffness of punches, H = 0.7, MDR over boundary elements, at "
            "three forces, with 95 % intervals; shaded: within 10 %. The line trace and the rolling-equivalent "
            "spectrum have less height than the surface."
        ),
    }


CASE = Case(
    name="rolling_input",
    chapter=Chapter.ROLLING,
    place=3,
    claim=(
        "With the rolling-equivalent input spectrum, springs have the force level of 3D within 3 dB in "
        "one-third octaves."
    ),
    answers="The input spectrum of MDR for rolling, and one-third octaves within 3 dB (Ford and Thompson 2006)",
    quick=RollingInput(),
    full=RollingInput(
        last=20.0,
        lowest=0.22,
        length=256.0,
        width=32.0,
        cells=16,
        strips=4,
        tracks=250,
        punch_cells=128,
        surfaces=60,
        profiles=500,
    ),
    run=run,
    evidence=evidence,
    needs="linear filter, 3D",
)
