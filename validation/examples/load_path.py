"""A load path: each contact begins with the one before it, and its stiffness is the slope of the load curve."""

import numpy as np
from matplotlib.figure import Figure

import bem3d
import mdr

side, modulus, h, n = 1e-3, 2e9, 1e-6, 64
rough = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi / side, q_max=2 * np.pi / side * n / 4, rms=h)
surface = bem3d.rough_surface(rough.c2d, shape=(n, n), spacing=side / n, rng=np.random.default_rng(2), rms=h)
half_space = bem3d.HalfSpace(shape=(n, n), spacing=side / n, modulus=modulus)

approaches = np.linspace(-0.5 * h, 2.5 * h, 61)
path = list(
    bem3d.indent(
        half_space, -surface, approaches=approaches, stiffness=True, indenter_ends_at_edge=True, tolerance=1e-8
    )
)
force = np.array([contact.force for contact in path])
stiffness = np.array([contact.stiffness() for contact in path])

slope = np.gradient(force, approaches)
off = np.abs(slope / stiffness - 1)[1:-1]
print(f"stiffness and slope of the load curve differ by {np.median(off):.2%}, median of {off.size} steps")
assert np.median(off) < 0.01
assert (np.diff(force) > 0).all()
assert sum(contact.operator_applications for contact in path[1:]) < 30 * len(path)  # none of them begins cold

figure = Figure(layout="constrained")
axes = figure.subplots()
axes.plot(approaches / h, stiffness, "k-", label="tangent stiffness")
axes.plot(approaches / h, slope, "o", markerfacecolor="none", label="slope of the load curve")
axes.set(xlabel="approach / h", ylabel="stiffness [N/m]")
axes.legend()
figure.savefig("load_path.png")
