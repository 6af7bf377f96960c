"""The line of a long run: its counts, the time left by seconds that are planted, when it is printed."""

import io
import sys

import pytest

from tests.engine.toys import wait_until
from validation.engine import progress
from validation.engine.progress import Part, Progress


def test_the_line_names_the_part_its_solves_and_the_time_left_for_all():
    run = Progress({"hertz": 10.0, "fractal_punch": 90.0, "wheel": 100.0}, shown=False)
    hertz, punch = run.parts["hertz"], run.parts["fractal_punch"]
    assert run.line == "[1/3] hertz, whole report about 3 min left"
    hertz.over = True
    punch.begin("press surface", total=420, stored=2, failed=1)
    for _ in range(40):
        punch.step()
    assert run.line.startswith("[2/3] fractal_punch: press surface 42/420, 2 from an earlier run, 1 failed, whole rep")
    # what is at work ahead of its turn does not show yet
    run.parts["wheel"].begin("roll", total=3)
    assert "press surface" in run.line


@pytest.mark.parametrize("pace", [0.5, 1.0, 4.0])
def test_the_time_left_follows_the_pace_of_this_machine(pace):
    """And not what was stored; what is expected counts as ten seconds of work."""
    run = Progress({"stored": 700.0, "first": 1000.0, "second": 500.0}, workers=2, shown=False)
    stored, first = run.parts["stored"], run.parts["first"]
    stored.begin("solve", total=100, stored=100)
    stored.over = True
    # before anything is done: as expected of two workers
    assert run.seconds_left == pytest.approx(1500 / 2)
    first.begin("solve", total=100, stored=50)
    for _ in range(5):
        first.step(seconds=10 * pace)
    # 1000 s less 90 % of 55 hundredths, of which this run has done 5
    assert run.seconds_left == pytest.approx((1500 - 495) / 2 * (50 * pace + 10) / (45 + 10))
    for part in (first, run.parts["second"]):
        part.over = True
    assert run.seconds_left == 0


def test_a_part_with_solves_to_come_is_not_over():
    """Its first kind of solves is done, the second not begun: the share grows, and ends with the part."""
    part = Part()
    for _ in range(3):
        part.begin("press", total=1)
        part.step(failed=True)
    assert part.share == progress.BEFORE_EVIDENCE
    part.begin("draw", total=1)
    assert part.share == pytest.approx(0.75 * progress.BEFORE_EVIDENCE)
    part.over = True
    assert part.share == part.share_of_this_run == 1.0
    assert part.lost == {"press": 3}


def printed(monkeypatch, *, terminal):
    """What a run prints while its part stands still, with a section in the middle."""
    stream = io.StringIO()
    stream.isatty = lambda: terminal
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "SECONDS_BETWEEN_REFRESHES" if terminal else "SECONDS_BETWEEN_LINES", 0.01)
    with Progress({"hertz": 1.0}) as run:
        for lines in (2, 4):
            wait_until(lambda lines=lines: stream.getvalue().count("hertz") >= lines)
            with run.aside():
                stream.write("a section\n")
    return stream.getvalue()


def test_a_log_has_a_line_every_few_seconds_though_the_run_stands_still(monkeypatch):
    lines = printed(monkeypatch, terminal=False).splitlines()
    assert set(lines) == {"a section", "hertz, a few seconds left"} and lines.count("a section") == 2


def test_a_terminal_has_one_line_that_is_rewritten_and_gone_at_the_end(monkeypatch):
    monkeypatch.setenv("COLUMNS", "20")
    text = printed(monkeypatch, terminal=True)
    assert text.count("\n") == 2 and text.count("\r\x1b[Ka section\n") == 2
    assert set(text.replace("a section\n", "").split("\r")) == {"", "hertz, a few second\x1b[K", "\x1b[K"}
    assert text.endswith("\r\x1b[K")
