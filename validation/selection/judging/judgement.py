"""A verdict on a model from outside at one point, and how it is reached."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from validation.engine.offered import Caller, Failed

__all__ = ["Caller", "Failed", "Verdict", "compared", "lost"]
SMALL = 0.01


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """Stand-in until the branch judge is merged."""

    quantity: str
    where: Mapping[str, float | str] = field(default_factory=dict)
    value: float = math.nan
    reference: float = math.nan
    difference: float = math.nan
    error: float = math.nan
    verdict: str = "undecided"
    reason: str = ""


def compared(
    quantity: str,
    where: Mapping[str, float | str],
    value: float,
    reference: float,
    error: float,
    tolerance: float,
    *,
    decibels: bool = False,
) -> Verdict:
    """error: half-width of 95 % of the value less the reference, in their unit."""
    absolute = decibels or abs(reference) < SMALL
    difference = value - reference if absolute else value / reference - 1
    error = error if absolute else error / abs(reference)
    limit = 20 * math.log10(1 + tolerance) if decibels else tolerance * (SMALL if absolute else 1)
    verdict = "undecided"
    if abs(difference) + error <= limit:
        verdict = "agree"
    elif abs(difference) - error > limit:
        verdict = "differ"
    return Verdict(
        quantity=quantity,
        where=where,
        value=value,
        reference=reference,
        difference=difference,
        error=error,
        verdict=verdict,
    )


def lost(quantity: str, where: Mapping[str, float | str], reason: str) -> Verdict:
    """Where the model has no answer."""
    return Verdict(quantity=quantity, where=where, verdict="failed", reason=reason)
