"""Rough profiles drawn from a spectrum.

h(x) = sum_q B(q) exp(i (q x + phi(q))), B(q) = sqrt(2 pi C_1D(q) / L), over all waves q = 2 pi j / L, with phi
uniform in [0, 2 pi) and phi(-q) = -phi(q); Popov and Hess, (14.8), and (14.9) with the root over all of it. The mean
square is sum_q 2 pi C_1D(q) / L over these waves. That exceeds int C_1D dq where the band begins at 2 pi / L.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from mdr.checks import FloatArray, Spectrum, callable_spectrum, density, doubles, fits, held, positive
from mdr.checks import count as whole
from mdr.diagnostics import SpringContactWarning, diagnose_waves, warn

BYTES_A_POINT = 40
"""At the height of a draw, measured: five times what it returns."""


def rough_profile(
    c1d: Spectrum,
    *,
    length: float,
    points: int,
    rng: np.random.Generator,
    rms: float | None = None,
    amplitudes: Literal["fixed", "gaussian"] = "fixed",
) -> FloatArray:
    """Draw a periodic rough profile with a given spectrum.

    Parameters
    ----------
    c1d : callable
        Two-sided power spectral density C_1D(q) [m^3] of wavenumbers q > 0 [rad/m], for arrays. It must vanish beyond
        the Nyquist wavenumber, pi points / L.
    length, points : float, int
        Period L [m]; number of heights, at least 2.
    rng : numpy.random.Generator
        Source of the phases. Waves take their random numbers in the order of q, so that the same seed on more points
        draws the same profile.
    rms : float, optional
        Root mean square height [m], exact (fixed) or expected (Gaussian). By default the amplitudes follow the
        spectrum.
    amplitudes : {"fixed", "gaussian"}, optional
        "fixed": every draw has the mean square of the sum over its waves. "gaussian": only the expectation has.

    Returns
    -------
    ndarray, shape (points,)
        Heights at x_i = (i + 1/2) L / points, of mean zero, positive towards the other body [m].

    Raises
    ------
    ValueError, TypeError, MemoryError
        If the spectrum has power beyond the Nyquist wavenumber or none below, or an argument is out of range.

    Warns
    -----
    SpringResolutionWarning
        If the shortest wave has fewer than four points.

    Notes
    -----
    Waves of the amplitudes sqrt(2 pi C_1D / L) and random phases; Popov and Hess, (14.8) and (14.9).

    Examples
    --------
    >>> rough = mdr.SelfAffine(hurst=0.8, q_min=1e4, q_max=1e5, rms=1e-6)
    >>> height = mdr.rough_profile(rough.c1d, length=2e-3, points=512, rng=np.random.default_rng(1), rms=rough.rms)
    >>> print(f"rms = {height.std():.4g} m")
    rms = 1e-06 m
    """
    length, points = positive("length", length), whole("points", points, least=2)
    _check_draw(rng, amplitudes)
    fits("points", points, BYTES_A_POINT * points)
    amplitude, own_mirror, diagnostics = _amplitudes(c1d, length, points, rms)
    warn(diagnostics)
    return _drawn(amplitude * _random_waves((amplitude.size,), own_mirror, amplitudes, rng), own_mirror, points)


def rough_profiles(
    c1d: Spectrum,
    *,
    length: float,
    points: int,
    count: int,
    rng: np.random.Generator,
    rms: float | None = None,
) -> FloatArray:
    """Draw several periodic rough profiles at once, with fixed amplitudes.

    Parameters
    ----------
    c1d : callable
        Two-sided power spectral density C_1D(q) [m^3], as in `rough_profile`.
    length : float
        Period L [m].
    points : int
        Number of heights of each profile, at least 2.
    count : int
        Number of profiles, at least 1.
    rng : numpy.random.Generator
        Source of the phases.
    rms : float, optional
        Root mean square height of each profile [m], as in `rough_profile`.

    Returns
    -------
    ndarray, shape (count, points)
        The profiles that ``count`` calls of `rough_profile` with the same generator draw [m].

    Raises
    ------
    ValueError, TypeError, MemoryError
        As `rough_profile`.

    Warns
    -----
    SpringResolutionWarning
        If the shortest wave has fewer than four points.

    Examples
    --------
    >>> rough = mdr.SelfAffine(hurst=0.8, q_min=1e4, q_max=1e5, rms=1e-6)
    >>> draw = {"length": 2e-3, "points": 512, "rms": rough.rms}
    >>> many = mdr.rough_profiles(rough.c1d, count=3, rng=np.random.default_rng(1), **draw)
    >>> bool((many[0] == mdr.rough_profile(rough.c1d, rng=np.random.default_rng(1), **draw)).all())
    True
    """
    length, points = positive("length", length), whole("points", points, least=2)
    count = whole("count", count, least=1)
    _check_draw(rng, "fixed")
    fits("count", f"{count} of {points} points", BYTES_A_POINT * points * count)
    amplitude, own_mirror, diagnostics = _amplitudes(c1d, length, points, rms)
    warn(diagnostics)
    turns = _random_waves((count, amplitude.size), own_mirror, "fixed", rng)
    return _drawn(amplitude * turns, own_mirror, points)


def _check_draw(rng: object, amplitudes: str) -> None:
    if not isinstance(rng, np.random.Generator):
        raise TypeError(f"rng must be a numpy.random.Generator, got {type(rng).__name__}")
    if amplitudes not in ("fixed", "gaussian"):
        raise ValueError(f'amplitudes must be "fixed" or "gaussian", got {amplitudes!r}')


def _amplitudes(
    c1d: Spectrum, length: float, points: int, rms: float | None
) -> tuple[FloatArray, np.ndarray, tuple[SpringContactWarning, ...]]:
    """B(q) of the waves that the points can carry, which of them is its own mirror image, and diagnostics."""
    mode = np.arange(1, points // 2 + 1)
    with doubles(length=length, points=points):
        q = np.asarray(2 * np.pi / length * mode, dtype=np.float64)
        held(q, positive=True)
    values = _resolved(c1d, q, np.pi * points / length)
    if not values.any():
        raise ValueError("c1d has no power at any wave that length and points can carry")
    own_mirror = 2 * mode == points
    with doubles(c1d=float(values.max()), length=length, rms=rms):
        variance = 2 * np.pi / length * values
        total = np.sum(np.where(own_mirror, 1, 2) * variance)
        held(total, positive=True)
        scale = 1.0 if rms is None else positive("rms", rms) / np.sqrt(total)
        amplitude = scale * np.sqrt(variance)
        held(amplitude, np.sum(amplitude))
    return amplitude, own_mirror, diagnose_waves(values, q, length / points)


def _drawn(wave: np.ndarray, own_mirror: np.ndarray, points: int) -> FloatArray:
    """Heights at the middle of the points, of waves along the last axis."""
    half_a_cell = np.where(own_mirror, 1.0, np.exp(1j * np.pi * np.arange(1, points // 2 + 1) / points))
    mean = np.zeros((*wave.shape[:-1], 1))
    return np.fft.irfft(np.concatenate([mean, wave * half_a_cell], axis=-1), points, norm="forward")


def _random_waves(
    shape: tuple[int, ...], own_mirror: np.ndarray, amplitudes: Literal["fixed", "gaussian"], rng: np.random.Generator
) -> np.ndarray:
    """Complex factors of mean square one; real where a wave is its own mirror image."""
    if amplitudes == "fixed":
        turn = np.asarray(np.exp(2j * np.pi * rng.random(shape)))
        turn[..., own_mirror] = np.copysign(1.0, turn[..., own_mirror].real)
        return turn
    pair = rng.standard_normal((*shape, 2))
    return np.where(own_mirror, pair[..., 0], (pair[..., 0] + 1j * pair[..., 1]) / np.sqrt(2))


def _resolved(c1d: Spectrum, q: FloatArray, nyquist: float) -> FloatArray:
    """c1d at the waves of the grid; ValueError where its curvature spectrum extends beyond the Nyquist wavenumber."""
    c1d = callable_spectrum("c1d", c1d)
    values = density("c1d", c1d(q))
    if values.shape != q.shape:
        raise ValueError(f"c1d must return one value a wavenumber, got shape {values.shape} for {q.shape}")
    beyond = nyquist * np.geomspace(1 + 1e-6, 1e3, 4096)
    # in units of the Nyquist wavenumber, whose fourth power may not be a number that there is
    within = np.max((q / nyquist) ** 4 * values)
    if np.max((beyond / nyquist) ** 4 * density("c1d", c1d(beyond))) > 1e-9 * within:
        raise ValueError(
            f"c1d must vanish beyond the Nyquist wavenumber of the points, {nyquist:.6g} rad/m, "
            "got power there: lower q_max or take more points"
        )
    return values
