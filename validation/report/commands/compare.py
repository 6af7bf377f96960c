"""Select the cheapest model of a scene that meets a tolerance."""

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from validation.analysis.contents import as_csv
from validation.analysis.evidence import Table
from validation.engine.engine import Engine
from validation.engine.files import write_given
from validation.engine.progress import progress_of
from validation.report.commands.arguments import at_least
from validation.report.commands.exit_status import Exit
from validation.report.manifest import COMPARISON
from validation.scenes.load import Scene, bundled_for_compare, load_scene, load_varied
from validation.scenes.printable import printable
from validation.selection.compare import QUANTITIES, Comparison, models_of, quantities_of
from validation.selection.compare import compare as compared
from validation.selection.exported import levels_of_models, to_json_of
from validation.selection.filter_table import filter_table
from validation.selection.hierarchy import ContactModel
from validation.selection.model_names import models_named, names_in
from validation.selection.several import help_with, overview, table_of_several
from validation.selection.several_scenes import SceneProblem, compare_scenes
from validation.selection.summary import findings, format_seconds, heading
from validation.selection.tolerance import tolerance_of

FIGURES = (".svg", ".png", ".pdf")
STORE = Path("reports", "compared")
"""Where finished scenes of several are kept, below the working folder."""


def describe(comparing: argparse.ArgumentParser) -> None:
    comparing.add_argument(
        "scene",
        nargs="+",
        metavar="SCENE",
        help=f"a TOML file, or the name of an example scene ({', '.join(bundled_for_compare())}); several: one table",
    )
    comparing.add_argument(
        "--sweep", type=_sweep, metavar="KEY=A,B,C", help='the scene with each value, as wheel.load="5 kN,10 kN"'
    )
    comparing.add_argument(
        "--tolerance", type=_tolerance, default="10%", metavar="T", help='"5%%", "0.05" or "0.4 dB" (default: 10%%)'
    )
    comparing.add_argument(
        "--quantity",
        "--want",
        choices=QUANTITIES,
        metavar="QUANTITY",
        help=(
            f"one of {', '.join(QUANTITIES)} (default: the first that the scene has); --want is an old name, until 0.3"
        ),
    )
    comparing.add_argument("--seed", type=at_least(0), metavar="S", help="seed of the random roughness (default: 0)")
    solved = comparing.add_mutually_exclusive_group()
    solved.add_argument("--all", action="store_true", help="solve all models, and print them side by side")
    solved.add_argument(
        "--models", metavar="NAMES", help='solve these alone: mdr, bem, or names, as "mdr,bem" or "fit,springs"'
    )
    for name, what in (
        ("--json", "write the result for other programs; `--report` writes it with a schema that describes its keys"),
        ("--csv", "write a row a number or a band, of each model that was solved"),
        ("--cnossos", "write a contact filter in the columns of the table of CNOSSOS-EU, as CSV"),
        ("--figure", "draw the models that were solved, in a .svg, .png or .pdf"),
    ):
        comparing.add_argument(name, type=Path, metavar="FILE", help=what)
    comparing.add_argument(
        "--report", type=Path, metavar="DIR", help="write a page with figure and data into a folder of its own"
    )
    _describe_runs_of_several(comparing)
    comparing.set_defaults(command=compare)


def _describe_runs_of_several(comparing: argparse.ArgumentParser) -> None:
    comparing.add_argument(
        "--workers",
        type=at_least(1),
        default=os.cpu_count() or 1,
        metavar="N",
        help="number of processes for several scenes (default: one per core)",
    )
    comparing.add_argument(
        "--store",
        type=Path,
        metavar="DIR",
        help=f"where finished ones of several scenes are kept, for a run that goes on (default: {STORE}, or in "
        "the folder of --report)",
    )


def compare(arguments: argparse.Namespace) -> Exit:
    """Select the cheapest model of a scene that meets the tolerance, and say why."""
    scenes = [scene for name in arguments.scene for scene in _scenes_of(name, arguments.sweep)]
    problems = [_problem(scene, arguments) for scene in scenes]
    _check_files(problems, arguments)
    if arguments.report is None:
        found = _found(problems, arguments)
        _write(found, arguments)
    else:
        found = _reported(problems, arguments)
    return Exit.MET if all(one.met for one in found) else Exit.NOT_CONVERGED


def _scenes_of(name: str, sweep: tuple[str, list[str]] | None) -> list[Scene]:
    if sweep is None:
        return [load_scene(name)]
    key, values = sweep
    return [load_varied(name, key, value) for value in values]


def _problem(scene: Scene, arguments: argparse.Namespace) -> SceneProblem:
    """What is asked of a scene. Raises ValueError for a quantity or a model that it has not."""
    quantity, seed = arguments.quantity or quantities_of(scene)[0], arguments.seed or 0
    tolerance = tolerance_of(arguments.tolerance).relative
    models = models_of(scene, quantity, tolerance, seed)
    names = names_in(arguments.models, [model.name for model in models]) if arguments.models is not None else []
    models_named(models, names, tolerance)
    return SceneProblem(scene, quantity, arguments.tolerance, seed, arguments.all, tuple(names))


def _check_files(problems: Sequence[SceneProblem], arguments: argparse.Namespace) -> None:
    """Raises ValueError before anything is solved."""
    quantities = list(dict.fromkeys(problem.quantity for problem in problems))
    figure = arguments.figure
    if figure is not None and figure.suffix not in FIGURES:
        raise ValueError(f"--figure must end in {', '.join(FIGURES)}, got {printable(figure)}")
    if len(quantities) > 1 and (figure is not None or arguments.csv is not None):
        raise ValueError(f"--figure and --csv must have one quantity, named by --quantity, got {', '.join(quantities)}")
    if arguments.cnossos is not None and quantities != ["contact-filter"]:
        raise ValueError(f"--cnossos is for the quantity contact-filter of a rail, got {', '.join(quantities)}")


def _found(problems: Sequence[SceneProblem], arguments: argparse.Namespace) -> list[Comparison]:
    """Solve, and print: all about one scene, what was understood before it is solved; a line each of several."""
    if len(problems) == 1:
        (problem,) = problems
        print(heading(problem.scene, problem.quantity, problem.wanted), flush=True)
        found = compared(
            problem.scene,
            quantity=problem.quantity,
            tolerance=problem.tolerance,
            seed=problem.seed,
            solve_all=problem.solve_all,
            models=problem.models,
            callback=_announce,
        )
        print(findings(found))
        return [found]
    # a run that ends before its time says that what is finished is kept
    arguments.out = arguments.store or arguments.report or STORE
    with progress_of("scenes", arguments.workers) as progress:
        engine = Engine(workers=arguments.workers, store=arguments.out / "realisations", progress=progress)
        several = compare_scenes(problems, engine)
    print("\n".join([*overview(several), *help_with(several)]))
    return several


def _reported(problems: Sequence[SceneProblem], arguments: argparse.Namespace) -> list[Comparison]:
    """The same, with a page in a folder of its own."""
    from validation.report.compared_page import PAGE, files_of_comparison  # which takes half a second to import
    from validation.report.folder import Folder
    from validation.report.provenance import provenance

    with Folder(arguments.report, kind=COMPARISON, option="--report") as folder:
        found = _found(problems, arguments)
        _write(found, arguments)
        about = provenance("compare", {"compare": problems[0].seed}, Engine(workers=arguments.workers), {})
        folder.replace(files_of_comparison(found, about))
    print(printable(f"report: {arguments.report / PAGE}"))
    return found


def _announce(model: ContactModel) -> None:
    """Name a model whose solve takes a second or more, before it begins."""
    if model.cost().seconds >= 1:
        print(f"solving {model.name}, about {format_seconds(model.cost().seconds)}", file=sys.stderr, flush=True)


def _write(found: list[Comparison], arguments: argparse.Namespace) -> None:
    """The files that are asked for, each of them whole; of several scenes a list, and a column for the scene."""
    several = len(found) > 1
    if arguments.json is not None:
        write_given(arguments.json, to_json_of(found).encode())
    if arguments.csv is not None:
        write_given(arguments.csv, as_csv(table_of_several(found) if several else levels_of_models(found[0])))
    if arguments.cnossos is not None:
        filters = [filter_table(one) for one in found]
        rows = {name: [value for one in filters for value in one.columns[name]] for name in filters[0].columns}
        write_given(arguments.cnossos, as_csv(Table("contact-filter", rows)))
    if arguments.figure is not None:
        from validation.report.compared import to_figure  # which takes half a second to import

        write_given(arguments.figure, to_figure(found, form=arguments.figure.suffix[1:]))


def _sweep(word: str) -> tuple[str, list[str]]:
    key, _, values = word.partition("=")
    if not key.strip() or not all(value.strip() for value in values.split(",")):
        raise argparse.ArgumentTypeError(f'must be as wheel.load="5 kN,10 kN", got {word!r}')
    return key.strip(), [value.strip() for value in values.split(",")]


def _tolerance(word: str) -> str:
    try:
        tolerance_of(word)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error).removeprefix("tolerance ")) from None
    return word
