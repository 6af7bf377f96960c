"""What a scene of a wheel has where the wheel rolls along a track in time: springs, time steps, frequencies."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from scipy.fft import next_fast_len

from mdr.checks import count, positive
from validation.analysis.escapes import shortened
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.roughness import Roughness, RoughSurface, check_band
from validation.scenes.wheel_body import OnHalfSpace

if TYPE_CHECKING:
    from validation.scenes.rolling import RollingScene

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
