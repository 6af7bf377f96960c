"""Whether the answer of Fig. 14.1 depends on bandwidth, on a roll-off and on the size; a fit for the mean stiffness.

Boundary elements of a wide band are those of the narrowest, on many surfaces, and the changes from band to band, on few
that have the same long waves. The sum is unbiased, and what these waves scatter drops out of each change.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import accumulate, pairwise

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix, per_cent
from validation.analysis.series import Estimates, Margin, Series, Where, spans
from validation.analysis.statistics import DECIBEL, FIVE_PER_CENT, jackknifed, log_mean, log_relative_deviation
from validation.analysis.study import Outcomes, Study
from validation.cases.punch.ensembles import DEVIATION, FORCE, MEAN, OVER, PunchEnsembles, change, of_rows, press
from validation.engine.engine import SERIAL, Engine
from validation.selection import model_needed
from validation.simulation.rough_punch import PunchRoughness, RolledOffRoughness, Surface, require_converged
from validation.theory import closed_forms

BANDWIDTH, ROLL_OFF = "q_max / q_min", "q_r L / 2π"
KINDS = (BANDWIDTH, ROLL_OFF)
Kind = tuple[str, float]


@dataclass(frozen=True, kw_only=True)
class Bandwidth(PunchEnsembles):
    """Punches whose longest wave is the side, of several bandwidths, and with a roll-off.

    cells: on a side in the narrowest band, four to its shortest wave, as in all others; wider: how many times wider the
    other bands are; pairs: surfaces pressed in such a band and in the one before, the same long waves in both;
    refined: surfaces of the narrowest band pressed on twice as many cells; roll_off: q_r L / 2 pi of surfaces that have
    a plateau below, and the narrowest band above; rolled_off: as many surfaces.
    """

    hurst: float = 0.7
    cells: int = 32
    wider: tuple[int, ...] = (2, 4)
    surfaces: int = 120
    pairs: tuple[int, ...] = (20, 12)
    refined: int = 30
    roll_off: int = 4
    rolled_off: int = 20
    profiles: int = 200
    decades: tuple[int, int] = (-2, 1)
    per_decade: int = 2
    points: int = 1024
    seed: int = 143

    def __post_init__(self) -> None:
        if not len(self.pairs) == len(self.wider) or min(self.surfaces, self.refined, self.rolled_off, *self.pairs) < 3:
            raise ValueError(f"pairs must be three at least for each wider band, got {self.pairs} for {self.wider}")

    @property
    def bandwidths(self) -> tuple[int, ...]:
        """q_max / q_min without a roll-off, ascending."""
        return tuple(self.cells // 4 * width for width in (1, *self.wider))

    @property
    def ground(self) -> dict[Kind, PunchRoughness]:
        """Of each bandwidth from one wave on a side; and with a roll-off, the narrowest band beyond it."""
        plain = partial(PunchRoughness, hurst=self.hurst, height=self.height, seed=self.seed)
        rolled = partial(RolledOffRoughness, hurst=self.hurst, height=self.height, seed=self.seed)
        waves = (1, self.roll_off * self.bandwidths[0])
        return {
            **{(BANDWIDTH, float(b)): plain(waves=(1, b)) for b in self.bandwidths},
            (ROLL_OFF, float(self.roll_off)): rolled(waves=waves, roll_off=self.roll_off),
        }

    def pressed(self, roughness: PunchRoughness, first: int, count: int, finer: int = 1) -> list[Surface]:
        """Realisations from the first on, four cells to the shortest wave, or so many times more."""
        return self.surfaces_of(roughness, 4 * roughness.waves[1] * finer, count, first)


def run(case: Bandwidth, engine: Engine = SERIAL) -> Outcomes:
    """Press surfaces of each band, "before" and "wider" the same ones, and profiles of all."""
    *bands, rolled_off = case.ground.values()
    surfaces = {
        "narrow": case.pressed(bands[0], 0, case.surfaces),
        "refined": case.pressed(bands[0], 0, case.refined, finer=2),
        "rolled off": case.pressed(rolled_off, 0, case.rolled_off),
    }
    starts = np.cumsum([case.surfaces, *case.pairs]).tolist()
    for i, (first, count) in enumerate(zip(starts, case.pairs, strict=False)):
        surfaces |= {f"before {i}": case.pressed(bands[i], first, count)}
        surfaces |= {f"wider {i}": case.pressed(bands[i + 1], first, count)}
    profiles = {kind: case.profiles_of(ground, case.points) for kind, ground in case.ground.items()}
    bem, springs, unconverged = press(engine, surfaces, profiles)
    return Outcomes(case, {**bem, **springs}, unconverged)


CHANGE, SIZE, OF_BEM = "change of MDR over bem3d, ", "with the roll-off over without, ", " over bem3d"
NO_CHANGE = partial(Margin, source="no change")
MARGINS = {
    MEAN: NO_CHANGE(FIVE_PER_CENT, "5 %, less than half of what MDR is off by in full contact, 13 %"),
    DEVIATION: NO_CHANGE(DECIBEL * math.log(1.1), "10 %, the margin at which Fig. 14.1 is decided"),
}
SIX_PER_CENT = DECIBEL * math.log(1.06)
OF_FIT = Margin(SIX_PER_CENT, "6 %, less than half of what MDR is off by in full contact, 13 %", source="bem3d")
FIT, FIT_RANGE = "fit", (0.3, 10.0)
STATISTICS = {MEAN: log_mean, DEVIATION: log_relative_deviation}


def series(result: Outcomes) -> list[Series]:
    """Raises NotConvergedError where too few surfaces have converged at one of the forces."""
    bem = [outcome for key, outcome in result.found.items() if isinstance(key, str)]
    require_converged(bem, result.unconverged)
    return [one for quantity in STATISTICS for one in _of(result, quantity)]


def _of(result: Outcomes, quantity: str) -> Iterator[Series]:
    """Of one statistic: both methods, MDR and the fit over boundary elements, and what bands and a roll-off change."""
    case, statistic = result.case, STATISTICS[quantity]

    def found(key: object) -> Estimates:
        return Estimates(jackknifed(partial(of_rows, statistic), result[key]["stiffness"]))

    def changed(before: object, after: object) -> Estimates:
        return change(statistic, result[before]["stiffness"], result[after]["stiffness"])

    steps = [changed(f"before {i}", f"wider {i}") for i in range(len(case.pairs))]
    springs = {kind: found(kind) for kind in case.ground}
    bem = dict(zip(springs, [*accumulate(steps, initial=found("narrow")), found("rolled off")], strict=True))
    left = np.array([abs(e.value) + e.half_width for e in changed("narrow", "refined")])
    shown = partial(Series, along=FORCE, at=case.forces, shown=math.exp)
    family = case.family(max(len(case.bandwidths) - 1, 1))
    # to first order cells of no size are twice as far away as cells of half the size
    over = partial(case.in_decibels, grid=2 * left, shown=lambda x: math.exp(x / DECIBEL), fewest=2, family=family)
    for kind, mine in springs.items():
        where: Where = dict([kind])
        yield shown(quantity, "bem3d", bem[kind], where=where)
        yield shown(quantity, "mdr", mine, where=where)
        judged = {"ranges": spans(case.forces, FIT_RANGE), "margin": OF_FIT if quantity == MEAN else None}
        yield over(quantity + OF_BEM, "mdr", mine - bem[kind], where=where, **judged)
        if quantity == MEAN:
            fit = Estimates.exact(np.log(fitted(case)), 10**9)
            yield over(quantity + OF_BEM, FIT, fit - bem[kind], where=where, **judged)
    by_decade = partial(over, grid=left, margin=MARGINS[quantity])
    for (a, b), step in zip(pairwise(springs), steps, strict=False):
        yield by_decade(CHANGE + quantity, OVER, changed(a, b) - step, where={BANDWIDTH: (a[1], b[1])})
    (first, *_, rolled), where = springs, {ROLL_OFF: float(case.roll_off)}
    apart = (springs[rolled] - bem[rolled]) - (springs[first] - bem[first])
    yield by_decade(CHANGE + quantity, OVER, apart, where=where)
    if quantity == DEVIATION:
        for model, of in (("bem3d", bem), ("mdr", springs)):
            yield by_decade(SIZE + quantity, model, of[rolled] - of[first], where=where)


def fitted(case: Bandwidth) -> list[float]:
    """k / (E* L) of the fit, the flat punch in series with its rough face, at each force."""
    h = case.height
    return [
        closed_forms.rough_punch_stiffness(side=1.0, modulus=1.0, force=force * h, height=h) for force in case.forces
    ]


of_change = partial(Claim, quantity=(CHANGE + MEAN, CHANGE + DEVIATION), along="-Fbar", printed=per_cent)
of_mean = partial(Claim, quantity=MEAN + OF_BEM, along=ROLL_OFF, printed=per_cent)
of_kinds = partial(Curve, by=KINDS)
against_force = partial(Panel, FORCE, "")
STIFFER = (of_kinds(MEAN + OF_BEM, "mdr", bars=True), of_kinds(MEAN + OF_BEM, FIT, "dotted", "_"))
SCATTERED = (of_kinds(DEVIATION, "bem3d", "marks", bars=True), of_kinds(DEVIATION, "mdr", "lines"))
WIDER = (of_kinds(DEVIATION + OF_BEM, bars=True),)
PANELS = (
    against_force(STIFFER, "mean stiffness, over bem3d", ylim=(0.75, 1.25), lines=(1.0,)),
    against_force(WIDER, "relative deviation, MDR over bem3d", log="xy", ylim=(0.3, 3), lines=(1.0,)),
    against_force(SCATTERED, "relative deviation", log="xy", ylim=(5e-4, 1)),
)
STUDY = Study(
    title="Bandwidth, roll-off and size: does the answer of Fig. 14.1 depend on them?",
    method=(
        "Punches as in Fig. 14.1, H = {c.hurst:g}, longest wave L, q_max / q_min = {c.bandwidths}, each on four cells "
        "to its shortest wave. Boundary elements press {c.surfaces} surfaces of the narrowest band, and {c.pairs} of "
        "the wider ones both in that band and in the one before, with the same long waves. The narrowest band and "
        "these changes add up to the widest. With a roll-off: {c.rolled_off} surfaces whose spectrum is constant up to "
        "q_r = {c.roll_off} · 2π/L and the narrowest band beyond. {c.profiles} profiles of {c.points} springs in each "
        "band, all with the same long waves. Intervals by the jackknife and Student's t. Grid: {c.refined} surfaces of "
        "the narrowest band on twice as many cells a side; wider bands have as many cells to a wave and more to a "
        "contact, and are taken to err by no more."
    ),
    series=series,
    claims=(
        of_change(
            says="What Fig. 14.1 says of MDR beside boundary elements does not depend on bandwidth.",
            short="Change of MDR over boundary elements by bandwidth",
            where={BANDWIDTH: ...},
        ),
        of_change(
            says="What Fig. 14.1 says of MDR beside boundary elements does not depend on a roll-off.",
            short="by a roll-off",
            where={ROLL_OFF: ...},
        ),
        Claim(quantity=SIZE + DEVIATION, printed=per_cent).saying(
            "The fluctuation of Fig. 14.1 does not depend on how many of its longest waves the punch holds."
        ),
        of_mean(
            says="The fit 1/kbar = 1/1.1523 + 0.48/Fbar has the mean stiffness within 6 % for Fbar from 0.32 to 10.",
            model=FIT,
        ),
        of_mean(says="MDR has the mean stiffness within 6 % for Fbar from 0.32 to 10.", model="mdr"),
    ),
    charts=(
        Chart("bandwidth", claims=(0, 1)).of(
            "H = {c.hurst:g}. (a) Mean stiffness over that of boundary elements: MDR at each bandwidth, with and "
            "without a roll-off; dotted, the fit. (b) Relative deviation, MDR over bem3d. (c) Relative deviation "
            "itself: symbols, boundary elements; lines, MDR. Bars: 95 % of the sample, in (a) and (b) with the grid.",
            *PANELS,
        ),
    ),
    matrices=(
        Matrix(
            name="mean stiffness over boundary elements, Fbar from 0.32 to 10",
            quantity=MEAN + OF_BEM,
            rows=KINDS,
            columns="model",
            printed=per_cent,
        ),
    ),
)
CASE = Case(
    name="bandwidth",
    chapter=Chapter.PRESSED,
    place=4,
    answers="Fig. 14.1 at other bandwidths, with a roll-off, and on larger punches; a fit for the mean stiffness",
    quick=Bandwidth(surfaces=60, pairs=(10, 6), refined=15, rolled_off=10),
    full=Bandwidth(
        cells=64, wider=(4, 16), surfaces=900, pairs=(80, 8), refined=150, rolled_off=50, profiles=2000, points=4096
    ),
    run=run,
    study=STUDY,
    needs=model_needed.punches,
)
