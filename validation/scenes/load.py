"""The scene of a file: a sphere, a punch, a wheel on rough ground with or without a mass, or one on a rail."""

import difflib
import os
from collections.abc import Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

from validation.analysis.escapes import printable
from validation.engine.street import objects_of_houses
from validation.scenes.bundled import bundled, path_of
from validation.scenes.indentation import IndentationScene
from validation.scenes.material import material_of
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.measured_surface import heights_of, measured
from validation.scenes.reader import Reader, errors_of_file, table, tables_of, value_of_one_key, values
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import roughness_of
from validation.scenes.scene import Scene

BODIES, GROUNDS = ("sphere", "punch", "wheel"), ("roughness", "heights")
"""Tables of bodies, of which a scene has one, and of roughness, of which it has one at the most."""
LOADS = ("load", "pressure")
"""Keys of which a punch has one: its force, or the mean pressure on its face."""
OTHER_GROUNDS = ("roughness", "levels", "lines", "lateral_structure", "lateral_ratio", "across", "alpha")
"""Keys of a body or a rail that heights stand in place of."""


def load_scene(scene: str | Path, *, heights: object = None) -> Scene:
    """Scene of a TOML file, or the shipped scene of that name.

    Parameters
    ----------
    scene : str or Path
        Path of a scene file, or the name of a shipped scene: "rail", "rolling_wheel", "rough_punch", "rough_wheel",
        "sphere" or "table_14_1". A name has no folder and no ".toml".
    heights : object, optional
        Measured heights in place of the roughness of the file: MeasuredHeights, or whatever `measured` takes, such as a
        Topography of SurfaceTopography.

    Returns
    -------
    IndentationScene, RollingScene or RailScene
        A sphere or punch, or a wheel, by the body that the file has a table of. A wheel on a rail has a crown,
        roughness as levels or lines, or another key that no other wheel has. A wheel that moves has a track where the
        file has ``[simulation]``.

    Raises
    ------
    ValueError
        If no shipped scene has the name, or a value of the file is missing, unknown or out of range; the message
        names it.
    OSError
        If the file cannot be read.

    Examples
    --------
    >>> scene = validation.load_scene("sphere")
    >>> scene.name, scene.load
    ('Smooth sphere', 4905.0)
    """
    path = path_of(scene)
    tables = tables_of(path)
    ground = heights if isinstance(heights, MeasuredHeights | None) else measured(heights)
    with errors_of_file(path):
        return _read_scene(tables if ground is None else _replace_roughness(tables, ground), path.parent)


def load_scene_with_track(scene: str | Path) -> RollingScene:
    """Scene of a wheel that rolls along a track in time, as `load_scene`; ValueError for any other."""
    path = path_of(scene)
    tables = tables_of(path)
    with errors_of_file(path):
        for reader in objects_of_houses("scene"):
            if reader.reads(tables):
                raise ValueError(f"wheel and rail must be those of a dynamic wheel, got {reader.what}")
        return _scene_with_track(tables)


def files_of(scene: str | Path) -> tuple[Path, ...]:
    """The file of a scene, and the files beside it that its values name."""
    path = path_of(scene)
    candidates = (path.parent / text for text in _texts(tables_of(path)))
    # unlike that of a Path, which raises for a text that is too long for a name
    return path, *(file for file in candidates if os.path.isfile(file))  # noqa: PTH113


def _texts(value: object) -> Iterator[str]:
    """All texts in the tables of a file."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict | list):
        for entry in value.values() if isinstance(value, dict) else value:
            yield from _texts(entry)


def load_varied(scene: str | Path, key: str, value: str) -> Scene:
    """The scene of a file with another value of one key, as "wheel.load" and "60 kN", and both in its name.

    value: as in a scene file, a text without its quotation marks. Raises ValueError, too, for a key that is no value of
    the file.
    """
    path = path_of(scene)
    tables = tables_of(path)
    with errors_of_file(path):
        *sections, last = key.split(".")
        inner: Any = tables
        for section in sections:
            inner = inner.get(section)
            if not isinstance(inner, dict):
                raise ValueError(f"{printable(key)} must be a key in a table of the scene, as wheel.load")
        if isinstance(inner.get(last), dict):
            raise ValueError(f"{printable(key)} must be a key with a value, got a table")
        _without_other_name(tables, key)
        inner[last] = _number_or_text(value)
        tables["name"] = f"{tables.get('name')}, {last} = {value}"
        return _read_scene(tables, path.parent)


def _without_other_name(tables: dict[str, Any], key: str) -> None:
    """Remove the former name of a key, or today's beside a former one, which would be a second value of the same."""
    for reader in objects_of_houses("scene"):
        for names in reader.renamed.items():
            for name in names if key in names else ():
                table_name, _, other = name.partition(".")
                tables[table_name].pop(other, None)


def _number_or_text(text: str) -> object:
    """The value of a text as TOML would have it: a whole number, another number, or the text itself."""
    for read in (int, float):
        with suppress(ValueError):
            return read(text)
    return text


def _replace_roughness(tables: dict[str, Any], heights: MeasuredHeights) -> dict[str, Any]:
    """The tables of a scene with these heights in place of their roughness."""
    if "wheel" in tables:
        rail = tables.get("rail")
        rest = {key: value for key, value in tables.items() if key != "simulation"}
        return {**rest, "rail": _replace_roughness(rail if isinstance(rail, dict) else {}, heights)}
    return {**{key: value for key, value in tables.items() if key not in OTHER_GROUNDS}, "heights": heights}


def _read_scene(tables: dict[str, Any], folder: Path) -> Scene:
    """The scene by its body and, of a wheel, by the first house that reads such tables; folder: of files it names."""
    if not any(body in tables for body in BODIES):
        for table_name in tables:
            if meant := difflib.get_close_matches(table_name.casefold(), BODIES, 1):
                raise ValueError(f"{printable(table_name)} is unknown, as: [{meant[0]}]")
    value_of_one_key(tables, "a scene", BODIES)
    body = next(name for name in BODIES if name in tables)
    if body != "wheel":
        return _indentation_scene(body, tables, folder)
    for reader in objects_of_houses("scene"):
        if reader.reads(tables):
            scene: Scene = reader.scene_of(tables, folder)
            return scene
    wheel, rail = tables["wheel"], tables.get("rail")
    moving = isinstance(wheel, dict) and "mass" in wheel
    if moving and "simulation" in tables and not (isinstance(rail, dict) and "heights" in rail):
        return _scene_with_track(tables)
    return _rolling_scene(tables, moving, folder)


def bundled_with_track() -> tuple[str, ...]:
    """Names of the shipped scenes of a wheel that rolls along a track in time."""
    return tuple(name for name in bundled() if "simulation" in tables_of(path_of(name)))


def bundled_for_compare() -> tuple[str, ...]:
    """Names of the shipped scenes that `compare` takes: all but those of a rough wheel."""
    return tuple(name for name in bundled() if "roughness" not in tables_of(path_of(name)).get("wheel", {}))


def _indentation_scene(body: str, tables: dict[str, Any], folder: Path) -> IndentationScene:
    """A sphere or a punch; a mean pressure becomes a load, F = p L^2."""
    size, loads = ("radius", LOADS[:1]) if body == "sphere" else ("side", LOADS)
    readers: dict[str, Reader] = {
        **values("name"),
        body: partial(table, values(size, *loads), LOADS if len(loads) > 1 else ()),
        "material": material_of,
        **_ground_readers(folder),
    }
    entries = table(readers, GROUNDS, "", tables)
    load: float = value_of_one_key(entries[body], body, loads)
    return IndentationScene(
        name=entries["name"],
        shape="sphere" if body == "sphere" else "punch",
        size=entries[body][size],
        load=load * entries[body][size] ** 2 if "pressure" in entries[body] else load,
        modulus=entries["material"].modulus,
        material=entries["material"],
        ground=value_of_one_key(entries, "a scene", GROUNDS, least=0),
    )


def _rolling_scene(tables: dict[str, Any], moving: bool, folder: Path) -> RollingScene:
    """A wheel on rough ground; moving: whether it has a mass and a speed."""
    wheel = values("radius", "load", *(("mass", "speed") if moving else ()), "damping")
    readers: dict[str, Reader] = {
        **values("name"),
        "wheel": partial(table, wheel, ("damping",)),
        "material": material_of,
        "rail": partial(table, _ground_readers(folder), GROUNDS),
    }
    entries = table(readers, (), "", tables)
    ground, material = value_of_one_key(entries.pop("rail"), "rail", GROUNDS), entries["material"]
    return RollingScene(ground=ground, modulus=material.modulus, **entries.pop("wheel"), **entries)


ROUGH: dict[str, Reader] = {"roughness": roughness_of}
WHEEL = values("radius", "mass", "load", "speed", "damping") | ROUGH
WITH_TRACK: dict[str, Reader] = {
    **values("name"),
    "wheel": partial(table, WHEEL, ("damping", "roughness")),
    "material": material_of,
    "rail": partial(table, ROUGH, tuple(ROUGH)),
    "simulation": partial(table, values("distance", "springs"), ()),
}
"""How each value of the file of a wheel with a track is read."""


def _scene_with_track(tables: dict[str, Any]) -> RollingScene:
    """A wheel that rolls along a track in time; rail and wheel may both be rough."""
    entries = table(WITH_TRACK, ("rail",), "", tables)
    wheel, rail = entries["wheel"], entries.get("rail", {})
    return RollingScene(
        name=entries["name"],
        material=entries["material"],
        ground=rail.get("roughness"),
        wheel=wheel.pop("roughness", None),
        **wheel,
        **entries["simulation"],
    )


def _ground_readers(folder: Path) -> dict[str, Reader]:
    """Readers of the tables of roughness; folder: that of the files which they name."""
    return {"roughness": roughness_of, "heights": partial(heights_of, folder=folder)}
