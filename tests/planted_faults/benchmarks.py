"""Faults planted in what `tests/benchmarks` looks at: where, what is wrong there, and the test that must catch it."""

import dataclasses
import functools
from types import SimpleNamespace

import numpy as np

from tests.benchmarks import test_chart_points as test_points
from tests.benchmarks import test_fronts, test_peers
from tests.judging import test_judged_solvers as test_solvers
from tests.judging import test_judging_bounds as test_bounds
from tests.planted_faults.wrong import Fault, Times
from validation.benchmarks import discrete, timing
from validation.benchmarks import solvers as comparison
from validation.benchmarks.work_precision import case as precision_case
from validation.benchmarks.work_precision import errors as precision_error
from validation.benchmarks.work_precision import pareto as precision_faster
from validation.benchmarks.work_precision import problem as precision
from validation.benchmarks.work_precision.pareto import Point
from validation.judging.solvers import factors, properties
from validation.judging.solvers import judged as judging


def at_first_order(answer, quantity, rows):
    return log_of_answer(answer, dataclasses.replace(quantity, order=1.0), rows)


def rigid(problem):
    return SimpleNamespace(displacement=lambda pressure: 0 * pressure)


left, timed, checked = discrete.ContactProblem.left, judging.timed, properties.checked
log_of_answer = precision_error.MethodValues.log


FAULTS = [
    functools.partial(
        test_fronts.test_the_cheapest_is_claimed_of_times,
        test_fronts.timed_point(test_fronts.FILTER_1D, 0.3, 1e-6),
        "holds",
        (test_fronts.BEM, test_fronts.BEM),
    ),
    Fault("a time beside that of a method that is not as close").at(
        precision_case,
        "cheapest_as_close",
        lambda _, others: min(others, key=lambda one: one.seconds[1], default=None),
    ),
    test_fronts.test_times_faster_are_those_of_the_cheapest_boundary_elements_with_no_larger_error,
    Fault("times beside a grid that is not as close").at(
        precision_faster,
        "cheapest_as_close",
        lambda _, others: min(others, key=lambda one: one.seconds[1], default=None),
    ),
    test_fronts.test_times_faster_have_the_intervals_of_both_medians,
    Fault("times that are known exactly").at(precision_faster, "_uncertainty", lambda _: 0.0),
    test_peers.test_the_median_lies_between_order_statistics,
    Fault("a median without an interval").at(
        timing, "interval_of_median", lambda times: (np.median(times), np.median(times))
    ),
    functools.partial(
        test_peers.test_where_tamaas_has_no_answer_another_contact_stands_in, [[0.0] * 3] * 5, False, (6, 4)
    ),
    Fault("a rim that touches").at(discrete.ContactProblem, "half_space", property(rigid)),
    test_peers.test_a_solver_that_is_placed_first_does_not_become_ours,
    Fault("our solver for the first of the list").at(comparison, "OUR_SOLVER", "theirs"),
    test_fronts.test_the_front_is_what_nothing_beats_and_ends_in_the_band,
    Fault("nothing left open by a reference").at(Point, "rank", property(lambda point: point.error + point.half_width)),
    test_fronts.test_errors_are_ranked_by_their_upper_ends,
    Fault("errors ranked without their intervals").at(
        Point, "rank", property(lambda point: max(point.error, point.band))
    ),
    test_points.test_what_realisations_have_of_their_own_drops_out_of_paired_errors,
    Fault("the same surfaces taken for others").at(
        test_points,
        "error",
        lambda quantity, mine, reference: precision_error.error(
            quantity, dataclasses.replace(mine, paired=False), reference
        ),
    ),
    functools.partial(test_points.test_two_grids_of_a_power_law_are_extrapolated_to_the_truth, 2.0),
    Fault("first order for second in an extrapolation").at(precision_error.MethodValues, "log", at_first_order),
    test_points.test_levels_differ_by_the_root_mean_square_of_decibels,
    Fault("decibels of an amplitude for those of a power").at(precision.ChartQuantity, "distance", Times(2.0)),
    test_solvers.test_a_condition_that_is_left_has_its_size,
    Fault("the approach of a contact for the one that is prescribed").at(
        discrete.ContactProblem,
        "left",
        lambda problem, pressure, by_force, *operator: left(problem, pressure, True, *operator),
    ),
    functools.partial(
        test_solvers.test_a_planted_fault_is_caught_and_named,
        *test_solvers.FAULTS["cells of a rectangle in another order"],
    ),
    Fault("properties of nothing but a square").at(judging, "_rectangle", lambda problem, shape, longer: problem),
    functools.partial(
        test_solvers.test_a_solver_that_is_right_on_small_grids_alone_is_wrong, *test_solvers.LARGE["an even pressure"]
    ),
    Fault("answers that are timed and not judged").at(
        judging, "timed", lambda asked: (([], times) for _, times in timed(asked))
    ),
    functools.partial(
        test_bounds.test_a_number_agrees_within_its_bound_and_no_number_never, float("nan"), 0.0, "differ"
    ),
    Fault("no number agrees").at(
        properties, "checked", lambda *point: dataclasses.replace(checked(*point), verdict="agree", reason="")
    ),
    functools.partial(test_bounds.test_an_answer_may_be_off_by_fifty_residuals, "approach", "force", 55, "differ"),
    Fault("an approach that may be off by ten times as much").at(properties, "OF_ANSWER", Times(10.0)),
    functools.partial(test_bounds.test_the_order_of_convergence_is_one_to_the_next_term, 0.8, "differ"),
    Fault("an order of convergence that may be off by 0.1 more").at(judging, "NEXT_TERM", 0.25),
    functools.partial(
        test_bounds.test_a_contact_that_shrinks_under_more_load_is_found, lost=0.03, verdict="differ", step=1
    ),
    Fault("a contact that may shrink under more load").at(properties, "SINGLE_CELLS", float("inf")),
    test_bounds.test_a_full_periodic_contact_is_not_asked_by_approach,
    Fault("an approach for a full periodic contact, which determines nothing").at(
        discrete.ContactProblem, "is_determined_by_approach", True
    ),
    test_bounds.test_what_a_solver_does_not_serve_is_a_status_of_its_own,
    Fault("what is not served for a failure").at(timing, "NOT_SERVED", "failed"),
    functools.partial(test_solvers.test_a_fault_is_caught_by_approach_too, "heights from their mean"),
    Fault("the approach of an answer for the one that is prescribed, in causes").at(
        factors, "_shift", lambda contact: 0.0
    ),
]
