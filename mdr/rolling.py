"""The wheel on the spring foundation: contact force along a periodic rough track.

At a given force the approach is found by Newton's method: the force is convex and piecewise linear in the approach.
Where rounding keeps Newton's method from an end, the springs are sorted. Springs that must touch enter by prefix
sums, and springs that cannot touch are left out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from mdr.approach_by_sorting import Borne, by_sorting
from mdr.checks import FloatArray, OneOrTwo, doubles, finite_array, held, positive
from mdr.diagnostics import SpringContactWarning, diagnose_linearity, diagnose_slope, warn
from mdr.elliptic_wheel import spring_wheel
from mdr.results import ReadOnlyArrays, line, span
from mdr.spring_track import Near, SpringTrack


@dataclass(frozen=True, eq=False, kw_only=True)
class RollingTrack(ReadOnlyArrays):
    """Wheel at each point of its track. Made by `roll`; ``mdr.Rolling`` in 0.1.

    Attributes
    ----------
    force : ndarray, shape (points,)
        Normal force [N].
    approach : ndarray, shape (points,)
        Approach of the smooth wheel to the plane of height zero [m].
    stiffness : ndarray, shape (points,)
        dF/dd of the springs in contact [N/m].
    examined : ndarray, shape (points,)
        Springs that were looked at one by one: those that may touch or not. A measure of the work.

    Examples
    --------
    >>> rolled = mdr.roll(np.zeros(64), spacing=1e-4, radius=0.5, modulus=2e11, force=1e3)
    >>> print(f"{rolled.approach[0]:.3g} m")
    3.04e-06 m
    """

    force: FloatArray
    approach: FloatArray
    stiffness: FloatArray
    examined: FloatArray

    def __repr__(self) -> str:
        load = f"force={span(self.force, 'N')}, approach={span(self.approach, 'm')}"
        return line(f"RollingTrack({self.force.size} points, {load}, stiffness={span(self.stiffness, 'N/m')})")


BLOCK = 1024
"""Positions at a time: few enough to stay in the cache, and to see little of the range of the heights."""
MOST_STEPS = 200
FARTHEST = 2**15
"""Springs to each side of a wheel, pressed to the lowest, beyond which steps from there take longer than sorting."""

Contact = Literal["one-sided", "full", "linear"]


def roll(
    height: ArrayLike,
    *,
    spacing: float,
    radius: OneOrTwo,
    modulus: float,
    approach: float | ArrayLike | None = None,
    force: float | None = None,
    contact: Contact = "one-sided",
) -> RollingTrack:
    """Roll a wheel along a rough track of springs, quasi-statically.

    Parameters
    ----------
    height : array_like, shape (points,)
        Heights of the periodic track, positive towards the wheel [m].
    spacing, radius, modulus : float
        Distance dx of the springs [m], radius R of the wheel, or two (along, across) [m], contact modulus E* [Pa].
    approach : float or array_like, shape (points,), optional
        Approach to the plane of height zero [m], positive, or at each point one of any sign; either this or ``force``.
    force : float, optional
        Normal force, positive [N].
    contact : {"one-sided", "full", "linear"}, optional
        "one-sided": springs do not pull. "full": all springs within the Hertz radius a = sqrt(R d), and no others.
        "linear": the filter with the transfer function 2 E* sin(q a) / q from height to force.

    Returns
    -------
    RollingTrack
        Force, approach and stiffness with the wheel over each spring in turn.

    Raises
    ------
    ValueError, TypeError
        If a value is out of range, or the track is not longer than the contact of the smooth wheel.

    Warns
    -----
    SpringResolutionWarning, SpringUnitsWarning
        If the contact of the smooth wheel has fewer than 16 springs, or is larger than the wheel, or half of the
        springs have a slope above 10, as of heights in nm on a spacing in m.
    LinearityWarning
        If roughness moves the ends of a "full" or "linear" contact by too much.

    Notes
    -----
    F(x_i) = E* dx sum_j max(d - (x_j - x_i)^2 / R + h_j, 0); Popov and Hess, (14.2), (14.5), (14.11). A contact
    longer than the track meets the same roughness again. For two radii see ``elliptic_wheel.spring_wheel``.

    Examples
    --------
    >>> track = 1e-7 * np.cos(2 * np.pi * np.arange(256) / 64)
    >>> rolled = mdr.roll(track, spacing=1e-4, radius=0.5, modulus=2e11, approach=2e-6)
    >>> print(f"{rolled.force.min():.1f} to {rolled.force.max():.1f} N")
    499.3 to 567.0 N
    """
    track = _track(height, spacing, radius, modulus)
    rolled, diagnostics = _within_doubles(track, approach, force, contact)
    warn((*diagnostics, *diagnose_slope(track.height, track.spacing, modulus)))
    return rolled


def rolling_force(
    height: ArrayLike,
    *,
    spacing: float,
    radius: OneOrTwo,
    modulus: float,
    approach: float | ArrayLike,
) -> FloatArray:
    """Force of one-sided springs along a rough track, at a given approach.

    Parameters
    ----------
    height : array_like, shape (points,)
        Heights of the periodic track, positive towards the wheel [m].
    spacing, radius, modulus
        As in `roll`.
    approach : float or array_like, shape (points,)
        Approach of the smooth wheel to the plane of height zero [m], as in `roll`.

    Returns
    -------
    ndarray, shape (points,)
        ``roll(...).force`` [N], which may be written to.

    Raises
    ------
    ValueError, TypeError
        As `roll`.

    Warns
    -----
    SpringResolutionWarning, SpringUnitsWarning
        As `roll`.

    Examples
    --------
    >>> force = mdr.rolling_force(np.zeros(256), spacing=1e-4, radius=0.5, modulus=2e11, approach=2e-6)
    >>> print(f"{force[0]:.0f} N, by Hertz {4 / 3 * 2e11 * 0.5**0.5 * 2e-6**1.5:.0f} N")
    532 N, by Hertz 533 N
    """
    track = _track(height, spacing, radius, modulus)
    rolled, diagnostics = _within_doubles(track, approach, None, "one-sided")
    warn((*diagnostics, *diagnose_slope(track.height, track.spacing, modulus)))
    return rolled.force.copy()


def _track(height: ArrayLike, spacing: float, radius: OneOrTwo, modulus: float) -> SpringTrack:
    wheel = spring_wheel(radius, modulus)
    return SpringTrack(height, spacing, wheel.radius, wheel.modulus)


def _within_doubles(
    track: SpringTrack, approach: float | ArrayLike | None, force: float | None, contact: Contact
) -> tuple[RollingTrack, tuple[SpringContactWarning, ...]]:
    """`_rolled`; ValueError where its numbers are too large or too small."""
    load = {"force": force} if approach is None else {"approach": approach}
    given = {"height": float(np.abs(track.height).max()), "spacing": track.spacing, "radius": track.radius}
    with doubles(**given, modulus=track.modulus, **load):
        rolled, diagnostics = _rolled(track, approach, force, contact)
        held(rolled.force, rolled.approach)
        held(rolled.stiffness, positive=force is not None)
        held(float(rolled.force.any() or not rolled.stiffness.any()), positive=True)
    return rolled, diagnostics


def _rolled(
    track: SpringTrack, approach: float | ArrayLike | None, force: float | None, contact: Contact
) -> tuple[RollingTrack, tuple[SpringContactWarning, ...]]:
    """`roll`, and its diagnostics."""
    if (approach is None) == (force is None):
        raise ValueError(f"give either approach or force, got approach={approach!r} and force={force!r}")
    if contact not in ("one-sided", "full", "linear"):
        raise ValueError(f'contact must be "one-sided", "full" or "linear", got {contact!r}')
    if force is not None:
        d, prescribed = smooth_approach(track.radius, positive("force", force) / track.modulus), force
        held(d, force / track.spring, positive=True)
    elif np.ndim(approach) == 0:  # type: ignore[arg-type]
        d, prescribed = positive("approach", approach), None
    else:
        along = finite_array("approach", approach, ndim=1)  # type: ignore[arg-type]
        return _one_sided_along(track, along, contact), track.diagnose(float(along.max()))
    track.longer_than(2 * math.sqrt(track.radius * d))
    if contact == "one-sided":
        one_sided = (
            _one_sided_under(track, prescribed, d) if prescribed else _one_sided(track, np.full(track.points, d))
        )
        return one_sided, track.diagnose(d)
    linear = (_linear if contact == "linear" else _full)(track, d, prescribed)
    a, change = math.sqrt(track.radius * d), linear.force if prescribed is None else linear.stiffness * linear.approach
    moved = diagnose_linearity(track.height, change / (track.modulus * a), approach=d, reach=round(a / track.spacing))
    return linear, (*track.diagnose(d), *moved)


def _linear(track: SpringTrack, d: float, force: float | None) -> RollingTrack:
    """Hertz and (14.11), sum over q of 2 E* sin(q a) / q h(q) exp(i q x): 2 E* a sinc(q a)."""
    a, points = math.sqrt(track.radius * d), track.height.size
    k = 2 * track.modulus * a
    q = 2 * np.pi * np.fft.rfftfreq(points, track.spacing)
    change = np.fft.irfft(k * np.sinc(q * a / np.pi) * np.fft.rfft(track.height), points)
    return _of_linear(2 / 3 * k * d + change, d, np.full(points, k), force)


def _full(track: SpringTrack, d: float, force: float | None) -> RollingTrack:
    """E* dx sum of d - x^2 / R + h over the springs with |x| < a, from prefix sums."""
    m, points = track.reach(d), track.height.size
    j = np.arange(-m, m + 1)
    smooth = float(np.sum(d - track.wheel(j.astype(np.float64))))
    near = _moving_sum(np.pad(track.height, m, mode="wrap"), 2 * m + 1)
    k = track.spring * (2 * m + 1)
    return _of_linear(track.spring * (smooth + near), d, np.full(points, k), force)


def _of_linear(at_d: FloatArray, d: float, stiffness: FloatArray, force: float | None) -> RollingTrack:
    """The forces at approach d; or, under a force, the approaches at which a contact of this stiffness has it."""
    if force is None:
        return RollingTrack(
            force=at_d, approach=np.full(at_d.size, d), stiffness=stiffness, examined=np.zeros(at_d.size)
        )
    return RollingTrack(
        force=np.full(at_d.size, force),
        approach=d + (force - at_d) / stiffness,
        stiffness=stiffness,
        examined=np.zeros(at_d.size),
    )


def _one_sided_along(track: SpringTrack, approach: FloatArray, contact: Contact) -> RollingTrack:
    if contact != "one-sided":
        raise ValueError(f'approach must be one number where contact is "{contact}", got {approach.size} of them')
    if approach.size != track.height.size:
        raise ValueError(f"approach must be one number or one a point, {track.height.size}, got {approach.size}")
    track.longer_than(2 * math.sqrt(track.radius * max(float(approach.max()), 0.0)))
    return _one_sided(track, approach)


def _one_sided(track: SpringTrack, approach: FloatArray) -> RollingTrack:
    """At given approaches, block by block."""
    force, count, examined = np.empty((3, approach.size))
    for first in range(0, approach.size, BLOCK):
        block = slice(first, min(first + BLOCK, approach.size))
        near = Near(track, block, float(approach[block].max()))
        force[block], count[block], examined[block] = _pressed(near, approach[block])
    return RollingTrack(
        force=track.spring * force, approach=approach, stiffness=track.spring * count, examined=examined
    )


def _one_sided_under(track: SpringTrack, force: float, d: float) -> RollingTrack:
    """At the approaches that bear a force, block by block."""
    approach, stiffness, examined = np.empty((3, track.height.size))
    wanted = force / track.spring
    for first in range(0, track.height.size, BLOCK):
        block = slice(first, min(first + BLOCK, track.height.size))
        borne = _by_newton(track, block, wanted, d) or by_sorting(track, block, wanted, d)
        approach[block], stiffness[block], examined[block] = borne.approach, track.spring * borne.pressed, borne.looked
    return RollingTrack(force=np.full(approach.size, force), approach=approach, stiffness=stiffness, examined=examined)


def _by_newton(track: SpringTrack, block: slice, wanted: float, d: float) -> Borne | None:
    """From where every wheel is too deep, so that none loses contact; None where rounding keeps it from an end."""
    deep = d - float(track.height.min())
    if track.distance(deep + float(track.height.max())) > FARTHEST:
        return None
    approach, looked = np.full(block.stop - block.start, deep), 0.0
    for _ in range(MOST_STEPS):
        found, count, more = _pressed(Near(track, block, float(approach.max())), approach)
        if not count.all():
            return None
        looked += more
        change = (wanted - found) / count
        approach = approach + change
        if (np.abs(change) <= 1e-14 * d + 4 * np.spacing(np.abs(approach))).all():
            return Borne(approach, count, looked)
    return None


def _pressed(near: Near, approach: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """sum_j max(d - x_j^2 / R + h_j, 0) of each position, springs in contact, and how many of them were looked at.

    near: springs that may touch; approach: of each position.
    """
    track, heights, middle = near.track, near.heights, near.reach
    total, count = np.zeros((2, approach.size))
    if near.farthest < 0:
        return total, count, 0.0
    sure = min(track.reach(float(approach.min()) + near.lowest), middle)
    if sure >= 0:
        j = np.arange(-sure, sure + 1, dtype=np.float64)
        sums = _moving_sum(heights[middle - sure : heights.size - middle + sure], j.size)
        total += j.size * approach - float(np.sum(track.wheel(j))) + sums
        count += j.size
    for i in (i for side in range(sure + 1, middle + 1) for i in {-side, side}):
        compression = approach - track.wheel(i) + heights[middle + i : middle + i + approach.size]
        total += np.maximum(compression, 0.0)
        count += compression > 0
    if near.springs.size:
        total, count = _pressed_apart(near, approach, total, count)
    return total, count, float(near.columns - max(2 * sure + 1, 0))


def _pressed_apart(
    near: Near, approach: FloatArray, total: FloatArray, count: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Total and count with those that stand out, added from near to far, as neighbours are."""
    offsets = near.offsets()
    distance = np.minimum(np.abs(offsets), near.farthest)
    profile = near.track.profile(near.farthest)
    compression = approach[:, np.newaxis] - profile[distance] + near.apart
    borne = np.where(near.beyond(offsets), np.maximum(compression, 0.0), 0.0)
    order = np.argsort(np.abs(offsets), axis=1, kind="stable")
    borne, offsets = np.take_along_axis(borne, order, axis=1), np.take_along_axis(offsets, order, axis=1)
    equally_far = (offsets[:, 1:] == -offsets[:, :-1]) & (borne[:, 1:] > 0) & (borne[:, :-1] > 0)
    for row, column in np.argwhere(equally_far).tolist():
        first = int(offsets[row, column])
        if next(iter({-abs(first), abs(first)})) != first:
            borne[row, column : column + 2] = borne[row, [column + 1, column]]
    total = np.add.accumulate(np.column_stack([total, borne]), axis=1)[:, -1]
    return total, count + np.count_nonzero(borne, axis=1)


def _moving_sum(values: FloatArray, length: int) -> FloatArray:
    """Sums of so many neighbours, from prefix sums about the mean, which keeps them small."""
    mean = float(values.mean())
    sums = np.concatenate([[0.0], np.cumsum(values - mean)])
    return np.asarray(sums[length:] - sums[:-length] + length * mean)


def smooth_approach(radius: float, force_over_modulus: float) -> float:
    """d = (9 F^2 / (16 R E*^2))^(1/3) of the smooth wheel."""
    return math.cbrt(9 / 16 / radius) * math.cbrt(force_over_modulus) ** 2
