"""Rough profiles drawn from a spectrum; the wheel's parabola."""

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import FloatArray, Spectrum, density, doubles, finite_array, held, positive
from mdr.checks import count as whole
from mdr.diagnostics import Diagnostic, diagnose_waves, warn
from mdr.memory import fits

BYTES_A_POINT = 40
"""At the height of a draw, measured: five times what it returns."""


def sphere_profile(x: ArrayLike, *, radius: float) -> FloatArray:
    """The one-dimensional profile that stands for a sphere of the given radius: x^2 / R, not x^2 / 2R.

    x: distance from the centre of the contact [m]; radius: of the sphere, positive [m]. Returns [m].
    Source: Popov and Hess, (14.2).
    """
    given, radius = finite_array("x", x), positive("radius", radius)
    with doubles(x=float(np.abs(given).max(initial=0.0)), radius=radius):
        profile: FloatArray = given**2 / radius
        held(profile)
    return profile


def rough_profile(
    c1d: Spectrum,
    *,
    length: float,
    points: int,
    rng: np.random.Generator,
    rms: float | None = None,
    amplitudes: Literal["fixed", "gaussian"] = "fixed",
) -> FloatArray:
    """A periodic rough profile with a given spectrum.

    h(x_i) = sum_q B(q) exp(i (q x_i + phi(q))),  B(q) = sqrt(2 pi C_1D(q) / L),  x_i = (i + 1/2) L / points,
    over the waves q = 2 pi j / L that the points can carry, phi uniform in [0, 2 pi), phi(-q) = -phi(q), mean zero.

    c1d: callable, two-sided density, zero beyond the Nyquist wavenumber pi points / L [m^3]; length: period L [m];
    rng: the source of the phases. Waves take their random numbers in order of q, so that the same generator on
    more points draws the same profile, if its band ends below the Nyquist wavenumber of fewer.
    amplitudes: "fixed", where every draw has the same mean square, sum_q 2 pi C_1D(q) / L, exactly (the sum over
    the waves of the period, which exceeds int C_1D dq when the band begins at 2 pi / L); or "gaussian", where
    only its expectation has.
    rms: where given, all amplitudes are scaled by one constant that makes this root mean square exact (fixed) or
    expected (gaussian) [m].
    Returns height, shape (points,), positive towards the other body [m].
    Warns (ResolutionWarning) of a shortest wave of fewer than four springs.
    Raises ValueError for a spectrum with power beyond the Nyquist wavenumber, or none that the points can carry;
    MemoryError for more points than this machine has room for.
    Source: Popov and Hess, (14.8), and (14.9) with the root over all of it.
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
    """So many profiles at once, shape (count, points): those that as many calls of `rough_profile` draw.

    Amplitudes are fixed; everything else as there.
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
) -> tuple[FloatArray, np.ndarray, tuple[Diagnostic, ...]]:
    """B(q) of the waves that the points can carry, which of them is its own mirror image, and what to doubt."""
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
    """c1d at the waves of the grid; refused where its curvature spectrum goes on beyond the Nyquist wavenumber."""
    if not callable(c1d):
        raise TypeError(f"c1d must be a callable c1d(q), got {type(c1d).__name__}")
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
