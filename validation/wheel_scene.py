"""The scene of a wheel that rolls along a rough rail: what it is made of, what follows from that, where it is read."""

import math
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from scipy.fft import next_fast_len

from mdr import SelfAffine
from mdr.border import count, finite, positive
from validation.contact_laws import Wheel
from validation.quantities import quantity

Reader = Callable[[str, object], Any]

SCENES = Path(__file__).parent / "scenes"
KEYS = {
    "radius": "wheel.radius",
    "mass": "wheel.mass",
    "load": "wheel.load",
    "speed": "wheel.speed",
    "youngs_modulus": "material.youngs_modulus",
    "distance": "simulation.distance",
}
"""Where what must be positive stands in a scene file."""
MOST_POINTS = 10**9
"""Springs of a track of eight gigabytes."""

FEW_SPRINGS = 4
"""To a wave: with fewer its curvature is off."""
FEW_WAVES = 10
"""To a track: with fewer the longest waves are a handful of lines in a spectrum."""
HIGH = 1e-4
"""Heights in metres that no rolling surface has."""


@dataclass(frozen=True, kw_only=True)
class Roughness:
    """Isotropic self-affine roughness between two waves; the scene that holds it checks it.

    rms: root mean square height [m]; hurst: H; longest, shortest: wavelengths between which it is rough [m].
    """

    rms: float
    hurst: float
    longest: float
    shortest: float

    @property
    def q_min(self) -> float:
        """2 pi over the longest wave [rad/m]."""
        return 2 * math.pi / self.longest

    @property
    def q_max(self) -> float:
        """2 pi over the shortest wave [rad/m]."""
        return 2 * math.pi / self.shortest

    @property
    def spectrum(self) -> SelfAffine:
        """C_2D ~ q^(-2H-2) between q_min and q_max."""
        return SelfAffine(hurst=self.hurst, q_min=self.q_min, q_max=self.q_max, rms=self.rms)


@dataclass(frozen=True, kw_only=True)
class WheelScene:
    """An elastic wheel on a rigid rail, either of them rough or smooth.

    radius: R [m]; mass: M [kg]; load: F [N]; speed: v0 [m/s]; youngs_modulus: E [Pa]; poisson_ratio: nu in [0, 0.5];
    rail, wheel: their roughness, None where smooth; distance: to roll at least, before the track begins again [m];
    springs: to a contact radius.
    Raises ValueError or TypeError naming the key of a scene file that is out of range.
    """

    name: str
    radius: float
    mass: float
    load: float
    speed: float
    youngs_modulus: float
    poisson_ratio: float
    rail: Roughness | None
    wheel: Roughness | None
    distance: float
    springs: int

    def __post_init__(self) -> None:
        _named("name", self.name)
        for name, key in KEYS.items():
            positive(key, getattr(self, name))
        if not 0 <= finite("material.poisson_ratio", self.poisson_ratio) <= 0.5:
            raise ValueError(f"material.poisson_ratio must lie in [0, 0.5], got {self.poisson_ratio}")
        count("simulation.springs", self.springs, least=1)
        for key, rough in (("rail.roughness", self.rail), ("wheel.roughness", self.wheel)):
            if rough is not None:
                _check_band(key, rough)
        _check_lengths(self)

    @property
    def modulus(self) -> float:
        """E* = E / (1 - nu^2), the rail being rigid [Pa]."""
        return self.youngs_modulus / (1 - self.poisson_ratio**2)

    @property
    def body(self) -> Wheel:
        """The wheel without its roughness."""
        return Wheel(radius=self.radius, mass=self.mass, modulus=self.modulus, load=self.load)

    @property
    def approach(self) -> float:
        """d = (9 F^2 / (16 R E*^2))^(1/3) of the smooth wheel [m]."""
        return self.body.approach

    @property
    def contact_radius(self) -> float:
        """a = sqrt(R d) [m]."""
        return self.body.contact_radius

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
        return min(rough.q_min for rough in self._rough().values()) * self.speed

    @property
    def cutoff(self) -> float:
        """omega = q_max v0 of the shortest wave, on the rail or the wheel [rad/s]; ValueError if both are smooth."""
        return max(rough.q_max for rough in self._rough().values()) * self.speed

    @property
    def rms(self) -> float:
        """sqrt(h_rail^2 + h_wheel^2), the height of both together, zero where smooth [m]."""
        return math.hypot(*(rough.rms for rough in (self.rail, self.wheel) if rough is not None))

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
    def circumference_points(self) -> int:
        """2 pi R / dx, rounded."""
        return round(2 * math.pi * self.radius / self.spacing)

    def doubts(self) -> tuple[str, ...]:
        """What may be wrong about this scene though it is valid, in sentences with numbers."""
        return (*_doubts_of_roughness(self), *_doubts_of_motion(self))

    def _rough(self) -> dict[str, Roughness]:
        """What is rough, by its key."""
        both = {"rail.roughness": self.rail, "wheel.roughness": self.wheel}
        rough = {key: each for key, each in both.items() if each is not None}
        if not rough:
            raise ValueError(f"scene {self.name!r} must have a rough rail or wheel for this, got both smooth")
        return rough


def shipped() -> tuple[str, ...]:
    """Names of the scenes that come with this package."""
    return tuple(sorted(path.stem for path in SCENES.glob("*.toml")))


def read_scene(scene: str | Path) -> WheelScene:
    """The scene in a TOML file, or the shipped one of that name.

    scene: a path; a name without folder and without ".toml" is that of a shipped scene.
    Raises ValueError naming the first thing that is missing, unknown or out of range, and OSError for files that
    cannot be read.
    """
    path = _path(str(scene))
    try:
        # with or without the mark that some editors put in front
        tables = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as problem:
        raise type(problem)(f"scene {path} cannot be read: {problem.strerror}") from None
    except ValueError as problem:
        raise ValueError(f"scene {path} must be valid TOML, got: {problem}") from None
    found = _table(SCENE, ("rail",), "", tables)
    wheel, rail = found["wheel"], found.get("rail", {})
    return WheelScene(
        name=found["name"],
        wheel=wheel.pop("roughness", None),
        rail=rail.get("roughness"),
        **wheel,
        **found["material"],
        **found["simulation"],
    )


def _path(scene: str) -> Path:
    if scene.endswith(".toml") or Path(scene).name != scene:
        return Path(scene)
    if scene not in shipped():
        raise ValueError(f'scene must be a file, as "./{scene}.toml", or one of {", ".join(shipped())}, got "{scene}"')
    return SCENES / f"{scene}.toml"


def _table(readers: Mapping[str, Reader], optional: tuple[str, ...], name: str, given: object) -> dict[str, Any]:
    """Each value of a table by its own reader; no key unknown, none missing but what is optional."""
    if not isinstance(given, dict):
        raise ValueError(f"{name} must be a table, got {given!r}")
    full = {key: f"{name}.{key}" if name else key for key in (*given, *readers)}
    for key in given:
        if key not in readers:
            raise ValueError(f"{full[key]} is unknown, {name or 'a scene'} must be made of {', '.join(readers)}")
    for key in readers:
        if key not in given and key not in optional:
            raise ValueError(f"{full[key]} is missing, {name or 'a scene'} must have it")
    return {key: read(full[key], given[key]) for key, read in readers.items() if key in given}


def _plain(read: Reader, name: str, given: object) -> Any:
    """A value without unit. In a file a wrong type is a wrong value, too."""
    try:
        return read(name, given)
    except TypeError as problem:
        raise ValueError(str(problem)) from None
    except OverflowError:
        raise ValueError(f"{name} must be finite, got a number of {len(str(given))} digits") from None


def _named(name: str, given: object) -> str:
    """A text that is not blank."""
    if not isinstance(given, str) or not given.strip():
        raise ValueError(f"{name} must be a text that is not blank, got {given!r}")
    return given


def _roughness(name: str, given: object) -> Roughness:
    readers: dict[str, Reader] = {"rms": LENGTH, "hurst": NUMBER, "longest": LENGTH, "shortest": LENGTH}
    return Roughness(**_table(readers, (), name, given))


LENGTH, MASS, FORCE, PRESSURE, SPEED = (
    partial(quantity, dimension=dimension, positive=True)
    for dimension in ("length", "mass", "force", "pressure", "speed")
)
NUMBER, WHOLE = partial(_plain, finite), partial(_plain, partial(count, least=1))
WHEEL: dict[str, Reader] = {"radius": LENGTH, "mass": MASS, "load": FORCE, "speed": SPEED, "roughness": _roughness}
SCENE: dict[str, Reader] = {
    "name": _named,
    "wheel": partial(_table, WHEEL, ("roughness",)),
    "material": partial(_table, {"youngs_modulus": PRESSURE, "poisson_ratio": NUMBER}, ()),
    "rail": partial(_table, {"roughness": _roughness}, ("roughness",)),
    "simulation": partial(_table, {"distance": LENGTH, "springs": WHOLE}, ()),
}
"""How each value of a scene file is read."""


def _check_band(key: str, rough: object) -> None:
    """Roughness in itself."""
    if not isinstance(rough, Roughness):
        raise TypeError(f"{key} must be a Roughness or None, got {rough!r}")
    longest, shortest = positive(f"{key}.longest", rough.longest), positive(f"{key}.shortest", rough.shortest)
    if not shortest < longest:
        raise ValueError(f"{key}.shortest must be below the longest wave, {longest:g} m, got {shortest:g} m")
    try:
        _ = rough.spectrum
    except (TypeError, ValueError) as problem:
        # which begins with the name of its argument, "hurst" or "rms"
        raise type(problem)(f"{key}.{problem}") from None


def _check_lengths(scene: WheelScene) -> None:
    """Contact, track and waves beside each other."""
    a, distance, circumference = scene.contact_radius, scene.distance, 2 * math.pi * scene.radius
    if a >= scene.radius:
        raise ValueError(f"wheel.load must leave a contact smaller than the wheel, {scene.radius:g} m, got {a:g} m")
    if distance <= 2 * a:
        raise ValueError(f"simulation.distance must be longer than the contact, {2 * a:g} m, got {distance:g} m")
    most = MOST_POINTS * a / max(distance, circumference)
    if scene.springs > most:
        raise ValueError(f"simulation.springs must be at most {most:.0f} on such a track, got {scene.springs}")
    if scene.rail is not None:
        _check_waves("rail.roughness", scene.rail, scene, period=scene.length)
    if scene.wheel is not None:
        _check_waves("wheel.roughness", scene.wheel, scene, period=scene.circumference_points * scene.spacing)


def _check_waves(key: str, rough: Roughness, scene: WheelScene, *, period: float) -> None:
    """Waves on the springs of a track of that period."""
    longest, shortest = rough.longest, rough.shortest
    if scene.distance <= longest:
        track = f"longer than {key}.longest, {longest:g} m"
        raise ValueError(f"simulation.distance must be {track}, got {scene.distance:g} m")
    if shortest < 2 * scene.spacing:
        raise ValueError(f"{key}.shortest must hold two springs, {2 * scene.spacing:g} m, got {shortest:g} m")
    if math.floor(period / shortest) < math.ceil(period / longest):
        raise ValueError(
            f"{key}.shortest must leave a wave that fits a period of {period:g} m a whole number of times, "
            f"got waves from {shortest:g} m to {longest:g} m"
        )


def _doubts_of_roughness(scene: WheelScene) -> Iterator[str]:
    circumference = 2 * math.pi * scene.radius
    for key, rough in (("rail.roughness", scene.rail), ("wheel.roughness", scene.wheel)):
        if rough is None:
            continue
        springs, waves = rough.shortest / scene.spacing, scene.distance / rough.longest
        if springs < FEW_SPRINGS:
            yield f"{key}.shortest holds {springs:.3g} springs, fewer than {FEW_SPRINGS}: its waves are not resolved."
        if waves < FEW_WAVES:
            yield (
                f"simulation.distance holds {waves:.3g} waves of {key}.longest, fewer than {FEW_WAVES}: "
                "the low end of a spectrum rests on few waves."
            )
        if rough.rms > HIGH:
            yield f"{key}.rms is {rough.rms:.3g} m, more than {HIGH:g} m: is its unit right?"
    if scene.wheel is not None and scene.wheel.longest > circumference / 2:
        yield (
            f"wheel.roughness.longest is {scene.wheel.longest:.3g} m, more than half of the circumference of "
            f"{circumference:.3g} m: a wheel carries whole waves only."
        )


def _doubts_of_motion(scene: WheelScene) -> Iterator[str]:
    d, a, turn = scene.approach, scene.contact_radius, scene.time_step * scene.eigenfrequency
    if scene.rms > d / 3:
        yield (
            f"the roughness is {scene.rms / d:.3g} of the approach of {d:.3g} m, more than a third: "
            "the wheel may lift off."
        )
    if turn > 0.2:
        yield (
            f"a time step is {turn:.3g} over the eigenfrequency, more than 0.2, and 2 is unstable: "
            "roll slower or take more springs."
        )
    if a > scene.radius / 10:
        yield (
            f"the contact radius is {a / scene.radius:.3g} of wheel.radius, more than a tenth: "
            "no half-space; are the units of wheel.load and material.youngs_modulus right?"
        )
