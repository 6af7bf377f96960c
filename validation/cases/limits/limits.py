"""Where each method fails: a sweep through each limit, the threshold that is predicted, what the software says."""

import math
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from validation.analysis.evidence import Number, Role, Table, table_of
from validation.analysis.series import Where, single
from validation.case import SERIAL, Case, Chapter, Chart, Claim, Curve, Engine, Outcomes, Panel, Quantity, Series, Study
from validation.cases.limits.sweeps import HALF_SPACE, LIMITS, SPRINGS, Limit, Sweep
from validation.simulation.limits import sweep


@dataclass(frozen=True, kw_only=True)
class Limits:
    """How finely each limit is swept.

    cells: on a side of rough punches; surfaces, profiles: realisations; length: of a rolled strip, over a, at
    strip_cells to a contact radius; track: length of a track on springs, over a; resolved: surfaces on grids of
    different cells; wheels: that lift off; seed: zero or positive.
    """

    cells: int = 64
    surfaces: int = 4
    profiles: int = 100
    length: float = 16.0
    strip_cells: int = 8
    track: float = 256.0
    resolved: int = 2
    wheels: int = 4
    seed: int = 147


def run(case: Limits, engine: Engine = SERIAL) -> Outcomes:
    """Sweep through every limit."""
    problems = list(dict.fromkeys(limit.problem(case) for limit in LIMITS))
    swept = dict(zip(problems, engine.map(sweep, problems), strict=True))
    outcomes = {
        "sweeps": [Sweep.of(limit, swept[limit.problem(case)]) for limit in LIMITS],
        "tracks": next(outcome for outcome in swept.values() if "imbalance" in outcome),
    }
    lost = (f"{p.probe.replace('_', ' ')}: {o['failed']:g}" for p, o in swept.items() if np.any(o.get("failed", 0.0)))
    return Outcomes(case, outcomes, tuple(lost))


THRESHOLD = Quantity("observed_threshold_over_the_predicted_one")
WARNED = Quantity(
    "part_of_a_sweep_without_the_right_message_none_past_the_threshold_or_one_before_it",
    "part of a sweep without the right message: none past the threshold, or one before it",
)
IMBALANCE = Quantity(
    "imbalance_of_impulse_and_momentum_over_F_N_T_largest", "imbalance of impulse and momentum over F_N T, largest"
)
SUMMARY = Quantity("where_each_method_fails_and_its_messages", "where each method fails, and its messages")


def series(result: Outcomes) -> list[Series]:
    """Each threshold against its condition, and warnings."""
    imbalance = float(np.max(result["tracks"]["imbalance"]))
    source = "momentum: F T - F_N T = M (v_0 - v_end), in contact and in the air"
    reason = "rounding: one unit in the last place of the highest force in each step"
    where: Where = {"motion": "wheels that lift off"}
    return [
        *map(threshold, result["sweeps"]),
        *map(warnings, result["sweeps"]),
        single(IMBALANCE, "springs", imbalance, 1e-10, source, reason, where=where, role=Role.IDENTITY),
        *(panel_curve for sweep in result["sweeps"] for panel_curve in shown(sweep)),
    ]


def threshold(sweep: Sweep) -> Series:
    """Where the error passes its tolerance, over the predicted threshold, in octaves; positive where it fails later.

    A sweep that does not pass it has no threshold: its end has the interval of what decides nothing.
    """
    (method, title, parameter), (factor, derived, _) = sweep.limit.named, sweep.limit.judged
    within, reason = math.log2(factor), f"within a factor {factor:g}"
    if not sweep.crossing:
        reason += "; the error passes its tolerance nowhere, and the value is the end of the sweep"
    at, half = sweep.crossing or (float(sweep.values[:: sweep.sign][-1]), math.nan)
    octaves = sweep.sign * math.log2(at / sweep.predicted_threshold)
    half = half if sweep.crossing else abs(octaves) + 2 * within
    where: Where = {"limit": title, "parameter": parameter}
    role = Role.CRITERION if derived else Role.FINDING
    condition = sweep.limit.condition
    return single(
        THRESHOLD, method, octaves, within, condition, reason, where=where, role=role, unit="octaves", grid=half
    )


def warnings(sweep: Sweep) -> Series:
    """Whether the software warns or refuses past the threshold, and nowhere before it."""
    source = "warnings or errors past the threshold, none before it"
    reason = (
        "5 %: less than one value of a sweep; every value counts that is farther from the threshold than the stated "
        "factor"
    )
    (method, title, _), wrong = sweep.limit.named, 100 * (1 - sweep.share_of_correct_warnings)
    role = Role.CRITERION if sweep.limit.judged.warned else Role.FINDING
    return single(WARNED, method, wrong, 5.0, source, reason, where={"limit": title}, role=role, unit="%")


def shown(sweep: Sweep) -> Iterator[Series]:
    """For the panel of a limit: the error, where a message was given, and where the tolerance must be passed.

    Values of the models threshold, factor and no answer are the places where the panel draws them.
    """
    limit, x, tolerance = sweep.limit, sweep.predicted_threshold, sweep.limit.fails.tolerance
    answered, factor = np.isfinite(sweep.error), sweep.limit.judged.factor
    error = np.where(answered, sweep.error, math.nan)
    top = max(float(np.nanmax(error)), 4 * tolerance)
    for model, at, values in (
        ("factor", np.array([x / factor, x * factor]), np.full(2, tolerance)),
        ("threshold", np.array([x, x]), np.array([lowest_drawn(limit), top])),
        ("error", sweep.values, error),
        ("message", sweep.values, np.where(sweep.warned, error, math.nan)),
        ("no answer", sweep.values, np.where(answered, math.nan, top)),
    ):
        yield Series(limit.name, model, values, along=limit.named.parameter, at=at)


def lowest_drawn(limit: Limit) -> float:
    """A hundredth of the tolerance: the place of smaller errors in the panel of a limit."""
    return limit.fails.tolerance / 100


def tables(result: Outcomes) -> list[Table]:
    """On the page: of each limit its condition and the message. All points of all sweeps."""
    points = [
        {"limit": s.limit.name, "value": float(x), "error": float(e), "message": m}
        for s in result["sweeps"]
        for x, e, m in zip(s.values, s.error, s.messages, strict=True)
    ]
    summary = [summarised(sweep) for sweep in result["sweeps"]]
    return [table_of(SUMMARY, summary), table_of("sweeps", points)]


def summarised(sweep: Sweep) -> dict[str, object]:
    """Of a limit: its condition, its error, where it fails, and what the software says there."""
    limit, (side, error, reference, tolerance) = sweep.limit, sweep.limit.fails
    sign, seen = ">" if side == "above" else "<", "as predicted" if sweep.predicted else "elsewhere"
    return {
        "limit": limit.name,
        "fails where": f"{limit.named.parameter} {sign} {sweep.predicted_threshold:.3g}: {limit.condition}",
        "error": f"{error} above {tolerance:g}; reference: {reference}",
        "fails at": f"{sweep.crossing[0]:.3g}, {seen}" if sweep.crossing else "nowhere",
        "within": f"a factor {limit.judged.factor:g}, by {'theory' if limit.judged.derived else 'an estimate'}",
        "message of the software": textwrap.shorten(sweep.first_message, 190, placeholder=" …") or "none",
        "values with the right message, or with none": f"{100 * sweep.share_of_correct_warnings:.0f} %",
    }


def in_words(number: Number) -> str:
    if number.quantity == WARNED:
        return f"{number.value:.0f} % of its values without the right message"
    if number.grid > abs(number.value) + number.tolerance:
        return "no threshold in the sweep"
    return f"{abs(number.value):.2g} octaves {'after' if number.value > 0 else 'before'} the predicted threshold"


def panel(limit: Limit) -> Panel:
    curves = (
        Curve(limit.name, "threshold", "dashed", "predicted threshold"),
        Curve(limit.name, "factor", "thick", "its factor, at the tolerance"),
        Curve(limit.name, "error", "marks", "error, no message"),
        Curve(limit.name, "message", "open marks", "warning or error message"),
        Curve(limit.name, "no answer", "crosses", "no answer"),
    )
    title = f"{limit.named.method}:\n{limit.named.title} {'→' if limit.fails.side == 'above' else '←'}"
    log = "xy" if max(limit.probe.values) > 4 * min(limit.probe.values) else "y"
    y, tolerance = textwrap.fill(limit.fails.error, 30), limit.fails.tolerance
    least = (-math.inf, lowest_drawn(limit))
    return Panel(limit.named.parameter, y, title=title, log=log, lines=(tolerance,), least=least).of(*curves)


ALL = (
    " One panel a limit: the error against the parameter. Arrow: the side on which it must pass its tolerance, the "
    "line, within the factor of the predicted threshold. Triangles: a message of the software; crosses: no answer. "
    "Marks below: an error of a hundredth of the tolerance or less."
)
figure = partial(Chart, claims=(0, 1))
STUDY = Study(
    title="Where each method fails, and whether the software warns",
    method=(
        f"{len(LIMITS)} limits of springs, time stepping and boundary elements. A sweep through each limit measures "
        "the error against a better method and records the warnings, or the refusal, of each call. A condition "
        "predicts the threshold of the failure. The threshold counts as predicted if the error exceeds its tolerance "
        "everywhere past it and nowhere before it, but for the factor stated. A user counts as warned if every call "
        "past the threshold warns or raises an error, and no call before it does. Rough punches have {c.cells}² cells, "
        "{c.surfaces} surfaces and {c.profiles} profiles. The case wheel_stability shows time stepping and the spacing "
        "of springs at length, rolling shows rolling in three dimensions, interface shows contact area and gap."
    ),
    series=series,
    claims=(
        Claim(quantity=THRESHOLD, printed=in_words).saying(
            "Each method fails where its condition says.",
            short="Failures of the methods agree with their predicted thresholds",
            key="failure",
        ),
        Claim(quantity=WARNED, printed=in_words).saying(
            "The software warns past each limit and only there.",
            short="Warnings of the software agree with the limits",
            key="warning",
        ),
    ),
    charts=(
        figure("limits", "Springs and time stepping." + ALL, tuple(map(panel, SPRINGS))),
        figure("limits-bem", "Boundary elements." + ALL, tuple(map(panel, HALF_SPACE))),
    ),
    tables=tables,
    printed=(SUMMARY,),
)
CASE = Case(
    name="limits",
    chapter=Chapter.LIMITS,
    place=2,
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
        wheels=8,
    ),
    run=run,
    study=STUDY,
    needs="not applicable: the case tests every model at its limit",
)
