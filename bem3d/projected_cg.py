"""Projected, preconditioned conjugate directions: one operator application an iteration, whatever the contact does."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from bem3d.checks import BoolArray, FloatArray
from bem3d.contact import relative_error
from bem3d.window import dot, dots

STEPS_REMEMBERED = 3
"""Steps remembered, with their images: what conjugacy and truncation need, measured on rough contacts."""
FIRST_STEP = 0.4
"""The approximate inverse is too stiff by up to a factor of a few: eigenvalues of M K on a contact are 1 and more."""
LONGEST_CUT_STEP = 0.6
"""A step that is cut grows no longer. On a large grid some cell is cut in each step: held at the first length, an
asperity unlike the others would keep 0.6 of its error an iteration, long after all of them have settled."""
WHOLE_STEP = 0.65
"""A step that cut cells off is taken whole if its best length is at least this part of it: it then gains energy."""
ROUNDING = 8 * float(np.finfo(np.float64).eps)
"""Part of its pressure that a cell may keep by rounding alone when a step ends where the cell leaves the contact: a
division, a product and a sum leave 2 eps, with a margin of 4."""
BALANCED = 1e-12
"""Part of a prescribed total by which the pressures of a step may miss it."""


@dataclass(frozen=True, eq=False)
class Load:
    """What is prescribed: the overlap s = approach - first touch, or the sum of the pressures."""

    overlap: float | None = None
    total: float | None = None

    def overlap_of(self, pressure: FloatArray, separation: FloatArray) -> float:
        """s; at a prescribed force the mean of g + u under the pressure, for which p w sums to zero."""
        if self.overlap is not None:
            return self.overlap
        return float((pressure * separation).sum() / pressure.sum())

    def balanced(self, direction: FloatArray, pressure: FloatArray) -> FloatArray:
        """A direction that keeps the prescribed total."""
        if self.total is None:
            return direction
        # in proportion to the pressure, so that no cell outside of the contact is pulled on
        return direction - float(direction.sum()) / float(pressure.sum()) * pressure

    def nearest(self, aim: FloatArray, free: BoolArray) -> FloatArray:
        """The nearest pressure, on the free cells, that is nowhere negative and has the prescribed total if any.

        With a total it is aim less one number on all cells that stay in contact, found by a sort.
        """
        if self.total is None:
            return np.where(free, np.maximum(aim, 0.0), 0.0)
        # the level if so many of the highest stay: right for the last that still reaches its own
        falling = np.sort(aim[free])[::-1]
        surplus = (np.cumsum(falling) - self.total) / np.arange(1, falling.size + 1)
        level = surplus[np.flatnonzero(falling >= surplus)[-1]]
        return np.where(free, np.maximum(aim - level, 0.0), 0.0)

    def scaled(self, pressure: FloatArray) -> FloatArray:
        """The pressure, scaled to the prescribed total if there is one."""
        return pressure if self.total is None else pressure * (self.total / pressure.sum())


class State(NamedTuple):
    """Pressure p, on the candidate cells, and the residual that it has; the next iteration overwrites the pressure."""

    pressure: FloatArray
    residual: float


class Memory:
    """The last steps s_i and their images y_i = K s_i, as rows of arrays that are made once.

    direction: row for the preconditioned residual of the next step.
    """

    def __init__(self, size: int) -> None:
        self._rows, self._images = np.empty((1 + STEPS_REMEMBERED, size)), np.empty((STEPS_REMEMBERED, size))
        self.direction, self._steps = self._rows[0], self._rows[1:]
        self._gram = [[0.0] * STEPS_REMEMBERED for _ in range(STEPS_REMEMBERED)]
        self.forget()

    def forget(self) -> None:
        """Begin anew."""
        self._count = self._next = 0

    @property
    def next(self) -> tuple[FloatArray, FloatArray]:
        """Rows for a step and its image, those of the oldest: `add` takes what stands there."""
        return self._steps[self._next], self._images[self._next]

    def add(self) -> float:
        """Remember the step that stands in the next rows; returns its curvature s . K s."""
        latest, self._count = self._next, min(max(self._count, self._next + 1), STEPS_REMEMBERED)
        energies = dots(self._images[: self._count], self._steps[latest]).tolist()
        for i, energy in enumerate(energies):
            self._gram[i][latest] = self._gram[latest][i] = energy
        self._next = (latest + 1) % STEPS_REMEMBERED
        return float(energies[latest])

    def improve(self, length: float, uphill: FloatArray, out: FloatArray) -> None:
        """- length direction, made conjugate to what is remembered, plus the step among that which gains the most.

        uphill: gradient of the energy, zero where no pressure may change.
        """
        if self._count == 0:
            np.multiply(self.direction, -length, out=out)
            return
        steps, images = self._steps[: self._count], self._images[: self._count]
        # one system does both: a step that was cut short leaves energy to gain along itself
        wanted = length * dots(images, self.direction) - dots(steps, uphill)
        weights = solved([row[: self._count] for row in self._gram[: self._count]], wanted.tolist())
        np.einsum("i,ij->j", [-length, *weights], self._rows[: 1 + self._count], out=out)


def solved(gram: list[list[float]], wanted: list[float]) -> list[float]:
    """The small system G x = b, G symmetric and nearly singular at worst: an unknown that adds nothing stays zero."""
    count, left = len(wanted), [row[k] for k, row in enumerate(gram)]
    for k, pivot in enumerate(gram):
        # the pivot of a step that the others contain is rounding alone: it must not blow up the rest
        if not pivot[k] > 1e-10 * left[k]:
            for row in gram:
                row[k] = 0.0
            pivot[:] = [0.0] * count
            pivot[k], wanted[k] = 1.0, 0.0
        for i in range(k + 1, count):
            row = gram[i]
            factor = row[k] / pivot[k]
            wanted[i] -= factor * wanted[k]
            for j in range(k, count):
                row[j] -= factor * pivot[j]
    for k in reversed(range(count)):
        for j in range(k + 1, count):
            wanted[k] -= gram[k][j] * wanted[j]
        wanted[k] /= gram[k][k]
    return wanted


class Operator(Protocol):
    """K and its approximate inverse on vectors over the cells that may touch."""

    @property
    def stiffness(self) -> float:
        """Pressure on a cell alone that moves it by a unit [Pa/m]."""

    def displacement(self, pressure: FloatArray, out: FloatArray) -> object:
        """u = K p, into an array."""

    def inverse(self, displacement: FloatArray, free: BoolArray, out: FloatArray) -> object:
        """Nearly the pressure on the free cells that makes this displacement, into an array."""

    def cut(self, pressure: FloatArray) -> object:
        """Make what is negative zero, in place; what that adds may be taken from cells nearby."""


class Iterate:
    """Where the iteration is: pressure p and distance w = g + u - s on the candidate cells, and the slope there.

    pressure, w: overwritten by `move`; free, uphill: cells whose pressure may change, and w on them; aim: the pressure
    that the step of `cut` leads to.
    """

    def __init__(self, pressure: FloatArray, separation: FloatArray, load: Load) -> None:
        self._load, self.pressure, self._overlap = load, pressure.copy(), load.overlap_of(pressure, separation)
        self.w = separation - self._overlap
        self.uphill, self.aim, self._mask = (np.empty(pressure.size) for _ in range(3))
        self.free, self._touching = (np.empty(pressure.size, dtype=np.bool_) for _ in range(2))

    def residual(self) -> float:
        """That of p, by a w that is summed up."""
        p, load = self.pressure, self._load
        total = float(np.add.reduce(p)) if load.total is None else load.total
        moved = dot(p, np.abs(self.w, out=self.aim))
        return relative_error(total, moved, -float(np.minimum.reduce(self.w)), self._overlap)

    def descend(self, cells: Operator, memory: Memory, length: float) -> tuple[float, bool]:
        """The first of three steps that gains energy: conjugate, preconditioned, plain; into the next row of memory.

        Returns its gain to first order, zero or less if none gains, and whether it was cut off at p = 0.
        """
        p, free, z = self.pressure, self.free, memory.direction
        # a cell out of contact that does not overlap has nothing to gain by pressure
        np.greater(p, 0.0, out=self._touching)
        np.logical_or(self._touching, np.less(self.w, 0.0, out=free), out=free)
        np.copyto(self._mask, free)
        np.multiply(self.w, self._mask, out=self.uphill)
        cells.inverse(self.uphill, free, out=z)
        z *= self._mask
        if self._load.total is not None:
            # in proportion to the pressure, so that no cell outside of the contact is pulled on
            z -= np.multiply(p, float(np.add.reduce(z)) / self._load.total, out=self.aim)
        step, _ = memory.next
        memory.improve(length, self.uphill, out=self.aim)
        gain, short = self.cut(cells, np.multiply(self.aim, self._mask, out=step))
        # cut off at p = 0, even a conjugate direction may lead up: the memory is of another contact then
        if not gain > 0:
            memory.forget()
            step, _ = memory.next
            gain, short = self.cut(cells, np.multiply(z, -length, out=step))
        if not gain > 0:
            # along the gradient and back to the nearest pressure: downhill unless there is no lower place
            self.aim[:] = self._load.nearest(p - length * cells.stiffness * self.uphill, free)
            gain, short = -dot(self.w, np.subtract(self.aim, p, out=step)), True
        return gain, short

    def cut(self, cells: Operator, step: FloatArray) -> tuple[float, bool]:
        """Cut a step off where p would be negative, in place; what it gains to first order, and whether it was cut."""
        p, aim, total = self.pressure, self.aim, self._load.total
        np.add(p, step, out=aim)
        short = bool(np.minimum.reduce(aim) < 0)
        if short:
            cells.cut(aim)
        if total is not None:
            # the cut adds pressure, so that a prescribed total is restored before the step is measured
            scale = total / np.add.reduce(aim)
            if abs(scale - 1) > BALANCED:
                aim *= scale
                np.subtract(aim, p, out=step)
                return -dot(self.w, step), short
        if short:
            np.subtract(aim, p, out=step)
        return -dot(self.w, step), short

    def part_of(self, step: FloatArray, best: float, length: float, short: bool) -> tuple[float, float]:
        """How much of a step to take, and the length to estimate next."""
        if not short:
            # the estimate follows by a factor of two at most, since one step is no measure of the next
            length *= min(max(best, 0.5), 2.0)
            # nothing was cut, so that a whole step and less stay in bounds
            return (best if best <= 1 else min(best, self._to_the_bound(step, best))), length
        if best >= WHOLE_STEP:
            # the energy gained goes as best t - t^2 / 2 along the step: a whole one gains from best = 1/2 on
            return 1.0, max(length, min(FIRST_STEP, 2 * length), min(LONGEST_CUT_STEP, length * min(best, 2.0)))
        # a part of a cut step stays in bounds, between two pressures that are
        return best, length * max(best, 0.5)

    def _to_the_bound(self, step: FloatArray, best: float) -> float:
        """How far the step goes until a cell would be pulled on; infinite if that is farther than the best length."""
        far = np.multiply(step, best, out=self.aim)
        far += self.pressure
        if not np.minimum.reduce(far) < 0:
            return math.inf
        falling = step < 0
        return float(np.min(-self.pressure[falling] / step[falling]))

    def move(self, step: FloatArray, image: FloatArray, part: float, short: bool) -> None:
        """Take a part of the step, whose image sums up the displacement."""
        p, w, change = self.pressure, self.w, self.aim
        if short and part == 1:
            p[:] = self.aim
        else:
            p += np.multiply(step, part, out=change)
            if part > 1:
                # a step beyond its aim may end where a cell leaves the contact: what that keeps is rounding
                p[p <= np.multiply(change, -ROUNDING, out=change)] = 0.0
        # summed up, which spares an application; the caller confirms it with a fresh one
        w += np.multiply(image, part, out=change)
        if self._load.total is not None:
            closer = dot(p, w) / self._load.total
            self._overlap += closer
            w -= closer


def projected_cg(
    cells: Operator, pressure: FloatArray, separation: FloatArray, load: Load, length: float = FIRST_STEP
) -> Iterator[State]:
    """Iterate towards p >= 0, w = g + u - s >= 0, p w = 0; the caller decides when to stop.

    Free cells are those under pressure and those that overlap. On them the preconditioned residual, made conjugate to
    the steps before, is followed for an estimated length; what becomes negative is cut off; and the operator is
    applied to the step as it then is. Its image gives the best length of that step, which is taken whole where it cut
    something off and gains from it, so that cells leave the contact many at a time. No second application, no restart:
    steps that were cut are as good for conjugacy as any other.
    Ends, without a solution, where no direction leads down any more.

    cells: K and its approximate inverse on vectors over the candidate cells; pressure, separation g + u: to begin with;
    load: what is prescribed; length: of the first step, in units of the preconditioned residual.
    Source: the projection and the free cells as in Polonsky and Keer, Wear 231 (1999) 206; going on without restart as
    in Bugnicourt et al., Tribol. Lett. 66 (2018) 29; one application an iteration by the memory is ours.
    """
    at, memory = Iterate(pressure, separation, load), Memory(pressure.size)
    while True:
        # 1. residual: before the step, so that the caller may stop without another application
        yield State(at.pressure, at.residual())
        # 2. direction, cut at p = 0 before the operator is applied: its image is then exact, whatever was cut
        gain, short = at.descend(cells, memory, length)
        if not gain > 0:
            return
        step, image = memory.next
        cells.displacement(step, out=image)
        curvature = memory.add()
        # K is positive: a step without curvature, or NaN, is rounding, and nothing more is gained
        if not curvature > 0:
            return
        # 3. length, by the one image that there is
        part, length = at.part_of(step, gain / curvature, length, short)
        at.move(step, image, part, short)
