"""Runs cases and writes their report, or lists them. Its import brings in all cases, which takes seconds."""

import argparse
import os
import textwrap
from collections.abc import Iterator, Sequence
from pathlib import Path

from validation.analysis.case import Profile
from validation.analysis.escapes import coloured, printable
from validation.analysis.evidence import ClaimStatus, JudgedClaim, Number, Role, Table, Verdict, Whose
from validation.analysis.number_text import short
from validation.benchmarks.peers import solvers_with
from validation.engine.engine import LOCAL
from validation.report.build import build
from validation.report.commands.arguments import Exit, check_places, not_beside
from validation.report.contents import CASES, TIMED, timed_here
from validation.report.durations import duration_text
from validation.report.formats import in_four_digits
from validation.report.page import FIGURES
from validation.report.section import Section
from validation.scenes.description import description_lines
from validation.scenes.load import load_scene_with_track
from validation.scenes.rolling import RollingScene

WIDTH = 100
"""Characters of a line."""
COLUMNS = f"{'case':15s}{'checks':>10s}{'supported':>11s}{'refuted':>9s}{'inconclusive':>14s}"
HEAD = f"{COLUMNS}  largest deviation, in tolerances"
"""Names of the columns: checks passed of all, how many claims are supported (also within limits), refuted or
inconclusive, the number of a case that is farthest from its reference, counted in its tolerance."""


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
    everything_here = len(names) == len(everything) > 1
    print(coloured("\n".join(heading_lines(names, arguments.profile, arguments.workers))), flush=True)
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
        callback=lambda section: _print_section(section, verbose=arguments.verbose or bool(arguments.timed)),
    )
    status = _status_of(sections)
    full = "" if arguments.profile == "full" or not everything_here else _time_text("full", names, arguments.workers)
    print(coloured(printable("\n".join(closing_lines(sections, status, out, full)), lines=True)))
    return status


def _status_of(sections: Sequence[Section]) -> Exit:
    if any(section.unconverged for section in sections):
        return Exit.NOT_CONVERGED
    return Exit.CRITERION_FAILED if any(section.missed for section in sections) else Exit.MET


def heading_lines(names: Sequence[str], profile: Profile, workers: int) -> Iterator[str]:
    """What is run: size, cases, processes, and how long that takes; then the names of the columns."""
    cases = f"{len(names)} case{'s' * (len(names) > 1)}"
    cores = f"{os.cpu_count() or 1} core{'s' * ((os.cpu_count() or 1) > 1)}"
    processes = f"{workers} process{'es' * (workers > 1)}"
    yield f"report of the {profile} size: {cases}, {processes} on {cores}, {_time_text(profile, names, workers)}"
    yield from ("", HEAD)


def _time_text(profile: Profile, names: Sequence[str], workers: int) -> str:
    """As "about 2 minutes": of cases and figures, by measured durations."""
    return duration_text(profile, [*names, FIGURES], workers)


def closing_lines(sections: Sequence[Section], status: Exit, out: Path, full: str) -> Iterator[str]:
    """Checks and claims of all cases, what the full size costs, where the page is, and the exit status in words.

    full: how long the full size takes, empty where it has been run or not all cases have.
    """
    checks, missed = sum(section.criteria for section in sections), sum(len(section.missed) for section in sections)
    yield ""
    if claims := [claim for section in sections for claim in section.claims]:
        yield f"claims: {claims_text(claims)}"
        yield "a refuted claim is a finding and fails no check"
    if full:
        yield f"full size: --profile full, {full}"
    yield f"page: {out / 'index.html'}"
    yield {
        Exit.MET: f"exit status 0: all {checks} checks passed" if checks else "exit status 0: no checks in these cases",
        Exit.CRITERION_FAILED: f"exit status 1: {missed} of {checks} checks not passed",
        Exit.NOT_CONVERGED: "exit status 3: solves have not converged",
    }[status]


def claims_text(claims: Sequence[JudgedClaim]) -> str:
    """As "31 supported (9 within limits), 8 refuted, 2 inconclusive"."""
    statuses = [claim.status for claim in claims]
    limited = statuses.count(ClaimStatus.LIMITED)
    supported = f"{statuses.count(ClaimStatus.SUPPORTED) + limited} supported"
    rest = (f"{statuses.count(status)} {status}" for status in (ClaimStatus.REFUTED, ClaimStatus.INCONCLUSIVE))
    return ", ".join([f"{supported} ({limited} within limits)" if limited else supported, *rest])


def _print_section(section: Section, *, verbose: bool) -> None:
    lines = lines_of(section, verbose=verbose)
    print(coloured(printable("\n".join(lines), lines=True)), flush=True)


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


def lines_of(section: Section, *, verbose: bool = False) -> list[str]:
    """The row of a case; below it failures, and statements of the book and the literature that are refuted.

    verbose: all claims and conclusions, and the tables of what is timed, too.
    """
    details = [f"check not passed: {number.sentence}" for number in section.missed]
    details += [f"not converged: {solve}" for solve in section.unconverged]
    details += [_claim_line(claim) for claim in section.claims if verbose or _is_refuted_statement(claim)]
    if verbose and section.evidence:
        details += section.evidence.conclusions
        worst = worst_number(section)
        details += [f"largest deviation: {worst.sentence}"] if worst else []
        if section.name in TIMED:
            details += [line for table in section.evidence.page_tables for line in _table_lines(table)]
    return [_row_of(section), *(line for detail in details for line in _indented(detail))]


def _row_of(section: Section) -> str:
    """The cells of `HEAD`; what does not fit into a line is left to the page."""
    if section.failure:
        return f"{section.name:15s}{'no result':>10s}"
    statuses = [claim.status for claim in section.claims]
    supported = sum(status in (ClaimStatus.SUPPORTED, ClaimStatus.LIMITED) for status in statuses)
    counts = (supported, *(statuses.count(status) for status in (ClaimStatus.REFUTED, ClaimStatus.INCONCLUSIVE)))
    missed = sum(number.role is Role.CRITERION for number in section.missed)
    checks = f"{section.criteria - missed} of {section.criteria}" if section.criteria else "none"
    cells = [
        f"{count:>{width}d}" if statuses else " " * width for count, width in zip(counts, (11, 9, 14), strict=True)
    ]
    row = f"{section.name:15s}{checks:>10s}{''.join(cells)}"
    line = f"{row}  {_worst_text(section)}".rstrip()
    return line if len(line) <= WIDTH else f"{line[: WIDTH - 1].rstrip(' ,')}…"


def _worst_text(section: Section) -> str:
    """As "3.9: mean force, h/d = 1": how many tolerances the number is off that is farthest from its reference."""
    worst = worst_number(section)
    if worst is None:
        return ""
    quantity = f"{worst.quantity}, {worst.conditions}" if worst.where else worst.quantity
    return f"{short(abs(worst.difference) / worst.tolerance)}: {quantity}"


def worst_number(section: Section) -> Number | None:
    """The number whose difference from its reference is the largest part of its tolerance.

    Numbers outside tolerance come first, then those that are inconclusive: an interval may be wider than the tolerance.
    Left out is what a claim says to be different, and a tolerance of zero.
    """
    different = {n.label for claim in section.claims if claim.confirmed_by is Verdict.OUTSIDE for n in claim.numbers}
    order = (Verdict.WITHIN, Verdict.INCONCLUSIVE, Verdict.OUTSIDE)
    judged = (number for number in section.numbers if number.tolerance > 0 and number.label not in different)
    return max(judged, key=lambda n: (order.index(n.verdict), abs(n.difference) / n.tolerance), default=None)


def _is_refuted_statement(claim: JudgedClaim) -> bool:
    """Whether it is refuted, and stated by others."""
    return claim.status is ClaimStatus.REFUTED and claim.whose is not Whose.HYPOTHESIS


def _claim_line(claim: JudgedClaim) -> str:
    """The claim and its answer; of a refuted statement whose it is, and that this is a finding."""
    about = f"finding on {claim.whose}, {claim.status}" if _is_refuted_statement(claim) else f"{claim.status}"
    return f"{about}: {claim.claim} {claim.answer}"


def _indented(line: str) -> list[str]:
    """Lines of the width at the most."""
    own = " " * (4 + len(line) - len(line.lstrip()))
    return textwrap.wrap(line.strip(), WIDTH, initial_indent=own, subsequent_indent=f"{own}  ")


def _table_lines(table: Table) -> list[str]:
    """A line a row, under the name of the table."""
    rows = zip(*table.columns.values(), strict=True)
    pairs = ([pair for pair in zip(table.columns, row, strict=True) if pair[1] != ""] for row in rows)
    lines = ("; ".join(f"{name}: {in_four_digits(cell)}" for name, cell in pairs_of_row) for pairs_of_row in pairs)
    return [f"{table.name}:", *(f"  {line}" for line in lines)]
