"""Fig. 14.1: rough square punches under equal forces, by both methods; `fractal_punch_evidence.py` reads the result."""

from dataclasses import dataclass

from validation.cases.punch.ensembles import PunchEnsembles, press
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rough_punch import BEM, MDR, Profiles, PunchRoughness, Surface
from validation.theory import closed_forms

LONG = "mdr 1.1523 L"
"""The 1D model whose stiffness in full contact is that of the square punch."""


@dataclass(frozen=True, kw_only=True)
class FractalPunch(PunchEnsembles):
    """Self-affine punches from q_min = 2 pi / L to four cells a wave, no roll-off; each has its rms height exactly.

    hursts; refined: surfaces pressed again on half and on twice as many cells a side, from three to all; light: up to
    this Fbar, where a solve is cheap and the scatter large, all of them are; refined_per_decade: steps of force in a
    decade there, a divisor of per_decade. cells: even.
    """

    hursts: tuple[float, ...] = (0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
    surfaces: int = 20
    decades: tuple[int, int] = (-3, 1)
    refined: int = 6
    light: float = 0.1
    refined_per_decade: int = 1
    seed: int = 14

    def __post_init__(self) -> None:
        if self.cells % 2 or self.cells < 8:
            raise ValueError(f"cells must be even and at least 8, got {self.cells}")
        if not self.decades[0] < self.decades[1]:
            raise ValueError(f"decades must be two powers of ten, ascending, got {self.decades}")
        if self.refined_per_decade < 1 or self.per_decade % self.refined_per_decade:
            raise ValueError(f"refined_per_decade must divide {self.per_decade}, got {self.refined_per_decade}")
        if not 3 <= self.refined <= self.surfaces:
            raise ValueError(f"refined must be from 3 to the {self.surfaces} surfaces, got {self.refined}")

    @property
    def refined_forces(self) -> tuple[float, ...]:
        """Those of them at which grids are compared."""
        return self.forces[:: self.per_decade // self.refined_per_decade]

    @property
    def grids(self) -> tuple[int, int, int]:
        """Cells on a side, coarse to fine; the middle one is that of all surfaces."""
        return self.cells // 2, self.cells, 2 * self.cells

    def roughness(self, hurst: float) -> PunchRoughness:
        return self.band(hurst)

    def surface(self, hurst: float, realisation: int, cells: int) -> Surface:
        """One of the solves: at all forces on the middle grid, at fewer on the others."""
        forces = self.forces if cells == self.cells else self.refined_forces
        if cells != self.cells and realisation >= self.refined:
            forces = tuple(force for force in forces if force <= self.light * (1 + 1e-9))
        return self.surface_of(self.roughness(hurst), realisation, cells, forces)

    def springs(self, hurst: float, points: int, length: float) -> Profiles:
        """All profiles of one Hurst exponent, in a 1D model of length L_1D."""
        return self.profiles_of(self.roughness(hurst), points, length)


@dataclass(frozen=True)
class Ensemble:
    """Outcomes for one Hurst exponent: rows of their arrays are realisations, columns are forces.

    bem, mdr: at all forces; coarser, finer: on half and on twice the cells a side, at fewer forces, NaN where they were
    not pressed; coarse, long: springs twice as wide, and a 1D model of length 1.1523 L.
    """

    hurst: float
    bem: Outcome
    coarser: Outcome
    finer: Outcome
    mdr: Outcome
    coarse: Outcome
    long: Outcome

    @property
    def by_method(self) -> dict[str, Outcome]:
        return {BEM: self.bem, MDR: self.mdr, LONG: self.long}


@dataclass(frozen=True)
class FractalPunchResult:
    """One ensemble a Hurst exponent, and which solves did not converge."""

    case: FractalPunch
    ensembles: list[Ensemble]
    unconverged: tuple[str, ...]


def run(case: FractalPunch, engine: Engine = SERIAL) -> FractalPunchResult:
    """Press all surfaces and all profiles with equal forces."""
    grids = dict(zip(("coarser", "bem", "finer"), case.grids, strict=True))
    models = {
        "mdr": (case.points, 1.0),
        "coarse": (case.points // 2, 1.0),
        "long": (case.points, closed_forms.SQUARE_PUNCH),
    }
    # surfaces without a force on a grid are not pressed there
    surfaces = {
        (hurst, grid): [s for i in range(case.surfaces) if (s := case.surface(hurst, i, cells)).forces]
        for hurst in case.hursts
        for grid, cells in grids.items()
    }
    profiles = {(hurst, name): case.springs(hurst, *model) for hurst in case.hursts for name, model in models.items()}
    bem, mdr, unconverged = press(engine, surfaces, profiles)
    found = bem | mdr
    ensembles = [Ensemble(hurst, **{name: found[hurst, name] for name in (*grids, *models)}) for hurst in case.hursts]
    return FractalPunchResult(case, ensembles, unconverged)
