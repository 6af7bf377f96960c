"""Fig. 14.1: both methods beside each other, decade by decade, the errors of sample and grid apart."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import product

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix, per_cent
from validation.analysis.evidence import Number, Place, Role, numbers_with
from validation.analysis.series import Margin, Series
from validation.analysis.statistics import DECIBEL
from validation.analysis.study import Outcomes, Study
from validation.cases.punch import fractal_punch as shown
from validation.cases.punch.ensembles import DEVIATION, FEW, FORCE, MEAN, OVER
from validation.selection import model_needed
from validation.simulation.rough_punch import BEM, FEW_CELLS, MDR

EXPONENT, LESS, OF_LONG = "exponent", "mdr less bem3d", ", L_1D = 1.1523 L"
LEVEL = Margin(
    tolerance=DECIBEL * math.log(1.1),
    reason="10 %: 0.8 dB, finer than one-third octave levels of rolling are known",
    source="bem3d, extrapolated",
)
FIGURE = replace(
    LEVEL,
    reason="10 %: three standard errors of a deviation from the 500 profiles of the book, whose figure cannot show "
    "less",
)
DIGITS = replace(LEVEL, tolerance=0.02, reason="the published exponents have two digits")
FACTOR = "3 dB: since k ~ F^(1/(1+H)), a wrong factor 2 in the force or the length changes k by 3 dB or more, H <= 1"
ROLLING = "accuracy claimed for 1D models of rolling noise against 3D models: Ford and Thompson (2006)"
PUBLISHED = (0.51, 0.77)
"""Exponents of fractal dimensions 2 to 3; Pohrt and Popov, Phys. Rev. Lett. 108, 104301 (2012), abstract."""


def series(result: Outcomes) -> list[Series]:
    """Raises NotConvergedError where too few surfaces have converged at one of the forces."""
    case, found = result.case, shown.PunchStatistics(result)
    found.require_converged()
    hursts: list[float | None] = [*case.hursts, *([None] if len(case.hursts) > 1 else [])]
    return [
        *shown.criteria(found),
        *(one for hurst in case.hursts for one in shown.curves(found, hurst)),
        *(one for hurst in hursts for one in compared(found, hurst)),
        *laws(found),
        *shown.trends(found),
    ]


def compared(found: shown.PunchStatistics, hurst: float | None) -> Iterator[Series]:
    """Each 1D model over boundary elements; every decade is judged by its worst force, whose intervals hold at once."""
    case = found.case
    where: dict[str, Place] = {shown.H: "mean over H" if hurst is None else hurst}
    judged = partial(case.in_decibels, where=where, shown=lambda x: math.exp(x / DECIBEL), fewest=case.per_decade + 1)
    for statistic, margin in ((DEVIATION, FIGURE), (MEAN, LEVEL)):
        for method, name in ((MDR, statistic), (shown.LONG, statistic + OF_LONG)):
            ratios = [found.ratio(hurst, method, statistic, level) for level in range(len(case.forces))]
            values, grid = [ratio.value for ratio in ratios], [ratio.grid for ratio in ratios]
            yield judged(name, OVER, values, grid=grid, margin=margin)
    for first in case.first_forces:
        springs, bem = (found.exponent(hurst, method, *case.decade(first)) for method in (MDR, BEM))
        apart, place = springs.beside(bem), {**where, FORCE: (first, 10 * first)}
        yield Series(EXPONENT, LESS, (apart.value,), where=place, grid=[apart.grid], margin=DIGITS)


def laws(found: shown.PunchStatistics) -> Iterator[Series]:
    """Exponents beside 1 / (1 + H), their intervals at once for all H, off the last asperity and off saturation."""
    case = found.case
    first = min(case.first_forces, key=lambda force: abs(math.log(force / 0.01)))
    law = partial(Series, EXPONENT, family=len(case.hursts), margin=replace(DIGITS, source=shown.LAW))
    for hurst, method in product(case.hursts, (BEM, MDR)):
        where: dict[str, Place] = {shown.H: hurst, FORCE: (first, 10 * first)}
        mine = found.exponent(hurst, method, *case.decade(first))
        yield law(method, (mine.value,), where=where, reference=1 / (1 + hurst), grid=[mine.grid])


def once_more(result: Outcomes, numbers: Sequence[Number]) -> list[Number]:
    """Where the models may differ most, within 3 dB: they share no code, so an error in one of them shows there.

    Of the mean in decades whose lightest contacts have cells enough at every H, and in the last.
    """
    case, found = result.case, shown.PunchStatistics(result)
    light = {
        (case.forces[first], case.forces[last])
        for first, last in map(case.decade, case.first_forces[:-1])
        if min(found.contact(hurst, first, case.cells) for hurst in case.hursts) < FEW_CELLS
    }
    mean = [n for n in numbers_with(numbers, MEAN) if n.where[FORCE] not in light]
    judged = (
        (mean, f"{MEAN} where the models", FACTOR, Role.CRITERION),
        (numbers_with(numbers, DEVIATION), f"{DEVIATION} where it", ROLLING, Role.FINDING),
    )
    return [
        replace(farthest, quantity=f"{what} may differ most, within 3 dB", tolerance=3.0, reason=reason, role=role)
        for some, what, reason, role in judged
        if some
        for farthest in [max(some, key=lambda n: abs(n.value) + n.uncertainty)]
    ]


COMPARED = (
    Curve(shown.STIFFNESS, BEM, "bem", "boundary elements", bars=True),
    Curve(shown.STIFFNESS, FEW, "bem, few cells", "boundary elements, few cells", bars=True),
    Curve(shown.STIFFNESS, MDR, "mdr line", "MDR, L_1D = L", band=True),
    Curve(shown.STIFFNESS, shown.LONG, "other", "MDR, L_1D = 1.1523 L"),
    Curve(shown.STIFFNESS, shown.LAW, "guide", "1 / (1 + H)"),
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
    mine = tuple(replace(curve, quantity=quantity) for curve in drawn)
    panels = (Panel(FORCE, label, facet=shown.H, **panel).of(*mine),)  # type: ignore[arg-type]
    name = f"fractal_punch-{part}"
    return Chart(name, claims=(claim,), columns=4, height=6.4, sharey=True).of(caption, *panels)


at_each_hurst = partial(Claim, where={shown.H: float}, along=FORCE, printed=per_cent)
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
        "grid on the surfaces that both have (multilevel Monte Carlo). Both sums are unbiased. The stiffness is that "
        "of the fixed contact area (3D) and of the springs in contact (1D). There are three errors. Sample: intervals "
        "that hold at 95 % for all forces of a decade at once. Grid: boundary elements are extrapolated to cells of no "
        "size, to first order from the two finest grids; ± grid is the distance to the extrapolation from the next "
        "two, with the change from twice the springs. The rest is the error of the model. The verdict of a decade is "
        "that of its worst force; a deviation below 1 % of the other is none left, and counts as 1 % of it. Symbols "
        "are open where the mean contact has few cells."
    ),
    series=series,
    once_more=once_more,
    tables=shown.tables,
    claims=(
        at_each_hurst(
            says="MDR has the fluctuation of the stiffness of rough punches (Fig. 14.1).",
            short="MDR's fluctuation over boundary elements",
            quantity=DEVIATION,
        ),
        at_each_hurst(
            says="MDR has the mean stiffness of rough punches.",
            short="MDR's mean stiffness over boundary elements",
            quantity=MEAN,
        ),
        Claim(quantity=EXPONENT, model=BEM).saying(
            "The stiffness of a rough punch grows with the force as F^(1 / (1 + H)).", short="The exponent 1 / (1 + H)"
        ),
    ),
    charts=(
        Chart("fractal_punch", width=9.0).of(
            "Relative standard deviation of the stiffness over Fbar = F / (E* h L); bands: 95 % of the sample. (a) "
            "Boundary elements, open where the mean contact has few cells. (b) {c.profiles} profiles of springs, L_1D "
            "= L; lines end where all springs touch.",
            Panel(FORCE, "relative standard deviation of the stiffness", title="boundary elements", ylim=(0, 0.6)).of(
                *BEM_AT_H
            ),
            Panel(FORCE, "", title="MDR", ylim=(0, 0.6)).of(at_h(shown.SCATTER, MDR)),
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
            "Relative deviation of MDR over that of boundary elements. Circles: at each force. Thick: the worst force "
            "of each decade; box: its interval of sample and grid. Grey: 10 %; lines: 3 dB. = agree, ≠ differ, ? "
            "undecided.",
            DEVIATION,
            "deviation, MDR over boundary elements",
            (Curve(DEVIATION, style="bem", label="at each force, 95 % of sample and grid", bars=True),),
            log="xy",
            ylim=(0.3, 3),
            shade=(1 / 1.1, 1.1),
            lines=(10**-0.15, 10**0.15),
            judged=DEVIATION,
        ),
        _by_hurst(
            "mean",
            f"Mean stiffness kbar = k / (E* L) over the force. {LINES} Dotted: slope 1 / (1 + H).",
            shown.STIFFNESS,
            "mean stiffness kbar = k / (E* L)",
            claim=1,
            log="xy",
        ),
        _by_hurst(
            "exponent",
            f"Local exponent d ln k / d ln F of the mean stiffness. {LINES} Dotted: 1 / (1 + H). Grey: published, "
            f"{PUBLISHED[0]} to {PUBLISHED[1]}.",
            shown.SLOPE,
            "exponent d ln k / d ln F",
            claim=2,
            ylim=(0, 1),
            shade=PUBLISHED,
        ),
    ),
    matrices=(
        *(
            of_hursts(name=f"{one}: MDR over boundary elements", quantity=one, where={shown.H: ...}, printed=per_cent)
            for one in (DEVIATION, DEVIATION + OF_LONG, MEAN, MEAN + OF_LONG)
        ),
        of_hursts(name="exponent: MDR less boundary elements", quantity=EXPONENT, model=LESS),
        of_hursts(
            name=f"exponent of the mean stiffness beside 1 / (1 + H); published: {PUBLISHED[0]} to {PUBLISHED[1]}",
            quantity=EXPONENT,
            model=(BEM, MDR),
            columns="model",
        ),
    ),
    printed=("estimator", shown.TREND),
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
    ),
    full=shown.FractalPunch(
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
    run=shown.run,
    study=STUDY,
    needs=model_needed.punches,
)
