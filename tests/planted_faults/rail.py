"""Faults planted in contact filters of a wheel on a rail, in whichever room: where, what is wrong, and the test."""

from dataclasses import replace
from functools import partial

import numpy as np

from tests.advice import test_calibration, test_own_scene
from tests.planted_faults.wrong import Fault
from tests.railway import (
    test_across,
    test_contact_force,
    test_filter_table,
    test_graduation,
    test_isotropic_line,
    test_rail_error_bars,
    test_rail_filters,
)
from tests.railway import test_no_band_counts as silent
from tests.simulation import test_scattered_levels
from validation.advice import calibration_scenes, contact_force, side_by_side
from validation.advice.scene_model import Answer
from validation.analysis.spectra import NominalBands
from validation.railway import exported as of_rail
from validation.railway.cases import across, filters, rolled_filters
from validation.railway.problems import equivalent_displacement, rail_across, rail_models, rail_quantity, rail_strip
from validation.railway.problems.rail_models import ContactFilter
from validation.railway.problems.rail_quantity import RailQuantity
from validation.railway.scenes import isotropic_line
from validation.railway.scenes import isotropic_line as graduation
from validation.simulation.model_names import ONE_SIDED_BED

graduated, model_error, over_twin = graduation.graduated, ContactFilter.model_error, ContactFilter.over_twin


def without_sample_error(*args):
    value, error = over_twin(*args)
    return value, 0 * error


def as_they_are(series, weights, *, least):
    n = len(series)
    return graduation.Graduation(np.asarray(series), np.eye(n), least, np.ones(n))


def of_equal_weights(found):
    return replace(found, of_values=np.ones(len(found.values)))


def by_smooth_levels(scene):
    slope = rail_strip.strip_bands(scene).slope_of_spectrum(rail_strip.line_of(scene))
    return slope * scene.contact.along / scene.contact.approach


left_by_grid, beyond_linear = rolled_filters.RolledFiltersResult.left_by_grid, across.AcrossResult.beyond_linear
roll_one_way, filter_of = rail_across._roll, filters.filter_of


def of_the_fine_cells(result, key, model, other):
    """The change from coarse cells to fine ones for what is left behind them."""
    coarse, fine = result.case.cells
    return left_by_grid(result, key, model, other) * (fine - coarse) / coarse


def over_all_lines(model, contact):
    """Springs read each line, and the mean of three lines is one."""
    return filter_of("linear, on the line" if model.startswith("mean of") else model, contact)


slope_error, borne_by = graduation.Graduation.slope_error, equivalent_displacement.borne_by
ground_of_strip = rail_strip.RailGround
smoothing_error, stands_out = RailQuantity.smoothing_error.func, RailQuantity.stands_out.fget
HELD = test_scattered_levels.test_the_smooth_ground_is_held
UNHEARD = silent.test_no_model_is_enough_where_no_band_counts
ERRORS = test_across.test_a_filter_over_boundary_elements_has_their_errors_in_the_bands_that_count
SECOND_ORDER = test_across.test_a_wider_bed_and_three_lines_are_the_half_space_to_second_order
SUMS = test_across.test_linear_filters_are_double_sums_over_the_waves_of_a_band
FAULTS = [
    ERRORS,
    Fault("a change of the cells for what they leave, in contact filters").at(
        rolled_filters.RolledFiltersResult, "left_by_grid", of_the_fine_cells
    ),
    Fault("bands that do not count, in contact filters").at(across, "counted", lambda a3: a3 < 1.0),
    SECOND_ORDER,
    Fault("a bed that is narrower by 2/√3").at(filters, "WIDER", 3**0.5 / 2),
    Fault("three lines at the edges of the contact").at(filters, "NEAR", 1.0),
    Fault("one line for the mean of three").at(filters, "filter_of", over_all_lines),
    partial(SUMS, filters.REMINGTON_THERE),
    Fault("Remington's circle as long as the ellipse").at(
        filters, "filter_of", lambda model, contact: filter_of(model, replace(contact, across=contact.along))
    ),
    test_across.test_the_border_of_one_line_is_where_linear_theory_passes_the_tolerance_less_what_contact_adds,
    Fault("contact that adds to one line and not to boundary elements").at(
        across.AcrossResult, "beyond_linear", lambda result, key, sign=0: -beyond_linear(result, key, sign)
    ),
    test_across.test_forces_in_decibel_a_are_beside_those_of_boundary_elements,
    Fault("forces that are not A-weighted").at(filters, "a_weighting", lambda frequency: 0 * frequency),
    partial(test_across.test_strips_are_so_wide_that_their_line_has_the_power_of_the_ground, "alpha = 0.25"),
    Fault("strips too narrow for oblique long waves").at(rail_across, "LINES", 0.05),
    test_across.test_both_ways_are_the_heights_and_the_opposite_ones,
    Fault("strips rolled over one way alone").at(rail_across, "_roll", lambda rail, sign: roll_one_way(rail, 1)),
    test_rail_error_bars.test_the_sample_leaves_students_interval_of_the_strips,
    Fault("boundary elements on a rail without their sample error").at(
        ContactFilter, "over_twin", without_sample_error
    ),
    test_rail_error_bars.test_the_grid_leaves_what_second_order_makes_of_two_grids,
    Fault("a tenth of the grid error of boundary elements on a rail").at(
        rail_models, "OF_FINE", 0.1 * rail_models.OF_FINE
    ),
    test_rail_error_bars.test_what_the_ground_leaves_adds_to_grid_and_sample_as_it_is,
    Fault("a bias on a rail added at a right angle").at(
        Answer, "error_in_bands", property(lambda answer: np.sqrt(sum(part**2 for part in answer.band_errors.values())))
    ),
    Fault("a bias of the worst band on a rail added at a right angle").at(
        Answer, "error", property(lambda answer: float(np.sqrt(answer.model**2 + answer.grid**2 + answer.sample**2)))
    ),
    Fault("boundary elements that know what lies across a rail").at(
        ContactFilter,
        "model_error",
        lambda model, quantity, a3: model_error(model, quantity, a3) - quantity.left_by_ground,
    ),
    test_calibration.test_the_reference_has_surfaces_of_its_own_on_its_finest_grid,
    Fault("a reference of the calibration with the surfaces of the models").at(calibration_scenes, "OTHER_SEED", 0),
    test_graduation.test_errors_of_slopes_cover_those_of_a_line_with_known_scatter,
    Fault("one standard error of a slope").at(graduation.Graduation, "quantile", 1.0),
    partial(test_graduation.test_lone_values_lose_their_weight, 10, 3),
    Fault("lone values that keep their weight").at(graduation, "LONE", 1e3),
    test_graduation.test_a_value_weighs_by_tukeys_biweight_of_its_deviation,
    Fault("values that stand out weighed by Huber's rule").at(graduation, "REDESCENDING", -1),
    test_graduation.test_errors_of_slopes_are_those_of_series_that_scatter_by_their_weights,
    Fault("slopes whose errors have equal weights").at(
        graduation.Graduation, "slope_error", lambda found, reach: slope_error(of_equal_weights(found), reach)
    ),
    test_isotropic_line.test_a_level_of_few_waves_may_be_off_by_as_much_as_few_waves_scatter,
    Fault("levels of few waves that stand out as those of many").at(
        isotropic_line, "graduated", lambda *args, least: of_equal_weights(graduated(*args, least=least))
    ),
    test_scattered_levels.test_what_smoothing_leaves_is_its_slope_error_and_three_times_what_more_smoothing_changes,
    Fault("half of what smoothing leaves").at(
        RailQuantity, "smoothing_error", property(lambda quantity: smoothing_error(quantity) / 2)
    ),
    test_scattered_levels.test_bands_that_stand_out_keep_their_names_under_longer_waves,
    Fault("a corrugation at other waves").at(
        RailQuantity, "stands_out", property(lambda quantity: np.roll(stands_out(quantity), -3))
    ),
    partial(
        test_rail_error_bars.test_contacts_longer_or_wider_than_those_on_strips_have_no_known_error,
        over=0.48,
        known=True,
    ),
    Fault("a_x / a_y in place of a_y / a_x").at(rail_models, "ASPECTS", (1 / 1.9, 1 / 0.45)),
    partial(test_rail_filters.test_one_sided_models_follow_their_linear_twin_on_a_smoother_rail, ONE_SIDED_BED),
    Fault("a bed of springs under another load").at(
        equivalent_displacement, "borne_by", lambda levels, wanted: borne_by(levels, 1.5 * wanted)
    ),
    test_contact_force.test_each_band_is_weighted_as_the_table_of_the_standard_has_its_frequency,
    Fault("a force at nominal frequencies").at(NominalBands, "wavelengths", property(lambda bands: bands.nominal)),
    test_contact_force.test_the_error_of_the_sum_counts_loud_bands_most,
    Fault("the mean error of bands as that of their sum").at(
        contact_force.ContactForce, "error", property(lambda force: float(force.half_width.mean()))
    ),
    test_contact_force.test_bands_without_an_answer_are_left_out_of_both_sums,
    Fault("sums over unlike bands beside each other").at(
        contact_force.ContactForce, "over_chosen", lambda force, model: force.total(model) - force.total("by 0 dB")
    ),
    test_own_scene.test_a_distance_in_decibels_has_the_errors_of_its_band_and_the_reference_that_of_its_worst,
    Fault("decibels of a power as those of an amplitude").at(
        side_by_side, "decibels", lambda error: 10 * np.log10(1 + error)
    ),
    test_isotropic_line.test_levels_that_scatter_leave_their_scatter_and_waves_that_are_many_weigh_more,
    Fault("few waves that weigh as much as many").at(
        isotropic_line,
        "graduated",
        lambda series, weights, *, least: graduated(series, np.ones(len(series)), least=least),
    ),
    partial(test_isotropic_line.test_smooth_levels_stay_as_they_are_to_the_bit, "iso3095-2013"),
    Fault("smooth levels that are smoothed").at(isotropic_line, "WHOLE_DECIBELS", -1.0),
    partial(HELD, test_scattered_levels.by_linear_theory, 6, 0, 0.95),
    Fault("levels that scatter taken as they are").at(isotropic_line, "graduated", as_they_are),
    partial(HELD, test_scattered_levels.by_what_the_ground_leaves, 12, 0, 0.92),
    Fault("no error of levels that scatter").at(
        RailQuantity, "smoothing_error", property(lambda quantity: 0 * quantity.wave)
    ),
    partial(HELD, test_scattered_levels.by_linear_theory, 24, 5, 0.95),
    Fault("no error of a wide corrugation that is in part taken for ground").at(rail_quantity, "OF_SMOOTHING", 0.0),
    test_scattered_levels.test_a_corrugation_costs_its_own_bands_alone_and_they_lie_between_ridges_and_isotropic_ground,
    Fault("a corrugation taken for isotropic ground").at(RailQuantity, "between", lambda quantity, ends: ends[-1:]),
    test_scattered_levels.test_strips_have_the_power_of_what_stands_out,
    Fault("strips without a corrugation").at(
        rail_strip, "RailGround", lambda **waves: ground_of_strip(**{**waves, "whole": None})
    ),
    test_scattered_levels.test_loss_of_contact_is_that_of_the_levels_as_they_are,
    Fault("the loss of contact of smooth levels alone").at(
        test_scattered_levels, "lost_contact_number", by_smooth_levels
    ),
    silent.test_a_solve_leaves_its_bands_and_no_error,
    Fault("enough where no band counts").at(rail_models, "worst", lambda quantity, a3, error: 0.0),
    partial(UNHEARD, across="isotropic", scene=silent.QUIET, span="12.5 to 10 mm"),
    Fault("the bands of a wrong filter that count").at(RailQuantity, "no_answer", ""),
    test_filter_table.test_springs_on_geikes_spectrum_are_off_for_long_waves_too,
    Fault("long waves that pass under every filter").at(of_rail, "of_longer_waves", lambda model, target: np.zeros(35)),
    partial(UNHEARD, across="ridges", scene=silent.SHORT, span="6.3 to 3.15 mm"),
    Fault("levels counted that no one hears").at(rail_quantity, "COUNTED", -60.0),
]
