"""Fig. 14.1: both methods beside each other, decade by decade, the errors of sample and grid apart."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from validation.analysis.claim_text import THREE_D_DIFFER
from validation.analysis.claims import Matrix
from validation.analysis.evidence import Number, Place, Role, Whose, numbers_with
from validation.analysis.number_text import per_cent
from validation.analysis.series import Counted, Margin, spans
from validation.analysis.statistics import DECIBEL, Linearised
from validation.case import Case, Chapter, Chart, Claim, Curve, Outcomes, Panel, Series, Study
from validation.cases.punch import fractal_punch as shown
from validation.cases.punch.ensembles import DEVIATION, FEW, FORCE, MEAN, OVER
from validation.simulation import model_needed
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR
from validation.simulation.rough_punch import FEW_CELLS
from validation.theory import closed_forms

EXPONENT, LESS, OF_LONG = "exponent", "springs less boundary elements", ", L_1D = 1.1523 L"
OF_BEM = BEM
OF_LAW = f"{OF_BEM} beside {shown.LAW}"
PRINTED, FIT = ", as Fig. 14.1 shows it", "fit"
LEVEL = Margin(
    tolerance=DECIBEL * math.log(1.1),
    reason="10 %: 0.8 dB, less than the 1 dB within which measured levels of rolling repeat",
    source="boundary elements, extrapolated",
)
FIGURE = replace(
    LEVEL,
    tolerance=3.0,
    reason="3 dB: 60 surfaces on one side leave 20 % to chance, and curves 40 % apart are no longer similar",
)
DIGITS = replace(LEVEL, tolerance=0.02, reason="the published exponents have two digits")
FACTOR = "3 dB: since k ~ F^(1/(1+H)), a wrong factor 2 in the force or the length changes k by 3 dB or more, H <= 1"
PUBLISHED = (0.51, 0.77)
"""Exponents at H = 1 and 0: Pohrt and Popov, Phys. Rev. Lett. 108, 104301 (2012), abstract."""
CARRIED, LIGHT = 0.01, 0.1
"""Fbar from which more than the last asperities carry, and up to which the face carries in parts."""
HEAVY = (0.4, 10.0)
"""Forces that the fit is for: most of the face carries."""


def series(result: Outcomes) -> list[Series]:
    """Raises NotConvergedError where too few surfaces have converged at one of the forces."""
    case, statistics = result.case, shown.PunchStatistics(result)
    statistics.require_converged()
    return [
        *shown.criteria(statistics),
        *(series for hurst in case.hursts for series in shown.curves(statistics, hurst)),
        *(series for hurst in case.hursts for series in compared(statistics, hurst)),
        *shown.trends(statistics),
    ]


def compared(statistics: shown.PunchStatistics, hurst: float) -> Iterator[Series]:
    """Each 1D model over boundary elements; every decade is judged by its worst force, whose intervals hold at once."""
    case = statistics.case
    where: dict[str, Place] = {shown.H: hurst}
    judged = partial(case.in_decibels, where=where, shown=lambda x: math.exp(x / DECIBEL), fewest=case.per_decade + 1)
    for statistic, method, margins in (
        (DEVIATION, MDR, {DEVIATION: LEVEL, DEVIATION + PRINTED: FIGURE}),
        (MEAN, MDR, {MEAN: LEVEL}),
        (MEAN, shown.LONG, {MEAN + OF_LONG: LEVEL}),
    ):
        ratios = [statistics.ratio(hurst, method, statistic, level) for level in range(len(case.forces))]
        values, grid = [ratio.value for ratio in ratios], [ratio.grid for ratio in ratios]
        as_judged = counted(statistics, hurst, method) if statistic == DEVIATION else None
        for name, margin in margins.items():
            yield judged(name, OVER, values, grid=grid, margin=margin, counted=as_judged)
    bem = [statistics.at(hurst, BEM, MEAN, level) for level in range(len(case.forces))]
    of_fit = [Linearised(math.log(fitted(case, force)), np.zeros(1)) for force in case.forces]
    differences = [fit.minus_independent(stiffness.value) for fit, stiffness in zip(of_fit, bem, strict=True)]
    yield judged(
        MEAN,
        FIT,
        differences,
        grid=[stiffness.grid for stiffness in bem],
        margin=LEVEL,
        ranges=spans(case.forces, HEAVY),
        fewest=2,
    )
    yield from exponents(statistics, hurst)


def counted(statistics: shown.PunchStatistics, hurst: float, method: str) -> Counted:
    """Ratios of deviations as verdicts are about them."""
    ratios = [statistics.counted(hurst, method, level) for level in range(len(statistics.case.forces))]
    return Counted([ratio.value for ratio in ratios], [ratio.grid for ratio in ratios], shown.RULE)


def exponents(statistics: shown.PunchStatistics, hurst: float) -> Iterator[Series]:
    """Decade by decade; off the last asperity and off saturation beside those that are published, all H at once."""
    case = statistics.case
    tested = min(case.first_forces, key=lambda force: abs(math.log(force / 0.01)))
    steep, flat = max(PUBLISHED), min(PUBLISHED)
    for first in case.first_forces:
        springs, bem = (statistics.exponent(hurst, method, *case.decade(first)) for method in (MDR, BEM))
        difference = springs.minus_independent(bem)
        place: dict[str, Place] = {shown.H: hurst, FORCE: (first, 10 * first)}
        yield Series(EXPONENT, LESS, (difference.value,), where=place, grid=[difference.grid], margin=DIGITS)
        if first == tested:
            law = partial(Series, EXPONENT, where=place, family=len(case.hursts), grid=[bem.grid])
            for model, source, reference in (
                (
                    OF_BEM,
                    "Pohrt and Popov (2012), linear between H = 0 and 1",
                    steep + (flat - steep) * hurst,
                ),
                (OF_LAW, "an unbounded spectrum", 1 / (1 + hurst)),
            ):
                yield law(model, (bem.value,), margin=replace(DIGITS, source=source), reference=reference)


def fitted(case: shown.FractalPunch, force: float) -> float:
    """k / (E* L) of the fit, the flat punch in series with its rough face."""
    h = case.height
    return closed_forms.rough_punch_stiffness(side=1.0, modulus=1.0, force=force * h, height=h)


def once_more(result: Outcomes, numbers: Sequence[Number]) -> list[Number]:
    """Where the means may differ most, within 3 dB: the models share no code, so an error in one of them shows there.

    In decades whose lightest contacts have cells enough at every H, and in the last.
    """
    case, statistics = result.case, shown.PunchStatistics(result)
    light = {
        (case.forces[first], case.forces[last])
        for first, last in map(case.decade, case.first_forces[:-1])
        if min(statistics.contact(hurst, first, case.cells) for hurst in case.hursts) < FEW_CELLS
    }
    mean = [n for n in numbers_with(numbers, MEAN, OVER) if n.where[FORCE] not in light]
    farthest = max(mean, key=lambda n: abs(n.value) + n.uncertainty, default=None)
    name = MEAN + " where the models may differ most, within 3 dB"
    return [replace(farthest, quantity=name, tolerance=3.0, reason=FACTOR, role=Role.CRITERION)] if farthest else []


COMPARED = (
    Curve(shown.STIFFNESS, BEM, "marks", bars=True),
    Curve(shown.STIFFNESS, FEW, "open marks", bars=True),
    Curve(shown.STIFFNESS, MDR, "lines", "MDR, L_1D = L", band=True),
    Curve(shown.STIFFNESS, shown.LONG, "lines", "MDR, L_1D = 1.1523 L"),
    Curve(shown.STIFFNESS, shown.LAW),
)
LINES = (
    "Circles: boundary elements, open where the mean contact has few cells. Line: MDR, L_1D = L; dashed: L_1D = 1.1523 "
    "L. Bars and band: 95 % of the sample."
)


def _by_hurst(
    part: str,
    caption: str,
    quantity: str,
    label: str,
    drawn: Sequence[Curve] = COMPARED,
    claim: int = 0,
    **panel: object,
) -> Chart:
    """A panel for each Hurst exponent."""
    curves = tuple(replace(curve, quantity=quantity) for curve in drawn)
    panels = (Panel(FORCE, label, facet=shown.H, **panel).of(*curves),)  # type: ignore[arg-type]
    name = f"fractal_punch-{part}"
    return Chart(name, claims=(claim,)).of(caption, *panels)


at_each_hurst = partial(Claim, model=OVER, where={shown.H: float}, along=FORCE, printed=per_cent)
of_hursts = partial(Matrix, rows=(shown.H,), columns=FORCE)
at_h = partial(Curve, by=(shown.H,), band=True)
BEM_AT_H = (at_h(shown.SCATTER, BEM), at_h(shown.SCATTER, FEW, "open marks", "_"))
STUDY = Study(
    title="Fractal punch (Fig. 14.1)",
    method=(
        "A rigid square punch of side L, rough from q_min = 2π/L to a quarter of its cells times that, no roll-off, "
        "amplitudes fixed by the spectrum as in (14.8), so that every draw has its rms height h exactly. Surfaces and "
        "profiles have the same phases for every H, so that sampling noise does not hide the order of the curves. Both "
        "are pressed with equal forces; Fbar = F / (E* h L), kbar = k / (E* L). {c.profiles} profiles of Geike's "
        "spectrum on {c.points} springs, {c.fine_profiles} of them on twice as many. Surfaces, boundary elements: "
        "{c.plan}. The coarsest grid lacks the waves shorter than two of its cells; all others have the whole band. "
        "Mean and variance are sums over grids: of all surfaces on the coarsest, and of the changes to the next finer "
        "grid on the surfaces that both have (multilevel Monte Carlo). Both sums are unbiased. On the coarsest grid of "
        "all the mean, and it alone, is found by regression on the heights of {c.drawn} surfaces, pressed or not "
        "(control variates): the highest 0.1, 1 and 10 % of the cells, and three moments weighted by the pressure of "
        "the flat punch. The stiffness is that of the fixed contact area (3D) and of the springs in contact (1D). "
        "There are three errors. Sample: intervals that hold at 95 % for all forces of a decade at once. Grid: "
        "boundary elements are extrapolated to zero cell size, to first order from the two finest grids; ± grid is "
        "the distance to the extrapolation from the next two, with the residual of the solver and the change from "
        "twice the springs. The rest is the error of the model. The verdict of a decade is that of its worst force: "
        "where models differ, they do so at one force of it at least. In verdicts alone a relative standard deviation "
        "below 1 % counts as 1 %, so that two of them are alike; data and figures have the "
        "ratio that was found, 0 where all springs of all profiles touch. Symbols are open where the mean contact has "
        "few cells."
    ),
    series=series,
    once_more=once_more,
    tables=shown.tables,
    claims=(
        at_each_hurst(quantity=DEVIATION + PRINTED, whose=Whose.BOOK, no=THREE_D_DIFFER).saying(
            "The standard deviation of the stiffness is very similar in one and in three dimensions (Fig. 14.1).",
            short="MDR's standard deviation agrees with that of boundary elements",
            key="scatter-of-the-book",
        ),
        at_each_hurst(quantity=DEVIATION, where={shown.H: float, FORCE: lambda decade: decade[1] < 2 * LIGHT}).saying(
            f"Up to Fbar = {LIGHT} MDR predicts the standard deviation of the stiffness of rough punches.",
            short=f"Up to Fbar = {LIGHT} MDR's standard deviation agrees with that of boundary elements",
            key="scatter",
        ),
        at_each_hurst(
            quantity=MEAN,
            whose=Whose.BOOK,
            no=THREE_D_DIFFER,
            where={shown.H: float, FORCE: lambda decade: decade[0] > 0.5 * CARRIED},
        ).saying(
            f"MDR gives the mean stiffness of rough punches from Fbar = {CARRIED} on, where more than the last "
            "asperities carry.",
            short="MDR's mean stiffness agrees with that of boundary elements",
            key="mean-stiffness",
        ),
        Claim(quantity=EXPONENT, model=OF_BEM, along=f"-{shown.H}", whose=Whose.LITERATURE).saying(
            "The exponent of the stiffness over the force falls from 0.77 at H = 0 to 0.51 at H = 1 (Pohrt and Popov "
            "2012; the straight line between both is ours).",
            short="The exponent of the stiffness agrees with that of Pohrt and Popov (2012)",
            key="exponent",
        ),
        Claim(quantity=MEAN, model=FIT, printed=per_cent).saying(
            "The fit 1/kbar = 1/1.1523 + 0.48/Fbar gives the mean stiffness for Fbar from 0.46 to 10.",
            short="The fit agrees with the mean stiffness of boundary elements",
            key="fit",
        ),
    ),
    charts=(
        Chart("fractal_punch", claims=(1,)).of(
            "Relative standard deviation of the stiffness over Fbar = F / (E* h L); bands: 95 % of the sample. (a) "
            "Boundary elements, open where the mean contact has few cells. (b) {c.profiles} profiles of springs, L_1D "
            "= L; lines end where all springs touch.",
            Panel(FORCE, "relative standard deviation", title="boundary elements", ylim=(0, 0.4)).of(*BEM_AT_H),
            Panel(FORCE, "relative standard deviation", title="MDR", ylim=(0, 0.4)).of(at_h(shown.SCATTER, MDR)),
        ),
        _by_hurst(
            "overlay",
            f"Relative standard deviation of the stiffness over the force. {LINES}",
            shown.SCATTER,
            "relative standard deviation",
            COMPARED[:-1],
            log="xy",
            ylim=(1e-3, 1),
        ),
        _by_hurst(
            "difference",
            "Relative standard deviation of MDR over that of boundary elements. Squares: at each force, none where "
            "the ratio is 0: there all springs touch. Thick: the worst force of each decade; box: its interval of "
            "sample and grid. Grey: 10 %. = agree, ≠ differ, ? undecided; in these verdicts alone a deviation below "
            "1 % counts as 1 %.",
            DEVIATION,
            "deviation, MDR over boundary elements",
            (Curve(DEVIATION, style="marks", label="at each force, 95 % of sample and grid", bars=True),),
            claim=1,
            log="xy",
            ylim=(0.1, 3),
            shade=(1 / 1.1, 1.1),
            judged=DEVIATION,
        ),
        _by_hurst(
            "mean",
            f"Mean stiffness kbar = k / (E* L) over the force. {LINES} Dotted: slope 1 / (1 + H).",
            shown.STIFFNESS,
            "mean stiffness kbar = k / (E* L)",
            claim=2,
            log="xy",
        ),
        _by_hurst(
            "exponent",
            f"Local exponent d ln k / d ln F of the mean stiffness. {LINES} Dotted: 1 / (1 + H). Grey: published, "
            f"{PUBLISHED[0]} to {PUBLISHED[1]} for H = 1 to 0.",
            shown.SLOPE,
            "exponent d ln k / d ln F",
            claim=3,
            ylim=(0, 1),
            shade=PUBLISHED,
        ),
    ),
    matrices=(
        *(
            of_hursts(name=f"{quantity}: MDR over boundary elements", quantity=quantity, model=OVER, printed=per_cent)
            for quantity in (DEVIATION, DEVIATION + PRINTED, MEAN, MEAN + OF_LONG)
        ),
        of_hursts(name="mean stiffness: the fit over boundary elements", quantity=MEAN, model=FIT, printed=per_cent),
        of_hursts(name="exponent: MDR less boundary elements", quantity=EXPONENT, model=LESS),
        of_hursts(
            name="exponent of the mean stiffness beside what is published, and beside 1 / (1 + H)",
            quantity=EXPONENT,
            model=(OF_BEM, OF_LAW),
            columns="model",
        ),
    ),
    printed=(shown.TREND,),
)
CASE = Case(
    name="fractal_punch",
    chapter=Chapter.PRESSED,
    place=1,
    answers="Fig. 14.1: mean and fluctuation of the contact stiffness of rough punches",
    quick=shown.FractalPunch(
        hursts=(0.4, 0.7, 1.0),
        cells=48,
        surfaces=(
            *((0, 0, 30, 16, 8, 4),) * 2,
            *((0, 40, 12, 6, 0, 0),) * 2,
            *((60, 16, 8, 4, 0, 0),) * 2,
            *((30, 10, 6, 4, 0, 0),) * 2,
        ),
        drawn=600,
    ),
    full=shown.FractalPunch(
        hursts=(0.4, 0.55, 0.7, 0.85, 1.0),
        cells=256,
        surfaces=(
            (0, 0, 3600, 1300, 300, 66),
            (0, 0, 2800, 700, 70, 0),
            *((0, 3200, 620, 180, 0, 0),) * 2,
            *((1100, 300, 80, 16, 0, 0),) * 2,
            *((300, 60, 20, 4, 0, 0),) * 2,
        ),
        drawn=6000,
        profiles=30000,
        fine_profiles=1000,
    ),
    run=shown.run,
    study=STUDY,
    needs=model_needed.punches,
)
