"""Faults planted in how models from elsewhere are judged, and the test that must catch each."""

import math
from functools import partial

import numpy as np

from tests.analysis import test_independent_records
from tests.judging import (
    test_factors,
    test_judged_diagnosis,
    test_judged_ends,
    test_judged_kinds,
    test_judged_stiffness,
    test_judgement,
    test_references,
)
from tests.planted_faults.wrong import Fault, module_with
from validation.analysis import statistics as independent_records
from validation.judging import judgement
from validation.judging import worker as others
from validation.judging.kinds import diagnosis as factors
from validation.judging.kinds import held_out_solves, laws, own, stiffness, sweeps
from validation.judging.kinds import judge as repeats
from validation.judging.kinds import sweeps as scaling
from validation.judging.kinds.judge import ModelAnswer
from validation.simulation.rough_punch import PlateauSpectrum

given, verdict_of = stiffness.AskedPunch.arguments.fget, judgement.verdict_of


def under_twice_the_load(asked):
    return {**given(asked), "load": 2 * given(asked)["load"]}


def without_its_interval(apart, half, within):
    return verdict_of(apart, 0.0, within)


def without_the_error_of_the_sample(values, so_few, apart):
    return stiffness.Stiffness(ModelAnswer(np.mean(values)), ModelAnswer(np.std(values) / np.mean(values)))


ONE = scaling.Powers(1, 1, 1)
STAYING = {kind: [one._replace(at=one.at[:1] * len(one.at)) for one in some] for kind, some in sweeps.SWEEPS.items()}
FAULTS = [
    partial(test_judged_ends.test_where_a_model_breaks_is_found, *test_judged_ends.WRONG[5]),
    Fault("a sweep that stays where it begins").at(sweeps, "SWEEPS", STAYING),
    partial(test_judged_ends.test_what_is_right_in_some_units_alone_is_found, *test_judged_ends.UNSCALED[0]),
    Fault("a rule of scaling by the tolerance of a user").at(scaling, "EXACT", 0.5),
    partial(test_judged_ends.test_what_is_right_in_some_units_alone_is_found, *test_judged_ends.UNSCALED[6]),
    Fault("heights that never change").at(scaling, "RULES", {**scaling.RULES, "scaling with the height": ONE}),
    partial(test_judged_ends.test_where_a_model_breaks_is_found, *test_judged_ends.WRONG[8]),
    Fault("a track shorter than the contact").at(sweeps, "TRACK", 1),
    partial(test_judged_stiffness.test_a_stiffness_that_falls_between_loads_that_are_known_is_found, 0.3),
    Fault("no load between those that are known").at(stiffness, "BETWEEN", 0),
    test_judged_ends.test_a_warning_stands_beside_the_number,
    Fault("a warning that is not heard").at(others.Called, "warned", property(lambda called: "")),
    partial(test_judged_ends.test_where_a_model_breaks_is_found, *test_judged_ends.WRONG[-1]),
    Fault("a bound for a closed form").at(sweeps, "EXACT", None),
    test_judged_ends.test_errors_are_medians_of_the_quantity_of_their_kind,
    Fault("another quantity on the chart of errors").at(
        own, "MAIN", dict.fromkeys(own.MAIN, "contact filter of a long wave")
    ),
    test_judged_kinds.test_the_wheel_rolls_on_the_law_itself,
    Fault("a path that is not rolled again").at(laws, "NEAR", math.inf),
    test_judged_stiffness.test_what_boundary_elements_have_agrees_and_what_is_twice_as_far_differs,
    Fault("a model asked under twice the load").at(stiffness.AskedPunch, "arguments", property(under_twice_the_load)),
    test_judged_stiffness.test_a_plateau_is_given_with_its_own_rms_height,
    Fault("the level of a power law for that of its plateau").at(
        stiffness.PlateauRoughness, "c2d", PlateauSpectrum.c2d
    ),
    partial(test_judgement.test_the_whole_interval_lies_inside_or_outside_of_the_tolerance, 1.05, 0.06, "undecided"),
    Fault("a verdict without its interval").at(judgement, "verdict_of", without_its_interval),
    partial(test_judgement.test_a_ratio_of_ten_per_cent_is_0_83_decibels_of_a_level, 0.8, 0.02, "agree"),
    Fault("decibels of a power for those of an amplitude").at(
        judgement, "math", module_with(math, log10=lambda x: math.log10(x) / 2)
    ),
    test_judged_stiffness.test_realisations_have_their_mean_and_deviation_with_the_error_of_the_sample,
    Fault("realisations without the error of their sample").at(stiffness, "sampled", without_the_error_of_the_sample),
    test_judged_ends.test_draws_that_scale_wrong_by_more_than_two_intervals_are_found,
    Fault("a rule of scaling by ten times the interval of its draws").at(scaling, "OF_SAMPLE", 20.0),
    partial(test_judged_kinds.test_a_right_law_is_nowhere_wrong_on_a_track_that_repeats_itself, 10.0),
    Fault("wheels on equal pieces of a track that count as many").at(
        laws, "independent_records", lambda records: float(len(records))
    ),
    partial(test_judged_kinds.test_a_wrong_law_is_wrong_on_a_track_that_repeats_itself, 0.5, 1.5, 0.1, 0.5),
    Fault("a peak of a single record that is left open").at(laws, "PEAK", "another"),
    test_judged_kinds.test_wheels_start_on_no_equal_pieces_of_a_track,
    Fault("wheels that are all as far apart").at(laws, "BENDS", (0.0, 0.0)),
    test_independent_records.test_overlapping_pieces_are_between,
    Fault("records of which none is alike").at(independent_records, "CHANCE", 1.0),
    test_independent_records.test_pieces_of_a_short_track_are_about_as_many_as_it_has_room_for,
    Fault("red noise that is not whitened").at(independent_records, "NEIGHBOURS", 4001),
    partial(test_judged_diagnosis.test_noise_is_random_without_rng, 0.05),
    Fault("noise of ten per cent that is the same").at(repeats, "SAME", 0.5),
    test_judged_diagnosis.test_draws_that_differ_under_any_load_are_draws,
    Fault("draws that are equal under one load").at(stiffness, "EQUAL", 10.0),
    partial(
        test_factors.test_a_factor_is_named_by_what_is_commonly_forgotten,
        0.909,
        factors.OF_VALUES,
        "E for E*, at nu = 0.3",
    ),
    Fault("a factor that no name is near").at(factors, "NEAR", 0.0),
    test_references.test_held_out_scenes_are_none_of_the_tables,
    Fault("held-out loads that are those of the table").at(held_out_solves, "LOADS", (0.01, 0.1)),
]
