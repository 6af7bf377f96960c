"""The impedance of a rail that gives way under the contact force, and bodies that have it in a time loop.

Z(omega) = force over velocity at the point of contact, time as exp(i omega t), N s/m. A rail without an impedance here
is rigid. Its static deflection is no motion: only the change of the force moves it.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.checks import finite, positive
from validation.analysis.escapes import shortened

BODIES = 8
"""That stand for a free beam."""
FITTED = 20.0, 5000.0
"""Frequencies between which they do [Hz]."""
TAIL = 16.0
"""Outermost rates over the ends of that band: the bodies there stand for all beyond."""


class RailBody(NamedTuple):
    """m u'' + c u' = F - F_N; mass: m, positive [kg]; dashpot: c, to the inertial frame [N s/m]."""

    mass: float
    dashpot: float


@dataclass(frozen=True, kw_only=True)
class RailDashpot:
    """Z = c + i omega m. dashpot: c, positive [N s/m]; mass: m, zero or positive [kg]; ValueError for others."""

    dashpot: float
    mass: float = 0.0

    def __post_init__(self) -> None:
        positive("rail.impedance.dashpot", self.dashpot)
        if finite("rail.impedance.mass", self.mass) < 0:
            raise ValueError(f"rail.impedance.mass must be zero or positive, got {self.mass:g}")

    def impedance(self, omega: ArrayLike) -> NDArray[np.complex128]:
        """Z [N s/m] at angular frequencies [rad/s]."""
        return np.asarray(self.dashpot + 1j * np.asarray(omega, dtype=np.float64) * self.mass)

    def bodies(self, time_step: float) -> tuple[RailBody, ...]:
        """One body; without a mass it has c dt / 2, the least with which a dashpot follows the force in steps dt [s].

        Velocity Verlet then is u_(n+1) = u_n + dt (F_n - F_N) / c, of first order in dt.
        """
        return (RailBody(self.mass or self.dashpot * time_step / 2, self.dashpot),)

    @property
    def description(self) -> str:
        mass = f" and a mass of {self.mass:.4g} kg" if self.mass else ""
        return f"a dashpot of {self.dashpot:.4g} N s/m{mass}"


@dataclass(frozen=True, kw_only=True)
class FreeBeam:
    """An infinite Euler beam without a foundation, Z = 2 rho A c_B (1 + i), c_B = (EI omega^2 / rho A)^(1/4).

    A rail on its fastenings follows it above the frequency at which it decouples from the sleepers, some hundreds of
    hertz; below, a track is stiffer.

    Attributes
    ----------
    bending_stiffness : float
        EI [N m^2], positive.
    mass_per_length : float
        rho A [kg/m], positive.

    Raises
    ------
    ValueError
        If one of them is not positive.

    Notes
    -----
    Cremer, Heckl, Petersson, *Structure-Borne Sound*.

    Examples
    --------
    >>> from validation.scenes.rail_impedance import FreeBeam
    >>> f"{abs(FreeBeam(bending_stiffness=6.38e6, mass_per_length=60.2).impedance(4400)):.3g} N s/m"
    '2.04e+05 N s/m'
    """

    bending_stiffness: float
    mass_per_length: float

    def __post_init__(self) -> None:
        positive("rail.bending_stiffness", self.bending_stiffness)
        positive("rail.mass_per_length", self.mass_per_length)

    @property
    def factor(self) -> float:
        """K of Z = K sqrt(i omega), 2 sqrt 2 (rho A)^(3/4) EI^(1/4)."""
        return 2 * math.sqrt(2) * math.pow(self.mass_per_length, 0.75) * math.pow(self.bending_stiffness, 0.25)

    def impedance(self, omega: ArrayLike) -> NDArray[np.complex128]:
        """Z of the beam itself [N s/m] at angular frequencies [rad/s]."""
        return np.asarray(self.factor * np.sqrt(1j * np.asarray(omega, dtype=np.float64)))

    def bodies(self, time_step: float = 0.0) -> tuple[RailBody, ...]:
        """Bodies in series that have the mobility of the beam, within 1 % between `FITTED` frequencies.

        1 / sqrt(s) = (1 / pi) int_0^inf p^(-1/2) / (s + p) dp by the trapezoidal rule in ln p: a sum of g / (s + p),
        each of which is a mass K / g with a dashpot p K / g. All are positive, so that the rail never gives work.
        """
        low, high = (2 * math.pi * f for f in FITTED)
        rates = np.geomspace(low / TAIL, high * TAIL, BODIES)
        step = math.log(rates[1] / rates[0])
        weights = step / math.pi * np.sqrt(rates)
        # the sums over all rates below the first, and of mobilities above the last, are geometric series
        weights[[0, -1]] /= 1 - math.exp(-step / 2)
        masses = self.factor / weights
        return tuple(RailBody(*pair) for pair in zip(masses.tolist(), (rates * masses).tolist(), strict=True))

    @property
    def description(self) -> str:
        return f"a free beam, EI = {self.bending_stiffness:.4g} N m², {self.mass_per_length:.4g} kg/m"


RailImpedance = RailDashpot | FreeBeam


def read_impedance(impedance: object, beam: Mapping[str, float]) -> RailImpedance | None:
    """The value of `rail.impedance` of a scene file; None of a rigid rail.

    impedance: "rigid", "free beam", a number in N s/m, or a table of dashpot and mass; beam: the keys of a beam that
    are given. Raises ValueError that names the key.
    """
    name, keys = "rail.impedance", ("bending_stiffness", "mass_per_length")
    if impedance != "free beam" and beam:
        raise ValueError(f'rail.{next(iter(beam))} belongs to rail.impedance = "free beam", got {shortened(impedance)}')
    if impedance == "free beam":
        if missing := [f"rail.{key}" for key in keys if key not in beam]:
            raise ValueError(
                f'{" and ".join(missing)} must be given with {name} = "free beam", got none, as of 60E1: '
                "bending_stiffness = 6.38e6 in N m², mass_per_length = 60.2 in kg/m"
            )
        return FreeBeam(**beam)
    if impedance == "rigid":
        return None
    of_table = impedance if isinstance(impedance, dict) else {"dashpot": impedance}
    numbers = all(isinstance(value, int | float) and not isinstance(value, bool) for value in of_table.values())
    if not (numbers and {"dashpot"} <= set(of_table) <= {"dashpot", "mass"}):
        raise ValueError(
            f'{name} must be "rigid", "free beam", a dashpot in N s/m or {{ dashpot = 1.5e5, mass = 30 }} in N s/m and '
            f"kg, got {shortened(impedance)}"
        )
    return RailDashpot(**of_table)


def impedance_of_bodies(bodies: tuple[RailBody, ...], omega: ArrayLike) -> NDArray[np.complex128]:
    """1 / sum of 1 / (c + i omega m), of bodies in series [N s/m]."""
    w = np.asarray(omega, dtype=np.float64)
    return np.asarray(1 / sum(1 / (body.dashpot + 1j * w * body.mass) for body in bodies))
