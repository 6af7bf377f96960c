"""The wheel on springs that read a surface: each spring has the mean of the heights across the contact at its place."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from mdr.approach_by_sorting import borne_by
from mdr.checks import FloatArray, OneOrTwo, doubles, finite_array, held, positive, stiffness_of_springs
from mdr.diagnostics import SpringContactWarning, diagnose_slope, diagnose_units, diagnose_wheel, warn
from mdr.elliptic_wheel import SpringWheel, spring_wheel
from mdr.rolling import RollingTrack, smooth_approach

MOST_NUMBERS = 2**16
"""Springs times positions at once: few enough to stay in the cache."""
MOST_SPRINGS = 2**20
"""To each side of a wheel: of more, a single position would take tens of megabytes and seconds."""


def roll_surface(
    height: ArrayLike,
    *,
    spacing: OneOrTwo,
    radius: OneOrTwo,
    modulus: float,
    approach: float | None = None,
    force: float | None = None,
) -> RollingTrack:
    """Roll a wheel along a rough strip on one-sided springs that read the heights across it.

    Parameters
    ----------
    height : array_like, shape (points, across)
        Heights, positive towards the wheel, periodic along axis 0; the wheel rolls along the middle of axis 1 [m].
    spacing : float or tuple of float
        Distance of the springs and of the heights across the track, one number or (dx, dy) [m].
    radius, modulus
        As in `roll`.
    approach, force : float, optional
        Either the approach to the plane of height zero [m] or the normal force [N], both positive.

    Returns
    -------
    RollingTrack
        Force, approach and stiffness with the wheel over each row in turn.

    Raises
    ------
    ValueError, TypeError
        If a value is out of range, or the strip is not larger than the contact of the smooth wheel.

    Warns
    -----
    SpringResolutionWarning, SpringUnitsWarning
        As `roll`.

    Notes
    -----
    F(x_i) = E_1 dx sum_j max(d - x_j^2 / R_1 + H_j(x_i + x_j), 0), H_j(x) = int h dy / (pi sqrt(b_j^2 - y^2)) over
    abs(y) < b_j = a_y sqrt(1 - x_j^2 / a_x^2): the mean across the smooth contact by the weight of the flat punch, and
    the middle line outside of it. While all springs inside touch, the force is that of linear theory on the half-space.

    Examples
    --------
    >>> strip = np.repeat(1e-7 * np.cos(2 * np.pi * np.arange(256) / 64)[:, np.newaxis], 64, axis=1)
    >>> rolled = mdr.roll_surface(strip, spacing=1e-4, radius=0.5, modulus=2e11, approach=2e-6)
    >>> print(f"{rolled.force.min():.1f} to {rolled.force.max():.1f} N")
    499.3 to 567.0 N
    """
    heights = finite_array("height", height, ndim=2, copy=False)
    steps, wheel = _steps(spacing), spring_wheel(radius, modulus)
    if (approach is None) == (force is None):
        raise ValueError(f"give either approach or force, got approach={approach!r} and force={force!r}")
    load = {"force": force} if approach is None else {"approach": approach}
    with doubles(height=heights, spacing=steps[0], modulus=wheel.modulus, **load):
        rolled, diagnostics = _rolled(heights, steps, wheel, approach, force)
    warn((*diagnostics, *diagnose_slope(heights.T, steps[0], modulus)))
    return rolled


def _steps(spacing: OneOrTwo) -> tuple[float, float]:
    """Along and across."""
    if isinstance(spacing, tuple) and len(spacing) != 2:
        raise ValueError(f"spacing must be one number or two (along, across), got {spacing!r}")
    dx, dy = spacing if isinstance(spacing, tuple) else (spacing, spacing)
    return positive("spacing", dx), positive("spacing", dy)


def _rolled(
    heights: FloatArray, steps: tuple[float, float], wheel: SpringWheel, approach: float | None, force: float | None
) -> tuple[RollingTrack, tuple[SpringContactWarning, ...]]:
    (points, across), (dx, dy) = heights.shape, steps
    spring = stiffness_of_springs("spacing", wheel.modulus, dx)
    if force is None:
        d = positive("approach", approach)
    else:
        d = smooth_approach(wheel.radius, positive("force", force) / wheel.modulus)
    a = math.sqrt(wheel.radius * d)
    for name, size, contact in (("longer", points * dx, 2 * a), ("wider", across * dy, 2 * a * wheel.aspect)):
        if size <= contact:
            raise ValueError(f"height must be {name} than the contact, {contact:.6g} m, got a strip of {size:.6g} m")
    inside = int(a / dx)
    half_widths = wheel.aspect * np.sqrt(np.maximum(a**2 - (dx * np.arange(inside + 2)) ** 2, 0.0))
    weights = weights_across(half_widths, across, dy)
    # the contact is widest at its middle, and heights beside it are not read
    first, last = np.flatnonzero(weights[:, 0])[[0, -1]]
    under = slice(first, last + 1)
    read = weights[under].T @ heights[:, under].T
    reach = _reach(wheel, (d if force is None else d - float(read.min())) + float(read.max()), dx)
    offsets, block = np.arange(-reach, reach + 1), max(1, MOST_NUMBERS // (2 * reach + 1))
    bows, found = np.asarray((dx * offsets) ** 2 / wheel.radius), []
    for first in range(0, points, block):
        level = _levels(read, bows, range(first, min(first + block, points)))
        found.append(_at_approach(level, d) if force is None else _under_force(level, force / spring))
    total, depth, pressed = np.concatenate(found, axis=1)
    rolled = RollingTrack(
        force=spring * total if force is None else np.full(points, force),
        approach=depth,
        stiffness=spring * pressed,
        examined=np.full(points, float(offsets.size)),
    )
    held(rolled.force, rolled.approach, rolled.stiffness)
    diagnostics = (*diagnose_wheel(2 * a / dx), *diagnose_units(approach=d, radius=wheel.radius))
    return rolled, diagnostics


def weights_across(half_widths: FloatArray, points: int, step: float) -> FloatArray:
    """int dy / (pi sqrt(b^2 - y^2)) over each of so many points across, for each half-width b; sums are one.

    half_widths: zero for the middle alone; shape of the result: (points, half_widths).
    """
    edges = (np.arange(points + 1) - points / 2)[:, np.newaxis] * step
    narrow = np.maximum(half_widths, 1e-9 * step)
    return np.asarray(np.diff(np.arcsin(np.clip(edges / narrow, -1.0, 1.0)), axis=0) / np.pi)


def _levels(read: FloatArray, bows: FloatArray, positions: range) -> FloatArray:
    """H_j(x_i + x_j) - x_j^2 / R_1, shape (springs, positions).

    read: H by the distance from the wheel, its last row of all springs beyond; bows: x_j^2 / R_1 from end to end.
    """
    (rows, points), reach = read.shape, bows.size // 2
    level = np.empty((bows.size, len(positions)))
    for i, bow in enumerate(bows.tolist()):
        line, start = read[min(abs(i - reach), rows - 1)], (positions.start + i - reach) % points
        end = start + len(positions)
        near = line[start:end] if end <= points else line.take(np.arange(start, end), mode="wrap")
        np.subtract(near, bow, out=level[i])
    return level


def _at_approach(level: FloatArray, approach: float) -> FloatArray:
    """Sum of compressions, approach, and springs in contact of each position."""
    compression = np.maximum(level + approach, 0.0)
    total = compression.sum(axis=0)
    return np.stack([total, np.full(total.size, approach), np.count_nonzero(compression, axis=0)])


def _under_force(level: FloatArray, wanted: float) -> FloatArray:
    """The same where the sum is given."""
    borne = borne_by(np.ascontiguousarray(level.T), wanted)
    return np.stack([np.full(borne.approach.size, wanted), borne.approach, borne.pressed])


def _reach(wheel: SpringWheel, overlap: float, spacing: float) -> int:
    """Springs to each side that may touch; ValueError where they would take gigabytes."""
    about = math.sqrt(wheel.radius * max(overlap, 0.0)) / spacing
    if not about < MOST_SPRINGS:
        raise ValueError(
            f"spacing must be larger, or height, radius and load smaller: the wheel overlaps heights to {about:.3g} "
            f"springs on each side, more than {MOST_SPRINGS}"
        )
    return math.ceil(about)
