"""Fig. 14.1: rough square punches under equal forces, by both methods; `fractal_punch_evidence.py` reads the result."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from validation.cases.punch.ensembles import PunchEnsembles, press
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation.light_punch import press_lightly
from validation.simulation.rough_punch import BEM, MDR, Profiles, PunchRoughness, Surface
from validation.theory import closed_forms

LONG = "mdr 1.1523 L"
"""The 1D model whose stiffness in full contact is that of the square punch."""
PAIRS = 4
"""Fewer surfaces on a grid have no error bar worth its name."""


@dataclass(frozen=True, kw_only=True)
class FractalPunch(PunchEnsembles):
    """Self-affine punches from q_min = 2 pi / L, no roll-off; each has its rms height exactly.

    A realisation has the same phases on every grid and for every Hurst exponent. Grids have 1/4, 1/2, 1, 2, 4 and
    more times `cells` a side, which are four to the shortest wave; the coarsest has no waves beyond two of its cells.

    hursts; surfaces: how many on each of these grids, coarse to fine, one row for each of as many equal parts of the
    decades of force; zero if a grid is not used, else descending, with three finer than the coarsest grid, that of
    `cells` among them; fine_profiles: of the profiles, as many are pressed with twice the springs. cells: a multiple
    of 8.
    """

    hursts: tuple[float, ...] = (0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
    surfaces: tuple[tuple[int, ...], ...] = (
        (0, 0, 30, 12, 4),
        (0, 100, 30, 10, 0),
        (160, 40, 12, 6, 0),
        (60, 16, 6, 4, 0),
    )
    profiles: int = 400
    fine_profiles: int = 100
    decades: tuple[int, int] = (-3, 1)
    seed: int = 14

    def __post_init__(self) -> None:
        if self.cells % 8 or self.cells < 8:
            raise ValueError(f"cells must be a multiple of 8, got {self.cells}")
        if not self.decades[0] < self.decades[1]:
            raise ValueError(f"decades must be two powers of ten, ascending, got {self.decades}")
        if not 2 <= self.fine_profiles <= self.profiles:
            raise ValueError(f"fine_profiles must be from 2 to the {self.profiles} profiles, got {self.fine_profiles}")
        if not self.surfaces or len(self.surfaces) % (self.decades[1] - self.decades[0]):
            raise ValueError(f"surfaces must have as many rows in each decade, got {self.surfaces}")
        for row in self.surfaces:
            if len(row) != len(self.surfaces[0]):
                raise ValueError(f"surfaces must have rows of equal length, got {self.surfaces}")
            used = [count for count in row if count]
            if not row[2] or sum(map(bool, row[1:])) < 3 or used != sorted(used, reverse=True) or used[-1] < PAIRS:
                raise ValueError(
                    f"surfaces of a decade must descend to {PAIRS} or more on three grids of one band, got {row}"
                )

    @property
    def grids(self) -> tuple[int, ...]:
        """Cells on a side, coarse to fine."""
        return tuple(self.cells * 2**i // 4 for i in range(len(self.surfaces[0])))

    @property
    def parts(self) -> tuple[tuple[float, float], ...]:
        """First and last force of each row of `surfaces`."""
        (first, last), count = self.decades, len(self.surfaces)
        ends = [10.0 ** (first + (last - first) * i / count) for i in range(count + 1)]
        return tuple(pairwise(ends))

    def part_of(self, force: float) -> int:
        """Which row of `surfaces` a force belongs to: each part has its end, and the first has its beginning."""
        return max(sum(force > first * (1 + 1e-9) for first, _ in self.parts) - 1, 0)

    def count(self, force: float, cells: int) -> int:
        """How many surfaces are pressed with a force on a grid."""
        return self.surfaces[self.part_of(force)][self.grids.index(cells)]

    def grids_at(self, force: float) -> list[int]:
        """The grids on which surfaces are pressed with a force, coarse to fine."""
        return [cells for cells in self.grids if self.count(force, cells)]

    def roughness(self, hurst: float, cells: int | None = None) -> PunchRoughness:
        """Of surfaces on a grid, which has no wave shorter than two cells; without one, the whole band."""
        whole = replace(self.band(hurst), common=True)
        first, last = whole.waves
        return whole if cells is None else replace(whole, waves=(first, min(last, cells // 2)))

    def surface(self, hurst: float, realisation: int, cells: int) -> Surface:
        """One of the solves: one realisation on one grid, at all forces that have so many surfaces there."""
        forces = tuple(force for force in self.forces if realisation < self.count(force, cells))
        return self.surface_of(self.roughness(hurst, cells), realisation, cells, forces)

    def springs(self, hurst: float, points: int, length: float, profiles: int) -> Profiles:
        """The first profiles of one Hurst exponent, in a 1D model of length L_1D."""
        return replace(self.profiles_of(self.roughness(hurst), points, length), realisations=profiles)


@dataclass(frozen=True)
class Ensemble:
    """Outcomes for one Hurst exponent, by method and by grid, coarse to fine: cells on a side, or springs.

    Rows of their arrays are realisations, columns are forces; NaN where a realisation was not pressed.
    """

    hurst: float
    outcomes: dict[str, dict[int, Outcome]]


@dataclass(frozen=True)
class FractalPunchResult:
    """One ensemble a Hurst exponent, and which solves did not converge."""

    case: FractalPunch
    ensembles: list[Ensemble]
    unconverged: tuple[str, ...]


def run(case: FractalPunch, engine: Engine = SERIAL) -> FractalPunchResult:
    """Press all surfaces and all profiles with equal forces."""
    surfaces = {
        (hurst, BEM, cells): [case.surface(hurst, i, cells) for i in range(most)]
        for hurst in case.hursts
        for cells, most in zip(case.grids, np.max(case.surfaces, axis=0).tolist(), strict=True)
        if most
    }
    profiles = {
        (hurst, method, points): case.springs(hurst, points, length, count)
        for hurst in case.hursts
        for method, length in ((MDR, 1.0), (LONG, closed_forms.SQUARE_PUNCH))
        for points, count in ((case.points, case.profiles), (2 * case.points, case.fine_profiles))
    }
    bem, springs, unconverged = press(engine, surfaces, profiles, press_lightly)
    found = {key: at_all_forces(case, surfaces[key], outcome) for key, outcome in bem.items()} | springs
    ensembles = [Ensemble(hurst, {method: {} for method in (BEM, MDR, LONG)}) for hurst in case.hursts]
    for (hurst, method, size), outcome in found.items():
        ensembles[case.hursts.index(hurst)].outcomes[method][size] = outcome
    return FractalPunchResult(case, ensembles, unconverged)


def at_all_forces(case: FractalPunch, surfaces: Sequence[Surface], found: Outcome) -> Outcome:
    """What was found at the forces of each surface, put under those of the case; NaN elsewhere."""
    level = {force: i for i, force in enumerate(case.forces)}

    def spread(values: np.ndarray) -> np.ndarray:
        placed = np.full((len(surfaces), len(level)), np.nan)
        for row, surface, mine in zip(placed, surfaces, values, strict=True):
            row[[level[force] for force in surface.forces]] = mine[: len(surface.forces)]
        return placed

    return {name: spread(values) if values.ndim > 1 else values for name, values in found.items()}
