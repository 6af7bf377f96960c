"""Description of a scene, and what may be wrong about it: the first lines on terminal and page."""

import math
from collections.abc import Mapping
from functools import partial
from typing import Protocol

from validation.scenes.material import Material
from validation.scenes.roughness import RoughSurface
from validation.scenes.scene import Pairs
from validation.scenes.units import in_unit
from validation.scenes.wheel_body import Wheel, in_per_cent

COUNTED = "in one direction, of all waves"
"""What the slope of a scene counts."""
LENGTH, FORCE, MASS = (partial(in_unit, dimension=dimension) for dimension in ("length", "force", "mass"))


class Described(Protocol):
    """What is described: a scene of `compare`, or a wheel whose own roughness is known, too."""

    @property
    def modulus(self) -> float: ...
    @property
    def material(self) -> Material | None: ...
    def describe(self) -> Pairs: ...
    def diagnose(self) -> tuple[str, ...]: ...
    def no_steady_answer(self) -> str:
        """Why an undamped wheel has no steady state on this ground; empty where it has one."""


class Pressed(Protocol):
    """A sphere or a wheel under a load."""

    @property
    def load(self) -> float: ...
    @property
    def contact_radius(self) -> float: ...
    @property
    def approach(self) -> float: ...
    @property
    def mass(self) -> float | None: ...
    @property
    def speed(self) -> float | None: ...
    @property
    def damping(self) -> float: ...
    @property
    def body(self) -> Wheel: ...


def describe(scene: Described) -> Pairs:
    """What a scene is, in pairs of a name and a value with its unit: E* and its origin, body, contact, roughness."""
    material = scene.material or Material(contact_modulus=scene.modulus)
    modulus = f"{in_unit(scene.modulus, 'pressure', digits=6)}: {material.origin}"
    return ("contact modulus E*", modulus), *scene.describe()


def description_lines(scene: Described, *, moving: bool = True) -> list[str]:
    """Lines for a terminal: why there is no steady answer, notes, description.

    moving: whether the motion of a wheel is asked for.
    """
    reason = scene.no_steady_answer() if moving else ""
    lines = [f"no steady answer: {reason}"] if reason else []
    lines += [f"note: {note}" for note in scene.diagnose()]
    pairs = describe(scene)
    width = max(len(name) for name, _ in pairs)
    return [*lines, *(f"  {name:{width}s}  {value}" for name, value in pairs)]


def slope_ratio(slope_along: float, scene: Pressed) -> float:
    """h' a / d: the rms slope in one direction over that of the smooth body at the edge of its contact [-]."""
    return slope_along * scene.contact_radius / scene.approach


def body_pairs(name: str, radius: float, scene: Pressed) -> Pairs:
    return (
        (name, f"radius {LENGTH(radius)}, load {FORCE(scene.load)}"),
        ("contact radius a", f"{LENGTH(scene.contact_radius)}, of the smooth body"),
        ("approach d", f"{LENGTH(scene.approach)}, of the smooth body"),
    )


def motion_pair(scene: Pressed) -> tuple[str, str]:
    if scene.mass is None or scene.speed is None:
        return "motion", "none, the wheel keeps its approach"
    body = f"mass {MASS(scene.mass)}, speed {in_unit(scene.speed, 'speed')}"
    resonance = f"resonance at {scene.body.eigenfrequency:.4g} rad/s"
    return "motion", f"{body}, {resonance}, {damping_of(scene.damping) or 'undamped'}"


def damping_of(ratio: float) -> str:
    return f"damping {in_per_cent(ratio)} of critical" if ratio else ""


def roughness_pairs(scene: Pressed, grounds: Mapping[str, RoughSurface | None]) -> Pairs:
    """Height and slope of all that is rough, and the waves of each, by their names."""
    rough = {name: each for name, each in grounds.items() if each is not None}
    if not rough:
        return (("roughness", "none"),)
    rms, slope = (math.hypot(*(getattr(each, of) for each in rough.values())) for of in ("rms", "slope_along"))
    return (
        ("rms height h", f"{LENGTH(rms)}, h/d = {rms / scene.approach:.3g}"),
        ("rms slope h'", f"{slope:.3g}, {COUNTED}, h' a/d = {slope_ratio(slope, scene):.3g}"),
        *((name, waves_of(each, scene.speed)) for name, each in rough.items()),
    )


def waves_of(ground: RoughSurface, speed: float | None) -> str:
    """The wavelengths of the roughness in words; with a speed also their angular frequencies [rad/s]."""
    if speed is None or ground.is_single:
        return ground.waves
    return f"{ground.waves}, {ground.q_min * speed:.4g} to {ground.q_max * speed:.4g} rad/s"
