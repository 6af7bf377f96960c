"""Options of `pytest --pyargs validation.conformance`: an entry point of pytest, which imports nothing without them.

Names and destinations are of this package alone: pytest of any project loads every entry point that is installed.
"""

from collections.abc import Generator
from copy import copy
from importlib.util import find_spec
from typing import Any

import pytest

SOLVER, MAPPING = "--mdr-solver", "--mdr-mapping"
OPTIONS = {SOLVER: ("contact_solver", "bem3d"), MAPPING: ("profile_spectrum", "Geike's rule")}
"""Of each the kind of a function, and what stands in its place."""
BEFORE = {"--contact-solver": SOLVER, "--mapping": MAPPING}
"""Their names up to 0.3, which are read where the tests of `validation.conformance` run and nobody else has them."""
TESTS = "validation.conformance"


def pytest_addoption(parser: Any) -> None:
    if find_spec("validation.judging") is None:
        return
    group = parser.getgroup("validation.conformance", "a contact solver or a mapping of your own")
    for option, (kind, ours) in OPTIONS.items():
        group.addoption(option, metavar="FILE:NAME", help=f"a function for @{kind}; by default {ours}")


@pytest.hookimpl(hookwrapper=True)
def pytest_load_initial_conftests(early_config: Any, parser: Any, args: list[str]) -> Generator[None]:
    """Old names become new ones, once all options are known."""
    yield
    if TESTS not in args:
        return
    _, unknown = parser.parse_known_and_unknown_args(args, copy(early_config.option))
    for place, word in enumerate(args):
        name, equals, value = word.partition("=")
        if name in BEFORE and word in unknown:
            args[place] = f"{BEFORE[name]}{equals}{value}"


def pytest_configure(config: Any) -> None:
    """Raises pytest.UsageError, which is one line, for what is no such function."""
    for option, (kind, _) in OPTIONS.items():
        if place := config.getoption(option, None):
            from validation.judging.by_name import named_in

            try:
                named_in(place, kind)
            except (TypeError, ValueError) as error:
                raise pytest.UsageError(f"{option}: {error}") from None
