"""A model over its reference: what is left between two estimates, with the error of the grid and of the sample."""

from collections.abc import Mapping

from validation.analysis.evidence import Number, Place, Role
from validation.analysis.statistics import Estimate


def difference(
    model: Estimate,
    reference: Estimate,
    *,
    grid: float,
    scale: float,
    key: tuple[str, str, Mapping[str, Place]],
    source: str,
    tolerance: float,
    reason: str,
    unit: str = "dB",
    role: Role = Role.FINDING,
) -> Number:
    """model - reference, of natural logarithms, times the scale of the unit, beside zero.

    model, reference: independent estimates; grid: half-width that the grid of the reference leaves, in natural
    logarithms; scale: 10 / ln 10 for decibels of a power, 1 for the logarithm itself; key: quantity, model and where of
    the number; tolerance: in the unit.
    """
    quantity, name, where = key
    apart = model.minus(reference)
    return Number(
        quantity=quantity,
        model=name,
        where=where,
        value=scale * apart.value,
        reference=0.0,
        source=source,
        tolerance=tolerance,
        reason=reason,
        unit=unit,
        grid=scale * grid,
        sample=scale * apart.half_width,
        role=role,
    )
