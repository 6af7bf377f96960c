"""Which numbers of which case answer a question, and where they stand on its axis."""

from validation.analysis.evidence import Evidence, Number, Place
from validation.cases.punch import bandwidth
from validation.cases.punch import ensembles as punch
from validation.cases.punch import mdr_limits as rolled_off
from validation.cases.rail import rail_dynamic, rolled_filters, rough_rail
from validation.cases.rolling import reduced_models
from validation.cases.wheel.features import LEVEL
from validation.cases.wheel.half_space import OVER_BEM
from validation.report.answers.cells import NumberSource

FORCE, SLOPE = "Fbar", "h' a/d"
OVER = "mdr over bem3d"


def of_punch(quantity: str) -> NumberSource:
    return NumberSource(
        case="fractal_punch",
        quantities=(quantity,),
        model=OVER,
        axis=FORCE,
        series=("H",),
        keep=lambda number: not isinstance(number.where["H"], str),
    )


def not_modelled(*quantities: str, rolled: bool) -> NumberSource:
    return NumberSource(
        case="mdr_limits",
        quantities=quantities,
        model=OVER,
        axis=FORCE,
        series=(rolled_off.ROLL_OFF,),
        keep=lambda number: not rolled or number.where[rolled_off.ROLL_OFF] != 1,
    )


def _slope_of_height(evidence: Evidence, number: Number) -> Place:
    return float(evidence.table(SLOPE).where(**{"h/d": number.where["h/d"]})["value"][0])


def of_rolling(quantity: str, model: str) -> NumberSource:
    return NumberSource(
        case="rolling",
        quantities=(quantity,),
        model=f"{model} over bem3d",
        axis="h/d",
        series=("q a",),
        place=_slope_of_height,
    )


def of_strips(model: str) -> NumberSource:
    return NumberSource(
        case="reduced_models",
        quantities=(reduced_models.OFF,),
        model=model,
        axis=SLOPE,
        series=("H", "q a"),
    )


def _slope_of_offset(evidence: Evidence, number: Number) -> Place:
    roughness = evidence.table("roughness and contact")
    return float(roughness.where(**{"offset [dB]": number.where["offset [dB]"]})["h' a_x / d"][0])


def waves_of_slope(evidence: Evidence) -> str:
    """Which waves the slope of a rail counts; empty of a case that is kept from before it said so."""
    counted = evidence.table("roughness and contact").columns.get(rough_rail.WAVES)
    return f"h' of waves of {counted[0]}" if counted else ""


def of_rail(model: str) -> NumberSource:
    return NumberSource(
        case="rough_rail",
        quantities=(rolled_filters.OVER_BEM,),
        model=model,
        axis="offset [dB]",
        place=_slope_of_offset,
        keep=lambda number: number.where["waves"] == rough_rail.LONG,
    )


def of_wheel(model: str) -> NumberSource:
    return NumberSource(case="wheel_3d", quantities=(LEVEL,), model=OVER_BEM[model], axis="range")


def of_fit(kind: str) -> NumberSource:
    """The fit, at several bandwidths or with a roll-off."""
    return NumberSource(
        case="bandwidth",
        quantities=(punch.MEAN + bandwidth.OF_BEM,),
        model=bandwidth.FIT,
        axis=FORCE,
        series=(kind,),
        keep=lambda number: kind in number.where,
    )


def of_moving_wheel() -> NumberSource:
    """Springs that read the surface over boundary elements, both in motion."""
    return NumberSource(
        case="rail_dynamic",
        quantities=(rail_dynamic.RMS + rail_dynamic.BESIDE,),
        model="springs that read the surface over bem3d",
        axis=rail_dynamic.OFFSET,
    )
