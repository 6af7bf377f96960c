"""Faults planted in what `tests/analysis` looks at: where, what is wrong there, and the test that must catch it."""

import json
import math
from dataclasses import replace
from functools import partial

import numpy as np
import scipy
from scipy import stats

from tests.analysis import (
    test_declared_claims,
    test_error_bars,
    test_error_bars_of_grids,
    test_error_bars_of_rolling,
    test_escapes,
    test_judged_claims,
    test_multilevel,
    test_nominal_bands,
    test_rules_by_loops,
    test_series,
)
from tests.analysis import test_spectra as test_wheel_spectra
from tests.cases import test_interface
from tests.planted_faults.wrong import Fault, module_with
from validation.analysis import claims, contents, spectra, statistics
from validation.analysis import series as declared
from validation.analysis import series as over_range
from validation.analysis import spectra as nominal_bands
from validation.analysis import spectra as regions
from validation.analysis import statistics as multilevel
from validation.analysis.evidence import ClaimStatus, JudgedClaim, Number, Verdict
from validation.cases.punch import fractal_punch
from validation.cases.rolling import force_spectrum

COMBINED = multilevel.combined


def cancelled(weights, parts):
    """Grid errors with the signs of their weights."""
    whole = COMBINED(weights, parts)
    return replace(whole, grid=abs(float(np.dot(weights, [part.grid for part in parts]))))


def beside_with_its_sign(one, other):
    return multilevel.Resolved(one.value.beside(other.value), abs(one.grid - other.grid))


def weighed(factor):
    """(14.17) with a factor, of time step and window."""

    def wrong(series, *, time_step, window="none"):
        record = spectra_of_records(series, time_step=time_step, window=window)
        return replace(record, density=factor(time_step, window) * record.density)

    return wrong


def slope_of_what_is_steep(omega, density, first, last, period):
    centres, means = regions.compensated_band_means(omega, density, first, last, period, 0.0)
    return float(np.polyfit(np.log(centres), np.log(means), 1)[0])


def holds_unless_it_differs(claim):
    """A claim whose numbers are undecided taken for one that holds."""
    return ClaimStatus.CONTRADICTED if claim.count(Verdict.DIFFER) else ClaimStatus.HOLDS


def mean_of_the_range(points):
    """The signed mean over a range, in which signs cancel."""
    return replace(declared.worst(points), value=float(np.mean([p.difference for p in points])))


def about_its_mean(points, tolerance, reason):
    """The scatter over a range, of which a constant difference is no part."""
    found = over_range.root_mean_square(points, tolerance, reason)
    return replace(found, value=float(np.std([point.difference for point in points])))


def unpaired(values, references, weights):
    """The ratio of two means as if each were of realisations of its own."""
    mine, other = (statistics.log_ratio_of_means(x, np.ones(x.shape[1]), weights) for x in (values, references))
    return replace(mine.minus(other), samples=mine.samples)


def of_one_tail(estimate):
    """The quantile of 90 %."""
    return float(stats.t.ppf(0.95, estimate.samples - 1)) * estimate.error


def half_of_the_way(coarse, finer):
    """What halving the cells changes, for what all halvings do."""
    value, left = statistics.extrapolated(coarse, finer)
    return replace(value, value=coarse.value + finer.value), left


moments_with_step = multilevel.Moments.with_step


def with_n(values, used):
    """Variances of samples that are too small by 1 / n."""
    found = multilevel_moments_of(values, used)
    return replace(found, variance=(1 - 1 / used.sum()) * found.variance)


multilevel_moments_of = multilevel.moments


def shuffled(other):
    """The same error, of other realisations."""
    return replace(other, influence=other.influence[::-1])


def both_edges(bands, q, values):
    inside = (q[:, np.newaxis] >= bands.edges[:-1]) & (q[:, np.newaxis] <= bands.edges[1:])
    return values @ inside.astype(complex)


claim_status = JudgedClaim.status.fget
spectra_of_records = spectra.record_spectra
peak = regions.peak


FAULTS = [
    partial(test_escapes.test_a_text_that_a_spreadsheet_computes_is_quoted_in_every_cell_and_header, "=1+1"),
    Fault("a cell that a spreadsheet computes").at(contents, "cell_text", contents.printable),
    partial(test_escapes.test_names_of_folders_are_valid_and_apart_on_every_file_system, *test_escapes.NAMES[0]),
    Fault("folders that upper case alone tells apart").at(contents, "_as_stored", str),
    partial(test_escapes.test_names_of_folders_are_valid_and_apart_on_every_file_system, *test_escapes.NAMES[1]),
    Fault("folders with names of devices").at(contents, "RESERVED", set()),
    test_escapes.test_json_reads_back_and_has_no_character_that_acts,
    Fault("JSON as Python writes it").at(contents, "json_text", lambda value: json.dumps(value, ensure_ascii=False)),
    test_nominal_bands.test_bands_are_base_ten_and_lie_beside_each_other,
    Fault("bands of base two for those of base ten").at(
        nominal_bands.NominalBands,
        "edges",
        property(lambda bands: bands.centres[0] * 2 ** ((np.arange(len(bands) + 1) - 0.5) / 3)),
    ),
    test_nominal_bands.test_power_of_a_wave_is_in_its_band_alone,
    Fault("positive wavenumbers alone for the power of a band").at(
        nominal_bands, "levels", lambda found, bands: spectra.levels(found, bands) / 2
    ),
    test_nominal_bands.test_power_of_a_record_is_that_of_its_waves,
    Fault("lines that keep their slope").at(scipy.signal, "detrend", lambda heights, type: heights),
    partial(test_wheel_spectra.test_spectra_by_slow_sums, 31, "none"),
    Fault("dt for dt^2 in (14.17)").at(spectra, "record_spectra", weighed(lambda time_step, _: 1 / time_step)),
    partial(test_wheel_spectra.test_spectra_by_slow_sums, 31, "none"),
    Fault("one-sided spectrum of a record").at(spectra, "record_spectra", weighed(lambda *_: 2)),
    partial(test_wheel_spectra.test_spectra_by_slow_sums, 31, "hann"),
    Fault("Hann without its mean square").at(
        spectra, "record_spectra", weighed(lambda _, window: 3 / 8 if window == "hann" else 1)
    ),
    partial(test_wheel_spectra.test_peak_of_a_tone_between_lines, 30.5),
    Fault("half a line on in the peak").at(
        regions, "peak", lambda omega, hann, below: peak(omega, hann, below) + omega[0] / 2
    ),
    partial(test_wheel_spectra.test_slope_under_an_oscillation, 0.7),
    Fault("slope of bands that are not levelled").at(regions, "slope", slope_of_what_is_steep),
    partial(test_error_bars.test_the_interval_of_a_mean_is_students, 2),
    Fault("one tail of Student's t").at(statistics.Estimate, "half_width", property(of_one_tail)),
    partial(test_error_bars.test_the_interval_of_a_mean_is_students, 5),
    Fault("the normal quantile for Student's").at(
        statistics, "student", lambda degrees, confidence=0.95: float(stats.norm.ppf((1 + confidence) / 2))
    ),
    partial(test_error_bars_of_rolling.test_ratios_of_levels_cover_their_truth, 4),
    Fault("two standard errors of a sample of four").at(
        statistics.Estimate, "half_width", property(lambda estimate: 2 * estimate.error)
    ),
    Fault("pairs of strips taken for independent ones").at(test_error_bars_of_rolling, "log_ratio_of_means", unpaired),
    test_error_bars_of_grids.test_what_extrapolation_leaves_open_is_half_of_its_way_and_the_interval_of_all_of_it,
    Fault("half of the way to cells of no size").at(test_error_bars_of_grids, "extrapolated", half_of_the_way),
    partial(test_multilevel.test_mean_and_variance_have_no_bias, (8, 4), (0.9,)),
    Fault("steps between grids taken the wrong way").at(
        multilevel.Moments, "with_step", lambda mine, fine, coarse: moments_with_step(mine, coarse, fine)
    ),
    Fault("variances with n").at(multilevel, "moments", with_n),
    test_multilevel.test_values_from_the_same_realisations_share_their_errors,
    Fault("the covariance of two grids lost").at(
        multilevel.Linearised, "__sub__", lambda mine, other: mine + -1.0 * shuffled(other)
    ),
    partial(test_multilevel.test_intervals_hold_as_often_as_they_say, (300, 60), (0.95,), 0.93),
    Fault("the quantile of 90 % for that of 95").at(multilevel, "student", lambda freedom, confidence=0.95: 1.6),
    test_multilevel.test_a_sample_of_two_has_one_degree_of_freedom,
    Fault("degrees of freedom that two surfaces do not have").at(
        multilevel.Linearised, "freedom", property(lambda mine: math.inf)
    ),
    test_declared_claims.test_limits_are_the_first_piece_of_a_range,
    Fault("limits of whatever agrees").at(claims, "takewhile", filter),
    partial(test_multilevel.test_intervals_that_hold_together_share_their_five_per_cent, 25),
    Fault("intervals of single points for those of a range").at(
        multilevel, "student", lambda freedom, confidence=0.95: statistics.student(freedom)
    ),
    test_multilevel.test_the_bias_of_a_logarithm_is_half_of_its_variance,
    Fault("no bias of the logarithm taken off").at(multilevel, "math", module_with(math, log1p=lambda relative: 0.0)),
    test_error_bars_of_grids.test_the_sample_interval_of_fig_14_1,
    Fault("profiles and surfaces taken for the same realisations").at(
        multilevel.Linearised, "beside", lambda mine, other: mine - other
    ),
    test_interface.test_what_finer_cells_change_is_extrapolated_and_half_of_it_left_open,
    Fault("sample and grid exchanged").at(
        declared, "Number", lambda grid, sample, **settings: Number(grid=sample, sample=grid, **settings)
    ),
    test_error_bars_of_rolling.test_levels_of_rolling_are_powers_in_decibels,
    Fault("decibels of an amplitude for those of a power, in rolling").at(
        force_spectrum, "POWER_DECIBEL", statistics.DECIBEL
    ),
    test_rules_by_loops.test_a_band_holds_its_lower_edge_and_not_its_upper,
    Fault("a line at the upper edge of a band counted in it").at(spectra.Bands, "sums", both_edges),
    test_judged_claims.test_one_counterexample_contradicts_and_nothing_undecided_holds,
    Fault("an undecided number taken for one that confirms").at(
        JudgedClaim, "status", property(holds_unless_it_differs)
    ),
    test_judged_claims.test_a_mean_of_both_signs_agrees_where_the_range_does_not,
    Fault("the mean of a range for its worst point").at(test_judged_claims, "worst", mean_of_the_range),
    partial(
        test_judged_claims.test_the_worst_point_is_the_farthest_beyond_its_tolerance_with_its_interval,
        *test_judged_claims.WORST[0],
    ),
    Fault("the farthest point for the worst").at(
        test_judged_claims, "worst", lambda points: max(points, key=lambda p: abs(p.difference))
    ),
    test_judged_claims.test_the_interval_of_a_root_mean_square_holds_whenever_those_of_its_points_do,
    Fault("a root mean square about the mean").at(test_judged_claims, "root_mean_square", about_its_mean),
    partial(test_error_bars_of_grids.test_grid_errors_of_fig_14_1_never_cancel, (-2.0, 2.0), 0.16),
    Fault("grid errors of Fig. 14.1 that cancel in a difference").at(test_error_bars_of_grids, "combined", cancelled),
    test_error_bars_of_grids.test_grid_errors_of_an_exponent_a_trend_and_a_ratio_add_up,
    Fault("grid errors of Fig. 14.1 that cancel in an exponent").at(fractal_punch, "combined", cancelled),
    Fault("grid errors of two methods that cancel").at(multilevel.Resolved, "beside", beside_with_its_sign),
    partial(
        test_judged_claims.test_limits_hold_only_where_all_inside_agrees, Verdict.UNDECIDED, ClaimStatus.CONTRADICTED
    ),
    Fault("limits taken at their word").at(
        JudgedClaim, "status", property(lambda claim: ClaimStatus.LIMITED if claim.inside else claim_status(claim))
    ),
    test_series.test_a_relative_margin_is_of_the_reference_and_a_criterion_has_a_finding_for_its_rms,
    Fault("a relative tolerance in the unit").at(
        test_series, "Margin", lambda relative=False, **settings: declared.Margin(**settings)
    ),
    partial(test_error_bars.test_leaving_out_one_is_the_standard_error_of_a_mean, 7),
    Fault("a jackknife without its n - 1").at(
        statistics, "jackknife_error", lambda without: np.std(without, axis=0, ddof=1) / math.sqrt(len(without))
    ),
    test_judged_claims.test_intervals_of_a_range_hold_at_once,
    Fault("the interval of one point for all of a range").at(
        statistics.Estimate, "half_width_among", lambda one, points: statistics.student(one.samples - 1) * one.error
    ),
]
