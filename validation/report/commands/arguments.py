"""What several commands have: arguments, and how they ended."""

import argparse
import os
from collections.abc import Callable, Collection
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


LEAST_MOST, TO_A_CORE = 16, 4
"""Processes that may be asked for: so many in all, or to a core. Each takes some 200 MB, and more are not faster."""


def add_profile(command: argparse.ArgumentParser) -> None:
    sizes = ("quick", "full")
    command.add_argument("--profile", choices=sizes, default="quick", help="size of the problems (default: quick)")


def add_workers(command: argparse.ArgumentParser, what: str = "number of processes") -> None:
    help_text = f"{what} (default: one per core)"
    cores = os.cpu_count() or 1
    number = at_least(1, max(LEAST_MOST, TO_A_CORE * cores))
    command.add_argument("--workers", type=number, default=cores, metavar="N", help=help_text)


def add_options(command: argparse.ArgumentParser, *options: tuple[str, str, Callable[[str], object], str]) -> None:
    """Each with the name of its value, what reads that, and what it is for; without a default."""
    for name, value, reads, what in options:
        command.add_argument(name, metavar=value, type=reads, help=what)


def not_beside(arguments: argparse.Namespace, other: str, *options: str) -> None:
    """Raises ValueError for an option that was given beside another, or in a case, that has no use for it."""
    if idle := [name for name in options if name in getattr(arguments, "given", ())]:
        raise ValueError(f"{' and '.join(idle)} must be left out {other}, where nothing goes by it")


def at_least(least: int, most: int | None = None) -> Callable[[str], int]:
    """Whole numbers from a least one on, up to a largest one."""

    def number(word: str) -> int:
        try:
            value = int(word)
        except ValueError:
            raise argparse.ArgumentTypeError(f"must be a whole number, got {word!r}") from None
        if value < least:
            raise argparse.ArgumentTypeError(f"must be at least {least}, got {value}")
        if most is not None and value > most:
            raise argparse.ArgumentTypeError(f"must be at most {most}, got {value}")
        return value

    return number


def some_of(known: Collection[str]) -> Callable[[str], tuple[str, ...]]:
    """Names with commas between them, each once."""

    def names(word: str) -> tuple[str, ...]:
        found = tuple(dict.fromkeys(name.strip() for name in word.split(",")))
        if unknown := [name for name in found if name not in known]:
            raise argparse.ArgumentTypeError(f"must be of {', '.join(known)}, got {', '.join(map(repr, unknown))}")
        return found

    return names
