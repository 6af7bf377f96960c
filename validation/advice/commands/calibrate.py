"""Show the errors that cheap models claim, as they were measured, and what other houses measure on the same scenes."""

import argparse
from pathlib import Path

from validation.advice.calibrate import calibration_lines, table_in
from validation.engine.street import objects_of_houses
from validation.report.commands.arguments import Exit, add_options, add_workers, check_places, not_beside

MOVED = ("--answers", "--check", "--install", "--punches", "--rolling", "--seed", "--spheres", "--wheels")
"""Options of an earlier release, which the script has."""
SCRIPT = ".ci/calibrate.py of a checkout, which measures the table of the package"


def describe(calibrating: argparse.ArgumentParser) -> None:
    add_workers(calibrating)
    out = "folder of the table, or of what is made (default of --show: the table of the package)"
    add_options(calibrating, ("--out", "DIR", Path, out))
    alone = calibrating.add_mutually_exclusive_group()
    alone.add_argument("--show", action="store_true", help="show what the table holds")
    for house in objects_of_houses("calibrations"):
        house.add(alone)
    for name in MOVED:
        calibrating.add_argument(name, nargs="?", help=argparse.SUPPRESS)
    calibrating.set_defaults(command=calibrate)


def calibrate(arguments: argparse.Namespace) -> Exit:
    """Show the errors that were measured, or have another house measure."""
    if moved := [name for name in MOVED if name in getattr(arguments, "given", ())]:
        raise ValueError(f"{' and '.join(moved)} must be given to {SCRIPT}")
    arguments.keeps = not arguments.show
    if arguments.show:
        not_beside(arguments, "beside --show", "--workers")
        print("\n".join(calibration_lines(table_in(arguments.out))))
        return Exit.MET
    check_places(arguments, {})
    for house in objects_of_houses("calibrations"):
        if (done := house.command(arguments)) is not None:
            status: Exit = done
            return status
    raise ValueError(f"calibrate must have an option, as --show; without one it is {SCRIPT}")
