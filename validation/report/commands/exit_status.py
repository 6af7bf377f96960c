"""How a command ended."""

from enum import IntEnum


class Exit(IntEnum):
    """Exit status of the command."""

    MET = 0
    CRITERION_FAILED = 1
    BAD_INPUT = 2
    NOT_CONVERGED = 3
    UNFINISHED = 4
    FAULT = 70
    INTERRUPTED = 130
    TERMINATED = 143
