"""Faults planted in measured lines and their files: where, what is wrong, and the test that must catch it."""

from dataclasses import replace
from functools import partial

import numpy as np

from tests.planted_faults.wrong import Fault
from tests.railway import test_line_bursts, test_line_columns, test_line_outliers
from validation.railway.problems import rail_quantity
from validation.railway.scenes import line_columns, line_edits, line_steps
from validation.railway.scenes import line_edits as line_bursts
from validation.railway.scenes import line_steps as line_outliers
from validation.railway.scenes.level_files import RoughnessLevels
from validation.railway.scenes.line_edits import EditedLine, LineEdits
from validation.scenes import number_table, table_files

of_clean_lines = (
    test_line_outliers.test_levels_without_outliers_are_those_of_the_clean_line_within_the_error_that_is_left
)
change, kept, of_columns = EditedLine.change, EditedLine.kept, table_files.heights_of_columns
bursts_of = line_bursts.bursts_of
errors, without_steps, positions_of = LineEdits.errors, line_steps.without_steps, line_columns._positions_of


def in_the_unit_of_the_first(table, places, metre):
    one = table.columns[places[0]]
    return of_columns(replace(table, columns=(one,) * len(table.columns)), places, metre)


def steps_downwards(line, spacing, sensor):
    clean, steps = without_steps(line, spacing, sensor)
    return 2 * line - clean, steps


def positions_without_the_last(numbers, given, rest, dead):
    where, words = positions_of(numbers, given, rest, dead)
    return (given[: len(rest)] if given else where), words


def where_it_is_raised(line, measured, spacing, sensor):
    return bursts_of(line, line, spacing, sensor)


FAULTS = [
    partial(test_line_outliers.test_clean_lines_have_no_outliers, "H = 0.5", 0.0),
    Fault("roughness taken for spikes").at(line_outliers, "STANDS_OUT", 3.0),
    partial(test_line_outliers.test_clean_lines_have_no_outliers, "corrugated in part", 0.0),
    Fault("one scale of a line of two grounds").at(line_outliers, "STRETCH", 1e3),
    partial(test_line_outliers.test_all_that_is_planted_is_found_where_it_is, "spikes"),
    Fault("spikes that nobody finds").at(line_outliers, "STANDS_OUT", 100.0),
    partial(test_line_outliers.test_all_that_is_planted_is_found_where_it_is, "wide pits"),
    Fault("pits wider than a few points that are not seen").at(line_outliers, "DISTANCES", line_outliers.DISTANCES[:4]),
    partial(test_line_outliers.test_all_that_is_planted_is_found_where_it_is, "step down"),
    Fault("steps of a hundred scales alone").at(line_steps, "STEP", 100.0),
    partial(of_clean_lines, "step"),
    Fault("the part behind a step moved the other way").at(line_edits, "without_steps", steps_downwards),
    partial(of_clean_lines, "zeros"),
    Fault("no error of what a straight line replaces").at(
        EditedLine, "change", lambda line, bands: 0 * change(line, bands)
    ),
    partial(test_line_outliers.test_outliers_that_are_kept_are_in_the_error, "spikes"),
    Fault("no error of outliers that are kept").at(EditedLine, "kept", lambda line, bands: 0 * kept(line, bands)),
    partial(test_line_outliers.test_lines_of_which_too_much_is_gone_have_no_error, "above"),
    Fault("clipping at one end that is not seen").at(line_steps, "CROWDED", np.inf),
    partial(test_line_outliers.test_lines_of_which_too_much_is_gone_have_no_error, "a gap"),
    Fault("half of a line that is made up").at(line_edits, "MOST_REPLACED", 1.0),
    test_line_outliers.test_errors_of_several_lines_are_those_of_their_mean_energy,
    Fault("the error of the worst line for that of the mean").at(
        LineEdits, "errors", lambda edits, bands, powers: errors(edits, bands, powers / len(powers))
    ),
    test_line_outliers.test_errors_are_cut_and_added_with_their_levels,
    Fault("errors of the wheel left out of the sum").at(
        RoughnessLevels, "_powers_of_errors", property(lambda levels: 0 * levels.powers)
    ),
    test_line_columns.test_positions_of_dead_lines_go_with_them,
    Fault("positions of the first lines for those that are left").at(
        line_columns, "_positions_of", positions_without_the_last
    ),
    test_line_columns.test_noise_beside_rough_lines_is_no_line,
    Fault("noise of a sensor taken for roughness").at(line_columns, "noise_among", lambda lines: []),
    test_line_columns.test_positions_in_a_first_row_are_no_point,
    Fault("a row of positions read as a point").at(
        line_columns, "_without_first_row", lambda numbers, given: (numbers, ())
    ),
    test_line_columns.test_each_column_has_its_own_unit,
    Fault("all columns in the unit of the first").at(
        (table_files, test_line_columns), "heights_of_columns", in_the_unit_of_the_first
    ),
    test_line_columns.test_a_value_is_no_data_where_it_is_far_from_all_others_alone,
    Fault("a large height taken for no data").at(number_table, "LONELY", 0.0),
    test_line_outliers.test_no_filter_has_less_error_than_its_lines,
    Fault("a filter without the error of its lines").at(
        rail_quantity.RailQuantity, "left_by_faults", property(lambda asked: np.zeros(len(asked.bands)))
    ),
    partial(test_line_outliers.test_lines_of_which_too_much_is_gone_have_no_error, "below"),
    Fault("clipping that is forgiven").at(line_edits, "MOST_CLIPPED", 1.0),
    test_line_columns.test_seconds_since_1970_are_no_places,
    Fault("times taken for places").at(line_columns, "EPOCH", (0.0, 0.0)),
    partial(test_line_bursts.test_a_burst_is_named_where_it_is_and_is_in_the_error, "white", 5.0),
    Fault("bursts of noise that nobody finds").at(line_edits, "bursts_of", lambda *_: ()),
    partial(test_line_bursts.test_a_burst_is_named_where_it_is_and_is_in_the_error, "ground", 5.0),
    Fault("no error of a burst that is named").at(EditedLine, "of_bursts", lambda line, bands: np.zeros(len(bands))),
    partial(test_line_bursts.test_a_part_that_is_twice_as_rough_is_no_burst, 2.0),
    Fault("no part of a line may be rougher than the others").at(line_bursts, "NATURAL", 1.0),
    test_line_bursts.test_a_corrugation_of_a_part_is_no_burst,
    Fault("a corrugation taken for a burst").at(line_bursts, "NEIGHBOURS", 1),
    partial(test_line_bursts.test_right_lines_of_any_length_have_no_burst, 2e-3),
    Fault("bands compared as if they had no scatter").at(
        line_bursts.Windows, "_over", lambda windows, p: windows.powers > np.median(windows.powers, axis=0)
    ),
    test_line_bursts.test_a_burst_over_an_eightieth_of_a_line_is_named,
    Fault("long windows alone").at(line_bursts, "PARTS", (20,)),
    test_line_bursts.test_what_a_burst_adds_is_that_of_its_part_of_a_white_line,
    Fault("what a burst adds over all windows, and not over those without it").at(
        line_bursts.Windows, "touched", lambda windows, bursts: np.arange(windows.starts.size) < 1
    ),
    test_line_bursts.test_a_line_with_a_burst_over_more_than_a_third_has_no_error,
    Fault("a line of which half is a burst").at(line_edits, "MOST_OF_LINE", 1.0),
    partial(test_line_bursts.test_a_burst_is_named_where_it_is_and_is_in_the_error, "white", 60.0),
    Fault("a burst all of whose points are spikes").at(line_edits, "bursts_of", where_it_is_raised),
    partial(test_line_bursts.test_a_step_with_a_flank_in_a_corrugated_line_is_named, 14),
    Fault("steps that corrugation hides").at(line_steps, "_hidden_step", lambda *_: None),
    partial(test_line_bursts.test_wide_shallow_pits_are_named, 180),
    Fault("pits wider than 0.1 m that are not seen").at(line_outliers, "DISTANCES", line_outliers.DISTANCES[:10]),
]
