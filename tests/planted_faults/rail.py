"""Faults planted in contact filters of a wheel on a rail, in whichever room: where, what is wrong, and the test."""

import functools

import numpy as np

from tests.analysis import test_graduation
from tests.scenes import test_isotropic_line
from tests.selection import test_filter_table, test_no_band_counts
from tests.simulation import test_calibration, test_rail_error_bars, test_scattered_levels
from validation.analysis import graduation
from validation.scenes import isotropic_line
from validation.selection import calibrate, rail_model
from validation.selection.hierarchy import Answer
from validation.simulation import rail_ground, rail_models, rail_quantity
from validation.simulation.models.rail_boundary_elements import BoundaryElementsOnRail
from validation.simulation.rail_quantity import RailQuantity

graduated, model_error, over_twin = (
    graduation.graduated,
    BoundaryElementsOnRail.model_error,
    rail_models.RolledRailModel.over_twin,
)


def without_sample_error(model, scene, across, cells, seed):
    value, error = over_twin(model, scene, across, cells, seed)
    return value, 0 * error


def at_a_right_angle(answer):
    return np.sqrt(sum(part**2 for part in answer.band_errors.values()))


def without_what_the_ground_leaves(model, quantity, a3):
    return model_error(model, quantity, a3) - quantity.left_by_ground


def as_they_are(series, weights, *, least):
    n = len(series)
    return graduation.Graduation(np.asarray(series), np.eye(n), least, np.ones(n))


def with_equal_weights(series, weights, *, least):
    return graduated(series, np.ones(len(series)), least=least)


def nothing(quantity):
    return 0 * quantity.wave


def smooth_line_alone(scene):
    return rail_ground.line_of(scene)


BARS, SCATTERED = test_rail_error_bars, test_scattered_levels
FAULTS = {
    "boundary elements on a rail without their sample error": (
        (rail_models.RolledRailModel, "over_twin", without_sample_error),
        BARS.test_the_sample_leaves_students_interval_of_the_strips,
    ),
    "a tenth of the grid error of boundary elements on a rail": (
        (rail_models, "OF_FINE", 0.1 * rail_models.OF_FINE),
        BARS.test_the_grid_leaves_what_second_order_makes_of_two_grids,
    ),
    "a bias on a rail added at a right angle": (
        (Answer, "error_in_bands", property(at_a_right_angle)),
        BARS.test_errors_of_bands_add_a_bias_to_what_is_random,
    ),
    "a bias of the worst band on a rail added at a right angle": (
        (Answer, "error", property(lambda answer: float(np.sqrt(answer.model**2 + answer.grid**2 + answer.sample**2)))),
        BARS.test_what_the_ground_leaves_adds_to_grid_and_sample_as_it_is,
    ),
    "boundary elements that know what lies across a rail": (
        (BoundaryElementsOnRail, "model_error", without_what_the_ground_leaves),
        BARS.test_what_the_ground_leaves_adds_to_grid_and_sample_as_it_is,
    ),
    "a reference of the calibration with the surfaces of the models": (
        (calibrate, "OTHER_SEED", 0),
        test_calibration.test_the_reference_has_surfaces_of_its_own,
    ),
    "one standard error of a slope": (
        (graduation.Graduation, "quantile", 1.0),
        test_graduation.test_errors_of_slopes_cover_those_of_a_line_with_known_scatter,
    ),
    "lone values that keep their weight": (
        (graduation, "LONE", 1e3),
        functools.partial(test_graduation.test_lone_values_lose_their_weight, 10, 3),
    ),
    "values that stand out weighed by Huber's rule": (
        (graduation, "REDESCENDING", -1),
        test_graduation.test_a_value_weighs_by_tukeys_biweight_of_its_deviation,
    ),
    "few waves that weigh as much as many": (
        (isotropic_line, "graduated", with_equal_weights),
        test_isotropic_line.test_levels_that_scatter_leave_their_scatter_and_waves_that_are_many_weigh_more,
    ),
    "smooth levels that are smoothed": (
        (isotropic_line, "WHOLE_DECIBELS", -1.0),
        functools.partial(test_isotropic_line.test_smooth_levels_stay_as_they_are_to_the_bit, "iso3095-2013"),
    ),
    "levels that scatter taken as they are": (
        (isotropic_line, "graduated", as_they_are),
        SCATTERED.test_linear_theory_holds_the_smooth_ground,
    ),
    "no error of levels that scatter": (
        (RailQuantity, "smoothing_error", property(nothing)),
        SCATTERED.test_what_the_ground_leaves_covers_the_smooth_ground_alone,
    ),
    "no error of a wide corrugation that is in part taken for ground": (
        (rail_quantity, "OF_SMOOTHING", 0.0),
        SCATTERED.test_a_corrugation_of_five_bands_is_in_part_taken_for_ground_within_the_error,
    ),
    "a corrugation taken for isotropic ground": (
        (RailQuantity, "between", lambda quantity, ends: ends[-1:]),
        SCATTERED.test_a_corrugation_costs_its_own_bands_alone_and_they_lie_between_ridges_and_isotropic_ground,
    ),
    "strips without a corrugation": (
        (rail_ground, "whole_line_of", smooth_line_alone),
        SCATTERED.test_strips_have_the_power_of_what_stands_out,
    ),
    "the loss of contact of smooth levels alone": (
        (rail_ground, "_as_given", lambda scene: (scene.isotropic or test_scattered_levels.RAIL.isotropic).line),
        SCATTERED.test_loss_of_contact_is_that_of_the_levels_as_they_are,
    ),
    "enough where no band counts": (
        (rail_model, "worst", lambda quantity, a3, error: 0.0),
        test_no_band_counts.test_a_solve_leaves_its_bands_and_no_error,
    ),
    "the bands of a wrong filter that count": (
        (RailQuantity, "no_answer", ""),
        functools.partial(
            test_no_band_counts.test_no_model_is_enough_where_no_band_counts,
            across="isotropic",
            scene=test_no_band_counts.QUIET,
            span="12.5 to 10 mm",
        ),
    ),
    "long waves that pass under every filter": (
        (rail_model.RailSceneModel, "of_longer_waves", lambda one: np.zeros(35)),
        test_filter_table.test_springs_on_geikes_spectrum_are_off_for_long_waves_too,
    ),
    "levels counted that no one hears": (
        (rail_quantity, "COUNTED", -60.0),
        functools.partial(
            test_no_band_counts.test_no_model_is_enough_where_no_band_counts,
            across="ridges",
            scene=test_no_band_counts.SHORT,
            span="6.3 to 3.15 mm",
        ),
    ),
}
