"""Options of `pytest --pyargs validation.conformance`: an entry point of pytest, which imports nothing."""

from typing import Any


def pytest_addoption(parser: Any) -> None:
    group = parser.getgroup("validation.conformance", "a contact solver or a mapping of your own")
    group.addoption("--contact-solver", metavar="FILE:NAME", help="a function for @contact_solver; by default bem3d")
    group.addoption("--mapping", metavar="FILE:NAME", help="a function for @profile_spectrum; by default Geike's rule")
