"""Description of a scene, and what may be wrong about it: the first lines on terminal and page."""

import math
from functools import partial

from validation.railway.scenes.measured_lines import MeasuredLines
from validation.railway.scenes.rail import ProfiledRail, RailScene
from validation.scenes.damping import in_per_cent
from validation.scenes.dynamic_wheel import WheelScene
from validation.scenes.indentation import IndentationScene
from validation.scenes.material import Material
from validation.scenes.measured import MeasuredHeights
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import RoughSurface
from validation.scenes.units import in_unit

WithSphere = IndentationScene | RollingScene | WheelScene
AnyScene = WithSphere | RailScene
Pairs = tuple[tuple[str, str], ...]

COUNTED = "in one direction, of all waves"
"""What the slope of a scene counts."""
LENGTH, FORCE, MASS = (partial(in_unit, dimension=dimension) for dimension in ("length", "force", "mass"))
SHORT = partial(LENGTH, digits=3)


def describe(scene: AnyScene) -> Pairs:
    """What a scene is, in pairs of a name and a value with its unit: E* and its origin, body, contact, roughness."""
    material = scene.material or Material(contact_modulus=scene.modulus)
    modulus = ("contact modulus E*", f"{in_unit(scene.modulus, 'pressure', digits=6)}: {material.origin}")
    if isinstance(scene, RailScene):
        return modulus, *_of_rail(scene)
    if isinstance(scene, WheelScene | RollingScene):
        return modulus, *_of_body("wheel", scene.radius, scene), _of_motion(scene), *_of_roughness(scene)
    if scene.shape == "sphere":
        return modulus, *_of_body("sphere", scene.size, scene), *_of_roughness(scene)
    return modulus, *_of_punch(scene)


def description_lines(scene: AnyScene, *, moving: bool = True) -> list[str]:
    """Lines for a terminal: why there is no steady answer, notes, description.

    moving: whether the motion of a wheel is asked for.
    """
    reason = scene.no_steady_answer() if moving and isinstance(scene, RollingScene | WheelScene) else ""
    lines = [f"no steady answer: {reason}"] if reason else []
    lines += [f"note: {note}" for note in scene.diagnose()]
    pairs = describe(scene)
    width = max(len(name) for name, _ in pairs)
    return [*lines, *(f"  {name:{width}s}  {value}" for name, value in pairs)]


def slope_ratio(slope_along: float, scene: WithSphere) -> float:
    """h' a / d: the rms slope in one direction over that of the smooth body at the edge of its contact [-]."""
    return slope_along * scene.contact_radius / scene.approach


def _of_body(name: str, radius: float, scene: WithSphere) -> Pairs:
    return (
        (name, f"radius {LENGTH(radius)}, load {FORCE(scene.load)}"),
        ("contact radius a", f"{LENGTH(scene.contact_radius)}, of the smooth body"),
        ("approach d", f"{LENGTH(scene.approach)}, of the smooth body"),
    )


def _of_motion(scene: RollingScene | WheelScene) -> tuple[str, str]:
    if scene.mass is None or scene.speed is None:
        return "motion", "none, the wheel keeps its approach"
    body = f"mass {MASS(scene.mass)}, speed {in_unit(scene.speed, 'speed')}"
    return "motion", f"{body}, resonance at {scene.body.eigenfrequency:.4g} rad/s, {_damping(scene) or 'undamped'}"


def _damping(scene: RollingScene | WheelScene | RailScene) -> str:
    return f"damping {in_per_cent(scene.damping)} of critical" if scene.damping else ""


def _of_roughness(scene: WithSphere) -> Pairs:
    """Height and slope of all that is rough, and the waves of each."""
    rough: dict[str, RoughSurface]
    if isinstance(scene, WheelScene):
        rough = {f"waves of the {name}": each for name, each in (("rail", scene.rail), ("wheel", scene.wheel)) if each}
    else:
        rough = {"waves": scene.ground} if scene.ground else {}
    if not rough:
        return (("roughness", "none"),)
    rms, slope = (math.hypot(*(getattr(each, of) for each in rough.values())) for of in ("rms", "slope_along"))
    return (
        ("rms height h", f"{LENGTH(rms)}, h/d = {rms / scene.approach:.3g}"),
        ("rms slope h'", f"{slope:.3g}, {COUNTED}, h' a/d = {slope_ratio(slope, scene):.3g}"),
        *((name, _waves(each, scene)) for name, each in rough.items()),
    )


def _of_punch(scene: IndentationScene) -> Pairs:
    body = ("punch", f"side L = {LENGTH(scene.size)}, load {FORCE(scene.load)}")
    ground = scene.ground
    if ground is None:
        return body, ("roughness", "none")
    # a measured face is as long as its first wave
    longest = f"longest waves on a side: {scene.size * ground.q_min / (2 * math.pi):.3g}"
    return (
        body,
        ("rms height h", f"{LENGTH(ground.rms)}, F / (E* h L) = {scene.reduced_load:.3g}"),
        ("rms slope h'", f"{ground.slope_along:.3g}, {COUNTED}"),
        ("waves", f"{_waves(ground, scene)}; {longest}"),
    )


def _waves(ground: RoughSurface, scene: WithSphere) -> str:
    if isinstance(scene, IndentationScene) or scene.speed is None or ground.is_single:
        return ground.waves
    return f"{ground.waves}, {ground.q_min * scene.speed:.4g} to {ground.q_max * scene.speed:.4g} rad/s"


def _of_rail(scene: RailScene) -> Pairs:
    """Bodies, the contact that is assumed, motion, roughness, and what lies across."""
    contact, levels = scene.contact, scene.levels
    axes = f"a_x = {SHORT(contact.along)} along, a_y = {SHORT(contact.across)} across"
    slope, ratio = levels.slope_along, levels.slope_along * contact.along / contact.approach
    motion = "none: wavelengths have no frequencies"
    if scene.speed is not None:
        mass = "" if scene.mass is None else f"mass {MASS(scene.mass)}"
        motion = ", ".join(filter(None, (f"speed {3.6 * scene.speed:.5g} km/h", mass, _damping(scene))))
    return (
        *_of_bodies(scene),
        ("contact ellipse", f"{axes}, of the smooth bodies"),
        ("approach d", SHORT(contact.approach)),
        ("peak pressure p0", in_unit(contact.pressure, "pressure", digits=3)),
        ("motion", motion),
        ("roughness", f"rms {SHORT(levels.rms)} over all bands: {_source(scene)}"),
        ("bands", f"{len(levels.bands)} one-third octaves, {levels.bands.span}"),
        ("rms slope h'", f"{slope:.3g} along the track, of all bands, h' a_x/d = {ratio:.3g}"),
        ("what lies across", _structure(scene)),
    )


def _of_bodies(scene: RailScene) -> Pairs:
    """A profile of both bodies stands with the rail."""
    radius, load = f"radius {LENGTH(scene.radius)}", f"load {FORCE(scene.load)} of one wheel"
    if not isinstance(scene, ProfiledRail):
        wheel, rail = (
            "straight across" if across is None else f"radius {LENGTH(across)} across"
            for across in (scene.transverse_radius, scene.crown_radius)
        )
        return ("wheel", f"{radius}, {wheel}, {load}"), ("rail", rail)
    both = f"profile of {scene.profile.source} across, radius {SHORT(scene.radii[1])} fitted over the contact"
    return ("wheel", f"{radius}, {load}"), ("wheel and rail", both), ("contact lies at", scene.contact_place)


def _source(scene: RailScene) -> str:
    if isinstance(scene.roughness, MeasuredHeights):
        return scene.roughness.waves
    if isinstance(scene.roughness, MeasuredLines) and len(scene.roughness.positions) > 1:
        places = ", ".join(f"{1000 * position:g}" for position in scene.roughness.positions)
        return f"{scene.levels.source}, at {places} mm across"
    return scene.levels.source


def _structure(scene: RailScene) -> str:
    if isinstance(scene.roughness, MeasuredHeights):
        return "measured"
    words = {None: "not given: from ridges to isotropic ground", "isotropic": "isotropic ground", "ridges": "ridges"}
    if scene.across is None or isinstance(scene.across, str):
        return words[scene.across]
    return f"waves within {math.degrees(math.atan(scene.across)):.3g} degrees of the track, alpha = {scene.across:g}"
