"""The wheel on a rough layer, pressed flat beforehand: which asperities touch is known from the strip itself."""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from validation.scenes.rolling import RollingScene
from validation.simulation.pressed_layer import roll_on_layer
from validation.simulation.rolling_claims import LAYER_BANDS, LAYER_RMS
from validation.simulation.rolling_strip_model import RollingStripModel


class PressedLayer(RollingStripModel):
    """Boundary elements once for a strip and a mean pressure, not once for a position."""

    name: ClassVar = "pressed layer"
    setting: ClassVar = "10 strips"
    strips: ClassVar = 10
    per_cell: ClassVar = 4.0e-6
    bands: ClassVar = LAYER_BANDS
    rms: ClassVar = LAYER_RMS
    on_bands: ClassVar = "waves longer than the contact are pressed flat in the layer, where the wheel follows them"

    def force(self, scene: RollingScene, surface: NDArray[np.float64], spacing: float) -> NDArray[np.float64]:
        rolled = roll_on_layer(surface / scene.approach, spacing / scene.contact_radius)
        return np.asarray(rolled.force * scene.load)


MODEL = PressedLayer()
