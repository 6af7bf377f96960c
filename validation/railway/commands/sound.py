"""Write the contact force of a wheel on a rail as sounds, one a model, and their levels."""

import argparse
import math
import textwrap
from pathlib import Path

from validation.analysis.contents import as_csv, as_json
from validation.analysis.escapes import printable
from validation.engine.engine import Engine
from validation.engine.progress import progress_of
from validation.railway.cases.rail_sound import SOUNDING, RailSound, RailSoundResult, run
from validation.railway.cases.rail_sound_study import sounds_of, what_is_heard
from validation.railway.scenes.rail import RailScene
from validation.report.commands.arguments import Exit, add_workers, at_least, comma_separated
from validation.report.folder import SOUND, Folder
from validation.report.sounds import wavs
from validation.scenes.description import description_lines
from validation.scenes.load import load_scene

WHOLE = 2.0
"""Seconds that a file lasts at the least: shorter strips are repeated."""
COLUMNS = 100
"""Of a terminal."""


def describe(sounding: argparse.ArgumentParser) -> None:
    sounding.add_argument("scene", metavar="SCENE", help='a TOML file of a wheel on a rail, or "rail"')
    sounding.add_argument(
        "--out", type=Path, default=Path("sounds"), metavar="DIR", help="folder of the files (default: sounds)"
    )
    choices = f"some of {', '.join(SOUNDING)} (default: all)"
    sounding.add_argument(
        "--models", type=comma_separated(SOUNDING), default=tuple(SOUNDING), metavar="A,B", help=choices
    )
    sounding.add_argument(
        "--seconds",
        type=_seconds,
        default=0.5,
        metavar="S",
        help="time over the strip; files of less than 2 s repeat it (default: 0.5; boundary elements compute for about "
        "100 s a second at 80 km/h)",
    )
    sounding.add_argument("--seed", type=at_least(0), default=0, metavar="S", help="of the rough strip (default: 0)")
    add_workers(sounding)
    sounding.set_defaults(command=sound)


def sound(arguments: argparse.Namespace) -> Exit:
    """Write a WAV a model, levels.csv and sounds.json."""
    scene = load_scene(arguments.scene)
    if not isinstance(scene, RailScene):
        raise ValueError(f"sound is for a wheel on a rail, as the scene rail, got {scene.name}")
    case = RailSound(
        rail=scene,
        seconds=arguments.seconds,
        repeats=math.ceil(WHOLE / arguments.seconds - 1e-9),
        models=arguments.models,
        seed=arguments.seed,
    )
    case.strip(case.cells[1])  # what cannot be drawn is refused before the first line
    print("\n".join([scene.name, *description_lines(scene), *_assumed(case), ""]), flush=True)
    with Folder(arguments.out, kind=SOUND) as folder:
        with progress_of("sound", arguments.workers) as progress:
            result = run(case, Engine(workers=arguments.workers, progress=progress))
        folder.replace(files_of(result))
    wrapped = [line for sentence in what_is_heard(result) for line in textwrap.wrap(sentence, COLUMNS)]
    print("\n".join([*wrapped, "", *_lines(result)]))
    print(printable(f"sounds: {arguments.out}"))
    return Exit.MET


def files_of(result: RailSoundResult) -> dict[str, bytes]:
    """By their names: sounds, levels in one-third octaves, and all that is to be known about them."""
    sounds, table = sounds_of(result), result.sounds_table()
    rows = [
        dict(zip(table.columns, row, strict=True)) | result.former_levels(model)
        for model, row in zip(result.case.sounding, zip(*table.columns.values(), strict=True), strict=True)
    ]
    files = {f"{name}.wav": contents for name, contents in wavs(sounds, result.samples_table()).items()}
    about = {
        "scene": result.case.rail.name,
        "heard": sounds.heard,
        "full scale [N]": sounds.full_scale,
        "samples a second": sounds.rate,
        "period [s]": result.case.seconds,
        "repeats": sounds.repeats,
        "seed": result.case.seed,
        "band [Hz]": list(result.case.band),
        "sounds": [{"file": name, **row} for name, row in zip(files, rows, strict=True)],
    }
    return {**files, "levels.csv": as_csv(result.bands_table()), "sounds.json": as_json(about)}


def _assumed(case: RailSound) -> list[str]:
    lines = ["note: the strip is drawn at random with the levels of the scene"]
    if case.rail.lateral_structure is None:
        lines.append("note: the ground is taken as isotropic, since rail.lateral_structure is left out")
    if "geike" in case.models and len(case.sounding) < len(case.models):
        lines.append(f"note: Geike's rule is for isotropic ground, here it is {case.across}: no sound of it")
    return lines


def _lines(result: RailSoundResult) -> list[str]:
    """A row a model."""
    table = result.sounds_table()
    levels = zip(result.case.sounding, table["level [dB re 1 N]"], strict=True)
    return [f"{'model':32s} {'level re 1 N':>12s}", *(f"{model:32s} {level:9.1f} dB" for model, level in levels)]


def _seconds(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a number of seconds, got {word!r}") from None
    if not 0 < value <= 60:
        raise argparse.ArgumentTypeError(f"must be above 0 and 60 at the most, got {word}")
    return value
