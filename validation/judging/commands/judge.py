"""Judge a user's models: where each is accurate enough, or whether a solver is right."""

import argparse
from collections.abc import Sequence
from contextlib import ExitStack
from itertools import zip_longest
from pathlib import Path

from validation.advice.tolerance import tolerance_of
from validation.analysis.contents import as_json, folder_names
from validation.analysis.escapes import coloured, printable
from validation.engine.files import write_output
from validation.judging.judge import Judgement, callers_named, judged, numbers_as_csv
from validation.judging.source_files import GROUP, installed
from validation.judging.worker import Called, visited
from validation.report.commands.arguments import Exit, add_options, check_places
from validation.report.folder import JUDGEMENT, Folder


def describe(judging: argparse.ArgumentParser) -> None:
    judging.add_argument(
        "file",
        metavar="FILE",
        nargs="?",
        help="a Python file with decorated functions, as @stiffness_model, or the name of what an installed package "
        "offers; it is run as a program, with your rights",
    )
    judging.add_argument(
        "--list", action="store_true", help=f"print what installed packages offer, by the entry points {GROUP}"
    )
    add_options(
        judging,
        ("--tolerance", "T", str, '"5%%", "0.05" or "0.4 dB" (default: 10%%)'),
        ("--only", "NAME", str, "judge this model of the file alone"),
        ("--out", "DIR", Path, "write summary, JSON, CSV and figure into this folder, of several models a folder each"),
        ("--json", "FILE", Path, "write all verdicts for other programs; of several models a list"),
        ("--csv", "FILE", Path, "write a row a verdict"),
        ("--figure", "FILE", Path, "draw the relative deviation of each model, in a .svg, .png or .pdf"),
    )
    judging.epilog = (
        "Exit status: of a reduced model 0, whatever the verdicts; of a solver 0 right, 1 wrong; 2 no decorated "
        "function, or bad usage; 3 it answered nowhere."
    )
    judging.set_defaults(command=judge, tolerance="10%")


def judge(arguments: argparse.Namespace) -> Exit:
    """Judge what a file, or an installed package, offers."""
    if arguments.list and arguments.file is None:
        lines = [f"{entry.name}: {entry.value}" for entry in installed().values()]
        print(printable("\n".join(lines) or f"no installed package has the entry points {GROUP}", lines=True))
        return Exit.MET
    if arguments.list:
        raise ValueError(f"--list judges nothing, got it beside {arguments.file}: leave one of them out")
    if arguments.file is None:
        raise ValueError("judge needs a FILE with decorated functions, or a name of judge --list")
    if not Path(arguments.file).is_file() and arguments.file not in installed():
        raise ValueError(f"FILE must be a Python file, or a name of judge --list, got {arguments.file!r}")
    tolerance = tolerance_of(arguments.tolerance)
    check_places(arguments, {Path(arguments.file): "is the model"})
    judgements: list[Judgement] = []
    with visited(arguments.file) as callers, ExitStack() as stack:
        chosen = callers_named(callers, arguments.only, option="--only")
        folders = [stack.enter_context(folder) for folder in _folders(chosen, arguments.out)]
        for caller, folder in zip_longest(chosen, folders):
            judgements.append(judged(caller, tolerance))
            if folder:
                folder.replace(judgements[-1].files())
            print(coloured(printable(judgements[-1].summary(), lines=True)), end="\n\n", flush=True)
    _write(judgements, arguments)
    if not any(judgement.answered for judgement in judgements):
        return Exit.NOT_CONVERGED
    return Exit.CRITERION_FAILED if any(judgement.wrong for judgement in judgements) else Exit.MET


def _folders(chosen: Sequence[Called], out: Path | None) -> list[Folder]:
    """A folder a model, of several below `out`; all are taken before anything is judged."""
    if out is None:
        return []
    names = folder_names([caller.name for caller in chosen]) if len(chosen) > 1 else [""]
    return [Folder(out / name, kind=JUDGEMENT) for name in names]


def _write(judgements: list[Judgement], arguments: argparse.Namespace) -> None:
    """The files of --json, --csv and --figure, each of all models."""
    if arguments.json:
        objects = [judgement.as_dict() for judgement in judgements]
        write_output(arguments.json, as_json(objects if len(objects) > 1 else objects[0]))
    if arguments.csv:
        write_output(arguments.csv, numbers_as_csv(judgements))
    if arguments.figure:
        from validation.judging.figure import figure_of, left_out  # which takes half a second to import

        if names := left_out(judgements):
            print(printable(f"--figure does not show {', '.join(names)}: draw each with --only"))
        write_output(arguments.figure, figure_of(judgements, arguments.figure.suffix[1:]))
