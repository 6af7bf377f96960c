"""A model over its reference: what is left between two estimates, with the error of the grid and of the sample."""

from collections.abc import Mapping

from validation.analysis.evidence import Number, Place, Role
from validation.analysis.statistics import POWER_DECIBEL, Estimate


def difference(
    value: Estimate,
    other: Estimate | None = None,
    *,
    quantity: str,
    model: str,
    where: Mapping[str, Place],
    source: str,
    tolerance: float,
    reason: str,
    unit: str = "dB",
    scale: float = POWER_DECIBEL,
    grid: float = 0.0,
    role: Role = Role.FINDING,
    absolute: bool = False,
    among: int = 1,
) -> Number:
    """value - other, times the scale of the unit, beside zero; if absolute, value beside other itself.

    value, other: independent estimates, natural logarithms as a rule; without other, value is the difference already;
    quantity, model, where: the key of the number; scale: 10 / ln 10 for decibels of a power, 20 / ln 10 of an
    amplitude, 1 for the estimates themselves; grid: half-width that the grids leave, in the unit of the estimates;
    among: how many points of a range have intervals that hold at once.
    Raises ValueError where absolute has no other to stand beside.
    """
    if absolute and other is None:
        raise ValueError(f"{quantity!r} of {model!r} must have another estimate beside it, got absolute without other")
    apart = value if other is None else value.minus(other)
    return Number(
        quantity=quantity,
        model=model,
        where=where,
        value=scale * (value.value if absolute else apart.value),
        reference=scale * other.value if absolute and other else 0.0,
        source=source,
        tolerance=tolerance,
        reason=reason,
        unit=unit,
        grid=scale * grid,
        sample=scale * apart.half_width_among(among),
        role=role,
    )
