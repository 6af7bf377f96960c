"""Words that the stiffness along a track and reduced models still read here."""

from collections.abc import Sequence

from validation.cases.rolling.settings import SLOPE_COUNTS as SLOPE_COUNTS


def from_to(values: Sequence[float], digits: int = 1, *, signed: bool = True) -> str:
    """Both ends, with their signs where these tell something: "+3.4 to +4.3"."""
    low, high = (f"{value:{'+' if signed else ''}.{digits}f}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"
