"""Whether springs are noisier than a half-space however wide the band of the roughness is.

Long waves and phases are common to all bands, so that most of the scatter drops out of a change from band to band: the
deviation of a wide band is that of a narrower one on many surfaces, and the change on few (multilevel Monte Carlo).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from validation.analysis.statistics import (
    FloatArray,
    Linearised,
    Resolved,
    moments,
    multilevel_moments,
    nearest,
    weighted_sum,
)
from validation.case import SERIAL, Engine, Outcomes
from validation.cases.punch.ensembles import PunchEnsembles, press
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR
from validation.simulation.rough_punch import (
    Profiles,
    PunchRoughness,
    RolledOffRoughness,
    Surface,
    force_levels,
    left_by_solver,
    press_lightly,
)
from validation.simulation.spring_tracks import RoughAreas, press_areas

ROLL_OFF = "q_r L / 2π"
FINER, DOUBLED, AREA = "finer cells", "twice the springs", "springs over an area"
SAMPLE_OF = {FINER: BEM, DOUBLED: MDR}
"""Whose realisations they press again."""
LITTLE = 1e-9
A_WAVE = 16
"""Springs of a profile to the shortest wave."""


@dataclass(frozen=True)
class Band:
    """waves: q_max / q_min, q_min = 2 pi / L; cells: on a side; light: surfaces under the first decade of forces, for
    each Hurst exponent, or one number for all; heavy: how many of these under all forces; finer: the same two numbers
    on twice as many cells; areas: surfaces under springs."""

    waves: int
    cells: int
    light: int | tuple[int, ...]
    heavy: int
    finer: tuple[int, int] = (0, 0)
    areas: int = 0


@dataclass(frozen=True, kw_only=True)
class Bandwidth(PunchEnsembles):
    """Punches whose longest wave is the side, of several bandwidths, and one with a roll-off.

    bands: ascending, realisations in each are the first ones of the band before; first: realisation; the surfaces of
    the case fractal_punch from there on are the same ones. roll_off: q_r L / 2 pi of as many surfaces, rolled_off, in
    the band that the number stands in.
    """

    hursts: tuple[float, ...] = (0.4, 0.7, 1.0)
    bands: tuple[Band, ...] = (
        Band(8, 32, 200, 100, (60, 40), 200),
        Band(16, 64, 100, 60, (40, 20), 100),
        Band(32, 128, 40, 16, (16, 8), 40),
    )
    first: int = 80
    roll_off: tuple[int, int] = (4, 1)
    rolled_off: int = 40
    profiles: int = 1000
    decades: tuple[int, int] = (-3, -1)
    seed: int = 14

    def __post_init__(self) -> None:
        counts = np.array([(*self.light(i), band.heavy) for i, band in enumerate(self.bands)])
        if len(counts) < 2 or (np.diff(counts, axis=0) > 0).any() or (counts.min(axis=1) < counts[:, -1]).any():
            raise ValueError(f"bands must be two at least, with fewer surfaces in wider ones, got {self.bands}")

    def light(self, band: int) -> tuple[int, ...]:
        """Surfaces under the first decade of forces, for each Hurst exponent."""
        return tuple(np.broadcast_to(self.bands[band].light, len(self.hursts)).tolist())

    @property
    def counts(self) -> str:
        """How many surfaces in each band, in words."""
        light = [" or ".join(dict.fromkeys(map(str, self.light(i)))) for i in range(len(self.bands))]
        return "; ".join(
            f"{most} and {band.heavy} of q_max / q_min = {band.waves} on {band.cells}² cells"
            for most, band in zip(light, self.bands, strict=True)
        )

    def roughness(self, hurst: float, waves: int) -> PunchRoughness:
        return PunchRoughness(hurst=hurst, waves=(1, waves), height=self.height, seed=self.seed, common=True)

    @property
    def rolled(self) -> RolledOffRoughness:
        """Constant spectrum up to the roll-off, at the middle of the Hurst exponents."""
        roll_off, band = self.roll_off
        hurst = self.hursts[len(self.hursts) // 2]
        plain = self.roughness(hurst, self.bands[band].waves)
        return RolledOffRoughness(**vars(plain), roll_off=roll_off)

    def pressed(self, roughness: PunchRoughness, cells: int, light: int, heavy: int) -> list[Surface]:
        """The first ones at all forces, the others at those of the first decade."""
        few = force_levels((self.decades[0], self.decades[0] + 1), self.per_decade)
        forces = [self.forces if i < heavy else few for i in range(light)]
        return [self.surface_of(roughness, self.first + i, cells, levels) for i, levels in enumerate(forces)]

    def springs(self, roughness: PunchRoughness, points: int, count: int) -> Profiles:
        return replace(self.profiles_of(roughness, points), realisations=count)


LOADS = force_levels((-6, 0), 8)
"""Overlaps of springs over an area, mean over all of it, in rms heights."""
Key = tuple[str, float | str, int]


def run(case: Bandwidth, engine: Engine = SERIAL) -> Outcomes:
    """Stiffness by method, Hurst exponent or roll-off, and band: a row a realisation, a column a force, or a load of
    springs over an area."""
    plain = {
        (hurst, i): case.roughness(hurst, band.waves) for hurst in case.hursts for i, band in enumerate(case.bands)
    }
    surfaces: dict[Key, list[Surface]] = {}
    profiles: dict[Key, Profiles] = {}
    areas: dict[Key, RoughAreas] = {}
    for (hurst, i), ground in plain.items():
        band, light = case.bands[i], case.light(i)[case.hursts.index(hurst)]
        surfaces[BEM, hurst, i] = case.pressed(ground, band.cells, light, band.heavy)
        surfaces[FINER, hurst, i] = case.pressed(ground, 2 * band.cells, *band.finer)
        profiles[MDR, hurst, i] = case.springs(ground, A_WAVE * band.waves, case.profiles)
        profiles[DOUBLED, hurst, i] = case.springs(ground, 2 * A_WAVE * band.waves, case.profiles // 10)
        areas[AREA, hurst, i] = RoughAreas(
            roughness=ground, first=case.first, realisations=band.areas, cells=band.cells, loads=LOADS
        )
    band, key = case.bands[case.roll_off[1]], (ROLL_OFF, case.roll_off[1])
    surfaces[BEM, *key] = case.pressed(case.rolled, band.cells, case.rolled_off, case.rolled_off)
    profiles[MDR, *key] = case.springs(case.rolled, A_WAVE * band.waves, case.profiles)
    surfaces = {key: group for key, group in surfaces.items() if group}
    areas = {key: group for key, group in areas.items() if group.realisations}
    bem, springs, unconverged = press(engine, surfaces, profiles, press_lightly)
    uncoupled = dict(zip(areas, engine.map(press_areas, list(areas.values())), strict=True))
    outcomes = {**bem, **springs, **uncoupled}
    return Outcomes(case, {key: outcome["stiffness"] for key, outcome in outcomes.items()}, unconverged)


@dataclass(frozen=True)
class Deviations:
    """ln of the relative deviation by band, with what each realisation contributes to it."""

    result: Outcomes

    @cached_property
    def most(self) -> Mapping[str, int]:
        """Realisations of each method, in any band."""
        counts = [(SAMPLE_OF.get(key[0], key[0]), len(rows)) for key, rows in self.result.by_key.items()]
        return {method: max(n for m, n in counts if m == method) for method, _ in counts}

    def column(self, method: str, name: float | str, band: int, level: int) -> FloatArray:
        """Under one force, or at one load of springs over an area; NaN for realisations that were not pressed."""
        column = np.full(self.most[SAMPLE_OF.get(method, method)], math.nan)
        rows = self.result.by_key.get((method, name, band))
        if rows is not None and level < rows.shape[1]:
            column[: len(rows)] = rows[:, level]
        return column

    def by_band(self, method: str, name: float | str, level: int) -> dict[int, Linearised]:
        """From the narrowest band to the widest that has this level."""
        columns = {i: self.column(method, name, i, level) for i in range(len(self.result.case.bands))}
        pressed = {i: column for i, column in columns.items() if np.isfinite(column).any()}
        of_bands = multilevel_moments(list(pressed.values()))
        return {i: band.log_relative_deviation for i, band in zip(pressed, of_bands, strict=True)}

    def change(self, key: tuple[float, int, int], before: str, after: str) -> Linearised:
        """On the realisations that both have, by Hurst exponent, band and level."""
        columns = [self.column(method, *key) for method in (before, after)]
        both = np.asarray(np.isfinite(columns).all(axis=0))
        start, end = (moments(column, both).log_relative_deviation for column in columns)
        return end - start

    def steps(self, method: str, hurst: float, level: int) -> dict[int, Linearised]:
        """What cells half as long, or twice the springs, change; where that is not measured, as in the band before."""
        finer, changes = {BEM: FINER, MDR: DOUBLED}[method], {}
        step = Linearised(0.0, np.zeros(self.most[method]))
        for i in self.by_band(method, hurst, level):
            if np.isfinite(self.column(finer, hurst, i, level)).any():
                step = self.change((hurst, i, level), method, finer)
            changes[i] = step
        return changes

    def resolved(self, method: str, hurst: float, level: int) -> dict[int, Resolved]:
        """Boundary elements to first order at zero cell size, and half of the way there, with what the solver leaves;
        springs as they are, and what twice as many change."""
        values, steps = (of(method, hurst, level) for of in (self.by_band, self.steps))
        taken = {BEM: 2.0, MDR: 0.0}[method]
        resolved = {i: Resolved(values[i] + taken * step, abs(step.value)) for i, step in steps.items()}
        if method != BEM:
            return resolved
        return {i: deviation.widened(left_by_solver(deviation.value.value)) for i, deviation in resolved.items()}

    def ratio(self, hurst: float, level: int) -> dict[int, Resolved]:
        """MDR over boundary elements."""
        springs, bem = (self.resolved(method, hurst, level) for method in (MDR, BEM))
        return {i: springs[i].minus_independent(deviation) for i, deviation in bem.items()}

    def slope(self, hurst: float, level: int) -> Resolved:
        """d ln ratio / d log10(q_max / q_min) by generalised least squares: a change that few surfaces tell counts
        little. Cells err alike in all bands, so that what they leave of a slope is the slope of what they leave."""
        ratio = {i: point.value for i, point in self.ratio(hurst, level).items()}
        shifts = np.array([point.influence for point in ratio.values()])
        left = np.array(
            [[steps[i].value for i in ratio] for steps in (self.steps(of, hurst, level) for of in (BEM, MDR))]
        )
        if not np.isfinite([*left.sum(axis=0), *(point.value for point in ratio.values())]).all():
            return Resolved(Linearised(math.nan, shifts[0]), 0.0)
        waves = [self.result.case.bands[i].waves for i in ratio]
        line = np.stack([np.ones(len(waves)), np.log10(waves)], axis=1)
        covariance = shifts @ shifts.T
        # bands that go together exactly have no inverse
        inverse = np.linalg.inv(covariance + LITTLE * np.trace(covariance) * np.eye(len(waves)))
        weights = np.linalg.solve(line.T @ inverse @ line, line.T @ inverse)[1]
        solver = [left_by_solver(deviation.value) for deviation in self.by_band(BEM, hurst, level).values()]
        slope = Resolved(weighted_sum(weights, list(ratio.values())), float(np.abs(left @ weights).sum()))
        return slope.widened(float(np.abs(weights) @ solver))

    def without_coupling(self, hurst: float, level: int) -> dict[int, Linearised]:
        """Springs along a line over springs over an area, whose contact is k / E* wide, k that of boundary elements.

        In bands wider than (kbar / Fbar)^(1/H), whose shorter waves are low beside the depth F / k of the contact.
        """
        case, line, ratios = self.result.case, self.by_band(MDR, hurst, level), {}
        for i, band in enumerate(case.bands):
            fractions = self.result.by_key.get((AREA, hurst, i))
            if fractions is None:
                continue
            wide = float(np.nanmean(self.column(BEM, hurst, i, level)))
            if band.waves > (wide / case.forces[level]) ** (1 / hurst):
                load = nearest(fractions.mean(axis=0).tolist(), wide**2)
                ratios[i] = line[i].minus_independent(self.by_band(AREA, hurst, load)[i])
        return ratios

    def of_roll_off(self, level: int) -> Linearised:
        """Change of MDR over boundary elements on equal cells."""
        case = self.result.case
        hurst, band = case.rolled.hurst, case.roll_off[1]
        plain, rolled = (
            self.by_band(MDR, name, level)[band].minus_independent(self.by_band(BEM, name, level)[band])
            for name in (hurst, ROLL_OFF)
        )
        return rolled - plain
