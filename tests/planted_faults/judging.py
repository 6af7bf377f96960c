"""Faults planted in how models from elsewhere are judged, and the test that must catch each."""

import math
from functools import partial

import numpy as np

from tests.analysis import test_judgement
from tests.planted_faults.wrong import Fault, with_math
from tests.selection import test_judged_ends, test_judged_kinds, test_judged_stiffness
from validation.analysis import judgement
from validation.engine import others
from validation.selection.judging import laws, own, stiffness, sweeps
from validation.selection.judging.judge import ModelAnswer
from validation.simulation.rough_punch import PlateauSpectrum

given, verdict_of = stiffness.AskedPunch.arguments.fget, judgement.verdict_of


def under_twice_the_load(asked):
    return {**given(asked), "load": 2 * given(asked)["load"]}


def without_its_interval(apart, half, within):
    return verdict_of(apart, 0.0, within)


def without_the_error_of_the_sample(values):
    return stiffness.Stiffness(ModelAnswer(np.mean(values)), ModelAnswer(np.std(values) / np.mean(values)))


STAYING = {kind: [one._replace(at=one.at[:1] * len(one.at)) for one in some] for kind, some in sweeps.SWEEPS.items()}
FAULTS = [
    partial(test_judged_ends.test_where_a_model_breaks_is_found, *test_judged_ends.WRONG[5]),
    Fault("a sweep that stays where it begins").at(sweeps, "SWEEPS", STAYING),
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
        judgement, "math", with_math(log10=lambda x: math.log10(x) / 2)
    ),
    test_judged_stiffness.test_realisations_have_their_mean_and_deviation_with_the_error_of_the_sample,
    Fault("realisations without the error of their sample").at(stiffness, "sampled", without_the_error_of_the_sample),
]
