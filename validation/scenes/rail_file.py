"""The scene of a rail from the tables of a file, in the units of the field."""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from mdr.checks import positive
from validation.scenes.height_files import heights_of, read_heights, unit_of
from validation.scenes.level_files import curve, read_levels
from validation.scenes.material import material_of
from validation.scenes.measured import MeasuredHeights
from validation.scenes.measured_lines import MeasuredLines
from validation.scenes.printable import shortened
from validation.scenes.profile_files import read_profile
from validation.scenes.profiled_rail import ProfiledRail
from validation.scenes.rail import Across, RailScene
from validation.scenes.reader import FORCE, LENGTH, MASS, NUMBER, SPEED, WHOLE, Reader, nonblank_text, table
from validation.scenes.roughness_levels import RoughnessLevels
from validation.scenes.transverse_profile import TransverseProfile, both_together, fitted_radius
from validation.scenes.units import in_unit, quantity

OF_WHEEL = ("transverse_radius", "profile", "axle_load", "levels", "lines")
OF_RAIL = ("crown_radius", "profile", "across", "alpha", "levels", "lines")
"""What stands in the scene of a rail alone, of its wheel and of its rail."""
GROUNDS = ("levels", "lines", "heights")
SHAPES_OF_RAIL, SHAPES_OF_WHEEL = ("crown_radius", "profile"), ("transverse_radius", "profile")
"""Across the track."""


def is_rail(tables: dict[str, Any]) -> bool:
    """Whether the tables of a file are those of a wheel on a rail of two radii."""
    wheel, rail = tables.get("wheel"), tables.get("rail")
    return (isinstance(wheel, dict) and any(key in wheel for key in OF_WHEEL)) or (
        isinstance(rail, dict) and any(key in rail for key in OF_RAIL)
    )


def rail_of(tables: dict[str, Any], folder: Path) -> RailScene:
    """The scene in the tables of a file, other files beside it. Raises ValueError that names the key."""
    ground: dict[str, Reader] = {
        "levels": partial(_levels, folder=folder),
        "lines": partial(_lines, folder=folder),
        "heights": partial(heights_of, folder=folder),
    }
    shape: dict[str, Reader] = {"profile": partial(_profile, folder=folder)}
    on_wheel = shape | {key: ground[key] for key in ("levels", "lines")}
    on_rail = shape | ground
    readers: dict[str, Reader] = {
        "name": nonblank_text,
        "material": material_of,
        "wheel": partial(table, WHEEL | on_wheel, (*WHEEL, *on_wheel)),
        "rail": partial(table, RAIL | on_rail, (*RAIL, *on_rail)),
    }
    found = table(readers, (), "", tables)
    wheel, rail, material = found["wheel"], found["rail"], found["material"]
    roughness, of_roughness = _both(_one(rail, "rail", GROUNDS), _one(wheel, "wheel", GROUNDS, least=0))
    load, of_load = _load(wheel)
    given: dict[str, Any] = {
        "name": found["name"],
        "radius": _radius(wheel),
        "load": load,
        "modulus": material.modulus,
        "material": material,
        "roughness": roughness,
        "across": _one(rail, "rail", ("across", "alpha"), least=0),
        "notes": (*of_load, *of_roughness),
        **{key: wheel[key] for key in ("speed", "mass") if key in wheel},
    }
    of_rail = _one(rail, "rail", SHAPES_OF_RAIL, least=0)
    of_wheel = _one(wheel, "wheel", SHAPES_OF_WHEEL, least=0)
    if not any(isinstance(body, TransverseProfile) for body in (of_rail, of_wheel)):
        return RailScene(**given, crown_radius=of_rail, transverse_radius=of_wheel)
    key = "rail" if isinstance(of_rail, TransverseProfile) else "wheel"
    with _key_in_errors(key):
        profile = _together(of_rail, of_wheel)
        fitted_radius(profile, along=given["radius"], modulus=given["modulus"], load=load)
    return ProfiledRail(**given, profile=profile)


def _one(given: dict[str, Any], name: str, keys: tuple[str, ...], *, least: int = 1) -> Any:
    """The value of one of these keys. ValueError for more of them, or fewer than the least."""
    found = [key for key in keys if key in given]
    if not least <= len(found) <= 1:
        raise ValueError(f"{name} must have one of {', '.join(keys)}, got {' and '.join(found) or 'none'}")
    return given[found[0]] if found else None


def _radius(wheel: dict[str, Any]) -> float:
    one: float = _one(wheel, "wheel", ("radius", "diameter"))
    return one / 2 if "diameter" in wheel else one


def _together(*bodies: TransverseProfile | float | None) -> TransverseProfile:
    """Of rail and wheel, of which one has a profile; the other may have a radius, or be straight."""
    curvature = sum(1 / body for body in bodies if isinstance(body, float))
    return both_together([body for body in bodies if isinstance(body, TransverseProfile)], curvature)


def _load(wheel: dict[str, Any]) -> tuple[float, tuple[str, ...]]:
    """Of one wheel, and what was assumed of an axle."""
    one: float = _one(wheel, "wheel", ("load", "axle_load"))
    wheels = wheel.get("wheels_per_axle")
    if "load" in wheel:
        if wheels is not None:
            raise ValueError("wheel.wheels_per_axle belongs to wheel.axle_load, got it beside wheel.load, of one wheel")
        return one, ()
    if wheels is None:
        raise ValueError(
            "wheel.wheels_per_axle is missing: wheel.axle_load must be shared out among wheels, as wheels_per_axle = 2"
        )
    loads = in_unit(one, "force"), in_unit(one / wheels, "force")
    return one / wheels, (f"the axle load of {loads[0]} is shared by {wheels} wheels: {loads[1]} each.",)


def _both(rail: Any, wheel: Any) -> tuple[Any, tuple[str, ...]]:
    """Roughness of rail and wheel together, their energies added, and what is missing of it."""
    if wheel is None:
        return rail, ()
    if isinstance(rail, MeasuredHeights):
        raise ValueError(
            "wheel.levels must be left out beside rail.heights: levels have no phases and add to no heights"
        )
    levels, more = (each.levels if isinstance(each, MeasuredLines) else each for each in (rail, wheel))
    missing = [f"{1000 * w:g}" for w in levels.bands.nominal if w not in more.bands.nominal]
    note = f"the roughness of the wheel is not known at {', '.join(missing)} mm: that of the rail stands alone there."
    return levels + more, (note,) if missing else ()


def _levels(name: str, given: object, *, folder: Path) -> RoughnessLevels:
    """Of a bundled curve or of a file, so many decibels more, between two wavelengths."""
    readers: dict[str, Reader] = {
        "curve": nonblank_text,
        "file": nonblank_text,
        "offset": _decibels,
        "longest": LENGTH,
        "shortest": LENGTH,
    }
    found = table(readers, tuple(readers), name, given)
    _one(found, name, ("curve", "file"))
    if "file" in found:
        levels = read_levels(f"{name}.file", folder / found["file"])
    with _key_in_errors(name):
        levels = curve(found["curve"]) if "curve" in found else levels
        levels = levels.within(found.get("longest"), found.get("shortest"))
        return levels.raised(found["offset"]) if "offset" in found else levels


def _lines(name: str, given: object, *, folder: Path) -> MeasuredLines:
    """Of a file whose columns are lines along the rail."""
    readers: dict[str, Reader] = {
        "file": nonblank_text,
        "spacing": LENGTH,
        "unit": unit_of,
        "positions": _positions,
        "longest": LENGTH,
        "shortest": LENGTH,
    }
    found = table(readers, ("unit", "positions", "longest", "shortest"), name, given)
    height = np.atleast_2d(read_heights(f"{name}.file", folder / found.pop("file"))) * found.pop("unit", 1.0)
    with _key_in_errors(name):
        lines = MeasuredLines(height=height.T if len(height) == 1 else height, **found)
        if not lines.height.any():
            raise ValueError("file must have heights, got zeros alone")
        _ = lines.levels  # heights in a wrong unit are refused here, by their levels
        return lines


@contextmanager
def _key_in_errors(name: str) -> Iterator[None]:
    """Put the key of a scene file in front of the sentence of a ValueError."""
    try:
        yield
    except ValueError as problem:
        raise ValueError(f"{name}.{problem}") from None


def _profile(name: str, given: object, *, folder: Path) -> TransverseProfile:
    """Of a file beside the scene."""
    return read_profile(name, folder / nonblank_text(name, given))


def _decibels(name: str, given: object) -> float:
    """A number, or a text with its unit."""
    return quantity(name, given, "level") if isinstance(given, str) else NUMBER(name, given)


def _positions(name: str, given: object) -> list[float]:
    if not isinstance(given, list):
        raise ValueError(f'{name} must be a list of lengths, as ["-10 mm", "0 mm"], got {shortened(given)}')
    return [quantity(f"{name}[{i}]", one, "length") for i, one in enumerate(given)]


def _across(name: str, given: object) -> Across:
    if isinstance(given, str):
        if given not in ("ridges", "isotropic"):
            raise ValueError(f'{name} must be "ridges", "isotropic" or a number alpha, got {shortened(given)}')
        return given  # type: ignore[return-value]  # one of the two words
    return _alpha(name, given)


def _alpha(name: str, given: object) -> float:
    return positive(name, NUMBER(name, given))


WHEEL: dict[str, Reader] = {
    "radius": LENGTH,
    "diameter": LENGTH,
    "transverse_radius": LENGTH,
    "load": FORCE,
    "axle_load": FORCE,
    "wheels_per_axle": WHOLE,
    "speed": SPEED,
    "mass": MASS,
}
RAIL: dict[str, Reader] = {"crown_radius": LENGTH, "across": _across, "alpha": _alpha}
"""How each value of a scene file is read."""
