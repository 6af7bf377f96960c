"""The questions of the first screen, in the order of their cases."""

from dataclasses import replace
from functools import partial

from validation.analysis.number_text import level_in_decibels, level_in_per_cent
from validation.analysis.quantity import RMS_FORCE
from validation.cases.punch import ensembles as punch
from validation.cases.punch import fractal_punch_study as fig_14_1
from validation.cases.punch import interface
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling import reduced_models as reduced
from validation.cases.wheel import half_space as wheel
from validation.cases.wheel.ensembles import LEVEL
from validation.cases.wheel.half_space_study import WHEEL
from validation.engine.street import objects_of_houses
from validation.report.answers.question import (
    BEM,
    INTEGRAL,
    Alternative,
    Question,
    a_surface,
    a_track,
    a_wheel,
    an_integral,
)
from validation.report.answers.strip import Source
from validation.report.contents import CASES
from validation.simulation.model_names import SPRINGS_ROLLING

LINEAR_3D = wheel.LINEAR_3D
PRESSED = Alternative(BEM, timed=a_surface())
of_punch = partial(Source, case="fractal_punch", axis=punch.FORCE, series=("H",))
of_mdr = partial(of_punch, model=punch.OVER, where={"H": float})
of_rolled_off = partial(
    Source, case="interface", model=punch.OVER, axis=interface.CONTACT, series=(interface.ROLL_OFF, "H")
)
FIT = of_punch(quantity=punch.MEAN, model=fig_14_1.FIT)
of_rolling = partial(Source, case="rolling", axis=rolling.SLOPE)
of_strips = partial(Source, case="reduced_models", quantity=reduced.OFF, axis=rolling.SLOPE, series=("H", rolling.Q))
of_wheel = partial(Source, case="wheel_3d", quantity=LEVEL, axis="range", printed="the spectrum")
GEIKE, LINEAR = (model + rolling.OVER for model in (rolling.SPRINGS, rolling.LINEAR_3D))
JUDGE = Alternative(BEM, timed=a_track(12))
IN_3D = partial(Alternative, LINEAR_3D, cost=INTEGRAL, timed=an_integral)
OF_THE_CORE = (
    Question(
        "mean-stiffness",
        "Stiffness of a rough punch, ensemble mean",
        of_mdr(quantity=punch.MEAN),
        level_in_per_cent,
        (
            Alternative("the fit 1/kbar = 1/1.1523 + 0.48/Fbar", FIT, "a formula"),
            Alternative(BEM, timed=a_surface(punch.MEAN)),
        ),
    ),
    Question(
        "scatter",
        "Scatter of that stiffness over the ensemble",
        of_mdr(quantity=punch.DEVIATION),
        level_in_per_cent,
        (Alternative(BEM, timed=a_surface(punch.DEVIATION)),),
    ),
    Question(
        "roll-off",
        "Stiffness of a rough punch with a roll-off, ensemble mean",
        of_rolled_off(quantity=interface.STIFFNESS),
        level_in_per_cent,
        (PRESSED,),
    ),
    Question(
        "rolling-rms",
        "Rms force of a rolling wheel, ensemble mean",
        of_rolling(quantity=RMS_FORCE, model=GEIKE),
        level_in_per_cent,
        (IN_3D(of_rolling(quantity=RMS_FORCE, model=LINEAR)), JUDGE),
    ),
    Question(
        "rolling-spectrum",
        "Force spectrum of a rolling wheel, ensemble mean, rms over octaves",
        of_rolling(quantity=rolling.RMS_LEVEL, model=GEIKE),
        level_in_decibels,
        (
            IN_3D(of_rolling(quantity=rolling.RMS_LEVEL, model=LINEAR)),
            Alternative(SPRINGS_ROLLING, of_rolling(quantity=rolling.RMS_LEVEL, model=SPRINGS_ROLLING + rolling.OVER)),
            Alternative(reduced.PRINTED[reduced.COARSEST], of_strips(model=reduced.COARSEST), timed=a_track(4)),
            JUDGE,
        ),
    ),
    Question(
        "dynamic-wheel",
        "Acceleration of a dynamic wheel, ensemble mean, band by band",
        of_wheel(model=wheel.OVER_BEM[wheel.GEIKE]),
        level_in_decibels,
        (
            Alternative(LINEAR_3D, of_wheel(model=wheel.OVER_BEM[wheel.LINEAR_3D]), INTEGRAL),
            Alternative(SPRINGS_ROLLING, of_wheel(model=wheel.OVER_BEM[wheel.ROLLING])),
            Alternative(f"{BEM} in the time loop", timed=a_wheel),
        ),
        of_scene=(WHEEL, rolling.SLOPE),
    ),
)


def _all_questions() -> tuple[Question, ...]:
    """Those of the core and of the houses that are there, in the order of their cases; a house may add alternatives."""
    more = {
        name: question for alternatives in objects_of_houses("alternatives") for name, question in alternatives.items()
    }
    core = [
        replace(question, instead=(*question.instead[:-1], more[question.name], question.instead[-1]))
        if question.name in more
        else question
        for question in OF_THE_CORE
    ]
    questions_of_all = [*core, *(question for questions in objects_of_houses("questions") for question in questions)]
    return tuple(sorted(questions_of_all, key=lambda question: list(CASES).index(question.source.case)))


QUESTIONS = _all_questions()
