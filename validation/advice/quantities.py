"""The quantities of scenes, and the models of each."""

from validation.advice.hierarchy import needed
from validation.advice.scene_model import SceneModel, Shared
from validation.engine.street import objects_of_houses
from validation.scenes.scene import INTERFACE, MOVING, PRESSED, ROLLING, Scene, SceneQuantity
from validation.simulation.model import Target, models_serving
from validation.simulation.model_names import SPRINGS_THAT_READ

BY_NAME = (SPRINGS_THAT_READ,)
"""Models that are offered by name alone: linear theory costs less and is closer; they pay in the time loop alone."""


def all_quantities() -> tuple[str, ...]:
    """Keys of the quantities of all scenes."""
    brought_by_houses = (quantity for quantities in objects_of_houses("quantities") for quantity in quantities)
    return tuple(map(str, (*PRESSED, *INTERFACE, *ROLLING, *MOVING, *brought_by_houses)))


def quantities_of(scene: Scene) -> tuple[str, ...]:
    """The quantities that a scene has; the first is the default."""
    return tuple(map(str, scene.quantities))


def quantity_of(scene: Scene, key: str) -> SceneQuantity:
    """The quantity with this key. Raises ValueError for a quantity that the scene has not."""
    for quantity in scene.quantities:
        if key == str(quantity):
            return quantity
    raise ValueError(f"quantity must be one of {', '.join(quantities_of(scene))} for scene {scene.name!r}, got {key!r}")


def models_of(
    scene: Scene,
    quantity: str,
    tolerance: float,
    seed: int,
    shared: Shared | None = None,
    *,
    include_by_name: bool = False,
    realisations: int | None = None,
) -> list[SceneModel]:
    """Models of a scene, the cheapest first. Raises ValueError for a quantity that the scene has not.

    shared: solves for several quantities of one scene; include_by_name: whether those of `BY_NAME` are among them;
    realisations: as of `SceneModel`, for which a scene must have a model that draws surfaces.
    """
    quantity_of(scene, quantity)
    target, solved = Target(scene, quantity, tolerance, seed), Shared() if shared is None else shared
    models = [
        SceneModel(model, target, resolution, solved, realisations)
        for model in models_serving(scene, quantity)
        if include_by_name or model.name not in BY_NAME
        for resolution in model.resolutions(target)
    ]
    if realisations is not None and not any(scene_model.is_sampled for scene_model in models):
        raise ValueError(
            f"realisations must be left out for scene {scene.name!r}, got {realisations}: {scene.sample_note}"
        )
    return sorted(models, key=lambda scene_model: scene_model.cost().seconds)


def model_for(scene: Scene, quantity: SceneQuantity, tolerance: float) -> str:
    """The first model whose estimated error is within the tolerance, all grids one; empty where there is none."""
    model = needed(models_of(scene, str(quantity), tolerance, 0), tolerance)
    return "" if model is None else model.kind
