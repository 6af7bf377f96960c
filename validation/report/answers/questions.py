"""The questions of the first screen, in the order of the cases that answer them."""

from validation.cases.punch import bandwidth
from validation.cases.punch import ensembles as punch
from validation.cases.punch import mdr_limits as rolled_off
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling.force_spectrum import LINEAR_3D, ROLLING_SPRINGS, SPRINGS
from validation.cases.wheel import half_space as wheel
from validation.cases.wheel.half_space_study import WHEEL
from validation.report.answers.alternatives import (
    IN_TIME,
    JUDGE,
    LAYER,
    MOVING,
    READ,
    fit,
    linear,
    pressed,
    rolling_springs,
)
from validation.report.answers.question import AlternativeModel, Question
from validation.report.answers.sources import (
    FORCE,
    SLOPE,
    not_modelled,
    of_punch,
    of_rail,
    of_rolling,
    of_wheel,
    waves_of_slope,
)
from validation.report.answers.words import in_decibels, per_cent, times
from validation.report.section import Section

GEIKE = "springs, Geike's rule"


def _slope_of_wheel(section: Section) -> str:
    assert section.evidence
    return f"h' a/d = {section.evidence.table(WHEEL)[SLOPE][0]:.2g}"


def _waves_of_rail(section: Section) -> str:
    assert section.evidence
    return waves_of_slope(section.evidence)


def _hurst(section: Section) -> str:
    return f"H = {section.settings['hurst']:g}"


QUESTIONS = (
    Question(
        name="mean-stiffness",
        asks="Stiffness of a rough punch, its mean over surfaces",
        axis=FORCE,
        model=GEIKE,
        source=of_punch(punch.MEAN),
        printed=per_cent,
        alternatives=(fit(bandwidth.BANDWIDTH), pressed("fractal_punch")),
    ),
    Question(
        name="scatter",
        asks="Scatter of that stiffness over surfaces",
        axis=FORCE,
        model=GEIKE,
        source=of_punch(punch.DEVIATION),
        printed=per_cent,
        alternatives=(pressed("fractal_punch"),),
    ),
    Question(
        name="area-and-gap",
        asks="True contact area and mean gap of a rough punch",
        axis=FORCE,
        model=GEIKE,
        source=not_modelled(rolled_off.AREA, rolled_off.GAP, rolled=False),
        printed=times,
        of_scene=_hurst,
        alternatives=(pressed("mdr_limits"),),
    ),
    Question(
        name="roll-off",
        asks="Stiffness of roughness with a roll-off",
        axis=FORCE,
        model=GEIKE,
        source=not_modelled(rolled_off.STIFFNESS, rolled=True),
        printed=per_cent,
        of_scene=_hurst,
        alternatives=(fit(bandwidth.ROLL_OFF), pressed("mdr_limits")),
    ),
    Question(
        name="rolling-rms",
        asks="Rms force of a rolling wheel",
        axis=SLOPE,
        model=GEIKE,
        source=of_rolling(rolling.RMS_FORCE, SPRINGS),
        printed=per_cent,
        of_scene=_hurst,
        alternatives=(linear(of_rolling(rolling.RMS_FORCE, LINEAR_3D)), JUDGE),
    ),
    Question(
        name="rolling-spectrum",
        asks="Force spectrum of a rolling wheel, band by band",
        axis=SLOPE,
        model=GEIKE,
        source=of_rolling(rolling.LEVEL, SPRINGS),
        printed=in_decibels,
        of_scene=_hurst,
        alternatives=(
            linear(of_rolling(rolling.LEVEL, LINEAR_3D)),
            rolling_springs(of_rolling(rolling.LEVEL, ROLLING_SPRINGS)),
            READ,
            LAYER,
            JUDGE,
        ),
    ),
    Question(
        name="contact-filter",
        asks="Contact filter of a wheel on a rail",
        axis="h' a_x/d",
        model="springs on the measured line, isotropic ground",
        source=of_rail("springs on the line"),
        told=("offset [dB]",),
        printed=in_decibels,
        of_scene=_waves_of_rail,
        alternatives=(
            linear(of_rail("linear, ellipse"), "linear theory of the ellipse"),
            AlternativeModel(name=READ.name, cost=READ.cost, source=of_rail("springs that read the surface")),
            JUDGE,
        ),
    ),
    Question(
        name="dynamic-wheel",
        asks="Acceleration of a dynamic wheel, band by band",
        axis="the spectrum",
        model=GEIKE,
        source=of_wheel(wheel.GEIKE),
        printed=in_decibels,
        of_scene=_slope_of_wheel,
        alternatives=(
            linear(of_wheel(wheel.LINEAR_3D)),
            rolling_springs(of_wheel(wheel.ROLLING)),
            MOVING,
            IN_TIME,
        ),
    ),
)
