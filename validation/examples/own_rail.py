"""A rail of one's own: measured levels of one line, a wheel with a load, and the contact filter of both."""

from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import validation
from validation.theory.contact_filters import half_space_filter
from validation.theory.line_spectrum import LineSpectrum
from validation.theory.transverse_structure import IsotropicGround, Ridges

LEVELS = """wavelength [mm],level [dB re 1 um]
200,6\n160,5\n125,4\n100,3\n80,2\n63,1\n50,0\n40,-1\n31.5,-2\n25,-3\n20,-4\n16,-5\n12.5,-6\n10,-7\n"""
Path("levels.csv").write_text(LEVELS)
scene_file = Path("my_rail.toml")
scene_file.write_text("""
name = "my rail"
material = { youngs_modulus = "210 GPa", poisson_ratio = 0.3, counterface = "same" }
wheel = { diameter = "920 mm", load = "50 kN", speed = "80 km/h" }
rail = { crown_radius = "300 mm", across = "isotropic", levels = { file = "levels.csv" } }
""")
scene = validation.load_scene(scene_file)
assert isinstance(scene, validation.RailScene)
contact, levels = scene.contact, scene.levels
print(f"semi-axes {1e3 * contact.along:.2f} mm along, {1e3 * contact.across:.2f} mm across the rail")

line, semi_axes = LineSpectrum(*map(tuple, levels.nodes)), (contact.along, contact.across)
transfer = partial(half_space_filter, semi_axes=semi_axes)
filters = {
    name: 10 * np.log10(across.band_power(line, transfer, edges=levels.bands.edges, semi_axes=semi_axes))
    for name, across in {"ridges": Ridges(), "isotropic": IsotropicGround(line)}.items()
}
at_20_mm = {name: float(decibels[levels.bands.nominal == 0.020][0]) for name, decibels in filters.items()}
print(at_20_mm)
assert filters["isotropic"][0] > -0.5  # long waves pass
assert at_20_mm["isotropic"] < at_20_mm["ridges"] - 1  # what lies across decides
assert abs(at_20_mm["isotropic"] + 8.0) < 3  # -8.0 dB in the table of CNOSSOS-EU, for 50 kN and 920 mm

figure = Figure(layout="constrained")
axes = figure.subplots()
for name, decibels in filters.items():
    axes.semilogx(1e3 * levels.bands.nominal, decibels, "o-", label=name)
axes.set(xlabel="wavelength [mm]", ylabel="contact filter [dB]")
axes.invert_xaxis()
axes.legend()
figure.savefig("own_rail.png")
