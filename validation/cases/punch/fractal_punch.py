"""Fig. 14.1: rough square punches under equal forces, by both methods; `fractal_punch_evidence.py` reads the result."""

from dataclasses import dataclass

from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.rough_punch import (
    Profiles,
    PunchRoughness,
    Surface,
    describe_failures,
    force_levels,
    press_profiles,
    press_surface,
    stacked,
)
from validation.theory import closed_forms


@dataclass(frozen=True, kw_only=True)
class FractalPunch:
    """A rigid square punch of side L, self-affine from q_min = 2 pi / L to four cells a wave, no roll-off.

    Everything is normalised alike on both sides, in units of L = E* = 1: Fbar = F / (E* h L), kbar = k / (E* L),
    with h the rms height, which each realisation has exactly.

    hursts; cells: on a side, even; surfaces, profiles: realisations; decades: powers of ten of the first and the last
    Fbar; per_decade: steps of force in one; refined: surfaces pressed again on half and on twice as many cells a side,
    from three to all; light: up to this Fbar, where it costs little and tells most, all of them are;
    refined_per_decade: steps of force in one there, a divisor of per_decade; points: springs of a profile; height:
    h / L; tolerance: residual of the solver; seed: zero or positive.
    """

    hursts: tuple[float, ...] = (0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
    cells: int = 128
    surfaces: int = 20
    profiles: int = 200
    decades: tuple[int, int] = (-3, 1)
    per_decade: int = 3
    refined: int = 6
    light: float = 0.1
    refined_per_decade: int = 1
    points: int = 2048
    height: float = 1e-3
    tolerance: float = 1e-4
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
    def forces(self) -> tuple[float, ...]:
        """Levels of Fbar, ascending."""
        return force_levels(self.decades, self.per_decade)

    @property
    def refined_forces(self) -> tuple[float, ...]:
        """Those of them at which grids are compared."""
        return self.forces[:: self.per_decade // self.refined_per_decade]

    @property
    def grids(self) -> tuple[int, int, int]:
        """Cells on a side, coarse to fine; the middle one is that of all surfaces."""
        return self.cells // 2, self.cells, 2 * self.cells

    def roughness(self, hurst: float) -> PunchRoughness:
        """The band is the same on every grid and in both methods."""
        return PunchRoughness(hurst=hurst, waves=(1, self.cells // 4), height=self.height, seed=self.seed)

    def surface(self, hurst: float, realisation: int, cells: int) -> Surface:
        """One of the solves: at all forces on the middle grid, at fewer on the others."""
        forces = self.forces if cells == self.cells else self.refined_forces
        if cells != self.cells and realisation >= self.refined:
            forces = tuple(force for force in forces if force <= self.light * (1 + 1e-9))
        return Surface(
            roughness=self.roughness(hurst),
            realisation=realisation,
            cells=cells,
            forces=forces,
            tolerance=self.tolerance,
        )

    def springs(self, hurst: float, points: int, length: float) -> Profiles:
        """All profiles of one Hurst exponent, in a 1D model of length L_1D."""
        return Profiles(
            roughness=self.roughness(hurst),
            realisations=self.profiles,
            points=points,
            length=length,
            forces=self.forces,
        )


@dataclass(frozen=True)
class Ensemble:
    """Outcomes for one Hurst exponent: rows of their arrays are realisations, columns are forces.

    bem, mdr: at all forces; coarser, finer: on half and on twice the cells a side, at fewer forces, NaN where they were
    not pressed;
    coarse, long: springs twice as wide, and a 1D model of length 1.1523 L.
    """

    hurst: float
    bem: Outcome
    coarser: Outcome
    finer: Outcome
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
    groups = {
        (hurst, cells): [case.surface(hurst, i, cells) for i in range(case.surfaces)]
        for hurst in case.hursts
        for cells in case.grids
    }
    # without the surfaces that are to be pressed at no force
    surfaces = [surface for group in groups.values() for surface in group if surface.forces]
    outcomes = engine.map(press_surface, surfaces)
    pressed = iter(outcomes)
    bem = {key: stacked([next(pressed) for surface in group if surface.forces]) for key, group in groups.items()}
    models = ((case.points, 1.0), (case.points // 2, 1.0), (case.points, closed_forms.SQUARE_PUNCH))
    springs = iter(
        engine.map(press_profiles, [case.springs(hurst, *model) for hurst in case.hursts for model in models])
    )
    coarser, cells, finer = case.grids
    ensembles = [
        Ensemble(
            hurst,
            bem[hurst, cells],
            bem[hurst, coarser],
            bem[hurst, finer],
            mdr=next(springs),
            coarse=next(springs),
            long=next(springs),
        )
        for hurst in case.hursts
    ]
    return FractalPunchResult(case, ensembles, describe_failures(surfaces, outcomes))
