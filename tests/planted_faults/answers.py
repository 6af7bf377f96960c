"""Faults planted in what the answers of a report, its data and its figures say, and the test that must catch each."""

import math
from functools import partial

from tests.analysis import test_conditions
from tests.cases import test_exact_cases, test_no_floor_in_data
from tests.planted_faults.wrong import Fault
from tests.report import test_answers, test_axes, test_columns, test_front
from validation.analysis import claims as conditions
from validation.analysis.series import Series
from validation.cases.exact import hertz
from validation.cases.limits import limits
from validation.cases.punch import fractal_punch
from validation.judging.judgement import AGREE
from validation.report import columns
from validation.report.answers import first_screen, front_tables, strip

order, shown, apart, draw = hertz.order, limits.shown, strip._apart, test_axes.draw


def floored(statistics, hurst, method, statistic, level):
    """The ratio as it is judged, in the place of the one that was found."""
    return statistics.counted(hurst, method, level)


def last_of_those_that_join(found):
    return {place: numbers[-1:] for place, numbers in apart(found).items()}


def with_exchanged_axes(chart, evidence):
    figure = draw(chart, evidence)
    for axis in figure.axes:
        axis.set(xlabel=axis.get_ylabel(), ylabel=axis.get_xlabel())
    return figure


def no_less_than_the_panel_shows(sweep):
    for one in shown(sweep):
        yield Series(one.quantity, one.model, [max(x, 0.04) for x in one.found], along=one.along, at=one.at)


FAULTS = [
    partial(test_no_floor_in_data.test_the_ratio_of_two_deviations_is_that_of_the_deviations, 0.0, 0.1),
    Fault("a floor of a judgement in the data").at(fractal_punch.PunchStatistics, "ratio", floored),
    partial(
        test_no_floor_in_data.test_below_one_per_cent_two_deviations_are_alike_in_verdicts_which_say_so,
        *(0.5, 0.005, AGREE, 0.0),
    ),
    Fault("a rule of judgement that nobody applies").at(fractal_punch, "LEAST", -math.inf),
    test_no_floor_in_data.test_the_data_of_a_limit_are_the_errors_of_its_sweep,
    Fault("the floor of a panel in the data").at(limits, "shown", no_less_than_the_panel_shows),
    test_answers.test_a_strip_and_its_sentence_name_the_hurst_exponents_on_which_a_verdict_depends,
    Fault("a strip that hides its Hurst exponent").at(strip, "alone", lambda *_: ""),
    partial(
        test_conditions.test_values_of_a_condition_that_alone_have_a_verdict_are_named,
        "dadad",
        test_conditions.DIFFER,
        "H = 0.4, 0.7 and 1",
    ),
    Fault("exponents between those that differ named with them").at(conditions, "_in_a_row", lambda *_: True),
    partial(test_answers.test_ranges_that_join_keep_all_of_their_numbers, 0),
    Fault("numbers dropped where ranges join").at(strip, "_apart", last_of_those_that_join),
    test_answers.test_the_table_of_the_readme_names_them_and_its_ranges_share_no_value,
    Fault("neighbours that share a value").at(
        test_answers, "plain", lambda rows: [{**row, "strip": []} for row in first_screen.plain(rows)]
    ),
    partial(
        test_front.test_a_model_is_no_less_within_tolerance_in_one_table_than_in_the_next,
        *("dB", 0.65, 0.85, 1.5, "inconclusive"),
    ),
    Fault("the end of an interval for the error").at(front_tables, "ENOUGH", {"%": 0.0, "dB": -1.0}),
    test_axes.test_the_calibration_chart_has_estimated_errors_along_and_true_ones_up,
    Fault("axes of the calibration chart exchanged").at(test_axes, "draw", with_exchanged_axes),
    partial(
        test_columns.test_a_value_says_what_it_is_the_mean_of_and_where_it_has_none,
        *("fractal_punch", "mean stiffness, judged", "ensemble mean"),
    ),
    Fault("a mean that is called nothing").at(columns, "_MEANINGS", {}),
    partial(test_exact_cases.test_a_case_has_the_order_of_its_errors, 1.0),
    Fault("a tenth more in the order of a case").at(hertz, "order", lambda cells, errors: order(cells, errors) + 0.1),
]
