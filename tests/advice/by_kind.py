"""Models of a scene by their kind, so that a model added to `advice/models` changes no test."""

from validation.advice.models import boundary_elements_pressed
from validation.advice.models_of_scene import models_of
from validation.advice.scene_model import SceneModel
from validation.scenes.load import Scene
from validation.simulation.method import Resolution
from validation.simulation.model import ErrorEstimate, GridModel, Target

BOUNDARY_ELEMENTS = GridModel.name
CHEAP = ("closed form", "fit", "linear filter, 1D", "linear filter, 3D", "springs")
OURS = (*CHEAP, BOUNDARY_ELEMENTS)
"""The kinds of model that these tests are about."""


def models_of_kind(kind: str, scene: Scene, quantity: str, tolerance: float, seed: int = 0) -> list[SceneModel]:
    """The cheapest first: several grids of boundary elements, one model of any other kind."""
    return [model for model in models_of(scene, quantity, tolerance, seed) if model.kind == kind]


def model_of_kind(kind: str, scene: Scene, quantity: str, tolerance: float, seed: int = 0) -> SceneModel:
    """The only one of its kind."""
    (model,) = models_of_kind(kind, scene, quantity, tolerance, seed)
    return model


def grids_of(scene: Scene, quantity: str, tolerance: float, seed: int = 0) -> list[SceneModel]:
    """Boundary elements, the coarsest first."""
    return models_of_kind(BOUNDARY_ELEMENTS, scene, quantity, tolerance, seed)


def grid_of(scene: Scene, tolerance: float, seed: int, cells: int) -> SceneModel:
    """Boundary elements of a pressed body on a grid of so many cells a side."""
    grid = Resolution(size=cells, residual=boundary_elements_pressed.RESIDUAL)
    return SceneModel(boundary_elements_pressed.MODEL, Target(scene, "stiffness", tolerance, seed), grid)


def estimates_by_kind(scene: Scene, quantity: str, tolerance: float, seed: int = 0) -> dict[str, ErrorEstimate]:
    """Of the kinds of these tests; of boundary elements, that of the finest grid."""
    models = models_of(scene, quantity, tolerance, seed)
    return {model.kind: model.estimate() for model in models if model.kind in OURS}
