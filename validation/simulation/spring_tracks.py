"""Wheels on springs over rough tracks: lift-off, and springs too far apart."""

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
import scipy

import mdr
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import random_generator
from validation.scenes.roughness import Roughness
from validation.simulation.contact_laws import HertzLaw, SpringsLaw
from validation.simulation.free_vibration import SPEED, WHEEL
from validation.simulation.integrators import INTEGRATORS
from validation.simulation.motion import simulate
from validation.simulation.rough_punch import PunchRoughness
from validation.simulation.surface import draw_track

HEIGHT = 0.5e-6
"""h_rms of Table 14.1 [m]."""
FINE = 100
"""Springs to the shortest wave of a track that is resolved as a continuum."""
STRIDES = (3, 5, 9, 15, 25, 45, 75)
"""Between springs of a coarser track: odd, so that these are at places of the fine one; 25 is a quarter of a wave."""


@dataclass(frozen=True, kw_only=True)
class RoughTrack:
    """Rough tracks of the springs.

    rms: height [m]; longest, shortest: waves [m]; waves: of the longest, in a period; per_wave: springs to the
    shortest; hurst: H; realisation: first of all tracks.
    """

    rms: float
    seed: int
    realisation: int = 0
    longest: float = 10e-3
    shortest: float = 0.2e-3
    waves: int = 14
    per_wave: int = 8
    hurst: float = 0.7

    @property
    def spacing(self) -> float:
        return self.shortest / self.per_wave

    @property
    def points(self) -> int:
        return round(self.waves * self.longest / self.spacing)

    def heights(self, count: int, points: int | None = None) -> FloatArray:
        """So many tracks, shape (points, count) [m]; points: of another grid."""
        ground = Roughness(rms=self.rms, hurst=self.hurst, longest=self.longest, shortest=self.shortest)
        length = self.waves * self.longest
        draw = partial(draw_track, ground, "geike", rms=self.rms, length=length, points=points or self.points)
        return np.stack([draw(rng=random_generator(self.seed, self.realisation + i)) for i in range(count)], axis=1)


@dataclass(frozen=True, kw_only=True)
class LiftOff:
    """Wheels over rough tracks, once around, from static equilibrium."""

    track: RoughTrack
    wheels: int


def lift_off(problem: LiftOff) -> Outcome:
    """Time airborne, forces and the imbalance of momentum, of each wheel; the largest tension of linear theory."""
    track = problem.track
    height = track.heights(problem.wheels)
    law = SpringsLaw(WHEEL, height, track.spacing)
    motion = simulate(WHEEL, law, time_step=track.spacing / SPEED, steps=track.points)
    force = 1 + WHEEL.mass / WHEEL.load * motion.acceleration
    momentum = WHEEL.mass * (motion.velocity + motion.time_step / 2 * motion.jump) / motion.duration
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mdr.LinearityWarning)
        # dF / F_N of (14.11)
        linear = np.stack([filtered(track, profile).force / WHEEL.load - 1 for profile in height.T], axis=1)
    return {
        "airborne": motion.airborne / len(force),
        "lowest": force.min(axis=0),
        "imbalance": force.mean(axis=0) - 1 + momentum / WHEEL.load,
        "pull": -linear.min(axis=0),
    }


def filtered(track: RoughTrack, height: FloatArray) -> mdr.RollingTrack:
    """The force of the linear filter (14.11) along one track, at the approach d_N."""
    return mdr.roll(height, spacing=track.spacing, contact="linear", **WHEEL.smooth)


def coarsen(track: RoughTrack) -> Outcome:
    """Springs of each stride on one track, at the approach d_N, against the finest.

    error: the difference of force, rms about its mean, over the fluctuation; level, linear: of the last one-third
    octave over that of the finest, as it is and by linear theory; spread: see there, of both together.
    """
    height = track.heights(1)[:, 0]
    fine = mdr.rolling_force(height, spacing=track.spacing, **WHEEL.smooth)
    finest, rows = spread(track, 1), []
    for stride in STRIDES:
        middle = slice((stride - 1) // 2, None, stride)
        force = mdr.rolling_force(height[middle], spacing=stride * track.spacing, **WHEEL.smooth)
        error = np.std(force - fine[middle]) / fine.std()
        ratios = level(force, track) / level(fine, track), linear_level(height, stride, track)
        rows.append((error, *ratios, math.hypot(finest, spread(track, stride))))
    return dict(zip(("error", "level", "linear", "spread"), np.array(rows).T, strict=True))


def level(force: FloatArray, track: RoughTrack) -> float:
    """Sum of |F_j|^2 over the last one-third octave; nothing where the points cannot carry it."""
    band = highest_band(track)
    if 2 * (band.stop - 1) >= force.size:
        return 0.0
    return float(np.sum(np.abs(np.fft.rfft(force, norm="forward")[band]) ** 2))


def linear_level(height: FloatArray, stride: int, track: RoughTrack) -> float:
    """Ratio of powers in the highest band by linear theory, of springs `stride` places apart to those at each."""
    band = highest_band(track)
    power = np.abs(np.fft.rfft(height)[band]) ** 2
    coarse, fine = (np.sum(power * linear_response(track, n) ** 2) for n in (stride, 1))
    return float(coarse / fine)


def linear_response(track: RoughTrack, stride: int) -> FloatArray:
    """dx sin(q (m + 1/2) dx) / sin(q dx / 2) of 2 m + 1 springs, in place of 2 sin(q a) / q, in the last band."""
    band, dx = highest_band(track), stride * track.spacing
    q = 2 * np.pi / (track.waves * track.longest) * np.arange(band.start, band.stop)
    m = math.floor(WHEEL.contact_radius / dx)
    return np.asarray(dx * np.sin(q * (m + 0.5) * dx) / np.sin(q * dx / 2))


def spread(track: RoughTrack, stride: int) -> float:
    """Standard deviation of the level, over itself, that the moving ends of contact leave linear theory in one track.

    A spring of gap g under the smooth wheel bears max(g + h, 0) = Phi(g / s) h + phi(g / s) h^2 / s + ..., s = h_rms.
    The square multiplies a short wave by the long ones, h_rms high: at each of two ends a part e = dx sum phi(g / s) /
    rms(response) of the short wave is added, in no phase with it. Twice sqrt(2) e / sqrt(waves) remains in the level.
    """
    dx, response = stride * track.spacing, linear_response(track, stride)
    x = dx * np.arange(2 * math.ceil(WHEEL.contact_radius / dx))
    ends = dx * np.sum(scipy.stats.norm.pdf((WHEEL.approach - x**2 / WHEEL.radius) / track.rms))
    return float(2 * math.sqrt(2 / response.size) * ends / np.sqrt(np.mean(response**2)))


def highest_band(track: RoughTrack) -> slice:
    """Waves of the track in the last one-third octave."""
    last = round(track.waves * track.longest / track.shortest)
    return slice(math.ceil(last * 2 ** (-1 / 3)), last + 1)


def refusals() -> dict[str, str]:
    """Messages of calls that must be refused: steps past the limit of each scheme, and too few points to a wave."""
    calls: dict[str, Callable[[], object]] = {}
    for scheme in INTEGRATORS:
        step = 1.001 * max(scheme.limit, 2.0) / WHEEL.eigenfrequency / scheme.cells
        calls[f"simulate, {scheme.name}, a step just past its limit"] = partial(
            simulate, WHEEL, HertzLaw(WHEEL), time_step=step, steps=1, integrator=scheme
        )
    coarse = RoughTrack(rms=HEIGHT, seed=0, per_wave=1)
    calls["rough_profile, one point to the shortest wave"] = partial(coarse.heights, 1)
    return {name: refusal(call) for name, call in calls.items()}


def refusal(call: Callable[[], object]) -> str:
    """The message of the ValueError that a call raises; empty where it raises none."""
    try:
        call()
    except ValueError as error:
        return str(error)
    return ""


@dataclass(frozen=True, kw_only=True)
class RoughAreas:
    """So many realisations from the first on, on cells x cells; loads: overlaps, mean over the area, in rms heights."""

    roughness: PunchRoughness
    first: int
    realisations: int
    cells: int
    loads: tuple[float, ...]


def press_areas(areas: RoughAreas) -> Outcome:
    """Stiffness of each realisation at each load, E* = 1 a length, so the contact fraction: one sort a surface."""
    load = areas.roughness.height * np.array(areas.loads)
    last = areas.first + areas.realisations
    surfaces = (areas.roughness.surface(areas.cells, i) for i in range(areas.first, last))
    return {"stiffness": np.array([_fraction(surface.ravel(), load) for surface in surfaces])}


def _fraction(height: FloatArray, load: FloatArray) -> FloatArray:
    """Contact fraction at each load, linear between the loads at which one more spring touches [-]."""
    ordered = np.sort(height)[::-1]
    touching = np.arange(1, ordered.size + 1)
    overlap = (np.cumsum(ordered) - touching * ordered) / ordered.size
    return np.interp(load, overlap, touching / ordered.size)
