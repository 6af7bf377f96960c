"""What is pressed, by either method: one sort of springs, or one solve of boundary elements on a grid."""

import math
from collections.abc import Callable
from typing import Protocol

import bem3d
import mdr
from validation.engine.engine import FloatArray
from validation.simulation.method import Prepared, Resolution, Result, Solve, Values

MOST_ITERATIONS = 5000
"""Of Polonsky and Keer's method."""
FIXED_AREA_RESIDUAL = 1e-4
"""Residual of a fixed contact area, whose stiffness is good to some tens of times its square."""


class PressedScene(Protocol):
    """A body that is pressed onto a half-space on a grid, with an image on springs, E* = 1."""

    def load(self, cells: int) -> dict[str, float]:
        """The force or the approach that is prescribed, by its name."""

    def half_space(self, cells: int) -> bem3d.HalfSpace: ...

    def gap(self, cells: int, realisation: int) -> FloatArray:
        """Undeformed separation."""

    def finish(self, contact: bem3d.Contact) -> bem3d.FixedContactArea | None:
        """What is solved beside the contact, on the clock."""

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values: ...

    def profile(self, springs: float, realisation: int) -> tuple[FloatArray, float]:
        """Heights and length of the foundation. Raises ValueError where there is no image in one dimension."""

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values: ...


def press_on_springs(scene: PressedScene, resolution: Resolution) -> Prepared:
    """The foundation: one sort. Raises ValueError for waves that springs do not resolve."""
    scene.profile(resolution.size, 0)

    def draw(realisation: int) -> Solve:
        height, length = scene.profile(resolution.size, realisation)

        def run() -> mdr.LoadPoint[float]:
            curve = mdr.load_curve(height, length=length, modulus=1.0)
            load = scene.load(height.size)
            return curve.at_force(load["force"]) if "force" in load else curve.at_approach(load["approach"])

        return Solve(run, lambda point: Result(scene.read_springs(point), height.size))

    return draw


def press_on_grid(
    scene: PressedScene, resolution: Resolution, solver: Callable[..., bem3d.Contact] = bem3d.solve
) -> Prepared:
    """Boundary elements, from a cold start; a first solve makes plans, coarser grids and windows."""
    cells = round(resolution.size)
    half_space = scene.half_space(cells)

    def draw(realisation: int) -> Solve:
        gap = scene.gap(cells, realisation)

        def run() -> tuple[bem3d.Contact, bem3d.FixedContactArea | None]:
            contact = solver(half_space, gap, **scene.load(cells), tolerance=resolution.residual)
            return contact, scene.finish(contact)

        return Solve(run, lambda found: Result(scene.read(*found), cell_applications(*found)))

    draw(0).run()
    return draw


def cell_applications(contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> float:
    """Cells times operator applications, as if each were on the whole of its grid."""
    applications = contact.operator_applications + (fixed.operator_applications if fixed else 0)
    coarse = sum(math.prod(shape) * count for shape, count in contact.coarse_applications)
    return float(contact.pressure.size * applications + coarse)
