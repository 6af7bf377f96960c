"""A measured profile across the track in place of a radius: heights over the columns of the strip."""

import numpy as np
from numpy.typing import ArrayLike

from bem3d.checks import FloatArray, finite_row


def checked_profile(values: ArrayLike, columns: int, step: float) -> FloatArray:
    """Heights of a profile [m], one a column `step` apart, zero at the highest point.

    Raises ValueError for another length, for a highest point that is not zero to within what a column may miss of a
    top, and where the profile does not fall from it to both sides, by half of the columns or more.
    """
    z = finite_row("transverse_profile", values, columns)
    top, highest = int(z.argmax()), float(z.max())
    if not 0 < top < columns - 1:
        raise ValueError(f"transverse_profile must be highest inside of the strip, got its top in column {top}")
    missed = highest - min(z[top - 1], z[top + 1])
    if not -missed <= highest <= 0:
        raise ValueError(f"transverse_profile must be zero at its highest point, got {highest:.6g} m")
    if not np.isfinite(equivalent_radius(z, step)):
        raise ValueError("transverse_profile must fall from its highest point to both sides, got a flat one")
    return z


def top_column(z: FloatArray) -> float:
    """Where a profile is highest; between two columns where both are [columns]."""
    return float(np.flatnonzero(z == z.max()).mean())


def equivalent_radius(z: FloatArray, step: float) -> float:
    """The median of -y^2 / (2 z) over all columns, y from the top: R of a parabola, about that of others [m].

    With it the contact without roughness is expected, from which a solve begins.
    """
    y = (np.arange(z.size) - top_column(z)) * step
    beside = y != 0
    with np.errstate(divide="ignore"):
        return float(np.median(-(y[beside] ** 2) / (2 * z[beside])))
