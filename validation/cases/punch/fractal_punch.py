"""Fig. 14.1: rough square punches under equal forces, by both methods: solves, and statistics at zero cell size."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise

import numpy as np

from validation.analysis.evidence import Table
from validation.analysis.series import masked, single
from validation.analysis.statistics import (
    FloatArray,
    Linearised,
    Moments,
    Resolved,
    combined,
    extrapolate_to_zero,
    log,
    multilevel_moments,
    nearest,
    on_finest,
    regression_mean,
)
from validation.case import SERIAL, Engine, Outcomes, Quantity, Series
from validation.cases.punch.ensembles import DEVIATION, FEW, FORCE, MEAN, PunchEnsembles, press, worked
from validation.engine.engine import Outcome
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR
from validation.simulation.rough_punch import (
    FEW_CELLS,
    Faces,
    Profiles,
    PunchRoughness,
    Surface,
    left_by_solver,
    measure_faces,
    press_lightly,
    require_converged,
)
from validation.theory import closed_forms

LONG = "springs, L_1D = 1.1523 L"
"""The 1D model whose stiffness in full contact is that of the square punch."""
HEIGHTS = "heights"
FACES_AT_ONCE = 500
PAIRS = 4
"""Fewer surfaces on a grid have no error bar worth its name."""
LEAST = math.log(0.01)
RULE = "a relative standard deviation below 1 % is judged as 1 %"
"""Of verdicts alone: two that are below are alike. No data have it."""


@dataclass(frozen=True, kw_only=True)
class FractalPunch(PunchEnsembles):
    """Self-affine punches from q_min = 2 pi / L, no roll-off; each has its rms height exactly.

    A realisation has the same phases on every grid and for every Hurst exponent. Grids have 1/4, 1/2, 1, 2, 4 and
    more times `cells` a side, which are four to the shortest wave; the coarsest has no waves beyond two of its cells.

    hursts; surfaces: how many on each of these grids, coarse to fine, one row for each of as many equal parts of the
    decades of force; zero if a grid is not used, else descending, with three finer than the coarsest grid, that of
    `cells` among them; drawn: how many have their heights measured on the coarsest grid, as control variates of the
    mean stiffness where that is used, the pressed ones among them, or none; fine_profiles: of the profiles, as many are
    pressed with twice the springs. cells: a multiple of 8.
    """

    hursts: tuple[float, ...] = (0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
    surfaces: tuple[tuple[int, ...], ...] = (
        (0, 0, 30, 12, 4),
        (0, 100, 30, 10, 0),
        (160, 40, 12, 6, 0),
        (60, 16, 6, 4, 0),
    )
    drawn: int = 1000
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
        if self.drawn and self.drawn < max(row[0] for row in self.surfaces):
            raise ValueError(f"drawn must be none or all surfaces of the coarsest grid at least, got {self.drawn}")
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
    def controlled(self) -> bool:
        """Whether heights are measured, and stand beside surfaces that are pressed."""
        return bool(self.drawn and any(row[0] for row in self.surfaces))

    @property
    def parts(self) -> tuple[tuple[float, float], ...]:
        """First and last force of each row of `surfaces`."""
        (first, last), count = self.decades, len(self.surfaces)
        ends = [10.0 ** (first + (last - first) * i / count) for i in range(count + 1)]
        return tuple(pairwise(ends))

    @property
    def plan(self) -> str:
        """How many surfaces on each grid, in words."""
        return "; ".join(
            f"Fbar = {first:.2g} to {last:.2g}: "
            + ", ".join(f"{count} on {cells}²" for cells, count in zip(self.grids, row, strict=True) if count)
            for (first, last), row in zip(self.parts, self.surfaces, strict=True)
        )

    def part_of(self, force: float) -> int:
        """Which row of `surfaces` a force belongs to: each part has its end, and the first has its beginning."""
        return max(sum(force > first * (1 + 1e-9) for first, _ in self.parts) - 1, 0)

    def counts(self, force: float) -> dict[int, int]:
        """How many surfaces are pressed with a force, on each grid that has any, coarse to fine."""
        row = self.surfaces[self.part_of(force)]
        return {cells: count for cells, count in zip(self.grids, row, strict=True) if count}

    def decade(self, first: float) -> tuple[int, int]:
        """Levels of its first and last force."""
        return nearest(self.forces, first), nearest(self.forces, 10 * first)

    def roughness(self, hurst: float, cells: int | None = None) -> PunchRoughness:
        """Of surfaces on a grid, which has no wave shorter than two cells; without one, the whole band."""
        band = replace(self.band(hurst), common=True)
        first, last = band.waves
        return band if cells is None else replace(band, waves=(first, min(last, cells // 2)))

    def surface(self, hurst: float, realisation: int, cells: int) -> Surface:
        """One of the solves: one realisation on one grid, at all forces that have so many surfaces there."""
        forces = tuple(force for force in self.forces if realisation < self.counts(force).get(cells, 0))
        return self.surface_of(self.roughness(hurst, cells), realisation, cells, forces)

    def faces(self, hurst: float) -> list[Faces]:
        """All that have their heights measured on the coarsest grid, in parts."""
        cells = self.grids[0]
        of_grid = partial(Faces, roughness=self.roughness(hurst, cells), cells=cells)
        parts = range(0, self.drawn, FACES_AT_ONCE)
        return [of_grid(first=i, realisations=min(FACES_AT_ONCE, self.drawn - i)) for i in parts]

    def springs(self, hurst: float, points: int, length: float, profiles: int) -> Profiles:
        """The first profiles of one Hurst exponent, in a 1D model of length L_1D."""
        return replace(self.profiles_of(self.roughness(hurst), points, length), realisations=profiles)


def run(case: FractalPunch, engine: Engine = SERIAL) -> Outcomes:
    """Press all surfaces and all profiles with equal forces.

    Outcomes by Hurst exponent, method, and cells on a side or springs: rows are realisations, columns are forces, NaN
    where a realisation was not pressed; of `HEIGHTS`, statistics of heights.
    """
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
    placed = {key: at_all_forces(case, surfaces[key], outcome) for key, outcome in bem.items()}
    faces = {(hurst, HEIGHTS, case.grids[0]): case.faces(hurst) for hurst in case.hursts if case.controlled}
    heights = {
        key: {"heights": np.concatenate([part["heights"] for part in parts])}
        for key, parts in engine.map_groups(measure_faces, faces).items()
    }
    return Outcomes(case, {**placed, **springs, **heights}, unconverged)


def at_all_forces(case: FractalPunch, surfaces: Sequence[Surface], outcome: Outcome) -> Outcome:
    """What was found at the forces of each surface, put under those of the case; NaN elsewhere."""
    level = {force: i for i, force in enumerate(case.forces)}

    def spread(values: FloatArray) -> FloatArray:
        placed = np.full((len(surfaces), len(level)), np.nan)
        for row, surface, pressed in zip(placed, surfaces, values, strict=True):
            row[[level[force] for force in surface.forces]] = pressed[: len(surface.forces)]
        return placed

    return {name: spread(values) if values.ndim > 1 else values for name, values in outcome.items()}


@dataclass(frozen=True)
class PunchStatistics:
    """Statistics at each force, in natural logarithms."""

    result: Outcomes

    @property
    def case(self) -> FractalPunch:
        case: FractalPunch = self.result.case
        return case

    def outcomes(self, hurst: float, method: str) -> dict[int, Outcome]:
        """By cells on a side, or springs, coarse to fine."""
        return {size: outcome for (h, m, size), outcome in self.result.by_key.items() if (h, m) == (hurst, method)}

    def on_grids(self, name: str, hurst: float, method: str, level: int) -> dict[int, FloatArray]:
        """What each realisation has under one force, on each grid where some were pressed; NaN for the others."""
        columns = {size: outcome[name][:, level] for size, outcome in self.outcomes(hurst, method).items()}
        most = max(len(self.heights(hurst, method)), *(column.size for column in columns.values()))
        return {
            size: np.pad(column, (0, most - column.size), constant_values=np.nan)
            for size, column in columns.items()
            if np.isfinite(column).any()
        }

    def heights(self, hurst: float, method: str) -> FloatArray:
        """Statistics of the heights of surfaces on the coarsest grid, one row a realisation; no row without any."""
        measured = self.result.by_key.get((hurst, HEIGHTS, self.case.grids[0])) if method == BEM else None
        return measured["heights"] if measured is not None else np.empty((0, 0))

    @cached_property
    def _moments(self) -> dict[tuple[float, str, int], dict[int, Moments]]:
        """Of the stiffness by Hurst exponent, method and level of force: on each grid."""
        return {
            (hurst, method, level): dict(zip(pressed, multilevel_moments(list(pressed.values())), strict=True))
            for hurst in self.case.hursts
            for method in (BEM, MDR, LONG)
            for level in range(len(self.case.forces))
            for pressed in [self.on_grids("stiffness", hurst, method, level)]
        }

    def steps(self, hurst: float, method: str, statistic: str, level: int) -> dict[int, Linearised]:
        """ln of the mean stiffness, or of the relative deviation, under one force, on each grid."""
        if statistic == MEAN:
            return self._log_means[hurst, method, level]
        return {n: of_grid.log_relative_deviation for n, of_grid in self._moments[hurst, method, level].items()}

    @cached_property
    def _log_means(self) -> dict[tuple[float, str, int], dict[int, Linearised]]:
        """ln of the mean stiffness on each grid.

        What the mean of the coarsest gains by regression on the heights of more surfaces, all grids gain: the steps
        between them are as they were.
        """
        means = {key: {n: of_grid.mean for n, of_grid in grids.items()} for key, grids in self._moments.items()}
        for (hurst, method, level), of_grids in means.items():
            coarsest, heights = next(iter(of_grids)), self.heights(hurst, method)
            if len(heights) and coarsest == self.case.grids[0]:
                values = self.on_grids("stiffness", hurst, method, level)[coarsest]
                gain = regression_mean(values, heights) - of_grids[coarsest]
                means[hurst, method, level] = {n: mean + gain for n, mean in of_grids.items()}
        return {key: {n: log(mean) for n, mean in of_grids.items()} for key, of_grids in means.items()}

    def at(self, hurst: float, method: str, statistic: str, level: int) -> Resolved:
        """Extrapolated to zero cell size, with what the solver leaves, or on twice the springs."""
        steps = list(self.steps(hurst, method, statistic, level).values())
        if method != BEM:
            return on_finest(steps)
        resolved = extrapolate_to_zero(steps)
        return resolved.widened(left_by_solver() if statistic == MEAN else left_by_solver(resolved.value.value))

    def ratio(self, hurst: float, method: str, statistic: str, level: int) -> Resolved:
        """Springs over boundary elements; surfaces and profiles are independent.

        Minus infinity where no profile of springs deviates from another, as in full contact; NaN where no surface does.
        """
        springs, bem = (self.at(hurst, model, statistic, level) for model in (method, BEM))
        return springs.minus_independent(bem)

    def counted(self, hurst: float, method: str, level: int) -> Resolved:
        """The ratio of the deviations as it is judged, by `RULE`."""
        springs, bem = (at_least(self.at(hurst, model, DEVIATION, level)) for model in (method, BEM))
        return springs.minus_independent(bem)

    def exponent(self, hurst: float, method: str, before: int, after: int) -> Resolved:
        """d ln k / d ln F of the mean stiffness from one level of force to another."""
        slope = 1 / math.log(self.case.forces[after] / self.case.forces[before])
        return combined([-slope, slope], [self.at(hurst, method, MEAN, level) for level in (before, after)])

    def trend(self, method: str, level: int) -> Resolved:
        """d ln deviation / d H by least squares over the Hurst exponents: positive if the deviation rises with H."""
        centred = np.array(self.case.hursts) - np.mean(self.case.hursts)
        return combined(centred / (centred**2).sum(), [self.at(h, method, DEVIATION, level) for h in self.case.hursts])

    def require_converged(self) -> None:
        """Raises NotConvergedError where too few surfaces have converged at one of the forces."""
        for (_, method, cells), outcome in self.result.by_key.items():
            if method == BEM:
                pressed = [level for level, force in enumerate(self.case.forces) if cells in self.case.counts(force)]
                require_converged([{"stiffness": outcome["stiffness"][:, pressed]}], self.result.unconverged)

    def contact(self, hurst: float, level: int, cells: int) -> float:
        """Mean area of the contacts on a grid, in cells."""
        return cells**2 * float(np.nanmean(self.result[hurst, BEM, cells]["area"][:, level]))


def at_least(deviation: Resolved) -> Resolved:
    """The logarithm of a deviation as large as LEAST at least; by how much it may be larger."""
    value, half = deviation.value, deviation.value.half_width + deviation.grid
    if not value.value < LEAST:
        return deviation
    return Resolved(Linearised(LEAST, np.zeros(1)), max(value.value + half - LEAST, 0.0))


STIFFNESS = Quantity("k_E_L", "k / (E* L)")
SCATTER = Quantity("relative_deviation_of_k")
SLOPE = Quantity("d_ln_k_d_ln_F", "d ln k / d ln F")
H = "H"
TREND = Quantity("d_ln_deviation_d_H", "d ln deviation / d H")
LAW, FRACTION = "1 / (1 + H)", Quantity("contact_fraction")
CONVEX = Quantity("largest_excess_of_the_slope_of_the_load_curve_over_the_stiffnesses_at_its_two_ends")
FLAT = Quantity("largest_stiffness_of_any_surface_over_that_of_the_flat_punch")


def criteria(statistics: PunchStatistics) -> Iterator[Series]:
    """F(d) is convex: its slope lies between the stiffnesses at two forces. No punch is stiffer than a flat one."""
    case = statistics.case
    force = case.height * np.array(case.forces)
    consistent = (
        "force, approach and stiffness of every realisation are consistent; residual of the solver, and two digits of "
        "cancellation in the difference of approaches"
    )
    for method in (BEM, MDR):
        excess = 1.0
        for outcome in (o for hurst in case.hursts for o in statistics.outcomes(hurst, method).values()):
            slope, stiffness = np.diff(force) / np.diff(outcome["approach"], axis=1), outcome["stiffness"]
            for ratio in (stiffness[:, :-1] / slope, slope / stiffness[:, 1:]):
                excess = float(np.fmax.reduce(ratio, axis=None, initial=excess))
        yield single(CONVEX, method, excess - 1, 100 * case.tolerance, "F(d) is convex", consistent)
    largest = max(float(np.nanmax(statistics.result[hurst, BEM, case.cells]["stiffness"])) for hurst in case.hursts)
    over_flat, half = largest / closed_forms.SQUARE_PUNCH, 1 / case.cells
    all_cells = "flat punch: all cells in contact"
    reason = "never stiffer than all cells in contact; at the largest force at most two cells a side "
    yield single(FLAT, BEM, over_flat, half, all_cells, f"{reason}({2 * half:.2g}) softer", 1.0 - half)


def curves(statistics: PunchStatistics, hurst: float) -> Iterator[Series]:
    """Statistics of each method force by force, on grids too, and which of them stand on few cells."""
    case, levels = statistics.case, range(len(statistics.case.forces))
    by_force = partial(Series, where={H: hurst}, along=FORCE, at=case.forces)
    ends = [(max(i - 1, 0), min(i + 1, len(levels) - 1)) for i in levels]
    finest = [max(case.counts(force)) for force in case.forces]
    cells = np.array([statistics.contact(hurst, i, n) for i, n in zip(levels, finest, strict=True)])
    for method in (BEM, MDR, LONG):
        of: dict[tuple[str, Callable[[float], float]], list[Linearised]] = {
            (STIFFNESS, math.exp): [statistics.at(hurst, method, MEAN, i).value for i in levels],
            (SCATTER, math.exp): [statistics.at(hurst, method, DEVIATION, i).value for i in levels],
            (SLOPE, float): [statistics.exponent(hurst, method, *pair).value for pair in ends],
        }
        for (quantity, shown), values in of.items():
            yield by_force(quantity, method, values, shown=shown)
            if method == BEM:
                yield by_force(quantity, FEW, masked(values, cells < FEW_CELLS), shown=shown)
    force, middle = np.array(case.forces), len(levels) // 2
    law = np.where(force <= 1, (force / force[middle]) ** (1 / (1 + hurst)), math.nan)
    yield by_force(STIFFNESS, LAW, law * math.exp(statistics.at(hurst, BEM, MEAN, middle).value.value))
    yield by_force(SLOPE, LAW, np.full(force.size, 1 / (1 + hurst)))
    pressed = [statistics.on_grids("stiffness", hurst, BEM, i).values() for i in levels]
    yield by_force("surfaces", BEM, [float(max(np.isfinite(column).sum() for column in grids)) for grids in pressed])
    yield by_force(FRACTION, BEM, cells / np.square(finest))
    yield by_force(FRACTION, MDR, statistics.result[hurst, MDR, case.points]["area"].mean(axis=0))
    for quantity, statistic in ((STIFFNESS, MEAN), (SCATTER, DEVIATION)):
        steps = [statistics.steps(hurst, BEM, statistic, i) for i in levels]
        for n in case.grids:
            on_grid = [step[n].value if n in step else math.nan for step in steps]
            yield by_force(f"{quantity} on grids", f"{n}²", on_grid, shown=math.exp)


def trends(statistics: PunchStatistics) -> Iterator[Series]:
    """Whether the deviation rises with H, where there are several."""
    case = statistics.case
    for method in (BEM, MDR) if len(case.hursts) > 1 else ():
        by_force = [statistics.trend(method, level) for level in range(len(case.forces))]
        values, grid = [t.value for t in by_force], [t.grid for t in by_force]
        yield Series(TREND, method, values, along=FORCE, at=case.forces, grid=grid)


def tables(result: Outcomes) -> tuple[Table, ...]:
    """Counted work."""
    case = result.case
    return (worked(case.cells, case.points, [result[hurst, BEM, case.cells] for hurst in case.hursts]),)
