"""What MDR does not model: contact area, mean gap, and punches whose longest wave is a part of the side."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Bounds, Chart, Curve, Panel
from validation.analysis.claims import Claim, times
from validation.analysis.evidence import Table
from validation.analysis.series import Estimates, Margin, Series, Where, masked
from validation.analysis.statistics import (
    FIVE_PER_CENT,
    FloatArray,
    Sample,
    Statistic,
    decade_slope,
    extrapolated,
    log_mean,
    log_relative_deviation,
    sample,
    weighted_mean,
)
from validation.analysis.study import Outcomes, Study
from validation.cases.punch.ensembles import DEVIATION, FEW, FORCE, OVER, PunchEnsembles, change, press
from validation.cases.punch.rough_interface import SPRINGS, Layer, layer_on_half_space
from validation.cases.punch.work import worked
from validation.engine.engine import SERIAL, Engine
from validation.engine.random_numbers import random_generator
from validation.selection import model_needed
from validation.simulation.rough_punch import BEM, BOOTSTRAP, FEW_CELLS, MDR, METHODS, PunchRoughness, require_converged
from validation.theory import closed_forms


@dataclass(frozen=True, kw_only=True)
class MdrLimits(PunchEnsembles):
    """The punches of Fig. 14.1 and others whose spectrum is zero below a roll-off.

    hurst; roll_offs: q_r L / 2 pi, waves of the longest on a side, 1 first; refined: surfaces pressed again on twice as
    many cells a side.
    """

    hurst: float = 0.7
    roll_offs: tuple[int, ...] = (1, 8)
    surfaces: int = 12
    refined: int = 8
    seed: int = 142

    @property
    def shortest(self) -> int:
        """Waves of it on a side."""
        return self.cells // 4

    @property
    def finer(self) -> int:
        """Cells on a side of the finer grid."""
        return 2 * self.cells

    def roughness(self, roll_off: int) -> PunchRoughness:
        """No wave longer than L / roll_off."""
        return self.band(self.hurst, first=roll_off)


def run(case: MdrLimits, engine: Engine = SERIAL) -> Outcomes:
    """Press surfaces and profiles of every roll-off with equal forces: outcomes by roll-off, and cells or "mdr"."""
    surfaces = {
        (roll_off, cells): case.surfaces_of(case.roughness(roll_off), cells, count)
        for roll_off in case.roll_offs
        for cells, count in ((case.cells, case.surfaces), (case.finer, case.refined))
    }
    profiles = {(roll_off, MDR): case.profiles_of(case.roughness(roll_off), case.points) for roll_off in case.roll_offs}
    bem, mdr, unconverged = press(engine, surfaces, profiles)
    return Outcomes(case, {**bem, **mdr}, unconverged)


STIFFNESS, AREA, GAP, ROLL_OFF = "stiffness", "contact fraction", "mean gap", "q_r L / 2π"
EXPONENT = "exponent of the stiffness of the interface"
JUDGED: Mapping[str, tuple[str, Statistic]] = {
    STIFFNESS: ("stiffness", log_mean),
    AREA: ("area", log_mean),
    GAP: ("gap", log_mean),
    DEVIATION: ("stiffness", log_relative_deviation),
}
"""What of an outcome, and which statistic of it."""
MEASURED = ("stiffness", "area", "gap")
MEAN_STIFFNESS, FRACTION, GAP_OVER_H = "k over E* L", "contact fraction A over L²", "mean gap over h"
INTERFACE, SCATTER = "k_i over E* L Fbar", "relative standard deviation of k"
PERSSON = "Persson"
MIN_ROLL_OFF = 4
"""From here on the stiffness of the interface is proportional to the load in theory."""
ZERO_GAP = 1e-12
"""A mean gap over L that counts as none."""
NEAR = Margin(
    FIVE_PER_CENT, "5 %: 0.4 dB, finer than one-third octave levels are measured", source="bem3d, extrapolated"
)
PROPORTIONAL = Margin(
    0.115,
    "half of the distance to 0.77, the largest exponent published for roughness without a roll-off",
    source="stiffness proportional to load: Pastewka et al. (2013), for q_r L / 2π >> 1",
)


@dataclass(frozen=True)
class RollOffSamples:
    """What was measured at one roll-off, resampled, by method and quantity.

    grids: by quantity, on cells and on cells half as wide, a row a surface and a column a level.
    """

    roll_off: int
    by_method: Mapping[tuple[str, str], Sample]
    grids: Mapping[str, tuple[FloatArray, FloatArray]]

    def finer(self, measured: str, statistic: Statistic) -> Estimates:
        """The changes to cells half as wide."""
        return change(statistic, *self.grids[measured])

    def there(self, method: str, measured: str) -> np.ndarray:
        """Levels at which a method has it: in full contact there is no gap."""
        return np.asarray(self.by_method[method, measured].moments[0] > ZERO_GAP)


def resampled(result: Outcomes, roll_off: int) -> RollOffSamples:
    case, by_method, grids = result.case, {}, {}
    for i, measured in enumerate(MEASURED):
        # the gap of full contact is rounding
        coarse, fine, springs = (
            np.maximum(result[roll_off, which][measured], ZERO_GAP) for which in (case.cells, case.finer, MDR)
        )
        for j, (method, values) in enumerate({BEM: coarse, MDR: springs}.items()):
            by_method[method, measured] = sample(values, random_generator(case.seed, BOOTSTRAP, roll_off, i, j))
        grids[measured] = coarse, fine
    return RollOffSamples(roll_off, by_method, grids)


def series(result: Outcomes) -> list[Series]:
    """Area, gap, stiffness and its fluctuation, MDR over boundary elements; the exponents of the interface alone.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    require_converged([o for (_, which), o in result.found.items() if which != MDR], result.unconverged)
    layers = {BEM: layer_on_half_space(case.cells), MDR: SPRINGS}
    found = []
    for roll_off in case.roll_offs:
        mine = resampled(result, roll_off)
        found += [over_bem(case, mine, quantity) for quantity in JUDGED]
        found += [*_exponents(case, mine, layers), *_shown(case, mine, layers)]
        exact = persson_fractions(case, result[roll_off, case.cells]["gradient"])
        found.append(Series(FRACTION, PERSSON, exact, where={ROLL_OFF: roll_off}, along=FORCE, at=case.forces))
    return found


def over_bem(case: MdrLimits, mine: RollOffSamples, quantity: str) -> Series:
    """MDR over boundary elements at the worst force of a decade, of those at which springs have it."""
    measured, statistic = JUDGED[quantity]
    bem, springs = (Estimates(mine.by_method[method, measured].by_level(statistic)) for method in METHODS)
    on_no_size, grid = zip(*map(extrapolated, bem, mine.finer(measured, statistic)), strict=True)
    found = masked(springs - Estimates(on_no_size), mine.there(MDR, measured))
    where, family = {ROLL_OFF: mine.roll_off}, case.family(len(case.roll_offs))
    return case.in_decibels(quantity, OVER, found, where=where, grid=grid, margin=NEAR, fewest=2, family=family)


def _exponents(case: MdrLimits, mine: RollOffSamples, layers: Mapping[str, Layer]) -> Iterator[Series]:
    """d ln kappa / d ln F over each decade; no number where the punch is as stiff as the flat one."""
    family = case.family(len(case.roll_offs))
    judged = partial(Series, EXPONENT, reference=1.0, margin=PROPORTIONAL, family=family)
    for first in case.first_forces if mine.roll_off >= MIN_ROLL_OFF else ():
        for method in METHODS:
            slope = weighted_mean(decade_slope(case.forces, first), layers[method].statistic)
            found, grid = mine.by_method[method, "stiffness"].estimate(slope), 0.0
            if method == BEM:
                found, grid = extrapolated(found, *mine.finer("stiffness", slope))
            where: Where = {ROLL_OFF: mine.roll_off, FORCE: (first, 10 * first)}
            yield judged(method, (found,), where=where, grid=(grid,))


def _shown(case: MdrLimits, mine: RollOffSamples, layers: Mapping[str, Layer]) -> Iterator[Series]:
    """Both methods force by force, boundary elements apart where the mean contact has few cells."""
    few = mine.by_method[BEM, "area"].moments[0] * case.cells**2 < FEW_CELLS
    by_force = partial(Series, where={ROLL_OFF: mine.roll_off}, along=FORCE, at=case.forces)
    for method in METHODS:
        # what of an outcome, its statistic, and what it is divided by
        drawn: dict[str, tuple[str, Statistic, FloatArray | float]] = {
            MEAN_STIFFNESS: ("stiffness", log_mean, 1.0),
            FRACTION: ("area", log_mean, 1.0),
            GAP_OVER_H: ("gap", log_mean, case.height),
            INTERFACE: ("stiffness", layers[method].statistic, np.array(case.forces)),
            SCATTER: ("stiffness", log_relative_deviation, 1.0),
        }
        for quantity, (measured, statistic, unit) in drawn.items():
            logs = Estimates(mine.by_method[method, measured].by_level(statistic))
            found = logs - Estimates.exact(np.log(unit * np.ones(len(logs))))
            known = mine.there(method, measured) & (~few if method == BEM else True)
            yield by_force(quantity, method, masked(found, known), shown=math.exp)
            if method == BEM:
                yield by_force(quantity, FEW, masked(found, few), shown=math.exp)


def persson_fractions(case: MdrLimits, gradient: FloatArray) -> FloatArray:
    """Persson's contact fraction at each force, for the rms gradient of the surfaces."""
    pressures, mean = case.height * np.array(case.forces), float(gradient.mean())
    return np.array([closed_forms.persson_contact_fraction(float(p), gradient=mean) for p in pressures])


def _work(result: Outcomes) -> tuple[Table]:
    case = result.case
    return (worked(case.cells, case.points, [result[roll_off, case.cells] for roll_off in case.roll_offs]),)


def _panel(quantity: str, title: str, *more: Curve, ylim: Bounds | None = None) -> Panel:
    of = partial(Curve, quantity, by=("model", ROLL_OFF))
    bem = of(BEM, "marks", bars=True), of(FEW, "open marks", "_", bars=True)
    return Panel(FORCE, quantity, title=title, log="xy", ylim=ylim).of(*bem, of(MDR, "lines", band=True), *more)


of_ratios = partial(Claim, printed=times)
STUDY = Study(
    title="Where MDR must fail: contact area, mean gap, roughness with a roll-off",
    method=(
        "Punches with H = {c.hurst:g} as in Fig. 14.1, and others whose longest wave goes {c.roll_offs} times into L, "
        "all to {c.shortest} waves on a side. {c.surfaces} surfaces of {c.cells}² cells, {c.profiles} profiles of "
        "{c.points} springs, equal forces. The case compares the true contact area over L² and the share of springs in "
        "contact; the mean gap between the faces over h; the stiffness and its relative deviation; and, with a "
        "roll-off, the exponent of the stiffness of the rough interface alone. That is the uniform layer under a flat "
        "punch that makes it as stiff as the rough one. Boundary elements are extrapolated to first order from "
        "{c.cells}² and {c.finer}² cells on {c.refined} surfaces; ± grid is half of that correction, with its 95 % "
        "interval (jackknife, Student's t). A number over a decade of force is that of its worst force."
    ),
    series=series,
    claims=(
        of_ratios(
            says="MDR has neither the true contact area nor the mean gap of a rough punch.",
            short="MDR's contact area and mean gap beside those of boundary elements",
            quantity=(AREA, GAP),
            differ=True,
        ),
        of_ratios(
            says="MDR has the stiffness of roughness with a roll-off.",
            short="its stiffness with a roll-off over theirs",
            quantity=STIFFNESS,
            where={ROLL_OFF: lambda waves: waves != 1},
        ),
        of_ratios(says="MDR has the relative deviation of the stiffness.", quantity=DEVIATION),
        *(
            Claim(quantity=EXPONENT, model=method).saying(
                f"With a roll-off the stiffness of the rough interface is proportional to the load, by {method}."
            )
            for method in METHODS
        ),
    ),
    charts=(
        Chart("mdr_limits", columns=2, height=7.0).of(
            "Symbols: boundary elements, 95 % of the sample, open where the mean contact has few cells; lines in "
            "bands: MDR, L_1D = L; dark to light: q_r L / 2π = {c.roll_offs}. (a) Contact fraction; dotted: Persson's "
            "erf(√2 p / (E* g)), g the rms gradient. (b) Mean gap over h. (c) Stiffness of the interface alone over "
            "the force. (d) Relative deviation of the stiffness.",
            _panel(FRACTION, "contact fraction", Curve(FRACTION, PERSSON, "dotted", PERSSON, by=(ROLL_OFF,))),
            _panel(GAP_OVER_H, "mean gap", ylim=(0.02, None)),
            _panel(INTERFACE, "interface: constant if k ~ F"),
            _panel(SCATTER, "fluctuation of the punch"),
        ),
    ),
    tables=_work,
)
CASE = Case(
    name="mdr_limits",
    chapter=Chapter.PRESSED,
    place=3,
    answers="Where MDR fails by its assumptions: true contact area, mean gap, stiffness with a roll-off",
    quick=MdrLimits(surfaces=8, refined=4),
    full=MdrLimits(
        roll_offs=(1, 8, 16), cells=256, surfaces=30, refined=12, profiles=500, decades=(-3, 1), per_decade=3
    ),
    run=run,
    study=STUDY,
    needs=model_needed.rolled_off,
)
