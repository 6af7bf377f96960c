"""Run cases and write their report; by `precision` and `benchmark` what is timed alone; by `cases` list them."""

import argparse
import sys
from pathlib import Path

from validation.engine.street import places
from validation.report.commands.arguments import Exit, add_options, add_profile, add_workers, at_least, comma_separated

BENCHMARK, FORMER_BENCHMARK = "benchmark", "race"
"""The command of the case `race`, and its former name, which works for one release."""
WHEELS = ("rough_wheel", "table_14_1")
"""The scenes that `bundled_with_track` finds, which imports numerics."""


def describe(making: argparse.ArgumentParser) -> None:
    name = making.prog.split()[-1]
    if name == "cases":
        making.set_defaults(command=cases)
        return
    timed = name if name != "report" else ""
    making.set_defaults(
        command=report, only=None, keep=False, workers=1, executor=None, scene=None, solver=None, timed=timed
    )
    add_profile(making)
    making.add_argument(
        "--verbose", "-v", action="store_true", help="print all claims and conclusions of each case, too"
    )
    if timed:
        making.set_defaults(only=[("race" if name == BENCHMARK else name,)])
        out = ("--out", "DIR", Path, f"folder (default: reports/{name}-quick or reports/{name})")
        seed = "seed of the rough surfaces"
        seed += "; the tracks of Fig. 14.4, whose times are compared, keep theirs" if name == "precision" else ""
        add_options(making, out, ("--seed", "S", at_least(0), seed))
        if name in (BENCHMARK, FORMER_BENCHMARK) and places("solvers_of_files"):
            own = "a Python file with functions below @contact_solver, compared too; it is run as a program"
            add_options(making, ("--solver", "FILE", Path, own))
        return
    making.add_argument(
        "--only", nargs="+", action="extend", type=_names, metavar="CASE", help="run only these; `cases` lists them"
    )
    making.add_argument(
        "--keep",
        action="store_true",
        help="with --only: keep the other cases of the earlier report in --out (default: reports/PROFILE) as they are",
    )
    add_workers(making)
    scene = (
        "a dynamic wheel of your own, a TOML file like validation/scenes/table_14_1.toml, or the name of an example "
        f"scene ({', '.join(WHEELS)}); alone, it means --only wheel"
    )
    add_options(
        making,
        ("--out", "DIR", Path, "folder (default: reports/PROFILE, with the names of the cases if --only)"),
        ("--seed", "S", at_least(0), "seed of the random numbers of every case"),
        ("--executor", "WHERE", str, '"local" (default), or dask://HOST:PORT, whose workers replace local processes'),
        ("--scene", "FILE", str, scene),
    )


# all cases are imported where a name is read or a command runs, not for the help


def _names(word: str) -> tuple[str, ...]:
    from validation.report.contents import CASES, TIMED

    return comma_separated([*CASES, *TIMED])(word)


def cases(arguments: argparse.Namespace) -> Exit:
    """List the cases."""
    from validation.report.commands import run_cases

    return run_cases.cases(arguments)


def report(arguments: argparse.Namespace) -> Exit:
    """Run cases and write their report."""
    from validation.report.commands import run_cases

    if arguments.timed == FORMER_BENCHMARK:
        print(f"note: `race` is named `{BENCHMARK}` now; the former name works for one release", file=sys.stderr)
    return run_cases.report(arguments)
