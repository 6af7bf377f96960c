"""The ratio of the deviations of both methods by bandwidth, beside springs without elastic coupling."""

import math
from collections.abc import Iterator
from functools import partial

from validation.analysis.claims import Matrix
from validation.analysis.evidence import Place
from validation.analysis.number_text import per_cent
from validation.analysis.quantity import RELATIVE_DEVIATION
from validation.analysis.series import Margin
from validation.analysis.statistics import DECIBEL, combined
from validation.case import Case, Chapter, Chart, Claim, Curve, Outcomes, Panel, Quantity, Series, Study
from validation.cases.punch.bandwidth import AREA, ROLL_OFF, Band, Bandwidth, Deviations, run
from validation.cases.punch.ensembles import DEVIATION, FORCE, OVER
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR
from validation.simulation.rough_punch import require_converged

BANDWIDTH, H = "q_max / q_min", "H"
RATIO = Quantity("relative_deviation_MDR_over_boundary_elements", "relative deviation, MDR over boundary elements")
DRIFT = Quantity("change_of_that_ratio_per_decade_of_q_max_q_min", "change of that ratio per decade of q_max / q_min")
ROLLED = Quantity("change_of_that_ratio_by_a_roll-off")
OF_EACH = f"{DRIFT}, under each force"
ALIKE = Margin(DECIBEL * math.log(1.1), "10 %, the margin at which MDR is said to predict it", source="no change")


def series(result: Outcomes) -> list[Series]:
    """Raises NotConvergedError where too few surfaces have converged at one of the forces."""
    pressed = [{"stiffness": rows} for (method, *_), rows in result.by_key.items() if method == BEM]
    require_converged(pressed, result.unconverged)
    deviations = Deviations(result)
    return [
        *(series for hurst in result.case.hursts for series in _by_bandwidth(deviations, hurst)),
        *_changes(deviations),
    ]


def _by_bandwidth(deviations: Deviations, hurst: float) -> Iterator[Series]:
    """Under each force by band."""
    waves = [float(band.waves) for band in deviations.result.case.bands]

    for level, force in enumerate(deviations.result.case.forces):
        by_band = partial(Series, where={H: hurst, FORCE: force}, along=BANDWIDTH, shown=math.exp)
        for quantity, model, values in (
            (RATIO, OVER, deviations.ratio(hurst, level)),
            (DEVIATION, BEM, deviations.resolved(BEM, hurst, level)),
            (DEVIATION, MDR, deviations.resolved(MDR, hurst, level)),
        ):
            at, resolved = [waves[i] for i in values], list(values.values())
            yield by_band(quantity, model, [v.value for v in resolved], at=at, grid=[v.grid for v in resolved])
        alone = deviations.without_coupling(hurst, level)
        yield by_band(RATIO, AREA, list(alone.values()), at=[waves[i] for i in alone])


def _changes(deviations: Deviations) -> Iterator[Series]:
    """Of the ratio by decade of bandwidth, under each force and as their mean, which is judged; by a roll-off."""
    case, levels = deviations.result.case, range(len(deviations.result.case.forces))
    by_force = partial(case.in_decibels, shown=in_factors)
    judged = partial(Series, DRIFT, OVER, scale=DECIBEL, unit="dB", margin=ALIKE, family=len(case.hursts))
    for hurst in case.hursts:
        slopes = [deviations.slope(hurst, level) for level in levels]
        mean = combined([1 / len(slopes)] * len(slopes), slopes)
        yield judged((mean.value,), where={H: hurst, FORCE: (case.forces[0], case.forces[-1])}, grid=[mean.grid])
        yield by_force(OF_EACH, OVER, [s.value for s in slopes], grid=[s.grid for s in slopes], where={H: hurst})
    rolled = [deviations.of_roll_off(level) for level in levels]
    where: dict[str, Place] = {H: case.rolled.hurst, ROLL_OFF: float(case.roll_off[0])}
    yield by_force(ROLLED, OVER, rolled, where=where, margin=ALIKE)


def in_factors(decibels: float) -> float:
    return math.exp(decibels / DECIBEL)


def notes(result: Outcomes) -> list[str]:
    """What the constant is, and what springs without coupling say of it."""
    case, deviations = result.case, Deviations(result)
    pairs = [(hurst, level) for hurst in case.hursts for level in range(len(case.forces))]
    widest = max(i for i, band in enumerate(case.bands) if band.heavy)
    waves, ratios = case.bands[widest].waves, [deviations.ratio(*pair)[widest].value.value for pair in pairs]
    slopes = [deviations.slope(*pair) for pair in pairs]
    mean = combined([1 / len(slopes)] * len(slopes), slopes)
    if not math.isfinite(mean.value.value):
        return []
    sentences = [
        f"Over all loads and H, the ratio changes by {100 * mean.value.value:+.1f} ± "
        f"{100 * (mean.value.half_width + mean.grid):.1f} % per decade of bandwidth.",
        f"At q_max/q_min = {waves} MDR's relative deviation is {_from_to(ratios)} that of boundary elements.",
    ]
    for hurst in case.hursts:
        at = [(hurst, level) for level in range(len(case.forces))]
        uncoupled = [ratio.value for pair in at for ratio in deviations.without_coupling(*pair).values()]
        coupled = [deviations.ratio(*pair)[widest].value.value for pair in at]
        if uncoupled:
            sentences.append(
                f"At H = {hurst:g} it is {_from_to(coupled)} that of BEM; without elastic coupling springs along a "
                f"line have {_from_to(uncoupled)} the deviation of springs over an area: the rest is elastic coupling."
            )
    return sentences


def _from_to(logarithms: list[float]) -> str:
    ends = " to ".join(f"{math.exp(end):.2f}" for end in (min(logarithms), max(logarithms)))
    return f"{ends} times (mean {math.exp(sum(logarithms) / len(logarithms)):.2f})"


at_bandwidth = partial(Curve, by=(BANDWIDTH,), x_factor=1.06)
STUDY = Study(
    title="Bandwidth: is MDR noisier than the half-space however wide the band is?",
    method=(
        "Punches as in Fig. 14.1, whose longest wave is the side, without a roll-off, H = {c.hursts:g}. Boundary "
        "elements press {c.counts}; the first number of surfaces is that of the first decade of Fbar, the second that "
        "of both. Phases are common to all bands and H, so that most of the scatter drops out of a change from band to "
        "band: each deviation is that of the narrowest band and the changes, on the surfaces that both bands have "
        "(multilevel Monte Carlo). {c.profiles} profiles, 16 springs to the shortest wave. With a roll-off: "
        "{c.rolled_off} surfaces whose spectrum is constant up to q_r = {c.roll_off[0]} · 2π/L. Errors: the sample, 95 "
        "%; cells, extrapolated to no size, with half of the way there; twice as many springs. A band whose cells are "
        "not halved takes the error of the one before. What the ratio changes by decade of bandwidth is found by least "
        "squares in ln(q_max/q_min), weighted by what the surfaces tell, under each force. Its mean over forces is "
        "judged. "
        "Theory: waves beyond q_max are as high as h (q_min/q_max)^H, and shift both load curves by no more than "
        "their highest point (Barber 2003). So at one Fbar both stiffnesses have a limit for wide bands, and the "
        "ratio of their deviations tends to a constant. It holds where these waves are low beside the depth of the "
        "contact, q_max/q_min > (kbar/Fbar)^(1/H). Of the highest points of a line and of an area alone, without "
        "elastic coupling, the ratio would be the dotted one, of springs along a line over springs over an area, whose "
        "contact is k/E* long or wide, k that of boundary elements; what differs from it is elastic coupling, and "
        "depends on H."
    ),
    series=series,
    claims=(
        Claim(quantity=DRIFT, printed=per_cent).saying(
            "From one decade of bandwidth to the next, MDR's relative deviation of the stiffness over that of boundary "
            "elements stays the same.",
            short="The ratio of deviations agrees with that at a tenth of the bandwidth",
            key="drift",
        ),
    ),
    charts=(
        Chart("bandwidth", claims=(0,)).of(
            "Relative deviation of the stiffness, MDR over boundary elements, at each bandwidth. Bars: 95 % of sample "
            "and grid. Dotted: springs along a line over springs over an area, without elastic coupling, where waves "
            "that the band lacks are low beside the depth of the contact.",
            Panel(FORCE, "deviation, MDR over boundary elements", facet=H, ylim=(0.8, 1.6), lines=(1.0,)).of(
                at_bandwidth(RATIO, OVER, bars=True), at_bandwidth(RATIO, AREA, "dotted", "_")
            ),
        ),
        Chart("bandwidth-deviation", claims=(0,)).of(
            "The relative deviations. Symbols: boundary elements; lines: MDR. Bars: 95 % of sample and grid.",
            Panel(FORCE, RELATIVE_DEVIATION, facet=H, ylim=(0.1, 0.4)).of(
                at_bandwidth(DEVIATION, BEM, "marks", bars=True), at_bandwidth(DEVIATION, MDR, "lines", "_")
            ),
        ),
    ),
    matrices=(
        Matrix(
            name="change of MDR over boundary elements per decade of q_max / q_min, or by a roll-off",
            quantity=(DRIFT, ROLLED),
            rows=("quantity", H),
            columns=FORCE,
            printed=per_cent,
        ),
    ),
    notes=notes,
)
CASE = Case(
    name="bandwidth",
    chapter=Chapter.PRESSED,
    place=4,
    answers="Fig. 14.1 at bandwidths of 16 to 1024: is MDR noisier however wide the band is",
    quick=Bandwidth(
        hursts=(0.7,),
        bands=(Band(8, 32, 60, 40, (16, 8), 60), Band(16, 64, 40, 20, (12, 6), 40), Band(32, 128, 12, 6)),
        rolled_off=20,
        profiles=300,
    ),
    full=Bandwidth(
        bands=(
            Band(16, 256, (1500, 1100, 1100), 900, (150, 30), 400),
            Band(64, 256, (1500, 1100, 1100), 450, (150, 30), 400),
            Band(256, 1024, (900, 400, 240), 80, (20, 8), 60),
            Band(1024, 4096, (24, 10, 8), 0),
        ),
        rolled_off=300,
        profiles=10000,
    ),
    run=run,
    study=STUDY,
    needs="boundary elements, whatever the bandwidth",
)
