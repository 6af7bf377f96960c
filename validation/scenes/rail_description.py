"""Description of a wheel on a rail: the contact that is assumed, which no one can tell from a wrong load otherwise."""

import math

from validation.scenes.measured import MeasuredHeights
from validation.scenes.measured_lines import MeasuredLines
from validation.scenes.profiled_rail import ProfiledRail
from validation.scenes.rail import RailScene
from validation.scenes.units import in_unit


def of_rail(scene: RailScene) -> tuple[tuple[str, str], ...]:
    """Pairs of a name and a value with its unit: bodies, contact, motion, roughness, and what lies across."""
    contact, levels = scene.contact, scene.levels
    slope_ratio = levels.slope_along * contact.along / contact.approach
    return (
        ("wheel", f"radius {in_unit(scene.radius, 'length')}, {_wheel_across(scene)}{_load(scene)}"),
        _rail(scene),
        *([("contact lies at", scene.contact_place)] if isinstance(scene, ProfiledRail) else []),
        (
            "contact ellipse",
            f"a_x = {_short(contact.along)} along, a_y = {_short(contact.across)} across, of the smooth bodies",
        ),
        ("approach d", _short(contact.approach)),
        ("peak pressure p0", in_unit(contact.pressure, "pressure", digits=3)),
        ("motion", _motion(scene)),
        ("roughness", f"rms {_short(levels.rms)} over all bands: {_source(scene)}"),
        ("bands", _bands(scene)),
        ("rms slope h'", f"{levels.slope_along:.3g} along the track, of all bands, h' a_x/d = {slope_ratio:.3g}"),
        ("what lies across", _structure(scene)),
    )


def _wheel_across(scene: RailScene) -> str:
    """With its comma; of a profile of both bodies it stands with the rail."""
    return "" if isinstance(scene, ProfiledRail) else f"{_across(scene.transverse_radius)}, "


def _rail(scene: RailScene) -> tuple[str, str]:
    if not isinstance(scene, ProfiledRail):
        return "rail", _across(scene.crown_radius)
    radius = in_unit(scene.radii[1], "length", digits=3)
    return "wheel and rail", f"profile of {scene.profile.source} across, radius {radius} fitted over the contact"


def _load(scene: RailScene) -> str:
    return f"load {in_unit(scene.load, 'force')} of one wheel"


def _across(radius: float | None) -> str:
    return "straight across" if radius is None else f"radius {in_unit(radius, 'length')} across"


def _motion(scene: RailScene) -> str:
    if scene.speed is None:
        return "none: wavelengths have no frequencies"
    mass = "" if scene.mass is None else f", mass {in_unit(scene.mass, 'mass')}"
    return f"speed {3.6 * scene.speed:.5g} km/h{mass}"


def _source(scene: RailScene) -> str:
    if isinstance(scene.roughness, MeasuredHeights):
        return scene.roughness.waves
    if isinstance(scene.roughness, MeasuredLines) and len(scene.roughness.positions) > 1:
        places = ", ".join(f"{1000 * position:g}" for position in scene.roughness.positions)
        return f"{scene.levels.source}, at {places} mm across"
    return scene.levels.source


def _bands(scene: RailScene) -> str:
    return f"{len(scene.levels.bands)} one-third octaves, {scene.levels.bands.span}"


def _structure(scene: RailScene) -> str:
    if isinstance(scene.roughness, MeasuredHeights):
        return "measured"
    if scene.across is None:
        return "not given: from ridges to isotropic ground"
    if isinstance(scene.across, str):
        return {"ridges": "ridges", "isotropic": "isotropic ground"}[scene.across]
    return f"waves within {math.degrees(math.atan(scene.across)):.3g} degrees of the track, alpha = {scene.across:g}"


def _short(length: float) -> str:
    return in_unit(length, "length", digits=3)
