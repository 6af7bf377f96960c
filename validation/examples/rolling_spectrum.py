"""The spectrum of the force under a rolling wheel: by linear filters, springs and boundary elements."""

from pathlib import Path

import numpy as np

import validation

scene = validation.load_scene("rolling_wheel")
found = validation.compare(scene, quantity="force-spectrum", tolerance="1 dB", solve_all=True)
print(validation.summary(found))

levels = {one.name: found.value_of(one) for one in found.selection.solved}
reference = levels["boundary elements, a = 12 cells"]


def off(name: str) -> float:
    """Root mean square difference over the bands [dB]."""
    return float(np.sqrt(np.mean((levels[name] - reference) ** 2)))


assert off("linear filter, 3D") < 1  # the roughness is low beside the approach
assert off("springs") > 2  # right in the mean over bands, not in each
assert off("linear filter, 1D") > 3  # Geike's rule keeps the variance of the force, not its levels

Path("rolling_spectrum.png").write_bytes(validation.to_figure(found, form="png"))
