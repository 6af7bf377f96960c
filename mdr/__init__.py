"""The method of dimensionality reduction: contact as a one-dimensional foundation of independent springs.

All lengths in metres, forces in newtons; ``modulus`` is always the contact modulus E*.
"""

from mdr.diagnostics import LinearityWarning, SpringContactWarning, SpringResolutionWarning, SpringUnitsWarning
from mdr.foundation import (
    LoadCurve,
    LoadPoint,
    SphereContact,
    load_curve,
    press_sphere,
    stiffness_under,
)
from mdr.profile import rough_profile, rough_profiles, sphere_profile
from mdr.rolling import RollingTrack, roll, rolling_force
from mdr.rolling_ensemble import RollingEnsemble
from mdr.rolling_spectrum import rolling_spectrum
from mdr.spectrum import SelfAffine, geike, inverse_geike, line_trace

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
    "rolling_force",
    "rolling_spectrum",
    "rough_profile",
    "rough_profiles",
    "sphere_profile",
    "stiffness_under",
]
