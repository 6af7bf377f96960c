"""Faults planted in how one question gets one answer, and the test that must catch each."""

import functools
import math

from tests.advice import test_costs_by_counts, test_limits_of_compare, test_one_answer, test_read_only_comparison
from tests.judging import test_models_from
from tests.planted_faults.wrong import Fault
from validation.advice import advice, compare, hierarchy, scene_model
from validation.advice import advice as on_mdr
from validation.judging import own_models
from validation.railway.problems import rail_models, rail_quantity
from validation.scenes.measured import MeasuredHeights
from validation.scenes.scene import ContactEllipse

FAULTS = [
    test_costs_by_counts.test_cells_that_are_drawn_are_most_of_the_cost_of_springs_on_a_line,
    Fault("a cost without the strips that are drawn").at(rail_models, "DRAWN", 0.0),
    test_one_answer.test_no_model_is_selected_that_a_less_biased_one_contradicts,
    Fault("a contradiction that nobody looks for").at(hierarchy, "contradicting", lambda found, one: None),
    Fault("the model with the smallest error, however biased").at(
        hierarchy, "bias", lambda answer: (answer.error, 0.0)
    ),
    functools.partial(test_one_answer.test_of_errors_that_are_alike_the_less_biased_model_is_taken, 0.12, "grid"),
    Fault("errors that a sample tells apart").at(hierarchy, "ALIKE", 1.0),
    test_one_answer.test_a_sentence_on_springs_that_were_not_solved_says_predicted,
    Fault("a prediction told as a solve").at(on_mdr, "is_solved", lambda comparison, springs: True),
    functools.partial(test_one_answer.test_no_model_is_enough_beyond_linear_elasticity, *test_one_answer.BODIES[0]),
    Fault("a half-space that bears any pressure").at(compare, "beyond_elasticity", lambda scene: ""),
    functools.partial(test_one_answer.test_no_model_is_enough_beyond_linear_elasticity, *test_one_answer.BODIES[1]),
    Fault("the peak for the mean pressure").at(
        ContactEllipse, "mean_pressure", property(lambda contact: 1.5 * contact.load / (math.pi * contact.along**2))
    ),
    test_one_answer.test_where_the_sample_is_the_error_a_number_of_realisations_is_advised_that_does,
    Fault("no number of realisations would do").at(advice, "wanted_realisations", lambda one, tolerance: 0),
    test_one_answer.test_so_many_realisations_are_solved_as_are_asked,
    Fault("as many realisations as ever").at(scene_model, "replace", lambda plan, **_: plan),
    test_read_only_comparison.test_one_number_cannot_be_written_either,
    Fault("a value that can be written").at((compare, scene_model), "kept", lambda array: array.copy()),
    test_models_from.test_a_claim_for_one_measured_surface_has_its_scatter_about_the_mean,
    Fault("one measured surface without its scatter").at(MeasuredHeights, "is_single", False),
    test_models_from.test_a_file_that_is_changed_is_seen_before_it_is_called,
    Fault("a file that is changed while it is compared").at(own_models.OwnModel, "check_unchanged", lambda own: None),
    test_limits_of_compare.test_a_grid_whose_error_is_noise_is_compared_on_more_surfaces,
    Fault("noise taken for the error of a grid").at(scene_model, "FALLS", 0.5),
    test_limits_of_compare.test_a_grid_whose_error_is_its_own_is_given_up_soon,
    Fault("the error of a grid taken for noise").at(scene_model, "FALLS", 1.0),
    functools.partial(
        test_limits_of_compare.test_out_of_its_range_a_model_is_solved_that_takes_a_minute_at_the_most, 61.0, False
    ),
    Fault("a model out of its range that takes as long as it likes").at(compare, "LONGEST_BEYOND_RANGE", math.inf),
    test_limits_of_compare.test_bands_count_in_which_something_is_left,
    Fault("bands of which nothing is left").at(rail_quantity, "COUNTED", -math.inf),
]
