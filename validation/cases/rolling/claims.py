"""Claims about rolling with answers that begin with the verdict, and the roughness up to which a claim holds."""

from collections.abc import Sequence

from validation.analysis import answers
from validation.analysis.evidence import JudgedClaim, Number, Verdict


def answered(
    claim: str, numbers: Sequence[Number], answer: str, *, slope: float = 0.0, confirmed_by: Verdict = Verdict.AGREE
) -> JudgedClaim:
    """A claim whose answer begins with its status; with a slope, h' a for h_rms = 1, it may hold up to a roughness."""
    inside = confirmed_up_to(numbers, confirmed_by) if slope else ()
    highest = max((height_of(number) for number in inside), default=0.0)
    limits = f"up to h/d = {highest:g}, h' a/d = {slope * highest:.2g}" if inside else ""
    return answers.answered(claim, numbers, answer, confirmed_by=confirmed_by, limits=limits, inside=inside)


def confirmed_up_to(numbers: Sequence[Number], confirmed_by: Verdict = Verdict.AGREE) -> tuple[Number, ...]:
    """The numbers at all h/d below the first at which one is not confirmed."""
    failing = [height_of(number) for number in numbers if number.verdict is not confirmed_by]
    return tuple(number for number in numbers if height_of(number) < min(failing, default=float("inf")))


def height_of(number: Number) -> float:
    height = number.where["h/d"]
    assert isinstance(height, float)
    return height


def from_to(values: Sequence[float], digits: int = 1) -> str:
    """Both ends with their signs: "+3.4 to +4.3"."""
    low, high = (f"{value:+.{digits}f}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"
