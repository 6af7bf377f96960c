"""Print a scene that comes with this package, to start one of your own from."""

import argparse

from validation.report.commands.arguments import Exit
from validation.scenes.bundled import bundled, path_of


def describe(printing: argparse.ArgumentParser) -> None:
    printing.add_argument(
        "name", metavar="NAME", choices=bundled(), help=f"one of {', '.join(bundled())}; as `scene sphere > my.toml`"
    )
    printing.set_defaults(command=scene)


def scene(arguments: argparse.Namespace) -> Exit:
    print(path_of(arguments.name).read_text(encoding="utf-8"), end="")
    return Exit.MET
