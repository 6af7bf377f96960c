"""A rigid sphere rolled over a rough strip: one contact problem a cell of the track, each begun from those before."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bem3d.checks import BoolArray, FloatArray, count, finite, fraction, positive
from bem3d.contact import Status, residual
from bem3d.convergence import ConvergenceError
from bem3d.diagnostics import warn
from bem3d.projected_cg import Load, projected_cg
from bem3d.read_only import ReadOnly
from bem3d.rolling_frame import Frame, Spans, Track
from bem3d.window import Candidates, smallest_box
from bem3d.window_solve import IterationState, contact_candidates

FIRST_STEP = 1.0
"""Of a start that is warm, the first step may be as long as the approximate inverse says."""
PATIENCE = 30
"""Iterations in which the residual has to halve."""
AHEAD = 2
"""Rows that a frame has ahead of what it must hold: of these the past two positions tell nothing."""
MARGIN = 0.07
"""How much wider than a contact a frame begins, on each side: for cells that `Frame.outside` cannot rule out."""
REFIT = 32
"""Positions after which the frame, which else only grows, is fitted anew."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Rolling(ReadOnly):
    """A wheel at each cell of its track: arrays of shape (positions,).

    force: normal force [N]; approach: of the sphere to the plane of height zero [m]; area: of the cells in contact
    [m^2]; residual: see `contact.residual`, with the deepest overlap in the frame that was solved on;
    operator_applications: of u = K p; converged: whether the residual is within the tolerance.
    """

    force: FloatArray
    approach: FloatArray
    area: FloatArray
    residual: FloatArray
    operator_applications: NDArray[np.int64]
    converged: NDArray[np.bool_]


def roll(
    height: ArrayLike,
    *,
    spacing: float | tuple[float, float],
    radius: float,
    modulus: float,
    approach: float | None = None,
    force: float | None = None,
    positions: int | None = None,
    tolerance: float = 1e-5,
    max_iterations: int = 500,
    raise_on_failure: bool = True,
) -> Rolling:
    """Roll a rigid sphere along a rough strip, quasi-statically, at a prescribed approach or a prescribed force.

    The wheel stands over the centres of the cells along axis 0, one after the other, and over the middle of axis 1.

    height: shape (nx, ny), positive towards the sphere, periodic along axis 0, longer and wider than the contact of the
    smooth sphere [m]; spacing: one number or (dx, dy) [m];
    radius: R [m]; modulus: E* [Pa]; exactly one of approach, counted from where the smooth sphere touches the plane of
    height zero [m], and force [N], both positive; positions: how many, from the first, all by default;
    tolerance: the residual to reach; max_iterations: a position;
    raise_on_failure: False goes on, from a cold start, after a position that did not converge, and marks it.
    The error of the force is about as large as the tolerance, as a part of the force of the smooth sphere: it is of
    first order in the residual, and larger at single positions of very rough strips (see the race of the report).

    Each position is solved on a frame of cells that moves with the wheel, from the pressures of the two before, carried
    along with the ground. The frame is proved large enough at each position, see `Frame.outside`, and grows where it is
    not.
    Warns of a smooth contact of few cells (ResolutionWarning), and of one as `solve` does (UnitsWarning).
    Raises ValueError or TypeError for input out of range, and where the contact reaches the edge of the strip;
    ConvergenceError with the history of the position that did not converge.
    """
    track = Track(height=cast(FloatArray, height), spacing=spacing, radius=radius, modulus=modulus)
    if (approach is None) == (force is None):
        raise ValueError(f"give either approach or force, got approach={approach} and force={force}")
    prescribed = positive("approach" if force is None else "force", approach if force is None else force)
    smooth = prescribed if force is None else hertz_approach(track, prescribed)
    _wide_enough(track, smooth)
    warn(track.diagnose(smooth))
    stop = track.height.shape[0] if positions is None else count("positions", positions)
    wheel = RollingContact(track, tolerance=tolerance, max_iterations=max_iterations)
    along = []
    for position in range(stop):
        contact = wheel.press(position, prescribed) if force is None else wheel.carry(position, prescribed)
        if raise_on_failure and not contact.converged:
            raise ConvergenceError(
                f"residual {contact.residual:.3g} after {len(contact.history) - 1} iterations ({contact.status}), "
                f"asked for {wheel.tolerance:g}, at position {position}",
                contact.history,
                contact,
            )
        along.append(contact)
    return Rolling(
        force=np.array([contact.force for contact in along]),
        approach=np.array([contact.approach for contact in along]),
        area=np.array([contact.area for contact in along]),
        residual=np.array([contact.residual for contact in along]),
        operator_applications=np.array([contact.operator_applications for contact in along], dtype=np.int64),
        converged=np.array([contact.converged for contact in along]),
    )


def rolling_force(
    height: ArrayLike,
    *,
    spacing: float | tuple[float, float],
    radius: float,
    modulus: float,
    approach: float,
    tolerance: float = 1e-5,
) -> FloatArray:
    """The normal force of a sphere that rolls along a rough strip at a fixed approach, shape (nx,) [N]: see `roll`."""
    rolled = roll(height, spacing=spacing, radius=radius, modulus=modulus, approach=approach, tolerance=tolerance)
    return rolled.force.copy()


@dataclass(frozen=True, eq=False, kw_only=True)
class WheelContact:
    """The wheel at one position: force [N], approach [m], area [m^2]; how the solve went, as in `Contact`."""

    force: float
    approach: float
    area: float
    history: tuple[float, ...]
    operator_applications: int
    status: Status

    @property
    def residual(self) -> float:
        """The last entry of the history."""
        return self.history[-1]

    @property
    def converged(self) -> bool:
        """Whether this is a solution."""
        return self.status is Status.CONVERGED


class RollingContact:
    """A sphere over a strip, solved position by position, at any approach or force.

    A position that follows the one before is begun from the pressures of the last two, any other from none.
    On a frame that moves with the wheel, cells that may touch are iterated on; a fresh application then gives the
    residual of all cells of the frame. Outside of it no cell can touch, see `Frame.outside`, or else it grows.

    track: strip, sphere and modulus; tolerance, max_iterations: as those of `roll`.
    """

    def __init__(self, track: Track, *, tolerance: float = 1e-5, max_iterations: int = 500):
        self.track = track
        self.tolerance = fraction("tolerance", tolerance)
        self.max_iterations = count("max_iterations", max_iterations)
        self._frame: Frame | None = None
        self._past: tuple[FramePressure, ...] = ()
        self._position = -1

    def press(self, position: int, approach: float) -> WheelContact:
        """The contact over a cell of the track, a whole number, at an approach of any sign [m]."""
        d = finite("approach", approach)
        return self._solve(count("position", position, least=0), d, lambda touch, _: Load(overlap=d - touch))

    def carry(self, position: int, force: float) -> WheelContact:
        """The contact over a cell of the track, a whole number, under a force above zero [N]."""
        d = hertz_approach(self.track, positive("force", force))
        return self._solve(count("position", position, least=0), d, lambda _, area: Load(total=force / area))

    def pressure(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Of the last position: x ahead of the wheel, y beside its middle [m], and the pressure at both [Pa].

        Raises ValueError where there is none, or where it did not converge.
        """
        if not self._past:
            raise ValueError("there is no pressure: no position is solved, or the last one has not converged")
        last = self._past[-1]
        x, y = (np.arange(*span) for span in (last.frame.rows, last.frame.columns))
        return self.track.along(x), self.track.across(y), last.pressure.copy()

    def _solve(self, position: int, expected: float, prescribed: Callable[[float, float], Load]) -> WheelContact:
        """On a frame that grows until no cell outside can touch.

        expected: approach, about; prescribed: the load, from the approach of first touch and the area of a cell.
        """
        frame = self._frame or self._around(self.track.smooth_contact(expected), MARGIN)
        start, attempt = self._carried(position), IterationState(np.empty(frame.shape), math.nan)
        while True:
            gap = frame.gap(position)
            touch = float(gap.min())
            load = prescribed(touch, self.track.cell_area)
            pressed = self._pressed(frame, gap - touch, load, start, expected - touch, attempt)
            spans = frame.outside(position, touch + attempt.overlap, pressed.pressure)
            if spans is None or attempt.status is not Status.CONVERGED:
                break
            frame = self._around(spans)
            start, attempt.status = FramePressure.by(frame, frame.take(pressed.pressure, pressed.frame)), None
            attempt.operator_applications += 1
        if frame.at_edge(pressed.pressure):
            raise ValueError(
                f"height must be wider than the contact, which reaches the edge of the strip of "
                f"{self.track.height.shape[1]} cells at position {position}"
            )
        self._remember(position, pressed, attempt.status)
        return WheelContact(
            force=float(pressed.pressure.sum()) * self.track.cell_area,
            approach=touch + attempt.overlap,
            area=int(np.count_nonzero(pressed.pressure)) * self.track.cell_area,
            history=tuple(attempt.history),
            operator_applications=attempt.operator_applications,
            status=attempt.status or Status.BREAKDOWN,
        )

    def _pressed(
        self,
        frame: Frame,
        near: FloatArray,
        load: Load,
        start: "FramePressure | None",
        expected: float,
        attempt: IterationState,
    ) -> "FramePressure":
        """The contact on a frame: iterate on cells that may touch, until a fresh application finds no others.

        near: gap from the first touch; start: a pressure to begin with, None where there is none; expected: overlap.
        """
        if load.overlap is not None and load.overlap <= 0:
            attempt.overlap = load.overlap
            attempt.record_residual(0.0, self.tolerance, self.max_iterations)
            return FramePressure.nowhere(frame)
        if start is None:
            start = FramePressure.by(frame, load.scaled(_cold(frame, near, expected)))
            attempt.operator_applications += 1
        if load.total is not None:
            start = start.times(load.total / float(start.pressure.sum()))
        marked, confirmed = np.zeros(frame.shape, dtype=np.bool_), math.inf
        while True:
            separation = near + start.displacement
            attempt.overlap = load.overlap_of(start.pressure, separation)
            w = separation - attempt.overlap
            if attempt.history:
                # a fresh residual takes the place of the running one of the same pressure
                attempt.history = attempt.history[:-1]
                attempt.record_residual(
                    residual(start.pressure, w, attempt.overlap), self.tolerance, self.max_iterations
                )
                gained, confirmed = attempt.history[-1] < confirmed / 2, attempt.history[-1]
            known, marked = marked, marked | contact_candidates(start.pressure, w) | (start.pressure < 0)
            if attempt.history and attempt.status is None and not gained and (marked == known).all():
                attempt.status = Status.STAGNATION
            if attempt.status is not None:
                return start
            start = FramePressure.by(frame, self._iterated(frame, marked, start.pressure, separation, load, attempt))
            attempt.operator_applications += 1

    def _iterated(
        self,
        frame: Frame,
        marked: BoolArray,
        pressure: FloatArray,
        separation: FloatArray,
        load: Load,
        attempt: IterationState,
    ) -> FloatArray:
        """The pressure at which the running residual on the marked cells is small enough, or nothing more is gained."""
        box = smallest_box(frame.half_space, marked)
        window = self.track.half_space((box[0].stop - box[0].start, box[1].stop - box[1].start))
        cells = Candidates(window, marked[box])
        p, g = cells.compress(pressure[box]), cells.compress(separation[box])
        if p.min() < 0:
            p, g = _pressing(cells, p, g, load)
            attempt.operator_applications += 1
        best, since = np.inf, 0
        for state in projected_cg(cells, p, g, load, FIRST_STEP):
            attempt.record_residual(state.residual, 0.0, self.max_iterations)
            best, since = (state.residual, 0) if state.residual < best / 2 else (best, since + 1)
            if state.residual <= self.tolerance or attempt.status is not None or since > PATIENCE:
                break
            attempt.operator_applications += 1
        attempt.status = None
        found = np.zeros(frame.shape)
        found[box] = cells.spread(state.pressure)
        return found

    def _carried(self, position: int) -> "FramePressure | None":
        """The secant through the last two pressures, which stay where they are on the ground as the wheel goes on.

        It may pull where the contact closes behind the wheel. Its displacement needs no application.
        """
        if position != self._position + 1 or not self._past:
            return None
        carried = self._past[-1].behind(1)
        if len(self._past) == 2:
            carried = carried.times(2).less(self._past[0].behind(2))
        # what has left the frame, or is about to, is nothing to begin with
        return carried if float(carried.pressure.sum()) > 0 else None

    def _remember(self, position: int, pressed: "FramePressure", status: Status | None) -> None:
        """What the next position begins with; now and then, on a frame that fits anew."""
        frame = pressed.frame
        past = [p for p in self._past[-1:] if position == self._position + 1 and p.frame is frame]
        self._past = (*past, pressed) if status is Status.CONVERGED else ()
        if position % REFIT == 0 and pressed.pressure.any():
            fitting = self._around(frame.spans_of(pressed.pressure > 0), MARGIN)
            if fitting.shape != frame.shape and fitting.within(frame):
                frame, self._past = fitting, tuple(p.on(fitting) for p in self._past)
        self._frame, self._position = frame, position

    def _around(self, spans: Spans, more: float = 0.0) -> Frame:
        """A frame that holds these cells, and so many more on each side, in parts of that, and rows ahead."""
        (first, last), columns = spans
        margin = int(more * max(last - first, columns[1] - columns[0]))
        return Frame(self.track, self.track.widened(((first, last + AHEAD), columns), margin))


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


def hertz_approach(track: Track, force: float) -> float:
    """d = (9 F^2 / (16 R E*^2))^(1/3) of the smooth sphere, from where a force is prescribed [m]."""
    return float(np.cbrt(9 / 16 / track.radius) * np.cbrt(force / track.modulus) ** 2)


def _cold(frame: Frame, gap: FloatArray, approach: float) -> FloatArray:
    """A pressure proportional to the overlap, as large as lowers the energy most; uniform where none is expected."""
    overlap = np.maximum(approach - gap, 0.0)
    if not overlap.any():
        return np.ones(frame.shape)
    return overlap * float((overlap**2).sum() / (overlap * frame.half_space.apply(overlap)).sum())


def _pressing(
    cells: Candidates, pressure: FloatArray, separation: FloatArray, load: Load
) -> tuple[FloatArray, FloatArray]:
    """From a pressure that pulls somewhere, one preconditioned step to one that does not, and its separation."""
    w = separation - load.overlap_of(pressure, separation)
    free = (pressure > 0) | (w < 0)
    step = FIRST_STEP * load.balanced(cells.inverse(-w * free), pressure)
    pressing = np.maximum((pressure + step) * free, 0.0)
    if load.total is not None and not pressing.any():
        pressing[:] = 1.0
    pressing = load.scaled(pressing)
    return pressing, separation + cells.displacement(pressing - pressure)


def _wide_enough(track: Track, approach: float) -> None:
    """Refuse a strip that cannot hold the contact of the smooth sphere."""
    diameter = 2 * float(np.sqrt(track.radius * approach))
    (nx, ny), (dx, dy) = track.height.shape, track.steps
    if nx * dx <= diameter:
        raise ValueError(f"height must be longer than the contact, {diameter:.6g} m, got a track of {nx * dx:.6g} m")
    if ny * dy <= diameter:
        raise ValueError(f"height must be wider than the contact, {diameter:.6g} m, got a strip of {ny * dy:.6g} m")
