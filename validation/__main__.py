"""The command line."""

import argparse
import importlib.metadata
import os
import sys
import traceback
from collections.abc import Callable, Sequence
from contextlib import suppress
from enum import IntEnum
from functools import partial
from pathlib import Path
from typing import NoReturn

from validation.engine.engine import LOCAL, RESUME_NOTE, Engine, WorkerLostError
from validation.engine.files import ERRORS_OF_A_PATH
from validation.engine.termination import TerminatedError, terminable
from validation.report.build import build
from validation.report.contents import CASES, TIMED, timed_here
from validation.report.section import Section, total_of
from validation.report.terminal import lines_of
from validation.scenes.description import description_lines
from validation.scenes.dynamic_wheel import WheelScene, bundled_wheels, load_wheel_scene
from validation.scenes.load import bundled_for_compare, load_scene
from validation.scenes.printable import printable
from validation.scenes.reader import SceneError
from validation.selection.calibrate import CalibrationRun, calibration_lines, write_calibration
from validation.selection.compare import QUANTITIES
from validation.selection.compare import compare as compared
from validation.selection.hierarchy import ContactModel
from validation.selection.summary import format_seconds, summary

CLOCKED = {
    "precision": "error against cost of every method, on six scenes; full takes two and a half minutes",
    "race": "our solver and the other packages that are installed; the full size takes half an hour",
}


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


def main(words: Sequence[str] | None = None) -> int:
    """Run one command, return its exit status."""
    arguments = _parser().parse_args(words)
    try:
        with terminable():
            status = int(arguments.command(arguments))
            sys.stdout.flush()
            return status
    except (Exception, KeyboardInterrupt) as error:
        status, sentence = _ended(error, f"; {RESUME_NOTE}" if "out" in arguments else "")
        if status is Exit.FAULT:
            traceback.print_exc()
        if isinstance(error, BrokenPipeError):
            # what is left in its buffer would be written, and fail, once more
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        with suppress(OSError):
            print(printable(sentence, lines=isinstance(error, SceneError)), file=sys.stderr)
        return status


def _ended(error: BaseException, kept: str) -> tuple[Exit, str]:
    """Exit status and sentence for an exception that ended a command. kept: what is kept of a report."""
    if isinstance(error, TerminatedError):
        return Exit.TERMINATED, f"terminated{kept}"
    if isinstance(error, KeyboardInterrupt):
        return Exit.INTERRUPTED, f"interrupted{kept}"
    if isinstance(error, MemoryError):
        return Exit.UNFINISHED, f"error: the memory is full: {error}{kept}"
    if isinstance(error, OSError) and error.errno is not None:
        named = ": ".join(printable(part) for part in (error.filename, error.strerror) if part)
        if error.errno in ERRORS_OF_A_PATH:
            return Exit.BAD_INPUT, f"error: {named}"
        return Exit.UNFINISHED, f"error: {named}{kept}"
    if isinstance(error, (WorkerLostError, ConnectionError)):
        return Exit.UNFINISHED, f"error: {error}"
    if isinstance(error, (ValueError, OSError)):
        return Exit.BAD_INPUT, f"error: {error}"
    return Exit.FAULT, f"error: a fault of this program, {type(error).__name__}, see the traceback above"


def report(arguments: argparse.Namespace) -> Exit:
    """Run cases and write their report."""
    # what is timed is run last, when nothing else is; a race needs other solvers
    timed = timed_here()
    everything = [*CASES, *timed] if arguments.scene is None else ["wheel"]
    names = list(dict.fromkeys(arguments.only or everything))
    some = names if arguments.only or arguments.scene else ()
    out = arguments.out or Path("reports") / "-".join([arguments.profile, *some])
    return _built(names, out, arguments)


def clock(arguments: argparse.Namespace) -> Exit:
    """Run what is timed alone, and write the page of it."""
    name = arguments.timed
    out = arguments.out or Path("reports") / (name if arguments.profile == "full" else f"{name}-quick")
    return _built([name], out, arguments)


def _scene_of(arguments: argparse.Namespace, names: Sequence[str]) -> WheelScene | None:
    """The scene of `--scene`, refused where a case takes none."""
    if arguments.scene is None:
        return None
    without = [name for name in names if name in TIMED or not hasattr(CASES[name].quick, "scene")]
    if without:
        raise ValueError(f"--scene is for cases of the dynamic wheel, got {', '.join(without)}")
    return load_wheel_scene(arguments.scene)


def _built(names: Sequence[str], out: Path, arguments: argparse.Namespace) -> Exit:
    """Write a report and say how it came out."""
    scene = _scene_of(arguments, names)
    if scene is not None:
        print("\n".join([scene.name, *description_lines(scene), ""]), flush=True)
    unsteady = scene is not None and bool(scene.no_steady_answer())
    sections = build(
        names,
        profile=arguments.profile,
        out=out,
        workers=arguments.workers,
        seed=arguments.seed,
        scene=scene,
        executor=arguments.executor,
        callback=partial(_print_section, unsteady=unsteady),
    )
    if not unsteady and any(section.claims for section in sections):
        print(total_of(sections))
    print(printable(f"report: {out / 'index.html'}"))
    if unsteady or any(section.unconverged for section in sections):
        return Exit.NOT_CONVERGED
    return Exit.CRITERION_FAILED if any(section.missed for section in sections) else Exit.MET


def compare(arguments: argparse.Namespace) -> Exit:
    """Select the cheapest model of a scene that meets the tolerance, and say why."""
    scene = load_scene(arguments.scene)
    seed = arguments.seed or 0
    found = compared(scene, quantity=arguments.quantity, tolerance=arguments.tolerance, seed=seed, callback=_announce)
    print(summary(found))
    return Exit.MET if found.met else Exit.NOT_CONVERGED


def calibrate(arguments: argparse.Namespace) -> Exit:
    """Measure the errors of cheap models beside boundary elements, or show those that were measured."""
    if not arguments.show:
        run = CalibrationRun(
            punches=arguments.punches, spheres=arguments.spheres, rolling=arguments.rolling, seed=arguments.seed
        )
        engine = Engine(workers=arguments.workers, store=arguments.store, progress=True)
        write_calibration(run, engine, arguments.out)
    print("\n".join(calibration_lines(arguments.out)))
    return Exit.MET


def _announce(model: ContactModel) -> None:
    """Name a model whose solve takes a second or more, before it begins."""
    if model.cost().seconds >= 1:
        print(f"solving {model.name}, about {format_seconds(model.cost().seconds)}", file=sys.stderr, flush=True)


def cases(arguments: argparse.Namespace) -> Exit:
    """List what there is."""
    for name, entry in CASES.items():
        print(f"{name:20s} {entry.answers}")
    return Exit.MET


def _print_section(section: Section, *, unsteady: bool) -> None:
    print("\n".join(lines_of(section, unsteady=unsteady)), flush=True)


class _Parser(argparse.ArgumentParser):
    """Words that are refused are shown without their control characters."""

    def error(self, message: str) -> NoReturn:
        super().error(printable(message))


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="mdr-validation",
        description="Compare reduced contact models with three-dimensional boundary elements.",
        epilog="Exit status: 0 all criteria met; 1 a criterion failed, or could not be decided; 2 bad usage or input; "
        "3 something did not converge, has no steady state, or a tolerance was not reached; 4 could not be finished: "
        "a worker was killed, the disk or the memory is full, the scheduler is lost (finished solves are kept, the "
        "same command goes on from there); 70 a fault of the program; 130 interrupted; 143 terminated.",
    )
    parser.add_argument("--version", action="version", version=importlib.metadata.version("mdr-validation"))
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    _describe_report(commands.add_parser("report", help="run the cases and write a report folder"))
    _describe_compare(
        commands.add_parser("compare", help="select the cheapest model of a scene that meets a tolerance")
    )
    _describe_calibrate(
        commands.add_parser("calibrate", help="measure the errors that cheap models claim, beside boundary elements")
    )
    for name, what in CLOCKED.items():
        _describe_timed(commands.add_parser(name, help=what), name)
    listing = commands.add_parser("cases", help="list the cases and what each shows")
    listing.set_defaults(command=cases)
    return parser


def _describe_report(making: argparse.ArgumentParser) -> None:
    _add_profile(making)
    making.add_argument(
        "--only",
        nargs="+",
        action="extend",
        choices=list(CASES),
        metavar="CASE",
        help="run only these cases; `cases` lists them",
    )
    making.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        help="folder of the report (default: reports/PROFILE, with the names of the cases if --only)",
    )
    making.add_argument(
        "--workers",
        type=_at_least(1),
        default=os.cpu_count() or 1,
        metavar="N",
        help="number of processes (default: one per core)",
    )
    making.add_argument("--seed", type=_at_least(0), metavar="S", help="seed of the random numbers of every case")
    making.add_argument(
        "--executor",
        default=LOCAL,
        metavar="WHERE",
        help='"local", or dask://HOST:PORT, the scheduler whose workers replace local processes (default: local)',
    )
    making.add_argument(
        "--scene",
        metavar="FILE",
        help="a dynamic wheel of your own, a TOML file like validation/scenes/table_14_1.toml, or the name of an "
        f"example scene ({', '.join(bundled_wheels())}); alone, it means --only wheel",
    )
    making.set_defaults(command=report)


def _describe_compare(comparing: argparse.ArgumentParser) -> None:
    comparing.add_argument(
        "scene",
        metavar="SCENE",
        help=f"a TOML file, or the name of an example scene ({', '.join(bundled_for_compare())})",
    )
    comparing.add_argument(
        "--tolerance", type=_tolerance, default=0.1, metavar="T", help='"5%%", "0.05" or "0.4 dB" (default: 10%%)'
    )
    comparing.add_argument(
        "--quantity",
        "--want",
        choices=QUANTITIES,
        metavar="QUANTITY",
        help=(
            f"one of {', '.join(QUANTITIES)} (default: the first that the scene has); --want is an old name, until 0.3"
        ),
    )
    comparing.add_argument("--seed", type=_at_least(0), metavar="S", help="seed of the random roughness (default: 0)")
    comparing.set_defaults(command=compare)


def _describe_calibrate(calibrating: argparse.ArgumentParser) -> None:
    run = CalibrationRun()
    for name, what in {"punches": "rough punches", "spheres": "rough spheres", "rolling": "rolling wheels"}.items():
        default = getattr(run, name)
        calibrating.add_argument(
            f"--{name}", type=_at_least(0), default=default, metavar="N", help=f"{what} (default: {default})"
        )
    calibrating.add_argument("--seed", type=_at_least(0), default=run.seed, metavar="S", help="seed of the scenes")
    calibrating.add_argument("--workers", type=_at_least(1), default=os.cpu_count() or 1, metavar="N", help="processes")
    calibrating.add_argument(
        "--store",
        type=Path,
        default=Path(".mdr-validation-calibration"),
        metavar="DIR",
        help="folder of finished solves",
    )
    calibrating.add_argument("--out", type=Path, metavar="FILE", help="the table (default: that of the package)")
    calibrating.add_argument("--show", action="store_true", help="show what the table holds, and measure nothing")
    calibrating.set_defaults(command=calibrate)


def _describe_timed(timing: argparse.ArgumentParser, name: str) -> None:
    _add_profile(timing)
    timing.add_argument(
        "--out", type=Path, metavar="DIR", help=f"folder (default: reports/{name}-quick or reports/{name})"
    )
    timing.add_argument("--seed", type=_at_least(0), metavar="S", help="seed of the rough surfaces")
    timing.set_defaults(command=clock, timed=name, workers=1, executor=LOCAL, scene=None)


def _add_profile(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--profile", choices=("quick", "full"), default="quick", help="size of the problems (default: quick)"
    )


def _at_least(least: int) -> Callable[[str], int]:
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


def _tolerance(word: str) -> float:
    """A relative one: in per cent, as a ratio, or in decibels of an amplitude."""
    text, scale = word.strip(), 1.0
    decibels = text.endswith("dB")
    if text.endswith("%"):
        text, scale = text[:-1], 0.01
    elif decibels:
        text = text[:-2]
    try:
        value = scale * float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f'must be as "5%", "0.05" or "0.4 dB", got {word!r}') from None
    relative = 10 ** (value / 20) - 1 if decibels else value
    if not 0 < relative <= 1:
        raise argparse.ArgumentTypeError(f"must be above zero and no more than 100 %, or 6 dB, got {word!r}")
    return relative


def run() -> None:
    """The installed command."""
    sys.exit(main())


if __name__ == "__main__":
    run()
