"""Options of `pytest --pyargs validation.conformance`: an entry point of pytest, which imports nothing without them."""

from typing import Any

OPTIONS = {"--contact-solver": ("contact_solver", "bem3d"), "--mapping": ("profile_spectrum", "Geike's rule")}
"""Of each the kind of a function, and what stands in its place."""


def pytest_addoption(parser: Any) -> None:
    group = parser.getgroup("validation.conformance", "a contact solver or a mapping of your own")
    for option, (kind, ours) in OPTIONS.items():
        group.addoption(option, metavar="FILE:NAME", help=f"a function for @{kind}; by default {ours}")


def pytest_configure(config: Any) -> None:
    """Raises pytest.UsageError, which is one line, for what is no such function."""
    for option, (kind, _) in OPTIONS.items():
        if place := config.getoption(option):
            from pytest import UsageError

            from validation.engine.named import named_in

            try:
                named_in(place, kind)
            except (TypeError, ValueError) as error:
                raise UsageError(f"{option}: {error}") from None
