"""What the ensembles of rough punches show: means, fluctuations and exponents, decade by decade, errors apart."""

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, table_of
from validation.cases.punch import fractal_punch_text as text
from validation.cases.punch.fractal_punch import FractalPunch, FractalPunchResult, run
from validation.cases.punch.fractal_punch_claims import CLAIM, claims
from validation.cases.punch.fractal_punch_cost import estimator
from validation.cases.punch.fractal_punch_curves import curve, decades, grids, marks, order, points
from validation.cases.punch.fractal_punch_decades import (
    DEVIATION,
    MEAN,
    QUANTITIES,
    PunchStatistics,
    comparisons_of,
    numbers_of,
)
from validation.cases.punch.fractal_punch_headlines import finding, headlines
from validation.cases.punch.fractal_punch_numbers import claimed, criteria, laws
from validation.cases.punch.work import Worked
from validation.selection import model_needed
from validation.simulation.rough_punch import BEM, require_converged


def evidence(result: FractalPunchResult) -> Evidence:
    """Means, fluctuations and exponents of both methods apart, with what grid and sample leave open.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case, found = result.case, PunchStatistics(result)
    for ensemble in result.ensembles:
        for cells, outcome in ensemble.outcomes[BEM].items():
            pressed = [level for level, force in enumerate(case.forces) if case.count(force, cells)]
            require_converged([{"stiffness": outcome["stiffness"][:, pressed]}], result.unconverged)
    comparisons = comparisons_of(found)
    exponents = laws(case, comparisons)
    curves = [row for ensemble in result.ensembles for row in curve(found, ensemble)]
    by_force = order(found) if len(case.hursts) > 1 else []
    costs, answers = estimator(found), claims(comparisons, exponents)
    return Evidence(
        title="Fractal punch (Fig. 14.1)",
        method=text.method(case),
        claims=answers,
        finding=finding(comparisons, answers),
        headlines=headlines(comparisons, curves, answers),
        numbers=(
            *criteria(result, comparisons),
            *claimed(comparisons),
            *exponents,
            *numbers_of(comparisons),
        ),
        tables=(
            table_of("curves", curves),
            table_of("points", points(comparisons)),
            table_of("decades", decades(comparisons)),
            table_of("grids", [row for ensemble in result.ensembles for row in grids(found, ensemble)]),
            table_of("estimator", costs),
            *([table_of("order", by_force)] if by_force else []),
            marks(),
            _worked(result).table,
        ),
        page_tables=(
            *(text.matrix(name, comparisons) for name in QUANTITIES),
            *(text.margins(name, comparisons) for name in (DEVIATION, MEAN)),
            text.law_table(case, exponents),
            text.plan(case, costs),
        ),
        conclusions=(
            *text.order(by_force),
            *text.cost(result, costs),
        ),
        captions=text.captions(case),
        unconverged=result.unconverged,
    )


def _worked(result: FractalPunchResult) -> Worked:
    case = result.case
    return Worked.of(case.cells, case.points, [e.outcomes[BEM][case.cells] for e in result.ensembles])


CASE = Case(
    name="fractal_punch",
    chapter=Chapter.PRESSED,
    place=1,
    claim=CLAIM,
    answers="Fig. 14.1: mean and fluctuation of the contact stiffness of rough punches",
    quick=FractalPunch(
        hursts=(0.4, 0.7, 1.0),
        cells=48,
        surfaces=(
            *((0, 0, 30, 16, 8, 4),) * 2,
            *((0, 40, 12, 6, 0, 0),) * 2,
            *((60, 16, 8, 4, 0, 0),) * 2,
            *((30, 10, 6, 4, 0, 0),) * 2,
        ),
    ),
    full=FractalPunch(
        cells=256,
        surfaces=(
            (0, 0, 7000, 2500, 600, 130),
            (0, 0, 4000, 1000, 100, 0),
            *((0, 4500, 750, 210, 0, 0),) * 2,
            *((1500, 300, 80, 16, 0, 0),) * 2,
            *((300, 60, 20, 4, 0, 0),) * 2,
        ),
        profiles=30000,
        fine_profiles=1000,
    ),
    run=run,
    evidence=evidence,
    needs=model_needed.punches,
)
