"""Faults planted in what `tests/selection` looks at: where, what is wrong there, and the test that must catch it."""

import dataclasses
import functools
import math

import numpy as np

import bem3d
import mdr
from tests import test_face
from tests.advice import (
    test_calibrate_command,
    test_calibration,
    test_claims,
    test_edge_scenes,
    test_in_short,
    test_named_models,
    test_own_scene,
    test_what_compare_says,
)
from tests.advice import test_model_hierarchy as test_ladder
from tests.benchmarks import test_chart_points as test_points
from tests.planted_faults.wrong import Fault, Times, module_with
from tests.railway import test_contact_force
from validation.advice import (
    calibrate,
    calibration,
    columns,
    compare,
    contact_force,
    hierarchy,
    quantities,
    scene_model,
    side_by_side,
    tolerance,
)
from validation.advice import calibration as calibrated_range
from validation.advice import compare as swept
from validation.advice import figure as compared
from validation.advice.calibration import LOAD
from validation.advice.cases import model_selection_study
from validation.advice.models import boundary_elements_pressed, boundary_elements_rolling, pressed, rolling
from validation.benchmarks.work_precision import errors as precision_error
from validation.engine.random_numbers import random_generator
from validation.railway import exported as of_rail
from validation.railway.scenes import rail
from validation.scenes import measured
from validation.scenes import rolling_quantity as rolling_question
from validation.simulation import indentation as pressed_heights
from validation.simulation import method as sampling
from validation.simulation import rolling_levels as rolled
from validation.simulation import surface
from validation.theory import closed_forms
from validation.theory import rolling as rolling_theory


def by_the_filter_of_one_dimension(q, c2d, *, edges, contact_radius, modulus):
    geike = functools.partial(mdr.geike, c2d=c2d)
    return rolling_theory.force_spectrum_1d(q, geike, contact_radius=contact_radius, modulus=modulus)


drawn_on_a_grid = pressed_heights._drawn


def at_points(heights, shape, cell):
    return heights.at(*((np.arange(n) - (n - 1) / 2) * cell for n in shape))


def other_waves_on_every_grid(ground, shortest, cells, side, rng):
    return drawn_on_a_grid(ground, shortest, cells, side, np.random.default_rng(cells))


def the_last_change_alone(earlier, last):
    return abs(float(last.mean())) + sampling.mean_error(last[:, np.newaxis])


def without_the_noise_of_its_series(earlier, last):
    before, after = (abs(float(change.mean())) for change in (earlier, last))
    ratio = min(after / before, sampling.SLOWEST)
    return after * max(1.0, ratio / (1 - ratio)) + sampling.mean_error(last[:, np.newaxis])


def mean_over_bands(ratios):
    return float(np.mean([sampling.mean_error(band[:, np.newaxis]) for band in ratios.T]))


def the_same_every_time(entropy, *key):
    return random_generator(entropy, *key[:-1], 0)


def of_unit_modulus(**settings):
    return bem3d.HalfSpace(**{**settings, "modulus": 1.0})


surfaces, strips = boundary_elements_pressed.MODEL, boundary_elements_rolling.MODEL


def another_surface_on_coarser_grids(target, resolution):
    solve = surfaces.prepare(target, resolution)
    return (lambda surface: solve(surface + 1)) if resolution.size < 32 else solve


def another_strip_on_the_coarse_grid(target, resolution):
    solve = strips.prepare(target, resolution)
    coarse, _ = strips.resolutions(target)
    return (lambda strip: solve(strip + 1)) if resolution == coarse else solve


real_weighting, real_models_of = of_rail.a_weighting, compare.models_of


def of_its_own_grid(model, count, compared=0):
    return sum(model.shared[model.model, model.resolution].seconds[:count])


real_contact = rail.RailScene.contact.func


def of_the_secant(scene):
    contact = real_contact(scene)
    return dataclasses.replace(contact, stiffness=contact.force / contact.approach)


def independent_bands(force):
    level = force.levels[force.chosen]
    share = 10 ** (level / 10) / np.sum(10 ** (level / 10))
    return float(np.sqrt(np.sum((share * force.half_width) ** 2)))


FAULTS = [
    test_contact_force.test_each_band_is_weighted_as_the_table_of_the_standard_has_its_frequency,
    Fault("A-weighting at the frequency of half a wave").at(
        of_rail, "a_weighting", lambda frequency: real_weighting(2 * frequency)
    ),
    test_contact_force.test_the_force_is_the_stiffness_of_hertz_times_the_equivalent_displacement,
    Fault("the force over the approach for the stiffness of Hertz").at(
        rail.RailScene, "contact", property(of_the_secant)
    ),
    test_contact_force.test_the_error_of_the_sum_is_that_of_its_bands_and_says_which_are_unknown,
    Fault("errors of bands taken as independent in their sum").at(
        contact_force.ContactForce, "error", property(independent_bands)
    ),
    test_contact_force.test_text_json_and_csv_have_the_same_table,
    Fault("the equivalent roughness filtered once more").at(compare.Comparison, "a3_of", compare.Comparison.value_of),
    test_own_scene.test_both_quantities_of_a_rail_are_solved_once,
    Fault("a rail solved anew for each quantity").at(
        compare, "models_of", lambda *given, **named: real_models_of(*given[:4], **named)
    ),
    test_own_scene.test_seconds_are_those_of_all_solves_that_a_model_needs,
    Fault("seconds without those of the grids that tell the error").at(
        scene_model.SceneModel, "seconds_of", of_its_own_grid
    ),
    test_own_scene.test_a_distance_in_decibels_has_the_errors_of_its_band_and_the_reference_that_of_its_worst,
    Fault("a distance from the reference where nothing is left to hear").at(
        side_by_side, "counts", lambda comparison, one: np.full(comparison.value_of(one).size, True)
    ),
    test_own_scene.test_five_curves_at_the_most_are_told_apart_in_colour_and_in_grey,
    Fault("curves in the order of their cost").at(
        compared, "shown_models", lambda found: [one.name for one in found.models]
    ),
    test_own_scene.test_a_sweep_has_the_values_in_the_unit_of_the_first,
    Fault("a sweep with values in units of their own").at(
        swept, "quantity", lambda name, text, dimension: float(swept.NUMBER.fullmatch(text)[1])
    ),
    test_ladder.test_the_expected_levels_are_integrals_of_the_spectrum,
    Fault("Geike for the half-space under a wheel").at(
        rolling_question, "force_spectrum_3d", by_the_filter_of_one_dimension
    ),
    test_ladder.test_one_dimension_has_the_variance_of_the_force_and_not_its_levels,
    Fault("a factor 2 lost in the variance of the force").at(rolling_question, "force_variance", Times(0.5)),
    test_ladder.test_the_transfer_of_a_wheel_is_that_of_its_resonator,
    Fault("no resonator between force and acceleration").at(
        rolling_question.RollingQuantity, "transfer", lambda quantity, q: np.ones_like(q) / quantity.scene.body.mass
    ),
    test_ladder.test_the_error_of_a_mean_covers_it_in_95_of_100,
    Fault("one standard error for a 95 % interval").at(
        test_ladder, "mean_error", lambda ratios: float(np.sqrt(np.mean(ratios.var(axis=0, ddof=1) / len(ratios))))
    ),
    functools.partial(test_ladder.test_the_law_of_interfaces_holds_as_it_claims, 1.0),
    Fault("twice the separation of a rough face").at(closed_forms, "INTERFACE", 0.96),
    functools.partial(test_ladder.test_the_whole_is_the_root_of_the_sum_of_its_bands, False),
    Fault("one panel of a quadrature over decades").at(rolling_question, "PANEL", 1e9),
    test_ladder.test_short_waves_of_a_measured_track_are_no_longer_ones,
    Fault("measured heights at points, not over cells").at(measured.MeasuredHeights, "mean_over_cells", at_points),
    test_ladder.test_waves_that_a_grid_cannot_carry_are_left_out_and_no_others_changed,
    Fault("other waves on every grid of the ladder").at(pressed_heights, "_drawn", other_waves_on_every_grid),
    test_claims.test_few_springs_and_few_cells_are_no_answer,
    Fault("an answer that stands on one cell").at(scene_model, "too_few", lambda *_: ""),
    test_claims.test_grids_that_do_not_converge_have_no_error_bar,
    Fault("grids that do not converge with the error bar of those that do").at(
        test_claims, "grid_error", the_last_change_alone
    ),
    Fault("the error of a grid without that of its sample").at(sampling, "mean_error", lambda _: 0.0),
    functools.partial(test_calibration.test_beyond_the_table_there_is_no_claim, "punch", LOAD, 0.0075, 0.0065),
    Fault("a table of errors held constant beyond its end").at(calibration, "OPEN_BELOW", (LOAD,)),
    functools.partial(test_calibration.test_claims_cover_new_scenes_and_are_tight, "punch"),
    Fault("the error nearby, without what covers it").at(calibration.MeasuredErrors, "factor", 1.0),
    functools.partial(test_calibration.test_claims_cover_new_scenes_and_are_tight, "sphere"),
    Fault("a claim that half of the scenes exceed").at(calibration, "SHARE", 0.5),
    test_calibrate_command.test_the_run_that_the_table_is_of_may_be_installed_and_no_smaller_one,
    Fault("a table of any size in the place of that of the package").at(
        calibrate, "_refuse_fewer", lambda mine, there: None
    ),
    functools.partial(test_calibration.test_errors_nearby_are_those_of_a_loop_over_all_scenes, "punch"),
    Fault("a scene that calibrates itself").at(calibration.MeasuredErrors, "left_out", lambda table: table.errors),
    functools.partial(test_calibration.test_errors_nearby_are_those_of_a_loop_over_all_scenes, "sphere"),
    Fault("a table without the growth of its errors").at(calibration.MeasuredErrors, "trend", 0.0),
    test_ladder.test_a_coarse_grid_knows_how_far_it_is_from_a_fine_one,
    Fault("a grid that leaves too much solved to the end of its sample").at(
        boundary_elements_pressed, "MODEL", dataclasses.replace(surfaces, grid_error=lambda *_: (0.0, ""))
    ),
    functools.partial(test_claims.test_waves_shorter_than_the_contact_are_left_to_boundary_elements, "force-rms", 0.15),
    Fault("a linear filter for waves shorter than the contact").at(calibrated_range, "outside", lambda *_: ""),
    functools.partial(
        test_points.test_an_answer_that_luck_has_put_on_its_reference_scatters_as_much, test_points.MEAN, True
    ),
    Fault("an error that luck has made small, and its interval").at(
        precision_error, "math", module_with(math, copysign=lambda *_: 1.0)
    ),
    functools.partial(test_claims.test_what_a_grid_leaves_is_the_rest_of_its_series_and_of_its_sample, 0.75, 3.0),
    Fault("a series of grids without the noise of its last change").at(
        test_claims, "grid_error", without_the_noise_of_its_series
    ),
    test_claims.test_the_error_over_bands_is_their_root_mean_square,
    Fault("quiet bands in the error of loud ones").at(test_claims, "mean_error", mean_over_bands),
    test_claims.test_grids_are_compared_on_the_same_surfaces,
    Fault("coarser grids on other surfaces").at(
        boundary_elements_pressed, "MODEL", dataclasses.replace(surfaces, prepare=another_surface_on_coarser_grids)
    ),
    test_claims.test_realisations_are_others,
    Fault("one surface for all").at(pressed_heights, "random_generator", the_same_every_time),
    Fault("one strip and one track for all").at(rolled, "random_generator", the_same_every_time),
    functools.partial(test_claims.test_no_stiffness_depends_on_units, test_claims.ROUGH_BODIES[1]),
    Fault("a half-space of unit modulus").at(
        boundary_elements_pressed, "bem3d", module_with(bem3d, HalfSpace=of_unit_modulus)
    ),
    test_claims.test_one_measured_face_is_not_the_mean_of_all,
    Fault("one measured face for the mean of all").at(pressed, "SCATTER", 0.0),
    test_claims.test_the_side_of_a_sphere_holds_what_it_may_touch,
    Fault("a sphere cut off at its smooth approach").at(pressed_heights, "DEEPEST", 0.0),
    test_claims.test_grids_are_as_fine_in_any_unit,
    Fault("one cell in contact of a light punch").at(pressed_heights, "CONTACT", 1),
    functools.partial(test_claims.test_claims_of_cheap_models_of_rolling, *test_claims.RULES[1]),
    Fault("the rule of the rms for levels in bands").at(
        rolling, "ON_HALF_SPACE", dataclasses.replace(rolling.ON_HALF_SPACE, bands=rolling.LINEAR_RMS)
    ),
    functools.partial(test_claims.test_two_grids_of_second_order_leave_what_they_miss, finest=False),
    Fault("what the finer of two grids leaves, for the coarser").at(
        boundary_elements_rolling, "OF_FINE", boundary_elements_rolling.OF_FINE - 1
    ),
    functools.partial(test_claims.test_two_grids_of_second_order_leave_what_they_miss, finest=True),
    Fault("a grid beside another on another strip").at(
        boundary_elements_rolling, "MODEL", dataclasses.replace(strips, prepare=another_strip_on_the_coarse_grid)
    ),
    functools.partial(
        test_claims.test_springs_on_low_roughness_are_linear_theory_in_the_mean_over_bands, "force-spectrum"
    ),
    Fault("Geike's spectrum for springs that roll").at(
        rolled, "draw_track", lambda ground, rule, **settings: surface.draw_track(ground, "geike", **settings)
    ),
    functools.partial(test_ladder.test_bands_are_told_with_wavenumber_frequency_and_level, "force-spectrum", "N"),
    Fault("decibels of a power for those of a level").at(
        tolerance, "math", module_with(math, log10=lambda value: math.log10(value) / 2)
    ),
    functools.partial(test_ladder.test_bands_are_told_with_wavenumber_frequency_and_level, "acceleration", "m/s²"),
    Fault("radians in a second told as hertz").at(compare, "math", module_with(math, pi=0.5)),
    test_what_compare_says.test_spectra_stand_side_by_side_in_decibels,
    Fault("models side by side in decibels of a power").at(
        (columns, side_by_side), "differences", lambda one, other: 10 * np.log10(one.answer.value / other.answer.value)
    ),
    test_what_compare_says.test_mdr_is_named_where_it_is_enough_and_where_not,
    Fault("springs that are enough whatever error they have").at(
        hierarchy.Candidate, "error", property(lambda candidate: 0.0)
    ),
    test_in_short.test_the_error_is_told_beside_what_was_wanted_with_what_is_left,
    Fault("a missed tolerance told as met").at(hierarchy.Selection, "met", property(lambda selection: True)),
    test_face.test_levels_come_in_decibels,
    Fault("a level of the face without its logarithm").at(
        compare.Comparison, "is_level", property(lambda result: False)
    ),
    test_face.test_a_missed_tolerance_leaves_the_best_value,
    Fault("a tolerance of the face that is always met").at(
        hierarchy.Selection, "met", property(lambda selection: True)
    ),
    functools.partial(test_edge_scenes.test_every_grid_under_a_wheel_has_all_measured_points, 0),
    Fault("measured points between the cells of a wheel's grid").at(
        rolled, "grids_of_points", lambda heights, radius: tuple(n * radius / heights.spacing[0] for n in (2, 4))
    ),
    test_edge_scenes.test_answers_at_the_edges_are_counted_with_those_that_are_none,
    Fault("an answer at the edge that always holds").at(
        model_selection_study, "over_estimate", lambda table: 0 * table["true error"]
    ),
    functools.partial(test_named_models.test_springs_that_read_the_surface_are_there_by_name_alone, (), 0),
    Fault("dominated models among those that are offered").at((quantities, compare), "BY_NAME", ()),
    functools.partial(test_claims.test_a_pressed_face_claims_no_less_than_the_edge_of_the_flat_punch, 32),
    Fault("a punch without the error at its edge").at(
        boundary_elements_pressed, "edge_error", lambda scene, cells: 0.0
    ),
]
