"""The scene of a wheel that rolls over rough ground: quasi-statically, or with a mass, also along a track in time.

`RollingQuantity` is what is asked of it: levels in bands, of force or acceleration, and what linear theory expects.
"""

import math
import warnings
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import ClassVar

import numpy as np

from validation.analysis.spectra import Bands
from validation.analysis.statistics import FloatArray
from validation.scenes.description import body_pairs, motion_pair, roughness_pairs
from validation.scenes.material import Material, check_scene
from validation.scenes.measured_heights import MeasuredHeights, check_covers
from validation.scenes.roughness import Roughness, RoughSurface, check_band
from validation.scenes.scene import (
    LATER,
    MOVING,
    ROLLING,
    ContactEllipse,
    Pairs,
    SceneDefaults,
    SceneQuantity,
)
from validation.scenes.units import in_unit
from validation.scenes.wheel_body import (
    DampedWheel,
    OnTrack,
    check_damping,
    check_track,
    diagnose_short_waves,
    diagnose_track,
    force_on_the_way,
    no_steady_answer,
)
from validation.theory.half_space import on_panels
from validation.theory.rolling import dynamic_stiffness, force_spectrum_1d, force_spectrum_3d, force_variance

MOST_WAVES = 1000
"""To a contact radius: shorter ones no grid of a wheel holds, and linear theory takes hours over them."""


@dataclass(frozen=True, kw_only=True, repr=False)
class RollingScene(OnTrack, SceneDefaults):
    """Wheel that rolls along a rough rail, with a mass or at a constant approach.

    Parameters
    ----------
    name : str
        One line of text.
    radius : float
        Radius R of the wheel [m].
    load : float
        Static load F_N [N].
    modulus : float, optional
        Contact modulus E* [Pa], by default that of the material.
    ground : Roughness, MeasuredHeights or None
        Isotropic roughness of the rail, or heights whose first axis is along the track. None is a smooth rail, which
        needs a track.
    mass, speed : float or None, optional
        Mass M [kg] and speed v0 [m/s], both or neither. Without them the wheel keeps its approach.
    material : Material or None, optional
        What E* is made of, None where only ``modulus`` is known.
    damping : float, optional
        Damping ratio zeta of a wheel with a mass, of critical, in [0, 1): a dashpot between wheel and inertial frame,
        c = 2 zeta M omega_eigen, which acts while contact is lost, too. None by default.
    wheel : Roughness or None, optional
        Roughness of the wheel, which needs a track; None where it is smooth.
    distance : float or None, optional
        Of a track: shortest distance to roll in time before it begins again [m].
    springs : int or None, optional
        Of a track: springs to a contact radius.

    Raises
    ------
    ValueError, TypeError
        If a value is out of range; the message names the key of a scene file.

    Notes
    -----
    A track, which is ``distance`` and ``springs``, is for simulations in time, as those of ``report --scene``.
    `compare` has no need of one, and leaves it out.

    Examples
    --------
    >>> scene = validation.load_scene("rolling_wheel")
    >>> print(f"h / d = {scene.roughness_ratio:.2g}")
    h / d = 0.064
    >>> wheel = validation.load_scene("table_14_1")
    >>> print(f"contact radius {wheel.contact_radius:.3g} m, time step {wheel.time_step:.3g} s")
    contact radius 0.00198 m, time step 9.91e-07 s
    """

    kind: ClassVar[str] = "wheel"
    size_key: ClassVar[str] = "wheel.radius"
    roughness_key: ClassVar[str] = "rail.roughness"

    name: str
    radius: float
    load: float
    modulus: float = None  # type: ignore[assignment]  # that of the material
    ground: RoughSurface | None
    mass: float | None = None
    speed: float | None = None
    material: Material | None = None
    damping: float = 0.0
    wheel: Roughness | None = field(default=None, metadata=LATER)
    distance: float | None = field(default=None, metadata=LATER)
    springs: int | None = field(default=None, metadata=LATER)

    def __post_init__(self) -> None:
        if not isinstance(self.material, Material | None):
            raise TypeError(f"material must be a Material, got {self.material!r}")
        if self.modulus is None:
            if self.material is None:
                raise ValueError("modulus must be given, or a material which has it, got neither")
            object.__setattr__(self, "modulus", self.material.modulus)
        check_scene(self, ("wheel.radius", "wheel.load"), ("wheel.mass", "wheel.speed"))
        if (self.mass is None) != (self.speed is None):
            raise ValueError(f"wheel.mass and wheel.speed must both be given or neither, got {self.mass}, {self.speed}")
        check_damping(self.damping, self.mass)
        check_track(self)
        if self.has_track:
            return
        if isinstance(self.ground, MeasuredHeights):
            a = self.contact_radius
            check_covers("rail.heights", self.ground, (4 * math.pi * a, 3 * a), a)
        elif self.ground is None:
            raise TypeError("rail.roughness must be given where there is no track, or rail.heights, got None")
        else:
            check_band("rail.roughness", self.ground)
            _check_waves(self.ground, self.contact_radius)

    @classmethod
    def of_wheel(cls, scene: "RollingScene") -> "RollingScene":
        """Earlier name of `for_compare`, for one release."""
        warnings.warn(
            "RollingScene.of_wheel(scene) is scene.for_compare() now; the earlier name goes with the next release",
            FutureWarning,
            stacklevel=2,
        )
        return scene.for_compare()

    def for_compare(self) -> "RollingScene":
        """The scene without its track. Raises ValueError unless the rail alone is rough, of waves of any grid."""
        if not self.has_track:
            return self
        if not self.rail_alone_is_rough:
            raise ValueError(f"scene {self.name!r} must have a rough rail and a smooth wheel to be compared")
        return replace(self, distance=None, springs=None)

    @property
    def body(self) -> DampedWheel:
        """The wheel; of unit mass where it has none."""
        same = {name: getattr(self, name) for name in ("radius", "modulus", "load", "damping")}
        return DampedWheel(mass=self.mass or 1.0, **same)

    @property
    def quantities(self) -> tuple[SceneQuantity, ...]:
        """Quantities of the force at a prescribed approach; with a mass, those of the motion come first."""
        return ROLLING if self.mass is None else (*MOVING, *ROLLING)

    def bands(self, quantity: str) -> FloatArray:
        """Centres of the one-third octaves [rad/m]. ValueError where there is none."""
        return self._asked(quantity).bands.centres

    @property
    def smooth_contact(self) -> ContactEllipse:
        """The contact of Hertz of the smooth wheel."""
        return self.contact_of_hertz

    @property
    def mean_pressure(self) -> float:
        """F / (pi a^2) [Pa]."""
        return self.contact_of_hertz.mean_pressure

    def no_answer(self, quantity: str) -> str:
        """Why there is no level, whatever the model: no steady motion, or no band; empty where there is one."""
        return self._asked(quantity).no_answer

    def _asked(self, quantity: str) -> "RollingQuantity":
        # imported here, since a quantity is of a scene
        from validation.scenes.rolling import RollingQuantity

        return RollingQuantity(self, quantity)

    def describe(self) -> Pairs:
        """Body, contact, motion and roughness."""
        waves = {"waves of the rail": self.ground, "waves of the wheel": self.wheel}
        return (
            *body_pairs("wheel", self.radius, self),
            motion_pair(self),
            *roughness_pairs(self, waves if self.has_track else {"waves": self.ground}),
        )

    @property
    def rms(self) -> float:
        """sqrt(h_rail^2 + h_wheel^2), the height of both together, zero where smooth [m]."""
        return math.hypot(*(surface.rms for surface in self.rough_surfaces.values()))

    @property
    def slope_along(self) -> float:
        """Root mean square slope of both together along the track [-]."""
        return math.hypot(*(surface.slope_along for surface in self.rough_surfaces.values()))

    @property
    def roughness_ratio(self) -> float:
        """The rms height over the approach, h / d [-]."""
        return self.rms / self.approach

    def diagnose(self) -> tuple[str, ...]:
        """What may be wrong about this scene though it is valid, in sentences with numbers."""
        surfaces = list(self.rough_surfaces.values())
        short = diagnose_short_waves(self.body, surfaces) if self.has_motion and surfaces else ()
        if self.has_track:
            return *diagnose_track(self), *short
        notes = [note for surface in surfaces for note in surface.notes()]
        if self.roughness_ratio > 1 / 3:
            notes.append(f"the roughness is {self.roughness_ratio:.3g} of the approach: the wheel may lose contact.")
        return *notes, *short, *self.diagnose_contact_radius()

    def no_steady_answer(self) -> str:
        """Why the motion of a wheel with a mass has no level that the distance leaves alone; empty where it has."""
        surfaces = list(self.rough_surfaces.values())
        return no_steady_answer(self.body, self.speed, surfaces) if self.speed is not None and surfaces else ""


def _check_waves(rough: Roughness, a: float) -> None:
    if rough.shortest * MOST_WAVES < a * (1 - 1e-9):
        least, got = (in_unit(wave, "length", digits=3) for wave in (a / MOST_WAVES, rough.shortest))
        raise ValueError(
            f"rail.roughness.shortest must be at least {least}, {MOST_WAVES} waves to the contact radius, got {got}"
        )


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
