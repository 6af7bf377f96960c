"""Many wheels on spring foundations, each over a track of its own, in step: the force at the place all have reached."""

import math

import numpy as np
from numpy.typing import ArrayLike

from mdr.border import FloatArray, count, finite_array, not_negative, positive
from mdr.rolling import smooth_approach

BLOCK = 512
"""Places at a time: few enough to stay in the cache, and to see little of the range of the heights."""
EXACT = 2.0**53
"""Whole numbers below this are added without rounding."""
ROOM = 4
"""Sums of compressions may be so many times as large as under the smooth wheel before they round; more where rough."""
DEVIATIONS = 5
"""Of the height from its mean that are met on long tracks."""
SLACK = 0.02
"""How far approaches may move before springs are sorted anew, over the smooth approach."""
MOST_STEPS = 200


class Wheels:
    """The contact of rigid wheels of profile x^2 / R with one-sided springs, one periodic track a wheel.

    F(x_i) = E* dx sum_j max(d - (x_j - x_i)^2 / R + h_j, 0), for each wheel over the i-th spring of its track.

    Heights, profile and approaches are rounded to whole multiples of a quantum, some 20 * 2 a / dx * 2^-53 of the smooth
    approach d, so that no sum rounds: a wheel feels the same force to the last bit whoever rolls beside it, in whatever
    order springs are added. Off the sum of springs that are not rounded it is by at most 3/4 of a quantum over d of the
    force of the smooth wheel for the approach, 5e-13 with a / dx = 100, and less for the heights, which average out.
    Springs that must touch, whichever wheel, come from prefix sums; those that cannot are left out.
    """

    def __init__(self, height: ArrayLike, *, spacing: float, radius: float, modulus: float, force: float, rms: float | None = None):
        """Lay the tracks.

        height: shape (points, wheels), positive towards the wheel [m]; spacing: dx of the springs [m]; radius: R [m];
        modulus: E* [Pa]; force: under which the wheels roll, whose smooth approach sets the quantum [N]; rms: of the
        heights, for which sums must have room [m], half of that approach by default: no more is needed, and with it the
        quantum is the smaller the lower the heights; it, not these heights, so that wheels beside each other share it.
        Raises ValueError for tracks that are not longer than the contact of the smooth wheel, and values out of range.
        """
        self.height = finite_array("height", height, ndim=2)
        self.spacing, self.radius = positive("spacing", spacing), positive("radius", radius)
        self.modulus, force = positive("modulus", modulus), positive("force", force)
        self.smooth_approach = smooth_approach(self.radius, force / self.modulus)
        self.points, self.wheels = self.height.shape
        half = math.sqrt(self.radius * self.smooth_approach)
        if self.points * self.spacing <= 2 * half:
            length = self.points * self.spacing
            raise ValueError(f"height must be longer than the contact, {2 * half:.6g} m, got a track of {length:.6g} m")
        rough = 0.5 if rms is None else not_negative("rms", rms) / self.smooth_approach
        # springs under the wheel, as root of their depth, times how deep they are
        room = ROOM * (1 + DEVIATIONS * rough) ** 1.5
        self.quantum = room * max(2 * half / self.spacing, 1.0) * self.smooth_approach / EXACT
        self._rounded = np.rint(self.height / self.quantum)
        self._block, self._pad = range(0), 0
        self._low, self._high, self._floor = 0.0, -1.0, -math.inf

    def force(self, place: int, approach: ArrayLike) -> FloatArray:
        """The force of each wheel over a spring of its track, at its approach of any sign, shape (wheels,) [N].

        place: which spring, a whole number from zero; beyond the last the track begins again; approach: one a wheel,
        to the plane of height zero [m].
        Raises ValueError for approaches that are not finite, and ArithmeticError for those so deep that sums round.
        """
        d = np.rint(np.asarray(approach, dtype=np.float64) / self.quantum)
        if d.shape != (self.wheels,):
            raise ValueError(f"approach must be one value a wheel, shape ({self.wheels},), got shape {d.shape}")
        lowest, highest = d.min(), d.max()
        if not (place in self._block and self._low <= lowest and highest <= self._high):
            self._sort(place, d)
        if lowest < self._floor:
            # without contact at any height, and not so far off that sums round
            d = np.maximum(d, self._floor)
        at = self._pad + place - self._block.start
        before, behind, touching = self._before, self._behind, self._compression
        # max(d - w + h, 0) = max(h - w, -d) + d
        np.subtract(self._near[at + before.start : at + before.stop], self._profile_before, out=touching[: len(before)])
        np.subtract(self._near[at + behind.start : at + behind.stop], self._profile_behind, out=touching[len(before) :])
        np.maximum(touching, -d, out=touching)
        total = touching.sum(axis=0)
        total += self._sums[at + self._sure.stop] - self._sums[at + self._sure.start]
        total += self._springs * d
        total -= self._profile_sure
        total *= self.modulus * self.spacing * self.quantum
        return np.asarray(total)

    def approach(self, place: int, force: float) -> FloatArray:
        """The approach at which each wheel bears a force over a spring of its track, shape (wheels,) [m].

        By Newton's method, which ends, since the force is convex and piecewise linear in the approach.
        """
        wanted = positive("force", force) / (self.modulus * self.spacing * self.quantum)
        d = self.smooth_approach / self.quantum - self._rounded.min(axis=0)
        reach = self._reach(float(d.max() + self._rounded.max()))
        near = self._rounded.take(np.arange(-reach, reach + 1) + count("place", place, least=0), axis=0, mode="wrap")
        level = near - self._profile(range(-reach, reach + 1))[:, np.newaxis]
        for _ in range(MOST_STEPS):
            touching = level > -d
            before, d = d, (wanted - np.where(touching, level, 0.0).sum(axis=0)) / touching.sum(axis=0)
            if (d == before).all():
                return np.asarray(d * self.quantum)
        raise ArithmeticError(f"Newton's method did not end within {MOST_STEPS} steps")

    @property
    def examined(self) -> int:
        """Springs of a place that are looked at one by one at present, those of all others being known to touch."""
        return len(self._before) + len(self._behind)

    def _sort(self, place: int, d: FloatArray) -> None:
        """Tell springs that must touch, that may, and that cannot, for approaches about these, of all wheels."""
        if not np.isfinite(d).all():
            raise ValueError(f"approach must be finite, got {d * self.quantum}")
        slack = SLACK * self.smooth_approach / self.quantum
        self._low, self._high = float(d.min()) - slack, float(d.max()) + slack
        if place not in self._block or self._reach(self._high + self._highest) > self._pad:
            self._lay(count("place", place, least=0))
        if (2 * self._pad + 1) * (max(self._high, 0.0) + self._highest - self._lowest) >= EXACT:
            raise ArithmeticError(f"approach {self._high * self.quantum:.3g} m is too deep for sums without rounding")
        sure = self._reach(max(self._low, self._floor) + self._lowest)
        possible = max(self._reach(self._high + self._highest), sure)
        self._before, self._behind = range(-possible, -sure), range(max(sure, 0) + 1, possible + 1)
        self._sure = range(-sure, sure + 1) if sure >= 0 else range(0)
        self._profile_before = self._profile(self._before)[:, np.newaxis]
        self._profile_behind = self._profile(self._behind)[:, np.newaxis]
        self._profile_sure = float(self._profile(self._sure).sum())
        self._springs = float(len(self._before) + len(self._behind) + len(self._sure))
        self._compression = np.empty((self.examined, self.wheels))

    def _lay(self, place: int) -> None:
        """The heights about a block of places, and their prefix sums."""
        self._block = range(place, place + BLOCK)
        everywhere = float(np.abs(self._rounded).max())
        self._pad = max(self._reach(self._high + everywhere), 0)
        rows = np.arange(self._block.start - self._pad, self._block.stop + self._pad)
        self._near = self._rounded.take(rows, axis=0, mode="wrap")
        self._sums = np.concatenate([np.zeros((1, self.wheels)), np.cumsum(self._near, axis=0)])
        if np.abs(self._sums).max() >= EXACT:
            raise ArithmeticError("height must be about zero, or its sums round, in the place of a whole block")
        self._lowest, self._highest = float(self._near.min()), float(self._near.max())
        self._floor = -self._highest

    def _profile(self, springs: range) -> FloatArray:
        """x^2 / R of the wheel, in quanta, so many springs from its middle."""
        x = np.arange(springs.start, springs.stop) * self.spacing
        return np.asarray(np.rint(x**2 / self.radius / self.quantum))

    def _reach(self, level: float) -> int:
        """Springs to each side at which the profile, as rounded, lies below a level in quanta; -1 where nowhere."""
        if level <= 0:
            return -1
        j = int(math.sqrt(level * self.quantum * self.radius) / self.spacing)
        # by the profile as it is rounded, not by its root
        while self._profile(range(j, j + 1))[0] >= level:
            j -= 1
        while self._profile(range(j + 1, j + 2))[0] < level:
            j += 1
        return j
