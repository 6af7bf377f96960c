"""Measure the errors that cheap models claim, beside boundary elements."""

import argparse
from collections.abc import Mapping
from pathlib import Path

from validation.advice.calibrate import (
    calibration_lines,
    check_calibration,
    check_installable,
    install,
    measured_alone,
    measured_answers,
    measured_table,
    table_in,
)
from validation.advice.calibration_scenes import ANSWERS, Answers, CalibrationRun, Group, merged
from validation.engine.engine import Engine
from validation.engine.files import write_whole
from validation.engine.progress import progress_of
from validation.engine.street import objects_of_houses
from validation.report.commands.arguments import Exit, add_options, add_workers, at_least, check_places, not_beside
from validation.report.folder import CALIBRATION, REALISATIONS, Folder
from validation.scenes.printable import printable

OUT = Path("calibration")
"""Where a table is measured, below the working folder."""
PLACES = f"default: {OUT}; of --show and --check: the table of the package"
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
    add_workers(calibrating)
    out = f"folder of the table and of finished solves, from which a run goes on ({PLACES})"
    add_options(calibrating, ("--seed", "S", at_least(0), "seed of the scenes"), ("--out", "DIR", Path, out))
    calibrating.add_argument(
        "--install",
        action="store_true",
        help="put the table in the place of that of the package, if it has as many scenes of all kinds; with --check, "
        "give the rows of that the version of today's code where all are the same",
    )
    alone = calibrating.add_mutually_exclusive_group()
    alone.add_argument("--show", action="store_true", help="show what the table holds, and measure nothing")
    alone.add_argument(
        "--answers",
        action="store_true",
        help="make the answers of boundary elements alone, which models of somebody's own are measured beside; those "
        "of kinds of which no scene is asked stay",
    )
    alone.add_argument(
        "--model",
        metavar="FILE|NAME",
        help="measure this model alone, beside stored answers of boundary elements: of the package, by its name, whose "
        f"rows alone change in the table{''.join(house.file for house in objects_of_houses('calibrations'))}",
    )
    alone.add_argument(
        "--check", type=at_least(1), metavar="N", help="measure N scenes of each kind again, and report which differ"
    )
    for house in objects_of_houses("calibrations"):
        house.add(alone)
    calibrating.set_defaults(command=calibrate, seed=run.seed)


def calibrate(arguments: argparse.Namespace) -> Exit:
    """Measure the errors of cheap models beside boundary elements, or check or show those that were measured."""
    arguments.keeps = not (arguments.show or arguments.check)
    if arguments.keeps:
        check_places(arguments, {})
    counts = [f"--{name}" for name in COUNTED]
    if arguments.show:
        not_beside(arguments, "beside --show", "--workers", "--seed", *counts)
    for name in ("check", "model", "references"):
        if getattr(arguments, name, None):
            not_beside(arguments, f"beside --{name}", "--seed", *counts)
    for house in objects_of_houses("calibrations"):
        if (done := house.command(arguments)) is not None:
            status: Exit = done
            return status
    if arguments.install and (arguments.show or (arguments.check and arguments.out is not None)):
        raise ValueError("--install is for a table that is measured, or for --check of that of the package")
    if arguments.check:
        return _check(arguments)
    if arguments.show:
        print("\n".join(calibration_lines(table_in(arguments.out))))
        return Exit.MET
    return _measure(arguments)


def _check(arguments: argparse.Namespace) -> Exit:
    table, engine = table_in(arguments.out), Engine(workers=arguments.workers)
    differing, solves = check_calibration(arguments.check, engine, table, stamp=arguments.install)
    if differing:
        print("\n".join(differing))
        return Exit.CRITERION_FAILED
    print("\n".join(calibration_lines(table)))
    rows = "their rows have today's code" if arguments.install else "nothing was written"
    print(f"measured again: {solves}, all the same; {rows}")
    return Exit.MET


def _measure(arguments: argparse.Namespace) -> Exit:
    """Table and answers, or one of them, in a folder of the user's own, and in the package if asked for."""
    run = CalibrationRun(seed=arguments.seed, **{name: getattr(arguments, name) for name in COUNTED})
    if arguments.install and not (arguments.answers or arguments.model):
        check_installable(run)
    arguments.out = arguments.out or OUT
    table, answers = places = table_in(arguments.out), arguments.out / ANSWERS.name
    with (
        Folder(arguments.out, kind=CALIBRATION) as folder,
        progress_of("calibration", arguments.workers) as progress,
    ):
        engine = Engine(workers=arguments.workers, store=arguments.out / REALISATIONS, progress=progress)
        files = {place.name: place.read_bytes() for place in places if place.exists()}
        made: Mapping[Group, Answers] = {}
        if arguments.model:
            files[table.name] = measured_alone(arguments.model, engine, table if table.exists() else table_in(None))
        elif arguments.answers:
            made = measured_answers(run, engine)
        else:
            files[table.name], made = measured_table(run, engine)
        if made:
            files[answers.name] = merged(answers, made)
        folder.replace(files)
    if arguments.install and not arguments.answers:
        install(table)
    if arguments.install and made:
        write_whole(ANSWERS, merged(ANSWERS, made))
    print("\n".join(_report_lines(table, made, arguments)))
    return Exit.MET


def _report_lines(table: Path, made: Mapping[Group, Answers], arguments: argparse.Namespace) -> list[str]:
    """What was measured, where it is, and whether `compare` goes by it."""
    if arguments.answers:
        lines = [
            f"{' '.join(group)}: {answers.number.size} answers, {answers.each.size} numbers of realisations"
            for group, answers in made.items()
        ]
        return [*lines, printable(f"answers: {ANSWERS if arguments.install else arguments.out / ANSWERS.name}")]
    used = "goes on with that of the package: the same command with --install"
    where = f"{table}, installed: `compare` claims errors by it" if arguments.install else f"{table}; `compare` {used}"
    return [*calibration_lines(table), printable(f"table: {where}")]
