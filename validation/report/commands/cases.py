"""List the cases, from their sources: no case is imported."""

import argparse

from validation.report.commands.exit_status import Exit
from validation.report.listing import answers_of_cases


def describe(listing: argparse.ArgumentParser) -> None:
    listing.set_defaults(command=cases)


def cases(arguments: argparse.Namespace) -> Exit:
    for name, answers in answers_of_cases().items():
        print(f"{name:20s} {answers}")
    return Exit.MET
