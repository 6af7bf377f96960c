"""What could be taken in the place of MDR, and what it costs, from counts of the cases."""

from functools import partial

from validation.analysis.evidence import Evidence
from validation.cases.punch.work import WORK, Worked
from validation.cases.rolling import reduced_models as reduced
from validation.cases.wheel.half_space_study import APPLICATIONS, WHEEL
from validation.report.answers.cells import NumberSource
from validation.report.answers.question import AlternativeModel, ModelCost
from validation.report.answers.sources import of_fit, of_moving_wheel, of_strips

BEM = "boundary elements"


def _worked(evidence: Evidence) -> str:
    """A contact on boundary elements, beside the springs."""
    work = Worked.read(evidence.table(WORK))
    return (
        f"{work.applications:.0f} applications of the operator to {work.cells}² cells a surface and load; springs: "
        f"one sort of {work.springs} for all loads"
    )


def _times_springs(model: str, evidence: Evidence) -> str:
    mine = evidence.table(reduced.WORK).where(model=model)["value"]
    least, most = (f"{float(f'{times:.2g}'):,g}" for times in (mine.min(), mine.max()))
    return f"{least if least == most else f'{least} to {most}'} times the counted work of springs on a line"


def steps(evidence: Evidence) -> str:
    work = evidence.table(WHEEL)
    applications, cells = (work[name][0] for name in (APPLICATIONS, "cells to a contact radius"))
    return f"{applications:.0f} applications of the operator in each time step, {cells:.0f} cells to a contact radius"


def rolled(model: str) -> ModelCost:
    return ModelCost(case="reduced_models", text=partial(_times_springs, model))


def pressed(case: str) -> AlternativeModel:
    return AlternativeModel(name=BEM, cost=ModelCost(case=case, text=_worked))


def as_springs(evidence: Evidence) -> str:
    return "the work of springs"


def formula(evidence: Evidence) -> str:
    return "a formula"


def integral(evidence: Evidence) -> str:
    return "an integral over the spectrum"


FIT = "the fit 1/kbar = 1/1.1523 + 0.48/Fbar"


def fit(kind: str) -> AlternativeModel:
    return AlternativeModel(name=FIT, source=of_fit(kind), cost=ModelCost(case="bandwidth", text=formula))


def linear(source: NumberSource, name: str = "linear theory in 3D") -> AlternativeModel:
    return AlternativeModel(name=name, source=source, cost=ModelCost(case=source.case, text=integral))


def rolling_springs(source: NumberSource) -> AlternativeModel:
    name = "springs, rolling-equivalent spectrum"
    return AlternativeModel(name=name, source=source, cost=ModelCost(case=source.case, text=as_springs))


def on_strips(name: str, model: str) -> AlternativeModel:
    """A reduced model, judged and counted on the same strips."""
    return AlternativeModel(name=name, cost=rolled(model), source=of_strips(model), by="rms over octaves")


JUDGE = AlternativeModel(name=BEM, cost=rolled(reduced.JUDGE))
READ = on_strips(reduced.READ, reduced.READ)
LAYER = on_strips(reduced.LAYER, reduced.COARSE_LAYER)
MOVING = AlternativeModel(
    name="on a rail, springs that read the surface in the time loop",
    cost=rolled(reduced.READ),
    source=of_moving_wheel(),
    by="rms over bands",
    axis="dB over the curve",
)
IN_TIME = AlternativeModel(name="boundary elements in the time loop", cost=ModelCost(case="wheel_3d", text=steps))
