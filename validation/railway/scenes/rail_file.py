"""The scene of a rail from the tables of a file, in the units of the field."""

from functools import partial
from pathlib import Path
from typing import Any

from validation.analysis.escapes import shortened
from validation.engine.former_names import with_current_keys
from validation.railway.scenes.level_files import levels_in
from validation.railway.scenes.measured_lines import MeasuredLines, lines_in
from validation.railway.scenes.rail import ProfiledRail, RailScene
from validation.railway.scenes.transverse_profile import TransverseProfile, both_together, profile_in
from validation.scenes.material import material_of
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.measured_surface import heights_of
from validation.scenes.rail_impedance import read_impedance
from validation.scenes.reader import (
    NUMBER,
    POSITIVE,
    WHOLE,
    Reader,
    errors_of,
    nonblank_text,
    table,
    value_of_one_key,
    values,
)
from validation.scenes.units import in_unit, quantity

OWN = {
    "wheel": ("transverse_radius", "profile", "offset", "axle_load", "transfer", "axles", "levels", "lines"),
    "rail": (
        *("crown_radius", "profile", "lateral_structure", "lateral_ratio", "across", "alpha", "track", "levels"),
        "lines",
    ),
}
"""What stands in the scene of a rail alone."""
RENAMED = {"rail.across": "rail.lateral_structure", "rail.alpha": "rail.lateral_ratio"}
"""Former keys, which are read for one release, and today's."""
GROUNDS = ("levels", "lines", "heights")
Shape = TransverseProfile | float | None
MOST_WHEELS = 8
"""That share the load of an axle; two, but for running gear of many wheels."""
CROWN, FLANGE = 0.026, 0.015
"""Half of the width of a head without its corners [m], 52 mm of 60E1; height that a flange has and a tread has not [m].
"""


def is_rail(tables: dict[str, Any]) -> bool:
    """Whether the tables of a file are those of a wheel on a rail of two radii."""
    return any(isinstance(tables.get(body), dict) and any(key in tables[body] for key in OWN[body]) for body in OWN)


def rail_of(tables: dict[str, Any], folder: Path) -> RailScene:
    """The scene in the tables of a file, other files beside it. Raises ValueError that names the key."""
    tables, notes = with_current_keys(tables, RENAMED)
    of_files = {"profile": profile_in, "levels": levels_in, "lines": lines_in}
    files: dict[str, Reader] = {key: partial(read, folder=folder, notes=notes) for key, read in of_files.items()}
    bodies = {"wheel": WHEEL | files, "rail": RAIL | files | {"heights": partial(heights_of, folder=folder)}}
    readers = {key: partial(table, own, tuple(own)) for key, own in bodies.items()}
    entries = table({**values("name"), "material": material_of, **readers}, (), "", tables)
    wheel, rail, material = entries["wheel"], entries["rail"], entries["material"]
    roughness, of_roughness = _combined(
        value_of_one_key(rail, "rail", GROUNDS), value_of_one_key(wheel, "wheel", GROUNDS, least=0)
    )
    load, of_load = _load(wheel)
    fields: dict[str, Any] = {
        "name": entries["name"],
        "radius": value_of_one_key(wheel, "wheel", ("radius", "diameter")) / (2 if "diameter" in wheel else 1),
        "load": load,
        "modulus": material.modulus,
        "material": material,
        "roughness": roughness,
        "lateral_structure": value_of_one_key(rail, "rail", ("lateral_structure", "lateral_ratio"), least=0),
        "notes": (*of_load, *of_roughness, *notes),
        **{key: wheel[key] for key in ("speed", "mass", "damping", "transfer", "axles") if key in wheel},
        **{key: rail[key] for key in ("track",) if key in rail},
        "impedance": read_impedance(rail.get("impedance", "rigid"), {key: rail[key] for key in BEAM if key in rail}),
    }
    of_rail = value_of_one_key(rail, "rail", ("crown_radius", "profile"), least=0)
    of_wheel = value_of_one_key(wheel, "wheel", ("transverse_radius", "profile"), least=0)
    if not any(isinstance(body, TransverseProfile) for body in (of_rail, of_wheel)):
        if "offset" in wheel:
            raise ValueError("wheel.offset must be left out where neither wheel nor rail has a profile, got it")
        return RailScene(**fields, crown_radius=of_rail, transverse_radius=of_wheel)
    offset = wheel.get("offset", 0.0)
    with errors_of("rail." if isinstance(of_rail, TransverseProfile) else "wheel.", of="profile"):
        scene = ProfiledRail(**fields, profile=_together(of_rail, of_wheel, offset), offset=offset)
    if isinstance(of_wheel, TransverseProfile):
        _check_flange(of_wheel, scene.profile.at - offset)
    return scene


def _together(of_rail: Shape, of_wheel: Shape, offset: float) -> TransverseProfile:
    """Of rail and wheel, of which one has a profile; the other may have a radius, or be straight."""
    if isinstance(of_wheel, TransverseProfile):
        wheel = of_wheel.moved(offset)
        if isinstance(of_rail, TransverseProfile):
            return both_together([of_rail, wheel], 0.0)
        # the rail has no corners, which a flange would meet
        if wheel.y[0] > CROWN or wheel.y[-1] < -CROWN:
            middle = in_unit(offset - (wheel.y[0] + wheel.y[-1]) / 2, "length", digits=3)
            raise ValueError(
                f"profile must have points within {1e3 * CROWN:g} mm of the middle of the rail, got y from "
                f'{1e3 * wheel.y[0]:.4g} to {1e3 * wheel.y[-1]:.4g} mm: wheel.offset moves it, as: offset = "{middle}"'
            )
        return both_together([wheel.within(CROWN)], 0.0 if of_rail is None else 1 / of_rail)
    assert isinstance(of_rail, TransverseProfile)
    return both_together([of_rail], 0.0 if of_wheel is None else 1 / of_wheel, offset)


def _check_flange(wheel: TransverseProfile, at: float) -> None:
    """Raises ValueError for a wheel that is upside down: a flange goes down beside the rail. at: of the contact [m]."""
    up, down = (sign * (float(end(wheel.height)) - float(wheel(at))) for sign, end in ((1, max), (-1, min)))
    if down > FLANGE > up:
        raise ValueError(
            f"wheel.profile must have heights positive towards the rail, got one that goes {in_unit(down, 'length')} "
            "away from it, as a flange does that is upside down: flip = true turns it"
        )


def _load(wheel: dict[str, Any]) -> tuple[float, tuple[str, ...]]:
    """Of one wheel, and what was assumed of an axle."""
    load: float = value_of_one_key(wheel, "wheel", ("load", "axle_load"))
    wheels = wheel.get("wheels_per_axle")
    if "load" in wheel:
        if wheels is not None:
            raise ValueError("wheel.wheels_per_axle belongs to wheel.axle_load, got it beside wheel.load, of one wheel")
        return load, ()
    if wheels is None:
        raise ValueError(
            "wheel.wheels_per_axle is missing: wheel.axle_load must be shared out among wheels, as wheels_per_axle = 2"
        )
    if wheels > MOST_WHEELS:
        raise ValueError(f"wheel.wheels_per_axle must be at most {MOST_WHEELS}, got {shortened(wheels)}")
    loads = in_unit(load, "force"), in_unit(load / wheels, "force")
    return load / wheels, (f"the axle load of {loads[0]} is shared by {wheels} wheels: {loads[1]} each.",)


def _combined(rail: Any, wheel: Any) -> tuple[Any, tuple[str, ...]]:
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
    notes: tuple[str, ...] = (note,) if missing else ()
    if isinstance(rail, MeasuredLines) and len(rail.positions) > 1:
        notes += (
            "the lateral structure of rail and wheel together is not measured by the lines of the rail: "
            "rail.lateral_structure states it.",
        )
    return levels + more, notes


def _across(name: str, value: object) -> Any:
    """What an `Across` of `RailScene` may be."""
    if value in ("ridges", "isotropic"):
        return value
    if isinstance(value, str):
        raise ValueError(f'{name} must be "ridges", "isotropic" or a number alpha, got {shortened(value)}')
    return POSITIVE(name, value)


def _diameter(name: str, value: object) -> Any:
    """A column of table G-3b in mm: a number, or a text with a unit."""
    if isinstance(value, str):
        return round(1e6 * quantity(name, value, "length")) / 1e3
    return NUMBER(name, value)


class RailReader:
    """Reads the scenes of this house."""

    what = "a wheel on a rail with two radii"
    renamed = RENAMED
    reads = staticmethod(is_rail)
    scene_of = staticmethod(rail_of)


LOADED = values("radius", "diameter", "transverse_radius", "load", "axle_load", "wheels_per_axle")
WHEEL = LOADED | values("speed", "mass", "damping") | {"offset": partial(quantity, dimension="length")}
WHEEL |= {"transfer": _diameter, "axles": WHOLE}
BEAM: dict[str, Reader] = {"bending_stiffness": POSITIVE, "mass_per_length": POSITIVE}
"""N m^2 and kg/m, of a free beam."""
RAIL: dict[str, Reader] = {
    **values("crown_radius"),
    "lateral_structure": _across,
    **values("lateral_ratio"),
    "impedance": lambda name, value: value,
    "track": nonblank_text,
    **BEAM,
}
"""How each value of a scene file is read."""
