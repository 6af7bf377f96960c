"""What the limits of time stepping and of springs show, as data."""

import math
from functools import partial

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim
from validation.analysis.evidence import Table
from validation.analysis.study import Outcomes, Study
from validation.cases.stability import wheel_stability as shown
from validation.simulation.free_vibration import LIFT_OFF

STYLES = {shown.EULER: "mdr", shown.SYMPLECTIC: "other", shown.VERLET: "bem", shown.KUTTA: "crosses"}


def of_all_schemes(quantity: str) -> tuple[Curve, ...]:
    """Theory, and each scheme in its own style."""
    theory = Curve(quantity, tuple(f"theory of {name}" for name in STYLES), "exact", "_", by=("model",))
    return (theory, *(Curve(quantity, name, style, name) for name, style in STYLES.items()))


def in_the_air(quantity: str, title: str) -> Panel:
    """Springs where the height or the load changes, each beside linear theory."""
    styles = {("springs", "height"): "bem", ("springs", "load"): "mdr"}
    styles |= {(shown.THEORY, "height"): "exact", (shown.THEORY, "load"): "mdr line"}
    curves = tuple(
        Curve(quantity, model, style, f"{model}, {sweep} changed", of={"sweep": sweep})
        for (model, sweep), style in styles.items()
    )
    return LOG(shown.HEIGHT, quantity, curves, title)


def refused(result: Outcomes) -> tuple[Table]:
    calls, answers = zip(*result["refusals"].items(), strict=True)
    return (Table("refusals", {"call": calls, "answer": [a or "none: the call succeeded" for a in answers]}),)


LOG = partial(Panel, log="xy", legend="lower right")
OF_EACH = partial(Curve, by=(shown.RELEASE,))
OF_HEIGHTS = partial(Curve, by=(shown.HEIGHT,))
WAVES = (math.pi / 2, math.pi)
SCHEMES = (
    LOG(shown.OMEGA_DT, "relative error", of_all_schemes(shown.PERIOD), "period, linear"),
    LOG(shown.OMEGA_DT, "relative change", of_all_schemes(shown.CHANGE), "energy in one period"),
    Panel(
        shown.OMEGA_DT,
        "growth in one step",
        title="near the limits",
        log="y",
        xlim=(0.4, 3.3),
        ylim=(0.2, 10),
        at=(2.0, math.sqrt(8)),
        legend="upper left",
    ).of(*of_all_schemes(shown.STEP)),
    LOG(
        shown.OMEGA_DT,
        "relative error",
        (OF_EACH(shown.ON_HERTZ, shown.VERLET), OF_EACH(shown.ON_HERTZ, shown.KUTTA, "open", "_")),
        "period, Hertz contact",
    ),
)
ENERGY = (
    Curve(shown.LONG, shown.THEORY, "thick", shown.THEORY),
    OF_EACH(shown.LONG, shown.VERLET),
    OF_EACH(shown.LONG, shown.EULER, "open", "_"),
)
LAST_OCTAVE = (
    OF_HEIGHTS(shown.OCTAVE + " [dB]", "springs"),
    OF_HEIGHTS(shown.OCTAVE + " [dB]", shown.THEORY, "dotted", "_"),
)
GROWTH = (
    Curve(shown.GROWN, shown.THEORY, "exact", shown.THEORY),
    *(
        Curve(shown.GROWN, scheme, style, f"{scheme}, {energy}", of={"of": energy}, bars=True)
        for scheme, energy, style in (
            (shown.VERLET, shown.FREE, "bem"),
            (shown.VERLET, shown.SQUARE, "bem, few cells"),
            (shown.EULER, shown.FREE, "crosses"),
            (shown.EULER, shown.SQUARE, "mdr"),
        )
    ),
)
LONGER = (
    Panel("steps", "|change of energy|", title="very long runs", log="y", ylim=(1e-15, 1e4), legend="center right").of(
        *ENERGY
    ),
    Panel(shown.WIDTH, "error [dB]", title="last one-third octave", at=WAVES, legend="upper left").of(*LAST_OCTAVE),
    LOG(shown.WIDTH, "error over fluctuation", (OF_HEIGHTS(shown.SPACED),), "force against spacing", at=WAVES),
    in_the_air(shown.AIRBORNE, "in the air"),
    in_the_air(shown.HIGHEST, "impacts"),
    Panel("laps", "over the first tenth", title="springs, rough track", log="", legend="upper left").of(*GROWTH),
)
OF_SCHEMES = (
    "Free vibration; thin lines: theory. (a) Error of the period, each scheme up to its limit. (b) Largest change of "
    "the energy within one period. (c) Growth in one step near the limits, dotted. (d) Error of the period on a Hertz "
    "contact: full, velocity Verlet; dotted, Runge-Kutta; contact is lost above a release of " + f"{LIFT_OFF:.3g} d_N."
)
OF_LONGER = (
    "(a) Change of the energy over {c.long_steps} steps: full, velocity Verlet; dotted, explicit Euler. (b) Error of "
    "the last one-third octave by the spacing of springs; upright: a quarter of the shortest wave, and the largest "
    "spacing that represents it. (c) Error of the force on the same tracks. (d) Time airborne, where it is not zero, "
    "and (e) highest force, by height and by load; lines: (14.11). (f) Laps over rough tracks: energy of the free "
    "vibration and, open, mean square acceleration, 95 % of {c.wheels} wheels. Grey in (a), dotted in (b), line in "
    "(f): linear theory."
)
STUDY = Study(
    title="Where time stepping and springs fail",
    method=(
        "The wheel of Table 14.1. Four schemes integrate its free vibration with omega_eigen dt from {c.steps[0]:g} to "
        "past the limit of each, on a linear and on a Hertz contact, released at {c.highest:g} d_N. Above "
        f"{LIFT_OFF:.3g} d_N the Hertz contact opens. "
        "Long runs take {c.long_steps} steps of a / 100 on it, and {c.laps} laps of {c.wheels} wheels over rough "
        "periodic tracks. Springs of many spacings roll on one track. Wheels lift off where tracks are rough or loads "
        "low; the mass is the same at every load."
    ),
    series=shown.series,
    claims=(
        Claim(quantity=(shown.GROWTH, shown.REFUSED)).saying(
            "Time stepping becomes unstable where theory says, and the software rejects steps past that limit.",
            short="Growth of a step and the refusals past its limit, beside theory",
        ),
        Claim(
            quantity=(shown.DRIFT, shown.LAPS.format(shown.SQUARE), shown.LAPS.format(shown.FREE)), model=shown.VERLET
        ).saying(
            "Velocity Verlet keeps the energy over {c.long_steps} steps.",
            short="the energy of velocity Verlet beside its first value",
        ),
        Claim(quantity=shown.OCTAVE).saying(
            "On low roughness springs a quarter of the shortest wave apart have the last one-third octave within 1 dB.",
            short="the last one-third octave on springs a quarter wave apart",
        ),
        Claim(quantity=shown.LIFTED).saying(
            "Wheels lift off where linear theory pulls.", short="the first lift-off beside the first linear tension"
        ),
    ),
    charts=(
        Chart("wheel_stability", columns=2, width=9.0, height=6.6).of(OF_SCHEMES, *SCHEMES),
        Chart("wheel_stability-rough", claims=(1, 2, 3), columns=2, width=9.0, height=9.2).of(OF_LONGER, *LONGER),
    ),
    tables=refused,
    printed=("refusals",),
)
CASE = Case(
    name="wheel_stability",
    chapter=Chapter.LIMITS,
    place=1,
    answers="Where time stepping and springs fail: steps up to and past the limit, long runs, spacing, lift-off",
    quick=shown.WheelStability(),
    full=shown.WheelStability(
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
    run=shown.run,
    study=STUDY,
    needs="closed form",
)
