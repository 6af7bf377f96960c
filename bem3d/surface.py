"""Rough surfaces drawn from an isotropic spectrum.

h(x) = sum_q B(q) exp(i (q.x + phi(q))), B(q) = 2 pi sqrt(C_2D(q) / (Lx Ly)), over the waves q = 2 pi (i/Lx, j/Ly) of
the grid, with phi uniform in [0, 2 pi) and phi(-q) = -phi(q); Popov and Hess, (14.8) in two dimensions. The mean
square is sum_q (2 pi)^2 C_2D / (Lx Ly) over these waves, which tends to int C_2D d^2q. It exceeds that integral where
the band begins at 2 pi / L.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
import scipy
from numpy.typing import NDArray

from bem3d.checks import (
    FloatArray,
    OneOrTwo,
    Spectrum,
    callable_spectrum,
    density,
    fits,
    grid_shape,
    grid_spacing,
    positive,
)
from bem3d.diagnostics import diagnose_waves, warn

ComplexArray = NDArray[np.complex128]
BYTES_A_CELL = 48
"""At the height of a draw, measured: six times what it returns."""


def rough_surface(
    c2d: Spectrum,
    *,
    shape: tuple[int, int],
    spacing: OneOrTwo,
    rng: np.random.Generator,
    rms: float | None = None,
    amplitudes: Literal["fixed", "gaussian"] = "fixed",
) -> FloatArray:
    """Draw a periodic rough surface with a given isotropic spectrum.

    Parameters
    ----------
    c2d : callable
        Isotropic spectrum C_2D(q) [m^4] of arrays of q > 0 [rad/m], zero beyond the smaller Nyquist wavenumber.
    shape, spacing
        Cells (nx, ny) and their sides, as in `HalfSpace`.
    rng : numpy.random.Generator
        Source of the phases. The same seed on a finer grid of the same proportions draws the same surface.
    rms : float, optional
        Root mean square height [m], exact (fixed) or expected (Gaussian). By default the amplitudes follow the
        spectrum.
    amplitudes : {"fixed", "gaussian"}, optional
        "fixed": every draw has the mean square of the sum over its waves. "gaussian": only the expectation has.

    Returns
    -------
    ndarray, shape (nx, ny)
        Heights at the centres of the cells, of mean zero, positive towards the other body [m].

    Raises
    ------
    ValueError, TypeError, MemoryError
        If the spectrum has power beyond the Nyquist wavenumber or none below, or an argument is out of range.

    Warns
    -----
    ResolutionWarning
        If the shortest wave has fewer than four cells.

    Examples
    --------
    >>> def c2d(q):
    ...     return np.where((q > 1e4) & (q < 1e5), q**-3.6, 0.0)
    >>> height = bem3d.rough_surface(c2d, shape=(64, 64), spacing=1e-5, rng=np.random.default_rng(1), rms=1e-6)
    >>> print(f"rms = {height.std():.4g} m")
    rms = 1e-06 m
    """
    shape, steps = grid_shape(shape), grid_spacing(spacing)
    _check_draw(rng, amplitudes)
    fits("shape", f"{shape[0]} x {shape[1]}", BYTES_A_CELL * shape[0] * shape[1])
    lengths = shape[0] * steps[0], shape[1] * steps[1]
    i, j, q = _waves(shape, lengths)
    values = _resolved(c2d, q, steps)
    warn(diagnose_waves(values, q, steps))
    variance = (2 * np.pi) ** 2 / (lengths[0] * lengths[1]) * values
    spectrum = _amplitudes(variance, (j == 0) | (2 * j == shape[1]), rms) * _random_waves(i, j, shape, amplitudes, rng)
    spectrum *= _half_a_cell(i, shape[0]) * _half_a_cell(j, shape[1])
    return np.asarray(scipy.fft.irfft2(spectrum, shape, norm="forward"))


def _waves(shape: tuple[int, int], lengths: tuple[float, float]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Numbers of waves along both axes, and wavenumbers, of the half spectrum of a real field."""
    i = np.rint(scipy.fft.fftfreq(shape[0]) * shape[0])[:, np.newaxis]
    j = np.arange(shape[1] // 2 + 1.0)[np.newaxis, :]
    return i, j, 2 * np.pi * np.hypot(i / lengths[0], j / lengths[1])


def _check_draw(rng: object, amplitudes: str) -> None:
    if not isinstance(rng, np.random.Generator):
        raise TypeError(f"rng must be a numpy.random.Generator, got {type(rng).__name__}")
    if amplitudes not in ("fixed", "gaussian"):
        raise ValueError(f'amplitudes must be "fixed" or "gaussian", got {amplitudes!r}')


def _amplitudes(variance: FloatArray, mirrored: NDArray[np.bool_], rms: float | None) -> FloatArray:
    """Amplitudes of waves of these variances, scaled to the root mean square height.

    mirrored: columns of the half spectrum that show waves with their mirror images; all others show each wave once.
    """
    total = np.sum(np.where(mirrored, 1, 2) * variance)
    if total == 0:
        raise ValueError("c2d has no power at any wave that shape and spacing can carry")
    scale = 1.0 if rms is None else positive("rms", rms) / np.sqrt(total)
    return np.asarray(scale * np.sqrt(variance))


def _resolved(c2d: Spectrum, q: FloatArray, steps: tuple[float, float]) -> FloatArray:
    """c2d at the waves of the grid without the zero mode; ValueError where its curvature spectrum exceeds Nyquist."""
    c2d = callable_spectrum("c2d", c2d)
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
