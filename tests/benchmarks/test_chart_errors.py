"""How wrong an answer is beside its reference, of hand-made values."""

import dataclasses
import math

import numpy as np
import pytest

from tests.benchmarks.made_up import MEAN, k
from validation.benchmarks.work_precision.errors import MethodValues, error
from validation.benchmarks.work_precision.problem import Quantity
from validation.benchmarks.work_precision.rough_punch import log_deviation


def test_what_realisations_have_of_their_own_drops_out_of_paired_errors():
    drawn = np.random.default_rng(1).lognormal(0, 0.3, 12)
    paired = error(MEAN, MethodValues(k(1.1 * drawn)), MethodValues(k(drawn)))
    assert paired.value == pytest.approx(0.1)
    assert paired.over == pytest.approx(1.1)
    assert paired.half_width < 1e-9
    alone = error(MEAN, MethodValues(k(1.1 * drawn), paired=False), MethodValues(k(drawn)))
    assert alone.value == pytest.approx(0.1)
    # two means of twelve, each of a relative standard error of s / sqrt(12)
    expected = 2.2 * 1.1 * drawn.std(ddof=1) / drawn.mean() * math.sqrt(2 / 12)
    assert alone.half_width == pytest.approx(expected, rel=0.02)


def test_fewer_realisations_are_paired_with_the_first_of_the_reference():
    drawn = np.random.default_rng(2).lognormal(0, 0.3, 12)
    assert error(MEAN, MethodValues(k(1.1 * drawn[:5])), MethodValues(k(drawn))).value == pytest.approx(0.1)


def test_intervals_cover_the_truth():
    """Of 300 pairs of samples of the same mean, more than 90 % have an error that their interval holds."""
    rng, held = np.random.default_rng(3), 0
    for _ in range(300):
        mine, reference = rng.lognormal(0, 0.2, 20), rng.lognormal(0, 0.2, 10)
        found = error(MEAN, MethodValues(k(mine), paired=False), MethodValues(k(reference)))
        held += found.value <= found.half_width
    assert held > 0.90 * 300


def test_no_scatter_is_all_wrong_and_a_single_value_has_none():
    assert log_deviation({"stiffness": np.ones(1)}) == -np.inf
    quantity = Quantity(name="deviation", log=log_deviation, needs=("stiffness",))
    drawn = {"stiffness": np.random.default_rng(4).lognormal(0, 0.3, 12)}
    found = error(quantity, MethodValues({"stiffness": np.ones(1)}, paired=False), MethodValues(drawn))
    assert found.value == 1.0


@pytest.mark.parametrize("order", [1.0, 2.0])
def test_two_grids_of_a_power_law_are_extrapolated_to_the_truth(order):
    quantity = dataclasses.replace(MEAN, order=order)
    coarse, fine = (k([math.exp(0.3 * n**-order)]) for n in (10.0, 15.0))
    assert error(quantity, MethodValues(fine, coarse, 1.5), MethodValues(k([1.0]))).value < 1e-12
    assert error(quantity, MethodValues(fine), MethodValues(k([1.0]))).value > 1e-4


def test_levels_differ_by_the_root_mean_square_of_decibels():
    quantity = Quantity(name="levels", log=lambda a: np.log(a["k"].mean(axis=0)), needs=("k",), decibel=True)
    found = error(quantity, MethodValues(k([[2.0, 1.0]])), MethodValues(k([[1.0, 1.0]])))
    assert found.value == pytest.approx(10 * math.log10(2) / math.sqrt(2))
    assert math.isnan(found.over)
