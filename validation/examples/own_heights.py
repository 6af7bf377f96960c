"""Heights of one's own: a punch whose face was measured, from an array with its size and from the file of a device."""

from pathlib import Path
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

# the same face in a file: micrometres below a header, longer than wide, a point without data
table = np.pad(1e6 * heights, ((4, 4), (0, 0)))
table[40, 20] = np.nan
np.savetxt("face.csv", table, delimiter=",", header="Instrument 7\nz [um]", comments="")
keys = 'file = "face.csv"\nspacing = "15.625 um"\nunit = "um"\nskip = 2\ncrop = true\nfill = true\n'
body = 'name = "my punch"\npunch = { side = "1 mm", load = "5 N" }\nmaterial = { contact_modulus = "230 GPa" }\n'
Path("my_punch.toml").write_text(f"{body}[heights]\n{keys}")
same = validation.load_scene("my_punch.toml")
assert isinstance(same, validation.IndentationScene) and isinstance(same.ground, validation.MeasuredHeights)
from_file = same.ground
print(from_file.waves)
assert from_file.edits.filled == 1 and from_file.edits.cropped_from == (72, 64)
assert np.abs(from_file.height - ground.height).max() < 0.3e-6  # at the point that was filled in; elsewhere equal

figure = Figure(layout="constrained")
axes = figure.subplots()
image = axes.imshow(1e6 * heights.T, origin="lower", extent=(0, 1e3 * side, 0, 1e3 * side))
axes.set(xlabel="x [mm]", ylabel="y [mm]", title=f"stiffness {found.value[0]:.3g} N/m within {found.error:.0%}")
figure.colorbar(image, label="height [µm]")
figure.savefig("own_heights.png")
