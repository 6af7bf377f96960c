"""A factor that all points have in common is found and named; what no factor explains is not."""

import math

import numpy as np
import pytest

from tests.seeded import catches
from validation.judging.kinds import diagnosis
from validation.judging.kinds.diagnosis import OF_POWERS, OF_VALUES, common_factor, named

RNG = np.random.default_rng(5)


@pytest.mark.parametrize("factor", [0.909, 2.0, 0.5, math.pi, math.sqrt(2), 1.37])
def test_a_factor_of_all_points_is_found_within_their_errors(factor):
    halves = np.full(65, 0.02)
    ratios = factor * np.exp(RNG.uniform(-0.015, 0.015, 65))
    found = common_factor(ratios, halves)
    assert found.factor == pytest.approx(factor, rel=0.01) and found.kept == 65


@pytest.mark.parametrize(
    "ratios",
    [
        np.ones(40),
        np.full(40, 1.01),
        np.geomspace(1, 4, 40),
        np.r_[np.ones(8), np.full(32, 2.0)],
        np.full(4, 2.0),
        np.exp(np.linspace(-0.3, 0.3, 41)),
    ],
)
def test_no_factor_is_found_where_there_is_none(ratios):
    assert common_factor(ratios, np.full(len(ratios), 0.02)) is None


def test_a_factor_within_the_errors_of_most_points_is_none():
    assert common_factor(np.full(40, 1.3), np.full(40, 0.4)) is None


@catches("a factor that no name is near", factor=0.909, names=diagnosis.OF_VALUES, word="E for E*, at nu = 0.3").at(
    "validation.judging.kinds.diagnosis.NEAR", 0.0
)
@pytest.mark.parametrize(
    ("factor", "names", "word"),
    [
        (0.909, OF_VALUES, "E for E*, at nu = 0.3"),
        (8 / 9, OF_VALUES, "nu = 1/3"),
        (1.0989, OF_VALUES, "once more, at nu = 0.3"),
        (2.0, OF_VALUES, "diameter"),
        (1.1523, OF_VALUES, "square punch"),
        (math.pi, OF_VALUES, "pi"),
        (2.0, OF_POWERS, "one-sided for two-sided"),
        (4.0, OF_POWERS, "of the amplitude"),
        (0.8281, OF_POWERS, "E for E*"),
    ],
)
def test_a_factor_is_named_by_what_is_commonly_forgotten(factor, names, word):
    assert word in named(factor, 1e-3, names)


def test_a_factor_of_no_origin_has_no_name():
    assert not named(1.37, 1e-3, OF_VALUES) and not named(1.37, 1e-3, OF_POWERS)


def test_two_origins_that_are_as_near_are_both_named():
    """9/8 and 2/sqrt(pi)."""
    assert "nu = 1/3" in named(1.126, 1e-3, OF_VALUES) and "circular punch" in named(1.126, 1e-3, OF_VALUES)


def test_a_factor_of_less_than_two_per_cent_is_none():
    assert common_factor(np.full(40, 1.015), np.full(40, 1e-3)) is None
    assert common_factor(np.full(40, 1.025), np.full(40, 1e-3)) is not None
