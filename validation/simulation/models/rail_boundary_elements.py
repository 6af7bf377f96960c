"""Boundary elements under a wheel of constant load on strips of rail: the reference of the other contact filters."""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.simulation.equivalent_displacement import BEM
from validation.simulation.rail_models import POSITION, RolledRailModel, in_strips, linear_error
from validation.simulation.rail_quantity import RailQuantity


class BoundaryElementsOnRail(RolledRailModel):
    """On two grids; bands that a strip has not are linear theory, with its error."""

    name: ClassVar = BEM
    seconds: ClassVar = POSITION

    def model_error(self, quantity: RailQuantity, a3: NDArray[np.float64]) -> NDArray[np.float64]:
        """What the ground leaves; no error of its own."""
        return np.where(in_strips(quantity), 0.0, linear_error(quantity)) + quantity.half_width

    def beyond(self, quantity: RailQuantity) -> str:
        """It is the reference."""
        return ""


MODEL = BoundaryElementsOnRail()
