"""A sphere on a half-space: boundary elements and springs beside Hertz."""

import math

import numpy as np
from matplotlib.figure import Figure

import bem3d
import mdr

radius, modulus, force = 0.5, 2.3e11, 4905.0
a = (3 * force * radius / (4 * modulus)) ** (1 / 3)  # contact radius of Hertz
d, p0 = a**2 / radius, 3 * force / (2 * math.pi * a**2)

# three dimensions: the gap between sphere and half-space on a grid of three contact radii
n = 96
x = (np.arange(n) + 0.5 - n / 2) * 3 * a / n
gap = (x[:, np.newaxis] ** 2 + x**2) / (2 * radius)
half_space = bem3d.HalfSpace(shape=(n, n), spacing=3 * a / n, modulus=modulus)
contact = bem3d.solve(half_space, gap, force=force)

# one dimension: springs under a profile twice as curved as the sphere, x^2 / R
line = np.linspace(-2 * a, 2 * a, 4001)
springs = mdr.load_curve(-mdr.sphere_profile(line, radius=radius), length=4 * a, modulus=modulus).at_force(force)

print(f"approach: Hertz {d:.4g} m, boundary elements {contact.approach:.4g} m, springs {springs.approach:.4g} m")
assert abs(contact.approach / d - 1) < 0.005
assert abs(springs.approach / d - 1) < 0.001
assert abs(contact.pressure.max() / p0 - 1) < 0.01

figure = Figure(layout="constrained")
axes = figure.subplots()
axes.plot(x / a, contact.pressure[n // 2] / p0, "o", label="boundary elements")
axes.plot(x / a, np.sqrt(np.maximum(1 - (x / a) ** 2, 0)), "k-", label="Hertz")
axes.set(xlabel="x / a", ylabel="p / p0")
axes.legend()
figure.savefig("sphere.png")
