"""Run cases and write their report."""

import argparse
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from validation.engine.engine import LOCAL
from validation.report.build import build
from validation.report.commands.arguments import add_options, add_profile, add_workers, at_least
from validation.report.commands.exit_status import Exit
from validation.report.contents import CASES, TIMED, timed_here
from validation.report.section import Section, total_of
from validation.report.terminal import lines_of
from validation.scenes.description import description_lines
from validation.scenes.dynamic_wheel import WheelScene, bundled_wheels, load_wheel_scene
from validation.scenes.printable import printable


def describe(making: argparse.ArgumentParser) -> None:
    add_profile(making)
    making.add_argument(
        "--only",
        nargs="+",
        action="extend",
        choices=[*CASES, *TIMED],
        metavar="CASE",
        help="run only these cases; `cases` lists them",
    )
    making.add_argument(
        "--keep",
        action="store_true",
        help="with --only: keep the other cases of the earlier report in --out (default: reports/PROFILE) as they are",
    )
    add_workers(making)
    scene = (
        "a dynamic wheel of your own, a TOML file like validation/scenes/table_14_1.toml, or the name of an example "
        f"scene ({', '.join(bundled_wheels())}); alone, it means --only wheel"
    )
    add_options(
        making,
        ("--out", "DIR", Path, "folder (default: reports/PROFILE, with the names of the cases if --only)"),
        ("--seed", "S", at_least(0), "seed of the random numbers of every case"),
        ("--executor", "WHERE", str, '"local" (default), or dask://HOST:PORT, whose workers replace local processes'),
        ("--scene", "FILE", str, scene),
    )
    making.set_defaults(command=report, executor=LOCAL)


def report(arguments: argparse.Namespace) -> Exit:
    """Run cases and write their report."""
    # what is timed is run last, when nothing else is; a race needs other solvers
    timed = timed_here()
    everything = [*CASES, *timed] if arguments.scene is None else ["wheel"]
    names = list(dict.fromkeys(arguments.only or everything))
    if arguments.keep and not arguments.only:
        raise ValueError("--keep is for --only, got it alone: without --only no case is left to be kept")
    some = names if (arguments.only or arguments.scene) and not arguments.keep else ()
    out = arguments.out or Path("reports") / "-".join([arguments.profile, *some])
    return built(names, out, arguments)


def _scene_of(arguments: argparse.Namespace, names: Sequence[str]) -> WheelScene | None:
    """The scene of `--scene`, refused where a case takes none."""
    if arguments.scene is None:
        return None
    without = [name for name in names if name in TIMED or not hasattr(CASES[name].quick, "scene")]
    if without:
        raise ValueError(f"--scene is for cases of the dynamic wheel, got {', '.join(without)}")
    return load_wheel_scene(arguments.scene)


def built(names: Sequence[str], out: Path, arguments: argparse.Namespace) -> Exit:
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
        keep=arguments.keep,
        callback=partial(_print_section, unsteady=unsteady),
    )
    if not unsteady and any(section.claims for section in sections):
        print(total_of(sections))
    print(printable(f"report: {out / 'index.html'}"))
    if unsteady or any(section.unconverged for section in sections):
        return Exit.NOT_CONVERGED
    return Exit.CRITERION_FAILED if any(section.missed for section in sections) else Exit.MET


def _print_section(section: Section, *, unsteady: bool) -> None:
    print("\n".join(lines_of(section, unsteady=unsteady)), flush=True)
