"""Options of `pytest --pyargs validation.conformance`; an entry point of pytest, so it imports nothing heavy."""

import pytest


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("validation.conformance", "a contact solver or a mapping of your own")
    group.addoption("--contact-solver", metavar="FILE:NAME", help="a function with @contact_solver; without it, bem3d")
    group.addoption(
        "--mapping", metavar="FILE:NAME", help="a function with @profile_spectrum; without it, Geike's rule"
    )
