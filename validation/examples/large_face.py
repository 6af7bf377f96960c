"""A large measured face: 2048 x 2048 heights pressed on a half-space, with all cores of the machine."""

import numpy as np
from matplotlib.figure import Figure

import bem3d
import mdr

n, spacing, modulus = 2048, 0.5e-6, 115e9  # a square millimetre, steel on steel: E* = 210 GPa / (2 (1 - 0.3²))

# in place of np.load("face.npy"): heights of a profilometer in metres, without gaps, on a table that was tilted
q_min, q_max = 2 * np.pi / (0.25 * n * spacing), 2 * np.pi / (8 * spacing)
ground = mdr.SelfAffine(hurst=0.8, q_min=q_min, q_max=q_max, rms=1e-6)
rng, x = np.random.default_rng(7), np.linspace(-1, 1, n)
heights = bem3d.rough_surface(ground.c2d, shape=(n, n), spacing=spacing, rng=rng, rms=ground.rms)
heights += 3e-6 * x[:, np.newaxis] - 1e-6 * x

# less its mean plane: on a full grid the slopes along both axes are independent
down, across = (np.average(heights, axis=axis) for axis in (1, 0))
heights -= np.polyval(np.polyfit(x, down, 1), x)[:, np.newaxis] + np.polyfit(x, across, 1)[0] * x

half_space = bem3d.HalfSpace(shape=(n, n), spacing=spacing, modulus=modulus, threads="all")
contact = bem3d.solve(half_space, -heights, force=100.0, indenter_ends_at_edge=True, tolerance=1e-5)
print(f"{contact.area / (n * spacing) ** 2:.1%} of the face in contact under {contact.force:.0f} N,")
print(
    f"k = {contact.stiffness(tolerance=1e-3):.3g} N/m, peak {contact.pressure.max() / 1e9:.1f} GPa if nothing yields,"
)
print(f"{contact.operator_applications} applications of the operator on {n} x {n} cells")
assert abs(heights.mean()) < 1e-12
assert contact.converged and contact.operator_applications < 40

figure = Figure(layout="constrained")
axes = figure.subplots()
part = contact.pressure[: n // 4, : n // 4] / 1e9
image = axes.imshow(
    part.T, origin="lower", cmap="cividis", extent=(0, n // 4 * spacing * 1e6, 0, n // 4 * spacing * 1e6)
)
axes.set(xlabel="x [µm]", ylabel="y [µm]", title="a sixteenth of the face")
figure.colorbar(image, label="pressure [GPa]")
figure.savefig("large_face.png")
