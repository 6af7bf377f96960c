"""A contact solver that shares no code with the package, right, and wrong in many ways: what `judge` is tried on.

A wrong one is a function of gap, spacing, modulus, load, tolerance that is nothing but the right one with one mistake.
"""

import functools

import numpy as np
from scipy import ndimage
from scipy.optimize import brentq


def corners(x, y):
    """int int dx dy / r, between the corners of a cell."""
    with np.errstate(all="ignore"):
        return np.nan_to_num(x * np.arcsinh(y / abs(x))) + np.nan_to_num(y * np.arcsinh(x / abs(y)))


def distances(n, m, spacing, shift=(0.0, 0.0)):
    (dx, dy), (i, j) = spacing, (np.fft.fftfreq(count, 1 / count) for count in (n, m))
    return (i[:, None] + shift[0]) * dx, (j[None, :] + shift[1]) * dy


def love(n, m, spacing, shift=(0.0, 0.0)):
    """On a period of n times m cells."""
    (x, y), (a, b) = distances(n, m, spacing, shift), np.divide(spacing, 2)
    signs = [(s, t) for s in (1, -1) for t in (1, -1)]
    return sum(s * t * corners(x + s * a, y + t * b) for s, t in signs) / np.pi


def points(n, m, spacing):
    """The cell itself is a disc of its area."""
    area = np.prod(spacing)
    r = np.hypot(*distances(n, m, spacing))
    r[0, 0] = np.sqrt(area / np.pi) / 2
    return area / np.pi / r


def waves(n, m, spacing):
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(n, spacing[0])[:, None], np.fft.rfftfreq(m, spacing[1])[None, :])
    q[0, 0] = np.inf
    return 2 / q


def operator(shape, symbol, period):
    (n, m) = shape
    return lambda p: np.fft.irfft2(np.fft.rfft2(p, period) * symbol, period)[:n, :m]


def free(shape, spacing, kernel=love, padded=(2, 2)):
    """E* = 1."""
    period = shape[0] * padded[0], shape[1] * padded[1]
    return operator(shape, np.fft.rfft2(kernel(*period, spacing)), period)


def periodic(shape, spacing, padded=(1, 1)):
    period = shape[0] * padded[0], shape[1] * padded[1]
    return operator(shape, waves(*period, spacing), period)


def conjugate_gradients(apply, gap, force, area, tolerance, iterations=600):
    """Polonsky and Keer, Wear 231 (1999) 206. The last pressure, and whether the residual is reached."""
    p, direction, before, restart = np.full(gap.shape, force / (gap.size * area)), np.zeros(gap.shape), 1.0, True
    for _ in range(iterations):
        w = gap + apply(p)
        d = (p * w).sum() / p.sum()
        if max((p * abs(w - d)).sum() / p.sum(), (d - w).max()) < tolerance * (d - gap.min()):
            return p, True
        inside = p > 0
        slope = w - w[inside].mean()
        square = (slope[inside] ** 2).sum()
        direction = np.where(inside, slope + (0 if restart else square / before) * direction, 0)
        before = square
        curved = apply(direction)
        curved -= curved[inside].mean()
        step = (slope * direction)[inside].sum() / (curved * direction)[inside].sum()
        p = np.maximum(p - step * direction, 0)
        overlapping = (p == 0) & (slope < 0)
        restart = bool(overlapping.any())
        p = p - step * slope * overlapping
        p *= force / (p.sum() * area)
    return p, False


def pressed(gap, spacing, modulus, force, tolerance, *, apply=None, area=None, iterations=600):
    """Right without options."""
    apply = apply or free(gap.shape, spacing)
    area = np.prod(spacing) if area is None else area
    return conjugate_gradients(lambda p: apply(p) / modulus, gap, force, area, 0.3 * tolerance, iterations)[0]


def pressed_to(gap, spacing, modulus, approach, tolerance, apply=None):
    """By approach: the force is sought on a logarithmic scale."""
    apply = apply or free(gap.shape, spacing)
    solve = functools.partial(pressed, gap, spacing, modulus, tolerance=0.01 * tolerance, apply=apply)

    def reached(log):
        p = solve(force=np.exp(log))
        return (p * (gap + apply(p) / modulus)).sum() / p.sum() - approach

    low = high = np.log(1e-3 * modulus * (approach - gap.min()) * np.sqrt(gap.size * np.prod(spacing)))
    while reached(high) < 0:
        high += 1
    while reached(low) > 0:
        low -= 1
    return solve(force=np.exp(brentq(reached, low, high, xtol=1e-14)))


# --- mistakes ---


def on(**mistake):
    """Given other arguments, functions of the right ones."""

    def solve(**given):
        return pressed(**{**given, **{name: of(**given) for name, of in mistake.items()}})

    return solve


def returned(way):
    """What is done to the right answer."""
    return lambda **given: way(pressed(**given), **given)


def by(apply):
    """By another operator."""
    return lambda gap, spacing, **given: pressed(gap, spacing, apply=apply(gap.shape, spacing), **given)


def rescaled(p, spacing, force, **_):
    return p * force / (p.sum() * np.prod(spacing))


def without_boundary(gap, **_):
    return np.pad(gap[1:-1, 1:-1], 1, constant_values=gap.max() + 1) if min(gap.shape) > 2 else gap


def without_two_of_boundary(gap, **_):
    return np.pad(gap[2:-2, 2:-2], 2, constant_values=gap.max() + 1) if min(gap.shape) > 5 else gap


def without_last_row(gap, **_):
    return np.vstack([gap[:-1], np.full_like(gap[:1], gap.max() + 1)]) if len(gap) > 1 else gap


def bilateral(gap, spacing, modulus, force, **_):
    """Without p >= 0, by a dense matrix."""
    n, m = gap.shape
    i, j = (index.ravel() for index in np.indices((n, m)))
    matrix = love(2 * n, 2 * m, spacing)[i[:, None] - i, j[:, None] - j] / modulus
    ones, heights = np.linalg.solve(matrix, np.stack([np.ones(n * m), gap.ravel()], axis=1)).T
    d = (force / np.prod(spacing) + heights.sum()) / ones.sum()
    return (d * ones - heights).reshape(n, m)


def springs(gap, spacing, modulus, force, **_):
    """Each cell by itself, up to the force."""
    low, high = gap.min(), gap.max() + 1e3 * force / (modulus * gap.size * spacing[0])
    for _ in range(200):
        d = (low + high) / 2
        low, high = (d, high) if np.maximum(d - gap, 0).sum() * modulus * spacing[1] < force else (low, d)
    return rescaled(np.maximum(high - gap, 0), spacing, force)


class Remembers:
    """What is kept between calls."""

    def __init__(self, solve):
        self.solve, self.kept, self.calls = solve, {}, 0

    def __call__(self, **given):
        self.calls += 1
        return self.solve(self, **given)


def kept_operator(self, gap, spacing, **given):
    return pressed(gap, spacing, apply=self.kept.setdefault(gap.shape, free(gap.shape, spacing)), **given)


def kept_answer(self, gap, **given):
    return self.kept.setdefault(gap.shape, pressed(gap, **given))


def drifting(self, modulus, **given):
    return pressed(modulus=modulus * (1 + 2e-3 * self.calls), **given)


def random(self, **given):
    return pressed(**given) * (1 + 0.05 * np.random.default_rng(self.calls).standard_normal(given["gap"].shape))


def single(gap, spacing, modulus, force, tolerance):
    apply = free(gap.shape, spacing)
    rounded = lambda p: np.float32(apply(np.float32(p)))  # noqa: E731
    return np.float32(pressed(np.float32(gap), spacing, modulus, force, tolerance, apply=rounded, iterations=300))


def odd(gap, **_):
    return gap.shape[0] % 2 or gap.shape[1] % 2


def share(p):
    return (p > 0).mean()


WRONG = {
    # operators
    "no padding": (by(functools.partial(free, padded=(1, 1))), "no padding:"),
    "no padding along axis 0": (by(functools.partial(free, padded=(1, 2))), "no padding along axis 0:"),
    "no padding along axis 1": (by(functools.partial(free, padded=(2, 1))), "no padding along axis 1:"),
    "periodic for free": (by(periodic), "no padding:"),
    "periodic waves on a padded grid": (by(functools.partial(periodic, padded=(2, 2))), "on a padded grid:"),
    "dx and dy swapped": (by(lambda shape, d: free(shape, d[::-1])), "the answer with dx and dy exchanged:"),
    "square cells in the kernel": (by(lambda shape, d: free(shape, (d[0], d[0]))), "the answer with dx for dy:"),
    "square cells": (on(spacing=lambda spacing, **_: (spacing[0],) * 2), "square cells, dx for dy:"),
    "point loads": (by(functools.partial(free, kernel=points)), "point loads instead of Love's rectangles:"),
    # factors
    "E for E*, nu = 0.3": (on(modulus=lambda modulus, **_: 0.91 * modulus), "(E for E* at nu = 0.3?)"),
    "E for E*, nu = 1/3": (on(modulus=lambda modulus, **_: modulus * 9 / 8), "(E for E* at nu = 1/3?)"),
    "a factor 2": (on(modulus=lambda modulus, **_: 2 * modulus), "(a factor 2?)"),
    "a factor pi": (on(modulus=lambda modulus, **_: modulus / np.pi), "(a factor pi?)"),
    "a factor of the answer": (returned(lambda p, **_: 1.3 * p), "1.3 times the answer:"),
    "forces for pressures": (returned(lambda p, spacing, **_: p * np.prod(spacing)), "the forces of the cells for"),
    # load
    "mean pressure for the load": (
        on(force=lambda force, spacing, gap, **_: force * gap.size * np.prod(spacing)),
        "the mean pressure for the force",
    ),
    "sum of pressures for the load": (
        on(force=lambda force, spacing, **_: force * np.prod(spacing)),
        "the sum of the pressures for the force",
    ),
    "force not met": (on(force=lambda force, **_: 0.97 * force), "0.97 times the force: the force is not held:"),
    # gap
    "sign of the gap": (on(gap=lambda gap, **_: -gap), "the sign of the gap:"),
    "boundary excluded": (on(gap=without_boundary), "cells of the boundary excluded:"),
    "two cells of the boundary excluded": (on(gap=without_two_of_boundary), "two cells of the boundary excluded:"),
    "last row excluded": (on(gap=without_last_row), "the last row excluded:"),
    "first row": (on(gap=lambda gap, **_: np.repeat(gap[:1], len(gap), 0)), "the first row for the whole gap:"),
    # answers
    "transposed": (returned(lambda p, **_: p.T if p.shape[0] == p.shape[1] else p), "transposed:"),
    "order of memory": (returned(lambda p, **_: p.ravel(order="F").reshape(p.shape)), "exchanged in memory:"),
    "flipped": (returned(lambda p, **_: p[:, ::-1]), "flipped along axis 1:"),
    "flipped on odd grids": (
        returned(lambda p, **given: p[::-1] if odd(**given) else p),
        "on grids of an odd number of cells alone: flipped along axis 0:",
    ),
    "added": (returned(lambda p, **_: p + 0.01 * p.mean()), "a pressure is added in all cells:"),
    "shifted by a cell": (returned(lambda p, **_: np.roll(p, 1, 0)), "shifted by 1 cell along axis 0:"),
    "shifted by half a cell": (returned(lambda p, **_: (p + np.roll(p, 1, 1)) / 2), "0.5 cells along axis 1"),
    "fftshift": (returned(lambda p, **_: np.fft.fftshift(p)), "shifted by half of the grid: fftshift:"),
    "smoothed": (returned(lambda p, **_: ndimage.gaussian_filter(p, 0.8, mode="constant")), "smoothed pressures:"),
    "clipped": (
        returned(lambda p, **_: np.where(p < 0.03 * p.max(), 0, p)),
        "small pressures are clipped to zero and the force is not restored:",
    ),
    "clipped and scaled": (
        returned(lambda p, **given: rescaled(np.where(p < 0.03 * p.max(), 0, p), given["spacing"], given["force"])),
        "small pressures are clipped to zero and all others are scaled:",
    ),
    "cut": (returned(lambda p, **_: np.minimum(p, 0.6 * p.max())), "pressures are cut at a largest value:"),
    "tension": (bilateral, "negative pressures: p >= 0 is not held:"),
    "tension clipped once": (
        lambda **given: np.maximum(bilateral(**given), 0),
        "negative pressures are clipped once and the force is not restored:",
    ),
    # iterations
    "loose": (on(tolerance=lambda tolerance, **_: 300 * tolerance), "under a tighter tolerance it does:"),
    "loose whatever the tolerance": (on(tolerance=lambda **_: 0.02), "near the answer: it does not converge"),
    "one iteration": (functools.partial(pressed, iterations=1), "one iteration from an even pressure:"),
    "springs": (springs, "each cell by itself: springs without a half-space:"),
    "single precision": (single, "single precision"),
    # kinds of problems
    "elongated cells": (
        on(modulus=lambda modulus, spacing, **_: modulus * (1.2 if max(spacing) > 3 * min(spacing) else 1)),
        "on cells of 4:1 alone: the answer for 1.2 times the modulus",
    ),
    "light load": (
        returned(lambda p, **_: np.roll(p, 1, 0) if share(p) < 0.02 else p),
        "on light loads, below 2 % of contact alone: shifted by 1 cell along axis 0:",
    ),
    "one cell": (
        returned(lambda p, **_: np.where(p < p.max(), 0, p.sum()) if 1 < (p > 0).sum() < 30 else p),
        "all of the force in one cell:",
    ),
    "full contact": (
        returned(lambda p, **_: np.full_like(p, p.mean()) if share(p) == 1 else p),
        "on full contact alone: the same pressure in all cells:",
    ),
    # state
    "kept operator": (Remembers(kept_operator), "an operator that is kept from an earlier call"),
    "kept answer": (Remembers(kept_answer), "the answer of another problem:"),
    "drift": (Remembers(drifting), "the answer depends on earlier calls:"),
    "random": (Remembers(random), "each call gives another answer: random numbers:"),
}
"""Each wrong solver with what must be said first of it."""
