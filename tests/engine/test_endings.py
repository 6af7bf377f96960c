"""How runs end that do not come to their end: one sentence, the status that the table promises, no worker left."""

import errno
import os
import re
import signal
import subprocess
import sys
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import pytest

from tests.engine.jobs import Job, alive_in, case_of, die_at_once, lose_alone, stay
from tests.engine.toys import ENVIRONMENT, HANG, ROOT, wait_until
from tests.report.test_command_line import SMALL
from validation import __main__ as command
from validation.benchmarks.timing import isolated_process
from validation.engine import workers as termination
from validation.engine.engine import Engine, WorkerLostError
from validation.report import page as pictures
from validation.report.contents import CASES


def raising(error):
    def run(case, engine):
        raise error

    return replace(CASES["hertz"], run=run)


def report(folder, *words):
    return command.main(["report", "--only", "hertz", "--out", str(folder), "--workers", "2", *words])


def test_a_request_that_is_ignored_on_purpose_ends_no_run():
    """As a hang-up under nohup; one that has a handler of its own keeps that; all are as before, afterwards."""
    taken = list[int]()
    wanted = {signal.SIGHUP: signal.SIG_IGN, signal.SIGTERM: lambda number, frame: taken.append(number)}
    before = {number: signal.signal(number, handler) for number, handler in wanted.items()}
    try:
        # which would interrupt pytest itself
        with suppress(termination.TerminatedError), termination.terminable():
            for number in wanted:
                signal.raise_signal(number)
        assert taken == [signal.SIGTERM]
        assert {number: signal.getsignal(number) for number in wanted} == wanted
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
        with pytest.raises(termination.TerminatedError, match="SIGHUP"), termination.terminable():
            signal.raise_signal(signal.SIGHUP)
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_DFL
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@pytest.mark.slow
def test_a_worker_that_is_killed_is_exit_4(tmp_path, monkeypatch, capsys):
    """In a sentence; and what was finished is kept."""
    monkeypatch.setitem(CASES, "hertz", case_of(die_at_once, tmp_path))
    assert report(tmp_path) == command.Exit.UNFINISHED == 4
    said = capsys.readouterr().err.splitlines()[-1]
    assert re.fullmatch(r"error: a worker was killed, .*; finished solves are kept, the same command goes on .*", said)
    assert len(list((tmp_path / "realisations").glob("*.npz"))) == 1
    assert not (tmp_path / "results.json").exists()


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2])
def test_a_process_of_its_own_that_dies_is_a_lost_worker(workers, tmp_path):
    with pytest.raises(WorkerLostError, match="a worker was killed"):
        Engine(workers=workers).map(lose_alone, [Job(i, str(tmp_path)) for i in range(2)])


@pytest.mark.slow
def test_a_worker_that_is_killed_while_it_draws_is_exit_4(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(CASES, "hertz", replace(CASES["hertz"], quick=SMALL["hertz"]))
    monkeypatch.setattr(pictures, "draw_figure", lambda *_: os.kill(os.getpid(), signal.SIGKILL))
    assert report(tmp_path) == command.Exit.UNFINISHED
    assert capsys.readouterr().err.splitlines()[-1].startswith("error: a worker was killed")
    assert list((tmp_path / "realisations").glob("*.npz"))
    assert not (tmp_path / "results.json").exists()


RUN = """
import os
import signal
import sys
from pathlib import Path
from tests.engine import jobs
from validation import __main__ as command
from validation.engine.workers import end_with_parent
from validation.report.contents import CASES
solve, folder, workers = sys.argv[1:]
# whoever started the tests may have had them ignored
signal.signal(signal.SIGHUP, signal.SIG_DFL)
signal.signal(signal.SIGTERM, signal.SIG_DFL)
signal.signal(signal.SIGINT, signal.default_int_handler)
end_with_parent(os.getppid())
CASES["hertz"] = jobs.case_of(getattr(jobs, solve), Path(folder))
words = ["report", "--only", "hertz", "--out", folder + "/out", "--workers", workers]
sys.exit(command.main(words))
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("asked", "status", "said", "solve", "workers"),
    [
        (signal.SIGTERM, 143, "terminated", "stay", 2),
        (signal.SIGHUP, 143, "terminated", "stay_alone", 1),
        (signal.SIGINT, 130, "interrupted", "stay", 2),
    ],
)
def test_who_is_asked_to_end_takes_all_workers_along(asked, status, said, solve, workers, tmp_path):
    """However long a solve would take; in a sentence; and the next run has what was finished."""
    words = [sys.executable, "-c", RUN, solve, str(tmp_path), str(workers)]
    run = subprocess.Popen(words, cwd=ROOT, env=ENVIRONMENT, stderr=subprocess.PIPE, encoding="utf-8")
    wait_until(lambda: len(alive_in(tmp_path)) == workers, run)
    run.send_signal(asked)
    _, told = run.communicate(timeout=HANG)
    assert run.returncode == status
    assert told.splitlines()[-1] == f"{said}; finished solves are kept, the same command goes on from there"
    assert "Traceback" not in told
    assert not alive_in(tmp_path)
    assert len(list((tmp_path / "out" / "realisations").glob("*.npz"))) == 1
    assert not list((tmp_path / "out").glob(".mdr-validation*"))


@pytest.mark.slow
def test_a_process_of_its_own_that_nobody_waits_for_is_ended(tmp_path):
    with pytest.raises(ZeroDivisionError), isolated_process() as lane:
        answer = lane.submit(stay, Job(1, str(tmp_path)))
        wait_until(lambda: alive_in(tmp_path))
        raise ZeroDivisionError
    with pytest.raises(BrokenProcessPool):
        answer.result()


@pytest.mark.parametrize(
    ("error", "status", "said"),
    [
        (MemoryError("unable to allocate 12 GiB"), 4, "error: the memory is full: unable to allocate 12 GiB; finished"),
        (OSError(errno.ENOSPC, "No space left", "here/x"), 4, "error: here/x: No space left; finished solves are kept"),
        (OSError(errno.EIO, "Input/output error"), 4, "error: Input/output error; finished"),
        (ConnectionError("the scheduler is gone"), 4, "error: the scheduler is gone"),
        # output that is still read
        (BrokenPipeError(errno.EPIPE, "Broken pipe"), 4, "error: Broken pipe"),
        (FileNotFoundError(errno.ENOENT, "No such file", "a.toml"), 2, "error: a.toml: No such file"),
        (PermissionError(errno.EACCES, "Permission denied", "x"), 2, "error: x: Permission denied"),
        (ValueError("radius must be\n\x1b[2Jpositive"), 2, r"error: radius must be\n\x1b[2Jpositive"),
        (ZeroDivisionError("division by zero"), 70, "error: a fault of this program, ZeroDivisionError"),
    ],
)
def test_every_end_has_its_status_and_its_sentence(error, status, said, tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(CASES, "hertz", raising(error))
    assert report(tmp_path) == status
    told = capsys.readouterr().err
    assert told.splitlines()[-1].startswith(said)
    assert ("Traceback" in told) == (status == command.Exit.FAULT)


@pytest.mark.parametrize(
    ("words", "called", "kept"),
    [
        ("judge mine.py --out out", "judging.commands.judge.visited", False),
        ("sound rail --out out", "railway.commands.sound.run", False),
        ("compare sphere", "advice.commands.compare.findings", False),
        ("compare sphere rough_punch", "advice.commands.compare.compare_scenes", True),
        ("calibrate --show", "advice.commands.calibrate.calibration_lines", False),
        ("calibrate --references made", "judging.kinds.from_report.references_of", True),
        ("benchmark --out out", "report.commands.run_cases.build", True),
    ],
)
def test_what_is_kept_is_said_by_commands_that_keep_it(words, called, kept, tmp_path, monkeypatch, capsys):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.py").touch()
    monkeypatch.setattr(f"validation.{called}", interrupted)
    assert command.main(words.split()) == command.Exit.INTERRUPTED
    note = "; finished solves are kept, the same command goes on from there" if kept else ""
    assert capsys.readouterr().err.splitlines()[-1] == f"interrupted{note}"


def test_the_table_of_statuses_is_complete(capsys):
    """In --help and in the README of the reports."""
    with pytest.raises(SystemExit):
        command.main(["--help"])
    printed = " ".join(capsys.readouterr().out.split())
    table = printed[printed.index("Exit status: 0") :]
    rows = (ROOT / "reports" / "README.md").read_text(encoding="utf-8")
    for status in command.Exit:
        assert re.search(rf"[:;] {int(status)} \w", table), status
        assert re.search(rf"^\| {int(status)} \| \w", rows, re.MULTILINE), status


@pytest.mark.slow
def test_nobody_reads_what_is_printed():
    """As after `| head`: it ends without a word, as other commands do."""
    words = [sys.executable, "-m", "validation", "scene", "rail"]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(words, cwd=ROOT, env=ENVIRONMENT, encoding="utf-8", **pipes) as run:
        run.stdout.close()
        told = run.stderr.read()
    assert run.returncode == command.Exit.UNFINISHED
    assert told == ""


@pytest.mark.slow
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no full device")
def test_what_is_printed_goes_to_a_full_disk():
    words = [sys.executable, "-m", "validation", "scene", "rail"]
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        run = subprocess.run(words, cwd=ROOT, env=ENVIRONMENT, stdout=full, stderr=subprocess.PIPE, encoding="utf-8")
    assert run.returncode == command.Exit.UNFINISHED
    assert run.stderr == "error: No space left on device\n"
