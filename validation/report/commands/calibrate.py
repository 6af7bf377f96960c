"""Measure the errors that cheap models claim, beside boundary elements."""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from validation.engine.engine import Engine
from validation.engine.files import write_whole
from validation.engine.progress import progress_of
from validation.report.commands.arguments import Exit, add_options, add_workers, at_least
from validation.report.commands.compare import STORE
from validation.report.commands.places import check_places
from validation.report.folder import CALIBRATION, REALISATIONS, REFERENCES, Folder
from validation.scenes.printable import printable
from validation.selection.calibrate import (
    calibration_lines,
    check_calibration,
    check_installable,
    errors_as_lines,
    install,
    measured_alone,
    measured_table,
    provenance_of,
    table_in,
)
from validation.selection.calibration_answers import ANSWERS, answers_in, measured_answers, merged
from validation.selection.calibration_scenes import CalibrationRun
from validation.selection.judging.from_report import references_of
from validation.selection.judging.references import FOLDER as INSTALLED

OUT, OUT_OF_REFERENCES = Path("calibration"), Path("references")
"""Where a table is measured, and references are made, below the working folder."""
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
        "rows alone change in the table; or those of a Python file, which is run as a program, with your rights",
    )
    alone.add_argument(
        "--check", type=at_least(1), metavar="N", help="measure N scenes of each kind again, and report which differ"
    )
    alone.add_argument(
        "--references",
        type=Path,
        metavar="REPORT",
        help="make the references of `judge` anew from the folder of a full report, which takes hours; the few solves "
        "that it does not keep take two minutes (default of --out: references)",
    )
    calibrating.set_defaults(command=calibrate, seed=run.seed)


def calibrate(arguments: argparse.Namespace) -> Exit:
    """Measure the errors of cheap models beside boundary elements, or check or show those that were measured."""
    arguments.keeps = not (arguments.show or arguments.check)
    if arguments.keeps:
        check_places(arguments, {})
    if arguments.references:
        return _references(arguments)
    if arguments.answers:
        return _answers(arguments)
    if arguments.model:
        return _model(arguments)
    table = table_in(arguments.out)
    if arguments.install and (arguments.show or (arguments.check and arguments.out is not None)):
        raise ValueError("--install is for a table that is measured, or for --check of that of the package")
    if arguments.check:
        return _check(table, arguments)
    if not arguments.show:
        table = _measure(arguments)
    print("\n".join(calibration_lines(table)))
    if not arguments.show:
        print(_what_is_used(table, arguments))
    return Exit.MET


def _check(table: Path, arguments: argparse.Namespace) -> Exit:
    engine = Engine(workers=arguments.workers)
    differing, solves = check_calibration(arguments.check, engine, table, stamp=arguments.install)
    if differing:
        print("\n".join(differing))
        return Exit.CRITERION_FAILED
    print("\n".join(calibration_lines(table)))
    rows = "their rows have today's code" if arguments.install else "nothing was written"
    print(f"measured again: {solves}, all the same; {rows}")
    return Exit.MET


def _measure(arguments: argparse.Namespace) -> Path:
    """The table, in a folder of the user's own, and in the place of that of the package if asked for."""
    run = _run_of(arguments)
    if arguments.install:
        check_installable(run)
    arguments.out = arguments.out or OUT
    table, answers = table_in(arguments.out), arguments.out / ANSWERS.name
    with _folder(arguments) as (folder, engine):
        measured, made = measured_table(run, engine)
        folder.replace({table.name: measured, answers.name: merged(answers, made)})
    if arguments.install:
        install(table)
        write_whole(ANSWERS, merged(ANSWERS, made))
    return table


def _answers(arguments: argparse.Namespace) -> Exit:
    """In a folder of the user's own, beside those of other kinds, and in the package if asked for."""
    run = _run_of(arguments)
    arguments.out = arguments.out or OUT
    place = arguments.out / ANSWERS.name
    about = provenance_of(run)
    about["command"] = about["command"].replace("calibrate", "calibrate --answers")
    with _folder(arguments) as (folder, engine):
        made = measured_answers(run.points, about, engine)
        folder.replace({**_kept(arguments), place.name: merged(place, made)})
    if arguments.install:
        write_whole(ANSWERS, merged(ANSWERS, made))
    for group, answers in made.items():
        print(f"{' '.join(group)}: {answers.number.size} answers, {answers.each.size} numbers of realisations")
    print(printable(f"answers: {ANSWERS if arguments.install else place}"))
    return Exit.MET


def _model(arguments: argparse.Namespace) -> Exit:
    """One of the package, in a table of the user's own, and in that of the package if asked for; or those of a file."""
    path = Path(arguments.model)
    if path.suffix == ".py" or path.is_file():
        return _own(path, arguments)
    arguments.out = arguments.out or OUT
    table = table_in(arguments.out)
    with _folder(arguments) as (folder, engine):
        measured = measured_alone(arguments.model, engine, table if table.exists() else table_in(None))
        folder.replace({**_kept(arguments), table.name: measured})
    if arguments.install:
        install(table)
    print("\n".join(calibration_lines(table)))
    print(_what_is_used(table, arguments))
    return Exit.MET


def _own(path: Path, arguments: argparse.Namespace) -> Exit:
    """Models of somebody's own, whose errors `compare` finds in the same store."""
    from validation.selection.own_models import calibrated, models_in  # imported where there is such a file

    if arguments.install:
        raise ValueError("--install is for models of the package, whose table has no rows of others")
    store, answers = arguments.out or STORE, answers_in()
    engine = Engine(store=store / REALISATIONS)
    found = [calibrated(one, answers.keys(), engine) for one in models_in(path)]
    errors = {(*group, one.name): known.measured for one in found for group, known in one.errors.items()}
    lines = errors_as_lines({key: measured for key, measured in errors.items() if measured})
    print(printable("\n".join(lines), lines=True))
    for one in found:
        if not any(one.name == name for *_, name in errors):
            print(printable(f"{one.serves}; no answers are stored for that: its error is unknown"))
    print(printable(f"errors: in {store}, by the bytes of {path.name} and of what it has loaded from its folder"))
    return Exit.MET


def _kept(arguments: argparse.Namespace) -> dict[str, bytes]:
    """What a folder has, table and answers."""
    places = (table_in(arguments.out), arguments.out / ANSWERS.name)
    return {place.name: place.read_bytes() for place in places if place.exists()}


def _run_of(arguments: argparse.Namespace) -> CalibrationRun:
    return CalibrationRun(seed=arguments.seed, **{name: getattr(arguments, name) for name in COUNTED})


@contextmanager
def _folder(arguments: argparse.Namespace) -> Iterator[tuple[Folder, Engine]]:
    """That of the table and of finished solves."""
    with (
        Folder(arguments.out, kind=CALIBRATION) as folder,
        progress_of("calibration", arguments.workers) as progress,
    ):
        yield folder, Engine(workers=arguments.workers, store=arguments.out / REALISATIONS, progress=progress)


def _references(arguments: argparse.Namespace) -> Exit:
    """Of the judges, in a folder of the user's own, and in the package if asked for."""
    out = arguments.out or OUT_OF_REFERENCES
    with Folder(out, kind=REFERENCES) as folder, progress_of("references", arguments.workers) as progress:
        engine = Engine(workers=arguments.workers, store=out / REALISATIONS, progress=progress)
        files = references_of(arguments.references, engine)
        folder.replace(files)
    for name, contents in files.items() if arguments.install else ():
        write_whole(INSTALLED / name, contents)
    where = (
        f"{INSTALLED}, where `judge` reads them" if arguments.install else f"{out}; `judge` reads those of the package"
    )
    print(printable(f"{len(files)} files of references in {where}"))
    return Exit.MET


def _what_is_used(table: Path, arguments: argparse.Namespace) -> str:
    if arguments.install:
        return printable(f"table: {table}, installed: `compare` claims errors by it")
    return printable(f"table: {table}; `compare` goes on with that of the package: the same command with --install")
