"""Threads share out the transforms of large grids: no bit tells how many, and they end when they should."""

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import tracemalloc
from collections import deque
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest

import bem3d
from bem3d import blocked_convolution
from bem3d import threads as shared_out
from tests.bem3d.test_operator_against_dense_twin import in_blocks, random_pressure
from tests.seeded import catches
from validation.engine.engine import Engine

LARGE = {"shape": (523, 611), "spacing": (1.0, 1.3), "modulus": 2.0}
"""More cells than a grid that is transformed as a whole, if it is periodic."""
HANG = 300
"""Seconds after which a wait has failed."""


def started():
    return [thread for thread in threading.enumerate() if thread.name.startswith(f"bem3d-{os.getpid()}")]


share = blocked_convolution.share


@catches("threads that share a buffer", periodic=False).at(
    "bem3d.blocked_convolution.share", lambda work, blocks, buffers: share(work, blocks, [buffers[0]] * len(buffers))
)
@pytest.mark.parametrize("periodic", [False, True])
def test_bits_of_a_displacement_are_equal_for_any_threads(periodic):
    one, *others = (bem3d.HalfSpace(**LARGE, periodic=periodic, threads=n) for n in (1, 2, 3, 5))
    pressure = random_pressure(one, 0)
    expected = one.displacement(pressure)
    interval = sys.getswitchinterval()
    try:
        # from thread to thread whenever the interpreter can
        sys.setswitchinterval(1e-6)
        for other in others:
            for _ in range(3):
                np.testing.assert_array_equal(other.displacement(pressure), expected)
    finally:
        sys.setswitchinterval(interval)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("shape", [(90, 75), (1, 130), (47, 64)])
def test_bits_of_a_contact_are_equal_for_any_threads(shape, periodic, monkeypatch):
    in_blocks(monkeypatch, columns=5, numbers=300)
    gap = np.random.default_rng(0).random(shape)

    def pressure(threads):
        body = bem3d.HalfSpace(shape=shape, spacing=1.0, modulus=1.0, periodic=periodic, threads=threads)
        return bem3d.solve(body, gap, force=0.05 * gap.size, indenter_ends_at_edge=True).pressure

    expected = pressure(1)
    for threads in (2, 3, 5, "all"):
        np.testing.assert_array_equal(pressure(threads), expected)


def test_cells_are_those_of_the_whole_field():
    """A field that is zero but at some cells, by threads, and read back there."""
    body = bem3d.HalfSpace(**LARGE, threads=2)
    field = random_pressure(body, 0) * (random_pressure(body, 1) > 1.5)
    field[:100] = 0.0
    cells = np.flatnonzero(field)
    convolution = body.convolution
    found = convolution.at(convolution.places(cells), field.ravel()[cells])
    np.testing.assert_array_equal(found, body.displacement(field).ravel()[cells])


def test_a_convolution_of_one_half_space_waits_for_the_other():
    """They share the memory of their spectra, whichever is made first."""
    body = bem3d.HalfSpace(**LARGE, threads=2)
    field = random_pressure(body, 0)
    nearly, exact = body.inverse(field), body.convolution(field)
    with ThreadPoolExecutor(2) as callers:
        for found, expected in zip(
            callers.map(lambda one: one(field), [body.inverse, body.convolution] * 3), 3 * [nearly, exact], strict=True
        ):
            np.testing.assert_array_equal(found, expected)


@catches("a spectrum for each convolution").at(
    "bem3d.HalfSpace._memory", property(lambda body: blocked_convolution.SpectrumMemory())
)
def test_memory_of_the_operators():
    """In fields: a spectrum of 2 that both share, quadrants of the symbols of 1 and a quarter, and buffers."""
    body = bem3d.HalfSpace(shape=(1024, 1024), spacing=1.0, modulus=1.0)
    field = np.ones(body.shape)
    body.like(shape=(2, 2)).displacement(np.ones((2, 2)))  # imports what transforms need
    tracemalloc.start()
    try:
        for operator in (body.convolution, body.inverse):
            operator(field)
        left, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert left < 4 * field.nbytes
    assert peak < 5 * field.nbytes


def test_large_relatives_are_let_go():
    """Their plans cost less than their memory; those of small ones are kept."""
    body = bem3d.HalfSpace(shape=(1100, 1100), spacing=1.0, modulus=1.0)
    for cells, kept in ((550, False), (500, True)):
        relative = body.like(shape=(cells, cells))
        body.release(relative)
        assert (body.like(shape=(cells, cells)) is relative) == kept


def test_a_half_space_keeps_its_threads_and_is_equal_without_them():
    body = bem3d.HalfSpace(shape=(40, 30), spacing=1.0, modulus=1.0, threads=3)
    assert body == bem3d.HalfSpace(shape=(40, 30), spacing=1.0, modulus=1.0)
    assert body.like(shape=(20, 20)).threads == pickle.loads(pickle.dumps(body)).threads == 3


@pytest.mark.parametrize("given", [0, -1, 1.5, True, "two", None])
def test_threads_are_a_whole_number_or_all(given):
    with pytest.raises((ValueError, TypeError), match=r"^threads.* must be"):
        bem3d.HalfSpace(shape=(2, 2), spacing=1.0, modulus=1.0, threads=given)


@dataclass
class Watch:
    """awaited: the main thread waits for another one; drained: another one has dropped all blocks that were left;
    interrupts: of the wait."""

    awaited: threading.Event = field(default_factory=threading.Event)
    drained: threading.Event = field(default_factory=threading.Event)
    interrupts: list[str] = field(default_factory=list)

    def forget(self):
        self.awaited.clear()
        self.drained.clear()

    def sleep(self, seconds):
        if self.interrupts:
            raise KeyboardInterrupt(self.interrupts.pop(0))
        self.awaited.set()
        time.sleep(seconds)

    def drain(self, left, maxlen):
        deque(left, maxlen)
        if threading.current_thread() is not threading.main_thread():
            self.drained.set()


@contextmanager
def watched():
    """Threads that share out their work; whatever a test finds, none is left at work."""
    watch = Watch()
    with mock.patch.object(shared_out, "sleep", watch.sleep), mock.patch.object(shared_out, "deque", watch.drain):
        try:
            yield watch
        finally:
            watch.awaited.set()


@catches("nobody waits for the other threads", in_the_caller=True).at("bem3d.threads._wait", lambda left, at_work: None)
@pytest.mark.parametrize("in_the_caller", [True, False])
def test_after_an_exception_in_a_block_the_next_answer_is_right(in_the_caller):
    """As Ctrl-C is one: nothing further is begun, and nobody writes to the buffers of the next call."""
    body = bem3d.HalfSpace(**LARGE, threads=2)
    pressure = random_pressure(body, 0)
    expected, multiply = body.displacement(pressure), blocked_convolution.BlockedConvolution._multiply
    begun, ended = [], []

    def interrupted(convolution, buffers, block):
        here = threading.current_thread() is threading.main_thread()
        begun.append(here)
        both.wait()
        if here == in_the_caller:
            raise KeyboardInterrupt
        # either comes after the blocks that are left were dropped
        assert (watch.awaited if in_the_caller else watch.drained).wait(HANG)
        multiply(convolution, buffers, block)
        ended.append(here)

    with watched() as watch:
        both = threading.Barrier(2, watch.forget, timeout=HANG)
        with (
            mock.patch.object(blocked_convolution.BlockedConvolution, "_multiply", interrupted),
            pytest.raises(KeyboardInterrupt),
        ):
            body.displacement(pressure)
        assert ended == [not in_the_caller] and len(begun) == 2, "of 23 blocks"
    np.testing.assert_array_equal(body.displacement(pressure), expected)


def wait_once_more(left, at_work):
    """A wait that survives one interrupt, and no second one."""
    try:
        wait_uninterrupted(left, at_work)
    except KeyboardInterrupt:
        wait_uninterrupted(left, at_work)
        raise


def wait_uninterrupted(left, at_work):
    deque(left, maxlen=0)
    while at_work:
        shared_out.sleep(shared_out.POLL)


@catches("a second interrupt ends the wait", interrupts=2).at("bem3d.threads._wait", wait_once_more)
@pytest.mark.parametrize("interrupts", [0, 1, 2, 5])
def test_interrupts_of_the_wait_come_after_the_last_block(interrupts):
    """As many Ctrl-C as there are; the first of them is raised."""
    begun, ended = threading.Event(), []

    def work(_, block):
        if threading.current_thread() is threading.main_thread():
            begun.wait(HANG)
            raise KeyboardInterrupt("block")
        begun.set()
        watch.awaited.wait(HANG)
        ended.append(block)

    with watched() as watch:
        watch.interrupts.extend(f"interrupt {i}" for i in range(interrupts))
        with pytest.raises(KeyboardInterrupt) as interrupted:
            shared_out.share(work, range(9), ["of the caller", "of the other"])
        assert len(ended) == 1 and not watch.interrupts
    assert interrupted.value.args == ("interrupt 0" if interrupts else "block",)


def share_by_futures(work, blocks, buffers):
    """Only what has a future is waited for."""
    left, futures = iter(blocks), []

    def part(own):
        for block in left:
            work(own, block)

    try:
        for own in buffers[1:]:
            futures.append(shared_out._pool(len(buffers) - 1, os.getpid()).submit(part, own))
        part(buffers[0])
    finally:
        deque(left, maxlen=0)
        wait(futures)


@catches("a thread whose future is lost").at("bem3d.threads.share", share_by_futures)
def test_a_thread_is_waited_for_whose_start_is_interrupted():
    """It is at work already, and its caller has no future of it."""
    pool, begun, ended = shared_out._pool(1, os.getpid()), threading.Event(), []

    def submit(*call):
        pool.submit(*call)
        begun.wait(HANG)
        raise KeyboardInterrupt

    def work(_, block):
        begun.set()
        watch.awaited.wait(HANG)
        ended.append(block)

    with watched() as watch, mock.patch.object(shared_out, "_pool", lambda *_: SimpleNamespace(submit=submit)):
        with pytest.raises(KeyboardInterrupt):
            shared_out.share(work, range(9), ["of the caller", "of the other"])
        assert len(ended) == 1


FORKED = """
import multiprocessing, numpy as np, bem3d
body = bem3d.HalfSpace(shape=(523, 611), spacing=1.0, modulus=2.0, threads=2)
pressure = np.random.default_rng(0).random(body.shape)
expected = body.displacement(pressure)
def same(queue):
    queue.put(np.array_equal(body.displacement(pressure), expected))
context = multiprocessing.get_context("fork")
queue = context.Queue()
child = context.Process(target=same, args=(queue,))
child.start()
assert queue.get(timeout=300)
child.join()
"""

ENDLESS = """
import signal, numpy as np, bem3d
body = bem3d.HalfSpace(shape=(523, 611), spacing=1.0, modulus=2.0, threads=2)
pressure = np.random.default_rng(0).random(body.shape)
# where it is ignored, children inherit that
signal.signal(signal.SIGINT, signal.default_int_handler)
while True:
    body.displacement(pressure)
    print("once", flush=True)
"""


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="a system without fork")
def test_a_fork_after_threads_makes_threads_of_its_own():
    subprocess.run([sys.executable, "-W", "ignore", "-c", FORKED], check=True, timeout=HANG)


@pytest.mark.slow
def test_ctrl_c_ends_the_threads():
    with subprocess.Popen([sys.executable, "-c", ENDLESS], stdout=-1, stderr=-1, encoding="utf-8") as process:
        assert process.stdout.readline() == "once\n"
        process.send_signal(signal.SIGINT)
        assert "KeyboardInterrupt" in process.communicate(timeout=HANG)[1]


@dataclass(frozen=True)
class Press:
    seed: int


def press(problem):
    """The mean displacement of a large grid, and the threads that it has started in its process."""
    body = bem3d.HalfSpace(**LARGE)
    return {"mean": body.displacement(random_pressure(body, problem.seed)).mean(), "threads": np.array(len(started()))}


@pytest.mark.slow
def test_a_process_of_the_engine_has_one_thread():
    bem3d.HalfSpace(**LARGE, threads=2).displacement(np.ones(LARGE["shape"]))
    assert started()
    here = [press(Press(seed))["mean"] for seed in range(2)]
    outcomes = Engine(workers=2).map(press, [Press(seed) for seed in range(2)])
    assert [int(outcome["threads"]) for outcome in outcomes] == [0, 0]
    assert [float(outcome["mean"]) for outcome in outcomes] == here
