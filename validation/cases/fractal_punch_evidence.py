"""What the ensembles of rough punches say: means and fluctuations of the stiffness, both methods in decibels apart."""

from dataclasses import dataclass, replace
from itertools import chain

import numpy as np

from validation import closed_forms
from validation.cases.fractal_punch import Ensemble, FractalPunch, FractalPunchResult
from validation.ensemble import Outcome, generator
from validation.evidence import Evidence, NotConvergedError, Number, Role, Table, Verdict
from validation.statistics import Estimate, Statistic, estimate, log_mean, log_relative_deviation, paired_change

Row = dict[str, float]

DECIBEL = 20 / np.log(10)
# a contact of fewer cells is under-resolved
FEW_CELLS = 30
# the spawn key of the bootstrap; profiles and surfaces have theirs
BOOTSTRAP = 3


@dataclass(frozen=True)
class Compared:
    """A statistic of one 1D model beside that of the boundary elements, and how near they should be [dB]."""

    statistic: Statistic
    method: str
    tolerance: float
    reason: str


THIRD_OCTAVE = "12 %, what a third-octave level can tell"
COMPARED = {
    "mean stiffness": Compared(log_mean, "mdr", 1.0, THIRD_OCTAVE),
    "mean stiffness with L_1D = 1.1523 L": Compared(log_mean, "mdr 1.1523 L", 1.0, THIRD_OCTAVE),
    "relative deviation": Compared(
        log_relative_deviation, "mdr", 3.0, "what is claimed of 1D against 3D models: Ford and Thompson (2006)"
    ),
}


def evidence(result: FractalPunchResult) -> Evidence:
    """Means and fluctuations of both methods in decibels apart, with what grid and sample leave open.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    fewest = min(int(np.isfinite(e.bem["stiffness"]).sum(axis=0).min()) for e in result.ensembles)
    if fewest < 3:
        raise NotConvergedError(f"{fewest} surfaces converged at one of the forces, 3 are needed", result.unconverged)
    apart = {name: [_apart(case, h, e, name) for h, e in enumerate(result.ensembles)] for name in COMPARED}
    criteria = (
        _convex(result, "bem3d"),
        _convex(result, "mdr"),
        _bounded(result, "bem3d", closed_forms.SQUARE_PUNCH),
        *(_no_factor_lost(numbers) for numbers in apart["mean stiffness"]),
    )
    rows = [row for h, ensemble in enumerate(result.ensembles) for row in _rows(case, h, ensemble)]
    return Evidence(
        title="Fractal punch (Fig. 14.1)",
        compared=(
            f"A rigid square punch of side L, rough from q_min = 2π/L to {case.cells // 4} q_min, no roll-off. "
            f"{case.surfaces} surfaces of {case.cells}² cells under boundary elements, {case.profiles} profiles of "
            f"{case.points} springs of Geike's spectrum, L_1D = L, at equal forces; Fbar = F / (E* h L), "
            "kbar = k / (E* L) on both sides, h exact in every draw. Stiffness of the frozen contact (3D) and of the "
            f"springs in contact (1D). Grid error, an estimate: what cells half as wide changed on {case.refined} "
            "surfaces, with its own standard error, twice (first order); and what half as many springs change."
        ),
        numbers=(*criteria, *chain.from_iterable(chain.from_iterable(apart.values()))),
        tables=(Table("curves", {name: [row[name] for row in rows] for name in rows[0]}),),
        conclusions=(
            *(_summary(name, list(chain.from_iterable(numbers))) for name, numbers in apart.items()),
            *_saturation(rows),
            _area(case, result.ensembles),
        ),
        caption=(
            "Above: mean stiffness k / (E* L) against force Fbar = F / (E* h L). Below: its relative standard "
            "deviation. Circles: boundary elements, 95 % intervals of the sample alone, open where the mean contact "
            f"has fewer than {FEW_CELLS} cells. Full line in a band: MDR with L_1D = L and its 95 % interval; dashed: "
            "MDR with L_1D = 1.1523 L. Below, the lines end where all springs of all profiles are in contact and no "
            "deviation is left. Dotted: slope 1 / (1 + H), through the boundary elements at Fbar = 0.1."
        ),
        unconverged=result.unconverged,
    )


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
        label=f"{method}: slope of the load curve outside the stiffnesses at its two ends, largest excess",
        value=max(excess),
        reference=0.0,
        source="F(d) is convex",
        tolerance=100 * result.case.tolerance,
        reason="force, approach and stiffness of every realisation fit together; residual of the solver, and two "
        "digits lost in the difference of approaches",
    )


def _bounded(result: FractalPunchResult, method: str, flat: float) -> Number:
    """No rough punch is stiffer than the flat one, and the largest force comes near it."""
    largest = max(float(np.nanmax(_of(ensemble, method)["stiffness"])) for ensemble in result.ensembles)
    deficit = 2 / result.case.cells
    return Number(
        label=f"{method}: largest stiffness of any surface over that of the flat punch, {flat:g} E* L",
        value=largest / flat,
        reference=1.0 - deficit / 2,
        source="flat punch",
        tolerance=deficit / 2,
        reason=f"never stiffer than all cells together, and no more than two cells a side ({deficit:.2g}) softer at "
        "the largest force",
    )


def _no_factor_lost(numbers: list[Number]) -> Number:
    """The two methods are independent: a fault in one of them shows where they are farthest apart."""
    farthest = max(numbers, key=lambda number: abs(number.value) + number.uncertainty)
    return replace(
        farthest,
        label=f"largest difference: {farthest.label}",
        tolerance=3.0,
        reason="k ~ F^(1/(1+H)): a factor 2 lost in the force, or half of the length, is 3 dB or more for H <= 1",
        role=Role.CRITERION,
    )


def _of(ensemble: Ensemble, method: str) -> Outcome:
    return {"bem3d": ensemble.bem, "mdr": ensemble.mdr, "mdr 1.1523 L": ensemble.long}[method]


def _level(case: FractalPunch, force: float) -> int:
    """Which of the force levels is the reported one."""
    return int(np.argmin(np.abs(np.log(np.array(case.forces) / force))))


def _apart(case: FractalPunch, h: int, ensemble: Ensemble, name: str) -> list[Number]:
    """MDR beside boundary elements at the reported forces, as far as both have the statistic on both grids."""
    compared = COMPARED[name]
    numbers = []
    for r, force in enumerate(case.reported):
        level = _level(case, force)
        springs = _estimate(case, h, level, _of(ensemble, compared.method), compared.statistic)
        apart = springs.minus(_estimate(case, h, level, ensemble.bem, compared.statistic))
        left = _left_by_cells(case, ensemble, r, compared) + _left_by_springs(ensemble, level, compared)
        if not np.isfinite([apart.value, apart.error, left]).all():
            continue
        numbers.append(
            Number(
                label=f"{name} at H = {ensemble.hurst:g}, Fbar = {force:.3g}: mdr over bem3d",
                value=DECIBEL * apart.value,
                reference=0.0,
                source="bem3d",
                tolerance=compared.tolerance,
                unit="dB",
                reason=compared.reason,
                grid=DECIBEL * left,
                sample=DECIBEL * apart.half_width,
                role=Role.FINDING,
            )
        )
    return numbers


def _left_by_cells(case: FractalPunch, ensemble: Ensemble, r: int, compared: Compared) -> float:
    """First order in the cell: the error of the coarse grid is twice what halving its cells changed."""
    level = _level(case, case.reported[r])
    whole = ensemble.bem["stiffness"][:, level]
    fine, coarse = ensemble.refined["stiffness"][:, r], whole[: case.refined]
    both = np.isfinite(fine) & np.isfinite(coarse)
    if np.count_nonzero(both) < 3:
        raise NotConvergedError(f"{np.count_nonzero(both)} surfaces converged on both grids, 3 are needed")
    change, error = paired_change(fine[both], coarse[both], whole[np.isfinite(whole)], compared.statistic)
    return 2 * (abs(change) + error)


def _left_by_springs(ensemble: Ensemble, level: int, compared: Compared) -> float:
    """First order in the spring: the error of the fine springs is what halving the coarse ones changed."""
    fine, coarse = ensemble.mdr["stiffness"][:, level], ensemble.coarse["stiffness"][:, level]
    with np.errstate(divide="ignore", invalid="ignore"):
        return abs(float(compared.statistic(fine) - compared.statistic(coarse)))


def _rows(case: FractalPunch, h: int, ensemble: Ensemble) -> list[Row]:
    """One row a force: both statistics of both methods with their 95 % intervals."""
    rows = []
    for level, force in enumerate(case.forces):
        row = {"H": ensemble.hurst, "Fbar": force}
        for method in ("bem3d", "mdr", "mdr 1.1523 L"):
            for name in ("mean stiffness", "relative deviation"):
                found = _estimate(case, h, level, _of(ensemble, method), COMPARED[name].statistic)
                row[f"{method} {name}"] = float(np.exp(found.value))
                row[f"{method} {name} low"] = float(np.exp(found.value - found.half_width))
                row[f"{method} {name} high"] = float(np.exp(found.value + found.half_width))
        row["bem3d contact fraction"] = float(np.nanmean(ensemble.bem["area"][:, level]))
        row["bem3d cells in contact"] = row["bem3d contact fraction"] * case.cells**2
        row["mdr contact fraction"] = float(ensemble.mdr["area"][:, level].mean())
        row["bem3d surfaces"] = int(np.isfinite(ensemble.bem["stiffness"][:, level]).sum())
        rows.append(row)
    return rows


def _estimate(case: FractalPunch, h: int, level: int, outcome: Outcome, statistic: Statistic) -> Estimate:
    """Over the realisations that converged (those that did not are listed by the case).

    Where springs saturate there is no deviation to take a logarithm of: minus infinity, or no finite error.
    """
    samples = outcome["stiffness"][:, level]
    with np.errstate(divide="ignore", invalid="ignore"):
        return estimate(samples[np.isfinite(samples)], statistic, generator(case.seed, BOOTSTRAP, h, level))


def _summary(name: str, numbers: list[Number]) -> str:
    """How many agree, which differ and by how much."""
    verdicts = [n.verdict for n in numbers]
    counts = ", ".join(f"{verdicts.count(v)} {v}" for v in Verdict if v in verdicts)
    differ = [
        f"{n.label.removeprefix(name + ' at ').removesuffix(': mdr over bem3d')} ({n.value:+.2f} dB)"
        for n in numbers
        if n.verdict is Verdict.DIFFER
    ]
    heading = (
        f"{name[0].upper()}{name[1:]}, MDR beside boundary elements within {COMPARED[name].tolerance:g} dB: {counts}"
    )
    return heading + (f"; differ: {'; '.join(differ)}." if differ else ".")


def _saturation(rows: list[Row]) -> tuple[str, ...]:
    """Where the springs have no fluctuation left and the boundary elements still have."""
    still = [row for row in rows if row["mdr relative deviation"] == 0]
    first = {row["H"]: row for row in reversed(still)}
    return tuple(
        f"At H = {hurst:g} all springs of all profiles are in contact from Fbar = {row['Fbar']:.3g} on: MDR has no "
        f"fluctuation left, boundary elements have a relative deviation of {row['bem3d relative deviation']:.2g}."
        for hurst, row in sorted(first.items())
    )


def _area(case: FractalPunch, ensembles: list[Ensemble]) -> str:
    """True contact beside the springs in contact."""
    middle, force = ensembles[len(ensembles) // 2], case.reported[1 % len(case.reported)]
    level = _level(case, force)
    fine = np.nanmean(middle.refined["area"][:, 1 % len(case.reported)])
    change = fine / np.nanmean(middle.bem["area"][: case.refined, level])
    return (
        f"Contact area is another matter: at H = {middle.hurst:g}, Fbar = {force:.2g} the springs in contact make up "
        f"{middle.mdr['area'][:, level].mean():.3f} of the length, the true contact "
        f"{np.nanmean(middle.bem['area'][:, level]):.4f} of the area (cells half as wide change it by a factor of "
        f"{change:.2f}). MDR is no model of the contact area."
    )
