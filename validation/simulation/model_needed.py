"""The cheapest model that each case needs, selected for the scenes of the case by the a-priori error estimates."""

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import groupby
from typing import Any

from validation.engine.street import objects_of_houses
from validation.scenes.indentation import IndentationScene
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.scenes.scene import MOVING, PRESSED, ROLLING, Scene, SceneQuantity
from validation.simulation.model_names import BEM
from validation.simulation.rough_punch import PunchRoughness

TOLERANCE = 0.1


def model_for(scene: Scene, quantity: SceneQuantity) -> str:
    """The cheapest whose estimated error is small enough; where nothing selects models that is not known."""
    selections = objects_of_houses("model_for")
    return next((select(scene, quantity, TOLERANCE) or "none" for select in selections), "not known")


def of_each(quantities: Sequence[SceneQuantity], shown: Callable[[SceneQuantity], str]) -> str:
    """ "stiffness: springs", and so for each quantity: what is enough for one is not for another."""
    return ". ".join(f"{quantity}: {shown(quantity)}" for quantity in quantities)


def along(name: str, scenes: Sequence[tuple[float, Scene]], quantity: SceneQuantity) -> str:
    """Models along a parameter, in pieces: "springs for Fbar from 0.02 to 0.5; ..."."""
    pairs = [(value, model_for(scene, quantity)) for value, scene in scenes]
    pieces = []
    for model, group in groupby(pairs, key=lambda pair: pair[1]):
        values = [value for value, _ in group]
        span = f"{values[0]:.2g}" if len(values) == 1 else f"{values[0]:.2g} to {values[-1]:.2g}"
        pieces.append(f"{model} for {name} {span}" if len(scenes) > len(values) else model)
    return "; ".join(pieces)


def sphere(case: Any) -> str:
    """Models of a smooth sphere by its radius [m], its force [N] and its modulus E* [Pa]."""
    scene = IndentationScene(name="sphere", shape="sphere", size=case.radius, load=case.force, modulus=case.modulus)
    return of_each(PRESSED, partial(model_for, scene))


def punches(case: Any, hurst: float = 0.7, first: int = 1) -> str:
    """Models of the punches of Fig. 14.1, by default for H = 0.7."""
    roughness = PunchRoughness(hurst=hurst, waves=(first, case.cells // 4), seed=0)
    scenes = [(force, roughness.scene(force)) for force in case.forces]
    return f"mean {of_each(PRESSED, partial(along, 'Fbar', scenes))} (H = {hurst:g})"


def rolled_off(case: Any) -> str:
    """Models of punches whose spectrum has a roll-off."""
    roll_off, hurst = case.pressed
    return punches(case, hurst, roll_off)


def rolling(case: Any) -> str:
    """Models of the spectrum of the force of a wheel, height by height: a = d = E* = 1."""
    longest, shortest = (2 * math.pi / case.spectrum.edges[end] for end in (0, -1))
    scenes = []
    for height in case.heights:
        ground = Roughness(rms=height, hurst=case.hurst, longest=longest, shortest=shortest)
        scenes.append((height, RollingScene(name="wheel", radius=1.0, load=4 / 3, modulus=1.0, ground=ground)))
    return of_each(ROLLING, partial(along, "h/d", scenes))


def wheel(case: Any) -> str:
    scene = case.scene
    if not scene.rail_alone_is_rough:
        return BEM
    return of_each(MOVING, partial(model_for, scene.for_compare()))
