"""Rough surfaces and tracks: drawn from a spectrum and measured back, measured elsewhere, and on a finer grid."""

import math
import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy

import bem3d
import mdr
from bem3d.checks import Spectrum
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import random_generator
from validation.scenes.measured_heights import MeasuredHeights
from validation.scenes.roughness import RoughSurface
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, TrackSpectrum


def draw_surface(c2d: Spectrum, **settings: Any) -> FloatArray:
    """`bem3d.rough_surface`, silent about few cells to a wave: grids are compared, and what they leave is measured."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        return bem3d.rough_surface(c2d, **settings)


def draw_track(
    surface: PiecewisePowerLaw | RoughSurface,
    rule: InputSpectrum,
    *,
    rms: float,
    contact_radius: float = 1.0,
    **settings: Any,
) -> FloatArray:
    """`mdr.rough_profile` for an isotropic surface: of Geike's rule, which keeps it, with its rms height."""
    c1d = TrackSpectrum(surface, rule, contact_radius)
    return mdr.rough_profile(c1d, rms=rms if rule == "geike" else None, **settings)


def surface_on_grid(
    ground: RoughSurface, *, shape: tuple[int, int], spacing: float, rng: np.random.Generator
) -> FloatArray:
    """Heights at the centres of cells: a realisation with the rms height, or the mean of what was measured."""
    if isinstance(ground, MeasuredHeights):
        return ground.mean_over_cells(shape, spacing)
    return draw_surface(ground.c2d, shape=shape, spacing=spacing, rng=rng, rms=ground.rms)


def middle_of(surface: FloatArray, half_width: float, spacing: float, more: int = 1) -> FloatArray:
    """The columns that reach so far to both sides, and so many more, or all that there are."""
    middle = surface.shape[1] // 2
    side = min(math.ceil(half_width / spacing) + more, middle)
    return surface[:, middle - side : surface.shape[1] - middle + side]


def refined(height: FloatArray, cells: int) -> FloatArray:
    """Heights at the centres of cells x cells of a periodic surface that is known at those of fewer.

    h(x) = sum_q c_q exp(i q x) over the waves longer than two cells of the coarse grid, whose c_q follow from its
    heights; waves of just two cells are lost.

    height: shape (n, n), of the period of the fine grid; cells: n or more. Returns shape (cells, cells).
    Raises ValueError where the height is not square, or has more cells.
    """
    coarse = len(height)
    if height.shape != (coarse, coarse) or coarse > cells:
        raise ValueError(f"height must have shape (n, n) with n up to cells = {cells}, got {height.shape}")
    if coarse == cells:
        return height
    most = (coarse - 1) // 2
    along, across = np.arange(-most, most + 1), np.arange(most + 1)
    # from the centre of a coarse cell to that of a fine one, both half a cell off their corner
    shift = np.pi / cells - np.pi / coarse
    waves = scipy.fft.rfft2(height, norm="forward")[along[:, np.newaxis], across]
    waves *= np.exp(1j * shift * along)[:, np.newaxis] * np.exp(1j * shift * across)
    fine = np.zeros((cells, cells // 2 + 1), dtype=np.complex128)
    fine[along[:, np.newaxis], across] = waves
    return np.asarray(scipy.fft.irfft2(fine, (cells, cells), norm="forward"))


@dataclass(frozen=True, kw_only=True)
class RoughnessDraw:
    """spectrum: C_2D of the surface; length: period [m]; cells: a side and along the profile; seed."""

    spectrum: mdr.SelfAffine
    length: float
    cells: int
    seed: int


def measure_profile(draw: RoughnessDraw) -> Outcome:
    """Mean squares of height, gradient and curvature of a profile drawn by Geike's rule, and its spectrum."""
    rng = random_generator(draw.seed, 1)
    height = mdr.rough_profile(draw.spectrum.c1d, length=draw.length, points=draw.cells, rng=rng)
    power = np.abs(np.fft.fft(height, norm="forward")) ** 2
    q = 2 * np.pi * np.abs(np.fft.fftfreq(draw.cells, draw.length / draw.cells))
    moments = [np.sum(q**n * power) for n in (0, 2, 4)]
    return {"moments": np.array(moments), "spectrum": power[: draw.cells // 2] * draw.length / (2 * np.pi)}


def measure_surface(draw: RoughnessDraw) -> Outcome:
    """Mean squares of height, gradient and curvature of a surface, and the spectrum of its lines."""
    spacing = draw.length / draw.cells
    rng = random_generator(draw.seed, 2)
    height = bem3d.rough_surface(draw.spectrum.c2d, shape=(draw.cells, draw.cells), spacing=spacing, rng=rng)
    power = np.abs(np.fft.fft2(height, norm="forward")) ** 2
    q = 2 * np.pi * np.fft.fftfreq(draw.cells, spacing)
    square = q[:, np.newaxis] ** 2 + q**2
    moments = [np.sum(square**n * power) for n in (0, 1, 2)]
    lines = power.sum(axis=1)[: draw.cells // 2]
    return {"moments": np.array(moments), "spectrum": lines * draw.length / (2 * np.pi)}
