"""Being asked to end: an exception in place of a death without a word."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

ASKED = (signal.SIGTERM, signal.SIGHUP)


class TerminatedError(KeyboardInterrupt):
    """Somebody has asked this process to end; whatever ends workers at control-C ends them now."""


@contextmanager
def terminable() -> Iterator[None]:
    """TerminatedError is raised here at the first request to end; a second one ends the process at once.

    A request that is ignored on purpose stays so (nohup), and outside of the main thread there are none.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in ASKED}
    ours = [number for number, handler in before.items() if handler is signal.SIG_DFL]
    try:
        for number in ours:
            signal.signal(number, _asked)
        yield
    finally:
        for number in ours:
            signal.signal(number, signal.SIG_DFL)


def _asked(number: int, frame: FrameType | None) -> None:
    for other in ASKED:
        if signal.getsignal(other) is _asked:
            signal.signal(other, signal.SIG_DFL)
    raise TerminatedError(signal.Signals(number).name)
