"""What rolling over isotropic roughness shows, in a sentence and in titles; the words follow from verdicts."""

from collections.abc import Sequence

import numpy as np

from validation.analysis.evidence import JudgedClaim, Number, Table, Verdict, numbers_with
from validation.analysis.statistics import POWER_DECIBEL
from validation.analysis.wording import by_status, by_verdict, farthest_off, sentence, title, too_loud
from validation.cases.rolling.claims import height_of
from validation.cases.rolling.force_spectrum import ForceSpectrum
from validation.cases.rolling.force_spectrum_levels import LINEAR_3D, SPRINGS
from validation.cases.rolling.force_spectrum_numbers import LEVEL, THREE_DECIBELS, regions

LINEAR_CLAIM = "Linear theory in 3D has the level of boundary elements in each one-third octave."
COHERENT = 0.9
"""Above it, two forces are alike position by position."""


def finding(case: ForceSpectrum, numbers: Sequence[Number], claims: Sequence[JudgedClaim]) -> str:
    return sentence(_springs(case, numbers), _linear(claims))


def headlines(
    case: ForceSpectrum, numbers: Sequence[Number], claims: Sequence[JudgedClaim], spectrum: Table, levels: Table
) -> dict[str, str]:
    return {
        "rolling-line": _zeros(spectrum),
        "rolling": _springs(case, numbers),
        "rolling-coherence": _coherence(levels),
        "rolling-map": title(_linear(claims)),
    }


def _springs(case: ForceSpectrum, numbers: Sequence[Number]) -> str:
    """With Geike's spectrum, below the band and in it: the farthest band of all heights."""
    names = [*(["below the band"] if len(regions(case)) > 1 else []), "in the band"]
    parts = []
    for name, region in zip(names, regions(case), strict=True):
        mine = numbers_with(numbers, LEVEL, f"{SPRINGS} over bem3d", **{"q a": region})
        found = by_verdict(
            mine,
            agree=f"within {THREE_DECIBELS:g} dB",
            differ=f"at worst {too_loud(farthest_off(mine).difference)}",
            undecided=f"not decided within {THREE_DECIBELS:g} dB",
        )
        parts.append(f"{found} {name}")
    return f"Springs: {', '.join(parts)}"


def _linear(claims: Sequence[JudgedClaim]) -> str:
    (claim,) = (claim for claim in claims if claim.claim == LINEAR_CLAIM)
    return by_status(
        claim,
        holds="linear theory in 3D has the level of boundary elements",
        fails=f"linear theory in 3D leaves the level of boundary elements at h/d = {_first_off(claim.numbers):g}",
        undecided="whether linear theory in 3D has the level of boundary elements is open",
    )


def _first_off(numbers: Sequence[Number]) -> float:
    """The lowest height at which one differs; infinite without."""
    return min((height_of(number) for number in numbers if number.verdict is Verdict.DIFFER), default=float("inf"))


def _zeros(spectrum: Table) -> str:
    """How far linear theory in 3D falls below the mean of (14.12), in the band."""
    mean = spectrum["(14.14)"]
    known = mean > 0
    least = float(np.min(spectrum[LINEAR_3D][known] / mean[known]))
    if least <= 0:
        return "The force spectrum has zeros in 3D as in (14.12)"
    return f"3D fills the zeros of (14.12): nowhere more than {-POWER_DECIBEL * np.log(least):.0f} dB below their mean"


def _coherence(levels: Table) -> str:
    """Up to which height all bands are coherent with linear theory, from the lowest on."""
    highest = None
    for height in np.unique(levels["h/d"]):
        if levels.where(**{"h/d": height})["coherence of bem3d"].min() < COHERENT:
            break
        highest = height
    where = "at no h/d tried" if highest is None else f"up to h/d = {highest:g}"
    return f"Every band of boundary elements is coherent with linear theory ({COHERENT:g}) {where}"
