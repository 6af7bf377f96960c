"""Options of `pytest --pyargs validation.conformance`: an entry point of pytest, which imports nothing without them.

Names and destinations are of this package alone: pytest of any project loads every entry point that is installed.
"""

from collections.abc import Generator
from copy import copy
from importlib.util import find_spec
from typing import Any

import pytest

TESTS = "validation.conformance"


def options() -> dict[str, tuple[str, str]]:
    """Of each the kind of a function, and what stands in its place; none without the house that judges."""
    if find_spec("validation.judging") is None:
        return {}
    from validation.judging import MAPPING, SOLVER

    return {SOLVER: ("contact_solver", "bem3d"), MAPPING: ("profile_spectrum", "Geike's rule")}


def pytest_addoption(parser: Any) -> None:
    group = parser.getgroup("validation.conformance", "a contact solver or a mapping of your own")
    for option, (kind, ours) in options().items():
        group.addoption(option, metavar="FILE:NAME", help=f"a function for @{kind}; by default {ours}")


@pytest.hookimpl(hookwrapper=True)
def pytest_load_initial_conftests(early_config: Any, parser: Any, args: list[str]) -> Generator[None]:
    """Names up to 0.3, which nobody else has where these tests run, become new ones, once all options are known."""
    yield
    if TESTS not in args:
        return
    before = {f"--{option.removeprefix('--mdr-')}": option for option in options()}
    before["--contact-solver"] = before.pop("--solver", "")
    _, unknown = parser.parse_known_and_unknown_args(args, copy(early_config.option))
    for place, word in enumerate(args):
        name, equals, value = word.partition("=")
        if before.get(name) and word in unknown:
            args[place] = f"{before[name]}{equals}{value}"


def pytest_configure(config: Any) -> None:
    """Raises pytest.UsageError, which is one line, for what is no such function."""
    for option, (kind, _) in options().items():
        if place := config.getoption(option):
            from validation.judging.own_models import named_in

            try:
                named_in(place, kind)
            except (TypeError, ValueError) as error:
                raise pytest.UsageError(f"{option}: {error}") from None
