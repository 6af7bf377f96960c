"""The quantities that scenes have, and the models of each."""

from validation.advice.scene_model import SceneModel, Shared
from validation.railway.problems.rail_quantity import RAIL_QUANTITIES
from validation.railway.scene_model import RailSceneModel
from validation.railway.scenes.rail import RailScene
from validation.railway.scenes.roughness_levels import MICROMETRE
from validation.scenes.indentation import IndentationScene
from validation.scenes.load import Scene
from validation.simulation.model import Target, models_serving
from validation.simulation.model_names import SPRINGS_THAT_READ

PRESSED = ("stiffness",)
ROLLING = ("force-rms", "force-spectrum")
MOVING = ("acceleration", "acceleration-rms")
QUANTITIES = (*PRESSED, *ROLLING, *MOVING, *RAIL_QUANTITIES)
LEVELS = ("force-spectrum", "acceleration", *RAIL_QUANTITIES)
"""In one-third octaves; the others are one number."""
UNITS = {
    "stiffness": "N/m",
    "force-rms": "N",
    "force-spectrum": "N",
    "acceleration": "m/s²",
    "acceleration-rms": "m/s²",
    "contact-filter": "1",
    "equivalent-roughness": "µm",
}
BY_NAME = (SPRINGS_THAT_READ,)
"""Models that are offered by name alone: linear theory costs less and is closer; they pay in the time loop alone."""
REFERENCES = {"equivalent-roughness": MICROMETRE}
"""Of levels, in SI units; one of those that are not named."""


def quantities_of(scene: Scene) -> tuple[str, ...]:
    """The quantities that a scene has; the first is the default. Raises ValueError where it has none."""
    if isinstance(scene, IndentationScene):
        return PRESSED
    if isinstance(scene, RailScene):
        return RAIL_QUANTITIES
    return ROLLING if scene.mass is None else (*MOVING, *ROLLING)


def models_of(
    scene: Scene,
    quantity: str,
    tolerance: float,
    seed: int,
    shared: Shared | None = None,
    *,
    every: bool = False,
    realisations: int | None = None,
) -> list[SceneModel]:
    """Models of a scene, the cheapest first. Raises ValueError for a quantity that the scene has not.

    shared: what is solved for several quantities of one scene; every: whether those of `BY_NAME` are among them;
    realisations: as of `SceneModel`, for which a scene must have a model that draws surfaces.
    """
    if quantity not in quantities_of(scene):
        known = ", ".join(quantities_of(scene))
        raise ValueError(f"quantity must be one of {known} for scene {scene.name!r}, got {quantity!r}")
    target, solved = Target(scene, quantity, tolerance, seed), Shared() if shared is None else shared
    kind = RailSceneModel if isinstance(scene, RailScene) else SceneModel
    found = [
        kind(model, target, resolution, solved, realisations)
        for model in models_serving(scene, quantity)
        if every or model.name not in BY_NAME
        for resolution in model.resolutions(target)
    ]
    if realisations is not None and not any(one.is_sampled for one in found):
        raise ValueError(f"realisations must be left out for scene {scene.name!r}, got {realisations}: {_alone(scene)}")
    return sorted(found, key=lambda one: one.cost().seconds)


def _alone(scene: Scene) -> str:
    """Why no number of realisations is asked of a scene."""
    if isinstance(scene, RailScene):
        return "each model of a rail has as many strips as its errors were measured on"
    return "its body is smooth" if scene.ground is None else "its heights are measured, one surface"
