"""What is asked of a wheel that rolls: levels in bands, of force or acceleration, and what linear theory expects."""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from validation.analysis.spectra import Bands
from validation.analysis.statistics import FloatArray
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import RoughSurface
from validation.scenes.scene import MOVING, ROLLING
from validation.scenes.wheel_body import force_on_the_way
from validation.theory.half_space import on_panels
from validation.theory.rolling import force_spectrum_1d, force_spectrum_3d, force_variance
from validation.theory.wheel import dynamic_stiffness

QUANTITIES = tuple(map(str, (*ROLLING, *MOVING)))
"""Keys of all that a wheel may be asked."""
NODES = 8
"""Of Gauss and Legendre, on half a wave of sin^2."""
PANEL = 1.4
"""Ratio of the ends of a panel at the most."""
WAVES = 4
"""Of the length that was measured, in the longest band."""


@dataclass(frozen=True)
class RollingQuantity:
    """What is wanted of a wheel that rolls.

    Levels in one-third octaves from the longest to the shortest wave, root mean square in each, [N] or [m/s^2]; of the
    acceleration only those an octave and more above the resonance, since nothing need damp that; or one of all these.
    """

    scene: RollingScene
    name: str

    @property
    def ground(self) -> RoughSurface:
        """What is rough; ValueError for a smooth rail."""
        return self.scene.rough_ground

    @property
    def dynamic(self) -> bool:
        return self.name.startswith("acceleration")

    @cached_property
    def no_answer(self) -> str:
        """Why there is no level of what is wanted, whatever the model; empty where there is one."""
        return (self.scene.no_steady_answer() if self.dynamic else "") or self._no_band

    @cached_property
    def amplification(self) -> float:
        """The rms force on a moving wheel over that on one at a prescribed approach, at least one [-].

        Near its resonance a wheel presses deeper than roughness alone, and leaves linear theory earlier.
        """
        if not self.dynamic or self.scene.speed is None:
            return 1.0
        still = float(replace(self, name="force-rms").expected(one_dimensional=False)[0])
        return max(1.0, force_on_the_way(self.scene.body, self.scene.speed, [self.ground]) / still)

    @property
    def whole(self) -> bool:
        return self.name.endswith("rms")

    @property
    def q_max(self) -> float:
        """The shortest wave that counts: of measured heights, four of their points [rad/m]."""
        return self.ground.q_resolved

    @cached_property
    def bands(self) -> Bands:
        """The bands of wavenumbers along the track that have levels [rad/m]. Raises ValueError where none is left."""
        if self.name == "force-rms":
            return Bands((0.0, math.inf))
        if self._no_band:
            raise ValueError(self._no_band)
        edges = self._edges
        return Bands((edges[0], edges[-1])) if self.whole else Bands(edges)

    @property
    def _edges(self) -> tuple[float, ...]:
        """Edges of the one-third octaves that are left [rad/m]; empty or one where no band is."""
        first = max(self._longest_counted, self._above_resonance)
        return Bands.around(math.pi / self.scene.contact_radius, first, self.q_max).edges if first < self.q_max else ()

    @property
    def _longest_counted(self) -> float:
        """The longest wave that counts: of measured heights, a quarter of their length [rad/m]."""
        ground = self.ground
        return WAVES * ground.q_min if ground.is_single else ground.q_min

    @property
    def longest_moving(self) -> float:
        """The longest wave of the ground that counts: of a moving wheel, an octave above its resonance [rad/m]."""
        return max(self.ground.q_min, self._above_resonance)

    @property
    def _above_resonance(self) -> float:
        """The wave an octave above the resonance of a wheel with a mass [rad/m]."""
        return 2 * self.scene.body.eigenfrequency / (self.scene.speed or 1.0) if self.dynamic else 0.0

    @cached_property
    def _no_band(self) -> str:
        """Why no one-third octave is left, and what would help; empty where one is."""
        if self.name == "force-rms" or len(self._edges) > 1:
            return ""
        if self._above_resonance > self._longest_counted:
            end, remedy = "an octave above the resonance", "a higher speed, a larger mass or shorter waves"
        elif self.ground.is_single:
            end, remedy = f"{WAVES} waves on the measured length", "a longer track or points closer together"
        else:
            end, remedy = "the longest", "a wider band of roughness"
        first = max(self._longest_counted, self._above_resonance)
        return (
            f"no whole one-third octave of waves lies between {first:.3g} rad/m, {end}, and {self.q_max:.3g} rad/m, "
            f"the shortest that counts; {remedy} would leave one"
        )

    def transfer(self, q: FloatArray) -> FloatArray:
        """The quantity over the force: 1, or omega^2 / |k - M omega^2 + i c omega| with omega = q v0 [- or 1/kg]."""
        if not self.dynamic:
            return np.ones_like(q)
        body = self.scene.body
        omega = q * (self.scene.speed or 0.0)
        moved = dynamic_stiffness(omega, stiffness=body.stiffness, mass=body.mass, damping=body.damping)
        return np.asarray(omega**2 / np.abs(moved))

    def expected(self, one_dimensional: bool) -> FloatArray:
        """Levels by linear theory, of the spectrum [N] or [m/s^2]; the variance of the force is the same in both."""
        ground, found = self.ground, []
        contact = {"contact_radius": self.scene.contact_radius, "modulus": self.scene.modulus}
        if self.name == "force-rms":
            return np.array([math.sqrt(force_variance(ground.c2d, edges=ground.edges, **contact))])
        for q, weight in self._quadratures:
            if one_dimensional:
                density = force_spectrum_1d(q, lambda s: np.pi * np.abs(s) * ground.c2d(s), **contact)
            else:
                density = force_spectrum_3d(q, ground.c2d, edges=ground.edges, **contact)
            found.append(math.sqrt(2 * float(np.sum(weight * density * self.transfer(q) ** 2))))
        return np.array(found)

    @property
    def nodes(self) -> int:
        """The number of nodes of the quadrature over all bands."""
        if self.name == "force-rms" or self._no_band:
            return NODES
        return sum(q.size for q, _ in self._quadratures)

    @cached_property
    def _quadratures(self) -> list[tuple[FloatArray, FloatArray]]:
        """Nodes of Gauss and Legendre in each band, and their weights.

        On panels no longer than half a wave of sin^2(q a), nor than what a power law bends in.
        """
        found, a = [], self.scene.contact_radius
        for low, high in pairwise(self.bands.edges):
            waves = np.linspace(low, high, 2 + math.floor((high - low) * a / math.pi))
            powers = np.geomspace(low, high, 2 + math.floor(math.log(high / low) / math.log(PANEL)))
            found.append(on_panels(np.union1d(waves, powers), NODES))
        return found
