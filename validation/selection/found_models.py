"""Models that are found in `simulation/models`, as candidates of a selection."""

from dataclasses import dataclass

import numpy as np

from validation.scenes.load import Scene
from validation.selection.hierarchy import Answer, ContactModel, mean_error
from validation.simulation.method import Resolution
from validation.simulation.model import Cost, ErrorEstimate, Model, models_serving


@dataclass(frozen=True)
class FoundModel:
    """A model of a scene: its own estimate of its error, and what the sample leaves where it has one."""

    found: Model
    scene: Scene
    quantity: str

    @property
    def kind(self) -> str:
        """The name of the model."""
        return self.found.name

    name = kind

    def cost(self) -> Cost:
        """As the model expects it."""
        return self.found.cost(self.scene)

    def estimate(self) -> ErrorEstimate:
        """As the model expects it."""
        return self.found.estimate(self.scene)

    def solve(self) -> Answer:
        """One solve, the mean over its realisations."""
        expected, result = self.estimate(), self.found.prepare(self.scene, Resolution())(0)()
        values = np.atleast_1d(result.values[self.quantity])
        rows = values.reshape(result.count, -1)
        return Answer(
            value=rows.mean(axis=0),
            cost=self.cost(),
            model=expected.error,
            sample=mean_error(rows / rows.mean(axis=0)) if result.count > 1 else 0.0,
            reason=expected.reason,
        )


def with_found_models(models: list[ContactModel], scene: Scene, quantity: str) -> list[ContactModel]:
    """The same, each model that is found before the first that costs more."""
    for model in (FoundModel(found, scene, quantity) for found in models_serving(scene, quantity)):
        seconds = model.cost().seconds
        place = next((i for i, other in enumerate(models) if other.cost().seconds > seconds), len(models))
        models.insert(place, model)
    return models
