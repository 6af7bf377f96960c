"""Boundary elements for the frictionless contact of a rough elastic half-space in three dimensions.

All lengths in metres, forces in newtons; ``modulus`` is always the contact modulus E*.
"""

from bem3d.contact import Contact, Status
from bem3d.convergence import ConvergenceError
from bem3d.frozen import FrozenContact, press_frozen
from bem3d.halfspace import HalfSpace
from bem3d.indentation import indent
from bem3d.plain import solve_plain
from bem3d.solver import solve
from bem3d.surface import rough_surface

__all__ = [
    "Contact",
    "ConvergenceError",
    "FrozenContact",
    "HalfSpace",
    "Status",
    "indent",
    "press_frozen",
    "rough_surface",
    "solve",
    "solve_plain",
]
