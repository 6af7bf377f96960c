"""Models of a scene by their kind, so that a model added to `simulation/models` changes no test."""

from validation.scenes.load import Scene
from validation.selection.compare import models_of
from validation.selection.hierarchy import BOUNDARY_ELEMENTS, ContactModel
from validation.simulation.model import ErrorEstimate

OURS = ("closed form", "linear filter, 1D", "linear filter, 3D", "springs", BOUNDARY_ELEMENTS)
"""The kinds of model that these tests are about."""


def models_of_kind(kind: str, scene: Scene, quantity: str, tolerance: float, seed: int = 0) -> list[ContactModel]:
    """The cheapest first: several grids of boundary elements, one model of any other kind."""
    return [model for model in models_of(scene, quantity, tolerance, seed) if model.kind == kind]


def model_of_kind(kind: str, scene: Scene, quantity: str, tolerance: float, seed: int = 0) -> ContactModel:
    """The only one of its kind."""
    (model,) = models_of_kind(kind, scene, quantity, tolerance, seed)
    return model


def grids_of(scene: Scene, quantity: str, tolerance: float, seed: int = 0) -> list[ContactModel]:
    """Boundary elements, the coarsest first."""
    return models_of_kind(BOUNDARY_ELEMENTS, scene, quantity, tolerance, seed)


def estimates_by_kind(scene: Scene, quantity: str, tolerance: float, seed: int = 0) -> dict[str, ErrorEstimate]:
    """Of the kinds of these tests; of boundary elements, that of the finest grid."""
    models = models_of(scene, quantity, tolerance, seed)
    return {model.kind: model.estimate() for model in models if model.kind in OURS}
