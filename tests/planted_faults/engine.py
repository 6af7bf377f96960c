"""Faults planted in what `tests/engine` looks at: where, what is wrong there, and the test that must catch it."""

import functools

from tests.engine import test_engine as test_ensemble
from validation.engine import sources

FAULTS = {
    "results of other libraries": (
        (sources, "LIBRARIES", ("numpy",)),
        functools.partial(test_ensemble.test_another_version_of_a_library_is_another_version_of_the_numerics, "scipy"),
    ),
}
