"""A rigid wheel rolled over a rough strip, quasi-statically."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bem3d.checks import FloatArray, OneOrTwo, count, positive
from bem3d.convergence import ConvergenceError
from bem3d.diagnostics import warn
from bem3d.progress import Progress, steps
from bem3d.results import ReadOnly, line, span
from bem3d.rolling_contact import RollingContact, WheelContact
from bem3d.rolling_frame import Track


@dataclass(frozen=True, eq=False, kw_only=True)
class Rolling(ReadOnly):
    """Wheel at each cell of its track. Made by `roll`.

    Attributes
    ----------
    force : ndarray, shape (positions,)
        Normal force [N]. Like approach and area, NaN where a position has not converged.
    approach : ndarray, shape (positions,)
        Approach to the plane of height zero [m].
    area : ndarray, shape (positions,)
        Area of the cells in contact [m^2].
    residual : ndarray, shape (positions,)
        `residual` of each contact, over the deepest overlap in the frame.
    operator_applications : ndarray of int, shape (positions,)
        Applications of u = K p.
    converged : ndarray of bool, shape (positions,)
        Whether the residual is within the tolerance.

    Examples
    --------
    >>> rolled = bem3d.roll(np.zeros((64, 48)), spacing=1e-4, radius=0.5, modulus=2e11, force=500.0, positions=2)
    >>> rolled.force, rolled.converged
    (array([500., 500.]), array([ True,  True]))
    """

    force: FloatArray
    approach: FloatArray
    area: FloatArray
    residual: FloatArray
    operator_applications: NDArray[np.int64]
    converged: NDArray[np.bool_]

    def __repr__(self) -> str:
        load = f"force={span(self.force, 'N')}, approach={span(self.approach, 'm')}, area={span(self.area, 'm^2')}"
        return line(f"Rolling({load}, {np.count_nonzero(self.converged)}/{self.converged.size} converged)")


def roll(
    height: ArrayLike,
    *,
    spacing: OneOrTwo,
    radius: OneOrTwo,
    modulus: float,
    transverse_profile: ArrayLike | None = None,
    approach: float | None = None,
    force: float | None = None,
    positions: int | None = None,
    tolerance: float = 1e-5,
    max_iterations: int = 500,
    raise_on_failure: bool = True,
    progress: Progress = False,
) -> Rolling:
    """Roll a rigid wheel along a rough strip, quasi-statically.

    Parameters
    ----------
    height : array_like, shape (nx, ny)
        Heights, positive towards the wheel, periodic along axis 0 [m].
    spacing, radius, modulus, transverse_profile
        As in `Track`.
    approach, force : float, optional
        Either the approach to the plane of height zero [m] or the normal force [N], both positive.
    positions : int, optional
        Number of positions, from the first cell of axis 0. All by default.
    tolerance, max_iterations, raise_on_failure, progress
        As in `solve` and `indent`, at each position. The tolerance is about the relative error of the force.

    Returns
    -------
    Rolling
        Force, approach, area and convergence, with the wheel over the centre of each cell and the middle of axis 1.

    Raises
    ------
    ValueError, TypeError, ConvergenceError
        As `solve`, and if the contact reaches the edge of the strip.

    Warns
    -----
    ResolutionWarning, UnitsWarning
        As `solve`, of the smooth wheel.

    Examples
    --------
    >>> rolled = bem3d.roll(np.zeros((64, 48)), spacing=1e-4, radius=0.5, modulus=2e11, approach=2e-6, positions=3)
    >>> print(f"{rolled.force.mean():.0f} N, by Hertz {4 / 3 * 2e11 * 0.5**0.5 * 2e-6**1.5:.0f} N")
    534 N, by Hertz 533 N
    """
    track = _track(height, spacing, radius, modulus, transverse_profile)
    prescribed, smooth = _prescribed(track, approach, force)
    _wide_enough(track, smooth)
    warn(track.diagnose(smooth))
    wheel = RollingContact(track, tolerance=tolerance, max_iterations=max_iterations)
    press = wheel.press if force is None else wheel.carry
    stop = len(track.height) if positions is None else count("positions", positions)
    solved = steps(progress, stop)
    return _joined([_accepted(press(i, prescribed), i, wheel, raise_on_failure, solved) for i in range(stop)])


def _track(
    height: ArrayLike, spacing: OneOrTwo, radius: OneOrTwo, modulus: float, transverse_profile: ArrayLike | None
) -> Track:
    """Strip and wheel, checked."""
    heights, profile = cast(FloatArray, height), cast(FloatArray | None, transverse_profile)
    return Track(height=heights, spacing=spacing, radius=radius, modulus=modulus, transverse_profile=profile)


def _prescribed(track: Track, approach: float | None, force: float | None) -> tuple[float, float]:
    """The one of the two that is given, and the approach of the smooth wheel; ValueError for both or neither."""
    if (approach is None) == (force is None):
        raise ValueError(f"give either approach or force, got approach={approach} and force={force}")
    if force is None:
        d = positive("approach", approach)
        return d, d
    force = positive("force", force)
    return force, track.smooth.approach(force / track.modulus)


def _accepted(
    contact: WheelContact, position: int, wheel: RollingContact, raise_on_failure: bool, solved: Callable[[], object]
) -> WheelContact:
    """The contact at a position, which is told; ConvergenceError where it is no solution and that matters."""
    solved()
    if contact.converged or not raise_on_failure:
        return contact
    raise ConvergenceError(
        f"residual {contact.residual:.3g} after {len(contact.history) - 1} iterations ({contact.status}), "
        f"asked for {wheel.tolerance:g}, at position {position}",
        contact.history,
        contact,
    )


def _joined(along: list[WheelContact]) -> Rolling:
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
    spacing: OneOrTwo,
    radius: OneOrTwo,
    modulus: float,
    approach: float,
    tolerance: float = 1e-5,
) -> FloatArray:
    """Force of a wheel that rolls along a rough strip at a given approach.

    Parameters
    ----------
    height, spacing, radius, modulus, approach, tolerance
        As in `roll`.

    Returns
    -------
    ndarray, shape (nx,)
        ``roll(...).force`` [N], which may be written to.

    Raises
    ------
    ValueError, TypeError, ConvergenceError
        As `roll`.

    Warns
    -----
    ResolutionWarning, UnitsWarning
        As `roll`.

    Examples
    --------
    >>> force = bem3d.rolling_force(np.zeros((32, 32)), spacing=1e-4, radius=0.5, modulus=2e11, approach=1e-6)
    >>> force.shape
    (32,)
    """
    rolled = roll(height, spacing=spacing, radius=radius, modulus=modulus, approach=approach, tolerance=tolerance)
    return rolled.force.copy()


def _wide_enough(track: Track, approach: float) -> None:
    """Refuse a strip that cannot hold the contact of the smooth wheel."""
    (nx, ny), (dx, dy) = track.height.shape, track.steps
    length, width = (2 * semi_axis for semi_axis in track.smooth.semi_axes(approach))
    if nx * dx <= length:
        raise ValueError(f"height must be longer than the contact, {length:.6g} m, got a track of {nx * dx:.6g} m")
    if ny * dy <= width:
        raise ValueError(f"height must be wider than the contact, {width:.6g} m, got a strip of {ny * dy:.6g} m")
