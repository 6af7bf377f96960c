"""What Fig. 14.1 shows, in a sentence and in titles; the words follow from verdicts."""

from collections.abc import Sequence

from validation.analysis.evidence import JudgedClaim, Number, Verdict
from validation.analysis.wording import by_status, by_verdict, highest_and_lowest_off, sentence, share
from validation.cases.punch.ensembles import Row
from validation.cases.punch.fractal_punch_claims import CLAIM, OF_LAW, OF_MEAN
from validation.cases.punch.fractal_punch_decades import (
    DEVIATION,
    MARGIN,
    MEAN,
    DecadeComparison,
    numbers_of,
)
from validation.cases.punch.fractal_punch_numbers import PUBLISHED
from validation.cases.punch.fractal_punch_text import NONE_LEFT, in_words, nothing_left
from validation.simulation.rough_punch import BEM


def finding(comparisons: Sequence[DecadeComparison], claims: Sequence[JudgedClaim]) -> str:
    """The mean and the fluctuation, with the largest differences of both signs at any force and H."""
    named = {claim.claim: claim for claim in claims}
    what = {OF_MEAN: "mean stiffness", CLAIM: "fluctuation of the stiffness"}
    points = {
        claim: [n for c in comparisons if c.name == name and c.hurst is not None for n in c.numbers]
        for claim, name in ((OF_MEAN, MEAN), (CLAIM, DEVIATION))
    }
    return sentence(
        *(
            by_status(
                named[claim],
                holds=f"MDR has the {name} of rough punches within {MARGIN}",
                fails=f"MDR's {name} is more than {MARGIN} off: {_off(points[claim])}",
                undecided=f"whether MDR has the {name} of rough punches within {MARGIN} is open",
            )
            for claim, name in what.items()
            if claim in named
        )
    )


def headlines(
    comparisons: Sequence[DecadeComparison], curves: Sequence[Row], claims: Sequence[JudgedClaim]
) -> dict[str, str]:
    laws = [claim for claim in claims if claim.claim == OF_LAW]
    singles = numbers_of(c for c in comparisons if c.name == DEVIATION and c.hurst is not None)
    return {
        "fractal_punch": _of_mean_curve("fluctuation", DEVIATION, comparisons),
        "fractal_punch-overlay": _left(curves),
        "fractal_punch-difference": _decades(singles) if singles else "",
        "fractal_punch-mean": _of_mean_curve("mean stiffness", MEAN, comparisons),
        "fractal_punch-exponent": _law(laws[0]) if laws else _published(),
    }


def _of_mean_curve(what: str, name: str, comparisons: Sequence[DecadeComparison]) -> str:
    """Of the mean over H, where there are several, at every force."""
    mine = [c for c in comparisons if c.name == name]
    over = [c for c in mine if c.hurst is None]
    points = [number for c in over or mine for number in c.numbers]
    if not points:
        return ""
    found = by_verdict(
        points,
        agree=f"within {MARGIN} at every force",
        differ=_off(points),
        undecided=f"no force shows a difference of {MARGIN}",
    )
    return f"MDR's {what}{', mean over H' if over else ''}: {found}"


def _off(numbers: Sequence[Number]) -> str:
    """The largest difference of each sign: "+31 % at Fbar = 0.1, none left at Fbar = 10"."""
    return ", ".join(
        f"{NONE_LEFT if nothing_left(number) else in_words(number.value, number.unit)} at Fbar = "
        f"{number.where['Fbar']:.2g}"
        for number in highest_and_lowest_off(numbers)
    )


def _left(curves: Sequence[Row]) -> str:
    """From which force on springs have no fluctuation, whatever H, and boundary elements have some."""
    without = [row for row in curves if row["mdr relative deviation"] == 0]
    if not without:
        return "MDR keeps a fluctuation at every force"
    first = max(min(row["Fbar"] for row in without if row["H"] == h) for h in {row["H"] for row in without})
    some = len({row["H"] for row in without}) < len({row["H"] for row in curves})
    kept = all(row[f"{BEM} relative deviation"] > 0 for row in without)
    rest = "; boundary elements keep some" if kept else ""
    return f"From Fbar = {first:.2g} on MDR has no fluctuation{' for some H' if some else ''}{rest}"


def _decades(numbers: Sequence[Number]) -> str:
    """Of single H."""
    if any(number.verdict is Verdict.DIFFER for number in numbers):
        return f"MDR's fluctuation is over {MARGIN} off in {share(numbers, Verdict.DIFFER)} decades of single H"
    others = "; others open" if any(number.verdict is Verdict.UNDECIDED for number in numbers) else ""
    return f"MDR's fluctuation agrees within {MARGIN} in {share(numbers, Verdict.AGREE)} decades of single H{others}"


def _law(claim: JudgedClaim) -> str:
    """In the one decade where it is judged."""
    ends = claim.numbers[0].where["Fbar"]
    assert isinstance(ends, tuple)
    found = by_status(
        claim,
        holds=f"holds within {claim.numbers[0].tolerance:g}",
        fails=f"fails at {share(claim.numbers, Verdict.DIFFER)} H",
        undecided=f"is open within {claim.numbers[0].tolerance:g}",
    )
    return f"The exponent 1 / (1 + H) {found} (Fbar {ends[0]:g} to {ends[1]:g})"


def _published() -> str:
    return f"Exponents beside the published {PUBLISHED[0]} to {PUBLISHED[1]}"
