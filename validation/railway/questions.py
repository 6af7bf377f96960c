"""What this house asks on the front page: the contact filter, and springs in the motion of a wheel on a rail."""

from functools import partial

from validation.analysis.number_text import level_in_decibels
from validation.cases.rolling.reduced_models import READ
from validation.railway.cases import across, filters, rail_dynamic
from validation.railway.cases.rolled_filters import OVER_BEM
from validation.report.answers.question import BEM, INTEGRAL, Alternative, Question
from validation.report.answers.strip import Source

of_rail = partial(
    Source,
    case="across",
    quantity=OVER_BEM,
    where={filters.OFFSET: 0.0},
    axis=across.GROUND,
    printed="what lies across",
    series=(across.WHEEL,),
)
MOVING = Source(
    case="rail_dynamic",
    quantity=rail_dynamic.RMS + rail_dynamic.BESIDE,
    model=rail_dynamic.SPRINGS_OVER_BEM,
    where={rail_dynamic.RAIL: rail_dynamic.BEAM},
    axis=filters.OFFSET,
)
QUESTIONS = (
    Question(
        "contact-filter",
        "Contact filter of a wheel on a rail, ensemble mean",
        of_rail(model=across.LINES[0]),
        level_in_decibels,
        (
            Alternative(across.MODELS[0], of_rail(model=across.MODELS[0]), INTEGRAL),
            Alternative(filters.BED_WIDER, of_rail(model=filters.BED_WIDER), INTEGRAL),
            Alternative(BEM),
        ),
        "springs on one measured line",
    ),
)
ALTERNATIVES = {
    "dynamic-wheel": Alternative(f"on a rail, {READ} in the time loop", MOVING, by="rms over bands"),
}
"""To MDR in questions of the core, by their names."""
