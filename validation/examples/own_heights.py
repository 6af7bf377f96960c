"""Heights of one's own: a punch whose face was measured, from an array with its size; what each model says of it."""

from types import SimpleNamespace

import numpy as np
from matplotlib.figure import Figure

import bem3d
import mdr
import validation

# in place of a file: any object with `heights` and `physical_sizes`, as a Topography of SurfaceTopography
n, side = 64, 1e-3
rough = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi / side, q_max=2 * np.pi / side * n / 8, rms=1e-6)
heights = bem3d.rough_surface(rough.c2d, shape=(n, n), spacing=side / n, rng=np.random.default_rng(3), rms=1e-6)
face = SimpleNamespace(heights=heights, physical_sizes=(side, side))

ground = validation.measured(face)
scene = validation.IndentationScene(name="my punch", shape="punch", size=side, load=5.0, modulus=2.3e11, ground=ground)
found = validation.compare(scene, tolerance="30%", solve_all=True)
print(validation.summary(found))

assert found.met and found.model.startswith("boundary elements")  # springs know the spectrum, not this one face
assert ground.rms < 1e-6  # the mean plane is removed
springs = next(one for one in found.models if one.model.is_mdr)
assert springs.claimed > 0.44  # one surface scatters so much about the mean of its spectrum

figure = Figure(layout="constrained")
axes = figure.subplots()
image = axes.imshow(1e6 * heights.T, origin="lower", extent=(0, 1e3 * side, 0, 1e3 * side))
axes.set(xlabel="x [mm]", ylabel="y [mm]", title=f"stiffness {found.value[0]:.3g} N/m within {found.error:.0%}")
figure.colorbar(image, label="height [µm]")
figure.savefig("own_heights.png")
