"""Faults planted in what `tests/engine` looks at: where, what is wrong there, and the test that must catch it."""

from functools import partial

from tests.engine import test_engine as test_ensemble
from tests.engine import test_files
from validation.engine import files, sources

FAULTS = {
    "a mode of our own for the file that is there": (
        (files.stat, "S_IMODE", lambda mode: 0o644),
        partial(test_files.test_a_file_that_is_there_keeps_its_mode_and_is_replaced, 0o600),
    ),
    "a link replaced by a file": ((files.os.path, "realpath", str), test_files.test_a_link_is_followed),
    "results of other libraries": (
        (sources, "LIBRARIES", ("numpy",)),
        partial(test_ensemble.test_another_version_of_a_library_is_another_version_of_the_numerics, "scipy"),
    ),
}
