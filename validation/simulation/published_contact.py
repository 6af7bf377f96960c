"""The published example of the program CONTACT: one smooth elliptic contact, by boundary elements."""

import math
from dataclasses import dataclass

import numpy as np

import bem3d
from validation.engine.engine import Outcome
from validation.theory.elliptic_contact import EllipticContact, elliptic_contact

APPROACH, PRESSURE = "approach", "largest pressure"
CURVATURES = (0.001015, 0.0004215)
"""Of its gap, A x^2 + B y^2 [1/mm]."""
STRIP = 2.6
"""Length and width of the flat strip over those of the contact."""


@dataclass(frozen=True, kw_only=True)
class PublishedContact:
    """cells: of the grid, to the semi-axis along; tolerance: residual of boundary elements; force [N]."""

    cells: int
    tolerance: float
    force: float = 100e3

    @property
    def modulus(self) -> float:
        """E* = G / (1 - nu) of two equal bodies [Pa]."""
        return 82e9 / (1 - 0.28)

    @property
    def radii(self) -> tuple[float, float]:
        """1 / (2 A) along, 1 / (2 B) across [m]."""
        along, across = (1e-3 / (2 * curvature) for curvature in CURVATURES)
        return along, across

    @property
    def closed(self) -> EllipticContact:
        return elliptic_contact(self.radii, modulus=self.modulus, force=self.force)


def press_ellipse(problem: PublishedContact) -> Outcome:
    """On a flat strip; an odd number of columns puts a cell under the deepest point. Approach [mm], pressure [MPa]."""
    smooth = problem.closed
    spacing = smooth.along / problem.cells
    shape = tuple(2 * round(STRIP / 2 * axis / spacing) + 1 for axis in (2 * smooth.along, 2 * smooth.across))
    track = bem3d.Track(height=np.zeros(shape), spacing=spacing, radius=problem.radii, modulus=problem.modulus)
    wheel = bem3d.RollingContact(track, tolerance=problem.tolerance)
    found = wheel.carry(0, problem.force)
    return {
        APPROACH: np.array(1e3 * found.approach),
        PRESSURE: np.array(1e-6 * wheel.pressure()[2].max() if found.converged else math.nan),
        "failed": np.array(float(not found.converged)),
    }
