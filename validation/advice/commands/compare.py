"""Select the cheapest model of a scene that meets a tolerance."""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from validation.advice.compare import Comparison, SceneProblem, Swept, swept_values
from validation.advice.export import Export
from validation.advice.models_of_scene import all_quantities, label_notes, quantities_of
from validation.advice.scene_model import SceneModel
from validation.advice.several_scenes import compare_scenes
from validation.advice.summary import facts, findings, heading, in_full, in_short, summary
from validation.advice.tolerance import tolerance_of
from validation.analysis.escapes import coloured, printable
from validation.analysis.number_text import format_seconds
from validation.engine.engine import Engine
from validation.engine.files import write_output
from validation.engine.progress import progress_of
from validation.engine.street import objects_of_houses
from validation.report.commands.arguments import Exit, add_options, add_workers, at_least, check_places, comma_separated
from validation.scenes.bundled import path_of
from validation.scenes.load import bundled_for_compare, files_of, load_scene, load_varied
from validation.scenes.reader import errors_of_file
from validation.scenes.scene import Scene

STORE = Path("reports", "compared")
"""Where finished scenes of several are kept, below the working folder."""
KEPT = f"default: {STORE}, or in the folder of --report"


def describe(comparing: argparse.ArgumentParser) -> None:
    comparing.add_argument(
        "scene",
        nargs="+",
        metavar="SCENE",
        help=f"a TOML file, or the name of an example scene ({', '.join(bundled_for_compare())}); several: one table",
    )
    comparing.add_argument(
        "--tolerance", type=_tolerance, default="10%", metavar="T", help='"5%%", "0.05" or "0.4 dB" (default: 10%%)'
    )
    comparing.add_argument(
        "--quantity",
        type=comma_separated(all_quantities()),
        metavar="A,B",
        help=f"of {', '.join(all_quantities())}, one or several (default: the first of the scene)",
    )
    comparing.add_argument(
        "--verbose", "-v", action="store_true", help="of one scene also why, what errors rest on, what solves cost"
    )
    solved = comparing.add_mutually_exclusive_group()
    solved.add_argument("--all", action="store_true", help="solve and time all models, and print them side by side")
    solved.add_argument(
        "--models", metavar="NAMES", help='solve these alone: mdr, bem, or names, as "mdr,bem" or "MDR, single line"'
    )
    add_options(
        comparing,
        *((reader.option, "FILE", str, reader.help) for reader in objects_of_houses("models_from")),
        ("--sweep", "KEY=A,B,C", _sweep, 'the scene with each value, as wheel.load="5 kN,10 kN"'),
        ("--seed", "S", at_least(0), "seed of the random roughness (default: 0)"),
        (
            "--realisations",
            "N",
            at_least(2),
            "surfaces, or strips under a wheel, that boundary elements solve where roughness is drawn (default: as "
            "many as the tolerance takes, up to 1000 surfaces or 32 strips)",
        ),
        (
            "--json",
            "FILE",
            Path,
            "write the result for other programs; `--report` adds a schema that describes its keys",
        ),
        ("--csv", "FILE", Path, "write a row a number or a band, of each model that was solved"),
        *((export.option, "FILE", Path, export.help) for export in objects_of_houses("exports")),
        (
            "--figure",
            "FILE",
            Path,
            "draw the models that were solved, of spectra five at the most, in a .svg, .png or .pdf",
        ),
        ("--report", "DIR", Path, "write a page with figure and data into a folder of its own"),
        ("--store", "DIR", Path, f"where finished ones of several scenes are kept, for a run that goes on ({KEPT})"),
    )
    comparing.add_argument(
        "--over", choices=("seconds",), help="draw in --figure how far off each model is over the time that it took"
    )
    add_workers(comparing, "number of processes for several scenes")
    comparing.set_defaults(command=compare)


def compare(arguments: argparse.Namespace) -> Exit:
    """Select the cheapest model of a scene that meets the tolerance, and say why."""
    scenes = [scene for name in arguments.scene for scene in _scenes_of(name, arguments)]
    problems = [_problem(scene, arguments) for scene, _ in scenes]
    _check_files(problems, arguments)
    for reader in _model_readers(arguments):
        problems = reader.with_models(problems, arguments.models_from)
    notes = dict[str, None]()
    for problem in problems:
        for quantity in problem.quantities:
            models, _ = problem.listed_and_solvable(
                quantity
            )  # or an error, before anything is measured, written or solved
            notes |= dict.fromkeys(label_notes(models, arguments.models) if arguments.models else ())
    for note in notes:
        print(f"note: {note}", file=sys.stderr)
    swept = [sweep for (_, sweep), problem in zip(scenes, problems, strict=True) for _ in problem.quantities]
    comparisons = (
        _solve_and_report(problems, swept, arguments)
        if arguments.report
        else _solve_and_write(problems, swept, arguments)
    )
    return Exit.MET if all(comparison.met for comparison in comparisons) else Exit.NOT_CONVERGED


def _scenes_of(name: str, arguments: argparse.Namespace) -> list[tuple[Scene, Swept | None]]:
    """With the value of a sweep, which belongs to the file: two files may have scenes of one name."""
    if arguments.sweep is None:
        return [(_for_compare(load_scene(name), name), None)]
    key, values = arguments.sweep
    varied = [_for_compare(load_varied(name, key, value), name) for value in values]
    title = varied[0].name.removesuffix(f", {key.split('.')[-1]} = {values[0]}")
    scene = title if len(arguments.scene) == 1 else f"{title}, {printable(name)}"
    return list(zip(varied, swept_values(key, values, scene), strict=True))


def _for_compare(scene: Scene, name: str) -> Scene:
    """The scene of a file without what `compare` has no need of; a ValueError begins with the name of the file."""
    with errors_of_file(path_of(name)):
        return scene.for_compare()


def _problem(scene: Scene, arguments: argparse.Namespace) -> SceneProblem:
    """The problem of a scene: quantities, tolerance, seed and models as the arguments have them."""
    quantities, seed = tuple(arguments.quantity or quantities_of(scene)[:1]), arguments.seed or 0
    names = () if arguments.models is None else arguments.models or ("",)
    timed = arguments.all or arguments.over is not None
    return SceneProblem(scene, quantities, arguments.tolerance, seed, timed, names, realisations=arguments.realisations)


def _model_readers(arguments: argparse.Namespace) -> list[Any]:
    """What reads the models of a file or of an installed package, where one is given."""
    return [reader for reader in objects_of_houses("models_from") if getattr(arguments, reader.name) is not None]


def _exports(arguments: argparse.Namespace) -> list[tuple[Export, Path]]:
    """Files of houses that are asked for."""
    exports: list[Export] = objects_of_houses("exports")
    return [(export, path) for export in exports if (path := getattr(arguments, export.name)) is not None]


def _store_of(arguments: argparse.Namespace) -> Path:
    place: Path = arguments.store or arguments.report or STORE
    return place


def _check_files(problems: Sequence[SceneProblem], arguments: argparse.Namespace) -> None:
    """Raises ValueError before anything is solved."""
    read = {file: "the scene reads" for name in arguments.scene for file in files_of(name)}
    for reader in _model_readers(arguments):
        reader.check(arguments.models_from)
        read[Path(arguments.models_from)] = f"is {reader.option}"
    check_places(arguments, read)
    quantities = list(dict.fromkeys(name for problem in problems for name in problem.quantities))
    if arguments.over is not None and (arguments.figure is None or not (arguments.all or arguments.models)):
        raise ValueError("--over seconds must have --figure, and --all or --models, which say what is solved and timed")
    if arguments.over is not None and (len(problems) > 1 or len(quantities) > 1):
        raise ValueError(f"--over seconds is for one quantity of one scene, got {len(problems) * len(quantities)}")
    for export, _ in _exports(arguments):
        export.check(quantities)


def _solve_and_write(
    problems: Sequence[SceneProblem], swept: Sequence[Swept | None], arguments: argparse.Namespace
) -> list[Comparison]:
    """Solve, print, and write the files that are asked for."""
    for reader in _model_readers(arguments):
        problems = reader.measured(problems, arguments.models_from, _store_of(arguments))
    solved = _solve(problems, arguments)
    comparisons = [replace(comparison, swept=sweep) for comparison, sweep in zip(solved, swept, strict=True)]
    lines_of = in_full if arguments.verbose else in_short
    if len(problems) == 1:
        (problem,) = problems
        text = f"{findings(comparisons, lines_of)}\n{facts(problem.scene, problem.quantities)}"
    else:
        text = summary(comparisons)
    print(coloured(printable(text, lines=True)))
    _write(comparisons, arguments)
    return comparisons


def _solve(problems: Sequence[SceneProblem], arguments: argparse.Namespace) -> list[Comparison]:
    """What is asked of one scene, and notes on it, are printed before it is solved."""
    if len(problems) == 1:
        (problem,) = problems
        print(printable(heading(problem.scene, problem.quantities, problem.parsed_tolerance), lines=True), flush=True)
        return list(problem.compared(_announce).values())
    arguments.keeps = True
    with progress_of("scenes", arguments.workers) as progress:
        engine = Engine(workers=arguments.workers, store=_store_of(arguments) / "realisations", progress=progress)
        return compare_scenes(problems, engine)


def _solve_and_report(
    problems: Sequence[SceneProblem], swept: Sequence[Swept | None], arguments: argparse.Namespace
) -> list[Comparison]:
    """Solve, print and write as without --report, and write a page into a folder of its own."""
    from validation.advice.page import PAGE, files_of_comparison  # which takes half a second to import
    from validation.report.folder import COMPARISON, Folder
    from validation.report.provenance import machine, provenance

    with Folder(arguments.report, kind=COMPARISON, option="--report") as folder:
        comparisons = _solve_and_write(problems, swept, arguments)
        about = provenance("compare", {"compare": problems[0].seed}, Engine(workers=arguments.workers), {}, machine())
        folder.replace(files_of_comparison(comparisons, about))
    print(printable(f"report: {arguments.report / PAGE}"))
    return comparisons


def _announce(model: SceneModel) -> None:
    """Name a model whose solve takes a second or more, before it begins."""
    if model.cost().seconds >= 1:
        print(
            f"solving {printable(model.name)}, about {format_seconds(model.cost().seconds)}",
            file=sys.stderr,
            flush=True,
        )


def _write(comparisons: list[Comparison], arguments: argparse.Namespace) -> None:
    """The files that are asked for, each of them whole; of several scenes a list, and a column for the scene."""
    if arguments.json or arguments.csv or _exports(arguments):
        _write_data(comparisons, arguments)
    if arguments.figure is not None:
        from validation.advice.figure import figure_over_seconds, to_figure  # which takes half a second to import

        form = arguments.figure.suffix[1:]
        picture = figure_over_seconds(comparisons[0], form) if arguments.over else to_figure(comparisons, form=form)
        write_output(arguments.figure, picture)


def _write_data(comparisons: list[Comparison], arguments: argparse.Namespace) -> None:
    # imported where a file is asked for
    from validation.advice.exported import csv_table, to_json_of
    from validation.analysis.contents import as_csv

    if arguments.json:
        write_output(arguments.json, to_json_of(comparisons).encode())
    if arguments.csv:
        write_output(arguments.csv, as_csv(csv_table(comparisons)))
    for export, path in _exports(arguments):
        write_output(path, export.written(comparisons))


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
