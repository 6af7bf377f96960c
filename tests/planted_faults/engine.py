"""Faults planted in what `tests/engine` looks at: where, what is wrong there, and the test that must catch it."""

from functools import partial

from tests.engine import test_engine as test_ensemble
from tests.engine import test_files
from tests.planted_faults.wrong import Fault
from validation.engine import files, sources

FAULTS = [
    partial(test_files.test_a_file_that_is_there_keeps_its_mode_and_is_replaced, 0o600),
    Fault("a mode of our own for the file that is there").at(files.stat, "S_IMODE", lambda mode: 0o644),
    test_files.test_a_link_is_followed,
    Fault("a link replaced by a file").at(files.os.path, "realpath", str),
    partial(test_ensemble.test_another_version_of_a_library_is_another_version_of_the_numerics, "scipy"),
    Fault("results of other libraries").at(sources, "LIBRARIES", ("numpy",)),
]
