"""Boundary elements for the frictionless contact of a rough elastic half-space in three dimensions.

All lengths in metres, forces in newtons; ``modulus`` is always the contact modulus E*.
"""

from bem3d.contact import Contact, Status, residual
from bem3d.convergence import ConvergenceError
from bem3d.doubts import ContactWarning, EdgeWarning, ResolutionWarning, UnitsWarning
from bem3d.frozen import FrozenContact, press_frozen
from bem3d.halfspace import HalfSpace
from bem3d.indentation import indent
from bem3d.plain import solve_plain
from bem3d.problem import Problem
from bem3d.rolling import Rolling, RollingContact, WheelContact, roll, rolling_force
from bem3d.solver import solve
from bem3d.surface import rough_surface
from bem3d.track import Track

__all__ = [
    "Contact",
    "ContactWarning",
    "ConvergenceError",
    "EdgeWarning",
    "FrozenContact",
    "HalfSpace",
    "Problem",
    "ResolutionWarning",
    "Rolling",
    "RollingContact",
    "Status",
    "Track",
    "UnitsWarning",
    "WheelContact",
    "indent",
    "press_frozen",
    "residual",
    "roll",
    "rolling_force",
    "rough_surface",
    "solve",
    "solve_plain",
]
