"""A clock that ticks by itself."""

import pytest

from tests.benchmarks.made_up import use_a_clock_of_its_own


@pytest.fixture
def by_hand(monkeypatch):
    """No processes; every call takes 10 ms."""
    use_a_clock_of_its_own(monkeypatch)
