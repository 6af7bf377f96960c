"""A wheel with a mass on springs: it answers at the resonance of contact stiffness and mass."""

import math

import numpy as np
from matplotlib.figure import Figure

from validation import RollingScene, load_scene
from validation.analysis.spectra import peak, record_spectra
from validation.simulation.contact_laws import SpringsLaw
from validation.simulation.motion import simulate
from validation.simulation.wheel_on_springs import WheelEnsemble

scene = load_scene("table_14_1")
assert isinstance(scene, RollingScene)  # a wheel with a mass, and a track to roll along
wheel = scene.body
eigenfrequency = math.sqrt(wheel.stiffness / wheel.mass)  # k = 2 E* a

tracks = WheelEnsemble(scene=scene, count=20, seed=1).heights()
law = SpringsLaw(wheel, tracks, scene.spacing)
motion = simulate(wheel, law, time_step=scene.time_step, steps=16384)  # from static equilibrium
record = record_spectra(motion.acceleration, time_step=motion.time_step, window="hann")
density = record.density.mean(axis=1)
found = peak(record.omega, density, below=scene.jump / 2)

print(f"resonance: springs {found:.4g} rad/s, sqrt(k / M) {eigenfrequency:.4g} rad/s")
assert abs(found / eigenfrequency - 1) < 0.1
assert not motion.airborne.any()  # the roughness is too low to lift it off

figure = Figure(layout="constrained")
axes = figure.subplots()
inside = slice(1, int(np.searchsorted(record.omega, 2 * scene.jump)))
axes.loglog(record.omega[inside], density[inside])
axes.axvline(eigenfrequency, color="k", linestyle=":")
axes.set(xlabel="omega [rad/s]", ylabel="power density of the acceleration")
figure.savefig("dynamic_wheel.png")
