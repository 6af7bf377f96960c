"""Displacements by operators that a contact solver may have by mistake."""

import math
from collections.abc import Callable, Iterator
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from validation.benchmarks.discrete import ContactProblem
from validation.judging.registry import FloatArray
from validation.theory.half_space import love

Spacing = tuple[float, float]
Operator = Callable[[ContactProblem, FloatArray], FloatArray]
"""u [m] (n, m) of a problem under a pressure [Pa] (n, m)."""


@lru_cache(maxsize=64)
def _symbol(shape: tuple[int, int], padded: tuple[int, int], spacing: Spacing, kind: str) -> NDArray[np.complex128]:
    """Of E* = 1; padded: cells of the period of each axis; kind: of the kernel."""
    if kind == "waves":
        q = (
            2
            * math.pi
            * np.hypot(fft.fftfreq(padded[0], spacing[0])[:, np.newaxis], fft.rfftfreq(padded[1], spacing[1]))
        )
        return np.asarray(np.divide(2.0, q, out=np.zeros_like(q), where=q > 0), dtype=np.complex128)
    (dx, dy), (x, y) = spacing, (fft.fftfreq(n, 1 / n) * d for n, d in zip(padded, spacing, strict=True))
    x = x[:, np.newaxis]
    if kind == "points":
        r = np.hypot(x, y)
        return np.asarray(fft.rfft2(np.divide(dx * dy / math.pi, r, out=np.zeros_like(r), where=r > 0)))
    shift = {"half a cell along axis 0": (0.5, 0.0), "half a cell along axis 1": (0.0, 0.5), "half a cell": (0.5, 0.5)}
    i, j = shift.get(kind, (0.0, 0.0))
    return np.asarray(fft.rfft2(love(x + i * dx, y + j * dy, dx, dy) / math.pi))


def displaced(
    problem: ContactProblem,
    pressure: FloatArray,
    kind: str = "love",
    *,
    spacing: Spacing | None = None,
    padded: tuple[bool, bool] = (True, True),
) -> FloatArray:
    """By circular convolution over the grid, along a padded axis over twice its cells."""
    n, m = problem.gap.shape
    period = n * (1 + padded[0]), m * (1 + padded[1])
    symbol = _symbol((n, m), period, spacing or problem.spacing, kind)
    return np.asarray(fft.irfft2(fft.rfft2(pressure, period) * symbol, period)[:n, :m] / problem.modulus)


def of_half_space(periodic: bool, spacing: Callable[[Spacing], Spacing] = lambda d: d) -> Operator:
    """The right operator of this half-space, on cells of another spacing."""

    def operator(problem: ContactProblem, pressure: FloatArray) -> FloatArray:
        if periodic:
            return displaced(problem, pressure, "waves", spacing=spacing(problem.spacing), padded=(False, False))
        return displaced(problem, pressure, spacing=spacing(problem.spacing))

    return operator


def _kernel(kind: str = "love", padded: tuple[bool, bool] = (True, True)) -> Operator:
    return lambda problem, pressure: displaced(problem, pressure, kind, padded=padded)


def point_loads(problem: ContactProblem, pressure: FloatArray) -> FloatArray:
    """Between cells; the displacement of a cell under its own pressure is what fits the contact best."""
    u, own = displaced(problem, pressure, "points"), pressure / problem.modulus * math.sqrt(math.prod(problem.spacing))
    touching = pressure > 1e-3 * pressure.max()
    columns = np.stack([np.ones(np.count_nonzero(touching)), -own[touching]], axis=1)
    (_, factor), *_ = np.linalg.lstsq(columns, (problem.gap + u)[touching], rcond=None)
    return np.asarray(u + factor * own)


def operators(problem: ContactProblem) -> Iterator[tuple[str, Operator]]:
    """Those that differ from the right one of a problem, each with its name, the more specific first."""
    dx, dy = problem.spacing
    if problem.periodic:
        yield "the answer of a free half-space", of_half_space(False)
        yield "periodic images of Love's kernel within one period alone", _kernel(padded=(False, False))
    else:
        yield "the answer of a periodic half-space: no padding", of_half_space(True)
        yield "no padding", _kernel(padded=(False, False))
        yield "no padding along axis 0", _kernel(padded=(False, True))
        yield "no padding along axis 1", _kernel(padded=(True, False))
        yield "the waves of a periodic half-space on a padded grid", _kernel("waves")
        yield "no padding along axis 0, by the waves of a periodic half-space", _kernel("waves", (False, True))
        yield "no padding along axis 1, by the waves of a periodic half-space", _kernel("waves", (True, False))
        yield "point loads instead of Love's rectangles", point_loads
        for half in ("half a cell along axis 0", "half a cell along axis 1", "half a cell"):
            yield f"a kernel that is off by {half}", _kernel(half)
    if dx != dy:
        yield "the answer with dx and dy exchanged", of_half_space(problem.periodic, lambda d: d[::-1])
        yield "the answer with dx for dy", of_half_space(problem.periodic, lambda d: (d[0], d[0]))
        yield "the answer with dy for dx", of_half_space(problem.periodic, lambda d: (d[1], d[1]))


def dense(problem: ContactProblem) -> FloatArray:
    """The operator of a free half-space as a matrix, of all cells [m/Pa]."""
    (n, m), (dx, dy) = problem.gap.shape, problem.spacing
    x, y = (np.arange(count, dtype=np.float64) * d for count, d in ((n, dx), (m, dy)))
    table = love(x[:, np.newaxis], y, dx, dy) / (math.pi * problem.modulus)
    i, j = (index.ravel() for index in np.indices((n, m)))
    return np.asarray(table[np.abs(i[:, np.newaxis] - i), np.abs(j[:, np.newaxis] - j)])
