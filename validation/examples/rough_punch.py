"""A rough punch: its stiffness scatters from surface to surface, and from profile to profile of the 1D model."""

import numpy as np
from matplotlib.figure import Figure

import bem3d
import mdr

side, modulus, h, n = 1e-3, 2e9, 1e-6, 64
force = 0.1 * modulus * h * side
rough = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi / side, q_max=2 * np.pi / side * n / 4, rms=h)

# one dimension: many profiles with the spectrum of Geike's rule
profiles = mdr.rough_profiles(rough.c1d, length=side, points=512, count=200, rng=np.random.default_rng(1), rms=h)
springs = mdr.stiffness_under(force, profiles, length=side, modulus=modulus)

# three dimensions: a dozen surfaces of the same roughness
half_space = bem3d.HalfSpace(shape=(n, n), spacing=side / n, modulus=modulus)
surfaces = []
for seed in range(12):
    rng = np.random.default_rng(seed)
    gap = -bem3d.rough_surface(rough.c2d, shape=(n, n), spacing=side / n, rng=rng, rms=h)
    (contact,) = bem3d.indent(half_space, gap, forces=[force], stiffness=True, indenter_ends_at_edge=True)
    surfaces.append(contact.stiffness())

found = {"springs": springs, "boundary elements": np.array(surfaces)}
for name, stiffness in found.items():
    print(f"{name:18s} {stiffness.mean():.3g} N/m, scatter {stiffness.std(ddof=1) / stiffness.mean():.0%}")
    assert 0.1 < stiffness.std(ddof=1) / stiffness.mean() < 0.4
assert abs(springs.mean() / np.mean(surfaces) - 1) < 0.25

figure = Figure(layout="constrained")
axes = figure.subplots()
axes.boxplot([*found.values()], tick_labels=[*found])
axes.set_ylabel("contact stiffness [N/m]")
figure.savefig("rough_punch.png")
