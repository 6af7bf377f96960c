"""Faults planted in what `tests/house` looks at: where, what is wrong there, and the test that must catch it."""

from bem3d import problem
from tests import test_read_only_results

FAULTS = {
    "a gap that the caller may still write to": (
        (problem, "kept", lambda values: values),
        test_read_only_results.test_an_older_view_of_the_gap_changes_no_problem,
    )
}
