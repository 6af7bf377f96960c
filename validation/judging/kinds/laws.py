"""A contact law of others: the wheel of Table 14.1 rolls with it, and its spectrum is beside that on springs."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from validation.analysis.quantity import Quantity
from validation.analysis.spectra import band_means, record_spectra
from validation.analysis.statistics import (
    POWER_DECIBEL,
    Estimate,
    FloatArray,
    half_width,
    independent_records,
    jackknifed,
)
from validation.judging.judgement import LEVEL
from validation.judging.kinds.judge import Finding, LostError, ModelAnswer, answer_of, attempted, compared
from validation.judging.kinds.references import Reference, about, reference_rows
from validation.judging.registry import Caller, Failed
from validation.scenes.load import load_scene_with_track
from validation.scenes.rolling import RollingScene
from validation.simulation.motion import Motion, simulate
from validation.simulation.wheel_features import features_of
from validation.simulation.wheel_on_springs import band_edges

FEATURE, REGION = Quantity("feature_of_the_wheel"), Quantity("level_of_the_acceleration")
WHEELS, FARTHEST, BENDS, DOUBLINGS, HALVINGS = 20, 190.0, ((3 - math.sqrt(5)) / 2, math.sqrt(2) - 1.2), 12, 60
"""Wheels that roll; where the last one starts [m]; shares of the square and the cube in the starts, with which no
two distances between wheels are equal, and no period is in many of them; steps of the search for the load."""
FEWEST = 4.0
"""Independent records below which their scatter is unknown: of the peak that of the reference is taken, twice."""
PEAK = "peak ω_eigen"
AS_ONE = 0.1
"""A share of repeated records of which nothing is said."""
AT_REST = 1e-6
"""Change of the force along the track, over the load, that is none."""
AT_ONCE, DIFFERENCE, NEAR, ROUNDS = 1000, 1e-4, 1e-6, 12
"""Places of a call; part of the approach by which a slope is found, and to which a path is; attempts at it."""


def judged(model: Caller) -> Iterator[Finding]:
    """Features of its spectrum, and levels of its regions."""
    rows = reference_rows(FEATURE, REGION)
    features = attempted(_estimates, model)
    if isinstance(features, Failed):
        return compared(rows, features)
    estimates, records = features
    unseen = Failed("the spectrum does not show it")
    halves = [half_width(estimate, records, among=len(rows)) for estimate in estimates]
    values = [estimate.value for estimate in estimates]
    answers = (_model_answer(row, value, half, records) for row, value, half in zip(rows, values, halves, strict=True))
    return compared(rows, (answer if math.isfinite(answer.value) else unseen for answer in answers))


def _model_answer(row: Reference, value: float, half: float, records: float) -> ModelAnswer:
    """The value of a feature with its half-width of 95 %, relative to the value unless the row is a level.

    records: independent ones among the wheels, of which those on equal pieces of a track count as one. Of fewer than
    the wheels a reason says so. Of fewer than `FEWEST` the half-width of a peak is that of the reference for as many
    records, and of other features infinite.
    """
    answer = ModelAnswer(value, half / (1.0 if row.unit == LEVEL else abs(value) or 1.0))
    if records > (1 - AS_ONE) * WHEELS:
        return answer
    reason = f"{WHEELS} wheels are {records:.2g} independent records: the track repeats itself"
    if records < FEWEST:
        # a line spectrum has a peak, but no jump, slope or level of a continuous one
        of_one = 2 * row.sample * math.sqrt(about(row.quantity)["settings"]["realisations"] / records)
        answer = answer._replace(half=of_one if row.where.get("feature") == PEAK else math.inf)
    return answer._replace(reason=reason)


def table_14_1() -> RollingScene:
    """On half as many cells as the case has, which are five to the shortest wave."""
    return replace(table := load_scene_with_track("table_14_1"), springs=table.track.springs // 2)


def starts(scene: RollingScene) -> FloatArray:
    """Where the wheels start [m], at whole places of a track: of any period it has few of them on equal pieces."""
    part = np.arange(WHEELS) / (WHEELS - 1)
    square, cube = BENDS
    places = FARTHEST * ((1 - square - cube) * part + square * part**2 + cube * part**3)
    return np.asarray(scene.spacing * np.rint(places / scene.spacing))


def _estimates(model: Caller) -> tuple[list[Estimate], float]:
    """Features and levels, by the jackknife over the wheels; and as how many independent records these count."""
    scene = table_14_1()
    motion, along = rolled(model, scene)
    plain, hann = (record_spectra(motion.acceleration, time_step=motion.time_step, window=w) for w in ("none", "hann"))
    edges = band_edges(plain.omega)
    bands, centres = band_means(plain.omega, plain.density, edges), np.sqrt(edges[1:] * edges[:-1])

    def of(kept: FloatArray) -> FloatArray:
        wheels = kept.astype(int)
        features = features_of(scene, hann.omega, hann.density[:, wheels].mean(axis=1))
        decibels = POWER_DECIBEL * np.log(bands[:, wheels].mean(axis=1))
        return np.array([*features.values(), *by_region(scene, centres, decibels).values()])

    return list(jackknifed(of, np.arange(float(WHEELS)))), independent_records(along.T)


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


def rolled(model: Caller, scene: RollingScene) -> tuple[Motion, FloatArray]:
    """Each wheel begins at rest. Raises LostError for a law without an answer, or a motion.

    Returns the motion, and the force along each track at the approach of rest, (places, wheels) [N].

    A law has no memory, so it is asked along whole paths at once: first where the wheels would be at rest, then where
    they rolled on the law that is linear about the last paths, until they do not change.
    """
    places = scene.spacing * np.arange(scene.points + 1)[:, np.newaxis] + starts(scene)

    def force(d: FloatArray) -> FloatArray:
        """From the first place on, shape (places, wheels)."""
        at = np.broadcast_to(places[: len(d)], d.shape)
        slices = [slice(i, i + AT_ONCE) for i in range(0, len(d), AT_ONCE)]
        parts = [answer_of(model, approach=d[i].ravel(), position=at[i].ravel()) for i in slices]
        return np.concatenate(parts).reshape(d.shape)

    start = _at_rest(lambda d: force(d[np.newaxis])[0], scene)
    path = np.tile(start, (len(places), 1))
    along = at_path = force(path)
    for attempt in range(ROUNDS):
        at_path = force(path) if attempt else along
        if np.allclose(at_path, scene.load, rtol=AT_REST):
            raise LostError(
                Failed(f"the wheel stays at rest: the force does not change with the position under {in_words(scene)}")
            )
        stiffness = (force(path + (step := DIFFERENCE * scene.approach)) - at_path) / step
        law = LawAlongPaths(path, at_path, stiffness)
        try:
            motion = simulate(scene.body, law, time_step=scene.time_step, steps=scene.points, approach=start, path=True)
        except ValueError as error:
            raise LostError(Failed(str(error))) from None
        assert motion.path is not None  # which was asked for
        before, path = path, np.vstack([motion.path, motion.approach])
        if np.abs(path - before).max() < NEAR * scene.approach:
            return motion, along
    raise LostError(Failed(f"no motion is found in {ROUNDS} attempts: the force jumps with the approach"))


def in_words(scene: RollingScene) -> str:
    """Which wheel a law must bear."""
    wheel = f"R = {scene.radius:g} m, E* = {scene.modulus / 1e9:g} GPa, {scene.load:g} N, {scene.mass:g} kg"
    return f"the wheel of {scene.name} ({wheel}, {scene.speed:g} m/s, {1e6 * scene.approach:.3g} um on smooth ground)"


def _at_rest(force: Callable[[FloatArray], FloatArray], scene: RollingScene) -> FloatArray:
    """By halves, between approaches at which it bears less and more."""
    low, high = (np.full(WHEELS, sign * scene.approach) for sign in (-1.0, 1.0))
    for _ in range(DOUBLINGS):
        high = np.where(force(high) < scene.load, 2 * high, high)
        low = np.where(force(low) > scene.load, 2 * low, low)
    for d, wrong, word in ((high, force(high) < scene.load, "less"), (low, force(low) > scene.load, "more")):
        if wrong.any():
            raise LostError(
                Failed(f"at an approach of {d[wrong][0]:.2g} m it bears {word} than the load; {in_words(scene)}")
            )
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        heavy = force(middle) > scene.load
        low, high = np.where(heavy, low, middle), np.where(heavy, middle, high)
    return np.asarray((low + high) / 2)


def by_region(scene: RollingScene, omega: FloatArray, values: FloatArray) -> dict[str, float]:
    """Means of what is known at these frequencies."""
    regions = {name: (omega > first) & (omega < last) for name, (first, last) in ends_of(scene).items()}
    return {name: float(np.nanmean(values[inside])) for name, inside in regions.items()}


def ends_of(scene: RollingScene) -> dict[str, tuple[float, float]]:
    """Of the regions of Fig. 14.4, clear of peak, jump and end, and below half of the sampling rate [rad/s]."""
    peak, jump, end = scene.eigenfrequency, scene.jump, scene.cutoff
    return {
        "region 1": (peak / 2, 2 * peak),
        "region 2": (2 * peak, 0.8 * jump),
        "region 3": (1.1 * jump, 0.9 * end),
        "region 4": (1.3 * end, 2 * end),
    }
