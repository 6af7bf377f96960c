"""The input spectrum of springs for rolling: Geike's, the line trace, or the rolling-equivalent one."""

import math
import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import mdr
from validation.cases.rolling.force_spectrum import RollingSettings
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.engine.random_numbers import random_generator
from validation.simulation.rolling_strip import TRACKS, roll_strips, roll_tracks, strip_levels
from validation.simulation.rough_punch import (
    PunchRoughness,
    Surface,
    describe_failures,
    press_surface,
    require_converged,
    stacked,
)
from validation.simulation.track_spectrum import (
    INPUT_SPECTRA,
    InputSpectrum,
    PiecewisePowerLaw,
    TrackSpectrum,
    self_affine,
)

RollingKey = tuple[str, float]
"""Name of a spectrum, and h/d."""


@dataclass(frozen=True, kw_only=True)
class RollingInput(RollingSettings):
    """Linear theory of springs by input spectrum, over many surfaces; springs and boundary elements over some of them.

    punch_cells, surfaces, profiles: of the punches of Fig. 14.1, H = 0.7. The narrow band ends before `last`.
    """

    heights: tuple[float, ...] = (0.03, 0.3)
    strips: int = 4
    tracks: int = 40
    punch_cells: int = 64
    surfaces: int = 12
    profiles: int = 200

    @property
    def derived_for(self) -> dict[str, PiecewisePowerLaw]:
        """Power laws, for which the rolling-equivalent spectrum is Geike's times a factor far from both ends."""
        return {f"H = {hurst:g}": self_affine(hurst, 1.0, self.last) for hurst in (0.4, 0.7, 1.0)}

    @property
    def others(self) -> dict[str, PiecewisePowerLaw]:
        return {
            "roll-off": PiecewisePowerLaw(edges=(0.25, 2.0, self.last), exponents=(0.0, 3.4)),
            "two power laws": PiecewisePowerLaw(edges=(1.0, 4.0, self.last), exponents=(2.4, 4.0)),
            "narrow band": PiecewisePowerLaw(edges=(4.0, 6.0), exponents=(0.0,)),
        }

    @property
    def spectra(self) -> dict[str, PiecewisePowerLaw]:
        return {**self.derived_for, **self.others}

    @property
    def rolled(self) -> dict[str, PiecewisePowerLaw]:
        return {"H = 0.7": self.derived_for["H = 0.7"], **self.others}

    @property
    def forces(self) -> tuple[float, ...]:
        return (0.03, 0.1, 0.3)

    @property
    def punch(self) -> PunchRoughness:
        return PunchRoughness(hurst=0.7, waves=(1, self.punch_cells // 4), seed=self.seed)

    def inside(self, spectrum: PiecewisePowerLaw) -> NDArray[np.bool_]:
        """Which one-third octaves lie in the band of a spectrum."""
        edges = np.array(self.bands.edges)
        return np.asarray((edges[1:] > spectrum.edges[0] * 1.001) & (edges[:-1] < spectrum.edges[-1] * 0.999))

    def below_the_end(self, spectrum: PiecewisePowerLaw) -> list[int]:
        """Indices of the one-third octaves that begin below the end of a spectrum."""
        return [i for i, low in enumerate(self.bands.edges[:-1]) if low < spectrum.edges[-1] * 0.999]


@dataclass(frozen=True, kw_only=True)
class PunchProfiles:
    """Profiles of the punches of Fig. 14.1 with an input spectrum, pressed at all forces."""

    case: RollingInput
    input_spectrum: InputSpectrum


@dataclass(frozen=True)
class RollingInputResult:
    """Levels of boundary elements, and of springs by input spectrum; stiffness of punches, and of their profiles."""

    case: RollingInput
    bem: dict[RollingKey, Outcome]
    mdr: dict[tuple[str, float, InputSpectrum], Outcome]
    punches: Outcome
    profiles: dict[InputSpectrum, Outcome]
    unconverged: tuple[str, ...]


def press_input_profiles(profiles: PunchProfiles) -> Outcome:
    """k / (E* L) of each profile at each force; height: rms of the profiles over that of the surface."""
    case, punch = profiles.case, profiles.case.punch
    spectrum = PiecewisePowerLaw(edges=(2 * math.pi, math.pi / 2 * case.punch_cells), exponents=(2 * punch.hurst + 2,))
    q = 2 * np.pi * np.arange(1.0, case.punch_cells // 4 + 1)
    # the side of the punch for the diameter of the contact
    c1d = TrackSpectrum(spectrum, profiles.input_spectrum, contact_radius=0.5)
    height = math.sqrt(float(c1d(q).sum() / TrackSpectrum(spectrum, "geike")(q).sum()))
    points, rms = 16 * case.punch_cells, punch.height * height
    curves = [
        mdr.load_curve(
            mdr.rough_profile(c1d, length=1.0, points=points, rng=random_generator(case.seed, TRACKS, i), rms=rms),
            length=1.0,
            modulus=1.0,
        )
        for i in range(case.profiles)
    ]
    forces = punch.height * np.array(case.forces)
    with warnings.catch_warnings():
        # the lightest loads stand on few springs
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        stiffness = [curve.at_force(forces).stiffness for curve in curves]
    return {"stiffness": np.array(stiffness), "height": np.array(height)}


def run(case: RollingInput, engine: Engine = SERIAL) -> RollingInputResult:
    """Roll over the spectra by both methods; press the punches.

    Raises NotConvergedError where fewer than three strips of a spectrum and height, or surfaces at a force, converge.
    """
    scenes = {(name, h): case.rough_strip(spectrum, h) for name, spectrum in case.rolled.items() for h in case.heights}
    groups = {
        (name, h): scene.strips(case.cells, min(1e-5, 1e-4 * h), case.strips) for (name, h), scene in scenes.items()
    }
    strips, unconverged = roll_strips(groups, engine)
    tracks = {(*key, rule): case.tracks_on(scene, rule) for key, scene in scenes.items() for rule in INPUT_SPECTRA}
    on_springs = engine.map(roll_tracks, list(tracks.values()))
    surfaces = [
        Surface(roughness=case.punch, realisation=i, cells=case.punch_cells, forces=case.forces, tolerance=1e-4)
        for i in range(case.surfaces)
    ]
    pressed = engine.map(press_surface, surfaces)
    profiles = engine.map(
        press_input_profiles, [PunchProfiles(case=case, input_spectrum=rule) for rule in INPUT_SPECTRA]
    )
    failures = describe_failures(surfaces, pressed)
    require_converged([stacked(pressed)], failures)
    return RollingInputResult(
        case,
        {key: strip_levels(group, 1 / case.cells, case.bands) for key, group in strips.items()},
        dict(zip(tracks, on_springs, strict=True)),
        stacked(pressed),
        dict(zip(INPUT_SPECTRA, profiles, strict=True)),
        (*unconverged, *failures),
    )
