"""A rigid sphere rolled over a rough strip: one contact problem a cell of the track, each begun from those before."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce
from typing import cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bem3d.border import FloatArray, count, finite, fraction, positive
from bem3d.contact import Status, residual
from bem3d.convergence import ConvergenceError
from bem3d.halfspace import HalfSpace
from bem3d.press import Attempt
from bem3d.projected_cg import Load, projected_cg
from bem3d.track import Frame, Spans, Track, joined

FIRST_STEP = 0.5
"""A warm start leaves errors at the edge of the contact, where the approximate inverse is too stiff by about two."""
PATIENCE = 30
"""Iterations in which the residual has to halve."""
LATELY = 16
"""Positions whose contacts the tight window holds, and a margin."""
REFIT = 64
"""Positions after which the guard, which else only grows, is laid anew."""
GUARD = 0.08
"""How much wider than the tight window the guard begins, on each side, in parts of its side."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Rolling:
    """A wheel at each cell of its track: arrays of shape (positions,).

    force: normal force [N]; approach: of the sphere to the mean plane of the strip [m]; area: of the cells in contact
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

    height: shape (nx, ny), positive towards the sphere, periodic along axis 0 [m]; spacing: one number or (dx, dy) [m];
    radius: R [m]; modulus: E* [Pa]; exactly one of approach, counted from where the smooth sphere touches the plane of
    height zero [m], and force [N], both positive; positions: how many, from the first, all by default;
    tolerance: the residual to reach; max_iterations: a position;
    raise_on_failure: False goes on, from a cold start, after a position that did not converge, and marks it.
    The error of the force is of second order in that of the pressure: about a hundredth of the tolerance, relatively,
    of the force of a smooth sphere (measured; see the report).

    Each position is solved on a frame of cells that moves with the wheel, from the pressures of the two before, carried
    along with the ground. The frame is proved large enough at each position, see `Frame.outside`, and grows where it is
    not.
    Raises ValueError or TypeError for input out of range, and where the contact reaches the edge of the strip;
    ConvergenceError with the history of the position that did not converge.
    """
    track = Track(height=np.asarray(height), spacing=spacing, radius=radius, modulus=modulus)
    if (approach is None) == (force is None):
        raise ValueError(f"give either approach or force, got approach={approach} and force={force}")
    prescribed = positive("approach" if force is None else "force", approach if force is None else force)
    smooth = prescribed if force is None else hertz_approach(track, prescribed)
    _wide_enough(track, smooth)
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
    return roll(height, spacing=spacing, radius=radius, modulus=modulus, approach=approach, tolerance=tolerance).force


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
    Two windows move with the wheel: a tight one, on whose cells is iterated, and around it the guard, on whose cells a
    fresh application then gives the residual. Outside the guard no cell can touch, see `Frame.outside`. Both grow at
    once where they prove too small.

    track: strip, sphere and modulus; tolerance, max_iterations: as those of `roll`.
    """

    def __init__(self, track: Track, *, tolerance: float = 1e-5, max_iterations: int = 500):
        self.track = track
        self.tolerance = fraction("tolerance", tolerance)
        self.max_iterations = count("max_iterations", max_iterations)
        self._guard: Frame | None = None
        self._tight: Spans = (0, 1), (0, 1)
        self._touched: list[Spans] = []
        self._past: tuple[FloatArray, ...] = ()
        self._position = -1

    def press(self, position: int, approach: float) -> WheelContact:
        """The contact over a cell of the track, a whole number, at an approach of any sign [m]."""
        d = finite("approach", approach)
        return self._solve(count("position", position, least=0), d, lambda touch, _: Load(overlap=d - touch))

    def carry(self, position: int, force: float) -> WheelContact:
        """The contact over a cell of the track, a whole number, under a force above zero [N]."""
        d = hertz_approach(self.track, positive("force", force))
        return self._solve(count("position", position, least=0), d, lambda _, area: Load(total=force / area))

    def _solve(self, position: int, expected: float, prescribed: Callable[[float, float], Load]) -> WheelContact:
        """Iterate on the tight window, look at the guard, and enlarge what is too small, until nothing is.

        expected: approach, about; prescribed: the load, from the approach of first touch and the area of a cell.
        """
        if self._guard is None:
            self._tight = self.track.widened(_smooth_contact(self.track, expected), margin=1)
            self._guard = self._around_tight()
        pressure, attempt = self._carried(position), Attempt(np.zeros(0), 0.0)
        while True:
            guard = self._guard
            gap = guard.gap(position)
            touch = float(gap.min())
            load = prescribed(touch, self.track.cell_area)
            near, box = gap - touch, guard.box(self._tight)
            if load.overlap is not None and load.overlap <= 0:
                pressure, w = np.zeros(guard.shape), near - load.overlap
                attempt.overlap, attempt.status = load.overlap, Status.CONVERGED
                attempt.history.append(0.0)
            else:
                start = _cold(guard, near, expected - touch) if pressure is None else pressure
                pressure = np.zeros(guard.shape)
                pressure[box] = self._iterated(near[box], load.scaled(start[box]), load, attempt)
                w = self._judged(near, pressure, load, attempt)
            if not self._enlarged(position, touch + attempt.overlap, pressure, w, attempt):
                break
            pressure = self._guard.take(pressure, guard)
        self._remember(position, pressure, attempt.status)
        return WheelContact(
            force=float(pressure.sum()) * self.track.cell_area,
            approach=touch + attempt.overlap,
            area=int(np.count_nonzero(pressure)) * self.track.cell_area,
            history=tuple(attempt.history),
            operator_applications=attempt.operator_applications,
            status=attempt.status or Status.BREAKDOWN,
        )

    def _iterated(self, near: FloatArray, start: FloatArray, load: Load, attempt: Attempt) -> FloatArray:
        """The pressure on the tight window at which the running residual is small enough, or nothing more is gained."""
        half_space = self.track.half_space((near.shape[0], near.shape[1]))
        if not start.any():
            start = load.scaled(np.ones(near.shape))
        separation = near + half_space.apply(start)
        best, since = np.inf, 0
        for state in projected_cg(WholeWindow(half_space), start.ravel(), separation.ravel(), load, FIRST_STEP):
            attempt.operator_applications += 1
            attempt.judge(state.residual, 0.0, self.max_iterations)
            best, since = (state.residual, 0) if state.residual < best / 2 else (best, since + 1)
            if state.residual <= self.tolerance or attempt.status is not None or since > PATIENCE:
                break
        return state.pressure.reshape(near.shape)

    def _judged(self, near: FloatArray, pressure: FloatArray, load: Load, attempt: Attempt) -> FloatArray:
        """w on the guard from a fresh application; its residual takes the place of the running one."""
        separation = near + self.track.half_space((near.shape[0], near.shape[1])).apply(pressure)
        attempt.operator_applications += 1
        attempt.overlap = load.overlap_of(pressure, separation)
        w = separation - attempt.overlap
        attempt.history = attempt.history[:-1]
        attempt.judge(residual(pressure, w, attempt.overlap), self.tolerance, self.max_iterations)
        attempt.status = attempt.status or Status.STAGNATION
        return w

    def _enlarged(self, position: int, approach: float, pressure: FloatArray, w: FloatArray, attempt: Attempt) -> bool:
        """Whether tight window or guard had to grow, since cells outside overlap or cannot be ruled out."""
        guard = cast(Frame, self._guard)
        missed = w < -self.tolerance * attempt.overlap
        missed[guard.box(self._tight)] = False
        if missed.any():
            self._tighten(joined(self._tight, guard.spans_of(missed)))
            attempt.status = None
            return True
        if attempt.status is not Status.CONVERGED:
            return False
        if guard.at_edge(pressure):
            raise ValueError(
                f"height must be wider than the contact, which reaches the edge of the strip of "
                f"{self.track.height.shape[1]} cells at position {position}"
            )
        spans = guard.outside(position, approach, pressure)
        if spans is None:
            return False
        self._guarded(Frame(self.track, self.track.widened(spans, margin=2)))
        attempt.status = None
        return True

    def _tighten(self, spans: Spans) -> None:
        """Iterate on these cells, and let the guard hold them."""
        guard = cast(Frame, self._guard)
        self._tight = self.track.widened(spans, margin=1)
        if joined(self._tight, guard.spans) != guard.spans:
            self._guarded(Frame(self.track, self.track.widened(joined(self._tight, guard.spans), margin=0)))

    def _guarded(self, frame: Frame) -> None:
        """Take another guard, and what is known with it."""
        old, self._guard = cast(Frame, self._guard), frame
        self._past = tuple(frame.take(past, old) for past in self._past)

    def _around_tight(self) -> Frame:
        """A guard as the bound of `Frame.outside` needs it around most contacts."""
        margin = int(GUARD * max(span[1] - span[0] for span in self._tight)) + 1
        return Frame(self.track, self.track.widened(self._tight, margin))

    def _carried(self, position: int) -> FloatArray | None:
        """The secant through the last two pressures, which stay where they are on the ground as the wheel goes on."""
        if position != self._position + 1 or not self._past or not self._past[-1].any():
            return None
        last = _behind(self._past[-1], 1)
        if len(self._past) == 1:
            return last
        return np.maximum(2 * last - _behind(self._past[0], 2), 0.0)

    def _remember(self, position: int, pressure: FloatArray, status: Status | None) -> None:
        """What the next position begins with, and which cells: those that were in contact of late, and a margin."""
        guard = cast(Frame, self._guard)
        if status is not Status.CONVERGED:
            self._past = ()
        else:
            self._past = (*self._past[-1:], pressure) if position == self._position + 1 else (pressure,)
        self._position = position
        if not pressure.any():
            return
        self._touched = [*self._touched[1 - LATELY :], guard.spans_of(pressure > 0)]
        self._tighten(reduce(joined, self._touched))
        if position % REFIT == 0:
            self._guarded(self._around_tight())


@dataclass(frozen=True)
class WholeWindow:
    """K and its approximate inverse on vectors over all cells of a window."""

    half_space: HalfSpace

    @property
    def stiffness(self) -> float:
        """Pressure on a cell alone that moves it by a unit [Pa/m]."""
        return 1 / self.half_space.self_compliance

    def displacement(self, pressure: FloatArray) -> FloatArray:
        """u = K p."""
        return self.half_space.convolution(pressure.reshape(self.half_space.shape)).reshape(-1)

    def inverse(self, displacement: FloatArray) -> FloatArray:
        """Nearly the pressure that makes this displacement, were it zero elsewhere."""
        return self.half_space.inverse(displacement.reshape(self.half_space.shape)).reshape(-1)


def hertz_approach(track: Track, force: float) -> float:
    """d = (9 F^2 / (16 R E*^2))^(1/3) of the smooth sphere, from where a force is prescribed [m]."""
    return float(np.cbrt(9 / 16 / track.radius) * np.cbrt(force / track.modulus) ** 2)


def _smooth_contact(track: Track, approach: float) -> Spans:
    """Cells under the smooth sphere, one at least, as far as the strip has them."""
    (nx, ny), (dx, dy) = track.height.shape, track.steps
    a = np.sqrt(track.radius * max(approach, 0.0))
    ahead, across = min(int(a / dx), (nx - 1) // 2), min(int(a / dy) + 1, ny // 2)
    return (-ahead, ahead + 1), (ny // 2 - across, ny - ny // 2 + across)


def _cold(frame: Frame, gap: FloatArray, approach: float) -> FloatArray:
    """A pressure proportional to the overlap, as large as lowers the energy most; uniform where none is expected."""
    overlap = np.maximum(approach - gap, 0.0)
    if not overlap.any():
        return np.ones(frame.shape)
    return overlap * float((overlap**2).sum() / (overlap * frame.half_space.apply(overlap)).sum())


def _behind(pressure: FloatArray, rows: int) -> FloatArray:
    """What was under the wheel, so many rows further back."""
    moved = np.zeros_like(pressure)
    moved[:-rows] = pressure[rows:]
    return moved


def _wide_enough(track: Track, approach: float) -> None:
    """Refuse a strip that cannot hold the contact of the smooth sphere."""
    diameter = 2 * float(np.sqrt(track.radius * approach))
    (nx, ny), (dx, dy) = track.height.shape, track.steps
    if nx * dx <= diameter:
        raise ValueError(f"height must be longer than the contact, {diameter:.6g} m, got a track of {nx * dx:.6g} m")
    if ny * dy <= diameter:
        raise ValueError(f"height must be wider than the contact, {diameter:.6g} m, got a strip of {ny * dy:.6g} m")
