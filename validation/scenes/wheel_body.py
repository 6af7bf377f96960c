"""A wheel by itself: its contact, its stiffness, its resonance; what scenes of a wheel share."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from validation.scenes.scene import ContactEllipse
from validation.theory.closed_forms import circular_punch_stiffness, hertz_approach, hertz_contact_radius
from validation.theory.wheel import eigenfrequency


@dataclass(frozen=True, kw_only=True)
class Wheel:
    """A rigid wheel on an elastic half-space, in static equilibrium on a smooth track.

    radius: R [m]; mass: M [kg]; modulus: E* [Pa]; load: F_N [N]; all positive, or else ValueError. Its speed is in the
    time step of the simulation, dx / v_0.
    """

    radius: float
    mass: float
    modulus: float
    load: float

    def __post_init__(self) -> None:
        for name in ("radius", "mass", "modulus", "load"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise ValueError(f"{name} must be finite and positive, got {value}")

    @property
    def approach(self) -> float:
        """d_N of Hertz [m]."""
        return hertz_approach(radius=self.radius, modulus=self.modulus, force=self.load)

    @property
    def contact_radius(self) -> float:
        """a = sqrt(R d_N) [m]."""
        return hertz_contact_radius(radius=self.radius, approach=self.approach)

    @property
    def stiffness(self) -> float:
        """k = 2 E* a [N/m]."""
        return circular_punch_stiffness(radius=self.contact_radius, modulus=self.modulus)

    @property
    def eigenfrequency(self) -> float:
        """omega_eigen = sqrt(2 a E* / M) [rad/s]."""
        return eigenfrequency(contact_radius=self.contact_radius, modulus=self.modulus, mass=self.mass)

    @property
    def smooth(self) -> dict[str, Any]:
        """Radius, modulus and approach of its smooth contact, as `mdr` and `bem3d` take them."""
        return {"radius": self.radius, "modulus": self.modulus, "approach": self.approach}


class OnHalfSpace:
    """Hertz's contact of a scene's `body`, a sphere or a wheel, where all is smooth."""

    @property
    def body(self) -> Wheel:
        """The body without its roughness; of unit mass where it has none."""
        raise NotImplementedError

    @property
    def approach(self) -> float:
        """d_N = (9 F_N^2 / (16 R E*^2))^(1/3) of Hertz [m]."""
        return self.body.approach

    @property
    def contact_radius(self) -> float:
        """a = sqrt(R d_N) [m]."""
        return self.body.contact_radius

    @property
    def contact_of_hertz(self) -> ContactEllipse:
        """Of the smooth body."""
        return ContactEllipse(self.contact_radius, self.contact_radius, self.approach, self.body.load)

    def diagnose_contact_radius(self, name: str = "wheel") -> Iterator[str]:
        """A contact as large as a part of the body is not on a half-space. name: of the body's table in a scene."""
        if self.contact_radius > self.body.radius / 10:
            yield (
                f"the contact radius is {self.contact_radius / self.body.radius:.3g} of {name}.radius, more than a "
                f"tenth: no half-space; are the units of {name}.load and material.youngs_modulus right?"
            )
