"""What is selected on charts of speed against accuracy, and what it rests on: errors, costs, bands, words; no clock."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from validation.benchmarks.timing import FINISHED, OUT_OF_RANGE, Configuration
from validation.benchmarks.work_precision.errors import MethodValues, _half_width, error, points, reference_of
from validation.benchmarks.work_precision.pareto import (
    TOLERANCES,
    Point,
    cheapest,
    in_unit_of_error,
    monotone_envelope,
    reason_if_none,
    work,
)
from validation.benchmarks.work_precision.problem import EXTRAPOLATED, Quantity, logarithm
from validation.engine.convergence import NotConvergedError

K = Quantity(name="mean", log=logarithm("k"), needs=("k",))
LEVEL = Quantity(name="level", log=logarithm("k"), needs=("k",), decibel=True, order=2.0)
OTHER = Quantity(name="other", log=logarithm("m"), needs=("m",))


def attempt(label, value, **settings):
    known = {"method": None, "scene": None, "resolution": None, "parameter": "# cells"}
    return Configuration(label=label, value=value, **known, **settings)


COARSE, FINE, SPRINGS = attempt("BEM", 8.0), attempt("BEM", 12.0), attempt("MDR", 64.0, paired=False)
LOST = attempt("MDR", 99.0)


@dataclass(frozen=True)
class MadeProblem:
    """Made up."""

    quantities: tuple[Quantity, ...] = (K,)
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
    "work": np.array([10.0, 20.0, 40.0, math.nan]),
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
    assert reference.log(K, rows) == pytest.approx(-math.log(1.1), abs=1e-12)
    assert reference.ratio == 1.5
    assert band(K) == pytest.approx(1.1**2 - 1)
    # to second order it is 1 / (1.5^2 - 1) of the step that is left, in decibels of a power
    assert band(LEVEL) == pytest.approx(10 * math.log10(1.1) / (1.5**2 - 1))


def test_a_grid_of_the_reference_must_have_finished():
    with pytest.raises(NotConvergedError, match="made up: the grids of the reference have not finished"):
        reference_of(MadeProblem(), {FINE: {"k": X}})


def test_an_exact_reference_leaves_what_the_quantity_says():
    reference, band = reference_of(MadeProblem(exact=True), {})
    assert band(replace(K, band=0.125)) == 0.125
    assert reference.log(K, np.arange(3)) == pytest.approx(math.log(2))


def test_points_have_their_errors_and_costs():
    found = points(MadeProblem(exact=True), OUTCOME)
    assert [(p.method, p.value) for p in found] == [
        ("BEM", 8.0),
        ("BEM", 12.0),
        ("MDR", 64.0),
        ("MDR", 99.0),
        (EXTRAPOLATED, 12.0),
    ]
    fine = point_of(found, "BEM", 12.0)
    assert (fine.scene, fine.quantity, fine.unit, fine.parameter) == ("made up", "mean", "%", "# cells")
    assert (fine.error, fine.over) == pytest.approx((0.45, 0.55))
    one = error(K, MethodValues({"k": 1.1 * X}), MethodValues({"k": np.full(3, 2.0)}))
    assert fine.half_width == one.half_width > 0
    assert (fine.seconds, fine.runs, fine.setup, fine.work) == ((20.0, 30.0, 40.0), 5, 0.2, 20.0)
    assert fine.finished and not fine.is_reference and fine.setting == "12 cells"


def test_extrapolated_points_cost_both_grids():
    both = point_of(points(MadeProblem(exact=True), OUTCOME), EXTRAPOLATED, 12.0)
    assert both.seconds == pytest.approx((21.5, 32.0, 42.5))
    assert (both.runs, both.setup, both.work) == pytest.approx((3, 0.3, 30.0))
    # 1.1 (1.1 / 1.21)^2 = 1 / 1.1, of 2
    assert both.over == pytest.approx(1 / 2.2)
    assert both.error == pytest.approx(1 - 1 / 2.2)
    assert both.status == FINISHED and both.parameter == "# cells"
    assert both.half_width == pytest.approx(
        error(K, MethodValues({"k": 1.1 * X}, {"k": 1.21 * X}, 1.5), MethodValues({"k": np.full(3, 2.0)})).half_width
    )


def test_who_is_lost_or_cannot_say_is_a_point_without_an_error():
    found = points(MadeProblem(quantities=(K, OTHER), exact=True), {**OUTCOME, "m 0": X, "m 1": X, "m 3": X})
    lost = point_of(found[:5], "MDR", 99.0)
    assert lost.status == "failed: lost" and math.isnan(lost.error) and not lost.finished
    assert lost.seconds == (7.0, 7.0, 7.0)
    silent = point_of([p for p in found if p.quantity == "other"], "MDR", 64.0)
    assert silent.status == f"{OUT_OF_RANGE}: it does not have this quantity" and not silent.finished


def test_levels_are_in_decibels_and_the_others_in_per_cent():
    units = {p.quantity: p.unit for p in points(MadeProblem(quantities=(K, LEVEL), exact=True), OUTCOME)}
    assert units == {"mean": "%", "level": "dB"}


def test_a_pair_of_which_one_is_lost_is_not_extrapolated():
    outcome = {**OUTCOME, "status": np.array([FINISHED, "failed: lost", FINISHED, FINISHED]), "k 3": X}
    assert EXTRAPOLATED not in {p.method for p in points(MadeProblem(exact=True), outcome)}


def test_an_answer_alone_has_the_interval_of_either_sample():
    x, exact = {"k": np.array([1.0, 1.2])}, {"k": np.ones(1)}
    alone = error(K, MethodValues(x, paired=False), MethodValues(exact))
    assert alone.half_width == pytest.approx(error(K, MethodValues(x), MethodValues({"k": np.ones(2)})).half_width)
    other = error(K, MethodValues(exact, paired=False), MethodValues(x))
    assert other.half_width > 0
    both = error(K, MethodValues(x, paired=False), MethodValues(x))
    assert both.half_width == pytest.approx(math.hypot(alone.half_width / 1.1, other.half_width * 1.1), rel=0.02)


@pytest.mark.parametrize("quantity", [K, LEVEL])
@pytest.mark.parametrize("paired", [True, False])
def test_an_answer_that_luck_has_put_on_its_reference_scatters_as_much(quantity, paired):
    """Its distance has no sign, and without one its changes would be folded into each other."""
    x = np.array([0.9, 0.95, 1.0, 1.05, 1.1])

    def half(factor):
        return error(
            quantity, MethodValues({"k": factor * x}, paired=paired), MethodValues({"k": np.ones(5)})
        ).half_width

    unit = 10 / math.log(10) if quantity.decibel else 1.0
    assert half(1.0) == pytest.approx(2.776 * unit * x.std(ddof=1) / math.sqrt(5), rel=0.01)
    assert half(1.0) == pytest.approx(half(1.5) / (1.0 if quantity.decibel else 1.5), rel=1e-6)


def test_several_numbers_have_no_ratio():
    def log(answers):
        return np.log(answers["k"].mean(axis=0))

    two = Quantity(name="bands", log=log, needs=("k",))
    found = error(two, MethodValues({"k": np.array([[1.1, 0.7]])}), MethodValues({"k": np.ones((1, 2))}))
    assert math.isnan(found.over)
    # the farthest of them; of levels in decibels, their root mean square
    assert found.value == pytest.approx(0.3)
    levels = error(
        replace(two, decibel=True), MethodValues({"k": np.array([[10.0, 1.0]])}), MethodValues({"k": np.ones((1, 2))})
    )
    assert levels.value == pytest.approx(10 / math.sqrt(2))


def point(line, off, cost, **settings):
    settings = {"status": FINISHED, "band": 0.001, "unit": "%", "parameter": "# cells", "value": 8.0, **settings}
    return Point(
        scene="scene", quantity="force", method=line, error=off, seconds=(0.9 * cost, cost, 1.2 * cost), **settings
    )


def test_an_error_counts_with_its_interval_its_reference_and_its_luck():
    one = point("a", 0.1, 1.0, half_width=0.02)
    assert one.rank == pytest.approx(0.12)
    assert replace(one, band=0.2).rank == 0.2
    assert replace(one, finer=0.3).rank == 0.3


def test_luck_is_what_more_of_the_same_does_not_keep():
    """The largest upper end at more work of the same method; no others, and nobody who is lost."""
    chart = [
        point("a", 0.01, 1.0, work=10.0),
        point("a", 0.2, 2.0, work=20.0),
        point("a", 0.05, 3.0, work=30.0, half_width=0.01),
        point("a", 0.9, 9.0, work=30.0, status="failed: lost"),
        point("b", 0.8, 1.0, work=99.0),
    ]
    found = monotone_envelope(chart)
    assert [p.finer for p in found] == pytest.approx([0.2, 0.06, 0.0, 0.0, 0.0])
    assert [p.rank for p in found[:3]] == pytest.approx([0.2, 0.2, 0.06])


def test_a_tolerance_that_is_just_met_is_met():
    assert cheapest([point("a", 0.1, 1.0)], 0.1).method == "a"
    assert cheapest([point("a", 0.1000001, 1.0)], 0.1) is None
    assert cheapest([point("a", 0.05, 1.0), point("b", 0.01, 0.5)], 0.1).method == "b"


@pytest.mark.parametrize(("band", "why"), [(0.01, "none"), (0.0100001, "the reference cannot tell")])
def test_why_there_is_no_cheapest(band, why):
    assert reason_if_none([point("a", 0.5, 1.0, band=band)], 0.01) == why


def test_cost_is_the_median_or_the_count():
    one = point("a", 0.1, 2.0, work=7.0)
    assert cheapest([one, point("b", 0.1, 1.9, work=8.0)], 0.2).method == "b"
    assert cheapest([one, point("b", 0.1, 1.9, work=8.0)], 0.2, work).method == "a"


def test_tolerances_are_asked_for_relative_or_in_decibels():
    assert TOLERANCES == (0.3, 0.1, 0.03, 0.01, 0.001)
    assert in_unit_of_error(0.3, "%") == 0.3
    assert in_unit_of_error(0.3, "dB") == pytest.approx(20 * math.log10(1.3))


def test_a_single_paired_realisation_is_beside_the_first_of_the_reference():
    assert error(
        K, MethodValues({"k": np.array([1.5])}), MethodValues({"k": np.array([1.0, 3.0])})
    ).value == pytest.approx(0.5)


def test_an_interval_that_one_of_its_parts_lacks_is_infinite():
    assert _half_width([1.0, math.nan, 1.1]) == _half_width([1.0, math.inf, 1.1]) == math.inf
    assert math.isfinite(_half_width([1.0, 1.2, 1.1])) and _half_width([]) == 0.0
