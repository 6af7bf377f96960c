"""Faults planted in series, in claims and in what cases declare of both: where, what is wrong, who must catch it."""

from functools import partial

from tests.analysis import test_series
from tests.cases import test_faults_of_series_of_cases as test_cases
from tests.cases import test_faults_of_series_of_wheels as test_wheels
from tests.planted_faults.wrong import Fault
from validation.analysis import series
from validation.analysis.statistics import DECIBEL, Estimate
from validation.cases.punch import ensembles, fractal_punch, fractal_punch_study
from validation.cases.rolling import force_spectrum
from validation.cases.wheel import half_space_study

FAULTS = [
    test_series.test_a_reference_with_an_error_widens_the_interval_and_one_without_does_not,
    Fault("a series without the error of its reference").at(
        Estimate, "minus", lambda mine, other: Estimate(mine.value - other.value, mine.error, mine.samples)
    ),
    test_cases.test_the_rms_and_the_mean_force_are_those_on_cells_of_no_size,
    Fault("levels of the finest cells for those of no size").at(
        series.Estimates, "on_no_size", lambda mine, finer: mine
    ),
    test_cases.test_each_length_of_springs_has_its_own_level_and_exponents_their_grid,
    Fault("decibels of a power for those of an amplitude, in Fig. 14.1").at(ensembles, "DECIBEL", DECIBEL / 2),
    partial(test_cases.test_a_deviation_below_a_hundredth_counts_as_one, 0.001, 0.01, 0.0),
    Fault("a deviation of nothing that is infinitely far from a small one").at(fractal_punch, "LEAST", -1e9),
    test_cases.test_published_exponents_are_those_of_their_hurst_exponent,
    Fault("published exponents turned round").at(fractal_punch_study, "PUBLISHED", (0.49, 0.75)),
    test_cases.test_the_fit_is_judged_by_its_formula_where_most_of_the_face_carries,
    Fault("a fit without the flat punch").at(fractal_punch_study, "fitted", lambda case, force: force / 0.48),
    test_cases.test_the_mean_curve_is_too_loud_by_its_limit_where_boundary_elements_are_linear_theory,
    Fault("decibels of an amplitude for those of a power, in the mean curve").at(
        force_spectrum, "POWER_DECIBEL", DECIBEL
    ),
    partial(test_cases.test_the_curve_is_judged_over_low_roughness_where_linear_theory_must_hold, 0.1),
    Fault("linear theory must hold over any roughness").at(force_spectrum, "MUST_BE_LINEAR", 1.0),
    test_wheels.test_a_wheel_in_three_dimensions_is_judged_by_the_worst_band_of_each_range,
    Fault("one number of the claim on the wheel for all of them").at(half_space_study, "OF_FIGURE", 1),
]
