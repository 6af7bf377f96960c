"""Profiles that springs get for rough punches by each input spectrum."""

import math
import warnings
from dataclasses import dataclass

import numpy as np

import mdr
from validation.engine.engine import Outcome
from validation.engine.random_numbers import random_generator
from validation.simulation.rolling_strip import TRACKS
from validation.simulation.rough_punch import PunchRoughness
from validation.simulation.track_spectrum import InputSpectrum, PiecewisePowerLaw, TrackSpectrum


@dataclass(frozen=True, kw_only=True)
class InputProfiles:
    """The first so many profiles of a punch, pressed at all forces. cells: of the surface; forces: F / (E* h L)."""

    punch: PunchRoughness
    cells: int
    input_spectrum: InputSpectrum
    realisations: int
    forces: tuple[float, ...]


def press_input_profiles(profiles: InputProfiles) -> Outcome:
    """k / (E* L) of each profile at each force; height: rms of the profiles over that of the surface."""
    punch, cells = profiles.punch, profiles.cells
    spectrum = PiecewisePowerLaw(edges=(2 * math.pi, math.pi / 2 * cells), exponents=(2 * punch.hurst + 2,))
    q = 2 * np.pi * np.arange(1.0, cells // 4 + 1)
    # the side of the punch for the diameter of the contact
    c1d = TrackSpectrum(spectrum, profiles.input_spectrum, contact_radius=0.5)
    height = math.sqrt(float(c1d(q).sum() / TrackSpectrum(spectrum, "geike")(q).sum()))
    rms = punch.height * height
    curves = [
        mdr.load_curve(
            mdr.rough_profile(c1d, length=1.0, points=16 * cells, rng=random_generator(punch.seed, TRACKS, i), rms=rms),
            length=1.0,
            modulus=1.0,
        )
        for i in range(profiles.realisations)
    ]
    forces = punch.height * np.array(profiles.forces)
    with warnings.catch_warnings():
        # the lightest loads stand on few springs
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        stiffness = [curve.at_force(forces).stiffness for curve in curves]
    return {"stiffness": np.array(stiffness), "height": np.array(height)}
