"""Wheels of a scene on springs, each over a track of its own, all in step: one solve of every case about them."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len

import mdr
from validation.analysis.spectra import band_means, record_spectra
from validation.engine.engine import Outcome, random_generator
from validation.scenes.dynamic_wheel import WheelScene
from validation.scenes.measured import MeasuredHeights
from validation.scenes.roughness import Roughness
from validation.scenes.wheel_body import Wheel
from validation.simulation.contact_laws import ContactLaw, Linear, SpringsLaw
from validation.simulation.motion import Motion, repeating, simulate
from validation.theory.rolling import response

FloatArray = NDArray[np.float64]
Track = Literal["open", "closed", "steady"]
InputSpectrum = Literal["geike", "rolling"]

RAIL, WHEEL = 1, 2
"""The spawn keys under which the roughness of each draws."""
LEFT = 1e-7
"""Of the approach, over d, after a round of a motion that repeats itself."""
APART = 30
"""Longest waves between the end of an open track and its beginning: with a band that begins sharply, forces are still
correlated at a few."""
PARTS = 12
"""Bands to an octave, of which each wheel's levels are kept."""


@dataclass(frozen=True, kw_only=True)
class WheelEnsemble:
    """Some wheels of an ensemble, each with a rail and a roughness of its own.

    scene; first, count: which of its realisations; groups: of them, whose mean spectra are kept apart; seed: zero or
    positive; release: how much deeper than in equilibrium they begin, over the smooth approach;
    linear: the filter (14.11) in place of springs; input_spectrum: the spectrum that springs get for the isotropic
    surface: Geike's, or `mdr.rolling_spectrum`, with which they have the force level of the half-space;
    track: "open": the end is far from the beginning; "closed": the end is the beginning, after a whole
    number of turns of the resonance; "steady": closed, and the motion repeats itself, after a number and a half.
    """

    scene: WheelScene
    first: int = 0
    count: int = 1
    groups: int = 1
    track: Track = "open"
    linear: bool = False
    input_spectrum: InputSpectrum = "geike"
    release: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        if self.count % self.groups:
            raise ValueError(f"count must be a multiple of groups, got {self.count} and {self.groups}")

    @property
    def steps(self) -> int:
        """Cells that are rolled over, about the distance of the scene."""
        if self.track == "open":
            return self.scene.points
        turn = 2 * math.pi / (self.scene.eigenfrequency * self.scene.time_step)
        turns = self.scene.points / turn
        whole = round(turns) if self.track == "closed" else math.floor(turns) + 0.5
        return round(max(whole, 0.5 if self.track == "steady" else 1.0) * turn)

    @property
    def places(self) -> int:
        """Cells of the track."""
        if self.track != "open":
            return self.steps
        longest = max((r.longest for r in (self.scene.rail, self.scene.wheel) if r), default=0.0)
        return int(next_fast_len(self.steps + math.ceil(APART * longest / self.scene.spacing)))

    def heights(self) -> FloatArray:
        """Roughness of rail and wheel together, shape (places, count)."""
        scene, numbers = self.scene, range(self.first, self.first + self.count)
        height = np.zeros((self.places, self.count))
        for i, number in enumerate(numbers):
            if scene.rail:
                height[:, i] += self._drawn(scene.rail, self.places, RAIL, number)
            if scene.wheel:
                around = self._drawn(scene.wheel, self._circumference, WHEEL, number)
                height[:, i] += around[self._under % self._circumference]
        return height

    @property
    def _circumference(self) -> int:
        """Cells after which the wheel meets the rail with the same spot: 2 pi R, or the whole of a closed track."""
        return self.scene.circumference_points if self.track == "open" else self.places

    @property
    def _under(self) -> NDArray[np.int64]:
        """Cells rolled when each place is below; the last places of an open track lie behind the first."""
        place = np.arange(self.places)
        middle = (self.steps + self.places) // 2
        return np.where(place > middle, place - self.places, place)

    def _drawn(self, roughness: Roughness, points: int, kind: int, number: int) -> FloatArray:
        geike = self.input_spectrum == "geike"
        return mdr.rough_profile(
            roughness.spectrum.c1d if geike else rolling_feed(roughness, self.scene.contact_radius),
            length=points * self.scene.spacing,
            points=points,
            rng=random_generator(self.seed, kind, number),
            rms=roughness.rms if geike else None,
        )


@cache
def rolling_feed(ground: Roughness | MeasuredHeights, contact_radius: float) -> Callable[[FloatArray], FloatArray]:
    """C_1D(q) for springs that roll, of an isotropic spectrum; values are kept, since each is a quadrature."""

    @cache
    def values(q: tuple[float, ...]) -> FloatArray:
        return mdr.rolling_spectrum(np.array(q), ground.c2d, edges=ground.edges, contact_radius=contact_radius)

    return lambda q: values(tuple(q.tolist()))


def roll_wheels(rides: WheelEnsemble) -> Outcome:
    """Spectra of the accelerations of wheels on springs.

    omega: frequencies; plain, hann: A of (14.17) without window and with Hann's, means of each group, (groups,
    frequencies); bands: their edges; levels: means of A in each band without window, (bands, wheels); jump, mean,
    square: of each wheel, its acceleration, and the square of that; lowest, highest: approach over d; airborne: share
    of steps; failed: wheels whose motion was to repeat itself and does not; balance: see there.
    """
    try:
        motion, left = _motion(rides)
    except ArithmeticError:
        # a wheel that was thrown so far that sums would round: nothing of this ensemble is trusted
        return {"failed": np.array(float(rides.count))}
    plain, hann = (record_spectra(motion.acceleration, time_step=motion.time_step, window=w) for w in ("none", "hann"))
    scene, groups = rides.scene, np.arange(rides.count).reshape(rides.groups, -1)
    bands = band_edges(plain.omega)
    return {
        "omega": plain.omega,
        "plain": np.stack([plain.density[:, g].mean(axis=1) for g in groups]),
        "hann": np.stack([hann.density[:, g].mean(axis=1) for g in groups]),
        "bands": bands,
        "levels": band_means(plain.omega, plain.density, bands),
        "jump": motion.jump,
        "mean": motion.acceleration.mean(axis=0),
        "square": np.mean(motion.acceleration**2, axis=0),
        "lowest": motion.lowest / scene.approach,
        "highest": motion.highest / scene.approach,
        "airborne": motion.airborne / len(motion.acceleration),
        "failed": np.array(float(np.count_nonzero(left > LEFT))),
        "balance": balance(motion),
        "time step": np.array(motion.time_step),
        "duration": np.array(motion.duration),
    }


def _motion(rides: WheelEnsemble) -> tuple[Motion, FloatArray]:
    scene, wheel = rides.scene, rides.scene.body
    height = rides.heights()
    law: ContactLaw = (
        filtered(wheel, height, scene.spacing) if rides.linear else SpringsLaw(wheel, height, scene.spacing)
    )
    start, velocity = law.at_rest(0) + rides.release * scene.approach, np.zeros(rides.count)
    left = np.zeros(rides.count)
    if rides.track == "steady" and isinstance(law, Linear):
        start, velocity = law.steady(scene.time_step)
    elif rides.track == "steady":
        start, velocity, left = repeating(
            wheel,
            lambda n: SpringsLaw(wheel, np.tile(height, (1, n)), scene.spacing),
            time_step=scene.time_step,
            steps=rides.steps,
            start=(start, velocity),
        )
    motion = simulate(wheel, law, time_step=scene.time_step, steps=rides.steps, approach=start, velocity=velocity)
    return motion, left


def filtered(wheel: Wheel, height: FloatArray, spacing: float) -> Linear:
    """The linear contact of wheels on tracks: dF = sum over q of 2 E* sin(q a) / q h(q) exp(i q x), (14.11)."""
    q = 2 * np.pi * np.fft.rfftfreq(len(height), spacing)[:, np.newaxis]
    factor = response(q, contact_radius=wheel.contact_radius, modulus=wheel.modulus)
    return Linear(wheel, np.fft.irfft(factor * np.fft.rfft(height, axis=0), len(height), axis=0))


def balance(motion: Motion) -> FloatArray:
    """Mean acceleration less the change of velocity over time, over the root mean square of the acceleration.

    For velocity Verlet sum (a_n + a_(n+1)) dt / 2 = v_N - v_0 holds to rounding; z upward, v downward.
    """
    a, ends = motion.acceleration, (motion.onward - motion.acceleration[0]) / 2
    change = -(motion.velocity - motion.started) / motion.time_step
    return np.asarray((a.sum(axis=0) + ends - change) / (len(a) * np.sqrt(np.mean(a**2, axis=0))))


def band_edges(omega: FloatArray) -> FloatArray:
    """Twelfths of an octave where each holds a line or more, single lines below."""
    single = math.ceil(1 / (2 ** (1 / PARTS) - 1))
    lines = omega[0] * (np.arange(single) + 0.5)
    above = omega[0] * (single + 0.5) * 2 ** (np.arange(0, PARTS * math.log2(len(omega) / (single + 0.5))) / PARTS)
    return np.concatenate([lines, above])
