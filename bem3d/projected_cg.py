"""Projected, preconditioned conjugate directions: one operator application an iteration, whatever the contact does."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from bem3d.checks import BoolArray, FloatArray
from bem3d.contact import residual
from bem3d.window import dot, dots

STEPS_REMEMBERED = 3
"""Steps remembered, with their images: what conjugacy and truncation need, measured on rough contacts."""
FIRST_STEP = 0.4
"""The approximate inverse is too stiff by up to a factor of a few: eigenvalues of M K on a contact are 1 and more."""
WHOLE_STEP = 0.65
"""A step that cut cells off is taken whole if its best length is at least this part of it: it then gains energy."""
ROUNDING = 8 * float(np.finfo(np.float64).eps)
"""Part of its pressure that a cell may keep by rounding alone when a step ends where the cell leaves the contact: a
division, a product and a sum leave 2 eps, with a margin of 4."""


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


@dataclass(frozen=True, eq=False)
class State:
    """Pressure p, separation g + u, overlap s, and the residual they have, on the candidate cells."""

    pressure: FloatArray
    separation: FloatArray
    overlap: float
    residual: float


class Memory:
    """The last steps s_i and their images y_i = K s_i, as rows."""

    def __init__(self, size: int) -> None:
        self._rows = np.empty((2, STEPS_REMEMBERED, size))
        self.forget()

    def forget(self) -> None:
        """Begin anew."""
        self._count = self._next = 0
        self._gram = np.zeros((STEPS_REMEMBERED, STEPS_REMEMBERED))

    def add(self, step: FloatArray, image: FloatArray) -> None:
        """Remember a step, in units of its largest pressure, in the place of the oldest."""
        # steps shrink by decades during a solve: in units of their own the small system is well scaled
        scale = float(np.abs(step).max())
        steps, images = self._rows
        np.divide(step, scale, out=steps[self._next])
        np.divide(image, scale, out=images[self._next])
        self._count = min(self._count + 1, STEPS_REMEMBERED)
        known = slice(0, self._count)
        self._gram[self._next, known] = dots(images[known], steps[self._next])
        self._gram[known, self._next] = self._gram[self._next, known]
        self._next = (self._next + 1) % STEPS_REMEMBERED

    def improve(self, direction: FloatArray, downhill: FloatArray) -> FloatArray:
        """The direction made conjugate to what is remembered, plus the step among that which gains the most energy."""
        if self._count == 0:
            return direction
        known = slice(0, self._count)
        steps, images = self._rows[:, known]
        # one system does both: a step that was cut short leaves energy to gain along itself
        wanted = dots(steps, downhill) - dots(images, direction)
        weights = solved(self._gram[known, known].tolist(), wanted.tolist())
        return np.asarray(direction + np.einsum("i,ij->j", weights, steps))


def solved(gram: list[list[float]], wanted: list[float]) -> list[float]:
    """The small system G x = b, G symmetric and nearly singular at worst: an unknown that adds nothing stays zero."""
    count = len(wanted)
    left = [gram[i][i] for i in range(count)]
    for k in range(count):
        # the pivot of a step that the others contain is rounding alone: it must not blow up the rest
        if not gram[k][k] > 1e-10 * left[k]:
            for i in range(count):
                gram[i][k] = gram[k][i] = 0.0
            gram[k][k], wanted[k] = 1.0, 0.0
        for i in range(k + 1, count):
            factor = gram[i][k] / gram[k][k]
            wanted[i] -= factor * wanted[k]
            for j in range(k, count):
                gram[i][j] -= factor * gram[k][j]
    for k in reversed(range(count)):
        wanted[k] = (wanted[k] - sum(gram[k][j] * wanted[j] for j in range(k + 1, count))) / gram[k][k]
    return wanted


@dataclass(frozen=True, eq=False)
class IterationStep:
    """A change of the pressure that keeps it in bounds, the slope of the energy along it, whether it was cut short."""

    change: FloatArray
    gain: float
    cut: bool


class Operator(Protocol):
    """K and its approximate inverse on vectors over the cells that may touch."""

    @property
    def stiffness(self) -> float:
        """Pressure on a cell alone that moves it by a unit [Pa/m]."""

    def displacement(self, pressure: FloatArray) -> FloatArray:
        """u = K p."""

    def inverse(self, displacement: FloatArray, free: BoolArray) -> FloatArray:
        """Nearly the pressure on the free cells that makes this displacement."""


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
    memory = Memory(pressure.size)
    while True:
        # 1. residual: before the step, so that the caller may stop without another application
        s = load.overlap_of(pressure, separation)
        w = separation - s
        yield State(pressure, separation, s, residual(pressure, w, s))
        # 2. direction, cut at p = 0 before the operator is applied: its image is then exact, whatever was cut
        step = _downhill(cells, pressure, w, load, memory, length)
        if step is None:
            return
        image = cells.displacement(step.change)
        curvature = dot(step.change, image)
        # K is positive: a step without curvature, or NaN, is rounding, and nothing more is gained
        if not curvature > 0:
            return
        best = step.gain / curvature
        # 3. length, by the one image that there is
        taken, length = _taken(step, best, pressure, length)
        pressure = _left_over(pressure, taken * step.change)
        # summed up, which spares an application; the caller confirms it with a fresh one
        separation = separation + taken * image
        memory.add(step.change, image)


def _downhill(
    cells: Operator, pressure: FloatArray, w: FloatArray, load: Load, memory: Memory, length: float
) -> IterationStep | None:
    """The first of three steps that gains energy: conjugate, preconditioned, plain. None if none does."""
    # a cell out of contact that does not overlap has nothing to gain by pressure
    free = (pressure > 0) | (w < 0)
    downhill = -w * free
    preconditioned = length * load.balanced(cells.inverse(downhill, free) * free, pressure)
    step = _step(memory.improve(preconditioned, downhill), pressure, w, free, load)
    # cut off at p = 0, even a conjugate direction may lead up: the memory is of another contact then
    if not step.gain > 0:
        memory.forget()
        step = _step(preconditioned, pressure, w, free, load)
    if not step.gain > 0:
        # along the gradient and back to the nearest pressure: downhill unless there is no lower place
        change = load.nearest(pressure + length * cells.stiffness * downhill, free) - pressure
        step = IterationStep(change, -dot(w, change), cut=True)
    return step if step.gain > 0 else None


def _step(direction: FloatArray, pressure: FloatArray, w: FloatArray, free: BoolArray, load: Load) -> IterationStep:
    """From the pressure to the projection of pressure + direction."""
    aim = (pressure + direction) * free
    # the cut adds pressure, so that a prescribed total is restored before the step is measured
    change = load.scaled(np.maximum(aim, 0.0)) - pressure
    return IterationStep(change, -dot(w, change), bool(aim.min() < 0))


def _taken(step: IterationStep, best: float, pressure: FloatArray, length: float) -> tuple[float, float]:
    """How much of the step to take, and the length to estimate next."""
    if not step.cut:
        # nothing was cut, so that the best length may lie beyond p = 0: it ends where a cell would be pulled on
        with np.errstate(divide="ignore", invalid="ignore"):
            to_the_bound = float(np.min(np.where(step.change < 0, -pressure / step.change, np.inf)))
        # the estimate follows by a factor of two at most, since one step is no measure of the next
        return min(best, to_the_bound), length * min(max(best, 0.5), 2.0)
    if best >= WHOLE_STEP:
        # the energy gained goes as best t - t^2 / 2 along the step: a whole one gains from best = 1/2 on
        return 1.0, max(length, min(FIRST_STEP, 2 * length))
    # a part of a cut step stays in bounds, between two pressures that are
    return best, length * max(best, 0.5)


def _left_over(pressure: FloatArray, change: FloatArray) -> FloatArray:
    """Pressure after a step; a cell that keeps no more than rounding is out of the contact."""
    after = pressure + change
    return np.where(after > ROUNDING * pressure, after, 0.0)
