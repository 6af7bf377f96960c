"""What `calibrate` does for this house: errors of models of a file, and the references of the judges."""

import argparse
from pathlib import Path

from validation.advice.calibrate import errors_as_lines
from validation.advice.commands.calibrate import SCRIPT
from validation.advice.commands.compare import STORE
from validation.engine.engine import Engine
from validation.engine.progress import progress_of
from validation.judging.kinds.from_report import references_of
from validation.judging.own_models import calibrated, models_in
from validation.judging.source_files import is_installed
from validation.report.commands.arguments import Exit, not_beside
from validation.report.folder import REALISATIONS, REFERENCES, Folder
from validation.scenes.printable import printable

OUT_OF_REFERENCES = Path("references")
"""Where they are made, below the working folder."""


def measure_own_models(source: str, arguments: argparse.Namespace) -> Exit:
    """Models of somebody's own, whose errors `compare` finds in the same store."""
    if not (source.endswith(".py") or Path(source).is_file() or is_installed(source)):
        own = f"a Python file, or a name of `judge --list`, got {printable(source)}"
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
    out = arguments.out or OUT_OF_REFERENCES
    with Folder(out, kind=REFERENCES) as folder, progress_of("references", arguments.workers) as progress:
        engine = Engine(workers=arguments.workers, store=out / REALISATIONS, progress=progress)
        files = references_of(arguments.references, engine)
        folder.replace(files)
    print(printable(f"{len(files)} files of references in {out}; `judge` reads those of the package"))
    return Exit.MET
