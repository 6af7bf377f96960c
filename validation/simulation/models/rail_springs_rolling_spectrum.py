"""One-sided springs under a wheel on a line that has the rolling spectrum of the stated ground."""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.engine.engine import Outcome
from validation.scenes.rail import RailScene
from validation.simulation.rail_models import RolledRailModel
from validation.simulation.rail_quantity import RailQuantity
from validation.simulation.rail_strip import RailStrip
from validation.simulation.spectral_springs import (
    SPRINGS_ROLLING,
    SpectralRail,
    roll_spectral_springs,
    rolling_transfer,
)


class SpringsOnRollingSpectrum(RolledRailModel):
    """MDR with the level of the half-space for long and for short waves, of levels: a spectrum has no places."""

    name: ClassVar = SPRINGS_ROLLING
    is_mdr: ClassVar = True
    seconds: ClassVar = 3e-5

    def closed(self, quantity: RailQuantity) -> NDArray[np.float64]:
        return quantity.filtered(rolling_transfer(quantity.scene.contact))

    def roll(self, scene: RailScene, strip: RailStrip) -> Outcome:
        return roll_spectral_springs(SpectralRail(strip=strip, models=(self.name,)))


MODEL = SpringsOnRollingSpectrum()
