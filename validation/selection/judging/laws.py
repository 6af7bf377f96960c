"""A contact law of others: the wheel of Table 14.1 rolls with it, and its spectrum is beside that on springs."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from validation.analysis.spectra import band_means, record_spectra
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, jackknifed
from validation.engine.offered import Caller, Failed
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.selection.judging.judge import Finding, LostError, ModelAnswer, asked, attempted, beside
from validation.selection.judging.references import known
from validation.simulation.motion import Motion, simulate
from validation.simulation.wheel_features import features_of
from validation.simulation.wheel_on_springs import band_edges

FEATURE, REGION = "feature of the wheel", "level of the acceleration"
WHEELS, APART, DOUBLINGS, HALVINGS = 20, 10.0, 12, 60
"""Wheels that roll, metres from one to the next; steps of the search for the load."""
AT_REST = 1e-6
"""Change of the force along the track, over the load, that is none."""
AT_ONCE, DIFFERENCE, NEAR, ROUNDS = 1000, 1e-4, 1e-6, 12
"""Places of a call; part of the approach by which a slope is found, and to which a path is; attempts at it."""


def judged(model: Caller) -> Iterator[Finding]:
    """Features of its spectrum, and levels of its regions."""
    rows = known(FEATURE, REGION)
    found = attempted(_found, model)
    if isinstance(found, Failed):
        return beside(rows, found)
    unseen = Failed("the spectrum does not show it")
    answers = (ModelAnswer.of(one, row.unit) for row, one in zip(rows, found, strict=True))
    return beside(rows, (one if math.isfinite(one.value) else unseen for one in answers))


def _found(model: Caller) -> list[Estimate]:
    """Features and levels, by the jackknife over the wheels."""
    # half as many cells as the case has, which are five to the shortest wave
    scene = replace(table := load_wheel_scene("table_14_1"), springs=table.springs // 2)
    motion = rolled(model, scene)
    plain, hann = (record_spectra(motion.acceleration, time_step=motion.time_step, window=w) for w in ("none", "hann"))
    edges = band_edges(plain.omega)
    bands, centres = band_means(plain.omega, plain.density, edges), np.sqrt(edges[1:] * edges[:-1])

    def of(kept: FloatArray) -> FloatArray:
        some = kept.astype(int)
        features = features_of(scene, hann.omega, hann.density[:, some].mean(axis=1))
        decibels = POWER_DECIBEL * np.log(bands[:, some].mean(axis=1))
        return np.array([*features.values(), *by_region(scene, centres, decibels).values()])

    return list(jackknifed(of, np.arange(float(WHEELS))))


@dataclass(frozen=True)
class LawAlongPaths:
    """Wheels on one track, linear in the approach about a path of each: F = F_0 + k (d - d_0), all (places, wheels)."""

    path: FloatArray
    at_path: FloatArray
    stiffness: FloatArray

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        return np.asarray(self.at_path[place] + self.stiffness[place] * (approach - self.path[place]))

    def at_rest(self, place: int) -> FloatArray:
        raise NotImplementedError


def rolled(model: Caller, scene: WheelScene) -> Motion:
    """Each wheel begins at rest, APART from the last. Raises LostError for a law without an answer, or a motion.

    A law has no memory, so it is asked along whole paths at once: first where the wheels would be at rest, then where
    they rolled on the law that is linear about the last paths, until they do not change.
    """
    places = scene.spacing * np.arange(scene.points + 1)[:, np.newaxis] + APART * np.arange(WHEELS)

    def force(d: FloatArray) -> FloatArray:
        """From the first place on, shape (places, wheels)."""
        at = np.broadcast_to(places[: len(d)], d.shape)
        some = [slice(i, i + AT_ONCE) for i in range(0, len(d), AT_ONCE)]
        parts = [asked(model, approach=d[i].ravel(), position=at[i].ravel()) for i in some]
        return np.concatenate(parts).reshape(d.shape)

    start = _at_rest(lambda d: force(d[np.newaxis])[0], scene)
    path = np.tile(start, (len(places), 1))
    for _ in range(ROUNDS):
        at_path = force(path)
        if np.allclose(at_path, scene.load, rtol=AT_REST):
            raise LostError(Failed("the wheel stays at rest: the force does not change with the position"))
        stiffness = (force(path + (step := DIFFERENCE * scene.approach)) - at_path) / step
        law = LawAlongPaths(path, at_path, stiffness)
        try:
            motion = simulate(scene.body, law, time_step=scene.time_step, steps=scene.points, approach=start, path=True)
        except ValueError as error:
            raise LostError(Failed(str(error))) from None
        assert motion.path is not None  # which was asked for
        before, path = path, np.vstack([motion.path, motion.approach])
        if np.abs(path - before).max() < NEAR * scene.approach:
            return motion
    raise LostError(Failed(f"no motion is found in {ROUNDS} attempts: the force jumps with the approach"))


def _at_rest(force: Callable[[FloatArray], FloatArray], scene: WheelScene) -> FloatArray:
    """By halves, between approaches at which it bears less and more."""
    low, high = (np.full(WHEELS, sign * scene.approach) for sign in (-1.0, 1.0))
    for _ in range(DOUBLINGS):
        high = np.where(force(high) < scene.load, 2 * high, high)
        low = np.where(force(low) > scene.load, 2 * low, low)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        heavy = force(middle) > scene.load
        low, high = np.where(heavy, low, middle), np.where(heavy, middle, high)
    return np.asarray((low + high) / 2)


def by_region(scene: WheelScene, omega: FloatArray, values: FloatArray) -> dict[str, float]:
    """Means of what is known at these frequencies."""
    regions = {name: (omega > first) & (omega < last) for name, (first, last) in ends_of(scene).items()}
    return {name: float(np.nanmean(values[inside])) for name, inside in regions.items()}


def ends_of(scene: WheelScene) -> dict[str, tuple[float, float]]:
    """Of the regions of Fig. 14.4, clear of peak, jump and end, and below half of the sampling rate [rad/s]."""
    peak, jump, end = scene.eigenfrequency, scene.jump, scene.cutoff
    return {
        "region 1": (peak / 2, 2 * peak),
        "region 2": (2 * peak, 0.8 * jump),
        "region 3": (1.1 * jump, 0.9 * end),
        "region 4": (1.3 * end, 2 * end),
    }
