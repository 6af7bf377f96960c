"""A wheel by itself: its contact, its stiffness, its resonance; what scenes of a wheel share.

Along a track in time it also has springs, time steps and frequencies.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.fft import next_fast_len

from mdr.checks import count, finite, positive
from validation.analysis.escapes import shortened
from validation.analysis.statistics import FloatArray
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rail_impedance import RailBody, RailImpedance
from validation.scenes.roughness import Roughness, RoughSurface, check_band
from validation.scenes.scene import ContactEllipse
from validation.theory.closed_forms import circular_punch_stiffness, hertz_approach, hertz_contact_radius
from validation.theory.half_space import on_panels
from validation.theory.rolling import contact_force_over_force, eigenfrequency, force_spectrum_1d

if TYPE_CHECKING:
    from validation.scenes.rolling import RollingScene


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
        """The approach d_N of Hertz under the load [m]."""
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
        """Hertz's contact of the smooth body, a circle, under its load."""
        return ContactEllipse(self.contact_radius, self.contact_radius, self.approach, self.body.load)

    def diagnose_contact_radius(self, name: str = "wheel") -> Iterator[str]:
        """A contact as large as a part of the body is not on a half-space. name: of the body's table in a scene."""
        if self.contact_radius > self.body.radius / 10:
            yield (
                f"the contact radius is {self.contact_radius / self.body.radius:.3g} of {name}.radius, more than a "
                f"tenth: no half-space; are the units of {name}.load and material.youngs_modulus right?"
            )


@dataclass(frozen=True, kw_only=True)
class DampedWheel(Wheel):
    """A wheel with a dashpot: M z'' = F - F_N - c z', c = 2 zeta M omega_eigen, whatever its contact is.

    damping: zeta, of critical, at least zero and below one; ValueError for another. rail: under it, None where rigid.
    """

    damping: float = 0.0
    rail: RailImpedance | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        check_damping(self.damping, self.mass)


def damping_rate(wheel: Wheel) -> float:
    """c / M = 2 zeta omega_eigen [1/s]; zero without a dashpot."""
    return 2 * wheel.damping * wheel.eigenfrequency if isinstance(wheel, DampedWheel) else 0.0


def moving_bodies(wheel: Wheel, time_step: float) -> tuple[RailBody, ...]:
    """The wheel with its dashpot, and those of the rail in steps dt [s]: their motions add up to the approach."""
    of_rail = wheel.rail.bodies(time_step) if isinstance(wheel, DampedWheel) and wheel.rail else ()
    return RailBody(wheel.mass, wheel.mass * damping_rate(wheel)), *of_rail


def check_damping(damping: float, mass: float | None) -> None:
    """Raises ValueError for a ratio out of range, or of a wheel without a mass."""
    if not 0 <= finite("wheel.damping", damping) < 1:
        raise ValueError(
            f'wheel.damping must be at least 0 and below 1, which is critical, got {damping:g}, as: damping = "2 %"'
        )
    if damping and mass is None:
        raise ValueError(
            f"wheel.damping needs a mass: a wheel without one keeps its approach and does not vibrate, got "
            f'{in_per_cent(damping)} alone, as: mass = "500 kg"'
        )


def in_per_cent(damping: float) -> str:
    return f"{100 * damping:.4g} %"


MAX_FORCE = 0.25
"""Root mean square of the force by linear theory, over the load: above it wheels leave the track."""
MAX_HEIGHT = 1 / 3
"""h / d: above it wheels leave the track, or their level grows along it."""
SHORT_WAVES, FEEDING_HEIGHT = 2.0, 0.1
"""q a of the longest wave, and h / d, from where on short waves drive the free vibration."""
NODES, RATIO = 16, 1.4
"""Of Gauss and Legendre on a panel; of the ends of a panel, from the resonance, at the most."""


def no_steady_answer(wheel: Wheel, speed: float, grounds: Sequence[RoughSurface]) -> str:
    """Why the level of the motion depends on the distance, in a sentence; empty where it does not.

    The first of these conditions that holds:
    q_min v_0 <= omega_eigen <= q_max v_0 without damping; h / d > 1/3; sigma > F_N / 4 of `force_on_the_way`. With
    damping the level is steady beyond these last two also, but no model was measured there.

    speed: v_0 [m/s]; grounds: what is rough, rail and wheel.

    Measured on 12 wheels on springs, Table 14.1 except for these values, over 2 m: growth is that of the
    rms acceleration from the first quarter of the way to the last, flight the share of time in the air in the last.
    - q_min v_0 / omega_eigen = 0.5, 0.8, 0.95, h/d = 0.003, 4 m: growth 2.8, 2.4, 2.6, and flight at h/d = 0.03;
      q_min v_0 / omega_eigen = 1.05, 1.2, 1.5, 3, h/d = 0.003 and 0.03: growth below 1.06, no flight.
    - 10 to 0.5 mm, h/d = 0.3, 0.45, 0.6, 1, sigma / F_N = 0.22, 0.33, 0.44, 0.73: growth 1.1, 1.3, 1.5, 1.6, flight 0,
      0.1, 2, 19 %.
    - 10 to 1 mm, 5 m/s, h/d = 0.2, 0.3, 0.4, sigma / F_N = 0.17, 0.25, 0.34: flight 0, 1, 23 %.
    - 30 to 3 mm, h/d = 0.1, 0.2, 0.3, sigma / F_N = 0.14, 0.27, 0.41: flight 0, 0, 0.6 %.
    - 4 to 1 mm, shorter than the contact, so that the force hardly changes, h/d = 0.2, 0.3, 0.4, 0.5, 1: growth 1.2,
      1.6, 2.3, 2.6, 2, flight 0, 0, 0, 0.01, 7 %.
    Below the limits such short waves still drive the free vibration, which `diagnose_short_waves` reports. In three
    dimensions waves oblique to the track excite the resonance from below q_min v_0, too.
    """
    slow, fast = min(g.q_min for g in grounds) * speed, max(g.q_max for g in grounds) * speed
    omega = wheel.eigenfrequency
    damped = damping_rate(wheel) > 0
    then = "where no model was measured" if damped else "and the level depends on the distance"
    leaves = f"the wheel leaves the track, {then}"
    if slow <= omega <= fast and not damped:
        return (
            f"nothing damps the wheel, and its resonance, {omega:.4g} rad/s, lies among the waves that excite it, "
            f"{slow:.4g} to {fast:.4g} rad/s: the level grows with the distance"
        )
    height = math.hypot(*(ground.rms for ground in grounds))
    if height > MAX_HEIGHT * wheel.approach:
        return (
            f"the roughness is {height / wheel.approach:.3g} of the approach of {wheel.approach:.3g} m, more than a "
            f"third: {leaves}"
        )
    force = force_on_the_way(wheel, speed, grounds)
    if force > MAX_FORCE * wheel.load:
        return (
            f"by linear theory the force changes by {force / wheel.load:.3g} of the load, root mean square, more than "
            f"{MAX_FORCE:g}: {leaves}"
        )
    return ""


def diagnose_short_waves(wheel: Wheel, grounds: Sequence[RoughSurface]) -> tuple[str, ...]:
    """A note where waves are shorter than the contact and too high for linear theory: they drive the free vibration.

    Measured as in `no_steady_answer`: the acceleration grows, for waves of 2 to 0.5 mm, h/d = 0.1, 0.2, 0.3, by 1.2,
    1.7, 2.3; of 1 to 0.25 mm by 1.6, 2.5, 2.8; of 10 to 0.5 mm by 1.04, 1.07, 1.09.
    """
    height, longest = math.hypot(*(g.rms for g in grounds)), min(g.q_min for g in grounds) * wheel.contact_radius
    if longest < SHORT_WAVES or height < FEEDING_HEIGHT * wheel.approach or damping_rate(wheel) > 0:
        return ()
    ratio = height / wheel.approach
    return (
        f"the longest wave is short beside the contact, q a = {longest:.3g}, and the roughness {ratio:.3g} of the "
        "approach: this excites the free vibration, whose level at the resonance grows with the distance.",
    )


def force_on_the_way(wheel: Wheel, speed: float, grounds: Sequence[RoughSurface]) -> float:
    """Root mean square change of the force on a wheel that moves, by linear theory [N].

    sigma^2 = 2 int C_F(q) `contact_force_over_force` dq, C_F of (14.12) with Geike's spectrum.
    Infinite where the resonance is among the waves and nothing damps it.
    """
    return math.hypot(*(_of_one(wheel, wheel.eigenfrequency / speed, ground) for ground in grounds))


def _of_one(wheel: Wheel, resonance: float, ground: RoughSurface) -> float:
    damping = wheel.damping if isinstance(wheel, DampedWheel) else 0.0
    if ground.q_min <= resonance <= ground.q_max and not damping:
        return math.inf
    q, weight = _nodes(resonance, ground, math.pi / wheel.contact_radius, damping * resonance)
    force = force_spectrum_1d(
        q, lambda s: np.pi * s * ground.c2d(s), contact_radius=wheel.contact_radius, modulus=wheel.modulus
    )
    moved = contact_force_over_force(q, eigenfrequency=resonance, damping=damping)
    return math.sqrt(2 * float(np.sum(weight * force * moved)))


def _nodes(resonance: float, ground: RoughSurface, period: float, width: float) -> tuple[FloatArray, FloatArray]:
    """Wavenumbers and weights of a quadrature: panels shrink towards the resonance and are no longer than a period."""
    found = []
    for side in (-1, 1):
        low, high = (max(side * (q - resonance), 0.0) for q in (ground.q_min, ground.q_max)[::side])
        if high == 0:
            continue
        least = max(low, min(width, high))
        powers = np.geomspace(least, high, 2 + math.floor(math.log(high / least) / math.log(RATIO)))
        waves = np.linspace(low, high, 2 + math.floor((high - low) / period))
        inner = [side * (q - resonance) for q in ground.edges]
        away, weight = on_panels(np.union1d(np.union1d(powers, waves), np.clip(inner, low, high)), NODES)
        found.append((resonance + side * away, weight))
    q, weights = zip(*found, strict=True)
    return np.concatenate(q), np.concatenate(weights)


MAX_POINTS = 10**7
"""Springs of a track of eighty megabytes, of which an ensemble has dozens: of more, one is a day of time steps."""

MIN_SPRINGS_PER_WAVE = 4
"""To a wave: with fewer its curvature is off."""
MIN_WAVES_PER_TRACK = 10
"""To a track: with fewer the longest waves are a handful of lines in a spectrum."""
MAX_PLAUSIBLE_RMS = 1e-4
"""Heights in metres that no rolling surface has."""


class WheelTrack(NamedTuple):
    """Distance to roll [m], and springs to a contact radius."""

    distance: float
    springs: int


class OnTrack(OnHalfSpace):
    """Numbers of a simulation, from the distance and the springs of a scene. Each raises ValueError without them."""

    name: str
    radius: float
    speed: float | None
    ground: RoughSurface | None
    wheel: Roughness | None
    distance: float | None
    springs: int | None

    @property
    def has_motion(self) -> bool:
        """Whether the wheel has a speed and, with it, a mass; else it keeps its approach."""
        return self.speed is not None

    @property
    def has_track(self) -> bool:
        """Whether there is a track for the wheel to roll along in time."""
        return self.distance is not None

    @property
    def rail(self) -> Roughness | None:
        """The roughness that tracks are drawn from; None where the rail is smooth, or measured."""
        return self.ground if isinstance(self.ground, Roughness) else None

    @property
    def track(self) -> WheelTrack:
        """Along which the wheel rolls in time."""
        if self.distance is None or self.springs is None:
            keys = "simulation.distance and simulation.springs"
            raise ValueError(f"scene {self.name!r} must have a track for this, {keys}, got neither")
        return WheelTrack(self.distance, self.springs)

    @property
    def rough_ground(self) -> RoughSurface:
        """The surface of a rail that is rough."""
        if self.ground is None:
            raise ValueError(f"scene {self.name!r} must have a rough rail for this, got a smooth one")
        return self.ground

    @property
    def rough_surfaces(self) -> dict[str, RoughSurface]:
        """What is rough, rail and wheel, by the keys of a scene file."""
        both = {"rail.roughness": self.ground, "wheel.roughness": self.wheel}
        return {key: surface for key, surface in both.items() if surface is not None}

    @property
    def rail_alone_is_rough(self) -> bool:
        """Whether the rail is rough and the wheel smooth, as all models but a simulation assume."""
        return self.ground is not None and self.wheel is None

    @property
    def rolling_speed(self) -> float:
        """The speed v0 of the wheel along the track [m/s]. Raises ValueError where the scene has none."""
        if self.speed is None:
            keys = "wheel.mass and wheel.speed"
            raise ValueError(f"scene {self.name!r} must have a motion for this, {keys}, got neither")
        return self.speed

    @property
    def stiffness(self) -> float:
        """k = 2 E* a [N/m]."""
        return self.body.stiffness

    @property
    def eigenfrequency(self) -> float:
        """omega = sqrt(2 a E* / M) [rad/s]."""
        _ = self.rolling_speed  # without a motion there is no mass
        return self.body.eigenfrequency

    @property
    def jump(self) -> float:
        """omega = q_min v0 of the longest wave, on the rail or the wheel [rad/s]; ValueError if both are smooth."""
        return min(rough.q_min for rough in self._one_or_both()) * self.rolling_speed

    @property
    def cutoff(self) -> float:
        """omega = q_max v0 of the shortest wave, on the rail or the wheel [rad/s]; ValueError if both are smooth."""
        return max(rough.q_max for rough in self._one_or_both()) * self.rolling_speed

    @property
    def spacing(self) -> float:
        """dx = a / springs [m]."""
        return self.contact_radius / self.track.springs

    @property
    def points(self) -> int:
        """Springs of the track: those on the distance, and more up to the next length that an FFT is fast at."""
        return int(next_fast_len(math.ceil(self.track.distance / self.spacing)))

    @property
    def length(self) -> float:
        """points dx, the period of the track [m]."""
        return self.points * self.spacing

    @property
    def time_step(self) -> float:
        """dt = dx / v0 [s]."""
        return self.spacing / self.rolling_speed

    @property
    def period_length(self) -> float:
        """2 pi v0 / omega_eigen, rolled in a natural period [m]."""
        return 2 * math.pi * self.rolling_speed / self.eigenfrequency

    @property
    def oscillation_period(self) -> float:
        """pi v0 / a, of sin^2(q a) in the spectrum [rad/s]."""
        return math.pi * self.rolling_speed / self.contact_radius

    @property
    def circumference_points(self) -> int:
        """2 pi R / dx, rounded."""
        return round(2 * math.pi * self.radius / self.spacing)

    def _one_or_both(self) -> list[RoughSurface]:
        if not self.rough_surfaces:
            raise ValueError(f"scene {self.name!r} must have a rough rail or wheel for this, got both smooth")
        return list(self.rough_surfaces.values())


def check_track(scene: "RollingScene") -> None:
    """Check that a scene has all of a track or nothing of it, and a track against contact, motion and waves.

    Raises TypeError or ValueError, which names the key of a scene file.
    """
    if (scene.distance is None) != (scene.springs is None):
        ends = f"{scene.distance}, {shortened(scene.springs)}"
        raise ValueError(f"simulation.distance and simulation.springs must both be given or neither, got {ends}")
    if scene.distance is None:
        if scene.wheel is not None:
            raise ValueError(
                "wheel.roughness needs a track to be rolled along: simulation.distance and simulation.springs, "
                "got neither"
            )
        return
    if not scene.has_motion:
        raise ValueError(
            "simulation needs a wheel that moves: wheel.mass and wheel.speed, got neither; "
            "scene.for_compare() has no simulation"
        )
    positive("simulation.distance", scene.distance)
    count("simulation.springs", scene.springs, least=1)
    if isinstance(scene.ground, MeasuredHeights):
        raise ValueError(
            "simulation must be left out beside rail.heights, as by scene.for_compare(): "
            "tracks are drawn from a roughness"
        )
    for key, rough in scene.rough_surfaces.items():
        check_band(key, rough)
    _check_lengths(scene, *scene.track)


def _check_lengths(scene: "RollingScene", distance: float, springs: int) -> None:
    """Check the lengths of contact, track and waves against each other."""
    a, circumference = scene.contact_radius, 2 * math.pi * scene.radius
    if a >= scene.radius:
        raise ValueError(f"wheel.load must leave a contact smaller than the wheel, {scene.radius:g} m, got {a:g} m")
    if distance <= 2 * a:
        raise ValueError(f"simulation.distance must be longer than the contact, {2 * a:g} m, got {distance:g} m")
    most = MAX_POINTS * a / max(distance, circumference)
    if springs > most:
        raise ValueError(f"simulation.springs must be at most {most:.0f} on such a track, got {shortened(springs)}")
    for key, rough in _drawn(scene):
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


def _drawn(scene: "RollingScene") -> Iterator[tuple[str, Roughness]]:
    """What tracks of a scene are drawn from, by the keys of a scene file."""
    both = {"rail.roughness": scene.rail, "wheel.roughness": scene.wheel}
    return ((key, rough) for key, rough in both.items() if rough is not None)


def diagnose_track(scene: "RollingScene") -> Iterator[str]:
    """What may be wrong about roughness and motion of a scene with a track, in sentences with numbers."""
    yield from _diagnose_roughness(scene, *scene.track)
    omega_dt = scene.time_step * scene.eigenfrequency
    if omega_dt > 0.2:
        yield (
            f"a time step is {omega_dt:.3g} over the eigenfrequency, more than 0.2, and 2 is unstable: "
            "roll slower or take more springs."
        )
    yield from scene.diagnose_contact_radius()


def _diagnose_roughness(scene: "RollingScene", distance: float, springs: int) -> Iterator[str]:
    circumference = 2 * math.pi * scene.radius
    for key, rough in _drawn(scene):
        per_wave, waves = rough.shortest / scene.spacing, distance / rough.longest
        if per_wave < MIN_SPRINGS_PER_WAVE:
            few = f"{per_wave:.3g} springs, fewer than {MIN_SPRINGS_PER_WAVE}"
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
