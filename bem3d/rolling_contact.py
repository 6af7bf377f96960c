"""The wheel over a strip, solved position by position: each begun from those before."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bem3d.checks import FloatArray, count, finite, fraction, positive
from bem3d.contact import Status
from bem3d.projected_cg import Load
from bem3d.results import line, span
from bem3d.rolling_frame import Frame, Spans, Track
from bem3d.rolling_solve import FramePressure, FrameSolve
from bem3d.window_solve import IterationState

ROWS_AHEAD = 2
"""Rows that a frame has ahead of what it must hold: the past two positions have no pressure there."""
FRAME_MARGIN = 0.07
"""How much wider than a contact a frame begins, on each side: for cells that `Frame.outside` cannot rule out."""
REFIT_INTERVAL = 32
"""Positions after which the frame, which else only grows, is fitted anew."""


@dataclass(frozen=True, eq=False, kw_only=True)
class WheelContact:
    """Wheel at one position of its track. Made by `RollingContact`.

    Attributes
    ----------
    force, approach, area : float
        Normal force [N], approach to the plane of height zero [m], area of the cells in contact [m^2]; NaN where the
        solve has not converged.
    history : tuple of float
        Residual at the start and after each iteration.
    operator_applications : int
        Applications of u = K p.
    status : Status
        How the solve ended.

    Examples
    --------
    >>> track = bem3d.Track(height=np.zeros((64, 48)), spacing=1e-4, radius=0.5, modulus=2e11)
    >>> contact = bem3d.RollingContact(track).press(0, 2e-6)
    >>> contact.converged, contact.residual <= 1e-5
    (True, True)
    """

    force: float
    approach: float
    area: float
    history: tuple[float, ...]
    operator_applications: int
    status: Status

    def __repr__(self) -> str:
        load = f"force={span(self.force, 'N')}, approach={span(self.approach, 'm')}, area={span(self.area, 'm^2')}"
        return line(f"WheelContact({load}, {self.status}, iterations={len(self.history) - 1})")

    @property
    def residual(self) -> float:
        """The last entry of the history."""
        return self.history[-1]

    @property
    def converged(self) -> bool:
        """Whether this is a solution."""
        return self.status is Status.CONVERGED


class RollingContact:
    """Wheel over a rough strip, solved position by position, at any approach or force.

    Parameters
    ----------
    track : Track
        Strip, wheel and modulus.
    tolerance : float, optional
        `residual` to reach, in (0, 1).
    max_iterations : int, optional
        Limit at each position, at least 1.

    Notes
    -----
    A position that follows the one before is begun from the pressures of the last two, any other from none. Cells
    that may touch are iterated on, in a frame that moves with the wheel. A fresh application gives the residual of
    all cells of the frame. Outside of the frame no cell can touch, see ``rolling_frame.Frame.outside``, or else the
    frame grows.

    Examples
    --------
    >>> track = bem3d.Track(height=np.zeros((64, 48)), spacing=1e-4, radius=0.5, modulus=2e11)
    >>> wheel = bem3d.RollingContact(track)
    >>> print(f"{wheel.press(0, 2e-6).force:.0f} N, then {wheel.carry(1, 500.0).approach:.3g} m")
    534 N, then 1.91e-06 m
    """

    def __init__(self, track: Track, *, tolerance: float = 1e-5, max_iterations: int = 500):
        self.track = track
        self.tolerance = fraction("tolerance", tolerance)
        self.max_iterations = count("max_iterations", max_iterations)
        self._frame: Frame | None = None
        self._past: tuple[FramePressure, ...] = ()
        self._position = -1

    def press(self, position: int, approach: float) -> WheelContact:
        """Contact over a cell of the track, at an approach.

        Parameters
        ----------
        position : int
            Number of the cell along axis 0, from zero.
        approach : float
            Approach to the plane of height zero, of any sign [m].

        Returns
        -------
        WheelContact
            Converged or not, see its ``status``.

        Raises
        ------
        ValueError, TypeError
            If an argument is out of range, or the contact reaches the edge of the strip.
        """
        d = finite("approach", approach)
        return self._solve(count("position", position, least=0), d, lambda touch, _: Load(overlap=d - touch))

    def carry(self, position: int, force: float) -> WheelContact:
        """Contact over a cell of the track, under a force.

        Parameters
        ----------
        position : int
            Number of the cell along axis 0, from zero.
        force : float
            Normal force, positive [N].

        Returns
        -------
        WheelContact
            Converged or not, see its ``status``.

        Raises
        ------
        ValueError, TypeError
            If an argument is out of range, or the contact reaches the edge of the strip.
        """
        d = self.track.smooth.approach(positive("force", force) / self.track.modulus)
        return self._solve(count("position", position, least=0), d, lambda _, area: Load(total=force / area))

    def pressure(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Pressure at the last position.

        Returns
        -------
        x : ndarray, shape (n,)
            Distance ahead of the wheel [m].
        y : ndarray, shape (m,)
            Distance from the middle of the strip [m].
        pressure : ndarray, shape (n, m)
            Pressure at both [Pa].

        Raises
        ------
        ValueError
            If no position is solved, or the last one has not converged.
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
        frame = self._frame or self._around(self.track.smooth_contact(expected), FRAME_MARGIN)
        start, attempt = self._carried(position), IterationState(np.empty(frame.shape), math.nan)
        while True:
            gap = frame.gap(position)
            touch = float(gap.min())
            load = prescribed(touch, self.track.cell_area)
            on_frame = FrameSolve(
                frame=frame,
                near=gap - touch,
                load=load,
                attempt=attempt,
                tolerance=self.tolerance,
                max_iterations=self.max_iterations,
            )
            pressed = on_frame.solve(start, expected - touch)
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
        # what is no solution has no number that could be taken for one
        known = 1.0 if attempt.status is Status.CONVERGED else math.nan
        return WheelContact(
            force=known * float(pressed.pressure.sum()) * self.track.cell_area,
            approach=known * (touch + attempt.overlap),
            area=known * int(np.count_nonzero(pressed.pressure)) * self.track.cell_area,
            history=tuple(attempt.history),
            operator_applications=attempt.operator_applications,
            status=attempt.status or Status.BREAKDOWN,
        )

    def _carried(self, position: int) -> FramePressure | None:
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

    def _remember(self, position: int, pressed: FramePressure, status: Status | None) -> None:
        """What the next position begins with; now and then, on a frame that fits anew."""
        frame = pressed.frame
        past = [p for p in self._past[-1:] if position == self._position + 1 and p.frame is frame]
        self._past = (*past, pressed) if status is Status.CONVERGED else ()
        if position % REFIT_INTERVAL == 0 and pressed.pressure.any():
            fitting = self._around(frame.spans_of(pressed.pressure > 0), FRAME_MARGIN)
            if fitting.shape != frame.shape and fitting.within(frame):
                frame, self._past = fitting, tuple(p.on(fitting) for p in self._past)
        self._frame, self._position = frame, position

    def _around(self, spans: Spans, more: float = 0.0) -> Frame:
        """A frame that holds these cells, and so many more on each side, in parts of that, and rows ahead."""
        (first, last), columns = spans
        margin = int(more * max(last - first, columns[1] - columns[0]))
        return Frame(self.track, self.track.widened(((first, last + ROWS_AHEAD), columns), margin))
