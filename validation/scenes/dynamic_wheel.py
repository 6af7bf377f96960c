"""The scene of a wheel that rolls along a rough rail: what it is made of, what follows from that, where it is read."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from scipy.fft import next_fast_len

from mdr.checks import count
from validation.engine.street import objects_of_houses
from validation.scenes.bundled import bundled, path_of
from validation.scenes.description import body_pairs, motion_pair, roughness_pairs
from validation.scenes.material import Material, check_scene, material_of
from validation.scenes.printable import shortened
from validation.scenes.reader import Reader, errors_of_file, table, tables_of, values
from validation.scenes.roughness import Roughness, check_band, roughness_of
from validation.scenes.scene import Pairs
from validation.scenes.wheel_body import DampedWheel, OnHalfSpace, check_damping, diagnose_short_waves, no_steady_answer

KEYS = ("wheel.radius", "wheel.mass", "wheel.load", "wheel.speed", "simulation.distance")
"""Of what must be positive."""
MAX_POINTS = 10**7
"""Springs of a track of eighty megabytes, of which an ensemble has dozens: of more, one is a day of time steps."""

MIN_SPRINGS_PER_WAVE = 4
"""To a wave: with fewer its curvature is off."""
MIN_WAVES_PER_TRACK = 10
"""To a track: with fewer the longest waves are a handful of lines in a spectrum."""
MAX_PLAUSIBLE_RMS = 1e-4
"""Heights in metres that no rolling surface has."""


@dataclass(frozen=True, kw_only=True)
class WheelScene(OnHalfSpace):
    """Wheel with a mass that rolls along a rail; either of them rough or smooth.

    Parameters
    ----------
    name : str
        One line of text.
    radius : float
        Radius R of the wheel [m].
    mass : float
        Mass M [kg].
    load : float
        Static load F_N [N].
    speed : float
        Speed v0 [m/s].
    material : Material
        What wheel and rail are made of.
    rail, wheel : Roughness or None
        Roughness of each, None where smooth.
    distance : float
        Shortest distance to roll before the track begins again [m].
    springs : int
        Springs to a contact radius.
    damping : float, optional
        Damping ratio zeta, of critical, in [0, 1): a dashpot between wheel and inertial frame, c = 2 zeta M
        omega_eigen, which acts while contact is lost, too. None by default.

    Raises
    ------
    ValueError, TypeError
        If a value is out of range; the message names the key of a scene file.

    Examples
    --------
    >>> wheel = validation.load_wheel_scene("table_14_1")
    >>> print(f"contact radius {wheel.contact_radius:.3g} m, time step {wheel.time_step:.3g} s")
    contact radius 0.00198 m, time step 9.91e-07 s
    """

    name: str
    radius: float
    mass: float
    load: float
    speed: float
    material: Material
    rail: Roughness | None
    wheel: Roughness | None
    distance: float
    springs: int
    damping: float = 0.0

    def __post_init__(self) -> None:
        if not isinstance(self.material, Material):
            raise TypeError(f"material must be a Material, got {self.material!r}")
        check_scene(self, KEYS)
        count("simulation.springs", self.springs, least=1)
        check_damping(self.damping, self.mass)
        for key, rough in self._rough.items():
            check_band(key, rough)
        _check_lengths(self)

    @property
    def modulus(self) -> float:
        """E* of wheel and rail [Pa]."""
        return self.material.modulus

    @property
    def body(self) -> DampedWheel:
        """The wheel without its roughness."""
        same = ("radius", "mass", "modulus", "load", "damping")
        return DampedWheel(**{name: getattr(self, name) for name in same})

    @property
    def stiffness(self) -> float:
        """k = 2 E* a [N/m]."""
        return self.body.stiffness

    @property
    def eigenfrequency(self) -> float:
        """omega = sqrt(2 a E* / M) [rad/s]."""
        return self.body.eigenfrequency

    @property
    def jump(self) -> float:
        """omega = q_min v0 of the longest wave, on the rail or the wheel [rad/s]; ValueError if both are smooth."""
        return min(rough.q_min for rough in self._one_or_both()) * self.speed

    @property
    def cutoff(self) -> float:
        """omega = q_max v0 of the shortest wave, on the rail or the wheel [rad/s]; ValueError if both are smooth."""
        return max(rough.q_max for rough in self._one_or_both()) * self.speed

    @property
    def rms(self) -> float:
        """sqrt(h_rail^2 + h_wheel^2), the height of both together, zero where smooth [m]."""
        return math.hypot(*(rough.rms for rough in self._rough.values()))

    @property
    def slope_along(self) -> float:
        """Root mean square slope of both together along the track [-]."""
        return math.hypot(*(rough.slope_along for rough in self._rough.values()))

    @property
    def spacing(self) -> float:
        """dx = a / springs [m]."""
        return self.contact_radius / self.springs

    @property
    def points(self) -> int:
        """Springs of the track: those on the distance, and more up to the next length that an FFT is fast at."""
        return int(next_fast_len(math.ceil(self.distance / self.spacing)))

    @property
    def length(self) -> float:
        """points dx, the period of the track [m]."""
        return self.points * self.spacing

    @property
    def time_step(self) -> float:
        """dt = dx / v0 [s]."""
        return self.spacing / self.speed

    @property
    def period_length(self) -> float:
        """2 pi v0 / omega_eigen, rolled in a natural period [m]."""
        return 2 * math.pi * self.speed / self.eigenfrequency

    @property
    def oscillation_period(self) -> float:
        """pi v0 / a, of sin^2(q a) in the spectrum [rad/s]."""
        return math.pi * self.speed / self.contact_radius

    @property
    def circumference_points(self) -> int:
        """2 pi R / dx, rounded."""
        return round(2 * math.pi * self.radius / self.spacing)

    def describe(self) -> Pairs:
        """Body, contact, motion and roughness."""
        rough = {"waves of the rail": self.rail, "waves of the wheel": self.wheel}
        return *body_pairs("wheel", self.radius, self), motion_pair(self), *roughness_pairs(self, rough)

    def diagnose(self) -> tuple[str, ...]:
        """What may be wrong about this scene though it is valid, in sentences with numbers."""
        short = diagnose_short_waves(self.body, list(self._rough.values())) if self._rough else ()
        return (*_diagnose_roughness(self), *_diagnose_motion(self), *short)

    def no_steady_answer(self) -> str:
        """Why the motion has no level that the distance leaves alone, in a sentence; empty where it has."""
        return no_steady_answer(self.body, self.speed, list(self._rough.values())) if self._rough else ""

    @property
    def _rough(self) -> dict[str, Roughness]:
        """Each roughness, by its key in a scene file."""
        both = {"rail.roughness": self.rail, "wheel.roughness": self.wheel}
        return {key: each for key, each in both.items() if each is not None}

    def _one_or_both(self) -> Iterable[Roughness]:
        if not self._rough:
            raise ValueError(f"scene {self.name!r} must have a rough rail or wheel for this, got both smooth")
        return self._rough.values()


def bundled_wheels() -> tuple[str, ...]:
    """Names of the shipped scenes of a dynamic wheel."""
    return tuple(name for name in bundled() if "mass" in tables_of(path_of(name)).get("wheel", {}))


def load_wheel_scene(scene: str | Path) -> WheelScene:
    """Scene of a wheel with a mass, whose own roughness is allowed: what ``report --scene`` takes.

    Parameters
    ----------
    scene : str or Path
        Path of a scene file, or the name of a shipped scene: "rough_wheel" or "table_14_1".

    Returns
    -------
    WheelScene
        The wheel, both roughnesses, and the distance to roll.

    Raises
    ------
    ValueError
        If no shipped scene has the name, or a value of the file is missing, unknown or out of range; the message
        names it.
    OSError
        If the file cannot be read.

    Examples
    --------
    >>> wheel = validation.load_wheel_scene("table_14_1")
    >>> print(f"{wheel.eigenfrequency:.4g} rad/s")
    1369 rad/s
    """
    path = path_of(scene)
    tables = tables_of(path)
    with errors_of_file(path):
        for reader in objects_of_houses("scene"):
            if reader.reads(tables):
                raise ValueError(f"wheel and rail must be those of a dynamic wheel, got {reader.what}")
        return wheel_of(tables)


def wheel_of(tables: dict[str, Any]) -> WheelScene:
    """The scene in the tables of a file."""
    found = table(SCENE, ("rail",), "", tables)
    wheel, rail = found["wheel"], found.get("rail", {})
    return WheelScene(
        name=found["name"],
        wheel=wheel.pop("roughness", None),
        rail=rail.get("roughness"),
        **wheel,
        material=found["material"],
        **found["simulation"],
    )


ROUGH: dict[str, Reader] = {"roughness": roughness_of}
WHEEL = values("radius", "mass", "load", "speed", "damping") | ROUGH
SCENE: dict[str, Reader] = {
    **values("name"),
    "wheel": partial(table, WHEEL, ("damping", "roughness")),
    "material": material_of,
    "rail": partial(table, ROUGH, tuple(ROUGH)),
    "simulation": partial(table, values("distance", "springs"), ()),
}
"""How each value of a scene file is read."""


def _check_lengths(scene: WheelScene) -> None:
    """Check the lengths of contact, track and waves against each other."""
    a, distance, circumference = scene.contact_radius, scene.distance, 2 * math.pi * scene.radius
    if a >= scene.radius:
        raise ValueError(f"wheel.load must leave a contact smaller than the wheel, {scene.radius:g} m, got {a:g} m")
    if distance <= 2 * a:
        raise ValueError(f"simulation.distance must be longer than the contact, {2 * a:g} m, got {distance:g} m")
    most = MAX_POINTS * a / max(distance, circumference)
    if scene.springs > most:
        raise ValueError(
            f"simulation.springs must be at most {most:.0f} on such a track, got {shortened(scene.springs)}"
        )
    for key, rough in scene._rough.items():
        longest, shortest = rough.longest, rough.shortest
        period = scene.length if key.startswith("rail") else scene.circumference_points * scene.spacing
        if distance <= longest:
            track = f"longer than {key}.longest, {longest:g} m"
            raise ValueError(f"simulation.distance must be {track}, got {distance:g} m")
        if shortest < 2 * scene.spacing:
            raise ValueError(f"{key}.shortest must hold two springs, {2 * scene.spacing:g} m, got {shortest:g} m")
        if math.floor(period / shortest) < math.ceil(period / longest):
            raise ValueError(
                f"{key}.shortest must leave a wave that fits a period of {period:g} m a whole number of times, "
                f"got waves from {shortest:g} m to {longest:g} m"
            )


def _diagnose_roughness(scene: WheelScene) -> Iterator[str]:
    circumference = 2 * math.pi * scene.radius
    for key, rough in scene._rough.items():
        springs, waves = rough.shortest / scene.spacing, scene.distance / rough.longest
        if springs < MIN_SPRINGS_PER_WAVE:
            few = f"{springs:.3g} springs, fewer than {MIN_SPRINGS_PER_WAVE}"
            yield f"{key}.shortest holds {few}: its waves are not resolved."
        if waves < MIN_WAVES_PER_TRACK:
            yield (
                f"simulation.distance holds {waves:.3g} waves of {key}.longest, fewer than {MIN_WAVES_PER_TRACK}: "
                "the low end of the spectrum has few waves."
            )
        if rough.rms > MAX_PLAUSIBLE_RMS:
            yield f"{key}.rms is {rough.rms:.3g} m, more than {MAX_PLAUSIBLE_RMS:g} m: is its unit right?"
    if scene.wheel is not None and scene.wheel.longest > circumference / 2:
        yield (
            f"wheel.roughness.longest is {scene.wheel.longest:.3g} m, more than half of the circumference of "
            f"{circumference:.3g} m: a whole number of waves must fit the circumference."
        )


def _diagnose_motion(scene: WheelScene) -> Iterator[str]:
    omega_dt = scene.time_step * scene.eigenfrequency
    if omega_dt > 0.2:
        yield (
            f"a time step is {omega_dt:.3g} over the eigenfrequency, more than 0.2, and 2 is unstable: "
            "roll slower or take more springs."
        )
    yield from scene.diagnose_contact_radius()
