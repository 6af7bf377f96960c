"""What the ensembles of rough punches say: means, fluctuations and exponents, decade by decade, errors apart."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, Number, Role, Table, VerdictCell, table_of
from validation.analysis.statistics import (
    Estimate,
    at_level,
    local_slope,
    log_mean,
    log_relative_deviation,
    nearest,
    weighted_mean,
)
from validation.cases.punch.fractal_punch import Ensemble, FractalPunch, FractalPunchResult, run
from validation.cases.punch.fractal_punch_decades import (
    LONG,
    QUANTITIES,
    DecadeComparison,
    EnsembleSamples,
    compare,
    data_row,
    matrix,
    mean_over_hursts,
    resampled,
    summary,
)
from validation.engine.engine import Outcome
from validation.selection import model_needed
from validation.simulation.rough_punch import BEM, FEW_CELLS, MDR, require_converged
from validation.theory import closed_forms

Row = dict[str, float]

PUBLISHED = (0.51, 0.77)
"""Exponents of fractal dimensions 2 to 3; Pohrt and Popov, Phys. Rev. Lett. 108, 104301 (2012), abstract."""
CLAIMED = 3.0
"""Decibels within which 1D springs follow a 3D analysis of rolling; Ford and Thompson, J. Sound Vib. 293 (2006)."""


def evidence(result: FractalPunchResult) -> Evidence:
    """Means, fluctuations and exponents of both methods apart, with what grid and sample leave open.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    for ensemble in result.ensembles:
        require_converged((ensemble.bem, ensemble.coarser, ensemble.finer), result.unconverged)
    samples = [resampled(case, h, ensemble) for h, ensemble in enumerate(result.ensembles)]
    comparisons = _comparisons(case, samples)
    numbers = [n for c in comparisons if (n := c.number) is not None]
    laws = _laws(case, comparisons)
    criteria = (
        _convex(result, BEM),
        _convex(result, MDR),
        _bounded(result, closed_forms.SQUARE_PUNCH),
        _no_factor_lost([n for c in comparisons if _resolved(result, c) and (n := c.number) is not None]),
    )
    curves = [row for e, mine in zip(result.ensembles, samples, strict=True) for row in _curve(case, e, mine)]
    grids = [row for e, mine in zip(result.ensembles, samples, strict=True) for row in _grids(case, e, mine)]
    return Evidence(
        title="Fractal punch (Fig. 14.1)",
        method=_method(case),
        numbers=(*criteria, *_claimed(comparisons), *laws, *numbers),
        tables=(
            table_of("curves", curves),
            table_of("decades", list(map(data_row, comparisons))),
            table_of("grids", grids),
        ),
        page_tables=(*(matrix(case, name, comparisons) for name in QUANTITIES), _law_table(case, laws)),
        conclusions=(
            *(summary(name, comparisons) for name in QUANTITIES),
            *_saturation(curves),
            _cost(result),
        ),
        captions=_captions(case),
        unconverged=result.unconverged,
    )


def _comparisons(case: FractalPunch, samples: list[EnsembleSamples]) -> list[DecadeComparison]:
    """Of every quantity, one a Hurst exponent and a decade, and the means over the exponents."""
    comparisons = []
    for name in QUANTITIES:
        for power in range(*case.decades):
            mine = [compare(case, h, s, name, 10.0**power) for h, s in zip(case.hursts, samples, strict=True)]
            comparisons += [*mine, mean_over_hursts(mine)] if len(mine) > 1 else mine
    # by exponent and then by decade, the means last
    return sorted(comparisons, key=lambda c: (list(QUANTITIES).index(c.name), c.hurst is None, c.hurst or 0.0))


def _method(case: FractalPunch) -> str:
    coarser, cells, finer = case.grids
    return (
        f"A rigid square punch of side L, rough from q_min = 2π/L to {cells // 4} q_min, no roll-off, amplitudes fixed "
        f"by the spectrum as in (14.8), so that every draw has its rms height h exactly. {case.surfaces} surfaces of "
        f"{cells}² cells under boundary elements, {case.profiles} profiles of {case.points} springs of Geike's "
        "spectrum, at equal forces; Fbar = F / (E* h L), kbar = k / (E* L). Stiffness of the frozen contact (3D) and "
        "of the springs in contact (1D). Statistics are means over a decade of force (of the deviation: root mean "
        f"square). Three errors apart. Sample: 95 % interval, bootstrap over realisations. Grid: {case.refined} of the "
        f"surfaces, and up to Fbar = {case.light:g} all of them, the same band, pressed on {coarser}² and {finer}² "
        "cells too; the difference is to boundary elements extrapolated to first order from the finer two, and ± grid "
        "is how far the extrapolation from the coarser two lies from it, with the interval of the change, and what "
        "half as many springs change. What remains is the model's. Where a verdict is open, so many realisations would "
        'tell if value and grid error stayed; "the grid must tell first": no number of them would, as long as the grid '
        "error, which more refined surfaces or finer cells lower, is that large."
    )


def _captions(case: FractalPunch) -> dict[str, str]:
    interval = "95 % interval of the sample"
    few = f"open where the mean contact has fewer than {FEW_CELLS} cells"
    return {
        "fractal_punch": (
            f"Relative standard deviation of the stiffness against force, Fbar = F / (E* h L). (a) {case.surfaces} "
            f"surfaces under three-dimensional boundary elements, {case.cells}² cells; {few}. (b) {case.profiles} "
            "profiles of springs, L_1D = L; lines end where all springs of all profiles are in contact. Intervals: in "
            "the next figure."
        ),
        "fractal_punch-overlay": (
            f"The same, laid over each other. Circles: boundary elements, {interval}; {few}. Line in a band: MDR with "
            "L_1D = L and its interval; dashed: MDR with L_1D = 1.1523 L."
        ),
        "fractal_punch-difference": (
            f"Relative deviation of MDR over that of boundary elements. Circles: at each force on {case.cells}² cells, "
            f"{interval}; {few}; ratios below the axis, and those of a deviation that is zero, are not drawn. Thick: "
            "root mean square over each decade, which the lightest forces of the last one rule, boundary elements "
            "extrapolated to cells of no size; the thin box holds sample and grid. Grey: the tolerance of 3 %; dotted: "
            "3 dB. = agree, ≠ differ, ? undecided."
        ),
        "fractal_punch-mean": (
            f"Mean stiffness kbar = k / (E* L). Circles: boundary elements, {interval}; {few}. Full line: MDR with "
            "L_1D = L; dashed: L_1D = 1.1523 L. Dotted: slope 1 / (1 + H), through the boundary elements at the middle "
            "of the forces."
        ),
        "fractal_punch-exponent": (
            "Local exponent d ln k / d ln F of the mean stiffness, between neighbouring forces. Circles: boundary "
            f"elements, {interval}; {few}. Full line in a band: MDR, L_1D = L; dashed: L_1D = 1.1523 L. Dotted: "
            f"1 / (1 + H). Grey: the published exponents of fractal dimensions 2 to 3, {PUBLISHED[0]} to "
            f"{PUBLISHED[1]}."
        ),
    }


def _convex(result: FractalPunchResult, method: str) -> Number:
    """F(d) is convex: between two forces its slope lies between the stiffnesses at both."""
    force = result.case.height * np.array(result.case.forces)
    excess = [0.0]
    for ensemble in result.ensembles:
        outcome = _of(ensemble, method)
        slope = np.diff(force) / np.diff(outcome["approach"], axis=1)
        stiffness = outcome["stiffness"]
        excess += [float(np.nanmax(stiffness[:, :-1] / slope)) - 1, float(np.nanmax(slope / stiffness[:, 1:])) - 1]
    return Number(
        quantity=f"{method}: slope of the load curve outside the stiffnesses at its two ends, largest excess",
        value=max(excess),
        reference=0.0,
        source="F(d) is convex",
        tolerance=100 * result.case.tolerance,
        reason="force, approach and stiffness of every realisation fit together; residual of the solver, and two "
        "digits lost in the difference of approaches",
    )


def _bounded(result: FractalPunchResult, flat: float) -> Number:
    """No rough punch is stiffer than the flat one, and the largest force comes near it."""
    largest = max(float(np.nanmax(ensemble.bem["stiffness"])) for ensemble in result.ensembles)
    deficit = 2 / result.case.cells
    return Number(
        quantity=f"{BEM}: largest stiffness of any surface over that of the flat punch, {flat:g} E* L",
        value=largest / flat,
        reference=1.0 - deficit / 2,
        source="flat punch",
        tolerance=deficit / 2,
        reason=f"never stiffer than all cells together, and no more than two cells a side ({deficit:.2g}) softer at "
        "the largest force",
    )


def _resolved(result: FractalPunchResult, comparison: DecadeComparison) -> bool:
    """A mean stiffness in a decade whose lightest contacts have cells enough at every Hurst exponent."""
    case = result.case
    level = nearest(case.forces, comparison.first)
    cells = [float(np.nanmean(e.bem["area"][:, level])) * case.cells**2 for e in result.ensembles]
    heaviest = comparison.first == 10.0 ** (case.decades[1] - 1)
    return comparison.name == "mean stiffness" and (min(cells) >= FEW_CELLS or heaviest)


def _no_factor_lost(numbers: list[Number]) -> Number:
    """The two methods are independent: a fault in one of them shows where they may be farthest apart."""
    farthest = max(numbers, key=lambda number: abs(number.value) + number.uncertainty)
    return replace(
        farthest,
        quantity=f"no factor is lost, where it may be worst: {farthest.label}",
        tolerance=3.0,
        reason="k ~ F^(1/(1+H)): a factor 2 lost in the force, or half of the length, is 3 dB or more for H <= 1",
        role=Role.CRITERION,
    )


def _claimed(comparisons: list[DecadeComparison]) -> tuple[Number, ...]:
    """The fluctuations, where they are farthest apart, beside what is claimed of rolling."""
    deviations = [n for c in comparisons if c.name == "relative deviation" and (n := c.number) is not None]
    if not deviations:
        return ()
    farthest = max(deviations, key=lambda number: abs(number.value) + number.uncertainty)
    return (
        replace(
            farthest,
            quantity=f"within {CLAIMED:g} dB, where it may be worst: {farthest.label}",
            tolerance=CLAIMED,
            reason="what is claimed of 1D beside 3D models of rolling noise: Ford and Thompson (2006)",
        ),
    )


def _of(ensemble: Ensemble, method: str) -> Outcome:
    return {BEM: ensemble.bem, MDR: ensemble.mdr, LONG: ensemble.long}[method]


def _curve(case: FractalPunch, ensemble: Ensemble, samples: EnsembleSamples) -> list[Row]:
    """One row a force: the statistics of both methods with their 95 % intervals, and the ratio of the deviations."""
    rows = []
    for level, force in enumerate(case.forces):
        row = {"H": ensemble.hurst, "Fbar": force}
        slope = weighted_mean(local_slope(case.forces, level), log_mean)
        for method, mine in samples.methods.items():
            row |= _interval(f"{method} mean stiffness", mine.estimate(at_level(level, log_mean)), math.exp)
            row |= _interval(
                f"{method} relative deviation", mine.estimate(at_level(level, log_relative_deviation)), math.exp
            )
            row |= _interval(f"{method} exponent", mine.estimate(slope), float)
        apart = [samples.methods[method].estimate(at_level(level, log_relative_deviation)) for method in (MDR, BEM)]
        row |= _interval("mdr over bem3d relative deviation", apart[0].minus(apart[1]), math.exp)
        row["bem3d contact fraction"] = float(np.nanmean(ensemble.bem["area"][:, level]))
        row["bem3d cells in contact"] = row["bem3d contact fraction"] * case.cells**2
        row["mdr contact fraction"] = float(ensemble.mdr["area"][:, level].mean())
        row["bem3d applications"] = float(np.mean(ensemble.bem["applications"][:, level]))
        row["bem3d applications of the stiffness"] = float(np.mean(ensemble.bem["frozen applications"][:, level]))
        row["bem3d surfaces"] = int(np.isfinite(ensemble.bem["stiffness"][:, level]).sum())
        rows.append(row)
    return rows


def _interval(name: str, found: Estimate, value: Callable[[float], float]) -> Row:
    return {f"{name}{end}": float(value(v)) for end, v in zip(("", " low", " high"), found.interval, strict=True)}


def _grids(case: FractalPunch, ensemble: Ensemble, samples: EnsembleSamples) -> list[Row]:
    """One row a force of the refined surfaces: both statistics on three grids, and extrapolated."""
    rows = []
    half = len(case.refined_forces)
    for level, force in enumerate(case.refined_forces):
        surfaces = np.isfinite(ensemble.finer["stiffness"][:, level]).sum()
        row = {"H": ensemble.hurst, "Fbar": force, "surfaces": float(surfaces)}
        for name, statistic in (("mean stiffness", log_mean), ("relative deviation", log_relative_deviation)):
            grids = (samples.coarser, level), (samples.finer, level), (samples.finer, half + level)
            values = [s.estimate(at_level(place, statistic)).value for s, place in grids]
            for cells, value in zip(case.grids, values, strict=True):
                row[f"{name}, {cells}²"] = math.exp(value)
            row[f"{name}, extrapolated"] = math.exp(2 * values[2] - values[1])
        rows.append(row)
    return rows


def _laws(case: FractalPunch, comparisons: list[DecadeComparison]) -> list[Number]:
    """Exponents beside 1 / (1 + H), where the law should hold best: off the last asperity and off saturation."""
    decades = [10.0**power for power in range(*case.decades)]
    first = min(decades, key=lambda force: abs(math.log(force / 0.01)))
    mine = [c for c in comparisons if c.name == "exponent" and c.hurst is not None and c.first == first]
    return [number for c in mine for number in (_law(c, BEM), _law(c, MDR))]


def _law(comparison: DecadeComparison, method: str) -> Number:
    hurst, first = comparison.hurst or 0.0, comparison.first
    found, grid = (
        (comparison.extrapolated, comparison.left)
        if method == BEM
        else (comparison.springs, abs(comparison.refined_springs.value))
    )
    return Number(
        quantity=f"exponent at H = {hurst:g}, Fbar = {first:g} to {10 * first:g}: {method}",
        value=found.value,
        reference=1 / (1 + hurst),
        source="1 / (1 + H)",
        tolerance=QUANTITIES["exponent"].tolerance,
        reason=QUANTITIES["exponent"].reason,
        grid=grid,
        sample=found.half_width,
        role=Role.FINDING,
    )


def _law_table(case: FractalPunch, laws: list[Number]) -> Table:
    """On the page: a row a Hurst exponent."""

    def column(numbers: list[Number]) -> list[object]:
        return [VerdictCell(f"{n.value:.3f} ± {n.uncertainty:.3f}", n.verdict) for n in numbers]

    first, *_ = (n.label.split(", ")[1].split(":")[0] for n in laws)
    return Table(
        f"exponent of the mean stiffness beside 1 / (1 + H), {first}; published for fractal dimensions 2 to 3: "
        f"{PUBLISHED[0]} to {PUBLISHED[1]}",
        {
            "H": [f"{hurst:g}" for hurst in case.hursts],
            "1 / (1 + H)": [f"{n.reference:.3f}" for n in laws[::2]],
            "boundary elements, extrapolated": column(laws[::2]),
            "MDR, L_1D = L": column(laws[1::2]),
        },
    )


def _saturation(rows: list[Row]) -> tuple[str, ...]:
    """Where the springs have no fluctuation left and the boundary elements still have."""
    still = [row for row in rows if row["mdr relative deviation"] == 0]
    first = {row["H"]: row for row in reversed(still)}
    if not first:
        return ()
    found = [
        f"H = {h:g} from Fbar = {row['Fbar']:.3g} on ({row['bem3d relative deviation']:.2g})"
        for h, row in sorted(first.items())
    ]
    return (
        "All springs of all profiles are in contact, and MDR has no fluctuation left (boundary elements have, in "
        "brackets): " + ", ".join(found) + ".",
    )


def _cost(result: FractalPunchResult) -> str:
    """What a solve takes."""
    contacts = np.concatenate([e.bem["applications"].ravel() for e in result.ensembles])
    frozen = np.concatenate([e.bem["frozen applications"].ravel() for e in result.ensembles])
    return (
        f"{contacts.size} contacts with their stiffness on {result.case.cells}² cells took "
        f"{np.mean(contacts + frozen):.1f} operator applications each in the mean, {contacts.mean():.1f} for the "
        f"contact (at most {contacts.max():.0f}) and {frozen.mean():.1f} for the stiffness (at most "
        f"{frozen.max():.0f}), on the smallest window that holds the contact."
    )


CASE = Case(
    name="fractal_punch",
    chapter=Chapter.PRESSED,
    place=1,
    claim="One dimension has the mean stiffness of rough punches, and its fluctuation (Fig. 14.1).",
    answers="Fig. 14.1: mean and fluctuation of the contact stiffness of rough punches",
    quick=FractalPunch(),
    full=FractalPunch(cells=256, surfaces=60, profiles=500, per_decade=6, refined=6, refined_per_decade=2),
    run=run,
    evidence=evidence,
    needs=model_needed.punches,
)
