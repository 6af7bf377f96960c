"""Measure the errors that cheap models claim, beside boundary elements."""

import argparse
import os
from pathlib import Path

from validation.engine.engine import Engine
from validation.engine.progress import progress_of
from validation.report.commands.arguments import at_least
from validation.report.commands.exit_status import Exit
from validation.selection.calibrate import CalibrationRun, calibration_lines, write_calibration
from validation.selection.calibration_check import check_calibration

COUNTED = {
    "punches": "rough punches",
    "spheres": "rough spheres",
    "rolling": "rolling wheels",
    "wheels": "dynamic wheels",
}


def describe(calibrating: argparse.ArgumentParser) -> None:
    run = CalibrationRun()
    for name, what in COUNTED.items():
        default = getattr(run, name)
        calibrating.add_argument(
            f"--{name}", type=at_least(0), default=default, metavar="N", help=f"{what} (default: {default})"
        )
    calibrating.add_argument("--seed", type=at_least(0), default=run.seed, metavar="S", help="seed of the scenes")
    calibrating.add_argument("--workers", type=at_least(1), default=os.cpu_count() or 1, metavar="N", help="processes")
    calibrating.add_argument(
        "--store",
        type=Path,
        default=Path(".mdr-validation-calibration"),
        metavar="DIR",
        help="folder of finished solves",
    )
    calibrating.add_argument("--out", type=Path, metavar="FILE", help="the table (default: that of the package)")
    calibrating.add_argument("--show", action="store_true", help="show what the table holds, and measure nothing")
    calibrating.add_argument(
        "--check",
        type=at_least(1),
        metavar="N",
        help="measure N scenes of each kind again; rows take the version of today's code where all are the same",
    )
    calibrating.set_defaults(command=calibrate)


def calibrate(arguments: argparse.Namespace) -> Exit:
    """Measure the errors of cheap models beside boundary elements, or check or show those that were measured."""
    if arguments.check:
        differing = check_calibration(arguments.check, Engine(workers=arguments.workers), arguments.out)
        print("\n".join(differing or calibration_lines(arguments.out)))
        return Exit.CRITERION_FAILED if differing else Exit.MET
    if not arguments.show:
        run = CalibrationRun(seed=arguments.seed, **{name: getattr(arguments, name) for name in COUNTED})
        with progress_of("calibration", arguments.workers) as progress:
            engine = Engine(workers=arguments.workers, store=arguments.store, progress=progress)
            write_calibration(run, engine, arguments.out)
    print("\n".join(calibration_lines(arguments.out)))
    return Exit.MET
