"""Parallel lines drawn as sums of oblique plane waves, by code that knows no coherence."""

import math

import numpy as np

WAVES = 48
"""Directions of each wavenumber along the track."""


def draw_lines(rng, structure, exponent, *, positions, length=15.0, spacing=1e-3, rms=2e-5):
    """Heights (points, lines) of a surface of twice the length; C_line ~ q^-exponent from 3 m on.

    structure: alpha, of equal power at abs(k_y) < alpha k_x; "isotropic": C_2D ~ k^-(exponent + 1), so that k_y / k_x
    has the density of Student over its root of the exponent; "ridges".
    """
    points = round(length / spacing)
    k = 2 * math.pi * np.arange(1, points) / (2 * points * spacing)
    shape = (k.size, WAVES)
    amplitude = np.where(k >= 2 * math.pi / 3, k ** (-exponent / 2), 0.0)[:, np.newaxis] * rng.rayleigh(1.0, shape)
    waves = amplitude * np.exp(2j * math.pi * rng.random(shape))
    if structure == "isotropic":
        slope = rng.standard_t(exponent, shape) / math.sqrt(exponent)
    else:
        slope = (0.0 if structure == "ridges" else structure) * rng.uniform(-1.0, 1.0, shape)
    lines = np.zeros((points + 1, len(positions)), dtype=complex)
    for j, y in enumerate(positions):
        lines[1:points, j] = (waves * np.exp(1j * k[:, np.newaxis] * slope * y)).sum(axis=1)
    heights = np.fft.irfft(lines, 2 * points, axis=0)[:points]
    return heights * rms / heights.std()
