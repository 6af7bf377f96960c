"""One-sided springs under a wheel on a line that has the spectrum of Geike's rule, C_1D(q) = pi q C_2D(q)."""

from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from validation.engine.engine import Outcome
from validation.scenes.rail import RailScene
from validation.simulation.rail_models import RolledRailModel
from validation.simulation.rail_quantity import RailQuantity
from validation.simulation.rail_strip import RailStrip
from validation.simulation.spectral_springs import (
    SPRINGS_GEIKE,
    SpectralRail,
    geike_power,
    roll_spectral_springs,
)

ISOTROPIC: Literal["isotropic"] = "isotropic"


class SpringsOfGeike(RolledRailModel):
    """MDR for a punch: not 0 dB for long waves. The rule is for isotropic ground; a spectrum has no places."""

    name: ClassVar = SPRINGS_GEIKE
    is_mdr: ClassVar = True
    seconds: ClassVar = 3e-5

    def serves(self, scene: Any, quantity: str) -> bool:
        """Where the ground is isotropic or not stated: on any other there is no C_2D of one wavenumber."""
        return super().serves(scene, quantity) and scene.across in (ISOTROPIC, None)

    def closed(self, quantity: RailQuantity) -> NDArray[np.float64]:
        """The same for each end, of the isotropic ground that has the line. ValueError where none has."""
        found = geike_power(quantity.line, quantity.scene.contact, quantity.bands.edges)
        return np.tile(10 * np.log10(found), (len(quantity.ends), 1))

    def grounds(self, quantity: RailQuantity) -> tuple[Literal["isotropic"], ...]:
        return (ISOTROPIC,) * len(quantity.ends)

    def roll(self, scene: RailScene, strip: RailStrip) -> Outcome:
        return roll_spectral_springs(SpectralRail(strip=strip, models=(self.name,)))


MODEL = SpringsOfGeike()
