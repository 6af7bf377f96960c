"""Where MDR must fail: true contact area, mean gap, and roughness with a roll-off: stiffness proportional to load."""

import math
from dataclasses import dataclass

import numpy as np

from validation import closed_forms
from validation.ensemble import SERIAL, Engine, Outcome, generator
from validation.evidence import Evidence, Number, Role, Table
from validation.rough_punch import (
    Profiles,
    Roughness,
    Surface,
    enough,
    force_levels,
    lost,
    press_profiles,
    press_surface,
    stacked,
)
from validation.statistics import (
    DECIBEL,
    FIVE_PER_CENT,
    Estimate,
    FloatArray,
    Sample,
    Statistic,
    at,
    change,
    combined,
    decade_slope,
    decade_weights,
    local_slope,
    log_deviation_over,
    log_mean,
    log_relative_deviation,
    sample,
)

Row = dict[str, float]

BEM, MDR = "bem3d", "mdr"
METHODS = (BEM, MDR)
MEASURED = {"stiffness": "stiffness", "area": "contact fraction", "gap": "mean gap"}
BOOTSTRAP = 3
CLOSED = 1e-12
"""A mean gap over L that counts as none."""


@dataclass(frozen=True, kw_only=True)
class MdrLimits:
    """The punches of Fig. 14.1 and others whose longest wave is a part of the side: the roll-off to nothing.

    hurst; roll_offs: q_r L / 2 pi, waves of the longest on a side, 1 first; cells: on a side; surfaces, profiles:
    realisations; refined: surfaces pressed again on twice as many cells a side; decades: powers of ten of the first and
    the last Fbar, per_decade: steps of force in one; points: springs of a profile; height: h / L; tolerance: residual
    of the solver; seed: zero or positive.
    """

    hurst: float = 0.7
    roll_offs: tuple[int, ...] = (1, 8)
    cells: int = 128
    surfaces: int = 12
    refined: int = 4
    profiles: int = 200
    decades: tuple[int, int] = (-2, 0)
    per_decade: int = 3
    points: int = 2048
    height: float = 1e-3
    tolerance: float = 1e-4
    seed: int = 142

    @property
    def forces(self) -> tuple[float, ...]:
        """Levels of Fbar, ascending."""
        return force_levels(self.decades, self.per_decade)

    def roughness(self, roll_off: int) -> Roughness:
        """No wave longer than L / roll_off, none shorter than four cells."""
        return Roughness(hurst=self.hurst, waves=(roll_off, self.cells // 4), height=self.height, seed=self.seed)


@dataclass(frozen=True)
class MdrLimitsResult:
    """Outcomes by roll-off: rows of their arrays are realisations, columns are forces; refined: on finer cells."""

    case: MdrLimits
    bem: dict[int, Outcome]
    refined: dict[int, Outcome]
    mdr: dict[int, Outcome]
    unconverged: tuple[str, ...]


def run(case: MdrLimits, engine: Engine = SERIAL) -> MdrLimitsResult:
    """Press surfaces and profiles of every roll-off with equal forces."""
    groups = {
        (roll_off, cells): [
            Surface(
                roughness=case.roughness(roll_off),
                realisation=i,
                cells=cells,
                forces=case.forces,
                tolerance=case.tolerance,
            )
            for i in range(case.surfaces if cells == case.cells else case.refined)
        ]
        for roll_off in case.roll_offs
        for cells in (case.cells, 2 * case.cells)
    }
    surfaces = [surface for group in groups.values() for surface in group]
    profiles = [
        Profiles(
            roughness=case.roughness(roll_off),
            realisations=case.profiles,
            points=case.points,
            length=1.0,
            forces=case.forces,
        )
        for roll_off in case.roll_offs
    ]
    outcomes = engine.map(press_surface, surfaces)
    pressed = iter(outcomes)
    bem = {key: stacked([next(pressed) for _ in group]) for key, group in groups.items()}
    return MdrLimitsResult(
        case,
        {r: bem[r, case.cells] for r in case.roll_offs},
        {r: bem[r, 2 * case.cells] for r in case.roll_offs},
        dict(zip(case.roll_offs, engine.map(press_profiles, profiles), strict=True)),
        lost(surfaces, outcomes),
    )


@dataclass(frozen=True)
class Samples:
    """What was measured at one roll-off, resampled: by method and quantity; and by quantity, pairs of grids."""

    by_method: dict[tuple[str, str], Sample]
    grids: dict[str, Sample]

    def open(self, weights: FloatArray) -> bool:
        """Whether there is a gap in one dimension at all of these levels: none is left in full contact."""
        mean, _ = self.by_method[MDR, "gap"].moments
        return bool((mean[weights > 0] > CLOSED).all())

    def apart(self, label: str, quantity: str, statistic: Statistic) -> Number:
        """MDR over boundary elements in decibels; grid: what cells half as wide would go on to change."""
        mdr, bem = (self.by_method[method, quantity].estimate(statistic) for method in (MDR, BEM))
        apart, finer = mdr.minus(bem), self.grids[quantity].estimate(change(statistic))
        return Number(
            label=f"{label}: mdr over bem3d",
            value=DECIBEL * apart.value,
            reference=0.0,
            source="bem3d",
            tolerance=FIVE_PER_CENT,
            unit="dB",
            reason="5 %, as in Fig. 14.1",
            grid=DECIBEL * 2 * (abs(finer.value) + finer.half_width),
            sample=DECIBEL * apart.half_width,
            role=Role.FINDING,
        )


def evidence(result: MdrLimitsResult) -> Evidence:
    """Area, gap, stiffness and its fluctuation, MDR over boundary elements; the exponents of the interface alone.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    enough((*result.bem.values(), *result.refined.values()), result.unconverged)
    samples = {roll_off: _samples(result, roll_off) for roll_off in case.roll_offs}
    numbers = []
    for power in range(*case.decades):
        first = 10.0**power
        weights = decade_weights(case.forces, first)
        for roll_off, mine in samples.items():
            where = f"q_r L / 2π = {roll_off}, Fbar = {first:g} to {10 * first:g}"
            numbers += [
                mine.apart(f"{name}, {where}", quantity, combined(weights, log_mean))
                for quantity, name in MEASURED.items()
                if quantity != "gap" or mine.open(weights)
            ]
            numbers.append(mine.apart(f"relative deviation, {where}", "stiffness", log_deviation_over(weights)))
            numbers += [n for method in METHODS if (n := _proportional(case, mine, method, first, where))]
    curves = [row for roll_off, mine in samples.items() for row in _curve(result, roll_off, mine)]
    longest = case.roll_offs[-1]
    return Evidence(
        title="Where MDR must fail: contact area, mean gap, roughness with a roll-off",
        compared=(
            f"Punches with H = {case.hurst:g} as in Fig. 14.1, and others without waves longer than L over "
            f"{', '.join(map(str, case.roll_offs[1:]))}, all to {case.cells // 4} waves on a side. {case.surfaces} "
            f"surfaces of {case.cells}² cells, {case.profiles} profiles of {case.points} springs, equal forces. True "
            "contact area over L² beside springs in contact over all; mean gap between the faces over h; stiffness, "
            "its relative deviation, and the exponent of the stiffness of the rough interface alone, k_i, in series "
            "with the flat punch: 1/k = 1/k_i + 1/k_flat. Grid error: twice what cells half as wide change on "
            f"{case.refined} surfaces, and twice the interval of that."
        ),
        numbers=tuple(numbers),
        tables=(Table("curves", {name: [row[name] for row in curves] for name in curves[0]}),),
        conclusions=tuple(_conclusions(result, samples)),
        captions={
            "mdr_limits": (
                "Circles: boundary elements, 95 % intervals of the sample; lines in bands: MDR, L_1D = L. (a) Contact "
                "fraction; dotted: Persson's erf(√2 p / (E* h')) for the mean pressure p and the rms slope h' of the "
                f"surfaces with q_r L / 2π = {longest}. (b) Mean gap over h. (c) Stiffness of the interface alone over "
                "force, k_i / Fbar: level where the stiffness is proportional to the load. (d) Relative deviation of "
                "the stiffness of the punch. Dark to light: q_r L / 2π = "
                f"{', '.join(map(str, case.roll_offs))}."
            )
        },
        unconverged=result.unconverged,
    )


def _samples(result: MdrLimitsResult, roll_off: int) -> Samples:
    case = result.case
    outcomes = {BEM: result.bem[roll_off], MDR: result.mdr[roll_off]}
    by_method, grids = {}, {}
    for i, quantity in enumerate(MEASURED):
        for j, (method, outcome) in enumerate(outcomes.items()):
            # full contact has no gap but rounding's
            values = np.maximum(outcome[quantity], CLOSED)
            by_method[method, quantity] = sample(values, generator(case.seed, BOOTSTRAP, roll_off, i, j))
        coarse, fine = outcomes[BEM][quantity][: case.refined], result.refined[roll_off][quantity]
        both = np.where(np.isfinite(coarse) & np.isfinite(fine), 1.0, np.nan)
        pairs = np.concatenate([both * coarse, both * fine], axis=1)
        grids[quantity] = sample(pairs, generator(case.seed, BOOTSTRAP, roll_off, i, 2))
    return Samples(by_method, grids)


def _flat(method: str) -> float:
    """k / (E* L) of the flat punch."""
    return closed_forms.SQUARE_PUNCH if method == BEM else 1.0


def _log_interface(method: str) -> Statistic:
    """ln of the stiffness of the interface alone, from the mean stiffness of the punch; NaN beyond the flat punch."""

    def of_levels(mean: FloatArray, deviation: FloatArray) -> FloatArray:
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(-np.log(1 / mean - 1 / _flat(method)))

    return of_levels


def _proportional(case: MdrLimits, mine: Samples, method: str, first: float, where: str) -> Number | None:
    """d ln k_i / d ln F over a decade; None where the punch is as stiff as the flat one, or stiffer."""
    slope = combined(decade_slope(case.forces, first), _log_interface(method))
    found = mine.by_method[method, "stiffness"].estimate(slope)
    finer = mine.grids["stiffness"].estimate(change(slope)) if method == BEM else Estimate(0.0, 0.0, found.samples)
    if not np.isfinite([found.value, found.error, finer.value, finer.error]).all():
        return None
    return Number(
        label=f"exponent of the interface, {where}: {method}",
        value=found.value,
        reference=1.0,
        source="stiffness proportional to load: Pastewka et al. (2013), for q_r L / 2π >> 1",
        tolerance=0.115,
        reason="half of the way to 0.77, the largest exponent published for roughness without a roll-off",
        grid=2 * (abs(finer.value) + finer.half_width),
        sample=found.half_width,
        role=Role.FINDING,
    )


def persson(pressure: FloatArray, gradient: float) -> FloatArray:
    """Contact fraction erf(sqrt(2) p / (E* h')), p over E*: Persson, J. Chem. Phys. 115 (2001), full form."""
    return np.array([math.erf(math.sqrt(2) * p / gradient) for p in pressure])


def _curve(result: MdrLimitsResult, roll_off: int, mine: Samples) -> list[Row]:
    """One row a force."""
    case, outcome = result.case, result.bem[roll_off]
    rows = []
    for level, force in enumerate(case.forces):
        row = {"q_r L / 2π": float(roll_off), "Fbar": force}
        for method in METHODS:
            for quantity, name in MEASURED.items():
                found = mine.by_method[method, quantity].estimate(at(level, log_mean))
                unit = case.height if quantity == "gap" else 1.0
                row |= _interval(f"{method} {name}", found, unit)
            stiffness = mine.by_method[method, "stiffness"]
            row |= _interval(f"{method} relative deviation", stiffness.estimate(at(level, log_relative_deviation)))
            row |= _interval(f"{method} interface", stiffness.estimate(at(level, _log_interface(method))))
            slope = combined(local_slope(case.forces, level), _log_interface(method))
            row[f"{method} exponent of the interface"] = stiffness.estimate(slope).value
        row["Persson contact fraction"] = float(
            persson(np.array([case.height * force]), float(outcome["gradient"].mean()))[0]
        )
        row["bem3d cells in contact"] = row["bem3d contact fraction"] * case.cells**2
        rows.append(row)
    return rows


def _interval(name: str, found: Estimate, unit: float = 1.0) -> Row:
    ends = (found.value, found.value - found.half_width, found.value + found.half_width)
    return {f"{name}{end}": math.exp(value) / unit for end, value in zip(("", " low", " high"), ends, strict=True)}


def _conclusions(result: MdrLimitsResult, samples: dict[int, Samples]) -> list[str]:
    case = result.case
    level = int(np.argmin(np.abs(np.log(np.array(case.forces) / 0.1))))
    sentences = []
    for roll_off, mine in samples.items():
        value = {key: math.exp(s.estimate(at(level, log_mean)).value) for key, s in mine.by_method.items()}
        scatter = [
            math.exp(mine.by_method[m, "stiffness"].estimate(at(level, log_relative_deviation)).value) for m in METHODS
        ]
        pressure = np.array([case.height * case.forces[level]])
        law = persson(pressure, float(result.bem[roll_off]["gradient"].mean()))[0]
        area, gap, stiffness = ([value[m, quantity] for m in METHODS] for quantity in ("area", "gap", "stiffness"))
        sentences.append(
            f"q_r L / 2π = {roll_off}, Fbar = {case.forces[level]:.2g}, boundary elements and MDR: contact fraction "
            f"{area[0]:.4f} and {area[1]:.3f} (Persson {law:.4f}), mean gap {gap[0] / case.height:.2f} h and "
            f"{gap[1] / case.height:.2f} h, stiffness {stiffness[0]:.3f} and {stiffness[1]:.3f} E* L, its relative "
            f"deviation {scatter[0]:.3f} and {scatter[1]:.3f}."
        )
    return sentences
