"""Runs cases and writes their report, or lists them. Its import brings in all cases, which takes seconds."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from validation.analysis.escapes import printable
from validation.analysis.evidence import Table
from validation.benchmarks.peers import solvers_with
from validation.engine.engine import LOCAL
from validation.report.build import build
from validation.report.commands.arguments import Exit, check_places, not_beside
from validation.report.contents import CASES, TIMED, timed_here
from validation.report.formats import in_four_digits
from validation.report.section import Section, total_of
from validation.scenes.description import description_lines
from validation.scenes.load import load_scene_with_track
from validation.scenes.rolling import RollingScene


def cases(arguments: argparse.Namespace) -> Exit:
    """List those that are not timed, in the order of the page."""
    print("\n".join(f"{name:20s} {case.answers}" for name, case in CASES.items()))
    return Exit.MET


def report(arguments: argparse.Namespace) -> Exit:
    """Run cases, write their report, and say how it came out."""
    # what is timed is run last, when nothing else is; the solver benchmark needs other solvers
    everything = [*CASES, *timed_here()] if arguments.scene is None else ["wheel"]
    arguments.only = [name for group in arguments.only or () for name in group]
    names = list(dict.fromkeys(arguments.only or everything))
    if arguments.keep and not arguments.only:
        raise ValueError("--keep is for --only, got it alone: without --only no case is left to be kept")
    if arguments.executor not in (None, LOCAL):
        not_beside(arguments, "beside --executor", "--workers")
    out = arguments.out = arguments.out or Path("reports") / _folder(names, arguments)
    check_places(arguments, {})
    arguments.keeps = True
    scene = _scene_of(arguments, names)
    if scene is not None:
        print("\n".join([scene.name, *description_lines(scene), ""]), flush=True)
    sections = build(
        names,
        profile=arguments.profile,
        out=out,
        workers=arguments.workers,
        seed=arguments.seed,
        scene=scene,
        executor=arguments.executor or LOCAL,
        keep=arguments.keep,
        own=_solvers_of(arguments),
        callback=lambda section: print("\n".join(lines_of(section)), flush=True),
    )
    if any(section.claims for section in sections):
        print(total_of(sections))
    print(printable(f"report: {out / 'index.html'}"))
    if any(section.unconverged for section in sections):
        return Exit.NOT_CONVERGED
    return Exit.CRITERION_FAILED if any(section.missed for section in sections) else Exit.MET


def _solvers_of(arguments: argparse.Namespace) -> str:
    """The file of `--solver`, refused before the first solve where it offers none."""
    if arguments.solver is None:
        return ""
    solvers_with(str(arguments.solver))
    return str(arguments.solver.resolve())


def _folder(names: Sequence[str], arguments: argparse.Namespace) -> str:
    if arguments.timed:
        return "-".join([arguments.timed, *["quick"] * (arguments.profile == "quick")])
    listed = names if (arguments.only or arguments.scene) and not arguments.keep else ()
    return "-".join([arguments.profile, *listed])


def _scene_of(arguments: argparse.Namespace, names: Sequence[str]) -> RollingScene | None:
    """The scene of `--scene`, refused where a case takes none."""
    if arguments.scene is None:
        return None
    without = [name for name in names if name in TIMED or not hasattr(CASES[name].quick, "scene")]
    if without:
        raise ValueError(f"--scene is for cases of the dynamic wheel, got {', '.join(without)}")
    return load_scene_with_track(arguments.scene)


def lines_of(section: Section) -> list[str]:
    """A line for the case, each claim, conclusion, missed criterion and failed solve."""
    met = "no criteria"
    if section.criteria:
        met = f"criteria met {section.criteria - len(section.missed)} of {section.criteria}"
    details = [f"{c.status}: {c.claim} {c.answer}" for c in section.claims]
    details += section.evidence.conclusions if section.evidence else ()
    details += [f"missed: {number.sentence}" for number in section.missed]
    details += [f"not converged: {solve}" for solve in section.unconverged]
    if section.name in TIMED and section.evidence:
        details += [line for table in section.evidence.page_tables for line in _table_lines(table)]
    head = f"{section.name:15s} {'no result' if section.failure else met}"
    return [head, *(f"    {line}" for line in details)]


def _table_lines(table: Table) -> list[str]:
    """A line a row, under the name of the table."""
    rows = zip(*table.columns.values(), strict=True)
    pairs = ([pair for pair in zip(table.columns, row, strict=True) if pair[1] != ""] for row in rows)
    lines = ("; ".join(f"{name}: {in_four_digits(cell)}" for name, cell in pairs_of_row) for pairs_of_row in pairs)
    return [f"{table.name}:", *(f"  {line}" for line in lines)]
