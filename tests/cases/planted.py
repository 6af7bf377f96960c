"""Small wheels on rough tracks; results some of whose outcomes are changed on purpose, and their verdicts."""

import math
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from validation.analysis.evidence import numbers_with
from validation.cases.wheel import half_space as wheel_3d
from validation.scenes.load import load_scene_with_track
from validation.simulation.wheel_on_springs import WheelEnsemble

NOTHING = MappingProxyType({})


def changed(result, found=NOTHING, **more):
    """With other outcomes under some keys."""
    return replace(result, by_key={**result.by_key, **found, **more})


def times(outcomes, factor, *names):
    """Outcomes with a factor on some of their values."""
    return [one | {name: factor * one[name] for name in names} for one in outcomes]


def judged(case, result, quantity=None, model=None, **where):
    """Numbers with this key, of which there are some."""
    found = numbers_with(case.evidence(result).numbers, quantity, model, **where)
    assert found
    return found


def verdicts(case, result, quantity=None, model=None, **where):
    return {number.verdict for number in judged(case, result, quantity, model, **where)}


def statuses(evidence):
    return [claim.status for claim in evidence.claims]


def whole(evidence):
    """All criteria are met and all numbers are there."""
    assert [number.sentence for number in evidence.numbers if not number.met] == []
    assert np.isfinite([(number.value, number.uncertainty) for number in evidence.numbers]).all()
    assert evidence.unconverged == ()
    return evidence


TABLE = load_scene_with_track("table_14_1")
ROUNDING = 1e-12
DECIBEL = 10 / math.log(10)
SMALL = replace(TABLE, distance=0.16, springs=24, ground=replace(TABLE.rail, shortest=0.5e-3))
"""Seven natural periods in two thousand steps."""
BOTH = replace(SMALL, wheel=replace(SMALL.rail, rms=0.3e-6, longest=5e-3, hurst=0.5))
LITTLE = replace(SMALL, radius=0.02, ground=None, wheel=replace(SMALL.rail, shortest=0.4e-3), distance=0.3)
"""A wheel that turns more than twice."""
COARSE = replace(TABLE, springs=8, distance=0.16, ground=replace(TABLE.rail, longest=8e-3, shortest=2e-3))
LOW = replace(COARSE, ground=replace(COARSE.rail, shortest=4e-3, rms=1e-3 * COARSE.approach))
QUICK_3D = wheel_3d.Wheel3D(scene=COARSE, strips=3, finer=3, cells=4, shared=1, wheels=20, groups=5, tolerance=1e-4)
TRACKS = ("open", "part", "steady-state")


def rides(scene=SMALL, **settings):
    return WheelEnsemble(scene=scene, **{"seed": 5, **settings})


def power(height):
    """Mean square of each wave of a track, two-sided, shape (waves, wheels), without the mean."""
    return np.abs(np.fft.rfft(height, axis=0, norm="forward")[1:]) ** 2
