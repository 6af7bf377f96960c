"""A clock that ticks by itself, and processes that begin at once."""

import multiprocessing
from types import SimpleNamespace

import pytest

from tests.benchmarks.made_up import use_a_clock_of_its_own
from validation.benchmarks import solvers
from validation.benchmarks import timing as isolation


@pytest.fixture
def by_hand(monkeypatch):
    """No processes; every call takes 10 ms."""
    use_a_clock_of_its_own(monkeypatch)


@pytest.fixture(scope="module")
def forked():
    """Isolated processes are copies of one that has imported everything, which takes two seconds; fewest runs."""
    server = multiprocessing.get_context("forkserver")
    server.set_forkserver_preload(["tests.benchmarks.test_peers", "tests.benchmarks.made_up"])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(isolation, "multiprocessing", SimpleNamespace(get_context=lambda kind: server))
        patch.setattr(solvers, "SETTLED", 0.0)
        yield
