"""Options of this house in commands of others. What they do is imported when it is asked for: it takes seconds."""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from validation.analysis.escapes import printable
from validation.report.commands.arguments import Exit, not_beside

if TYPE_CHECKING:
    from validation.advice.compare import SceneProblem

OUT_OF_REFERENCES = Path("references")
"""Where they are made, below the working folder."""
FILE_OR_NAME = "a Python file, or a name of `judge --list`"


class ModelsFrom:
    """Of `compare`: models of a file, or of an installed package, beside those of a scene."""

    option, name = "--models-from", "models_from"
    help = (
        "models of your own beside the others: a Python file with decorated functions, as @stiffness_model, or the "
        "name of what an installed package offers, see `judge --list`; it is run as a program, with your rights"
    )

    @staticmethod
    def check(name: str) -> None:
        """Raises ValueError for neither."""
        from validation.judging.source_files import is_installed

        if not Path(name).is_file() and not is_installed(name):
            raise ValueError(f"--models-from must be {FILE_OR_NAME}, got {printable(name)}: No such file")

    @staticmethod
    def with_models(problems: Sequence["SceneProblem"], name: str) -> Sequence["SceneProblem"]:
        """Problems with the models of the file; of several scenes those that these serve have them."""
        from validation.judging.own_models import models_in

        own = tuple(models_in(name))

        def is_served(problem: "SceneProblem") -> bool:
            return any(model.model().serves(problem.scene, key) for model in own for key in problem.quantities)

        served = [is_served(problem) for problem in problems]
        # where none is served, all have them, which is refused with the reason
        return [
            replace(problem, own=own if is_own or not any(served) else ())
            for problem, is_own in zip(problems, served, strict=True)
        ]

    @staticmethod
    def measured(problems: Sequence["SceneProblem"], name: str, store: Path) -> Sequence["SceneProblem"]:
        """The same with the errors of these models, which are measured first where they are not in the store."""
        from validation.engine.engine import Engine
        from validation.engine.progress import Part
        from validation.judging.own_models import NOT_IN_KEY, OwnModel, calibrated, group_of

        groups = {group_of(problem.scene, quantity) for problem in problems for quantity in problem.quantities}
        solved = Part()
        engine = Engine(store=store / "realisations", progress=solved)

        def with_errors(problem: "SceneProblem") -> "SceneProblem":
            own = tuple(calibrated(model, groups, engine) for model in problem.own if isinstance(model, OwnModel))
            return replace(problem, own=own)

        measured_problems = [with_errors(problem) for problem in problems]
        if any(kind.stored for kind in solved.kinds):
            kept = f"errors of {printable(name)} are those kept in {printable(store)}, {NOT_IN_KEY}"
            print(kept, file=sys.stderr)
        return measured_problems


class OfCalibrate:
    """Of `calibrate`: models of a file, and the references of the judges."""

    @staticmethod
    def add(alone: argparse._MutuallyExclusiveGroup) -> None:
        alone.add_argument(
            "--model",
            metavar="FILE",
            help="measure the models of a Python file, or of an installed package by a name of `judge --list`, "
            "relative to stored answers of boundary elements; it is run as a program, with your rights",
        )
        alone.add_argument(
            "--references",
            type=Path,
            metavar="REPORT",
            help="make the references of `judge` anew from the folder of a full report, which takes hours; the few "
            "solves that it does not keep take two minutes (default of --out: references)",
        )

    @staticmethod
    def command(arguments: argparse.Namespace) -> Exit | None:
        """What was asked of this house; None where nothing was."""
        if arguments.references:
            return make_references(arguments)
        return measure_own_models(arguments.model, arguments) if arguments.model else None


def measure_own_models(source: str, arguments: argparse.Namespace) -> Exit:
    """Models of somebody's own, whose errors `compare` finds in the same store."""
    from validation.advice.calibrate import errors_as_lines
    from validation.advice.commands.calibrate import SCRIPT
    from validation.advice.commands.compare import STORE
    from validation.engine.engine import Engine
    from validation.judging.own_models import calibrated, models_in
    from validation.judging.source_files import is_installed
    from validation.report.folder import REALISATIONS

    if not (source.endswith(".py") or Path(source).is_file() or is_installed(source)):
        own = f"{FILE_OR_NAME}, got {printable(source)}"
        raise ValueError(f"--model must be {own}; a model of the package is for {SCRIPT}")
    not_beside(arguments, f"beside --model {printable(source)}", "--workers")
    store = arguments.out or STORE
    engine = Engine(store=store / REALISATIONS)
    models = [calibrated(model, None, engine) for model in models_in(source)]
    errors = {(*group, model.name): part.measured for model in models for group, part in model.errors.items()}
    measured = {key: rows for key, rows in errors.items() if rows}
    lines = errors_as_lines(measured)
    for model in models:
        if not any(model.name == name for *_, name in measured):
            lines.append(f"{model.serves}; {model.unknown(next(iter(model.errors.values()), None))}")
    lines.append(f"errors: in {store}, by the bytes of {Path(source).name} and of what it loads and reads")
    print(printable("\n".join(lines), lines=True))
    return Exit.MET


def make_references(arguments: argparse.Namespace) -> Exit:
    """Of the judges, in a folder of the user's own."""
    from validation.engine.engine import Engine
    from validation.engine.progress import progress_of
    from validation.judging.kinds.from_report import references_of
    from validation.report.folder import REALISATIONS, REFERENCES, Folder

    out = arguments.out or OUT_OF_REFERENCES
    with Folder(out, kind=REFERENCES) as folder, progress_of("references", arguments.workers) as progress:
        engine = Engine(workers=arguments.workers, store=out / REALISATIONS, progress=progress)
        files = references_of(arguments.references, engine)
        folder.replace(files)
    print(printable(f"{len(files)} files of references in {out}; `judge` reads those of the package"))
    return Exit.MET
