"""A plugin for recordings: what a test costs by itself, with the fixtures that it shares with others of its file."""

import time
from collections.abc import Iterator
from typing import Any

import pytest

SECONDS: dict[tuple[str, str], float] = {}
"""Of fixtures of a module or more, by where they stand and their name."""


@pytest.hookimpl(wrapper=True)
def pytest_fixture_setup(fixturedef: pytest.FixtureDef[Any]) -> Iterator[None]:
    """Time it, the fixtures that it asks for itself left out."""
    start = time.perf_counter()
    try:
        return (yield)
    finally:
        if fixturedef.scope != "function":
            SECONDS[fixturedef.baseid, fixturedef.argname] = time.perf_counter() - start


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_teardown(item: pytest.Function) -> None:
    """Write it to the record."""
    mine = [seconds for (file, name), seconds in SECONDS.items() if name in item.fixturenames and file in item.nodeid]
    item.user_properties.append(("fixtures", f"{sum(mine):.3f}"))
