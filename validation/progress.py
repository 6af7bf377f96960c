"""How far a long run is: a bar on a terminal, plain lines in a log."""

import sys
import time
from types import TracebackType

from tqdm import tqdm

EVERY = 10.0
"""Seconds between two lines in a log."""


class Progress:
    """Counts what is done, stored and failed, with the rate and the time left.

    name: of the work; total: solves; stored: of these were found finished; failed: of those stored have failed;
    shown: False says nothing.
    """

    def __init__(self, name: str, *, total: int, stored: int, failed: int, shown: bool):
        self.name, self.total, self.stored, self.failed = name, total, stored, failed
        self.done = stored
        self._began = self._told = time.monotonic()
        self._lines = shown and not sys.stderr.isatty()
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
        return self

    def step(self, failed: bool) -> None:
        """One more is done."""
        self.done += 1
        self.failed += failed
        self._bar.set_postfix_str(self._counts, refresh=False)
        self._bar.update()
        if self._lines and time.monotonic() - self._told >= EVERY:
            self._tell()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.close()
        if self._lines:
            self._tell()

    @property
    def line(self) -> str:
        """As it stands in a log."""
        seconds = time.monotonic() - self._began
        rate = (self.done - self.stored) / seconds if seconds > 0 else 0.0
        left = f"{(self.total - self.done) / rate:.0f} s left" if rate > 0 else "time left unknown"
        return f"{self.name}: {self.done} of {self.total} done, {self._counts}; {rate:.3g} a second, {left}"

    @property
    def _counts(self) -> str:
        return f"{self.stored} were stored, {self.failed} failed"

    def _tell(self) -> None:
        self._told = time.monotonic()
        sys.stderr.write(self.line + "\n")
        sys.stderr.flush()
