"""Processes of a run end with it when it is killed, which leaves it no time to end them."""

import os
import signal
import subprocess
import sys
from contextlib import suppress

import pytest

from tests.engine.jobs import alive_in
from tests.engine.toys import ENVIRONMENT, ROOT, wait_until

WORKERS = """
import sys
from tests.engine import jobs
from validation.engine.engine import Engine
solve, workers, folder = sys.argv[1:]
Engine(workers=int(workers)).map(getattr(jobs, solve), [jobs.Job(i, folder) for i in range(1, 3)])
"""
IDLE = """
import sys, time
from pathlib import Path
from tests.engine.jobs import live_in
from validation.engine.workers import Workers
workers = Workers(2)
workers.submit(live_in, sys.argv[1]).result()
time.sleep(600)
"""
JUDGE = """
import sys
from pathlib import Path
from validation.judging.worker import Visitor
Visitor(Path(sys.argv[1]), seconds=600.0).callers()[0].call(load=1.0)
"""
MODEL = """
import subprocess, sys
from tests.engine.jobs import live_in
from validation import stiffness_model
HERE = {folder!r}
OTHER = "import sys, time, tests.engine.jobs as jobs; jobs.live_in(sys.argv[1]); time.sleep(600)"
@stiffness_model("endless")
def endless(load):
    subprocess.Popen([sys.executable, "-c", OTHER, HERE])
    live_in(HERE)
    while True:
        pass
"""


def killed_in_the_middle(folder, processes, *words):
    """A run that is killed once so many processes of it are alive; they must end, too."""
    run = subprocess.Popen([sys.executable, "-c", *words], cwd=ROOT, env=ENVIRONMENT, stderr=subprocess.DEVNULL)
    try:
        wait_until(lambda: len(alive_in(folder)) == processes, run)
        run.kill()
        run.wait()
        wait_until(lambda: not alive_in(folder))
    finally:
        run.kill()
        for process in alive_in(folder):
            with suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)


@pytest.mark.slow
@pytest.mark.parametrize(("solve", "processes"), [("stay", 2), ("stay_alone", 1)])
def test_processes_at_work_end_with_a_run_that_is_killed(solve, processes, tmp_path):
    """Workers, and a process of its own of the run."""
    killed_in_the_middle(tmp_path, processes, WORKERS, solve, str(processes), str(tmp_path))


@pytest.mark.slow
def test_a_worker_without_work_ends_with_a_run_that_is_killed(tmp_path):
    killed_in_the_middle(tmp_path, 1, IDLE, str(tmp_path))


@pytest.mark.slow
def test_a_file_of_somebody_and_its_processes_end_with_a_run_that_is_killed(tmp_path):
    """In the middle of a call that never ends."""
    (tmp_path / "endless.py").write_text(MODEL.format(folder=str(tmp_path)), encoding="utf-8")
    killed_in_the_middle(tmp_path, 2, JUDGE, str(tmp_path / "endless.py"))
