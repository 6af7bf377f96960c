"""The progress of a long run in one line: which part is at work, how far it is, the time left for the whole."""

import math
import shutil
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

SECONDS_BETWEEN_LINES = 10.0
"""Seconds between two lines in a log."""
SECONDS_BETWEEN_REFRESHES = 0.2
"""Seconds between two states of the line on a terminal."""
BEFORE_EVIDENCE = 0.9
"""Share of a part that its solves can reach: it may have others, and is evaluated."""
TRUSTED = 10.0
"""Expected seconds of work after which the pace of this machine counts as much as the expected one."""
UNKNOWN = 600.0
"""Seconds of work that a part is taken for whose duration nobody knows."""
BACK, ERASED = "\r", "\x1b[K"


class Part:
    """A part of a run: counts of its solves, those of each kind that did not converge, and their seconds of work.

    all_done, all_total, all_found: of all kinds until now; done, total, found, failed: of the one that is at work.
    """

    def __init__(self, name: str = "", seconds: float = 0.0, refresh: Callable[[], None] = lambda: None):
        self.name, self.seconds = name, seconds
        self.worked = 0.0
        self.over = self.solving = False
        self.doing = ""
        self.done = self.total = self.found = self.failed = 0
        self.all_done = self.all_total = self.all_found = 0
        self.lost: Counter[str] = Counter()
        self._refresh = refresh

    def begin(self, doing: str, *, total: int, found: int = 0, failed: int = 0) -> None:
        """Solves that follow. found: in the store; failed: of those."""
        self.doing, self.done, self.total, self.found, self.failed = doing, found, total, found, failed
        self.all_done += found
        self.all_total += total
        self.all_found += found
        self.lost[doing] += failed
        self.solving |= total > found
        self._refresh()

    def extend(self, doing: str, more: int) -> None:
        """More of the same."""
        self.doing = doing
        self.total += more
        self.all_total += more

    def step(self, failed: bool = False, seconds: float = 0.0) -> None:
        """One solve more. seconds: that it took."""
        self.done += 1
        self.all_done += 1
        self.failed += failed
        self.lost[self.doing] += failed
        self.worked += seconds
        self._refresh()

    def finish(self) -> None:
        self.over = True
        self._refresh()

    @property
    def share(self) -> float:
        """Of the part that is done."""
        return 1.0 if self.over else BEFORE_EVIDENCE * self.all_done / max(self.all_total, 1)

    @property
    def share_of_this_run(self) -> float:
        """Of the part that is done and was not found in the store."""
        return self.share - (1.0 if self.over else BEFORE_EVIDENCE) * self.all_found / max(self.all_total, 1)

    @property
    def line(self) -> str:
        if not self.doing:
            return self.name
        found = f", {self.found} from an earlier run" if self.found else ""
        failed = f", {self.failed} failed" if self.failed else ""
        return f"{self.name}: {self.doing} {self.done}/{self.total}{found}{failed}"


class Progress:
    """Parts of a run in their order: one line that is rewritten on a terminal, a line every few seconds in a log.

    parts: name of each and the seconds that it is expected to take on one core; workers: that
    share the work; shown: False prints nothing. Lines are also printed while no solve finishes, so that a log shows a
    run that stands still.
    """

    def __init__(
        self,
        parts: Mapping[str, float],
        *,
        workers: int = 1,
        shown: bool = True,
        clock: Callable[[], float] = time.monotonic,
    ):
        self.parts = {name: Part(name, seconds, self.refresh) for name, seconds in parts.items()}
        self._workers, self._now = workers, clock
        self._shown, self._terminal = shown, sys.stderr.isatty()
        self._began, self._printed = math.inf, clock()
        self._lock = threading.RLock()
        self._over = threading.Event()
        self._ticks = threading.Thread(target=self._tick, daemon=True)

    def __enter__(self) -> "Progress":
        if self._shown:
            self._ticks.start()
        return self

    def __exit__(self, *raised: object) -> None:
        if self._shown:
            self._over.set()
            self._ticks.join()
            self._write("")

    def refresh(self) -> None:
        """Print the line, if the last one is old enough."""
        if math.isinf(self._began) and any(part.solving for part in self.parts.values()):
            self._began = self._now()
        apart = SECONDS_BETWEEN_REFRESHES if self._terminal else SECONDS_BETWEEN_LINES
        with self._lock:
            if not self._shown or self._over.is_set() or self._now() - self._printed < apart:
                return
            self._printed = self._now()
            self._write(self.line)

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Something else is printed meanwhile."""
        with self._lock:
            if self._shown:
                self._write("")
            yield

    @property
    def line(self) -> str:
        """Of the first part that is not over."""
        parts = list(self.parts.values())
        i = next((i for i, part in enumerate(parts) if not part.over), len(parts) - 1)
        place, whole = (f"[{i + 1}/{len(parts)}] ", "whole report ") if len(parts) > 1 else ("", "")
        return f"{place}{parts[i].line}, {whole}{format_left(self.seconds_left)} left"

    @property
    def seconds_left(self) -> float:
        """By the pace of what was done in this run, and the expected one as long as that is little.

        Time counts from the first solve that is not stored: to load what is stored tells nothing of the pace.
        """
        parts = self.parts.values()
        worked = sum(part.seconds * part.share_of_this_run for part in parts)
        expected = TRUSTED / self._workers
        pace = (max(self._now() - self._began, 0.0) + expected) / (worked + TRUSTED)
        return pace * sum(part.seconds * (1 - part.share) for part in parts)

    def _tick(self) -> None:
        while not self._over.wait(SECONDS_BETWEEN_REFRESHES):
            self.refresh()

    def _write(self, line: str) -> None:
        """On a terminal over the last one, in a log below it; an empty one erases the last."""
        if self._terminal:
            sys.stderr.write(BACK + line[: shutil.get_terminal_size().columns - 1] + ERASED)
        elif line:
            sys.stderr.write(line + "\n")
        sys.stderr.flush()


@contextmanager
def progress_of(name: str, workers: int) -> Iterator[Part]:
    """Of a run that is a single part, of which nobody knows how long it takes."""
    with Progress({name: UNKNOWN}, workers=workers) as progress:
        yield progress.parts[name]


def format_left(seconds: float) -> str:
    """As exact as it can be known."""
    if seconds < 10:
        return "a few seconds"
    if seconds < 90:
        return f"about {10 * round(seconds / 10)} s"
    minutes = round(seconds / 60)
    return f"about {minutes} min" if minutes < 90 else f"about {seconds / 3600:.1f} h"
