"""Jobs that share workers: in their order, ahead of their turn, and none left after an error."""

import itertools
import subprocess
import sys
import threading
import time
from concurrent.futures import CancelledError, ThreadPoolExecutor, wait
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from tests.engine.toys import HANG, wait_until
from validation.engine import engine as ensemble
from validation.engine import workers as shared
from validation.engine.engine import Engine
from validation.engine.progress import Part
from validation.engine.realisations import NotConvergedError
from validation.engine.workers import AHEAD, Workers


def slowly(number):
    time.sleep(0.05 * (number % 2))
    return number


@pytest.mark.parametrize("count", [1, 2])
def test_jobs_come_in_their_order_and_errors_with_them(count):
    """With one worker they are done here, with more in threads."""
    threads = set()

    def job(number):
        threads.add(threading.current_thread())
        if number == 3:
            raise ZeroDivisionError
        return slowly(number)

    found = list(Workers(count).ahead([lambda number=number: job(number) for number in range(8)]))
    assert [done.exception() is None for done in found] == [number != 3 for number in range(8)]
    assert [done.result() for done in found if not done.exception()] == [0, 1, 2, 4, 5, 6, 7]
    assert (threads == {threading.current_thread()}) == (count == 1)


def test_no_more_jobs_are_begun_than_there_is_memory_for(monkeypatch):
    submitted = []

    class Counted(ThreadPoolExecutor):
        def submit(self, job):
            submitted.append(job)
            return super().submit(job)

    monkeypatch.setattr(shared, "ThreadPoolExecutor", Counted)
    jobs = Workers(2).ahead([lambda: None] * (3 * AHEAD))
    for done in range(1, 3 * AHEAD + 1):
        next(jobs)
        assert len(submitted) == min(done - 1 + AHEAD, 3 * AHEAD)
    assert not list(jobs)


@dataclass(frozen=True)
class Asked:
    case: str
    number: int


def answer(asked):
    """The solves of one case fail; the rest is slow."""
    if asked.case == "fails" and asked.number == 2:
        raise NotConvergedError("too little is left")
    time.sleep(0.1)
    return {"value": np.full(2, float(asked.number))}


def cases_on(workers, *names, store=None):
    engine = Engine(workers=workers.count, store=store, shared=workers)
    return [lambda name=name: engine.map(answer, [Asked(name, i) for i in range(6)]) for name in names]


@pytest.mark.slow
def test_a_case_that_fails_leaves_the_others_their_workers(tmp_path):
    with Workers(2) as workers:
        first, second, third = workers.ahead(cases_on(workers, "first", "fails", "third", store=tmp_path))
    assert isinstance(second.exception(), NotConvergedError)
    for done in (first, third):
        assert [outcome["value"][0] for outcome in done.result()] == [0, 1, 2, 3, 4, 5]
    assert len(list(tmp_path.iterdir())) >= 12


@pytest.mark.slow
def test_an_error_between_two_cases_ends_the_workers_of_all():
    """What is at work ahead of its turn is not waited for, and nothing else is begun."""
    before, ended = threading.active_count(), []
    with pytest.raises(KeyboardInterrupt), Workers(2) as workers:
        for _ in workers.ahead([lambda: None, lambda: ended.append(workers.submit(time.sleep, 600).result())]):
            raise KeyboardInterrupt
    assert ended == []
    with pytest.raises(CancelledError):
        workers.submit(slowly, 1)
    wait_until(lambda: threading.active_count() <= before)


def test_workers_end_though_some_of_their_work_was_cancelled():
    """A case that fails cancels its solves while the end of the run kills the workers: nobody waits for either."""
    workers = Workers(2)
    waiting = [workers.submit(time.sleep, 30) for _ in range(8)]
    assert waiting[-1].cancel()
    workers.end()
    assert not wait(waiting[:-1], HANG).not_done
    assert all(future.cancelled() or future.exception() for future in waiting)


def test_the_seconds_of_solves_are_counted(tmp_path, monkeypatch):
    """Those of this run, not of an earlier one; by a clock that each look at it sets forward."""
    monkeypatch.setattr(ensemble, "time", SimpleNamespace(perf_counter=itertools.count().__next__))
    for worked in (3.0, 0.0):
        part = Part("first")
        Engine(store=tmp_path, progress=part).map(answer, [Asked("first", i) for i in range(3)])
        assert part.worked == worked


FIRST_IN_THREADS = """
import time
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from validation.engine.workers import Workers

workers, together = Workers(2), threading.Barrier(8)

def first(number):
    together.wait()
    time.sleep(number / 100)
    return workers.submit(abs, -number).result()

with ThreadPoolExecutor(8) as threads:
    assert list(threads.map(first, range(8))) == list(range(8))
workers.end()
"""


@pytest.mark.slow
def test_threads_may_be_the_first_to_need_workers():
    """In a fresh process: the library of processes is imported once, by one of them."""
    run = subprocess.run([sys.executable, "-c", FIRST_IN_THREADS], capture_output=True, encoding="utf-8", timeout=HANG)
    assert run.returncode == 0, run.stderr
