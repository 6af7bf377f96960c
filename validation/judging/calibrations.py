"""What `calibrate` does for this house: errors of models of a file, and the references of the judges."""

import argparse
from pathlib import Path

from validation.advice.calibrate import errors_as_lines, is_of_package
from validation.advice.commands.compare import STORE
from validation.engine.engine import Engine
from validation.engine.files import write_whole
from validation.engine.progress import progress_of
from validation.judging.files_read import is_installed
from validation.judging.kinds.from_report import references_of
from validation.judging.kinds.references import FOLDER as INSTALLED
from validation.judging.own_models import calibrated, models_in
from validation.report.commands.arguments import Exit, not_beside
from validation.report.folder import REALISATIONS, REFERENCES, Folder
from validation.scenes.printable import printable

OUT_OF_REFERENCES = Path("references")
"""Where they are made, below the working folder."""


def is_own(name: str) -> bool:
    """Whether it is a file, or what an installed package offers; a model of the package goes before that."""
    is_file = name.endswith(".py") or Path(name).is_file()
    return is_file or (is_installed(name) and not is_of_package(name))


def measure_own_models(model: str, arguments: argparse.Namespace) -> Exit:
    """Models of somebody's own, whose errors `compare` finds in the same store."""
    not_beside(arguments, f"beside --model {printable(model)}", "--workers")
    if arguments.install:
        raise ValueError("--install is for models of the package, whose table has no rows of others")
    store = arguments.out or STORE
    engine = Engine(store=store / REALISATIONS)
    models = [calibrated(own, None, engine) for own in models_in(model)]
    errors = {(*group, own.name): part.measured for own in models for group, part in own.errors.items()}
    measured = {key: rows for key, rows in errors.items() if rows}
    lines = errors_as_lines(measured)
    for own in models:
        if not any(own.name == name for *_, name in measured):
            lines.append(f"{own.serves}; {own.unknown(next(iter(own.errors.values()), None))}")
    lines.append(f"errors: in {store}, by the bytes of {Path(model).name} and of what it loads and reads")
    print(printable("\n".join(lines), lines=True))
    return Exit.MET


def make_references(arguments: argparse.Namespace) -> Exit:
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
