"""The command line: finds the command, imports its module and no other, and says how it ended."""

import argparse
import os
import select
import sys
import traceback
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module, metadata
from typing import Any, NoReturn

from validation.analysis.escapes import never_fatal, printable
from validation.engine.files import ERRORS_OF_A_PATH
from validation.engine.street import commands
from validation.engine.workers import (
    ONE_THREAD,
    RESUME_NOTE,
    TerminatedError,
    WorkerLostError,
    one_line_warnings,
    terminable,
)
from validation.report.commands.arguments import Exit
from validation.report.durations import duration_text
from validation.scenes.bundled import SceneError

COMMANDS = {
    "report": "run the cases and write a report folder",
    **{name: what for name, (what, _) in commands().items()},
    "scene": "print a scene that comes with this package, with a comment on every key",
    "precision": f"error against cost of every method; the full size takes {duration_text('full', ['precision'])}",
    "benchmark": "our solver and the other packages that are installed; the full size takes "
    + duration_text("full", ["race"]),
    "cases": "list the cases and what each shows",
}
FORMER = ("race",)
"""Former names of commands, which work for one release, with a note, and are not listed."""
OF_REPORT = ("precision", "benchmark", "cases", *FORMER)
"""In the module of `report`; each other one has its own in a folder `commands`, imported when it is given."""

STDOUT = 1
"""Its file descriptor."""


def main(words: Sequence[str] | None = None, parser: argparse.ArgumentParser | None = None) -> int:
    """Run one command, return its exit status. parser: of a script that ends as the commands do."""
    # before numpy is loaded: the last bits of sums depend on the threads of BLAS, and workers have one
    os.environ.update(ONE_THREAD | os.environ)
    never_fatal((sys.stdout, sys.stderr))
    arguments = (parser or _parser()).parse_args(words)
    try:
        with terminable(), one_line_warnings():
            status = int(arguments.command(arguments))
            sys.stdout.flush()
            return status
    except (Exception, KeyboardInterrupt) as error:
        if isinstance(error, BrokenPipeError) and _nobody_reads():
            # what is left in the buffer would be written, and fail, once more
            os.dup2(os.open(os.devnull, os.O_WRONLY), STDOUT)
            return Exit.UNFINISHED
        status, sentence = _ended(error, f"; {RESUME_NOTE}" if getattr(arguments, "keeps", False) else "")
        if status is Exit.FAULT:
            traceback.print_exc()
        with suppress(OSError):
            print(printable(sentence, lines=isinstance(error, SceneError)), file=sys.stderr)
        return status


def _nobody_reads() -> bool:
    """Whether standard output is a pipe whose reader has ended, as after `| head`."""
    output = select.poll()
    output.register(STDOUT, 0)
    return any(event & select.POLLERR for _, event in output.poll(0))


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


class _Once(argparse.Action):
    """Stores the value of an option, and its name in `given`. Twice it is an error: the first value would be lost."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: object,
        option_string: str | None = None,
    ) -> None:
        given = getattr(namespace, "given", ())
        if option_string is not None and self.option_strings[-1] in given:
            value = f"{{{','.join(map(str, self.choices))}}}" if self.choices else self.metavar or self.dest.upper()
            raise argparse.ArgumentError(self, f"must be given once, as {option_string} {value}, got it twice")
        namespace.given = (*given, *self.option_strings[-1:])
        setattr(namespace, self.dest, values)


class _Parser(argparse.ArgumentParser):
    """An option is given once; words that are refused are shown without their control characters."""

    def __init__(self, *args: Any, **settings: Any) -> None:
        super().__init__(*args, **settings)
        for action in (None, "store"):
            self.register("action", action, _Once)

    def error(self, message: str) -> NoReturn:
        super().error(printable(message))


class _CommandParser(_Parser):
    """The parser of one command: its module is imported, and describes the arguments, when it is parsed."""

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        command = self.prog.split()[-1]
        of_core = f"validation.report.commands.{'report' if command in OF_REPORT else command}"
        _, module = commands().get(command, ("", of_core))
        import_module(module).describe(self)
        found, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unrecognized arguments: {' '.join(unknown)}")
        return found, unknown


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="mdr-validation",
        description="Compare reduced contact models with three-dimensional boundary elements.",
        epilog="Exit status: 0 all criteria met; 1 a criterion failed, or could not be decided; 2 bad usage or input; "
        "3 something did not converge, has no steady state, or a tolerance was not reached; 4 could not be finished: "
        "a worker was killed, the disk or the memory is full, the scheduler is lost (finished solves are kept, the "
        "same command goes on from there); 70 a fault of the program; 130 interrupted; 143 terminated.",
    )
    parser.add_argument("--version", action="version", version=metadata.version("mdr-validation"))
    subparsers = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=_CommandParser)
    for name, what in COMMANDS.items():
        subparsers.add_parser(name, help=what)
    for name in FORMER:
        subparsers.add_parser(name)
    return parser


def run() -> None:
    """The installed command."""
    sys.exit(main())


if __name__ == "__main__":
    run()
