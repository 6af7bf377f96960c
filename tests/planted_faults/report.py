"""Faults planted in what `tests/report` looks at: where, what is wrong there, and the test that must catch it."""

import functools

import numpy as np
from markupsafe import Markup

from tests.report import (
    test_answers,
    test_calibration_figure,
    test_claims,
    test_figure_lines,
    test_printed,
    test_sounds,
    test_texts_of_users,
)
from validation.analysis import statistics
from validation.analysis.evidence import Verdict, if_confirmed, numbers_with
from validation.cases.punch import fractal_punch_text
from validation.report import chapter, formats, sounds, style
from validation.report.answers import cells, words
from validation.report.figures import ladder
from validation.report.figures import rolling as rolling_figure

AGREE, DIFFER = Verdict.AGREE, Verdict.DIFFER


def unless_it_differs(sentence, numbers):
    """An undecided number taken for one that agrees."""
    return if_confirmed(sentence, [n for n in numbers if n.verdict is not Verdict.UNDECIDED])


def green_by_its_criteria(status, *, unsteady=False):
    return Markup('<span class="verdict holds">✓ holds</span>')


def by_its_own_peak(samples, full_scale):
    """A sound that is as loud as a file can hold, whatever the others are."""
    values = np.asarray(samples)
    return np.rint(sounds.LARGEST / np.abs(values).max() * values).astype(np.int16)


def enough_by_most(cell):
    """A counterexample outvoted."""
    agree = sum(number.verdict is Verdict.AGREE for number in cell.numbers)
    return cells.Enough.YES if 2 * agree > len(cell.numbers) else cells.Enough.NO


def with_labels_of_the_other_axis(evidence):
    figure = calibration_figure(evidence)
    for axis in figure.axes:
        axis.set(xlabel=axis.get_ylabel(), ylabel=axis.get_xlabel())
    return figure


calibration_figure = ladder.draw


FAULTS = {
    "labels of the calibration figure on the other axes": (
        (ladder, "draw", with_labels_of_the_other_axis),
        functools.partial(
            test_calibration_figure.test_axes_are_labelled_as_their_columns,
            0,
            test_calibration_figure.TRUE,
            "true error",
            "selected models",
        ),
    ),
    "texts of users as mathematics": (
        (style, "plain", lambda text: text),
        functools.partial(test_texts_of_users.test_a_plain_text_is_drawn_as_it_is_written, "$x^2$"),
    ),
    "a cell that says what most of its numbers say": (
        (cells.RangeCell, "enough", property(enough_by_most)),
        test_answers.test_one_counterexample_among_all_exponents_is_a_no,
    ),
    "cells that overlap": (
        (cells, "_apart", lambda found: dict(sorted(found.items()))),
        test_answers.test_ranges_that_overlap_are_one_cell,
    ),
    "the power of a ratio printed for its amplitude": (
        (words, "DECIBEL", statistics.POWER_DECIBEL),
        test_answers.test_decibels_are_printed_as_their_quantity,
    ),
    "a sound normalised by itself": (
        (sounds, "quantised", by_its_own_peak),
        test_sounds.test_files_differ_by_the_level_of_the_forces,
    ),
    "a contradicted claim under a green badge": (
        (formats, "format_status", green_by_its_criteria),
        functools.partial(test_claims.test_a_status_has_its_word_and_sign, [AGREE, DIFFER], {}, "✗ contradicted"),
    ),
    "a statement of the book answered by numbers of another model": (
        (chapter, "numbers_with", lambda numbers, quantity, model: numbers_with(numbers, quantity)),
        functools.partial(test_claims.test_a_key_that_no_number_has_leaves_no_status, {"quantity": "y0", "model": "m"}),
    ),
    "another model's line under a label": (
        (rolling_figure, "SPRINGS", "linear 1D"),
        test_figure_lines.test_lines_of_rolling,
    ),
    "a printed decibel halved": (
        (fractal_punch_text, "DECIBEL", 2 * statistics.DECIBEL),
        test_printed.test_verdicts_of_fig_14_1_are_in_per_cent,
    ),
    "two signs of verdicts exchanged": (
        (formats, "SYMBOL", {"agree": "≠", "differ": "✓", "undecided": "?"}),
        test_printed.test_rows_of_the_page_are_their_numbers,
    ),
    "undecided read as agree": (
        (test_printed, "if_confirmed", unless_it_differs),
        test_printed.test_a_claim_holds_with_all_of_its_numbers,
    ),
}
