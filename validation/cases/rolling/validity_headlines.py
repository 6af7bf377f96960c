"""Which parameter says where linear theory ends, in words that follow from the claims."""

from collections.abc import Sequence

from validation.analysis.evidence import JudgedClaim
from validation.analysis.wording import by_status, sentence


def headline(claims: Sequence[JudgedClaim]) -> str:
    """claims: of the contact and of the level, each at equal h' a/d and at equal h/d."""
    return f"Contact kept over all spectra: {_sides(claims[0], claims[1])}"


def finding(claims: Sequence[JudgedClaim]) -> str:
    return sentence(
        f"over all spectra, the share of contact kept is {_sides(claims[0], claims[1])}",
        f"the level off linear theory is {_sides(claims[2], claims[3])}",
    )


def _sides(at_slope: JudgedClaim, at_height: JudgedClaim) -> str:
    said = [
        by_status(claim, holds="the same", fails="different", undecided="not decided")
        for claim in (at_height, at_slope)
    ]
    return f"{said[0]} at equal h/d, {said[1]} at equal h' a/d"
