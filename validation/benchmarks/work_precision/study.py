"""What error against cost shows, declared."""

from collections.abc import Sequence

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart
from validation.analysis.claims import Claim
from validation.analysis.evidence import Number, Whose
from validation.analysis.printed import times_source
from validation.analysis.study import Study
from validation.benchmarks.work_precision import case
from validation.benchmarks.work_precision.figure_cost import COST_OF_STEPS


class ClaimOfTheClosest(Claim):
    """Of each scene and quantity the model with the smallest error alone tests it."""

    def chosen(self, numbers: Sequence[Number]) -> list[Number]:
        best: dict[object, Number] = {}
        for number in super().chosen(numbers):
            key = number.where["scene"], number.quantity
            best[key] = min(best.get(key, number), number, key=lambda one: one.value + one.uncertainty)
        return list(best.values())


MARKS = (
    "Grey: the uncertainty of the reference, or, for closed forms, below the smallest error; marks at its edge, "
    "pointing down, lie within it. Thick line: the Pareto front, by upper ends of errors. Bars: 95 % of the sample, "
    "quartiles of times. Crosses along the top: failed or out of range, for the reason in the table."
)


def hours(number: Number) -> str:
    return f"Fig. 14.4 takes {number.value:.2g} h on one core"


STUDY = Study(
    title="Speed against accuracy: the error and the cost of every method",
    method=(
        "Each method is a curve along a parameter: cells, springs, residual. Error: beside closed forms where there "
        "are any; elsewhere beside the two finest grids of boundary elements on the same surfaces, extrapolated to "
        "cells of zero size. The last step of this extrapolation is the uncertainty of the reference, and errors below "
        "it are treated as equal to it. Methods are ranked by the upper 95 % bound; if a finer setting has a larger "
        "bound, that one is used. Errors of the two finest grids are steps of their own extrapolation. Spectra: root "
        "mean square, over one-third octaves, of level differences. Springs have roughness of their own, "
        "{c.fractal.profiles} profiles, {c.rolling.tracks} tracks, {c.wheel.wheels} wheels; boundary elements "
        "{c.fractal.realisations} surfaces, {c.rolling.realisations} and {c.wheel.realisations} strips, whose linear "
        "force takes most of their scatter away; these are periodic, which closed forms are not. Cost: seconds of one "
        "realisation, methods in turns, one thread, median and quartiles; claims compare medians with their 95 % "
        "intervals at the worst error of a chart; set-up (operators, plans, a first drawing) is timed apart. Work, the "
        "same on every machine: cells times operator applications, as if on the whole grid (rolling: on a square "
        "around the smooth contact), springs evaluated, points filtered, nodes of a quadrature. Extrapolated boundary "
        "elements cost both grids. Results of force-controlled solvers are converted to the prescribed approach with "
        "the closed-form load curve. Fig. 14.4: {c.cost.wheels} wheels over {c.cost.scene.distance:g} m, on springs or "
        "with boundary elements at each time step."
    ),
    series=case.series,
    tables=case.tables,
    printed=(case.WITHIN, case.WITHOUT, COST_OF_STEPS),
    claims=(
        Claim(quantity=case.TIME, printed=times_source).saying(
            "At each error springs are the cheapest method, or boundary elements where springs do not reach it.",
            short="Springs, or boundary elements below their error, are the cheapest method",
        ),
        Claim(quantity=case.COST, differ=True, whose=Whose.BOOK, printed=hours).saying(
            "The rolling contact of a rough wheel in three dimensions is too costly for boundary elements."
        ),
    ),
    charts=(Chart("precision", claims=(0,)).of(f"Error against seconds, a chart a quantity. {MARKS}"),),
)
CASE = Case(
    name="precision",
    chapter=Chapter.SPEED,
    place=1,
    answers="Speed against accuracy: error against cost of every method, and the cheapest within each error",
    quick=case.QUICK,
    full=case.FULL,
    run=case.run,
    study=STUDY,
    needs="scene by scene",
    timed=True,
)
