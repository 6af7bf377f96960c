"""Select the cheapest model of a scene that meets a tolerance."""

import argparse
import sys

from validation.commands.arguments import at_least
from validation.commands.exit_status import Exit
from validation.scenes.load import bundled_for_compare, load_scene
from validation.selection.compare import QUANTITIES
from validation.selection.compare import compare as compared
from validation.selection.hierarchy import ContactModel
from validation.selection.summary import format_seconds, summary


def describe(comparing: argparse.ArgumentParser) -> None:
    comparing.add_argument(
        "scene",
        metavar="SCENE",
        help=f"a TOML file, or the name of an example scene ({', '.join(bundled_for_compare())})",
    )
    comparing.add_argument(
        "--tolerance", type=_tolerance, default=0.1, metavar="T", help='"5%%", "0.05" or "0.4 dB" (default: 10%%)'
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
    comparing.set_defaults(command=compare)


def compare(arguments: argparse.Namespace) -> Exit:
    """Select the cheapest model of a scene that meets the tolerance, and say why."""
    scene = load_scene(arguments.scene)
    seed = arguments.seed or 0
    found = compared(scene, quantity=arguments.quantity, tolerance=arguments.tolerance, seed=seed, callback=_announce)
    print(summary(found))
    return Exit.MET if found.met else Exit.NOT_CONVERGED


def _announce(model: ContactModel) -> None:
    """Name a model whose solve takes a second or more, before it begins."""
    if model.cost().seconds >= 1:
        print(f"solving {model.name}, about {format_seconds(model.cost().seconds)}", file=sys.stderr, flush=True)


def _tolerance(word: str) -> float:
    """A relative one: in per cent, as a ratio, or in decibels of an amplitude."""
    text, scale = word.strip(), 1.0
    decibels = text.endswith("dB")
    if text.endswith("%"):
        text, scale = text[:-1], 0.01
    elif decibels:
        text = text[:-2]
    try:
        value = scale * float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f'must be as "5%", "0.05" or "0.4 dB", got {word!r}') from None
    relative = 10 ** (value / 20) - 1 if decibels else value
    if not 0 < relative <= 1:
        raise argparse.ArgumentTypeError(f"must be above zero and no more than 100 %, or 6 dB, got {word!r}")
    return relative
