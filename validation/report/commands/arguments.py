"""Arguments that several commands have."""

import argparse
from collections.abc import Callable


def add_profile(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--profile", choices=("quick", "full"), default="quick", help="size of the problems (default: quick)"
    )


def at_least(least: int) -> Callable[[str], int]:
    """Whole numbers from a least one on."""

    def number(word: str) -> int:
        try:
            value = int(word)
        except ValueError:
            raise argparse.ArgumentTypeError(f"must be a whole number, got {word!r}") from None
        if value < least:
            raise argparse.ArgumentTypeError(f"must be at least {least}, got {value}")
        return value

    return number
