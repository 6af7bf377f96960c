"""Where MDR must fail: true contact area, mean gap, and roughness with a roll-off: stiffness proportional to load."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import LinearOperator, cg

import bem3d
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Verdict, table_of
from validation.analysis.statistics import (
    DECIBEL,
    FIVE_PER_CENT,
    Estimate,
    FloatArray,
    Sample,
    Statistic,
    at_level,
    decade_slope,
    decade_weights,
    difference_of_halves,
    extrapolated,
    local_slope,
    log_deviation_over,
    log_mean,
    log_relative_deviation,
    nearest,
    paired_samples,
    sample,
    weighted_mean,
)
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome, random_generator
from validation.selection import model_needed
from validation.simulation.rough_punch import (
    BEM,
    BOOTSTRAP,
    FEW_CELLS,
    MDR,
    METHODS,
    Profiles,
    PunchRoughness,
    Surface,
    describe_failures,
    force_levels,
    press_profiles,
    press_surface,
    require_converged,
    stacked,
)
from validation.theory import closed_forms

Row = dict[str, float]

MEASURED = {"stiffness": "stiffness", "area": "contact fraction", "gap": "mean gap"}
WIDE = 4
"""A roll-off q_r L / 2 pi from which on the interface is a matter of its own."""
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

    def roughness(self, roll_off: int) -> PunchRoughness:
        """No wave longer than L / roll_off, none shorter than four cells."""
        return PunchRoughness(hurst=self.hurst, waves=(roll_off, self.cells // 4), height=self.height, seed=self.seed)


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
        describe_failures(surfaces, outcomes),
    )


@dataclass(frozen=True)
class RollOffSamples:
    """What was measured at one roll-off, resampled: by method and quantity; and by quantity, pairs of grids."""

    roll_off: int
    by_method: dict[tuple[str, str], Sample]
    grids: dict[str, Sample]

    def open(self, weights: FloatArray) -> bool:
        """Whether there is a gap in one dimension at all of these levels: none is left in full contact."""
        mean, _ = self.by_method[MDR, "gap"].moments
        return bool((mean[weights > 0] > CLOSED).all())

    def extrapolated(self, quantity: str, statistic: Statistic) -> tuple[Estimate, float]:
        """Boundary elements on cells of no size, and what that leaves open."""
        bem = self.by_method[BEM, quantity].estimate(statistic)
        return extrapolated(bem, self.grids[quantity].estimate(difference_of_halves(statistic)))

    def apart(self, label: str, quantity: str, statistic: Statistic) -> Number:
        """MDR over boundary elements in decibels."""
        bem, grid = self.extrapolated(quantity, statistic)
        apart = self.by_method[MDR, quantity].estimate(statistic).minus(bem)
        return Number(
            quantity=f"{label}: mdr over bem3d",
            value=DECIBEL * apart.value,
            reference=0.0,
            source="bem3d, extrapolated",
            tolerance=FIVE_PER_CENT,
            unit="dB",
            reason="5 %: 0.4 dB, less than a third-octave level resolves",
            grid=DECIBEL * grid,
            sample=DECIBEL * apart.half_width,
            role=Role.FINDING,
        )


def evidence(result: MdrLimitsResult) -> Evidence:
    """Area, gap, stiffness and its fluctuation, MDR over boundary elements; the exponents of the interface alone.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    require_converged((*result.bem.values(), *result.refined.values()), result.unconverged)
    samples = {roll_off: _samples(result, roll_off) for roll_off in case.roll_offs}
    layers = {BEM: layer_on_half_space(case.cells), MDR: SPRINGS}
    numbers = []
    for power in range(*case.decades):
        first = 10.0**power
        weights = decade_weights(case.forces, first)
        for roll_off, mine in samples.items():
            where = f"q_r L / 2π = {roll_off}, Fbar = {first:g} to {10 * first:g}"
            numbers += [
                mine.apart(f"{name}, {where}", quantity, weighted_mean(weights, log_mean))
                for quantity, name in MEASURED.items()
                if quantity != "gap" or mine.open(weights)
            ]
            numbers.append(mine.apart(f"relative deviation, {where}", "stiffness", log_deviation_over(weights)))
            if roll_off >= WIDE:
                slopes = [_proportional(case, mine, layers, method, first) for method in METHODS]
                numbers += [slope for slope in slopes if slope is not None]
    curves = [row for mine in samples.values() for row in _curve(result, layers, mine)]
    return Evidence(
        title="Where MDR must fail: contact area, mean gap, roughness with a roll-off",
        method=(
            f"Punches with H = {case.hurst:g} as in Fig. 14.1, and others without waves longer than L over "
            f"{', '.join(map(str, case.roll_offs[1:]))}, all to {case.cells // 4} waves on a side. {case.surfaces} "
            f"surfaces of {case.cells}² cells, {case.profiles} profiles of {case.points} springs, equal forces. True "
            "contact area over L² beside springs in contact over all; mean gap between the faces over h; stiffness, "
            "its relative deviation; and, where there is a roll-off, the exponent of the stiffness of the rough "
            "interface alone: of the uniform layer under a flat punch that makes it as stiff. Boundary elements are "
            f"extrapolated to first order from {case.cells}² and {2 * case.cells}² cells on {case.refined} surfaces; "
            "± grid is half of that way, and the interval of what it rests on."
        ),
        numbers=tuple(numbers),
        tables=(table_of("curves", curves),),
        conclusions=tuple(_conclusions(result, samples, numbers)),
        captions={
            "mdr_limits": (
                f"Symbols: boundary elements on {case.cells}² cells, 95 % intervals of the sample, open where the mean "
                f"contact has fewer than {FEW_CELLS} cells; lines in bands: MDR, L_1D = L. (a) Contact fraction; "
                "dotted: Persson's erf(√2 p / (E* h')) for the mean pressure p and the rms slope h' of the surfaces. "
                "(b) Mean gap over h. (c) Stiffness of the interface alone over the force: level where it is "
                "proportional to the load. (d) Relative deviation of the stiffness of the punch. Dark to light: "
                f"q_r L / 2π = {', '.join(map(str, case.roll_offs))}."
            )
        },
        unconverged=result.unconverged,
    )


def _samples(result: MdrLimitsResult, roll_off: int) -> RollOffSamples:
    case = result.case
    outcomes = {BEM: result.bem[roll_off], MDR: result.mdr[roll_off]}
    by_method, grids = {}, {}
    for i, quantity in enumerate(MEASURED):
        for j, (method, outcome) in enumerate(outcomes.items()):
            # full contact has no gap but rounding's
            values = np.maximum(outcome[quantity], CLOSED)
            by_method[method, quantity] = sample(values, random_generator(case.seed, BOOTSTRAP, roll_off, i, j))
        coarse, fine = outcomes[BEM][quantity][: case.refined], result.refined[roll_off][quantity]
        grids[quantity] = paired_samples(coarse, fine, random_generator(case.seed, BOOTSTRAP, roll_off, i, 2))
    return RollOffSamples(roll_off, by_method, grids)


@dataclass(frozen=True)
class Layer:
    """A flat punch on a uniform elastic layer of stiffness kappa an area, over E* / L: the rough interface alone.

    In one dimension the layer is in series with every spring, k = 1 / (1/kappa + 1). On the half-space it is not in
    series with the whole punch, since a soft layer presses evenly and a stiff one as the flat punch does: there k
    belongs to (K + 1 / kappa) p = 1. excess: ln kappa less that of the series, at part: k over k_flat, ascending.
    """

    flat: float
    part: FloatArray
    excess: FloatArray

    def log_kappa(self, stiffness: FloatArray) -> FloatArray:
        """ln kappa of a punch of this k / (E* L); NaN where it is as stiff as the flat one."""
        with np.errstate(divide="ignore", invalid="ignore"):
            series = -np.log(1 / stiffness - 1 / self.flat)
        return np.where(np.isfinite(series), series + np.interp(stiffness / self.flat, self.part, self.excess), np.nan)


SPRINGS = Layer(1.0, np.array([0.0, 1.0]), np.zeros(2))


def layer_on_half_space(cells: int) -> Layer:
    """k of kappa on so many cells a side, by conjugate gradients."""
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)
    ones = np.ones(half_space.shape)
    flat = bem3d.solve_fixed_area(half_space, ones > 0).stiffness
    kappas, stiffness = np.geomspace(1e-3, 1e3, 37), []
    pressure = ones.ravel()
    for kappa in kappas:

        def displacement(p: FloatArray, kappa: float = kappa) -> FloatArray:
            return half_space.displacement(p.reshape(cells, cells)).ravel() + p / kappa

        operator = LinearOperator((cells**2, cells**2), matvec=displacement, dtype=np.float64)
        pressure, status = cg(operator, ones.ravel(), x0=kappa * pressure, rtol=1e-6)
        if status:
            raise NotConvergedError(f"the flat punch on a layer of stiffness {kappa:g} did not converge")
        stiffness.append(float(pressure.sum()) / cells**2)
        pressure = pressure / kappa
    found = np.array(stiffness)
    series = -np.log(1 / found - 1 / flat)
    return Layer(
        flat, np.append(found / flat, 1.0), np.append(np.log(kappas) - series, np.log(kappas[-1]) - series[-1])
    )


def _interface(layer: Layer) -> Statistic:
    """ln of the stiffness of the interface alone, from the mean stiffness of the punch, level by level."""
    return lambda mean, deviation: layer.log_kappa(mean)


def _proportional(
    case: MdrLimits, mine: RollOffSamples, layers: dict[str, Layer], method: str, first: float
) -> Number | None:
    """d ln kappa / d ln F over a decade; None where the punch is as stiff as the flat one."""
    slope = weighted_mean(decade_slope(case.forces, first), _interface(layers[method]))
    found, grid = mine.by_method[method, "stiffness"].estimate(slope), 0.0
    if method == BEM:
        found, grid = mine.extrapolated("stiffness", slope)
    if not np.isfinite([found.value, found.error, grid]).all():
        return None
    return Number(
        quantity=f"exponent of the interface, q_r L / 2π = {mine.roll_off}, Fbar = {first:g} to "
        f"{10 * first:g}: {method}",
        value=found.value,
        reference=1.0,
        source="stiffness proportional to load: Pastewka et al. (2013), for q_r L / 2π >> 1",
        tolerance=0.115,
        reason="half of the way to 0.77, the largest exponent published for roughness without a roll-off",
        grid=grid,
        sample=found.half_width,
        role=Role.FINDING,
    )


def _curve(result: MdrLimitsResult, layers: dict[str, Layer], mine: RollOffSamples) -> list[Row]:
    """One row a force."""
    case, roll_off = result.case, mine.roll_off
    outcome = result.bem[roll_off]
    rows = []
    for level, force in enumerate(case.forces):
        row = {"q_r L / 2π": float(roll_off), "Fbar": force}
        for method in METHODS:
            for quantity, name in MEASURED.items():
                found = mine.by_method[method, quantity].estimate(at_level(level, log_mean))
                unit = case.height if quantity == "gap" else 1.0
                row |= _interval(f"{method} {name}", found, unit)
            stiffness = mine.by_method[method, "stiffness"]
            row |= _interval(
                f"{method} relative deviation", stiffness.estimate(at_level(level, log_relative_deviation))
            )
            row |= _interval(f"{method} interface", stiffness.estimate(at_level(level, _interface(layers[method]))))
            slope = weighted_mean(local_slope(case.forces, level), _interface(layers[method]))
            row[f"{method} exponent of the interface"] = stiffness.estimate(slope).value
        row["Persson contact fraction"] = closed_forms.persson_contact_fraction(
            case.height * force, gradient=float(outcome["gradient"].mean())
        )
        row["bem3d cells in contact"] = row["bem3d contact fraction"] * case.cells**2
        rows.append(row)
    return rows


def _interval(name: str, found: Estimate, unit: float = 1.0) -> Row:
    named = zip(("", " low", " high"), found.interval, strict=True)
    return {f"{name}{end}": math.exp(value) / unit for end, value in named}


def _conclusions(result: MdrLimitsResult, samples: dict[int, RollOffSamples], numbers: list[Number]) -> list[str]:
    """In words, and at one force; and how proportional the stiffness is."""
    case = result.case
    level = nearest(case.forces, 0.1)
    units = {"area": 1.0, "gap": case.height, "stiffness": 1.0}
    of_no_meaning = [n for n in numbers if n.label.startswith((MEASURED["area"], MEASURED["gap"]))]
    confirmed = "" if all(n.verdict is Verdict.DIFFER for n in of_no_meaning) else "Not confirmed at every load here: "
    sentences = [
        f"{confirmed}MDR is no model of contact area and gap: more springs are in contact than there is true contact, "
        "and their gap is smaller than that of the faces and closes while these are still apart."
    ]
    for roll_off, mine in samples.items():
        beside = {
            quantity: f"{_with_interval(*mine.extrapolated(quantity, at_level(level, log_mean)), units[quantity])} and "
            f"{math.exp(mine.by_method[MDR, quantity].estimate(at_level(level, log_mean)).value) / units[quantity]:.3g}"
            for quantity in units
        }
        law = closed_forms.persson_contact_fraction(
            case.height * case.forces[level], gradient=float(result.bem[roll_off]["gradient"].mean())
        )
        deviation = at_level(level, log_relative_deviation)
        sentences.append(
            f"q_r L / 2π = {roll_off}, Fbar = {case.forces[level]:.2g}, boundary elements (extrapolated, with their "
            f"interval) and MDR: contact fraction {beside['area']} (Persson {law:.2g}), mean gap {beside['gap']} h, "
            f"stiffness {beside['stiffness']} E* L, relative deviation "
            f"{_with_interval(*mine.extrapolated('stiffness', deviation), 1.0)} and "
            f"{math.exp(mine.by_method[MDR, 'stiffness'].estimate(deviation).value):.3g}."
        )
    slopes = [n for n in numbers if n.label.startswith("exponent of the interface")]
    for method in METHODS:
        found = "; ".join(
            f"{n.label.removeprefix('exponent of the interface, ').removesuffix(f': {method}')}: {n.value:.2f} ± "
            f"{n.uncertainty:.2f} ({n.verdict})"
            for n in slopes
            if n.label.endswith(method)
        )
        if found:
            sentences.append(
                f"Stiffness of the interface as a power of the load, {method}, 1 if proportional: {found}."
            )
    return sentences


def _with_interval(found: Estimate, grid: float, unit: float) -> str:
    half = found.half_width + grid
    middle, low, high = (math.exp(value) / unit for value in (found.value, found.value - half, found.value + half))
    return f"{middle:.3g} ({low:.2g} to {high:.2g})"


CASE = Case(
    name="mdr_limits",
    chapter=Chapter.PRESSED,
    place=3,
    claim="One dimension has neither the true area nor the gap, nor the stiffness of roughness with a roll-off.",
    answers="Where MDR must fail: true contact area, mean gap, stiffness with a roll-off",
    quick=MdrLimits(),
    full=MdrLimits(
        roll_offs=(1, 8, 16), cells=256, surfaces=30, refined=8, profiles=500, decades=(-3, 1), per_decade=3
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.rolled_off,
)
