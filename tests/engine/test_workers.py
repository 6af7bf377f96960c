"""Workers of any number, here or of a scheduler: equal bits; runs that are killed, workers that are lost."""

import os
import socket
import subprocess
import sys
import threading
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from tests.engine.toys import ENVIRONMENT, ROOT, Slow, computed, contents, gated, same, slow, toy, wait_until
from validation.engine import engine as ensemble
from validation.engine.engine import Engine


@pytest.mark.slow
def test_any_number_of_workers_and_any_order_give_the_same_bits(tmp_path):
    from tests.engine.small_punches import SURFACES, press_surface

    alone = Engine().map(press_surface, SURFACES)
    assert same(alone, Engine(workers=3, store=tmp_path / "3").map(press_surface, SURFACES))
    shuffled = np.random.default_rng(0).permutation(len(SURFACES))
    mixed = Engine(workers=2, store=tmp_path / "2").map(press_surface, [SURFACES[i] for i in shuffled])
    assert same([alone[i] for i in shuffled], mixed)
    assert contents(tmp_path / "3") == contents(tmp_path / "2")


RUN = """
import sys
from pathlib import Path
from tests.engine.toys import Slow, gated
from validation.engine.engine import Engine
problems = [Slow(i, sys.argv[2]) for i in range(12)]
Engine(workers=2, store=Path(sys.argv[1])).map(gated, problems)
"""


@pytest.mark.slow
def test_a_killed_run_goes_on_where_it_stopped(tmp_path):
    """SIGKILL in the middle, no time for any farewell: a rerun ends with the bytes of a run that was left alone, and
    computes nothing again that had been stored, and at most what the two workers were at or had before them."""
    store, log = tmp_path / "store", tmp_path / "log"
    words = [sys.executable, "-c", RUN, str(store), str(log)]
    run = subprocess.Popen(words, cwd=ROOT, env=ENVIRONMENT, stderr=subprocess.DEVNULL)
    try:
        wait_until(lambda: len(list(store.glob("*.npz"))) >= 4, run)
        run.kill()
        run.wait()
        kept = {f.name: f.stat().st_mtime_ns for f in store.glob("*.npz")}
        assert 4 <= len(kept) <= 6
    finally:
        run.kill()
        # for its workers, too, whom nobody waits for any more
        Path(f"{log}.go").touch()
    subprocess.run(words, cwd=ROOT, env=ENVIRONMENT, check=True)
    assert {name: (store / name).stat().st_mtime_ns for name in kept} == kept
    assert 12 <= len(computed(log)) <= 12 + 4
    alone = Engine(store=tmp_path / "alone").map(gated, [Slow(i, str(log)) for i in range(12)])
    assert len(alone) == 12
    assert contents(tmp_path / "alone") == {f.name: f.read_bytes() for f in store.glob("*.npz")}


AT_ANY_TIME = 10**6
"""Seconds that no load makes of a machine that works at all."""


@contextmanager
def meanwhile(action, condition):
    """Do it in a thread as soon as the condition holds, unless all is over by then."""
    over = threading.Event()

    def act():
        wait_until(condition, over=over)
        if not over.is_set():
            action()

    thread = threading.Thread(target=act)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


PART_OF_A_CLUSTER = """
import runpy, sys
from validation.engine.workers import end_with_parent
end_with_parent(int(sys.argv.pop(1)))
runpy.run_module(sys.argv.pop(1), run_name="__main__", alter_sys=True)
"""


@pytest.fixture
def cluster(monkeypatch, request):
    """A real scheduler on loopback: its address, how to start worker processes, and its own process."""
    # a machine that is busy starts processes slowly, as slowly as it likes
    monkeypatch.setattr(ensemble, "TIMEOUT", AT_ANY_TIME)
    started = []

    def start(module, *words):
        run = [sys.executable, "-c", PART_OF_A_CLUSTER, str(os.getpid()), f"distributed.cli.{module}"]
        settings = ENVIRONMENT | getattr(request, "param", {})
        started.append(
            subprocess.Popen([*run, *words, "--no-dashboard"], cwd=ROOT, env=settings, stderr=subprocess.DEVNULL)
        )
        return started[-1]

    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    scheduler = start("dask_scheduler", "--host", "127.0.0.1", "--port", str(port))

    def worker(threads=1):
        return start("dask_worker", f"tcp://127.0.0.1:{port}", "--nthreads", str(threads), "--no-nanny")

    yield f"dask://127.0.0.1:{port}", worker, scheduler
    for process in reversed(started):
        process.kill()
        process.wait()


@pytest.mark.slow
def test_workers_of_a_scheduler_give_the_same_bits_and_one_may_die(cluster, tmp_path):
    """One of two workers is killed in the middle: all results come, each as a single process would have it."""
    from tests.engine.small_punches import SURFACES, press_surface

    address, worker, _ = cluster
    workers = [worker(), worker(threads=2)]
    log = str(tmp_path / "log")
    problems = [Slow(i, log) for i in range(16)]

    with meanwhile(workers[0].kill, lambda: len(computed(log)) >= 6):
        remote = Engine(store=tmp_path / "remote", executor=address).map(slow, problems)
    assert workers[0].wait() != 0
    assert workers[1].poll() is None
    assert set(computed(log)) == set(range(16))
    assert same(Engine().map(slow, problems), remote)
    assert len(list((tmp_path / "remote").glob("*.npz"))) == 16
    # the survivor still computes: surfaces this time, two at once
    here, there = tmp_path / "here", tmp_path / "there"
    assert same(
        Engine(store=here).map(press_surface, SURFACES),
        Engine(store=there, executor=address).map(press_surface, SURFACES),
    )
    assert contents(here) == contents(there)


@pytest.mark.parametrize("executor", ["dask", "dask://", "dask://host", "tcp://host:1", "dask://host:port", "", "loky"])
def test_an_executor_is_local_or_an_address(executor):
    with pytest.raises(ValueError, match="executor must be"):
        Engine(executor=executor)


def test_there_is_at_least_one_worker():
    with pytest.raises(ValueError, match="workers must be at least 1"):
        Engine(workers=0)


@pytest.mark.slow
def test_an_address_where_nobody_answers(problems, monkeypatch):
    monkeypatch.setattr(ensemble, "TIMEOUT", 1)
    with pytest.raises(ValueError, match="executor must be a running scheduler"):
        Engine(executor="dask://127.0.0.1:9").map(toy, problems)


@pytest.mark.slow
def test_a_scheduler_that_is_lost(cluster, tmp_path):
    """A sentence, not a hang; what was finished is kept."""
    address, worker, scheduler = cluster
    worker()  # one is enough to compute there and not here
    store = tmp_path / "store"

    problems = [Slow(i, str(tmp_path / "log")) for i in range(300)]
    lost = pytest.raises(ConnectionError, match=r"scheduler at \S+ is gone; finished solves are kept")
    with lost, meanwhile(scheduler.kill, lambda: len(list(store.glob("*.npz"))) >= 3):
        Engine(store=store, executor=address).map(slow, problems)
    assert len(list(store.glob("*.npz"))) >= 3


@dataclass(frozen=True)
class Deadly:
    number: int


def deadly(problem):
    os._exit(1)


@pytest.mark.slow
@pytest.mark.parametrize("cluster", [{"DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1"}], indirect=True)
def test_a_solve_that_kills_every_worker_is_given_up(cluster, tmp_path):
    """The scheduler gives it to two, one after the other."""
    address, worker, _ = cluster
    for _ in range(2):
        worker()
    with pytest.raises(ensemble.WorkerLostError, match="has killed every worker"):
        Engine(executor=address).map(deadly, [Deadly(0)])


@pytest.mark.slow
def test_a_scheduler_without_workers(problems, cluster, monkeypatch):
    address, _, scheduler = cluster
    host, port = address.removeprefix("dask://").split(":")

    def answers():
        with socket.socket() as caller:
            return caller.connect_ex((host, int(port))) == 0

    wait_until(answers, scheduler)
    client = pytest.importorskip("distributed").Client
    wait = client.wait_for_workers
    # to be found is left its time, workers that will not come are not
    monkeypatch.setattr(client, "wait_for_workers", lambda self, count, timeout: wait(self, count, timeout=1))
    with pytest.raises(ValueError, match="executor must have workers"):
        Engine(executor=address).map(toy, problems)


def test_workers_with_other_numerics_are_refused(problems):
    with pytest.raises(ValueError, match="another version of the numerics"):
        ensemble._solve(toy, problems[0], 0, "another digest")
