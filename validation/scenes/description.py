"""Description of a scene, and what may be wrong about it: the first lines on terminal and page."""

import math

from validation.scenes.dynamic_wheel import WheelScene
from validation.scenes.indentation import IndentationScene
from validation.scenes.material import Material
from validation.scenes.rail import RailScene
from validation.scenes.rail_description import of_rail
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import RoughSurface
from validation.scenes.units import in_unit

WithSphere = IndentationScene | RollingScene | WheelScene
AnyScene = WithSphere | RailScene
Pairs = tuple[tuple[str, str], ...]

COUNTED = "in one direction, of all waves"
"""What the slope of a scene counts."""


def describe(scene: AnyScene) -> Pairs:
    """What a scene is, in pairs of a name and a value with its unit: E* and its origin, body, contact, roughness."""
    material = scene.material or Material(contact_modulus=scene.modulus)
    modulus = ("contact modulus E*", f"{in_unit(scene.modulus, 'pressure', digits=6)}: {material.origin}")
    if isinstance(scene, RailScene):
        return modulus, *of_rail(scene)
    if isinstance(scene, WheelScene):
        return modulus, *_of_body("wheel", scene.radius, scene), _of_motion(scene), *_of_roughness_of_wheel(scene)
    if isinstance(scene, RollingScene):
        return modulus, *_of_body("wheel", scene.radius, scene), _of_motion(scene), *_of_ground(scene)
    if scene.shape == "sphere":
        return modulus, *_of_body("sphere", scene.size, scene), *_of_ground(scene)
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


def _of_body(name: str, radius: float, scene: WithSphere) -> Pairs:
    return (
        (name, f"radius {in_unit(radius, 'length')}, load {in_unit(scene.load, 'force')}"),
        ("contact radius a", f"{in_unit(scene.contact_radius, 'length')}, of the smooth body"),
        ("approach d", f"{in_unit(scene.approach, 'length')}, of the smooth body"),
    )


def _of_motion(scene: RollingScene | WheelScene) -> tuple[str, str]:
    if scene.mass is None or scene.speed is None:
        return "motion", "none, the wheel keeps its approach"
    body = f"mass {in_unit(scene.mass, 'mass')}, speed {in_unit(scene.speed, 'speed')}"
    return "motion", f"{body}, resonance at {scene.body.eigenfrequency:.4g} rad/s, undamped"


def _of_ground(scene: IndentationScene | RollingScene) -> Pairs:
    ground = scene.ground
    if ground is None:
        return (("roughness", "none"),)
    return (_height(ground.rms, scene.approach), _slope(ground.slope_along, scene), ("waves", _waves(ground, scene)))


def _of_roughness_of_wheel(scene: WheelScene) -> Pairs:
    rough = [(name, r) for name, r in (("rail", scene.rail), ("wheel", scene.wheel)) if r]
    if not rough:
        return (("roughness", "none"),)
    waves = ((f"waves of the {name}", _waves(ground, scene)) for name, ground in rough)
    return (_height(scene.rms, scene.approach), _slope(scene.slope_along, scene), *waves)


def _of_punch(scene: IndentationScene) -> Pairs:
    body = ("punch", f"side L = {in_unit(scene.size, 'length')}, load {in_unit(scene.load, 'force')}")
    ground = scene.ground
    if ground is None:
        return body, ("roughness", "none")
    # a measured face is as long as its first wave
    longest = f"longest waves on a side: {scene.size * ground.q_min / (2 * math.pi):.3g}"
    return (
        body,
        ("rms height h", f"{in_unit(ground.rms, 'length')}, F / (E* h L) = {scene.reduced_load:.3g}"),
        ("rms slope h'", f"{ground.slope_along:.3g}, {COUNTED}"),
        ("waves", f"{_waves(ground, scene)}; {longest}"),
    )


def _height(rms: float, approach: float) -> tuple[str, str]:
    return "rms height h", f"{in_unit(rms, 'length')}, h/d = {rms / approach:.3g}"


def slope_ratio(slope_along: float, scene: WithSphere) -> float:
    """h' a / d: the rms slope in one direction over that of the smooth body at the edge of its contact [-]."""
    return slope_along * scene.contact_radius / scene.approach


def _slope(slope_along: float, scene: WithSphere) -> tuple[str, str]:
    return "rms slope h'", f"{slope_along:.3g}, {COUNTED}, h' a/d = {slope_ratio(slope_along, scene):.3g}"


def _waves(ground: RoughSurface, scene: WithSphere) -> str:
    if isinstance(scene, IndentationScene) or scene.speed is None or ground.is_single:
        return ground.waves
    return f"{ground.waves}, {ground.q_min * scene.speed:.4g} to {ground.q_max * scene.speed:.4g} rad/s"
