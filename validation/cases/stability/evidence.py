"""What the limits of time stepping and springs show."""

import math
from collections.abc import Sequence

import numpy as np

from validation.analysis.answers import answered
from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import (
    Evidence,
    JudgedClaim,
    Number,
    Role,
    Table,
    if_confirmed,
    numbers_with,
    table_of,
)
from validation.analysis.features import FEATURES
from validation.analysis.wording import by_status, in_a_word, sentence, title
from validation.cases.stability.hertz_vibration import hertz_numbers, hertz_table, orders_table
from validation.cases.stability.lift_off import first_lift, lift_numbers, lift_table, pulls_from
from validation.cases.stability.linear_vibration import GROWTH, linear_numbers, linear_table
from validation.cases.stability.long_runs import lap_numbers, laps_table, long_numbers, long_table
from validation.cases.stability.spacing import LEVEL, quarter_wave, spacing_numbers, spacing_table
from validation.cases.stability.stability import WheelStability, WheelStabilityResult, run
from validation.simulation.free_vibration import LIFT_OFF
from validation.simulation.integrators import VELOCITY_VERLET

CLAIM = "Time stepping becomes unstable where theory says, and the software rejects steps past that limit."


def evidence(result: WheelStabilityResult) -> Evidence:
    """Schemes against what is known of them, energy of long runs, springs too far apart, forces at lift-off."""
    linear, hertz, long = linear_table(result), hertz_table(result), long_table(result)
    laps, spacing, lift = laps_table(result), spacing_table(result), lift_table(result)
    of_schemes = [*linear_numbers(linear), *hertz_numbers(result, hertz)]
    of_long, of_springs = long_numbers(result, long), spacing_numbers(spacing)
    of_laps, of_lift = lap_numbers(result), lift_numbers(result, lift)
    claims = _claims(result, of_schemes, [*of_long, *of_laps], of_springs, of_lift)
    return Evidence(
        title="Where time stepping and springs fail",
        method=_method(result),
        numbers=(*of_schemes, *of_long, *of_laps, *of_springs, *of_lift, _refusals_number(result)),
        tables=(linear, hertz, long, laps, spacing, lift),
        claims=claims,
        finding=finding(claims),
        headlines=headlines(claims),
        conclusions=(
            _on_schemes(of_schemes, hertz),
            _on_long_runs(result, of_long, of_laps),
            _on_spacing(spacing, of_springs),
            _on_lift_off(lift, of_lift),
        ),
        captions=_captions(result),
        unconverged=tuple(f"{p.sweep}, load {p.load:g} N" for p, o in result.lift if o["failed"]),
        page_tables=(orders_table(hertz), table_of("refusals", result.refusals)),
    )


def _method(result: WheelStabilityResult) -> str:
    case = result.case
    return (
        "The wheel of Table 14.1. Four schemes integrate its free vibration with omega_eigen dt from "
        f"{case.steps[0]:g} to {case.steps[-1]:g}, on a linear and on a Hertz contact, released at "
        f"{', '.join(f'{u:g}' for u in case.highest)} d_N. Above {LIFT_OFF:.3g} d_N the Hertz contact opens. Long "
        f"runs take {case.long_steps} steps of a / 100 on it, and {case.laps} laps of {case.wheels} wheels over "
        "rough periodic tracks. Springs of many spacings roll on one track. Wheels lift off where tracks are rough or "
        "loads low; the mass is the same at every load."
    )


def _claims(
    result: WheelStabilityResult,
    of_schemes: Sequence[Number],
    of_long: Sequence[Number],
    of_springs: Sequence[Number],
    of_lift: Sequence[Number],
) -> tuple[JudgedClaim, ...]:
    """Of time stepping, of energy, of the spacing of springs and of lift-off."""
    growth, refused = numbers_with(of_schemes, GROWTH), _refusals_number(result)
    kept = numbers_with(of_long, model=VELOCITY_VERLET.name)
    (quarter,) = numbers_with(of_springs, "error of the last one-third octave")
    lifted = numbers_with(of_lift, FEATURES["lift-off"].quantity)
    claims = [
        answered(
            CLAIM,
            [*growth, refused],
            f"growth of a step of {len(growth)} schemes follows the eigenvalue on both sides of the limit within "
            f"{max(n.value for n in growth):.1g}, and {100 * refused.value:.0f} % of {len(result.refusals)} invalid "
            "calls raise an error.",
        ),
        answered(
            f"Velocity Verlet keeps the energy over {result.case.long_steps} steps.",
            kept,
            f"after them, and after {result.case.laps} laps over rough tracks, the logarithm of the energy has changed "
            f"by {max(abs(n.value) for n in kept):.1g} at most.",
        ),
        answered(
            "On low roughness springs a quarter of the shortest wave apart have the last one-third octave within 1 dB.",
            [quarter],
            f"at h/d = {quarter.where['h/d']:g} it is {quarter.value:+.2f} ± {quarter.uncertainty:.2f} dB off.",
        ),
    ]
    if lifted:
        found = "; ".join(f"{n.conditions}: {n.value:.2g} beside {n.reference:.2g}" for n in lifted)
        claims.append(answered("Wheels lift off where linear theory pulls.", lifted, f"h / d of the first, {found}."))
    return tuple(claims)


def headlines(claims: Sequence[JudgedClaim]) -> dict[str, str]:
    """Of the schemes; of energy, springs and, where it was seen, lift-off."""
    stable, energy, spaced, *lifted = claims
    rough = [
        by_status(
            energy,
            holds="velocity Verlet keeps the energy",
            fails="velocity Verlet does not keep the energy",
            undecided="whether velocity Verlet keeps the energy is open",
        ),
        f"springs a quarter wave apart are enough on low roughness: {in_a_word(spaced)}",
        *(f"wheels lift off where linear theory pulls: {in_a_word(claim)}" for claim in lifted),
    ]
    return {"wheel_stability": title(_stable(stable)), "wheel_stability-rough": title(*rough)}


def finding(claims: Sequence[JudgedClaim]) -> str:
    return sentence(_stable(claims[0]))


def _stable(claim: JudgedClaim) -> str:
    return by_status(
        claim,
        holds="time stepping becomes unstable where theory says, and steps past that limit are rejected",
        fails="time stepping does not become unstable where theory says, or a step past that limit is taken",
        undecided="whether time stepping becomes unstable where theory says is open",
    )


def _refusals_number(result: WheelStabilityResult) -> Number:
    return Number(
        quantity=(
            "share of invalid calls that raise an error: a step past the limit, or a track with too few "
            "points for its waves"
        ),
        value=float(np.mean([float(str(row["refused"])) for row in result.refusals])),
        reference=1.0,
        source="an error for every call whose motion would grow without bound or whose track would be another one",
        tolerance=0.0,
        reason="exact: every call counts",
    )


def _criteria(numbers: Sequence[Number]) -> list[Number]:
    return [number for number in numbers if number.role is not Role.FINDING]


def _on_schemes(numbers: Sequence[Number], table: Table) -> str:
    verlet = table.where(scheme=VELOCITY_VERLET.name)
    last = verlet["omega dt"].max()
    worst = verlet.where(**{"omega dt": last})["error of the period"].max()
    return if_confirmed(
        "On a Hertz contact velocity Verlet has the period of the energy integral, lift-off included: with omega dt = "
        f"{last:g} its error is at most {worst:.2g}.",
        _criteria(numbers),
    )


def _on_long_runs(result: WheelStabilityResult, numbers: Sequence[Number], laps: Sequence[Number]) -> str:
    growth, euler = laps[0], laps[-1]
    return if_confirmed(
        f"Over {result.case.laps} laps on springs the mean square acceleration changes by a factor "
        f"{math.exp(growth.value):.4g} under velocity Verlet; under explicit Euler the energy of the free vibration "
        f"grows by a factor {math.exp(euler.value):.3g}, as predicted.",
        _criteria([*numbers, *laps]),
    )


def _on_spacing(table: Table, numbers: Sequence[Number]) -> str:
    quarter = quarter_wave(table)
    levels = ", ".join(f"{level:.2g}" for level in quarter[LEVEL])
    errors = ", ".join(f"{error:.2g}" for error in quarter["error of force over its fluctuation"])
    heights = ", ".join(f"{height:g}" for height in quarter["height [d_N]"])
    return (
        f"With springs a quarter of the shortest wave apart the last one-third octave is off by {levels} dB and the "
        f"force by {errors} of its fluctuation, for h / d = {heights}. "
        + if_confirmed(
            "For low roughness the error of that level is that of a sum over springs in place of an integral.",
            numbers[:1],
        )
    )


def _on_lift_off(table: Table, numbers: Sequence[Number]) -> str:
    rows = table.where(sweep="height")
    seen = first_lift(rows)
    last = int(np.argmax(rows["height [d_N]"]))
    lifted = (
        "no wheel was seen to lift off" if seen is None else f"a wheel was first seen to lift off at h / d = {seen:.2g}"
    )
    return if_confirmed(
        f"Linear theory has tension from h / d = {pulls_from(rows):.2g} on; {lifted}. At h / d = "
        f"{rows['height [d_N]'][last]:g} it is in the air for {rows['time airborne'][last]:.2g} of the time and its "
        f"force reaches {rows['highest force [F_N]'][last]:.3g} loads.",
        _criteria(numbers),
    )


def _captions(result: WheelStabilityResult) -> dict[str, str]:
    low = result.case.long_highest[0]
    return {
        "wheel_stability": (
            "Free vibration; lines: theory. (a) Error of the period, each scheme up to its limit. (b) Energy: filled, "
            "its drift in one period; open, its oscillation within the first. (c) Growth in one step near the limits, "
            "dotted. (d) Error of the period on a Hertz contact: full, velocity Verlet; dashed, Runge-Kutta; numbers: "
            f"release over d_N; contact is lost above {LIFT_OFF:.3g}."
        ),
        "wheel_stability-rough": (
            f"(a) Change of the energy over {result.case.long_steps} steps, released at {low:.4g} d_N and above. (b) "
            "Error of the last one-third octave by the spacing of springs; dotted: a quarter of the shortest wave, and "
            "the largest spacing that represents it. (c) Error of the force on the same tracks. (d) Time airborne and "
            "(e) highest force, by height and by load; lines: (14.11). (f) Laps over rough tracks: energy of the free "
            f"vibration and mean square acceleration, 95 % of {result.case.wheels} wheels. Lines in (a), (b), (f): "
            "linear theory."
        ),
    }


CASE = Case(
    name="wheel_stability",
    chapter=Chapter.LIMITS,
    place=1,
    claim=CLAIM,
    answers="Where time stepping and springs fail: steps up to and past the limit, long runs, spacing, lift-off",
    quick=WheelStability(),
    full=WheelStability(
        turns=20,
        hertz_turns=6,
        long_steps=1000000,
        laps=20,
        heights=(0.03, 0.1, 0.2, 0.3, 0.45, 0.6, 1.0, 3.0),
        loads=(0.01, 0.02, 0.05, 0.1, 0.2),
        lift_laps=2,
        spacing_heights=(0.001, 0.064, 1.0),
        spacing_tracks=4,
    ),
    run=run,
    evidence=evidence,
    needs="closed form",
)
