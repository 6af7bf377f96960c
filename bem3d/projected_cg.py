"""Projected, preconditioned conjugate directions: one operator application an iteration, whatever the contact does."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from bem3d.border import BoolArray, FloatArray
from bem3d.contact import residual
from bem3d.window import dot

MEMORY = 3
"""Steps remembered, with their images: what conjugacy and truncation need, measured on rough contacts."""
FIRST_STEP = 0.4
"""The approximate inverse is too stiff by up to a factor of a few: eigenvalues of M K on a contact are 1 and more."""
WHOLE_STEP = 0.65
"""A step that cut cells off is taken whole if its best length is at least this part of it: it then gains energy."""


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
        return direction - float(direction.sum()) / float(pressure.sum()) * pressure

    def nearest(self, aim: FloatArray, free: BoolArray) -> FloatArray:
        """The nearest pressure, on the free cells, that is nowhere negative and has the prescribed total if any.

        With a total it is aim less one number on all cells that stay in contact, found by a sort.
        """
        if self.total is None:
            return np.where(free, np.maximum(aim, 0.0), 0.0)
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
    """The last steps s_i and their images y_i = K s_i."""

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Begin anew."""
        self._steps: list[FloatArray] = []
        self._images: list[FloatArray] = []
        self._gram = np.zeros((0, 0))

    def add(self, step: FloatArray, image: FloatArray) -> None:
        """Remember a step, in units of its largest pressure."""
        scale = float(np.abs(step).max())
        forgotten = max(len(self._steps) + 1 - MEMORY, 0)
        self._steps = [*self._steps[forgotten:], step / scale]
        self._images = [*self._images[forgotten:], image / scale]
        newest = [dot(self._steps[-1], other) for other in self._images]
        gram = np.empty((len(newest), len(newest)))
        gram[:-1, :-1] = self._gram[forgotten:, forgotten:]
        gram[-1], gram[:, -1] = newest, newest
        self._gram = gram

    def improve(self, direction: FloatArray, downhill: FloatArray) -> FloatArray:
        """The direction made conjugate to what is remembered, plus the step among that which gains the most energy."""
        if not self._steps:
            return direction
        remembered = list(zip(self._steps, self._images, strict=True))
        wanted = np.array([dot(step, downhill) - dot(image, direction) for step, image in remembered])
        weights = np.linalg.lstsq(self._gram, wanted, rcond=1e-10)[0]
        improved = direction.copy()
        for weight, step in zip(weights, self._steps, strict=True):
            improved += weight * step
        return improved


@dataclass(frozen=True, eq=False)
class Step:
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

    def inverse(self, displacement: FloatArray) -> FloatArray:
        """Nearly the pressure that makes this displacement, were it zero elsewhere."""


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
    memory = Memory()
    while True:
        s = load.overlap_of(pressure, separation)
        w = separation - s
        yield State(pressure, separation, s, residual(pressure, w, s))
        step = _downhill(cells, pressure, w, load, memory, length)
        if step is None:
            return
        image = cells.displacement(step.change)
        curvature = dot(step.change, image)
        if not curvature > 0:
            return
        best = step.gain / curvature
        taken, length = _taken(step, best, pressure, length)
        pressure = np.maximum(pressure + taken * step.change, 0.0)
        separation = separation + taken * image
        memory.add(step.change, image)


def _downhill(
    cells: Operator, pressure: FloatArray, w: FloatArray, load: Load, memory: Memory, length: float
) -> Step | None:
    """The first of three steps that gains energy: conjugate, preconditioned, plain. None if none does."""
    free = (pressure > 0) | (w < 0)
    downhill = np.where(free, -w, 0.0)
    preconditioned = length * load.balanced(np.where(free, cells.inverse(downhill), 0.0), pressure)
    step = _step(memory.improve(preconditioned, downhill), pressure, w, free, load)
    if not step.gain > 0:
        memory.forget()
        step = _step(preconditioned, pressure, w, free, load)
    if not step.gain > 0:
        # along the gradient and back to the nearest pressure: downhill unless there is no lower place
        change = load.nearest(pressure + length * cells.stiffness * downhill, free) - pressure
        step = Step(change, -dot(w, change), cut=True)
    return step if step.gain > 0 else None


def _step(direction: FloatArray, pressure: FloatArray, w: FloatArray, free: BoolArray, load: Load) -> Step:
    """From the pressure to the projection of pressure + direction."""
    aim = np.where(free, pressure + direction, 0.0)
    change = load.scaled(np.maximum(aim, 0.0)) - pressure
    return Step(change, -dot(w, change), bool(aim.min() < 0))


def _taken(step: Step, best: float, pressure: FloatArray, length: float) -> tuple[float, float]:
    """How much of the step to take, and the length to estimate next."""
    if not step.cut:
        with np.errstate(divide="ignore", invalid="ignore"):
            to_the_bound = float(np.min(np.where(step.change < 0, -pressure / step.change, np.inf)))
        return min(best, to_the_bound), length * min(max(best, 0.5), 2.0)
    if best >= WHOLE_STEP:
        return 1.0, max(length, min(FIRST_STEP, 2 * length))
    return best, length * max(best, 0.5)
