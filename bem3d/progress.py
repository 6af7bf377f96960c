"""How far a path of loads or a track has come: told to a function, or shown on the standard error stream."""

import sys
from collections.abc import Callable
from itertools import count

Progress = bool | Callable[[int, int], object]
"""True: a line on stderr; a function of (done, total); False: neither."""


def steps(progress: Progress, total: int) -> Callable[[], object]:
    """What to call after each of so many steps."""
    if not callable(progress) and progress is not True and progress is not False:
        raise TypeError(f"progress must be True, False or a function of (done, total), got {progress!r}")
    if progress is False:
        return lambda: None
    done, tell = count(1), _show if progress is True else progress
    return lambda: tell(next(done), total)


def _show(done: int, total: int) -> None:
    """In the line that is there; the last one ends it."""
    if sys.stderr is not None:
        sys.stderr.write(f"\r{done} of {total}" + "\n" * (done == total))
        sys.stderr.flush()
