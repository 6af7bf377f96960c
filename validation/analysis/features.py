"""Features that several cases judge: one tolerance each, with its reason, whichever model or scene it is found in."""

from collections.abc import Mapping
from dataclasses import dataclass

from validation.analysis.evidence import Number, Place, Role


@dataclass(frozen=True, kw_only=True)
class JudgedFeature:
    """What is judged, and how closely.

    quantity: its name; tolerance: in the unit, or as a fraction of the reference if relative; reason: for it.
    """

    quantity: str
    tolerance: float
    reason: str
    unit: str = "-"
    relative: bool = False

    def number(
        self,
        value: float,
        reference: float,
        source: str,
        *,
        model: str = "",
        where: Mapping[str, Place] | None = None,
        grid: float = 0.0,
        sample: float = 0.0,
        role: Role = Role.FINDING,
    ) -> Number:
        """Beside a reference, within the tolerance of the feature."""
        return Number(
            quantity=self.quantity,
            model=model,
            where=where or {},
            value=value,
            reference=reference,
            source=source,
            tolerance=self.tolerance * (abs(reference) if self.relative else 1.0),
            reason=self.reason,
            unit=self.unit,
            grid=grid,
            sample=sample,
            role=role,
        )
