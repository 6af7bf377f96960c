"""Boundary elements under a wheel of constant load on strips of rail: the reference of the other contact filters."""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.engine.engine import Outcome
from validation.scenes.rail import ProfiledRail, RailScene
from validation.simulation.equivalent_displacement import BEM
from validation.simulation.profiled_strip import roll_on_profile
from validation.simulation.rail_models import POSITION, RolledRailModel, in_strips, linear_error
from validation.simulation.rail_quantity import RailQuantity
from validation.simulation.rail_strip import RailStrip


class BoundaryElementsOnRail(RolledRailModel):
    """On two grids; bands that a strip has not are linear theory, with its error."""

    name: ClassVar = BEM
    seconds: ClassVar = POSITION

    def model_error(self, quantity: RailQuantity, a3: NDArray[np.float64]) -> NDArray[np.float64]:
        """What the ground leaves; no error of its own. Of a profile, short waves that a strip has not are unknown."""
        inside, beyond = in_strips(quantity), linear_error(quantity)
        if isinstance(quantity.scene, ProfiledRail):
            shorter = np.arange(inside.size) > np.flatnonzero(inside).max()
            beyond = np.where(shorter, np.inf, beyond)
        return np.where(inside, 0.0, beyond) + quantity.left_by_ground

    def roll(self, scene: RailScene, strip: RailStrip) -> Outcome:
        """With the profile across where the scene has one."""
        if isinstance(scene, ProfiledRail):
            return roll_on_profile(strip, scene.profile)
        return super().roll(scene, strip)

    def beyond(self, quantity: RailQuantity) -> str:
        """It is the reference."""
        return ""


MODEL = BoundaryElementsOnRail()
