"""Select the cheapest model of a scene that meets a tolerance."""

import argparse
import sys

from validation.commands.arguments import at_least
from validation.commands.exit_status import Exit
from validation.scenes.load import bundled_for_compare, load_scene
from validation.selection.compare import QUANTITIES, check_quantity, quantities_of
from validation.selection.compare import compare as compared
from validation.selection.hierarchy import ContactModel
from validation.selection.summary import findings, format_seconds, heading
from validation.selection.tolerance import tolerance_of


def describe(comparing: argparse.ArgumentParser) -> None:
    comparing.add_argument(
        "scene",
        metavar="SCENE",
        help=f"a TOML file, or the name of an example scene ({', '.join(bundled_for_compare())})",
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
    comparing.set_defaults(command=compare)


def compare(arguments: argparse.Namespace) -> Exit:
    """Select the cheapest model of a scene that meets the tolerance, and say why."""
    scene, seed = load_scene(arguments.scene), arguments.seed or 0
    quantity = arguments.quantity or quantities_of(scene)[0]
    check_quantity(scene, quantity)
    print(heading(scene, quantity, tolerance_of(arguments.tolerance)), flush=True)
    found = compared(
        scene,
        quantity=quantity,
        tolerance=arguments.tolerance,
        seed=seed,
        solve_all=arguments.all,
        callback=_announce,
    )
    print(findings(found))
    return Exit.MET if found.met else Exit.NOT_CONVERGED


def _announce(model: ContactModel) -> None:
    """Name a model whose solve takes a second or more, before it begins."""
    if model.cost().seconds >= 1:
        print(f"solving {model.name}, about {format_seconds(model.cost().seconds)}", file=sys.stderr, flush=True)


def _tolerance(word: str) -> str:
    try:
        tolerance_of(word)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error).removeprefix("tolerance ")) from None
    return word
