"""What is timed alone: `precision`, the error against the cost of every method, and `race`, the solver comparison."""

import argparse
from pathlib import Path

from validation.engine.engine import LOCAL
from validation.report.commands.arguments import add_options, add_profile, at_least
from validation.report.commands.exit_status import Exit
from validation.report.commands.report import built


def describe(timing: argparse.ArgumentParser) -> None:
    name = timing.prog.split()[-1]
    add_profile(timing)
    add_options(
        timing,
        ("--out", "DIR", Path, f"folder (default: reports/{name}-quick or reports/{name})"),
        ("--seed", "S", at_least(0), "seed of the rough surfaces"),
    )
    timing.set_defaults(command=clock, timed=name, workers=1, executor=LOCAL, scene=None, keep=False)


def clock(arguments: argparse.Namespace) -> Exit:
    """Run what is timed alone, and write the page of it."""
    name = arguments.timed
    out = arguments.out or Path("reports") / (name if arguments.profile == "full" else f"{name}-quick")
    return built([name], out, arguments)
