"""The line of a long run, by clocks that are planted: its counts, the time left, when it is printed."""

import io
import sys

import pytest

from validation.engine import progress
from validation.engine.progress import Progress


@pytest.fixture
def clock():
    """Tells the time that a test has planted in `now`."""

    def told():
        return told.now

    told.now = 0.0
    return told


def test_the_line_names_the_part_its_solves_and_the_time_left_for_all(clock):
    run = Progress({"hertz": 10.0, "fractal_punch": 90.0, "wheel": 100.0}, shown=False, clock=clock)
    hertz, punch = run.parts["hertz"], run.parts["fractal_punch"]
    assert run.line == "[1/3] hertz, whole report about 3 min left"
    hertz.finish()
    punch.begin("press surface", total=420)
    for _ in range(42):
        punch.step()
    assert run.line.startswith("[2/3] fractal_punch: press surface 42/420, whole report about")
    # what is at work ahead of its turn does not show yet
    run.parts["wheel"].begin("roll", total=3)
    assert "press surface" in run.line


def done_at_pace(clock, pace, run, part):
    """All of a part of 100 solves, each of which takes `pace` times what is expected."""
    part.begin("solve", total=100)
    for _ in range(100):
        clock.now += pace * part.seconds / 100
        part.step()
    part.finish()


@pytest.mark.parametrize("pace", [0.5, 1.0, 4.0])
def test_the_time_left_follows_the_pace_of_this_machine(pace, clock):
    run = Progress({"first": 1000.0, "second": 500.0}, workers=2, shown=False, clock=clock)
    # before anything is done: as expected of two workers
    assert run.seconds_left == pytest.approx(1500 / 2)
    done_at_pace(clock, pace, run, run.parts["first"])
    # what is expected counts as ten seconds of the thousand
    assert run.seconds_left == pytest.approx(500 * (1000 * pace + 5) / 1010)


def test_time_in_which_stored_solves_are_loaded_tells_nothing_of_the_pace(clock):
    run = Progress({"first": 1000.0, "second": 1000.0}, shown=False, clock=clock)
    clock.now = 300.0
    run.parts["first"].begin("solve", total=100, found=100)
    run.parts["first"].finish()
    assert run.seconds_left == pytest.approx(1000)
    clock.now = 600.0
    done_at_pace(clock, 1.0, run, run.parts["second"])
    assert clock.now == 1600.0
    assert run.seconds_left == 0


def test_what_is_left_of_a_part_that_was_half_stored_goes_at_its_own_pace(clock):
    """The first solves after those that were stored count at once."""
    run = Progress({"only": 1000.0}, shown=False, clock=clock)
    run.parts["only"].begin("solve", total=100, found=50)
    for _ in range(5):
        clock.now += 10.0
        run.parts["only"].step()
    # 1000 s less 90 % of 55 hundredths; 50 s were taken for 45 of them, with 10 s as expected
    assert run.seconds_left == pytest.approx((1000 - 495) * (50 + 10) / (45 + 10))


def test_a_part_with_solves_to_come_is_not_over():
    """Its first kind of solves is done, the second not begun: the share grows, and ends with the part."""
    part = Progress({"hertz": 1.0}, shown=False).parts["hertz"]
    part.begin("press", total=3)
    for _ in range(3):
        part.step()
    assert part.share == progress.BEFORE_EVIDENCE
    part.begin("draw", total=1)
    assert part.share == pytest.approx(0.75 * progress.BEFORE_EVIDENCE)
    part.finish()
    assert part.share == 1.0


def printed(monkeypatch, clock, *, terminal):
    """What 100 solves of a third of a second print, and a section in the middle of them."""
    stream = io.StringIO()
    stream.isatty = lambda: terminal
    monkeypatch.setattr(sys, "stderr", stream)
    # no thread of its own: all that is printed is due to the planted clock
    monkeypatch.setattr(progress.Progress, "_tick", lambda self: None)
    with Progress({"hertz": 50.0}, clock=clock) as run:
        part = run.parts["hertz"]
        part.begin("press", total=100)
        for i in range(100):
            clock.now += 0.33
            part.step()
            if i == 49:
                with run.aside():
                    stream.write("a section\n")
    return stream.getvalue()


def test_a_log_has_a_line_every_few_seconds(monkeypatch, clock):
    lines = printed(monkeypatch, clock, terminal=False).splitlines()
    lines.remove("a section")
    assert len(lines) == 33 // progress.SECONDS_BETWEEN_LINES
    assert lines[0].startswith("hertz: press 31/100, about")


def test_a_terminal_has_one_line_that_is_rewritten_and_gone_at_the_end(monkeypatch, clock):
    monkeypatch.setenv("COLUMNS", "30")
    text = printed(monkeypatch, clock, terminal=True)
    assert text.count("\n") == 1 and "\r\x1b[Ka section\n" in text
    states = [state.removesuffix("\x1b[K") for state in text.replace("a section\n", "").split("\r")]
    assert len(states) > 50 and max(map(len, states)) < 30
    assert text.endswith("\r\x1b[K")


def test_a_run_that_stands_still_is_seen(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "SECONDS_BETWEEN_LINES", 0.0)
    monkeypatch.setattr(progress, "SECONDS_BETWEEN_REFRESHES", 0.01)
    with Progress({"hertz": 1.0}) as run:
        while stream.getvalue().count("\n") < 2:
            run._over.wait(0.01)
    assert stream.getvalue().startswith("hertz, a few seconds left")
