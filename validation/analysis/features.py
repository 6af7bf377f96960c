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


FEATURES: Mapping[str, JudgedFeature] = {
    "peak": JudgedFeature(
        quantity="peak ω_eigen",
        tolerance=0.005,
        relative=True,
        unit="rad/s",
        reason="0.5 %: a small part of the spacing of spectral lines, between which the peak is interpolated",
    ),
    "jump": JudgedFeature(
        quantity="jump",
        tolerance=0.03,
        relative=True,
        unit="rad/s",
        reason="3 %: half of the main lobe of Hann's window, two lines of a record of 65 longest waves",
    ),
    "slope": JudgedFeature(
        quantity="slope of region 3",
        tolerance=0.05,
        reason="0.05: 1 %, a difference of slope that is hardly visible on a double-logarithmic plot",
    ),
    "period": JudgedFeature(
        quantity="period of the oscillation",
        tolerance=0.01,
        relative=True,
        unit="rad/s",
        reason="1 %: roughness at the edge of the contact changes the contact length to second order",
    ),
    "contrast": JudgedFeature(
        quantity="contrast of the oscillation",
        tolerance=3.0,
        unit="dB",
        reason="3 dB: maxima over zeros lower by a factor of two, hardly visible over decades",
    ),
    "floor": JudgedFeature(
        quantity="floor over predicted", tolerance=0.1, reason="10 %: 0.4 dB of a level, far below what a plot shows"
    ),
    "break": JudgedFeature(
        quantity="break over predicted",
        tolerance=0.1,
        reason="10 %: a floor 0.4 dB off alone moves the break by 3 to 6 %",
    ),
    "lift-off": JudgedFeature(
        quantity="h / d of the first lift-off",
        tolerance=0.2,
        relative=True,
        reason="20 % of h / d: heights of a sweep lie about as far apart",
    ),
    "level": JudgedFeature(
        quantity="level",
        tolerance=1.0,
        unit="dB",
        reason="1 dB: a third of the 3 dB accepted for one-third octaves of rolling noise",
    ),
}
"""Of the wheel and of its contact force; levels are over a reference, in one region of the spectrum."""
