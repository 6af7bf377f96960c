"""What the ensembles of rough punches show: means, fluctuations and exponents, decade by decade, errors apart."""

from validation.analysis.case import Case, Chapter
from validation.analysis.evidence import Evidence, table_of
from validation.cases.punch import fractal_punch_text as text
from validation.cases.punch.fractal_punch import FractalPunch, FractalPunchResult, run
from validation.cases.punch.fractal_punch_curves import curve, grids, marks
from validation.cases.punch.fractal_punch_decades import QUANTITIES, comparisons_of, data_row, numbers_of, resampled
from validation.cases.punch.fractal_punch_numbers import claimed, criteria, laws
from validation.selection import model_needed
from validation.simulation.rough_punch import require_converged


def evidence(result: FractalPunchResult) -> Evidence:
    """Means, fluctuations and exponents of both methods apart, with what grid and sample leave open.

    Raises NotConvergedError where too few surfaces have converged at one of the forces.
    """
    case = result.case
    for ensemble in result.ensembles:
        require_converged((ensemble.bem, ensemble.coarser, ensemble.finer), result.unconverged)
    samples = [resampled(case, h, ensemble) for h, ensemble in enumerate(result.ensembles)]
    comparisons = comparisons_of(case, samples)
    exponents = laws(case, comparisons)
    pairs = list(zip(result.ensembles, samples, strict=True))
    curves = [row for pair in pairs for row in curve(case, *pair)]
    return Evidence(
        title="Fractal punch (Fig. 14.1)",
        method=text.method(case),
        numbers=(
            *criteria(result, comparisons),
            *claimed(comparisons),
            *exponents,
            *numbers_of(comparisons),
        ),
        tables=(
            table_of("curves", curves),
            table_of("decades", list(map(data_row, comparisons))),
            table_of("grids", [row for pair in pairs for row in grids(case, *pair)]),
            marks(),
        ),
        page_tables=(*(text.matrix(case, name, comparisons) for name in QUANTITIES), text.law_table(case, exponents)),
        conclusions=(
            *(text.summary(name, comparisons) for name in QUANTITIES),
            *text.saturation(curves),
            text.cost(result),
        ),
        captions=text.captions(case),
        unconverged=result.unconverged,
    )


CASE = Case(
    name="fractal_punch",
    chapter=Chapter.PRESSED,
    place=1,
    claim="MDR has the mean stiffness of rough punches and its fluctuation (Fig. 14.1).",
    answers="Fig. 14.1: mean and fluctuation of the contact stiffness of rough punches",
    quick=FractalPunch(),
    full=FractalPunch(cells=256, surfaces=60, profiles=500, per_decade=6, refined=6, refined_per_decade=2),
    run=run,
    evidence=evidence,
    needs=model_needed.punches,
)
