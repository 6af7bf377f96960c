"""What `calibrate` does for this house: errors of models of a file, and the references of the judges."""

import argparse
from pathlib import Path

from validation.advice.calibrate import errors_as_lines
from validation.advice.commands.calibrate import SCRIPT
from validation.advice.commands.compare import STORE
from validation.engine.engine import Engine
from validation.engine.progress import progress_of
from validation.judging.files_read import is_installed
from validation.judging.kinds.from_report import references_of
from validation.judging.own_models import calibrated, models_in
from validation.report.commands.arguments import Exit, not_beside
from validation.report.folder import REALISATIONS, REFERENCES, Folder
from validation.scenes.printable import printable

OUT_OF_REFERENCES = Path("references")
"""Where they are made, below the working folder."""


def measure_own_models(model: str, arguments: argparse.Namespace) -> Exit:
    """Models of somebody's own, whose errors `compare` finds in the same store."""
    if not (model.endswith(".py") or Path(model).is_file() or is_installed(model)):
        own = f"a Python file, or a name of `judge --list`, got {printable(model)}"
        raise ValueError(f"--model must be {own}; a model of the package is for {SCRIPT}")
    not_beside(arguments, f"beside --model {printable(model)}", "--workers")
    store = arguments.out or STORE
    engine = Engine(store=store / REALISATIONS)
    found = [calibrated(one, None, engine) for one in models_in(model)]
    errors = {(*group, one.name): known.measured for one in found for group, known in one.errors.items()}
    known = {key: measured for key, measured in errors.items() if measured}
    lines = errors_as_lines(known)
    for one in found:
        if not any(one.name == name for *_, name in known):
            lines.append(f"{one.serves}; {one.unknown(next(iter(one.errors.values()), None))}")
    lines.append(f"errors: in {store}, by the bytes of {Path(model).name} and of what it loads and reads")
    print(printable("\n".join(lines), lines=True))
    return Exit.MET


def make_references(arguments: argparse.Namespace) -> Exit:
    """Of the judges, in a folder of the user's own."""
    out = arguments.out or OUT_OF_REFERENCES
    with Folder(out, kind=REFERENCES) as folder, progress_of("references", arguments.workers) as progress:
        engine = Engine(workers=arguments.workers, store=out / REALISATIONS, progress=progress)
        files = references_of(arguments.references, engine)
        folder.replace(files)
    print(printable(f"{len(files)} files of references in {out}; `judge` reads those of the package"))
    return Exit.MET
