"""Options of this house in commands of others; what they do is imported when it is asked for."""

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from validation.report.commands.arguments import Exit
from validation.scenes.printable import printable

if TYPE_CHECKING:
    from validation.advice.compare import SceneProblem


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
            expected = "a Python file, or a name of `judge --list`"
            raise ValueError(f"--models-from must be {expected}, got {printable(name)}: No such file")

    @staticmethod
    def with_models(problems: Sequence["SceneProblem"], name: str) -> Sequence["SceneProblem"]:
        """Problems with the models of the file."""
        from validation.judging.models_from import with_models

        return with_models(problems, name)

    @staticmethod
    def measured(problems: Sequence["SceneProblem"], name: str, store: Path) -> Sequence["SceneProblem"]:
        """The same with the errors of these models."""
        from validation.judging.models_from import measured

        return measured(problems, name, store)


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
        from validation.judging.calibrations import make_references, measure_own_models

        if arguments.references:
            return make_references(arguments)
        if arguments.model:
            return measure_own_models(arguments.model, arguments)
        return None
