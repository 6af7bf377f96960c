"""Error bars of pairs of grids, and of methods on a chart, on populations with a known answer."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from tests.analysis.intervals import covered, holds, t
from tests.seeded import catches
from validation.analysis import statistics
from validation.analysis.case import Outcomes
from validation.analysis.series import Series
from validation.analysis.statistics import (
    DECIBEL,
    Estimate,
    Linearised,
    Resolved,
    combined,
    extrapolate_to_zero,
    extrapolated,
    jackknifed,
    on_finest,
    student,
)
from validation.benchmarks.work_precision.pareto import MethodValues, error
from validation.benchmarks.work_precision.problem import ChartQuantity, mean_of
from validation.cases.punch import fractal_punch_study as study
from validation.cases.punch.ensembles import MEAN as MEAN_STIFFNESS
from validation.cases.punch.fractal_punch import FractalPunch, PunchStatistics
from validation.simulation.rough_punch import MDR


def half_of_the_way(coarse, finer):
    """What halving the cells changes, for what all halvings do."""
    value, left = statistics.extrapolated(coarse, finer)
    return replace(value, value=coarse.value + finer.value), left


@catches("half of the way to cells of no size").at(f"{__name__}.extrapolated", half_of_the_way)
def test_what_extrapolation_leaves_open_is_half_of_its_way_and_the_interval_of_all_of_it():
    """To cells of no size it is twice the change from one grid to the next."""
    coarse, finer = Estimate(1.0, 0.2, 20), Estimate(-0.1, 0.03, 4)
    value, left = extrapolated(coarse, finer)
    assert value == Estimate(0.8, 0.2, 20)
    assert left == pytest.approx(0.1 + 2 * t(4) * 0.03)
    assert extrapolated(coarse, finer, among=5)[1] == pytest.approx(0.1 + 2 * stats.t.ppf(0.995, 3) * 0.03)


@pytest.mark.slow
@pytest.mark.parametrize("refined", [3, 6])
def test_sample_and_grid_together_hold_cells_of_no_size(refined):
    """Few of twelve surfaces on the finer grid: added as if they went the same way, the two hold more than 95 %."""
    rng = np.random.default_rng(refined)

    def drawn():
        # stiffness on cells of size 1 and 1/2, whose error is of first order, with a slope of their own
        true, own = 1 + 0.1 * rng.standard_normal(12), 0.1 + 0.02 * rng.standard_normal(12)
        grids = true[:, np.newaxis] * np.exp(np.outer(own, [1, 0.5]))
        (coarse,) = jackknifed(lambda rows: np.log(rows[:, 0].mean()), grids)
        (finer,) = jackknifed(lambda rows: np.log(rows[:, 1].mean() / rows[:, 0].mean()), grids[:refined])
        value, left = extrapolated(coarse, finer)
        return value.value, value.half_width + left

    assert covered(drawn, 0.0, trials=200) >= 0.95


def steps(*values, error=0.01, n=50):
    """A statistic on grids, coarse to fine, from the same realisations; the steps between grids have no error."""
    influence = np.zeros(n)
    influence[:2] = error / math.sqrt(2)
    return {8 * 2**i: Linearised(value, influence) for i, value in enumerate(values)}


def compared(bem, springs, *, name=MEAN_STIFFNESS, among=4):
    apart = on_finest(list(springs.values())).minus_independent(extrapolate_to_zero(list(bem.values())))
    return number_of(apart, name, among)


def number_of(apart, name, among=1):
    settings = {"margin": study.LEVEL, "scale": DECIBEL} if name == MEAN_STIFFNESS else {"margin": study.DIGITS}
    (number,) = Series(name, "", (apart.value,), grid=(apart.grid,), family=among, **settings).numbers
    return number


def test_the_grid_interval_of_fig_14_1():
    """Cells of no size lie f beyond the finest grid by the two finest, and c beyond the middle one by the next two:
    what both differ by, and what doubling the springs changes. Nothing of that is the sample's."""
    number = compared(steps(0.2, 0.25, 0.27), steps(0.504, 0.5))
    assert number.grid == pytest.approx(DECIBEL * (abs(2 * 0.02 - 0.05) + 0.004))
    assert number.value == pytest.approx(DECIBEL * (0.5 - 0.27 - 0.02))
    for worse in (
        compared(steps(0.2, 0.24, 0.27), steps(0.504, 0.5)),
        compared(steps(0.1, 0.25, 0.27), steps(0.504, 0.5)),
        compared(steps(0.2, 0.25, 0.27), steps(0.51, 0.5)),
    ):
        assert worse.grid > number.grid
        assert worse.sample == number.sample
    exponent = compared(steps(0.2, 0.25, 0.27), steps(0.504, 0.5), name=study.EXPONENT)
    assert (exponent.grid, exponent.value) == pytest.approx((0.014, 0.21))


KNOWN_GRIDS = {"up": 0.03, "down": 0.05}


def resolved(grid, value=1.0):
    """A statistic of five realisations that its grids leave open by so much."""
    return Resolved(Linearised(value, np.zeros(5)), grid)


COMBINED = statistics.combined


def cancelled(weights, parts):
    """Grid errors with the signs of their weights."""
    whole = COMBINED(weights, parts)
    return replace(whole, grid=abs(float(np.dot(weights, [part.grid for part in parts]))))


@catches("grid errors of Fig. 14.1 that cancel in a difference", weights=(-2.0, 2.0), left=0.16).at(
    f"{__name__}.combined", cancelled
)
@pytest.mark.parametrize(("weights", "left"), [((0.5, 0.5), 0.04), ((-2.0, 2.0), 0.16), ((2.0, -2.0), 0.16)])
def test_grid_errors_of_fig_14_1_never_cancel(weights, left):
    """Two grid errors of unknown sign add up in a mean and in a difference, whichever is the larger."""
    for grids in (KNOWN_GRIDS.values(), reversed(KNOWN_GRIDS.values())):
        parts = [resolved(grid) for grid in grids]
        assert combined(weights, parts).grid == pytest.approx(left)


def difference_with_its_sign(one, other):
    return statistics.Resolved(one.value.minus_independent(other.value), abs(one.grid - other.grid))


@catches("grid errors of Fig. 14.1 that cancel in an exponent").at(
    "validation.cases.punch.fractal_punch.combined", cancelled
)
@catches("grid errors of two methods that cancel").at(
    "validation.analysis.statistics.Resolved.minus_independent", difference_with_its_sign
)
def test_grid_errors_of_an_exponent_a_trend_and_a_ratio_add_up():
    """The same grid error at both ends of a decade, at all Hurst exponents and in both methods."""
    case = FractalPunch(hursts=(0.4, 0.7, 1.0), cells=8, surfaces=((0, 4, 4, 4, 0),), decades=(-1, 0))
    found = PunchStatistics(Outcomes(case, {}))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(PunchStatistics, "at", lambda *_: resolved(0.01))
        apart = math.log(case.forces[-1] / case.forces[0])
        assert found.exponent(0.7, MDR, 0, len(case.forces) - 1).grid == pytest.approx(0.02 / apart)
        # slope of least squares over 0.4, 0.7, 1: weights -1 / 0.6, 0, 1 / 0.6
        assert found.trend(MDR, 0).grid == pytest.approx(0.02 / 0.6)
    for name, scale in ((MEAN_STIFFNESS, DECIBEL), (study.EXPONENT, 1.0)):
        assert number_of(resolved(0.03).minus_independent(resolved(0.05)), name).grid == pytest.approx(scale * 0.08)


@catches("profiles and surfaces taken for the same realisations").at(
    "validation.analysis.statistics.Linearised.minus_independent", lambda mine, other: mine - other
)
def test_the_sample_interval_of_fig_14_1():
    """Root of the sum of squares of surfaces and profiles, at once for all forces of the decade."""
    one, four = (compared(steps(0.2, 0.25, 0.27), steps(0.5, 0.5, error=0.02), among=n) for n in (1, 4))
    freedom = Linearised(0.0, np.array([0.02, 0.02, 0.01, 0.01])).freedom
    assert one.sample == pytest.approx(DECIBEL * student(freedom) * math.hypot(0.01, 0.02))
    assert four.sample / one.sample == pytest.approx(student(freedom, 1 - 0.05 / 4) / student(freedom))


MEAN = mean_of("mean", "k")
LEVEL = mean_of("level", "k", decibel=True)


@pytest.mark.slow
@pytest.mark.parametrize(("size", "short"), [(4, 0.0), (12, 0.0)])
@pytest.mark.parametrize("paired", [True, False])
@pytest.mark.parametrize("quantity", [MEAN, LEVEL])
def test_the_error_of_an_answer_covers_its_truth(size, short, paired, quantity):
    """1.5 times the reference: the distance |ratio - 1| or 10 lg of it. Alone, hypot of two quantiles is wide."""
    rng = np.random.default_rng(size)
    truth = 0.5 if quantity is MEAN else 10 * math.log10(1.5)

    def drawn():
        reference = 1 + 0.1 * rng.standard_normal(size)
        own = reference if paired else 1 + 0.1 * rng.standard_normal(size)
        mine = 1.5 * own * (1 + 0.05 * rng.standard_normal(size))
        one = error(quantity, MethodValues({"k": mine}, paired=paired), MethodValues({"k": reference}))
        return one.value, one.half_width

    assert holds(covered(drawn, truth, trials=400), trials=400, short=short, wide=0.0 if paired else 0.04)


def test_two_realisations_have_an_error_bar_and_one_has_none():
    x, exact = np.array([1.0, 1.2]), {"k": np.array([1.0, 1.0])}
    assert error(MEAN, MethodValues({"k": x}), MethodValues(exact)).half_width == pytest.approx(t(2) * 0.1)
    assert error(MEAN, MethodValues({"k": x[:1]}), MethodValues({"k": np.ones(1)})).half_width == 0.0
    alone = error(MEAN, MethodValues({"k": np.ones(1)}, paired=False), MethodValues({"k": x}))
    assert alone.half_width == pytest.approx(t(2) * 0.1 / 1.1**2, rel=0.01)


def test_two_realisations_tell_nothing_of_how_a_deviation_scatters():
    deviation = ChartQuantity(
        name="s", log=lambda a: np.log(np.atleast_1d(a["k"].std(ddof=1) if a["k"].size > 1 else 0.0)), needs=("k",)
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        found_ = error(deviation, MethodValues({"k": np.array([1.0, 1.2])}), MethodValues({"k": np.array([1.0, 1.3])}))
    assert found_.half_width == math.inf
