"""Ensembles of wheels on springs, each wheel on a track of its own, simulated together."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len

from validation.analysis.spectra import band_means, record_spectra
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import random_generator
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.scenes.wheel_body import Wheel
from validation.simulation.contact_laws import ContactLaw, LinearLaw, SpringsLaw
from validation.simulation.motion import Motion, periodic_motion, simulate
from validation.simulation.surface import draw_track
from validation.simulation.track_spectrum import InputSpectrum
from validation.theory.rolling import response

TrackKind = Literal["open", "steady-state", "part"]

RAIL, WHEEL = 1, 2
"""Keys of the random numbers of either roughness."""
STEADY_TOLERANCE = 1e-7
"""Change of the approach over d from one round of a track to the next: a motion that changes more is not periodic."""
WAVES_APART = 30
"""Longest waves between the end of an open track and its beginning: a band with a sharp lower end keeps forces
correlated over several waves."""
BANDS_PER_OCTAVE = 12


@dataclass(frozen=True, kw_only=True)
class WheelEnsemble:
    """Wheels of one scene, each on a track of its own.

    scene; first, count: the realisations; groups: of wheels, whose mean spectra are kept; seed: zero or positive;
    linear: whether the contact is the filter (14.11) in place of springs; input_spectrum: of the tracks, by Geike's
    rule, or the one with which springs have the force level of the half-space; track: "open": from static equilibrium,
    its end is far from its beginning; "steady-state": periodic like its motion, after a whole number of natural periods
    and a half; "part": a half of such a motion, whose end is not its beginning.
    """

    scene: RollingScene
    first: int = 0
    count: int = 1
    groups: int = 1
    track: TrackKind = "open"
    linear: bool = False
    input_spectrum: InputSpectrum = "geike"
    seed: int = 0

    def __post_init__(self) -> None:
        if self.count % self.groups:
            raise ValueError(f"count must be a multiple of groups, got {self.count} and {self.groups}")

    @property
    def steps(self) -> int:
        """Cells that are recorded, about the distance of the scene."""
        return self.places if self.track == "steady-state" else self.scene.points

    @property
    def places(self) -> int:
        """The number of cells of the periodic track of each wheel."""
        if self.track == "open":
            longest = max((r.longest for r in (self.scene.rail, self.scene.wheel) if r), default=0.0)
            # longer than the record, since a generated track is periodic: its end would correlate with its beginning
            return int(next_fast_len(self.steps + math.ceil(WAVES_APART * longest / self.scene.spacing)))
        # after a whole number of natural periods any free vibration would be periodic as well:
        # the half is farthest from that
        period = 2 * math.pi / (self.scene.eigenfrequency * self.scene.time_step)
        rolled = self.scene.points * (2 if self.track == "part" else 1)
        return round((math.floor(rolled / period) + 0.5) * period)

    def heights(self) -> FloatArray:
        """Roughness of rail and wheel together, shape (places, count)."""
        scene, numbers = self.scene, range(self.first, self.first + self.count)
        height = np.zeros((self.places, self.count))
        for i, number in enumerate(numbers):
            if scene.rail:
                height[:, i] += self._draw_track(scene.rail, self.places, RAIL, number)
            if scene.wheel:
                # the wheel meets its own roughness again after each revolution
                around = self._draw_track(scene.wheel, self._circumference, WHEEL, number)
                height[:, i] += around[self._rolled_cells % self._circumference]
        return height

    @property
    def _circumference(self) -> int:
        """Cells to a revolution of the wheel; a periodic track is one revolution."""
        return self.scene.circumference_points if self.track == "open" else self.places

    @property
    def _rolled_cells(self) -> NDArray[np.int64]:
        """Cells rolled when the wheel is over each place; the last places of an open track lie behind the first."""
        place = np.arange(self.places)
        middle = (self.steps + self.places) // 2
        return np.where(place > middle, place - self.places, place)

    def _draw_track(self, roughness: Roughness, points: int, kind: int, number: int) -> FloatArray:
        """Heights of one realisation of the roughness of rail or wheel, by its kind, at so many places [m]."""
        return draw_track(
            roughness,
            self.input_spectrum,
            contact_radius=self.scene.contact_radius,
            rms=roughness.rms,
            length=points * self.scene.spacing,
            points=points,
            # by its address, so that a track does not depend on the ensemble in which it is simulated
            rng=random_generator(self.seed, kind, number),
        )


def simulate_ensemble(ensemble: WheelEnsemble) -> Outcome:
    """Spectra of the accelerations of wheels.

    omega: frequencies; plain, hann: A of (14.17) without window and with Hann's, means of each group, (groups,
    frequencies); bands: their edges; levels: means of A in each band without window, (bands, wheels); jump, mean,
    square: of each wheel's acceleration; lowest, highest: approach over d; airborne: share of steps; failed: wheels
    whose motion is not periodic and should be; balance: see there.
    """
    try:
        motion, residual = _motion(ensemble)
    except ArithmeticError:
        # a wheel flew so high that sums would be rounded: the whole ensemble is lost
        return {"failed": np.array(float(ensemble.count))}
    # both windows on the same record: what they differ by is leakage, and no scatter
    plain, hann = (record_spectra(motion.acceleration, time_step=motion.time_step, window=w) for w in ("none", "hann"))
    scene, groups = ensemble.scene, np.arange(ensemble.count).reshape(ensemble.groups, -1)
    bands = band_edges(plain.omega)
    return {
        "omega": plain.omega,
        # a mean of each group: the scatter of groups is the error of the mean of all
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
        "failed": np.array(float(np.count_nonzero(residual > STEADY_TOLERANCE))),
        "balance": balance(motion),
        "time step": np.array(motion.time_step),
        "duration": np.array(motion.duration),
    }


def _motion(ensemble: WheelEnsemble) -> tuple[Motion, FloatArray]:
    """The motion, and what is left of a change from round to round where it should be periodic."""
    scene, wheel, height = ensemble.scene, ensemble.scene.body, ensemble.heights()
    law: ContactLaw = (linear_law_1d if ensemble.linear else SpringsLaw)(wheel, height, scene.spacing)
    approach, velocity = law.at_rest(0), np.zeros(ensemble.count)
    residual = np.zeros(ensemble.count)
    # a filter has its steady state in closed form; springs that lose contact need shooting
    if ensemble.track != "open" and isinstance(law, LinearLaw):
        approach, velocity = law.steady_state(scene.time_step)
    elif ensemble.track != "open":
        approach, velocity, residual = periodic_motion(
            wheel,
            lambda n: SpringsLaw(wheel, np.tile(height, (1, n)), scene.spacing),
            time_step=scene.time_step,
            steps=ensemble.places,
            start=(approach, velocity),
        )
    motion = simulate(wheel, law, time_step=scene.time_step, steps=ensemble.steps, approach=approach, velocity=velocity)
    return motion, residual


def linear_law_1d(wheel: Wheel, height: FloatArray, spacing: float) -> LinearLaw:
    """The linear contact of wheels on tracks: dF = sum over q of 2 E* sin(q a) / q h(q) exp(i q x), (14.11)."""
    # the whole track at once: (14.11) does not depend on the place, and its transform is periodic as the track
    q = 2 * np.pi * np.fft.rfftfreq(len(height), spacing)[:, np.newaxis]
    factor = response(q, contact_radius=wheel.contact_radius, modulus=wheel.modulus)
    return LinearLaw(wheel, np.fft.irfft(factor * np.fft.rfft(height, axis=0), len(height), axis=0))


def balance(motion: Motion) -> FloatArray:
    """Mean acceleration less the change of velocity over time, over the root mean square of the acceleration.

    For velocity Verlet sum (a_n + a_(n+1)) dt / 2 = v_N - v_0 holds to rounding; z upward, v downward.
    """
    a, ends = motion.acceleration, (motion.next_acceleration - motion.acceleration[0]) / 2
    change = -(motion.velocity - motion.initial_velocity) / motion.time_step
    return np.asarray((a.sum(axis=0) + ends - change) / (len(a) * np.sqrt(np.mean(a**2, axis=0))))


def band_edges(omega: FloatArray) -> FloatArray:
    """Edges of twelfths of an octave that hold a line or more, and of single lines below."""
    # below this line of the spectrum a twelfth of an octave is narrower than the distance of lines
    single = math.ceil(1 / (2 ** (1 / BANDS_PER_OCTAVE) - 1))
    lines = omega[0] * (np.arange(single) + 0.5)
    above = np.arange(0, BANDS_PER_OCTAVE * math.log2(len(omega) / (single + 0.5))) / BANDS_PER_OCTAVE
    return np.concatenate([lines, omega[0] * (single + 0.5) * 2**above])
