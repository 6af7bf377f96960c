"""Self-affine roughness drawn in one and in two dimensions, and measured back."""

from dataclasses import dataclass

import numpy as np

import bem3d
import mdr
from validation.engine.engine import Outcome
from validation.engine.random_numbers import random_generator


@dataclass(frozen=True, kw_only=True)
class RoughnessDraw:
    """One realisation. spectrum: C_2D of the surface; length: period [m]; cells: a side and along the profile; seed:
    zero or positive."""

    spectrum: mdr.SelfAffine
    length: float
    cells: int
    seed: int
    realisation: int


def measure_profile(draw: RoughnessDraw) -> Outcome:
    """Mean squares of height, gradient and curvature of a profile drawn by Geike's rule, and its spectrum."""
    rng = random_generator(draw.seed, 1, draw.realisation)
    height = mdr.rough_profile(draw.spectrum.c1d, length=draw.length, points=draw.cells, rng=rng)
    power = np.abs(np.fft.fft(height, norm="forward")) ** 2
    q = 2 * np.pi * np.abs(np.fft.fftfreq(draw.cells, draw.length / draw.cells))
    return {
        "height": np.mean(height**2),
        "gradient": np.sum(q**2 * power),
        "curvature": np.sum(q**4 * power),
        "spectrum": power[: draw.cells // 2] * draw.length / (2 * np.pi),
    }


def measure_surface(draw: RoughnessDraw) -> Outcome:
    """Mean squares of height, gradient and curvature of a surface, and the spectrum of its lines."""
    spacing = draw.length / draw.cells
    rng = random_generator(draw.seed, 2, draw.realisation)
    height = bem3d.rough_surface(draw.spectrum.c2d, shape=(draw.cells, draw.cells), spacing=spacing, rng=rng)
    power = np.abs(np.fft.fft2(height, norm="forward")) ** 2
    q = 2 * np.pi * np.fft.fftfreq(draw.cells, spacing)
    square = q[:, np.newaxis] ** 2 + q**2
    lines = np.mean(np.abs(np.fft.fft(height, axis=0, norm="forward")) ** 2, axis=1)
    return {
        "height": np.mean(height**2),
        "gradient": np.sum(square * power),
        "curvature": np.sum(square**2 * power),
        "spectrum": lines[: draw.cells // 2] * draw.length / (2 * np.pi),
    }
