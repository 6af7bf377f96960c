"""What decides how far cheap models are off: conditions of scenes by hand, and what lies beyond them in words."""

import math

import numpy as np
import pytest

from tests.advice.planted_answers import punch, waves, wheel
from validation.advice.calibration import (
    HEIGHT,
    HURST,
    LOAD,
    LONG,
    MOVING_LONG,
    RATIO,
    SHORT,
    WAVES,
    conditions_of,
    lost_contact,
    outside,
    rolling_conditions,
    sphere_shape,
)
from validation.scenes.indentation import IndentationScene
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.rolling import RollingQuantity
from validation.scenes.roughness import Roughness

ROUGH = Roughness(rms=1e-7, hurst=0.7, longest=2e-3, shortest=1e-4)
SPHERE = IndentationScene(name="s", shape="sphere", size=0.5, load=4905.0, modulus=1e11, ground=ROUGH)
APPROACH = (4905.0 / (4 / 3 * 1e11 * math.sqrt(0.5))) ** (2 / 3)
RADIUS = math.sqrt(0.5 * APPROACH)
"""Of the smooth sphere, by Hertz."""
PUNCH = punch(load=6.0, size=4.0, modulus=2.0, ground=waves(first=0.5, last=2.5, rms=0.5, hurst=0.4))


def test_conditions_of_a_punch_are_its_load_and_its_waves():
    assert conditions_of(PUNCH) == pytest.approx({LOAD: 3.0 / (2.0 * 0.5 * 4.0), WAVES: 2.0, RATIO: 5.0, HURST: 0.4})
    assert sphere_shape(PUNCH) == 1.0


def test_conditions_of_a_sphere_are_its_height_and_its_waves_over_the_contact():
    found = conditions_of(SPHERE)
    q = 2 * math.pi / 2e-3
    expected = {HEIGHT: 1e-7 / APPROACH, LONG: q * RADIUS, SHORT: 20 * q * RADIUS, RATIO: 20.0, HURST: 0.7}
    assert found == pytest.approx(expected)
    lost = lost_contact(SPHERE)
    assert 0 < lost < 1
    assert sphere_shape(SPHERE) == pytest.approx(lost + 0.05 * 1e-7 / APPROACH * q * RADIUS + 0.005)


def test_conditions_of_a_wheel_are_those_of_its_contact_and_a_moving_one_counts_its_waves_alone():
    still = RollingQuantity(wheel(height=0.01), "force-spectrum")
    expected = {HEIGHT: 0.01, LONG: 1.0, SHORT: 4.0, RATIO: 4.0, HURST: 0.7}
    assert rolling_conditions(still) == pytest.approx(expected)
    moving = RollingQuantity(wheel(height=0.01, mass=1.0, speed=10.0), "acceleration")
    found = rolling_conditions(moving)
    assert set(found) == {HEIGHT, MOVING_LONG, SHORT, RATIO, HURST}
    assert found[HEIGHT] == pytest.approx(0.01 * moving.amplification) and found[HEIGHT] > 0.01
    assert found[MOVING_LONG] == pytest.approx(moving.longest_moving)


def test_of_measured_heights_waves_of_four_points_are_the_shortest():
    """Steps of 0.1 under a contact of radius one: 2 pi / 0.4, not the pi / 0.1 of a wave of two points."""
    height = 1e-3 * np.random.default_rng(0).standard_normal((128, 64))
    ground = MeasuredHeights(height=height - height.mean(), spacing=(0.1, 0.1))
    found = rolling_conditions(RollingQuantity(wheel(ground=ground), "force-rms"))
    assert found[SHORT] == pytest.approx(2 * math.pi / 0.4)
    assert found[RATIO] == pytest.approx(found[SHORT] / found[LONG]) and HURST not in found


@pytest.mark.parametrize(
    ("value", "ranges", "said"),
    [
        (2.0, {LOAD: (1.0, 2.0)}, ""),
        (1.0, {LOAD: (1.0, 2.0)}, ""),
        # the rounding of units, and no number at all
        (2.0 + 1e-12, {LOAD: (1.0, 2.0)}, ""),
        (math.nan, {LOAD: (2.0, math.inf)}, "F / (E* h L) = nan; the error of the model is known from 2 on only"),
        (2.1, {LOAD: (1.0, 2.0)}, "F / (E* h L) = 2.1; the error of the model is known from 1 to 2 only"),
        (0.9, {LOAD: (1.0, math.inf)}, "F / (E* h L) = 0.9; the error of the model is known from 1 on only"),
        (5.0, {HURST: (0.2, 1.0)}, ""),
    ],
)
def test_the_first_condition_beyond_its_range_is_named(value, ranges, said):
    assert outside({LOAD: value, WAVES: 3.0}, ranges) == said
