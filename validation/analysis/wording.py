"""Words that follow from verdicts: for titles of figures and for first sentences."""

from collections.abc import Iterable, Sequence

from validation.analysis.evidence import ClaimStatus, JudgedClaim, Number, Verdict


def joint_verdict(numbers: Sequence[Number]) -> Verdict:
    """Differ where one does, agree where all do, else undecided. Raises ValueError without numbers."""
    if not numbers:
        raise ValueError("a joint verdict must have numbers, got none")
    verdicts = {number.verdict for number in numbers}
    if Verdict.DIFFER in verdicts:
        return Verdict.DIFFER
    return Verdict.UNDECIDED if Verdict.UNDECIDED in verdicts else Verdict.AGREE


def by_verdict(numbers: Sequence[Number], *, agree: str, differ: str, undecided: str) -> str:
    """The sentence of the joint verdict."""
    return {Verdict.AGREE: agree, Verdict.DIFFER: differ, Verdict.UNDECIDED: undecided}[joint_verdict(numbers)]


def by_status(claim: JudgedClaim, *, holds: str, fails: str, undecided: str) -> str:
    """The sentence of the status of a claim; where it holds within limits, these follow."""
    if claim.status is ClaimStatus.LIMITED:
        return f"{holds} ({claim.limits})"
    return {ClaimStatus.HOLDS: holds, ClaimStatus.CONTRADICTED: fails, ClaimStatus.OPEN: undecided}[claim.status]


def in_a_word(claim: JudgedClaim) -> str:
    """Its status where the question stands before it: "yes", "yes (up to h/d = 0.1)", "no", "open"."""
    return by_status(claim, holds="yes", fails="no", undecided="open")


def highest_and_lowest_off(numbers: Iterable[Number]) -> list[Number]:
    """Of the numbers that differ, the one farthest above its reference and the one farthest below, where there are."""
    off = [number for number in numbers if number.verdict is Verdict.DIFFER]
    above, below = ([n for n in off if sign * n.difference > 0] for sign in (1, -1))
    ends = [max(above, key=lambda n: n.difference)] if above else []
    return ends + ([min(below, key=lambda n: n.difference)] if below else [])


def farthest_off(numbers: Sequence[Number]) -> Number:
    """Of the numbers that differ the farthest from its reference; of all where none does."""
    off = [number for number in numbers if number.verdict is Verdict.DIFFER]
    return max(off or numbers, key=lambda number: abs(number.difference))


def too_loud(decibels: float, digits: int = 1) -> str:
    """A level over its reference: "3.1 dB too loud", "0.4 dB too quiet"."""
    return f"{abs(decibels):.{digits}f} dB too {'loud' if decibels > 0 else 'quiet'}"


def decibels(number: Number) -> str:
    """To a tenth, with an interval that has one: "+0.2 ± 0.5 dB", "+0.2 dB", "less than 0.05 dB"."""
    value, half_width = (round(x, 1) + 0.0 for x in (number.value, number.uncertainty))
    if not half_width:
        return f"{value:+.1f} dB" if value else "less than 0.05 dB"
    return f"{value:+.1f} ± {half_width:.1f} dB"


def share(numbers: Sequence[Number], verdict: Verdict) -> str:
    """How many have a verdict: "17 of 28"."""
    return f"{sum(number.verdict is verdict for number in numbers)} of {len(numbers)}"


def title(*clauses: str) -> str:
    """Clauses joined by semicolons, with a capital."""
    text = "; ".join(clause for clause in clauses if clause)
    return f"{text[:1].upper()}{text[1:]}"


def sentence(*clauses: str) -> str:
    """The same with a full stop."""
    text = title(*clauses)
    return f"{text}." if text else ""
