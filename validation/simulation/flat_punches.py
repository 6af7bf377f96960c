"""A flat square and a flat circle, every cell in contact."""

from dataclasses import dataclass

import numpy as np

import bem3d
from validation.engine.engine import Outcome


@dataclass(frozen=True, kw_only=True)
class FlatPunches:
    """side: L of the square and diameter of the circle [m]; modulus: E* [Pa]; cells: on a side; tolerance: of the
    linear solve."""

    side: float
    modulus: float
    cells: int
    tolerance: float


def press_flat_punches(punches: FlatPunches) -> Outcome:
    """Both pressed by a unit approach: k / (E* L), k / (2 E* a), and the pressure over its mean."""
    side, modulus, cells = punches.side, punches.modulus, punches.cells
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=side / cells, modulus=modulus)
    x = (np.arange(cells) + 0.5) / cells - 0.5
    disc = np.hypot(x[:, np.newaxis], x) < 0.5
    square = bem3d.solve_fixed_area(half_space, np.ones((cells, cells), dtype=bool), tolerance=punches.tolerance)
    circle = bem3d.solve_fixed_area(half_space, disc, tolerance=punches.tolerance)
    radius = np.sqrt(np.count_nonzero(disc) / np.pi) / cells * side
    return {
        "square": np.array(square.stiffness / (modulus * side)),
        "circle": np.array(circle.stiffness / radius / (2 * modulus)),
        "x": x,
        "pressure": square.pressure[cells // 2] / (square.stiffness / side**2),
    }
