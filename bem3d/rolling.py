"""A rigid sphere rolled over a rough strip, quasi-statically."""

from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bem3d.checks import FloatArray, count, positive
from bem3d.convergence import ConvergenceError
from bem3d.diagnostics import warn
from bem3d.read_only import ReadOnly
from bem3d.rolling_contact import RollingContact, hertz_approach
from bem3d.rolling_frame import Track


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


def _wide_enough(track: Track, approach: float) -> None:
    """Refuse a strip that cannot hold the contact of the smooth sphere."""
    diameter = 2 * float(np.sqrt(track.radius * approach))
    (nx, ny), (dx, dy) = track.height.shape, track.steps
    if nx * dx <= diameter:
        raise ValueError(f"height must be longer than the contact, {diameter:.6g} m, got a track of {nx * dx:.6g} m")
    if ny * dy <= diameter:
        raise ValueError(f"height must be wider than the contact, {diameter:.6g} m, got a strip of {ny * dy:.6g} m")
