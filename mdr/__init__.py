"""Contact as a one-dimensional foundation of independent springs: the method of dimensionality reduction (MDR).

All lengths are in metres, forces in newtons; ``modulus`` is always the contact modulus E*. Examples assume
``import mdr`` and ``import numpy as np``.
"""

import sys
from typing import TYPE_CHECKING

from mdr.diagnostics import LinearityWarning, SpringContactWarning, SpringResolutionWarning, SpringUnitsWarning
from mdr.foundation import LoadCurve, LoadPoint, load_curve, stiffness_under
from mdr.profile import rough_profile, rough_profiles
from mdr.rolling import RollingTrack, roll, rolling_force
from mdr.rolling_ensemble import RollingEnsemble
from mdr.rolling_spectrum import rolling_spectrum
from mdr.rolling_surface import roll_surface
from mdr.spectrum import SelfAffine, geike, inverse_geike, line_trace
from mdr.sphere import SphereContact, press_sphere, sphere_profile

# names of 0.1, for one release
ContactWarning, ResolutionWarning, UnitsWarning = SpringContactWarning, SpringResolutionWarning, SpringUnitsWarning
Rolling, Wheels = RollingTrack, RollingEnsemble

__all__ = [
    "ContactWarning",
    "LinearityWarning",
    "LoadCurve",
    "LoadPoint",
    "ResolutionWarning",
    "Rolling",
    "RollingEnsemble",
    "RollingTrack",
    "SelfAffine",
    "SphereContact",
    "SpringContactWarning",
    "SpringResolutionWarning",
    "SpringUnitsWarning",
    "UnitsWarning",
    "Wheels",
    "geike",
    "inverse_geike",
    "line_trace",
    "load_curve",
    "press_sphere",
    "roll",
    "roll_surface",
    "rolling_force",
    "rolling_spectrum",
    "rough_profile",
    "rough_profiles",
    "sphere_profile",
    "stiffness_under",
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
