"""Fig. 14.1: rough square punches under equal forces, by both methods; `fractal_punch_evidence.py` reads the result."""

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation import closed_forms
from validation.ensemble import SERIAL, Engine, Outcome, generator

FloatArray = NDArray[np.float64]

# the spawn keys under which each kind of roughness draws
PROFILES, SURFACES = 1, 2
# stiffness, area and approach of a solve that did not converge
LOST = (np.nan, np.nan, np.nan)


@dataclass(frozen=True, kw_only=True)
class FractalPunch:
    """A rigid square punch of side L, self-affine from q_min = 2 pi / L to four cells a wave, no roll-off.

    Everything is normalised alike on both sides, in units of L = E* = 1: Fbar = F / (E* h L), kbar = k / (E* L),
    with h the rms height, which each realisation has exactly.

    hursts; cells: on a side; surfaces, profiles: realisations; decades: of Fbar; per_decade: force levels in one;
    reported: forces at which numbers are compared; refined: surfaces solved again on cells half as wide;
    points: springs of a profile; height: h / L; tolerance: residual of the solver; seed: zero or positive.
    """

    hursts: tuple[float, ...] = (0.4, 0.7, 1.0)
    cells: int = 128
    surfaces: int = 24
    profiles: int = 200
    decades: tuple[int, int] = (-2, 1)
    per_decade: int = 3
    reported: tuple[float, ...] = (0.01, 0.1, 1.0, 10 ** (1 / 3), 10.0)
    refined: int = 4
    points: int = 2048
    height: float = 1e-3
    tolerance: float = 1e-5
    seed: int = 14

    def __post_init__(self) -> None:
        for force in self.reported:
            if not np.isclose(force, self.forces).any():
                raise ValueError(f"reported must be among the forces {self.forces}, got {force}")

    @property
    def forces(self) -> tuple[float, ...]:
        """Levels of Fbar, ascending."""
        first, last = self.decades
        return tuple(10.0 ** (first + i / self.per_decade) for i in range((last - first) * self.per_decade + 1))

    def spectrum(self, hurst: float) -> mdr.SelfAffine:
        """The band is the same on every grid and in both methods."""
        return mdr.SelfAffine(hurst=hurst, q_min=2 * np.pi, q_max=self.cells // 4 * 2 * np.pi, rms=self.height)


@dataclass(frozen=True, kw_only=True)
class Surface:
    """One rough punch on one grid, pressed with several forces."""

    case: FractalPunch
    hurst: float
    realisation: int
    cells: int
    forces: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class Profiles:
    """All rough profiles of one Hurst exponent on one number of springs, in a 1D model of length L_1D."""

    case: FractalPunch
    hurst: float
    points: int
    length: float


@dataclass(frozen=True)
class Ensemble:
    """Outcomes for one Hurst exponent: rows of their arrays are realisations, columns are forces.

    bem, mdr: at all forces; refined: the first surfaces on cells half as wide, at the reported forces;
    coarse, long: springs twice as wide, and a 1D model of length 1.1523 L.
    """

    hurst: float
    bem: Outcome
    refined: Outcome
    mdr: Outcome
    coarse: Outcome
    long: Outcome


@dataclass(frozen=True)
class FractalPunchResult:
    """One ensemble a Hurst exponent, and which solves did not converge."""

    case: FractalPunch
    ensembles: list[Ensemble]
    unconverged: tuple[str, ...]


def run(case: FractalPunch, engine: Engine = SERIAL) -> FractalPunchResult:
    """Press all surfaces and all profiles with equal forces."""
    surfaces = [
        Surface(case=case, hurst=hurst, realisation=i, cells=case.cells, forces=case.forces)
        for hurst in case.hursts
        for i in range(case.surfaces)
    ]
    refined = [
        Surface(case=case, hurst=hurst, realisation=i, cells=2 * case.cells, forces=case.reported)
        for hurst in case.hursts
        for i in range(case.refined)
    ]
    long = closed_forms.SQUARE_PUNCH
    profiles = [
        Profiles(case=case, hurst=hurst, points=points, length=length)
        for hurst in case.hursts
        for points, length in ((case.points, 1.0), (case.points // 2, 1.0), (case.points, long))
    ]
    bem, fine = engine.map(press_surface, surfaces), engine.map(press_surface, refined)
    springs = engine.map(press_profiles, profiles)
    ensembles = []
    for h, hurst in enumerate(case.hursts):
        mine = bem[h * case.surfaces : (h + 1) * case.surfaces]
        finer = fine[h * case.refined : (h + 1) * case.refined]
        same, coarse, longer = springs[3 * h : 3 * h + 3]
        ensembles.append(
            Ensemble(hurst=hurst, bem=_stacked(mine), refined=_stacked(finer), mdr=same, coarse=coarse, long=longer)
        )
    unconverged = tuple(
        f"surface {s.realisation}, H = {s.hurst:g}, {s.cells}² cells, Fbar = {force:.3g}: residual {residual:.2g}"
        for s, o in zip(surfaces + refined, bem + fine, strict=True)
        for force, residual in zip(s.forces, o["residual"], strict=True)
        if not residual <= case.tolerance
    )
    return FractalPunchResult(case, ensembles, unconverged)


def press_surface(surface: Surface) -> Outcome:
    """Boundary elements: stiffness and true contact area at each force, each contact starting from the last."""
    case, cells = surface.case, surface.cells
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)
    height = bem3d.rough_surface(
        case.spectrum(surface.hurst).c2d,
        shape=half_space.shape,
        spacing=half_space.spacing,
        rng=generator(case.seed, SURFACES, _key(surface.hurst), surface.realisation),
        rms=case.height,
    )
    path = bem3d.indent(
        half_space,
        -height,
        forces=case.height * np.array(surface.forces),
        stiffness=True,
        tolerance=case.tolerance,
        raise_on_failure=False,
    )
    rows = []
    with warnings.catch_warnings():
        # the punch ends where its grid does, and the figure marks what stands on few cells
        warnings.simplefilter("ignore", bem3d.ContactWarning)
        for contact in path:
            found = (contact.stiffness(), contact.area, contact.approach) if contact.converged else LOST
            rows.append((*found, contact.residual))
    return dict(zip(("stiffness", "area", "approach", "residual"), np.array(rows).T, strict=True))


def press_profiles(profiles: Profiles) -> Outcome:
    """Springs: stiffness and contact fraction of every profile at each force, one sort a profile."""
    case = profiles.case
    c1d = case.spectrum(profiles.hurst).c1d
    force = case.height * np.array(case.forces)
    stiffness, approach = np.empty((2, case.profiles, force.size))
    for i in range(case.profiles):
        rng = generator(case.seed, PROFILES, _key(profiles.hurst), i)
        height = mdr.rough_profile(c1d, length=1.0, points=profiles.points, rng=rng, rms=case.height)
        points = mdr.load_curve(height, length=profiles.length, modulus=1.0).at_force(force)
        stiffness[i], approach[i] = points.stiffness, points.approach
    return {"stiffness": stiffness, "area": stiffness / profiles.length, "approach": approach}


def _stacked(outcomes: list[Outcome]) -> Outcome:
    """One row a realisation."""
    return {name: np.array([outcome[name] for outcome in outcomes]) for name in outcomes[0]}


def _key(hurst: float) -> int:
    """Address of a Hurst exponent, so that adding one leaves the others their random numbers."""
    return round(1000 * hurst)
