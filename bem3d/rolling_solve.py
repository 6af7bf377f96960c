"""The contact under the wheel on one frame: a start, projected conjugate directions, fresh residuals."""

import math
from dataclasses import dataclass

import numpy as np

from bem3d.checks import BoolArray, FloatArray
from bem3d.contact import Status, residual
from bem3d.projected_cg import Load, projected_cg
from bem3d.rolling_frame import Frame
from bem3d.window import Candidates, smallest_box
from bem3d.window_solve import IterationState, contact_candidates

FIRST_STEP = 1.0
"""Of a start that is warm, the first step may be as long as the approximate inverse says."""
PATIENCE = 30
"""Iterations in which the residual has to halve."""


@dataclass(frozen=True, eq=False)
class FramePressure:
    """A pressure on a frame, and the displacement that it makes there."""

    frame: Frame
    pressure: FloatArray
    displacement: FloatArray

    @classmethod
    def by(cls, frame: Frame, pressure: FloatArray) -> "FramePressure":
        """By one application of the operator."""
        return cls(frame, pressure, frame.half_space.apply(pressure))

    @classmethod
    def nowhere(cls, frame: Frame) -> "FramePressure":
        """No contact."""
        return cls(frame, np.zeros(frame.shape), np.zeros(frame.shape))

    def on(self, frame: Frame) -> "FramePressure":
        """On a frame that is part of this one."""
        return FramePressure(frame, frame.take(self.pressure, self.frame), frame.take(self.displacement, self.frame))

    def times(self, factor: float) -> "FramePressure":
        """So many times as hard."""
        return FramePressure(self.frame, factor * self.pressure, factor * self.displacement)

    def less(self, other: "FramePressure") -> "FramePressure":
        """The difference to another on this frame."""
        return FramePressure(self.frame, self.pressure - other.pressure, self.displacement - other.displacement)

    def behind(self, rows: int) -> "FramePressure":
        """Where it is on the ground when the wheel is so many rows further; ahead, as deep as in the last row known."""
        pressure, displacement = np.zeros(self.frame.shape), np.empty(self.frame.shape)
        pressure[:-rows], displacement[:-rows] = self.pressure[rows:], self.displacement[rows:]
        displacement[-rows:] = self.displacement[-1]
        return FramePressure(self.frame, pressure, displacement)


@dataclass(frozen=True, eq=False, kw_only=True)
class FrameSolve:
    """A contact problem on a frame.

    near: gap from the first touch; load: what is prescribed; attempt: residuals and applications, of earlier frames
    too; tolerance, max_iterations: as those of `roll`.
    """

    frame: Frame
    near: FloatArray
    load: Load
    attempt: IterationState
    tolerance: float
    max_iterations: int

    def solve(self, start: FramePressure | None, expected: float) -> FramePressure:
        """Iterate on cells that may touch, until a fresh application finds no others.

        start: a pressure to begin with, None where there is none; expected: overlap.
        """
        if self.load.overlap is not None and self.load.overlap <= 0:
            self.attempt.overlap = self.load.overlap
            self._record(0.0)
            return FramePressure.nowhere(self.frame)
        return self._confirmed(self._scaled(start or self._cold(expected)))

    def _confirmed(self, start: FramePressure) -> FramePressure:
        """Iterate from a pressure until a fresh application confirms its residual on all cells of the frame."""
        attempt = self.attempt
        marked, confirmed = np.zeros(self.frame.shape, dtype=np.bool_), math.inf
        while True:
            separation = self.near + start.displacement
            attempt.overlap = self.load.overlap_of(start.pressure, separation)
            w = separation - attempt.overlap
            if attempt.history:
                # a fresh residual takes the place of the running one of the same pressure
                attempt.history = attempt.history[:-1]
                self._record(residual(start.pressure, w, attempt.overlap))
                gained, confirmed = attempt.history[-1] < confirmed / 2, attempt.history[-1]
            known, marked = marked, marked | contact_candidates(start.pressure, w) | (start.pressure < 0)
            if attempt.history and attempt.status is None and not gained and (marked == known).all():
                attempt.status = Status.STAGNATION
            if attempt.status is not None:
                return start
            start = self._by(self._iterated(marked, start.pressure, separation))

    def _iterated(self, marked: BoolArray, pressure: FloatArray, separation: FloatArray) -> FloatArray:
        """The pressure at which the running residual on the marked cells is small enough, or nothing more is gained."""
        attempt, box = self.attempt, smallest_box(self.frame.half_space, marked)
        window = self.frame.track.half_space((box[0].stop - box[0].start, box[1].stop - box[1].start))
        cells = Candidates(window, marked[box])
        p, g = cells.compress(pressure[box]), cells.compress(separation[box])
        if p.min() < 0:
            p, g = _pressing(cells, p, g, self.load)
            attempt.operator_applications += 1
        best, since = np.inf, 0
        for state in projected_cg(cells, p, g, self.load, FIRST_STEP):
            attempt.record_residual(state.residual, 0.0, self.max_iterations)
            best, since = (state.residual, 0) if state.residual < best / 2 else (best, since + 1)
            if state.residual <= self.tolerance or attempt.status is not None or since > PATIENCE:
                break
            attempt.operator_applications += 1
        attempt.status = None
        found = np.zeros(self.frame.shape)
        found[box] = cells.spread(state.pressure)
        return found

    def _cold(self, approach: float) -> FramePressure:
        """Proportional to the overlap, as large as lowers the energy most; uniform where no overlap is expected."""
        frame, overlap = self.frame, np.maximum(approach - self.near, 0.0)
        pressure = np.ones(frame.shape)
        if overlap.any():
            pressure = overlap * float((overlap**2).sum() / (overlap * frame.half_space.apply(overlap)).sum())
        return self._by(self.load.scaled(pressure))

    def _scaled(self, start: FramePressure) -> FramePressure:
        """The start, scaled to the prescribed total if there is one."""
        return start if self.load.total is None else start.times(self.load.total / float(start.pressure.sum()))

    def _by(self, pressure: FloatArray) -> FramePressure:
        self.attempt.operator_applications += 1
        return FramePressure.by(self.frame, pressure)

    def _record(self, value: float) -> None:
        self.attempt.record_residual(value, self.tolerance, self.max_iterations)


def _pressing(
    cells: Candidates, pressure: FloatArray, separation: FloatArray, load: Load
) -> tuple[FloatArray, FloatArray]:
    """From a pressure that pulls somewhere, one preconditioned step to one that does not, and its separation."""
    w = separation - load.overlap_of(pressure, separation)
    free = (pressure > 0) | (w < 0)
    step = FIRST_STEP * load.balanced(cells.inverse(-w * free, free), pressure)
    pressing = np.maximum((pressure + step) * free, 0.0)
    if load.total is not None and not pressing.any():
        pressing[:] = 1.0
    pressing = load.scaled(pressing)
    return pressing, separation + cells.displacement(pressing - pressure)
