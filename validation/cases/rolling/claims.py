"""Claims about rolling, and the roughness up to which they hold."""

from collections.abc import Sequence

from validation.analysis.answers import answered
from validation.analysis.evidence import JudgedClaim, Number, Verdict

SLOPE_COUNTS = "h' is the rms slope along the track, in one direction, of all waves"


def answered_up_to(claim: str, numbers: Sequence[Number], answer: str, *, slope: float) -> JudgedClaim:
    """A claim that may hold up to a roughness. slope: h' a for h_rms = 1, along the track."""
    inside = agreeing_up_to(numbers)
    highest = max((height_of(number) for number in inside), default=0.0)
    limits = f"up to h/d = {highest:g}, h' a/d = {slope * highest:.2g}" if inside else ""
    return answered(claim, numbers, answer, limits=limits, inside=inside)


def agreeing_up_to(numbers: Sequence[Number]) -> tuple[Number, ...]:
    """The numbers at all h/d below the first at which one does not agree."""
    failing = [height_of(number) for number in numbers if number.verdict is not Verdict.AGREE]
    return tuple(number for number in numbers if height_of(number) < min(failing, default=float("inf")))


def height_of(number: Number) -> float:
    height = number.where["h/d"]
    assert isinstance(height, float)
    return height


def from_to(values: Sequence[float], digits: int = 1, *, signed: bool = True) -> str:
    """Both ends, with their signs where these tell something: "+3.4 to +4.3"."""
    low, high = (f"{value:{'+' if signed else ''}.{digits}f}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"
