"""The progress of a long run: a bar on a terminal, plain lines in a log."""

import sys
import threading
import time
from types import TracebackType

from tqdm import tqdm

SECONDS_BETWEEN_LINES = 10.0
"""Seconds between two lines in a log."""


class Progress:
    """Counts of done, stored and failed solves, with the rate and the time left.

    name: of the work; total: solves; stored: solves whose results were found; failed: of those; shown: False prints
    nothing. Lines are also printed while no solve finishes, so that a log shows a run that stands still.
    """

    def __init__(self, name: str, *, total: int, stored: int, failed: int, shown: bool):
        self.name, self.total, self.stored, self.failed = name, total, stored, failed
        self.done = stored
        self._began = time.monotonic()
        self._lines = shown and not sys.stderr.isatty()
        self._over = threading.Event()
        self._clock = threading.Thread(target=self._tick, daemon=True)
        self._bar = tqdm(
            total=total,
            initial=stored,
            desc=name,
            disable=not shown or self._lines,
            bar_format="{desc}: {n_fmt} of {total_fmt} done{postfix}; {rate_fmt}, {remaining} left |{bar}|",
            unit=" solves",
        )
        self._bar.set_postfix_str(self._counts, refresh=False)

    def __enter__(self) -> "Progress":
        self._clock.start()
        return self

    def step(self, failed: bool) -> None:
        self.done += 1
        self.failed += failed
        self._bar.set_postfix_str(self._counts, refresh=False)
        self._bar.update()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        self._clock.join()
        self._bar.close()
        self._print_line()

    @property
    def line(self) -> str:
        seconds = time.monotonic() - self._began
        rate = (self.done - self.stored) / seconds if seconds > 0 else 0.0
        counts = f"{self.name}: {self.done} of {self.total} done, {self._counts}"
        if self.done == self.total:
            return f"{counts}; {rate:.3g} a second"
        return f"{counts}; {rate:.3g} a second, " + (
            f"{(self.total - self.done) / rate:.0f} s left" if rate > 0 else "time left unknown"
        )

    @property
    def _counts(self) -> str:
        return f"{self.stored} were stored, {self.failed} failed"

    def _tick(self) -> None:
        while not self._over.wait(SECONDS_BETWEEN_LINES):
            self._bar.refresh()
            self._print_line()

    def _print_line(self) -> None:
        if self._lines:
            sys.stderr.write(self.line + "\n")
            sys.stderr.flush()
