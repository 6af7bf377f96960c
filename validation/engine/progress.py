"""The progress of a long run in one line: which part is at work, how far it is, the time left for the whole."""

import shutil
import sys
import threading
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass

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


@dataclass
class Solves:
    """Solves of one kind: their number, those found in the store, those done with these, those not converged."""

    doing: str
    total: int = 0
    stored: int = 0
    done: int = 0
    failed: int = 0


class Part:
    """A part of a run: its solves, kind after kind, and their seconds of work. seconds: that are expected."""

    def __init__(self, name: str = "", seconds: float = 0.0):
        self.name, self.seconds, self.worked, self.over = name, seconds, 0.0, False
        self.kinds: list[Solves] = []

    def begin(self, doing: str, *, total: int, stored: int = 0, failed: int = 0) -> None:
        """Solves that follow, more of the last kind or another. stored: in the store; failed: of those."""
        if not self.kinds or self.kinds[-1].doing != doing:
            self.kinds.append(Solves(doing))
        kind = self.kinds[-1]
        kind.total, kind.stored, kind.done = kind.total + total, kind.stored + stored, kind.done + stored
        kind.failed += failed

    def step(self, failed: bool = False, seconds: float = 0.0) -> None:
        """One solve more. seconds: that it took."""
        self.kinds[-1].done += 1
        self.kinds[-1].failed += failed
        self.worked += seconds

    @property
    def lost(self) -> Counter[str]:
        """How many did not converge, by their kind."""
        return sum((Counter({kind.doing: kind.failed}) for kind in self.kinds), Counter[str]())

    @property
    def share(self) -> float:
        """Share of the part that is done, stored solves included [-]."""
        return 1.0 if self.over else self._share(sum(kind.done for kind in self.kinds))

    @property
    def share_of_this_run(self) -> float:
        """Share of the part that this run has done itself: solves in the store do not count [-]."""
        stored = sum(kind.stored for kind in self.kinds)
        return self.share - (self._share(stored) / BEFORE_EVIDENCE if self.over else self._share(stored))

    def _share(self, solves: int) -> float:
        """Share of the part that so many of its solves are: evaluation is the rest, from `BEFORE_EVIDENCE` on [-]."""
        return BEFORE_EVIDENCE * solves / max(sum(kind.total for kind in self.kinds), 1)

    @property
    def line(self) -> str:
        if not self.kinds:
            return self.name
        kind = self.kinds[-1]
        stored = f", {kind.stored} from an earlier run" if kind.stored else ""
        failed = f", {kind.failed} failed" if kind.failed else ""
        return f"{self.name}: {kind.doing} {kind.done}/{kind.total}{stored}{failed}"


class Progress:
    """Parts of a run in their order: one line that is rewritten on a terminal, a line every few seconds in a log.

    parts: name of each and the seconds that it is expected to take on one core; workers: that share the work; shown:
    False prints nothing. A thread prints the lines, also while no solve finishes: a log shows a run that stands still.
    """

    def __init__(self, parts: Mapping[str, float], *, workers: int = 1, shown: bool = True):
        self.parts = {name: Part(name, seconds) for name, seconds in parts.items()}
        self._workers, self._shown, self._terminal = workers, shown, sys.stderr.isatty()
        self._lock, self._over = threading.Lock(), threading.Event()
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

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Erase the line, and print none while the block writes to the terminal."""
        with self._lock:
            if self._shown:
                self._write("")
            yield

    @property
    def line(self) -> str:
        """State of the first part that is not over, and the time left for all parts."""
        parts = list(self.parts.values())
        i = next((i for i, part in enumerate(parts) if not part.over), len(parts) - 1)
        place, scope = (f"[{i + 1}/{len(parts)}] ", "whole report ") if len(parts) > 1 else ("", "")
        return f"{place}{parts[i].line}, {scope}{format_left(self.seconds_left)} left"

    @property
    def seconds_left(self) -> float:
        """Expected seconds of what is left, times the pace of this run, which counts more the more it has solved."""
        parts = self.parts.values()
        expected = sum(part.seconds * part.share_of_this_run for part in parts if part.worked)
        pace = (sum(part.worked for part in parts) + TRUSTED) / (expected + TRUSTED)
        return pace * sum(part.seconds * (1 - part.share) for part in parts) / self._workers

    def _tick(self) -> None:
        while not self._over.wait(SECONDS_BETWEEN_REFRESHES if self._terminal else SECONDS_BETWEEN_LINES):
            with self._lock:
                self._write(self.line)

    def _write(self, line: str) -> None:
        """Write a line over the last one on a terminal, below it in a log; an empty line erases the last."""
        if self._terminal:
            sys.stderr.write(f"\r{line[: shutil.get_terminal_size().columns - 1]}\x1b[K")
        elif line:
            sys.stderr.write(line + "\n")
        sys.stderr.flush()


@contextmanager
def progress_of(name: str, workers: int) -> Iterator[Part]:
    """Progress of a run that is a single part of unknown duration."""
    with Progress({name: UNKNOWN}, workers=workers) as progress:
        yield progress.parts[name]


def format_left(seconds: float) -> str:
    """Time left in words, no more exact than such an estimate can be."""
    if seconds < 10:
        return "a few seconds"
    if seconds < 90:
        return f"about {10 * round(seconds / 10)} s"
    minutes = round(seconds / 60)
    return f"about {minutes} min" if minutes < 90 else f"about {seconds / 3600:.1f} h"
