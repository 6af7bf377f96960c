"""Many wheels on spring foundations, each over a track of its own, batched place by place."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import FloatArray, OneOrTwo, count, doubles, finite_array, held, positive
from mdr.diagnostics import diagnose_slope, diagnose_units, diagnose_wheel, warn
from mdr.elliptic_wheel import spring_wheel
from mdr.rolling import smooth_approach
from mdr.spring_track import MOST_SPRINGS

BLOCK = 512
"""Places at a time: few enough to stay in the cache, and to see little of the range of the heights."""
EXACT_INTEGERS = 2.0**53
"""Whole numbers below this are added without rounding."""
HEADROOM = 5
"""Sums may be so many times as large as those of a wheel pressed as deep as its heights reach, before they round."""
SORTING_SLACK = 0.02
"""How far approaches may move before springs are sorted anew, over the smooth approach."""
MOST_STEPS = 200


class RollingEnsemble:
    """Contact of several wheels with one-sided springs, each wheel on a periodic track of its own.

    Parameters
    ----------
    height : array_like, shape (points, wheels)
        Heights of the tracks, positive towards the wheel [m].
    spacing : float
        Distance dx of the springs [m].
    radius : float or tuple of float
        Radius R of the wheels, whose profile is x^2 / R, or (along, across) the track [m], as in `roll`.
    modulus : float
        Contact modulus E* [Pa].
    force : float
        Mean force under which the wheels roll, positive [N]. Its smooth approach d sets the quantum.

    Attributes
    ----------
    points, wheels : int
        Springs of a track, number of tracks.
    smooth_approach : float
        Approach d of the smooth wheel under ``force`` [m].
    quantum : ndarray, shape (wheels,)
        Unit in which the heights and approaches of each wheel are whole numbers [m].

    Raises
    ------
    ValueError
        If a value is out of range, or a track is not longer than the contact of the smooth wheel.

    Warns
    -----
    SpringResolutionWarning
        If the contact of the smooth wheel has fewer than 16 springs.
    SpringUnitsWarning
        If the radius of contact is larger than the wheel, or half of the springs have a slope above 10.

    Notes
    -----
    F(x_i) = E* dx sum_j max(d - (x_j - x_i)^2 / R + h_j, 0), for each wheel over spring i of its track.

    Heights, profile and approach of a wheel are rounded to whole multiples of its quantum, so that no sum rounds: the
    force is the same to the last bit in any order of the springs and with any other wheels in the ensemble. The
    quantum is 5 (d + s)^(3/2) d^(-1/2) (2 a / dx + 512) 2^-53, s the span of the heights. It changes the force by a
    relative (3/4) quantum / d: 5e-13 where a / dx = 100 and s = d / 2.

    ``mdr.Wheels`` in 0.1.

    Examples
    --------
    >>> tracks = 1e-7 * np.random.default_rng(1).standard_normal((256, 3))
    >>> ensemble = mdr.RollingEnsemble(tracks, spacing=1e-4, radius=0.5, modulus=2e11, force=1e3)
    >>> approach = ensemble.approach(0, 1e3)
    >>> ensemble.force(0, approach)
    array([1000., 1000., 1000.])
    """

    def __init__(
        self,
        height: ArrayLike,
        *,
        spacing: float,
        radius: OneOrTwo,
        modulus: float,
        force: float,
    ):
        h = finite_array("height", height, ndim=2)
        self.spacing, force = positive("spacing", spacing), positive("force", force)
        # the profile x^2 / R and the springs that stand for a contact with two radii
        self.radius, self.modulus, _ = spring_wheel(radius, modulus)
        self.points, self.wheels = h.shape
        self._block, self._pad = range(0), 0
        self._low, self._high = math.inf, -math.inf
        with doubles(
            height=float(np.abs(h).max()), spacing=self.spacing, radius=self.radius, modulus=self.modulus, force=force
        ):
            self.smooth_approach = smooth_approach(self.radius, force / self.modulus)
            diameter = 2 * math.sqrt(self.radius * self.smooth_approach)
            held(diameter, diameter / self.spacing, self.smooth_approach, positive=True)
            self._quantise(h, diameter / self.spacing + BLOCK)
        if self.points * self.spacing <= diameter:
            length = self.points * self.spacing
            raise ValueError(f"height must be longer than the contact, {diameter:.6g} m, got a track of {length:.6g} m")
        units = diagnose_units(approach=self.smooth_approach, radius=self.radius)
        slope = diagnose_slope(h.T, self.spacing, modulus)
        warn((*diagnose_wheel(diameter / self.spacing), *units, *slope))

    def _quantise(self, h: FloatArray, springs: float) -> None:
        """The quantum of each wheel, in which so many springs are added without rounding, and heights in these."""
        lowest, highest = h.min(axis=0), h.max(axis=0)
        self._middle = (lowest + highest) / 2
        depth = 1 + (highest - lowest) / self.smooth_approach
        self.quantum = HEADROOM * springs / EXACT_INTEGERS * self.smooth_approach * depth * np.sqrt(depth)
        self._height = np.rint((h - self._middle) / self.quantum)
        self._stiffness = self.modulus * self.spacing * self.quantum
        self._span = float((highest - lowest).max())
        self._margin = 4 * float(self.quantum.max())
        # no force that is added without rounding is larger than that
        held(self.quantum, self._stiffness, EXACT_INTEGERS * self._stiffness, positive=True)
        held(self._height, self._margin * self.radius)

    def force(self, place: int, approach: ArrayLike) -> FloatArray:
        """Force of each wheel over one spring of its track.

        Parameters
        ----------
        place : int
            Number of the spring, from zero; beyond the last spring the track begins again.
        approach : array_like, shape (wheels,)
            Approach of each wheel to the plane of height zero, of any sign [m].

        Returns
        -------
        ndarray, shape (wheels,)
            Normal forces [N].

        Raises
        ------
        ValueError, TypeError
            If ``place`` or ``approach`` is out of range or of another shape.
        ArithmeticError
            If an approach is so deep that sums would round.
        """
        if type(place) is not int:
            place = count("place", place, least=0)
        if not (type(approach) is np.ndarray and approach.dtype == np.float64):
            approach = finite_array("approach", approach, ndim=1)
        if approach.shape != (self.wheels,):
            raise ValueError(f"approach must be one value a wheel, shape ({self.wheels},), got shape {approach.shape}")
        d = approach + self._middle
        lowest, highest = d.min(), d.max()
        if not (place in self._block and self._low <= lowest and highest <= self._high):
            self._sort(place, d)
        if lowest < self._floor:
            # without contact at any height, and not so far off that sums round
            d = np.maximum(d, self._floor)
        d = np.rint(d / self.quantum)
        at = self._pad + place - self._block.start
        before, behind, touching = self._before, self._behind, self._touching
        # max(d - w + h, 0) = max(h - w, -d) + d
        np.subtract(self._near[at + before.start : at + before.stop], self._profile_before, out=touching[: len(before)])
        np.subtract(self._near[at + behind.start : at + behind.stop], self._profile_behind, out=touching[len(before) :])
        np.maximum(touching, -d, out=touching)
        total = touching.sum(axis=0)
        total += self._sums[at + self._sure.stop] - self._sums[at + self._sure.start]
        total += self._springs * d
        total -= self._profile_sure
        total *= self._stiffness
        return np.asarray(total)

    def approach(self, place: int, force: float) -> FloatArray:
        """Approach at which each wheel bears a force over one spring of its track.

        Parameters
        ----------
        place : int
            Number of the spring, from zero.
        force : float
            Normal force, positive [N].

        Returns
        -------
        ndarray, shape (wheels,)
            Approaches to the plane of height zero [m], by Newton's method from deeper ones: the force is convex and
            piecewise linear in the approach.

        Raises
        ------
        ValueError, TypeError
            If ``place`` or ``force`` is out of range.
        ArithmeticError
            If the force is so large that sums would round.
        """
        place = count("place", place, least=0)
        with doubles(force=positive("force", force), modulus=self.modulus, spacing=self.spacing):
            wanted = force / self._stiffness
            held(wanted, positive=True)
        deep = max(self.smooth_approach, smooth_approach(self.radius, force / self.modulus))
        d = 2 * deep / self.quantum - self._height.min(axis=0)
        reach = self._reach(2 * deep + 2 * self._span + self._margin)
        springs = range(-reach, reach + 1)
        level = self._height.take(np.arange(-reach, reach + 1) + place, axis=0, mode="wrap") - self._profile(springs)
        if (np.abs(level) * (level > -d)).sum(axis=0).max() >= EXACT_INTEGERS:
            raise ArithmeticError(f"force must be less for sums without rounding, got {force:.3g} N")
        for _ in range(MOST_STEPS):
            pressed = level > -d
            # a force below the rounding of the heights may leave none: that is the end
            with np.errstate(divide="ignore"):
                change = (wanted - np.where(pressed, level, 0.0).sum(axis=0)) / pressed.sum(axis=0)
            before, d = d, np.minimum(d, change)
            if (d == before).all():
                return np.asarray(d * self.quantum - self._middle)
        raise ArithmeticError(f"Newton's method did not end within {MOST_STEPS} steps")

    @property
    def examined(self) -> int:
        """Springs of a place that are looked at one by one at present, those of all others being known to touch."""
        return len(self._before) + len(self._behind)

    def _sort(self, place: int, d: FloatArray) -> None:
        """Divide springs into those that must touch, may touch and cannot, for approaches near these, of all wheels.

        d: to the middle between the lowest and the highest point of each track.
        """
        if not np.isfinite(d).all():
            raise ValueError(f"approach must be finite, got {d - self._middle}")
        slack = SORTING_SLACK * self.smooth_approach
        low, high = float(d.min()) - slack, float(d.max()) + slack
        # reset first: after a rejection the ensemble may be asked for another approach
        self._low, self._high = math.inf, -math.inf
        pad = max(self._reach(high + self._span / 2 + self._margin), 0)
        if (2 * pad + 1) * (max(high, 0.0) + self._span) >= EXACT_INTEGERS * float(self.quantum.min()):
            raise ArithmeticError(
                f"approach must be less deep for sums of {2 * pad + 1:g} springs without rounding, got {high:.3g} m"
            )
        if place not in self._block or pad > self._pad:
            self._lay(count("place", place, least=0), pad)
        sure = self._reach(max(low, self._floor) + self._lowest - self._margin)
        possible = max(self._reach(high + self._highest + self._margin), sure)
        self._before, self._behind = range(-possible, -sure), range(max(sure, 0) + 1, possible + 1)
        self._sure = range(-sure, sure + 1) if sure >= 0 else range(0)
        self._profile_before, self._profile_behind = self._profile(self._before), self._profile(self._behind)
        self._profile_sure = self._profile(self._sure).sum(axis=0)
        self._springs = float(self.examined + len(self._sure))
        self._touching = np.empty((self.examined, self.wheels))
        self._low, self._high = low, high

    def _lay(self, place: int, pad: int) -> None:
        """The heights about a block of places, and their prefix sums."""
        self._block, self._pad = range(place, place + BLOCK), pad
        rows = np.arange(place - pad, place + BLOCK + pad)
        self._near = self._height.take(rows, axis=0, mode="wrap")
        self._sums = np.concatenate([np.zeros((1, self.wheels)), np.cumsum(self._near, axis=0)])
        self._lowest = float((self._near.min(axis=0) * self.quantum).min())
        self._highest = float((self._near.max(axis=0) * self.quantum).max())
        self._floor = -self._highest - self._margin

    def _profile(self, springs: range) -> FloatArray:
        """x^2 / R of the wheel, in quanta of each, so many springs from its middle, shape (springs, wheels)."""
        x = np.arange(springs.start, springs.stop) * self.spacing
        return np.asarray(np.rint((x**2 / self.radius)[:, np.newaxis] / self.quantum))

    def _reach(self, level: float) -> int:
        """Springs to each side at which the profile lies below a level, by a margin that covers rounding; -1: none."""
        if level <= 0:
            return -1
        springs = math.sqrt(level * self.radius) / self.spacing
        if not springs < MOST_SPRINGS:
            raise ArithmeticError(
                f"approach must be less deep, or spacing larger: a wheel overlaps heights to {springs:.3g} springs on "
                f"each side, more than {MOST_SPRINGS}"
            )
        return int(springs)
