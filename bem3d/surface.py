"""Rough surfaces drawn from an isotropic spectrum."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from bem3d.checks import FloatArray, Spectrum, density, grid_shape, grid_spacing, positive
from bem3d.diagnostics import diagnose_waves, warn
from bem3d.memory import fits

ComplexArray = NDArray[np.complex128]
BYTES_A_CELL = 48
"""At the height of a draw, measured: six times what it returns."""


def rough_surface(
    c2d: Spectrum,
    *,
    shape: tuple[int, int],
    spacing: float | tuple[float, float],
    rng: np.random.Generator,
    rms: float | None = None,
    amplitudes: Literal["fixed", "gaussian"] = "fixed",
) -> FloatArray:
    """A periodic rough surface with a given isotropic spectrum.

    h(x) = sum_q B(q) exp(i (q.x + phi(q))),  B(q) = 2 pi sqrt(C_2D(|q|) / (Lx Ly)),  x at the cell centres,
    over the waves q = 2 pi (i/Lx, j/Ly) of the grid, phi uniform in [0, 2 pi), phi(-q) = -phi(q), mean zero.

    c2d: callable of |q|, zero beyond the Nyquist wavenumber of the coarser axis [m^4]; shape: cells (nx, ny);
    spacing: one number or (dx, dy) [m]; rng: the source of the phases. Waves take their random numbers in rings
    from the longest to the shortest, so that the same generator on a finer grid of the same proportions draws the same
    surface, if its band ends below the Nyquist wavenumber of the coarser one.
    amplitudes: "fixed", where every draw has the same mean square, sum_q (2 pi)^2 C_2D / (Lx Ly), exactly (the sum
    over the waves of the grid, which exceeds int C_2D d^2q when the band begins at 2 pi / L); or "gaussian", where
    only its expectation has.
    rms: where given, all amplitudes are scaled by one constant that makes this root mean square exact (fixed) or
    expected (gaussian) [m].
    Returns height, shape (nx, ny), positive towards the other body [m].
    Warns (ResolutionWarning) of a shortest wave of fewer than four cells.
    Raises ValueError for a spectrum with power beyond the Nyquist wavenumber, or none that the grid can carry;
    MemoryError for a shape that this machine has no room for.
    Source: Popov and Hess, (14.8) in two dimensions; sum B^2 must tend to int C_2D d^2q, which sets B.
    """
    shape, steps = grid_shape(shape), grid_spacing(spacing)
    if not isinstance(rng, np.random.Generator):
        raise TypeError(f"rng must be a numpy.random.Generator, got {type(rng).__name__}")
    if amplitudes not in ("fixed", "gaussian"):
        raise ValueError(f'amplitudes must be "fixed" or "gaussian", got {amplitudes!r}')
    fits("shape", f"{shape[0]} x {shape[1]}", BYTES_A_CELL * shape[0] * shape[1])
    i = np.rint(fft.fftfreq(shape[0]) * shape[0])[:, np.newaxis]
    j = np.arange(shape[1] // 2 + 1.0)[np.newaxis, :]
    lengths = shape[0] * steps[0], shape[1] * steps[1]
    q = 2 * np.pi * np.hypot(i / lengths[0], j / lengths[1])
    values = _resolved(c2d, q, steps)
    warn(diagnose_waves(values, q, steps))
    variance = (2 * np.pi) ** 2 / (lengths[0] * lengths[1]) * values
    # the half spectrum shows each wave once, but those of its first and Nyquist column with their mirror images
    twice = np.where((j == 0) | (2 * j == shape[1]), 1, 2)
    total = np.sum(twice * variance)
    if total == 0:
        raise ValueError("c2d has no power at any wave that shape and spacing can carry")
    scale = 1.0 if rms is None else positive("rms", rms) / np.sqrt(total)
    spectrum = scale * np.sqrt(variance) * _random_waves(i, j, shape, amplitudes, rng)
    spectrum *= _half_a_cell(i, shape[0]) * _half_a_cell(j, shape[1])
    height: FloatArray = fft.irfft2(spectrum, shape, norm="forward")
    return height


def _resolved(c2d: Spectrum, q: FloatArray, steps: tuple[float, float]) -> FloatArray:
    """c2d at the waves of the grid without the zero mode; ValueError where its curvature spectrum exceeds Nyquist."""
    if not callable(c2d):
        raise TypeError(f"c2d must be a callable c2d(q), got {type(c2d).__name__}")
    values = np.zeros(q.shape)
    waves = q > 0
    values[waves] = density("c2d", c2d(q[waves]), q[waves].shape)
    nyquist = np.pi / max(steps)
    beyond = nyquist * np.geomspace(1 + 1e-6, 1e3, 4096)
    if np.max(beyond**5 * density("c2d", c2d(beyond), beyond.shape)) > 1e-9 * np.max(q**5 * values):
        raise ValueError(
            f"c2d must vanish beyond the Nyquist wavenumber of the grid, {nyquist:.6g} rad/m, "
            "got power there: lower q_max or refine the grid"
        )
    return values


def _random_waves(
    i: FloatArray,
    j: FloatArray,
    shape: tuple[int, int],
    amplitudes: Literal["fixed", "gaussian"],
    rng: np.random.Generator,
) -> ComplexArray:
    """Complex factors of mean square one on the half spectrum of a real field."""
    # the same order on every grid of these proportions: the waves of a coarse one come first on a finer one
    ring = np.maximum(np.abs(i) * shape[1], j * shape[0])
    order = np.lexsort([key.ravel() for key in (*np.broadcast_arrays(i, j), ring)])
    wave = np.empty(ring.size, dtype=np.complex128)
    if amplitudes == "fixed":
        wave[order] = np.exp(2j * np.pi * rng.random(ring.size))
    else:
        pair = rng.standard_normal((ring.size, 2))
        wave[order] = (pair[:, 0] + 1j * pair[:, 1]) / np.sqrt(2)
    spectrum = wave.reshape(ring.shape)
    for column in {0, shape[1] // 2} if shape[1] % 2 == 0 else {0}:
        spectrum[:, column] = _hermitian(spectrum[:, column], amplitudes)
    return spectrum


def _hermitian(wave: ComplexArray, amplitudes: Literal["fixed", "gaussian"]) -> ComplexArray:
    """The column with wave(-i) = conj(wave(i)): positive rows keep their value, mirror images follow."""
    mirrored = wave.copy()
    points = wave.size
    positive_rows = np.arange(1, points // 2 + 1)
    mirrored[-positive_rows] = np.conj(wave[positive_rows])
    own_mirror = [0, points // 2] if points % 2 == 0 else [0]
    real = np.sqrt(2) * wave[own_mirror].real
    mirrored[own_mirror] = np.copysign(1.0, real) if amplitudes == "fixed" else real
    return mirrored


def _half_a_cell(mode: FloatArray, points: int) -> ComplexArray:
    """Phase from the corner of a cell to its centre; the Nyquist wave is left where it is."""
    return np.where(2 * np.abs(mode) == points, 1.0, np.exp(1j * np.pi * mode / points))
