"""Stiffness along a track at constant load, by both methods, beside that of the punches of Fig. 14.1."""

import math
import warnings
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation.analysis.spectra import Bands, levels, waves
from validation.engine.convergence import FEWEST, NotConvergedError, require_realisations
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rolling_strip import HERTZ, RoughStrip, Strip, Tracks, crop_to_reach
from validation.simulation.rough_punch import (
    Profiles,
    PunchRoughness,
    Surface,
    describe_failures,
    press_profiles,
    press_surface,
    require_converged,
    stacked,
)
from validation.simulation.track_spectrum import INPUT_SPECTRA, InputSpectrum, PiecewisePowerLaw, self_affine

FloatArray = NDArray[np.float64]
SMOOTH = 2.0
"""Stiffness 2 E* a of the smooth wheel, a = E* = 1."""
LOADS_BELOW = 3
"""A punch is pressed at Fbar / 3 first: each contact starts from the last."""


@dataclass(frozen=True, kw_only=True)
class TrackStiffness:
    """A wheel under the force F of a smooth one with the approach d, over the roughness of the punches of Fig. 14.1.

    forces: Fbar = F / (E* h L) with L = 2 a, which is 2 / 3 over h/d; hurst; waves: the shortest on L, of which the
    longest is one; length, width: of a surface over a; cells: to a contact radius; strips, refined: surfaces, and how
    many are rolled again on cells half as wide; tracks, springs: realisations, and springs to a radius; surfaces,
    profiles: of punches; seed.
    """

    forces: tuple[float, ...] = (0.3, 1.0, 3.0)
    hurst: float = 0.7
    waves: int = 4
    length: int = 16
    width: int = 8
    cells: int = 8
    strips: int = 6
    refined: int = 3
    tracks: int = 40
    springs: int = 64
    surfaces: int = 30
    profiles: int = 400
    seed: int = 153

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips, refined=self.refined, surfaces=self.surfaces)

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        return self_affine(self.hurst, math.pi, self.waves * math.pi)

    @property
    def bands(self) -> Bands:
        """One-third octaves below the roughness and in it."""
        return Bands.around(math.pi, 0.5 * math.pi, self.waves * math.pi).on(self.length)

    @property
    def punch(self) -> PunchRoughness:
        return PunchRoughness(hurst=self.hurst, waves=(1, self.waves), seed=self.seed)

    def height(self, force: float) -> float:
        """h/d."""
        return HERTZ / 2 / force

    def rough_strip(self, force: float) -> RoughStrip:
        return RoughStrip(
            spectrum=self.spectrum, height=self.height(force), length=self.length, width=self.width, seed=self.seed
        )

    def strips_of(self, force: float, cells: int) -> list["LoadedStrip"]:
        strips = self.rough_strip(force).strips(cells, 3e-5, self.strips if cells == self.cells else self.refined)
        return [LoadedStrip(strip=strip, bands=self.bands) for strip in strips]

    def tracks_of(self, force: float, rule: InputSpectrum) -> Tracks:
        return Tracks(
            scene=self.rough_strip(force),
            input_spectrum=rule,
            realisations=self.tracks,
            springs=self.springs,
            bands=self.bands,
        )


@dataclass(frozen=True, kw_only=True)
class LoadedStrip:
    """One rough strip under a wheel of constant load."""

    strip: Strip
    bands: Bands


@dataclass(frozen=True)
class TrackStiffnessResult:
    """Stiffness over 2 E* a, by Fbar: `moments` along strips, along those again on finer cells, along tracks by input
    spectrum; k / (E* L) of punches and of profiles."""

    case: TrackStiffness
    bem: dict[float, Outcome]
    refined: dict[float, Outcome]
    springs: dict[tuple[float, InputSpectrum], Outcome]
    punches: dict[float, FloatArray]
    profiles: dict[float, FloatArray]
    unconverged: tuple[str, ...]


def roll_loaded_strip(problem: LoadedStrip) -> Outcome:
    """Boundary elements: `moments` of k = dF/dd at a constant contact area, over 2 E* a; failed: positions."""
    strip, spacing = problem.strip, 1 / problem.strip.cells
    height = np.ascontiguousarray(crop_to_reach(strip.surface(), spacing))
    wheel = bem3d.RollingContact(
        bem3d.Track(height=height, spacing=spacing, radius=1.0, modulus=1.0), tolerance=strip.tolerance
    )
    stiffness = np.array([tangent_stiffness(wheel, position) for position in range(len(height))]) / SMOOTH
    return {**moments(stiffness, spacing, problem.bands), "failed": np.array(float(np.isnan(stiffness).sum()))}


def tangent_stiffness(wheel: bem3d.RollingContact, position: int) -> float:
    """Of the contact under the load of Hertz over one cell of the track; NaN where it does not converge."""
    if not wheel.carry(position, HERTZ).converged:
        return math.nan
    _, _, pressure = wheel.pressure()
    body = half_space(pressure.shape, wheel.track.spacing)
    return bem3d.solve_fixed_area(body, pressure > 0, tolerance=1e-3).stiffness


@cache
def half_space(shape: tuple[int, int], spacing: float) -> bem3d.HalfSpace:
    """Frames along a track have few shapes."""
    return bem3d.HalfSpace(shape=shape, spacing=spacing, modulus=1.0)


def roll_loaded_tracks(tracks: Tracks) -> Outcome:
    """One-sided springs: `moments` of the stiffness along each track."""
    spacing = 1 / tracks.springs
    with warnings.catch_warnings():
        # the smooth contact has springs enough, which is what the warning is about
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        rolled = [mdr.roll(h, spacing=spacing, radius=1.0, modulus=1.0, force=HERTZ) for h in tracks.heights()]
    return moments(np.array([one.stiffness for one in rolled]) / SMOOTH, spacing, tracks.bands)


def moments(stiffness: FloatArray, spacing: float, bands: Bands) -> Outcome:
    """Mean and variance along a track, and the level int C_k dq in each band; along the last axis."""
    return {
        "mean": np.asarray(stiffness.mean(axis=-1)),
        "variance": np.asarray(stiffness.var(axis=-1)),
        "level": levels(waves(stiffness, spacing=spacing), bands),
    }


def run(case: TrackStiffness, engine: Engine = SERIAL) -> TrackStiffnessResult:
    """Roll and press. Raises NotConvergedError where fewer than three strips or punches converge at a force."""
    groups = {(f, cells): case.strips_of(f, cells) for f in case.forces for cells in (case.cells, 2 * case.cells)}
    strips = engine.map_groups(roll_loaded_strip, groups)
    lost = tuple(
        f"strip {i}, Fbar = {force:g}, {cells} cells to a radius: {int(one['failed'])} positions"
        for (force, cells), found in strips.items()
        for i, one in enumerate(found)
        if one["failed"]
    )
    for key, found in strips.items():
        if sum(not one["failed"] for one in found) < FEWEST:
            raise NotConvergedError(f"fewer than {FEWEST} strips of {key} converged", lost)
    along = {key: {name: np.array([one[name] for one in found]) for name in found[0]} for key, found in strips.items()}
    tracks = {(force, rule): case.tracks_of(force, rule) for force in case.forces for rule in INPUT_SPECTRA}
    loads = {force: (force / LOADS_BELOW, force) for force in case.forces}
    faces = [
        Surface(roughness=case.punch, realisation=i, cells=8 * case.waves, forces=loads[force], tolerance=1e-4)
        for force in case.forces
        for i in range(case.surfaces)
    ]
    pressed = engine.map(press_surface, faces)
    failures = describe_failures(faces, pressed)
    punches = np.array([one["stiffness"][-1] for one in pressed]).reshape(len(case.forces), -1)
    require_converged([stacked(pressed)], failures)
    profiles = Profiles(
        roughness=case.punch, realisations=case.profiles, points=8 * case.springs, length=1.0, forces=case.forces
    )
    on_springs = press_profiles(profiles)["stiffness"].T
    return TrackStiffnessResult(
        case,
        {force: along[force, case.cells] for force in case.forces},
        {force: along[force, 2 * case.cells] for force in case.forces},
        dict(zip(tracks, engine.map(roll_loaded_tracks, list(tracks.values())), strict=True)),
        dict(zip(case.forces, punches, strict=True)),
        dict(zip(case.forces, on_springs, strict=True)),
        (*lost, *failures),
    )
