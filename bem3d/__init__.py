"""Boundary elements for the frictionless contact of a rough elastic half-space in three dimensions.

All lengths are in metres, forces in newtons; ``modulus`` is always the contact modulus E*. Examples assume
``import bem3d`` and ``import numpy as np``.
"""

import sys
from typing import TYPE_CHECKING

from bem3d.contact import Contact, Status, residual
from bem3d.convergence import ConvergenceError
from bem3d.diagnostics import ContactWarning, EdgeWarning, ResolutionWarning, UnitsWarning
from bem3d.few_cells import FewCellsContact, TooManyCellsError, indent_few_cells
from bem3d.halfspace import HalfSpace
from bem3d.indentation import LoadPath, indent
from bem3d.polonsky_keer import solve_polonsky_keer
from bem3d.problem import Problem
from bem3d.rolling import Rolling, roll, rolling_force
from bem3d.rolling_contact import RollingContact, WheelContact
from bem3d.rolling_frame import Track
from bem3d.solver import solve
from bem3d.surface import rough_surface
from bem3d.tangent_stiffness import FixedContactArea, solve_fixed_area

# names of 0.1, for one release
FrozenContact, press_frozen, solve_plain = FixedContactArea, solve_fixed_area, solve_polonsky_keer

__all__ = [
    "Contact",
    "ContactWarning",
    "ConvergenceError",
    "EdgeWarning",
    "FewCellsContact",
    "FixedContactArea",
    "FrozenContact",
    "HalfSpace",
    "LoadPath",
    "Problem",
    "ResolutionWarning",
    "Rolling",
    "RollingContact",
    "Status",
    "TooManyCellsError",
    "Track",
    "UnitsWarning",
    "WheelContact",
    "indent",
    "indent_few_cells",
    "press_frozen",
    "residual",
    "roll",
    "rolling_force",
    "rough_surface",
    "solve",
    "solve_fixed_area",
    "solve_plain",
    "solve_polonsky_keer",
]


def __dir__() -> list[str]:
    """The public names."""
    return sorted([*__all__, "__version__"])


if TYPE_CHECKING:
    __version__: str
else:

    def __getattr__(name: str) -> str:
        """The version, from what pip has installed; read on first use, since that takes longer than it is worth."""
        if name == "__version__":
            from importlib import metadata

            return metadata.version("mdr-validation")
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}", name=name, obj=sys.modules[__name__])
