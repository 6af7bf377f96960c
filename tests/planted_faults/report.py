"""Faults planted in what `tests/report` looks at: where, what is wrong there, and the test that must catch it."""

from tests.report import test_figure_lines, test_printed
from validation.analysis import statistics
from validation.analysis.evidence import Verdict, if_confirmed
from validation.cases.punch import fractal_punch_text
from validation.report import page
from validation.report.figures import rolling as rolling_figure


def unless_it_differs(sentence, numbers):
    """An undecided number taken for one that agrees."""
    return if_confirmed(sentence, [n for n in numbers if n.verdict is not Verdict.UNDECIDED])


FAULTS = {
    "another model's line under a label": (
        (rolling_figure, "SPRINGS", "linear 1D"),
        test_figure_lines.test_lines_of_rolling,
    ),
    "a printed decibel halved": (
        (fractal_punch_text, "DECIBEL", 2 * statistics.DECIBEL),
        test_printed.test_verdicts_of_fig_14_1_are_in_per_cent,
    ),
    "two signs of verdicts exchanged": (
        (page, "SYMBOL", {"agree": "≠", "differ": "✓", "undecided": "?"}),
        test_printed.test_rows_of_the_page_are_their_numbers,
    ),
    "undecided read as agree": (
        (test_printed, "if_confirmed", unless_it_differs),
        test_printed.test_a_claim_holds_with_all_of_its_numbers,
    ),
}
