"""Small wheels on rough tracks."""

import math
from dataclasses import replace

import numpy as np

from validation.cases.wheel import half_space as wheel_3d
from validation.scenes.dynamic_wheel import load_wheel_scene
from validation.simulation.wheel_on_springs import WheelEnsemble

TABLE = load_wheel_scene("table_14_1")
ROUNDING = 1e-12
DECIBEL = 10 / math.log(10)
SMALL = replace(TABLE, distance=0.16, springs=24, rail=replace(TABLE.rail, shortest=0.5e-3))
"""Seven natural periods in two thousand steps."""
BOTH = replace(SMALL, wheel=replace(SMALL.rail, rms=0.3e-6, longest=5e-3, hurst=0.5))
LITTLE = replace(SMALL, radius=0.02, rail=None, wheel=replace(SMALL.rail, shortest=0.4e-3), distance=0.3)
"""A wheel that turns more than twice."""
TRACKS = ("open", "periodic", "steady-state")


def rides(scene=SMALL, **settings):
    return WheelEnsemble(scene=scene, **{"seed": 5, **settings})


def power(height):
    """Mean square of each wave of a track, two-sided, shape (waves, wheels), without the mean."""
    return np.abs(np.fft.rfft(height, axis=0, norm="forward")[1:]) ** 2


COARSE = replace(TABLE, springs=8, distance=0.16, rail=replace(TABLE.rail, longest=8e-3, shortest=2e-3))
LOW = replace(COARSE, rail=replace(COARSE.rail, shortest=4e-3, rms=1e-3 * COARSE.approach))


QUICK_3D = wheel_3d.Wheel3D(
    scene=COARSE, strips=3, coarser=1, cells=4, coarse=3, shared=1, wheels=20, groups=5, tolerance=1e-4
)
