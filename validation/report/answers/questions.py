"""The questions of the first screen, in the order of their cases: which numbers answer them, and what else to take."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from validation.analysis.evidence import Evidence
from validation.analysis.statistics import DECIBEL
from validation.cases.punch import bandwidth, work
from validation.cases.punch import ensembles as punch
from validation.cases.punch import mdr_limits as limits
from validation.cases.rail import rail_dynamic, rolled_filters, rough_rail
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling import reduced_models as reduced
from validation.cases.wheel import half_space as wheel
from validation.cases.wheel.features import LEVEL
from validation.cases.wheel.half_space_study import APPLICATIONS, WHEEL
from validation.report.answers.strip import Source

CONTACT, SPRINGS, BEM = "roughness and contact", "springs, Geike's rule", "boundary elements"
Printed = Callable[[float], str]
"""From the difference of a number in decibels to a text with its unit."""


def per_cent(decibels: float) -> str:
    """Of an amplitude: -12 %."""
    return f"{round(100 * math.expm1(decibels / DECIBEL)) + 0:+d} %"


def times(decibels: float) -> str:
    """Of an amplitude: 0.53 times, 350 times."""
    return f"{float(f'{math.exp(decibels / DECIBEL):.2g}'):g} times"


def in_decibels(decibels: float) -> str:
    return f"{round(decibels, 1) + 0.0:+.3g} dB"


@dataclass(frozen=True)
class Alternative:
    """What could be taken in the place of MDR; without a source it is what the others are judged by.

    cost: a text, or one of the evidence of the case that counted it; by: what its margin is of, where that is not the
    quantity of the question.
    """

    name: str
    source: Source | None
    cost: str | Callable[[Evidence], str]
    counted: str = ""
    by: str = ""


@dataclass(frozen=True)
class Question:
    """A row of the first screen.

    asks: without "is MDR enough?"; source: its numbers; printed: their differences; instead: the cheapest first; model:
    what stands for MDR; of_scene: a table and the column of it that says what else the numbers were measured for.
    """

    name: str
    asks: str
    source: Source
    printed: Printed
    instead: tuple[Alternative, ...]
    model: str = SPRINGS
    of_scene: tuple[str, str] | None = None


def worked(evidence: Evidence) -> str:
    """A contact on boundary elements, beside the springs."""
    table = evidence.table(work.WORK)
    applications, cells, springs = (table[name][0] for name in (work.APPLICATIONS, work.CELLS, work.SPRINGS))
    return (
        f"{applications:.0f} applications of the operator to {cells}² cells a surface and load; springs: one sort of "
        f"{springs} for all loads"
    )


def times_springs(model: str, evidence: Evidence) -> str:
    mine = evidence.table(reduced.WORK).where(model=model)["value"]
    least, most = (f"{float(f'{times:.2g}'):,g}" for times in (mine.min(), mine.max()))
    return f"{least if least == most else f'{least} to {most}'} times the counted work of springs on a line"


def steps(evidence: Evidence) -> str:
    table = evidence.table(WHEEL)
    applications, cells = (table[name][0] for name in (APPLICATIONS, "cells to a contact radius"))
    return f"{applications:.0f} applications of the operator in each time step, {cells:.0f} cells to a contact radius"


def counted(name: str, model: str, source: Source | None = None, by: str = "") -> Alternative:
    """With the work of a model on the strips of reduced models."""
    return Alternative(name, source, partial(times_springs, model), "reduced_models", by)


INTEGRAL, BY_FORMULA, OF_SPRINGS = "an integral over the spectrum", "a formula", "the work of springs"
LINEAR_3D, EQUIVALENT = "linear theory in 3D", "springs, rolling-equivalent spectrum"
FIT = partial(Alternative, "the fit 1/kbar = 1/1.1523 + 0.48/Fbar", cost=BY_FORMULA)
PRESSED = partial(Alternative, BEM, None, worked)
over_force = partial(Source, axis=punch.FORCE, over=punch.FORCE)
of_punch = partial(over_force, case="fractal_punch", model=punch.OVER, where={"H": float}, series=("H",))
of_limits = partial(over_force, case="mdr_limits", model=punch.OVER, series=(limits.ROLL_OFF,))
of_fit = partial(
    over_force, case="bandwidth", series=bandwidth.KINDS, quantity=punch.MEAN + bandwidth.OF_BEM, model=bandwidth.FIT
)
of_rolling = partial(
    Source, case="rolling", axis="h/d", over=reduced.SLOPE, read=(reduced.SLOPE, "value"), series=("q a",)
)
of_strips = partial(
    Source,
    case="reduced_models",
    quantity=reduced.OFF,
    axis=reduced.SLOPE,
    over=reduced.SLOPE,
    series=("H", reduced.Q),
)
of_rail = partial(
    Source,
    case="rough_rail",
    quantity=rolled_filters.OVER_BEM,
    where={"waves": rough_rail.LONG},
    axis=rough_rail.OFFSET,
    over="h' a_x/d",
    read=(CONTACT, "h' a_x / d"),
)
of_wheel = partial(Source, case="wheel_3d", quantity=LEVEL, axis="range", over="the spectrum")
BEM_IN_MOTION, SPRINGS_IN_MOTION = rail_dynamic.MODELS
MOVING = Source(
    case="rail_dynamic",
    quantity=rail_dynamic.RMS + rail_dynamic.BESIDE,
    model=f"{SPRINGS_IN_MOTION} over {BEM_IN_MOTION}",
    axis=rail_dynamic.OFFSET,
    over=rail_dynamic.OFFSET,
)
GEIKE, LINEAR, ROLLING = (
    model + rolling.OVER for model in (rolling.SPRINGS, rolling.LINEAR_3D, rolling.ROLLING_SPRINGS)
)
READ, ON_LINE = rolled_filters.RIVALS[:2]
JUDGE, OCTAVES = counted(BEM, reduced.JUDGE), "rms over octaves"
QUESTIONS = (
    Question(
        "mean-stiffness",
        "Stiffness of a rough punch, its mean over surfaces",
        of_punch(quantity=punch.MEAN),
        per_cent,
        (FIT(of_fit(where={bandwidth.BANDWIDTH: ...})), PRESSED("fractal_punch")),
    ),
    Question(
        "scatter",
        "Scatter of that stiffness over surfaces",
        of_punch(quantity=punch.DEVIATION),
        per_cent,
        (PRESSED("fractal_punch"),),
    ),
    Question(
        "area-and-gap",
        "True contact area and mean gap of a rough punch",
        of_limits(quantity=(limits.AREA, limits.GAP)),
        times,
        (PRESSED("mdr_limits"),),
    ),
    Question(
        "roll-off",
        "Stiffness of roughness with a roll-off",
        of_limits(quantity=limits.STIFFNESS, where={limits.ROLL_OFF: lambda place: place != 1}),
        per_cent,
        (FIT(of_fit(where={bandwidth.ROLL_OFF: ...})), PRESSED("mdr_limits")),
    ),
    Question(
        "rolling-rms",
        "Rms force of a rolling wheel",
        of_rolling(quantity=rolling.RMS_FORCE, model=GEIKE),
        per_cent,
        (Alternative(LINEAR_3D, of_rolling(quantity=rolling.RMS_FORCE, model=LINEAR), INTEGRAL), JUDGE),
    ),
    Question(
        "rolling-spectrum",
        "Force spectrum of a rolling wheel, band by band",
        of_rolling(quantity=rolling.LEVEL, model=GEIKE),
        in_decibels,
        (
            Alternative(LINEAR_3D, of_rolling(quantity=rolling.LEVEL, model=LINEAR), INTEGRAL),
            Alternative(EQUIVALENT, of_rolling(quantity=rolling.LEVEL, model=ROLLING), OF_SPRINGS),
            counted(reduced.READ, reduced.READ, of_strips(model=reduced.READ), OCTAVES),
            counted(reduced.LAYER, reduced.COARSE_LAYER, of_strips(model=reduced.COARSE_LAYER), OCTAVES),
            JUDGE,
        ),
    ),
    Question(
        "contact-filter",
        "Contact filter of a wheel on a rail",
        of_rail(model=ON_LINE),
        in_decibels,
        (
            Alternative("linear theory of the ellipse", of_rail(model=rolled_filters.FILTERS[0]), INTEGRAL),
            counted(reduced.READ, reduced.READ, of_rail(model=READ)),
            JUDGE,
        ),
        "springs on the measured line, isotropic ground",
        (CONTACT, rough_rail.WAVES),
    ),
    Question(
        "dynamic-wheel",
        "Acceleration of a dynamic wheel, band by band",
        of_wheel(model=wheel.OVER_BEM[wheel.GEIKE]),
        in_decibels,
        (
            Alternative(LINEAR_3D, of_wheel(model=wheel.OVER_BEM[wheel.LINEAR_3D]), INTEGRAL),
            counted(f"on a rail, {reduced.READ} in the time loop", reduced.READ, MOVING, "rms over bands"),
            Alternative(f"{BEM} in the time loop", None, steps, "wheel_3d"),
        ),
        of_scene=(WHEEL, reduced.SLOPE),
    ),
)
