"""The scene of a wheel on a rail whose shape across the track was measured: a profile in place of two radii."""

import math
from dataclasses import dataclass

from mdr.checks import positive
from validation.scenes.rail import RailScene
from validation.scenes.transverse_profile import TransverseProfile, fitted_radius
from validation.scenes.units import in_unit


@dataclass(frozen=True, kw_only=True)
class ProfiledRail(RailScene):
    """A wheel on a rail with a transverse profile.

    Boundary elements take the profile itself. All else takes `radii` of a fit: the ellipse of contact, linear theory,
    springs, and the bands and strips on which models are compared.

    profile: of both bodies together, zero and highest at y = 0 [m]. The radius across is not given: `crown_radius`
    becomes that of the fit over the contact, of both bodies, and `transverse_radius` is None. offset: where y = 0 of
    the wheel stands on the rail [m]. Other fields: as of `RailScene`. Raises ValueError, too, for a profile that has no
    such radius.
    """

    profile: TransverseProfile
    offset: float = 0.0

    def __post_init__(self) -> None:
        if self.transverse_radius is not None:
            raise ValueError(f"wheel.transverse_radius must be part of the profile, got {self.transverse_radius} m")
        for name in ("radius", "load"):
            positive(f"wheel.{name}", getattr(self, name))
        positive("modulus", self.modulus)
        fitted = fitted_radius(self.profile, along=self.radius, modulus=self.modulus, load=self.load)
        object.__setattr__(self, "crown_radius", fitted)
        super().__post_init__()

    def diagnose(self) -> tuple[str, ...]:
        """With what stands in for the profile."""
        return (f"{self.stand_in}.", *super().diagnose())

    @property
    def contact_place(self) -> str:
        """Where the contact lies, in words."""
        on_rail, on_wheel = (round(1e3 * y, 3) + 0.0 for y in (self.profile.at, self.profile.at - self.offset))
        inclined = f"{math.degrees(self.profile.inclination):.2g} degrees"
        return f"y = {on_rail:g} mm on the rail, {on_wheel:g} mm on the wheel, inclined by {inclined}"

    @property
    def stand_in(self) -> str:
        """What models of two radii assume, in words."""
        radius, half = (in_unit(length, "length", digits=3) for length in (self.radii[1], self.contact.across))
        return (
            f"the transverse profile of {self.profile.source} has a radius of {radius}, fitted over the contact, "
            f"{half} to both sides: boundary elements of compare take the profile, all other models that radius"
        )
