"""What the sweeps through the limits show: which thresholds are predicted, and where the software warns."""

from collections.abc import Sequence

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, JudgedClaim, Number, Role, Table, Verdict, if_confirmed, table_of
from validation.analysis.wording import share
from validation.cases.limits.limits import HALF_SPACE_LIMITS, Limits, LimitsResult, run
from validation.cases.limits.numbers import (
    errors_over_residuals,
    exponent_number,
    momentum_number,
    residual_number,
    threshold_number,
    warnings_number,
)
from validation.cases.limits.solver import MEASURES, SCENES, SOLVERS
from validation.cases.limits.sweep import Sweep
from validation.cases.limits.tables import (
    iterations_table,
    limits_table,
    residuals_table,
    summary_table,
    sweeps_table,
)

CLAIM = "Each limit of each method is predicted, and the software warns past it."


def evidence(result: LimitsResult) -> Evidence:
    """Each threshold against its condition, warnings, iterations on finer grids, the residual against the truth."""
    iterations, residuals = iterations_table(result), residuals_table(result)
    thresholds = [threshold_number(sweep) for sweep in result.sweeps]
    warned = [warnings_number(sweep) for sweep in result.sweeps]
    momentum = momentum_number(result)
    # two points leave a straight line no error
    pairs = [(scene, solver) for scene in SCENES for solver in SOLVERS if len(result.case.grids) > 2]
    exponents = [exponent_number(iterations, *pair) for pair in pairs]
    estimates = [residual_number(residuals, measure) for measure in MEASURES]
    claims = _claims(result, thresholds, warned)
    return Evidence(
        title="Where each method fails, and whether the software warns",
        method=_method(result),
        numbers=(*thresholds, *warned, momentum, *exponents, *estimates),
        tables=(limits_table(result), sweeps_table(result), iterations, residuals),
        claims=claims,
        finding=f"{predicted(thresholds)}; {warned_of(warned)}.",
        headlines=headlines(result, thresholds, warned, estimates),
        conclusions=(
            _on_warnings(result, [n for n in warned if n.role is Role.CRITERION]),
            _on_other_results(result, momentum),
            *([_on_iterations(exponents)] if exponents else []),
            _on_residuals(residuals, estimates),
        ),
        captions=_captions(),
        unconverged=result.unconverged,
        page_tables=(summary_table(result), table_of("input without an answer", result.unanswered)),
    )


def _method(result: LimitsResult) -> str:
    case = result.case
    return (
        f"{len(result.sweeps)} limits of springs, time stepping and boundary elements. A sweep through each limit "
        "measures the error against a better method and records the warnings, or the refusal, of each call. A "
        "condition predicts the threshold of the failure. The threshold counts as predicted if the error exceeds its "
        "tolerance everywhere past it and nowhere before it, but for the factor stated. A user counts as warned if "
        "every call past the threshold warns or raises an error, and no call before it does. "
        f"Rough punches have {case.cells}² cells, {case.surfaces} surfaces and {case.profiles} profiles. The case "
        "wheel_stability shows time stepping and the spacing of springs at length, rolling shows rolling in three "
        "dimensions, mdr_limits shows contact area and gap."
    )


def _claims(
    result: LimitsResult, thresholds: Sequence[Number], warned: Sequence[Number]
) -> tuple[JudgedClaim, JudgedClaim, JudgedClaim]:
    """Of the case, and of either half of it."""

    def of_all(numbers: Sequence[Number]) -> str:
        return f"{sum(number.verdict is Verdict.AGREE for number in numbers)} of {len(numbers)}"

    where = f"{of_all(thresholds)} thresholds lie where their condition says, within the factor stated for each"
    silent = sum(sweep.verdict == "not warned" for sweep in result.sweeps)
    message = (
        f"every call past the threshold warns, and none before it, at {of_all(warned)} limits; at {silent} none does"
    )
    elsewhere = [f"{n.where['limit']} {2**n.value:.2g}" for n in thresholds if n.verdict is Verdict.DIFFER]
    return (
        answered(CLAIM, [*thresholds, *warned], f"{where}; {message}."),
        answered(
            "Each method fails where its condition says.",
            thresholds,
            f"{where}; found over predicted elsewhere: {', '.join(elsewhere) or 'none'}.",
        ),
        answered("The software warns past each limit, and never before it.", warned, f"{message}."),
    )


def predicted(thresholds: Sequence[Number]) -> str:
    return f"{share(thresholds, Verdict.AGREE)} limits lie where predicted"


def warned_of(warned: Sequence[Number]) -> str:
    return f"the software warns rightly at {share(warned, Verdict.AGREE)}"


def headlines(
    result: LimitsResult, thresholds: Sequence[Number], warned: Sequence[Number], estimates: Sequence[Number]
) -> dict[str, str]:
    """Of the limits that each figure shows."""
    sweeps = list(zip(result.sweeps, thresholds, warned, strict=True))
    found = {}
    for figure, elements in (("limits", False), ("limits-bem", True)):
        mine = [(where, told) for sweep, where, told in sweeps if (sweep.limit in HALF_SPACE_LIMITS) is elements]
        if mine:
            where, told = zip(*mine, strict=True)
            found[figure] = f"{predicted(where)}; {warned_of(told)}"
    largest = ", ".join(f"{n.where['measure']} {n.value:.2g}" for n in estimates)
    return found | {"limits-solver": f"Largest error over residual: {largest}"}


def _named(sweeps: Sequence[Sweep]) -> str:
    return ", ".join(f"{s.limit.title} ({s.limit.method})" for s in sweeps) or "none"


def _on_warnings(result: LimitsResult, criteria: Sequence[Number]) -> str:
    warned = [s for s in result.sweeps if s.verdict == "warned"]
    silent = [s for s in result.sweeps if s.verdict == "not warned"]
    partly = [s for s in result.sweeps if s not in warned and s not in silent]
    return if_confirmed(
        f"The software warns a user past {len(warned)} of {len(result.sweeps)} limits: {_named(warned)}. In part: "
        + ("; ".join(f"{s.limit.title} ({s.limit.method}), {s.verdict}" for s in partly) or "none")
        + f". Without a warning: {len(silent)}, {_named(silent)}.",
        criteria,
    )


def _on_other_results(result: LimitsResult, momentum: Number) -> str:
    found = result.found
    loads, work = found["full contact values"], found["full contact, iterations"]
    error, rolling = found["full contact, L2"], found["level, rolling-equivalent spectrum"]
    level = next(s for s in result.sweeps if s.limit.name == "level").extreme_errors[0]
    return if_confirmed(
        f"Under a force instead of an approach full contact is no limit: from {loads[0]:g} to {loads[-1]:g} p* the "
        f"pressure is within {error.max():.2g} of Westergaard in L2 after {work.min():.0f} to {work.max():.0f} "
        "iterations. "
        f"The level along the track is already {level:.2g} dB off for waves much longer than the contact, so the "
        "threshold depends on the tolerance. "
        f"With the rolling-equivalent spectrum in place of Geike's, springs are at most {rolling.max():.2g} dB from "
        "the half-space in any octave. Wheels that lift off land again; impulse and momentum balance to "
        f"{momentum.value:.1g}.",
        [momentum],
    )


def _on_iterations(exponents: Sequence[Number]) -> str:
    found = "; ".join(f"{n.model}, {n.where['scene']} {n.value:.2f} ± {n.sample:.2f}" for n in exponents)
    return f"Iterations to a residual of 1e-8 grow with the cells on a side to the power of: {found}."


def _on_residuals(residuals: Table, estimates: Sequence[Number]) -> str:
    worst = ", ".join(f"{n.where['measure']} {n.value:.2g}" for n in estimates)
    largest = {m: errors_over_residuals(residuals, m, solver="solve").max() for m in MEASURES}
    fast = ", ".join(f"{measure} {value:.2g}" for measure, value in largest.items())
    return (
        f"The residual as an estimate: error <= c residual, with c = {worst} over all scenes, residuals and both "
        f"solvers; of solve alone {fast}."
    )


def _captions() -> dict[str, str]:
    panel = (
        "Dashed: the predicted threshold, with its factor. Shaded: where the method must fail. Dotted: the tolerance. "
        "Open marks: warned or refused; filled: no message; crosses above: no result; marks below: that size or less."
    )
    return {
        "limits": f"Limits of springs and of time stepping: error against the parameter. {panel}",
        "limits-bem": f"Limits of boundary elements. {panel}",
        "limits-solver": (
            "(a) Iterations to a residual of 1e-8 against cells on a side: filled, solve; open, Polonsky-Keer. (b), "
            "(c), (d) True error against residual, of the load (force at an approach, approach at a force), of the "
            "stiffness (none where the contact is the same cell by cell), of the pressure in L2; dotted: error = "
            "residual."
        ),
    }


CASE = Case(
    name="limits",
    chapter=Chapter.LIMITS,
    place=2,
    claim=CLAIM,
    answers="Where each method fails: a sweep through every limit, its predicted threshold, the software's warnings",
    quick=Limits(),
    full=Limits(
        cells=128,
        surfaces=12,
        profiles=400,
        length=64.0,
        strip_cells=12,
        track=1024.0,
        resolved=6,
        grids=(32, 64, 128, 256, 512),
        judged=128,
        wheels=8,
    ),
    run=run,
    evidence=evidence,
    needs="not applicable: the case tests every model at its limit",
)
