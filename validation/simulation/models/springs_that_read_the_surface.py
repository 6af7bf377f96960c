"""One-sided springs under a rolling wheel, each of which reads the mean of the heights across the contact."""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

import mdr
from validation.scenes.rolling import RollingScene
from validation.simulation.rolling_claims import READ_BANDS, READ_RMS
from validation.simulation.rolling_strip_model import RollingStripModel
from validation.simulation.wheel_on_half_space import crop_to_reach


class SpringsThatReadTheSurface(RollingStripModel):
    """Linear theory of the half-space while all springs touch; a spring lets go over its whole width at once."""

    name: ClassVar = "springs that read the surface"
    setting: ClassVar = "24 strips"
    is_mdr: ClassVar = True
    strips: ClassVar = 24
    per_cell: ClassVar = 1.5e-7
    bands: ClassVar = READ_BANDS
    rms: ClassVar = READ_RMS
    on_bands: ClassVar = "contact is lost along the track, not inside of the contact"

    def force(self, scene: RollingScene, surface: NDArray[np.float64], spacing: float) -> NDArray[np.float64]:
        strip = crop_to_reach(surface, spacing, scene.body)
        wheel = {"radius": scene.radius, "modulus": scene.modulus, "approach": scene.approach}
        return mdr.roll_surface(strip, spacing=spacing, **wheel).force


MODEL = SpringsThatReadTheSurface()
