"""Ridges across the track, rolled over by boundary elements and by springs: the response of the force to each wave."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import random_generator

BEM, FILTER, FULL, SPRINGS = "bem3d", "(14.11)", "springs, full contact", "springs, one-sided"
CONTACT: dict[str, mdr.rolling.Contact] = {FILTER: "linear", FULL: "full", SPRINGS: "one-sided"}


@dataclass(frozen=True, kw_only=True)
class SuperposedRidges:
    """Many waves at once, with amplitudes as 1/q, so that the force is as large by every wave; a = d = E* = 1.

    length: of the track over a, the longest wave; shortest: q a of the last; height: rms, over d; seed.
    """

    length: int
    shortest: float
    height: float
    seed: int

    @cached_property
    def wavenumbers(self) -> FloatArray:
        """q a of all waves of the track, up to the shortest."""
        count = int(self.shortest * self.length / (2 * np.pi))
        return np.asarray(2 * np.pi / self.length * np.arange(1, count + 1))

    def heights(self, points: int) -> FloatArray:
        """The heights of the ridges at so many equidistant points of the track, (points,)."""
        q = self.wavenumbers
        x = self.length / points * np.arange(points)
        phase = 2 * np.pi * random_generator(self.seed).random(q.size)
        unit = np.cos(np.outer(x, q) + phase) @ (1 / q)
        return np.asarray(self.height * unit / math.sqrt(np.sum(0.5 / q**2)))

    def response(self, up: FloatArray, down: FloatArray, height: FloatArray) -> NDArray[np.complex128]:
        """The transfer function from height to force, (waves,); (up - down) / 2 has no even orders of the height."""
        waves = slice(1, self.wavenumbers.size + 1)
        return np.asarray(np.fft.rfft((up - down) / 2)[waves] / np.fft.rfft(height)[waves])


@dataclass(frozen=True, kw_only=True)
class RidgesTrack:
    """One track, rolled by one method, at the prescribed approach or at the force that belongs to it.

    cells: or springs, to a contact radius; tolerance: residual of boundary elements.
    """

    ridges: SuperposedRidges
    method: str
    cells: float
    prescribed: str = "approach"
    tolerance: float = 1e-10


def roll_over(track: RidgesTrack) -> Outcome:
    """Response to each wave over 2 E* a, real and imaginary part, of the force, or of the approach under a force."""
    ridges, by_approach = track.ridges, track.prescribed == "approach"
    points = round(ridges.length * track.cells)
    height = ridges.heights(points)
    settings: dict[str, Any] = {
        "spacing": ridges.length / points,
        "radius": 1.0,
        "modulus": 1.0,
        **({"approach": 1.0} if by_approach else {"force": 4 / 3}),
    }
    runs = [_roll(track, sign * height, settings) for sign in (1, -1)]
    up, down = (run.force if by_approach else run.approach for run in runs)
    response = ridges.response(up, down, height) / 2
    failed = sum(np.count_nonzero(~run.converged) for run in runs if isinstance(run, bem3d.Rolling))
    return {"response": np.stack([response.real, response.imag]), "failed": np.array(float(failed))}


def _roll(track: RidgesTrack, height: FloatArray, settings: dict[str, Any]) -> bem3d.Rolling | mdr.RollingTrack:
    """The ridges rolled over by the method of the track: on springs, or by boundary elements on a strip of them."""
    if track.method != BEM:
        return mdr.roll(height, contact=CONTACT[track.method], **settings)
    width = 2 * math.ceil(1.45 / settings["spacing"])
    strip = np.repeat(height[:, np.newaxis], width, axis=1)
    return bem3d.roll(strip, tolerance=track.tolerance, raise_on_failure=False, **settings)
