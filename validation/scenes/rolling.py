"""The scene of a wheel that rolls over rough ground: quasi-statically, or with a mass."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from validation.analysis.statistics import FloatArray
from validation.scenes.description import body_pairs, motion_pair, roughness_pairs
from validation.scenes.dynamic_wheel import WheelScene
from validation.scenes.material import Material, check_scene
from validation.scenes.measured import MeasuredHeights, check_covers
from validation.scenes.roughness import Roughness, RoughSurface, check_band
from validation.scenes.scene import MOVING, ROLLING, ContactEllipse, Pairs, SceneDefaults, SceneQuantity
from validation.scenes.units import in_unit
from validation.scenes.wheel_body import DampedWheel, OnHalfSpace, check_damping, diagnose_short_waves, no_steady_answer

if TYPE_CHECKING:
    from validation.scenes.rolling_quantity import RollingQuantity

MOST_WAVES = 1000
"""To a contact radius: shorter ones no grid of a wheel holds, and linear theory takes hours over them."""


@dataclass(frozen=True, kw_only=True)
class RollingScene(OnHalfSpace, SceneDefaults):
    """Smooth wheel that rolls over rough ground, with a mass or at a constant approach.

    Parameters
    ----------
    name : str
        One line of text.
    radius : float
        Radius R of the wheel [m].
    load : float
        Static load F_N [N].
    modulus : float
        Contact modulus E* [Pa].
    ground : Roughness or MeasuredHeights
        Isotropic roughness, or heights whose first axis is along the track.
    mass, speed : float or None, optional
        Mass M [kg] and speed v0 [m/s], both or neither. Without them the wheel keeps its approach.
    material : Material or None, optional
        What E* is made of, None where only ``modulus`` is known.
    damping : float, optional
        Damping ratio of a wheel with a mass, as of `WheelScene`. None by default.

    Raises
    ------
    ValueError, TypeError
        If a value is out of range; the message names the key of a scene file.

    Examples
    --------
    >>> scene = validation.load_scene("rolling_wheel")
    >>> print(f"h / d = {scene.roughness_ratio:.2g}")
    h / d = 0.064
    """

    kind: ClassVar[str] = "wheel"
    size_key: ClassVar[str] = "wheel.radius"
    roughness_key: ClassVar[str] = "rail.roughness"

    name: str
    radius: float
    load: float
    modulus: float
    ground: RoughSurface
    mass: float | None = None
    speed: float | None = None
    material: Material | None = None
    damping: float = 0.0

    def __post_init__(self) -> None:
        check_scene(self, ("wheel.radius", "wheel.load"), ("wheel.mass", "wheel.speed"))
        if (self.mass is None) != (self.speed is None):
            raise ValueError(f"wheel.mass and wheel.speed must both be given or neither, got {self.mass}, {self.speed}")
        check_damping(self.damping, self.mass)
        if isinstance(self.ground, MeasuredHeights):
            a = self.contact_radius
            check_covers("rail.heights", self.ground, (4 * math.pi * a, 3 * a), a)
        else:
            check_band("rail.roughness", self.ground)
            _check_waves(self.ground, self.contact_radius)

    @classmethod
    def of_wheel(cls, scene: WheelScene) -> "RollingScene":
        """Of a dynamic wheel whose rail alone is rough. Raises ValueError for another."""
        if scene.rail is None or scene.wheel is not None:
            raise ValueError(f"scene {scene.name!r} must have a rough rail and a smooth wheel to be compared")
        same = ("name", "radius", "load", "modulus", "mass", "speed", "material", "damping")
        return cls(ground=scene.rail, **{name: getattr(scene, name) for name in same})

    @property
    def body(self) -> DampedWheel:
        """The wheel; of unit mass where it has none."""
        same = {name: getattr(self, name) for name in ("radius", "modulus", "load", "damping")}
        return DampedWheel(mass=self.mass or 1.0, **same)

    @property
    def quantities(self) -> tuple[SceneQuantity, ...]:
        """Of the motion where it moves, and of the force on a wheel that keeps its approach."""
        return ROLLING if self.mass is None else (*MOVING, *ROLLING)

    def bands(self, quantity: str) -> FloatArray:
        """Centres of the one-third octaves [rad/m]. ValueError where there is none."""
        return self._asked(quantity).bands.centres

    @property
    def smooth_contact(self) -> ContactEllipse:
        """Of Hertz."""
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
        from validation.scenes.rolling_quantity import RollingQuantity

        return RollingQuantity(self, quantity)

    def describe(self) -> Pairs:
        """Body, contact, motion and roughness."""
        return (
            *body_pairs("wheel", self.radius, self),
            motion_pair(self),
            *roughness_pairs(self, {"waves": self.ground}),
        )

    @property
    def roughness_ratio(self) -> float:
        """h / d [-]."""
        return self.ground.rms / self.approach

    def diagnose(self) -> tuple[str, ...]:
        """What may be wrong about this scene though it is valid, in sentences with numbers."""
        found = list(self.ground.notes())
        if self.roughness_ratio > 1 / 3:
            found.append(f"the roughness is {self.roughness_ratio:.3g} of the approach: the wheel may lose contact.")
        if self.mass is not None:
            found += diagnose_short_waves(self.body, [self.ground])
        return (*found, *self.diagnose_contact_radius())

    def no_steady_answer(self) -> str:
        """Why the motion of a wheel with a mass has no level that the distance leaves alone; empty where it has."""
        return "" if self.speed is None else no_steady_answer(self.body, self.speed, [self.ground])


def _check_waves(rough: Roughness, a: float) -> None:
    if rough.shortest * MOST_WAVES < a * (1 - 1e-9):
        least, got = (in_unit(wave, "length", digits=3) for wave in (a / MOST_WAVES, rough.shortest))
        raise ValueError(
            f"rail.roughness.shortest must be at least {least}, {MOST_WAVES} waves to the contact radius, got {got}"
        )
