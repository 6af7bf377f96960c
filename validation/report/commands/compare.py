"""Select the cheapest model of a scene that meets a tolerance."""

import argparse
import sys
from pathlib import Path

from validation.analysis.contents import as_csv
from validation.analysis.evidence import Table
from validation.engine.files import write_whole
from validation.report.commands.arguments import at_least
from validation.report.commands.exit_status import Exit
from validation.scenes.load import Scene, bundled_for_compare, load_scene, load_varied
from validation.scenes.printable import printable
from validation.selection.compare import QUANTITIES, Comparison, check_quantity, quantities_of
from validation.selection.compare import compare as compared
from validation.selection.exported import levels_of_models, to_json
from validation.selection.filter_table import filter_table
from validation.selection.hierarchy import ContactModel
from validation.selection.several import overview, selected_of_several, table_of_several
from validation.selection.summary import findings, format_seconds, heading
from validation.selection.tolerance import tolerance_of

FIGURES = (".svg", ".png", ".pdf")


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
    comparing.add_argument("--all", action="store_true", help="solve all models, and print them side by side")
    for name, what in (
        ("--json", "write the result for other programs; the keys are in reports/README.md"),
        ("--csv", "write a row a number or a band, of each model that was solved"),
        ("--cnossos", "write a contact filter in the columns of the table of CNOSSOS-EU, as CSV"),
        ("--figure", "draw the models that were solved, in a .svg, .png or .pdf"),
    ):
        comparing.add_argument(name, type=Path, metavar="FILE", help=what)
    comparing.set_defaults(command=compare)


def compare(arguments: argparse.Namespace) -> Exit:
    """Select the cheapest model of a scene that meets the tolerance, and say why."""
    scenes = [scene for name in arguments.scene for scene in _scenes_of(name, arguments.sweep)]
    _check_figure(arguments.figure)
    if arguments.cnossos is not None and arguments.quantity not in (None, "contact-filter"):
        raise ValueError(f"--cnossos is for the quantity contact-filter of a rail, got {arguments.quantity}")
    found = [_compared(scene, arguments, alone=len(scenes) == 1) for scene in scenes]
    if len(found) > 1:
        print("\n".join(overview(found)))
    _write(found, arguments)
    return Exit.MET if all(one.met for one in found) else Exit.NOT_CONVERGED


def _scenes_of(name: str, sweep: tuple[str, list[str]] | None) -> list[Scene]:
    if sweep is None:
        return [load_scene(name)]
    key, values = sweep
    return [load_varied(name, key, value) for value in values]


def _compared(scene: Scene, arguments: argparse.Namespace, *, alone: bool) -> Comparison:
    """alone: whether all about it is printed, what was understood before it is solved."""
    quantity = arguments.quantity or quantities_of(scene)[0]
    check_quantity(scene, quantity)
    if alone:
        print(heading(scene, quantity, tolerance_of(arguments.tolerance)), flush=True)
    found = compared(
        scene,
        quantity=quantity,
        tolerance=arguments.tolerance,
        seed=arguments.seed or 0,
        solve_all=arguments.all,
        callback=_announce,
    )
    if alone:
        print(findings(found))
    return found


def _announce(model: ContactModel) -> None:
    """Name a model whose solve takes a second or more, before it begins."""
    if model.cost().seconds >= 1:
        print(f"solving {model.name}, about {format_seconds(model.cost().seconds)}", file=sys.stderr, flush=True)


def _check_figure(path: Path | None) -> None:
    """Raises ValueError before anything is solved."""
    if path is not None and path.suffix not in FIGURES:
        raise ValueError(f"--figure must end in {', '.join(FIGURES)}, got {printable(path)}")


def _write(found: list[Comparison], arguments: argparse.Namespace) -> None:
    """The files that are asked for, each of them whole; of several scenes a list, and a column for the scene."""
    several = len(found) > 1
    if arguments.json is not None:
        objects = ",\n".join(to_json(one).rstrip() for one in found)
        write_whole(arguments.json, (f"[{objects}]\n" if several else f"{objects}\n").encode())
    table = table_of_several(found) if several else levels_of_models(found[0])
    if arguments.csv is not None:
        write_whole(arguments.csv, as_csv(table))
    if arguments.cnossos is not None:
        filters = [filter_table(one) for one in found]
        rows = {name: [value for one in filters for value in one.columns[name]] for name in filters[0].columns}
        write_whole(arguments.cnossos, as_csv(Table("contact-filter", rows)))
    if arguments.figure is not None:
        from validation.report.compared import figure_of_models  # which takes half a second to import

        title = table.name if several else f"{found[0].scene.name}: {table.name}"
        drawn = selected_of_several(table) if several else table
        write_whole(arguments.figure, figure_of_models(title, drawn, arguments.figure.suffix[1:]))


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
