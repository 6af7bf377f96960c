"""Errors of answers beside their reference and what they cost, point by point, of hand-made values; no clock."""

import dataclasses
import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from tests.benchmarks.made_up import MEAN, k
from tests.seeded import Times, catches, module_with
from validation.benchmarks.timing import FINISHED, OUT_OF_RANGE, Configuration
from validation.benchmarks.work_precision import pareto
from validation.benchmarks.work_precision.pareto import MethodValues, error, points, reference_of
from validation.benchmarks.work_precision.problem import EXTRAPOLATED, ChartQuantity, log_deviation, mean_of
from validation.engine.realisations import NotConvergedError

LEVEL = mean_of("level", "k", decibel=True, order=2.0)


@catches("the same surfaces taken for others").at(
    f"{__name__}.error",
    lambda quantity, mine, reference: pareto.error(quantity, dataclasses.replace(mine, paired=False), reference),
)
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


@pytest.mark.parametrize("fewer", [1, 5])
def test_fewer_realisations_are_paired_with_the_first_of_the_reference(fewer):
    drawn = np.random.default_rng(2).lognormal(0, 0.3, 12)
    assert error(MEAN, MethodValues(k(1.1 * drawn[:fewer])), MethodValues(k(drawn))).value == pytest.approx(0.1)


def test_no_scatter_is_all_wrong_and_a_single_value_has_none():
    assert log_deviation({"stiffness": np.ones(1)}) == -np.inf
    quantity = ChartQuantity(name="deviation", log=log_deviation, needs=("stiffness",))
    drawn = {"stiffness": np.random.default_rng(4).lognormal(0, 0.3, 12)}
    found = error(quantity, MethodValues({"stiffness": np.ones(1)}, paired=False), MethodValues(drawn))
    assert found.value == 1.0


def at_first_order(answer, quantity, rows):
    return log_of_answer(answer, dataclasses.replace(quantity, order=1.0), rows)


log_of_answer = pareto.MethodValues.log


@catches("first order for second in an extrapolation", order=2.0).at(
    "validation.benchmarks.work_precision.pareto.MethodValues.log", at_first_order
)
@pytest.mark.parametrize("order", [1.0, 2.0])
def test_two_grids_of_a_power_law_are_extrapolated_to_the_truth(order):
    quantity = dataclasses.replace(MEAN, order=order)
    coarse, fine = (k([math.exp(0.3 * n**-order)]) for n in (10.0, 15.0))
    assert error(quantity, MethodValues(fine, coarse, 1.5), MethodValues(k([1.0]))).value < 1e-12
    assert error(quantity, MethodValues(fine), MethodValues(k([1.0]))).value > 1e-4


@catches("decibels of an amplitude for those of a power").at(
    "validation.benchmarks.work_precision.problem.ChartQuantity.distance", Times(2.0)
)
def test_levels_differ_by_the_root_mean_square_of_decibels():
    """Other values by the farthest of them; several numbers have no ratio."""
    several = ChartQuantity(name="several", log=lambda a: np.log(a["k"].mean(axis=0)), needs=("k",))
    mine, reference = MethodValues(k([[2.0, 1.0]])), MethodValues(k([[1.0, 1.0]]))
    found = error(dataclasses.replace(several, decibel=True), mine, reference)
    assert found.value == pytest.approx(10 * math.log10(2) / math.sqrt(2))
    assert math.isnan(found.over)
    assert error(several, MethodValues(k([[1.1, 0.7]])), reference).value == pytest.approx(0.3)


@catches("an error that luck has made small, and its interval", quantity=MEAN, paired=True).at(
    "validation.benchmarks.work_precision.pareto.math", module_with(math, copysign=lambda *_: 1.0)
)
@pytest.mark.parametrize("quantity", [MEAN, LEVEL])
@pytest.mark.parametrize("paired", [True, False])
def test_an_answer_that_luck_has_put_on_its_reference_scatters_as_much(quantity, paired):
    """Its distance has no sign, and without one its changes would be folded into each other."""
    x = np.array([0.9, 0.95, 1.0, 1.05, 1.1])

    def half(factor):
        return error(quantity, MethodValues(k(factor * x), paired=paired), MethodValues(k(np.ones(5)))).half_width

    unit = 10 / math.log(10) if quantity.decibel else 1.0
    assert half(1.0) == pytest.approx(2.776 * unit * x.std(ddof=1) / math.sqrt(5), rel=0.01)
    assert half(1.0) == pytest.approx(half(1.5) / (1.0 if quantity.decibel else 1.5), rel=1e-6)


def attempt(label, value, **settings):
    known = {"method": None, "scene": None, "resolution": None, "parameter": "# cells"}
    return Configuration(label=label, value=value, **known, **settings)


COARSE, FINE, SPRINGS = attempt("BEM", 8.0), attempt("BEM", 12.0), attempt("MDR", 64.0, paired=False)
LOST = attempt("MDR", 99.0)


@dataclass(frozen=True)
class MadeProblem:
    """Made up."""

    quantities: tuple[ChartQuantity, ...] = (MEAN,)
    exact: bool = False
    name = "made up"
    scene, served = None, ()

    def configurations(self):
        return COARSE, FINE, SPRINGS, LOST

    def reference(self):
        return {"k": np.full(3, 2.0), "m": np.ones(3)} if self.exact else (COARSE, FINE)

    def pairs(self):
        return ((COARSE, FINE),)


X = np.array([1.0, 1.1, 0.9])
OUTCOME = {
    "status": np.array([FINISHED, FINISHED, FINISHED, "failed: lost"]),
    "setup": np.array([0.1, 0.2, 0.4, 0.8]),
    "seconds 0": np.array([1.0, 2.0, 3.0]),
    "seconds 1": np.array([10.0, 20.0, 30.0, 40.0, 50.0]),
    "seconds 2": np.array([0.5]),
    "seconds 3": np.array([7.0]),
    "k 0": 1.21 * X,
    "k 1": 1.1 * X,
    "k 2": np.array([2.0, 2.2]),
}


def point_of(found, line, value):
    (mine,) = (p for p in found if (p.method, p.value) == (line, value))
    return mine


def test_a_reference_of_two_grids_is_extrapolated_and_leaves_its_last_step_open():
    """From 8 to 12 cells, to first order: ln 1.1 - 2 (ln 1.21 - ln 1.1) is -ln 1.1, two steps below the finer."""
    reference, band = reference_of(MadeProblem(), {COARSE: {"k": 1.21 * X}, FINE: {"k": 1.1 * X}})
    rows = np.arange(3)
    assert reference.log(MEAN, rows) == pytest.approx(-math.log(1.1), abs=1e-12)
    assert reference.ratio == 1.5
    assert band(MEAN) == pytest.approx(1.1**2 - 1)
    # to second order it is 1 / (1.5^2 - 1) of the step that is left, in decibels of a power
    assert band(LEVEL) == pytest.approx(10 * math.log10(1.1) / (1.5**2 - 1))


def test_a_grid_of_the_reference_must_have_finished():
    with pytest.raises(NotConvergedError, match="made up: the grids of the reference have not finished"):
        reference_of(MadeProblem(), {FINE: {"k": X}})


def test_an_exact_reference_leaves_what_the_quantity_says():
    reference, band = reference_of(MadeProblem(exact=True), {})
    assert band(replace(MEAN, band=0.125)) == 0.125
    assert reference.log(MEAN, np.arange(3)) == pytest.approx(math.log(2))


def test_points_have_their_errors_and_costs():
    found = points(MadeProblem(exact=True), OUTCOME)
    known = [("BEM", 8.0), ("BEM", 12.0), ("MDR", 64.0), ("MDR", 99.0), (EXTRAPOLATED, 12.0)]
    assert [(p.method, p.value) for p in found] == known
    fine = point_of(found, "BEM", 12.0)
    assert (fine.scene, fine.quantity, fine.unit, fine.parameter) == ("made up", "mean", "%", "# cells")
    assert (fine.error, fine.over) == pytest.approx((0.45, 0.55))
    exact = MethodValues(k(np.full(3, 2.0)))
    assert fine.half_width == error(MEAN, MethodValues(k(1.1 * X)), exact).half_width > 0
    assert (fine.seconds, fine.runs, fine.setup) == ((20.0, 30.0, 40.0), 5, 0.2)
    assert fine.finished and not fine.is_reference and fine.setting == "12 cells"
    # both grids are paid for
    both = point_of(found, EXTRAPOLATED, 12.0)
    assert both.seconds == pytest.approx((21.5, 32.0, 42.5))
    assert (both.runs, both.setup) == pytest.approx((3, 0.3))
    # 1.1 (1.1 / 1.21)^2 = 1 / 1.1, of 2
    assert (both.over, both.error) == pytest.approx((1 / 2.2, 1 - 1 / 2.2))
    assert both.status == FINISHED and both.parameter == "# cells"
    assert both.half_width == pytest.approx(error(MEAN, MethodValues(k(1.1 * X), k(1.21 * X), 1.5), exact).half_width)


def test_who_is_lost_or_cannot_say_is_a_point_without_an_error():
    quantities = MEAN, LEVEL, mean_of("other", "m")
    found = points(MadeProblem(quantities, exact=True), {**OUTCOME, "m 0": X, "m 1": X, "m 3": X})
    assert {p.quantity: p.unit for p in found} == {"mean": "%", "level": "dB", "other": "%"}
    lost = point_of(found[:5], "MDR", 99.0)
    assert lost.status == "failed: lost" and math.isnan(lost.error) and not lost.finished
    assert lost.seconds == (7.0, 7.0, 7.0)
    silent = point_of([p for p in found if p.quantity == "other"], "MDR", 64.0)
    assert silent.status == f"{OUT_OF_RANGE}: it does not have this quantity" and not silent.finished


def test_a_pair_of_which_one_is_lost_is_not_extrapolated():
    outcome = {**OUTCOME, "status": np.array([FINISHED, "failed: lost", FINISHED, FINISHED]), "k 3": X}
    assert EXTRAPOLATED not in {p.method for p in points(MadeProblem(exact=True), outcome)}
