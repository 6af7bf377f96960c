"""Heights of one's own: a punch whose face was measured, from an array with its size and from the file of a device."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np

import bem3d
import mdr
import validation

# in place of a file: any object with `heights`, `physical_sizes` and a unit, as a Topography of SurfaceTopography
n, side = 64, 1e-3
rough = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi / side, q_max=2 * np.pi / side * n / 8, rms=1e-6)
heights = bem3d.rough_surface(rough.c2d, shape=(n, n), spacing=side / n, rng=np.random.default_rng(3), rms=1e-6)
ground = validation.measured(SimpleNamespace(heights=heights, physical_sizes=(side, side)), unit="m")
scene = validation.IndentationScene(name="my punch", shape="punch", size=side, load=5.0, modulus=2.3e11, ground=ground)
found = validation.compare(scene, tolerance="30%", solve_all=True)
print(validation.summary(found))
Path("own_heights.png").write_bytes(validation.to_figure(found, form="png"))
assert found.met and found.model.startswith("boundary elements")  # springs know the spectrum, not this one face
assert ground.rms < 1e-6  # the mean plane is removed

# the same face in a file: below a header that names micrometres, longer than wide, a point without data
table = np.pad(1e6 * heights, ((4, 4), (0, 0)))
table[40, 20] = np.nan
np.savetxt("face.csv", table, delimiter=",", header="Instrument 7\nz [um]", comments="")
keys = 'file = "face.csv"\nspacing = "15.625 um"\ncrop = true\nfill = true\n'
body = 'name = "my punch"\npunch = { side = "1 mm", load = "5 N" }\nmaterial = { contact_modulus = "230 GPa" }\n'
Path("my_punch.toml").write_text(f"{body}[heights]\n{keys}", encoding="utf-8")
same = validation.compare(validation.load_scene("my_punch.toml"), tolerance="30%")
assert abs(same.value / found.value - 1) < 0.01  # but for the point filled in
