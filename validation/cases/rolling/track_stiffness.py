"""Stiffness along a track at constant load, springs beside boundary elements."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from validation.analysis.claims import Matrix
from validation.analysis.quantity import MEAN_STIFFNESS
from validation.analysis.series import Margin
from validation.analysis.spectra import Bands
from validation.analysis.statistics import Estimate, FloatArray, extrapolated, log_ratio_of_means
from validation.case import SERIAL, Case, Chapter, Chart, Claim, Curve, Engine, Outcomes, Panel, Quantity, Series, Study
from validation.engine.engine import Outcome
from validation.engine.realisations import FEWEST, NotConvergedError, require_realisations
from validation.simulation import rolling_strip
from validation.simulation.rolling_strip import HERTZ, RoughStrip, Strip, Tracks
from validation.simulation.track_spectrum import PiecewisePowerLaw, self_affine


@dataclass(frozen=True, kw_only=True)
class TrackStiffness:
    """A wheel under the force F of a smooth one with the approach d, over the roughness of the punches of Fig. 14.1.

    forces: Fbar = F / (E* h L) with L = 2 a, which is 2 / 3 over h/d; hurst; waves: the shortest on L, of which the
    longest is one; length, width: of a surface over a; cells: to a contact radius; strips, refined: surfaces, and how
    many are rolled again on cells half as wide; tracks, springs: realisations, and springs to a radius; seed.
    """

    forces: tuple[float, ...] = (0.3, 1.0, 3.0)
    hurst: float = 0.7
    waves: int = 4
    length: int = 16
    width: int = 8
    cells: int = 8
    strips: int = 6
    refined: int = 3
    tracks: int = 40
    springs: int = 64
    seed: int = 153

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips, refined=self.refined)

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        return self_affine(self.hurst, math.pi, self.waves * math.pi)

    @property
    def bands(self) -> Bands:
        """One of all roughness, which no level is taken in."""
        return Bands((math.pi, self.waves * math.pi)).on(self.length)

    @property
    def positions(self) -> int:
        """Independent ones: a contact of 2 a on each longest wave."""
        return self.strips * self.length // 2

    def height(self, force: float) -> float:
        """h/d."""
        return HERTZ / 2 / force

    def rough_strip(self, force: float) -> RoughStrip:
        return RoughStrip(
            spectrum=self.spectrum, height=self.height(force), length=self.length, width=self.width, seed=self.seed
        )

    def strips_of(self, force: float, cells: int) -> list[Strip]:
        return self.rough_strip(force).strips(cells, 3e-5, self.strips if cells == self.cells else self.refined)

    def tracks_of(self, force: float) -> Tracks:
        return Tracks(
            scene=self.rough_strip(force),
            input_spectrum="geike",
            realisations=self.tracks,
            springs=self.springs,
            bands=self.bands,
        )


def run(case: TrackStiffness, engine: Engine = SERIAL) -> Outcomes:
    """Roll by both methods. Raises NotConvergedError where fewer than three strips converge at a force."""
    cells = {WHEEL: case.cells, REFINED: 2 * case.cells}
    groups = {(name, force): case.strips_of(force, n) for force in case.forces for name, n in cells.items()}
    strips = engine.map_groups(rolling_strip.roll_loaded_strip, groups)
    lost = tuple(
        f"strip {i}, Fbar = {force:g}, {cells[name]} cells to a radius: {int(outcome['failed'])} positions"
        for (name, force), outcomes in strips.items()
        for i, outcome in enumerate(outcomes)
        if outcome["failed"]
    )
    for key, outcomes in strips.items():
        if sum(not outcome["failed"] for outcome in outcomes) < FEWEST:
            raise NotConvergedError(f"fewer than {FEWEST} strips of {key} converged", lost)
    along: dict[tuple[str, float], Outcome] = {}
    for key, outcomes in strips.items():
        along[key] = rolling_strip.stiffness_moments(np.array([outcome["stiffness"] for outcome in outcomes]))
    tracks = {(SPRINGS, force): case.tracks_of(force) for force in case.forces}
    rolled = engine.map(rolling_strip.roll_loaded_tracks, list(tracks.values()))
    return Outcomes(case, {**along, **dict(zip(tracks, rolled, strict=True))}, lost)


WHEEL, REFINED, SPRINGS = "boundary elements", "boundary elements, half of the cell", "springs"
FORCE, MEAN, DEVIATION = "Fbar", MEAN_STIFFNESS, Quantity("relative_deviation_of_stiffness")
OVER = "springs over boundary elements"
SHOWN: Mapping[str, Quantity] = {
    MEAN: Quantity("mean_stiffness_of_each_model"),
    DEVIATION: Quantity("relative_deviation_of_each_model"),
}
WEIGHTS: Mapping[str, FloatArray] = {MEAN: np.array([0.0, 1.0]), DEVIATION: np.array([0.5, -1.0])}
"""Of ln of the mean variance and of ln of the mean."""
TEN_PER_CENT = Margin(10.0, "10 %, as of the stiffness of punches", source="boundary elements along it, extrapolated")


def series(result: Outcomes) -> list[Series]:
    """Each model's own moments along the track, and springs over boundary elements, force by force."""
    return [s for force in result.case.forces for quantity in WEIGHTS for s in _moments(result, quantity, force)]


def _moments(result: Outcomes, quantity: str, force: float) -> Iterator[Series]:
    bem, grid = of_bem(result, quantity, force)
    springs = moment(quantity, result[SPRINGS, force])
    where = {FORCE: force, "h/d": result.case.height(force)}
    yield Series(SHOWN[quantity], WHEEL, (exponential(bem),), where=where, grid=math.exp(bem.value) * grid)
    yield Series(SHOWN[quantity], SPRINGS, (exponential(springs),), where=where)
    over = springs.minus(bem)
    yield Series(
        quantity,
        OVER,
        (exponential(over, less=1.0),),
        where={FORCE: force},
        grid=math.exp(over.value) * grid,
        scale=100.0,
        unit="%",
        margin=TEN_PER_CENT,
        family=len(result.case.forces),
    )


def of_bem(result: Outcomes, quantity: str, force: float) -> tuple[Estimate, float]:
    """ln of the mean stiffness, or of its relative deviation, at zero cell size; half-width that the grid leaves."""
    coarse, fine = result[WHEEL, force], result[REFINED, force]
    same = {name: values[: len(fine["mean"])] for name, values in coarse.items()}
    return extrapolated(moment(quantity, coarse), moment(quantity, fine, same))


def moment(quantity: str, outcome: Outcome, other: Outcome | None = None) -> Estimate:
    """The same along tracks, or over another's."""
    rows, reference = (np.stack([o["variance"], o["mean"]], axis=1) for o in (outcome, other or outcome))
    return log_ratio_of_means(rows, reference if other else np.ones(2), WEIGHTS[quantity])


def exponential(log: Estimate, less: float = 0.0) -> Estimate:
    """exp(x) - less of an estimate of x, to first order in its error."""
    ratio = math.exp(log.value)
    return Estimate(ratio - less, ratio * log.error, log.samples)


def notes(result: Outcomes) -> list[str]:
    """What tells whether springs fluctuate more by their spectrum, or where the half-space leaves the linear range."""
    case = result.case
    if len(case.forces) == 1:
        return []
    heavy, light = sorted(case.forces, reverse=True)[:2]
    grown = {
        SPRINGS: [moment(DEVIATION, result[SPRINGS, force]).value for force in (heavy, light)],
        WHEEL: [of_bem(result, DEVIATION, force)[0].value for force in (heavy, light)],
    }
    times = {model: math.exp(after - before) for model, (before, after) in grown.items()}
    over = {force: math.exp(grown[SPRINGS][i] - grown[WHEEL][i]) for i, force in enumerate((heavy, light))}
    lost = {
        model: 100 * -math.expm1(mean.value)
        for model, mean in (
            (SPRINGS, moment(MEAN, result[SPRINGS, light])),
            (WHEEL, of_bem(result, MEAN, light)[0]),
        )
    }
    return [
        f"At Fbar = {heavy:g}, the smoothest, springs of Geike's spectrum fluctuate {over[heavy]:.2f} "
        f"times as much as boundary elements, at Fbar = {light:g} {over[light]:.2f} times. In between the roughness "
        f"grows {case.height(light) / case.height(heavy):.2g} times, the fluctuation of springs {times[SPRINGS]:.2g} "
        f"times and that of boundary elements {times[WHEEL]:.2g} times.",
        f"At Fbar = {light:g} the mean stiffness of the half-space is {lost[WHEEL]:.1f} % below that of the smooth "
        f"wheel, that of springs {lost[SPRINGS]:.1f} %.",
    ]


def _over_force(quantity: str) -> Panel:
    return Panel(FORCE, quantity, log="xy" if quantity == DEVIATION else "x").of(
        Curve(SHOWN[quantity], WHEEL, bars=True), Curve(SHOWN[quantity], SPRINGS)
    )


STUDY = Study(
    title="Stiffness along a track, springs beside boundary elements",
    method=(
        "A wheel rolls under a constant force over the roughness of Fig. 14.1, H = {c.hurst:g}, with {c.waves} of the "
        "shortest waves and one of the longest on L = 2 a, at Fbar = F / (E* h L) = {c.forces:g}. On boundary "
        "elements the contact area of each position is frozen and pressed, {c.cells} cells to a radius, on {c.strips} "
        "surfaces {c.length:g} a long ({c.positions} positions 2 a apart); {c.refined} of them again with twice as "
        "many cells. Values are extrapolated to first order; the grid leaves the change between both grids, with "
        "its interval. Springs: {c.tracks} tracks as long, with Geike's spectrum."
    ),
    series=series,
    claims=(
        Claim(quantity=DEVIATION).saying(
            "Under a constant load the stiffness of springs fluctuates along a track as that of boundary elements.",
            short="The fluctuation of stiffness of springs along a track agrees with that of boundary elements",
            key="fluctuation",
        ),
    ),
    charts=(
        Chart("track_stiffness").of(
            "(a) Mean stiffness over 2 E* a along a track, over Fbar = F / (E* h L); (b) its relative deviation. "
            "Circles: boundary elements, 95 % of sample and grid; squares: springs.",
            _over_force(MEAN),
            _over_force(DEVIATION),
        ),
    ),
    matrices=(
        Matrix(name="springs over boundary elements", quantity=(MEAN, DEVIATION), rows=(FORCE,), columns="quantity"),
    ),
    notes=notes,
)
CASE = Case(
    name="track_stiffness",
    chapter=Chapter.ROLLING,
    place=4,
    answers="Fluctuation of stiffness along a track: the link from Fig. 14.1 to rolling",
    quick=TrackStiffness(cells=6, strips=4, tracks=20),
    full=TrackStiffness(forces=(0.3, 1.0, 3.0, 10.0), length=32, width=12, cells=12, strips=20, refined=20, tracks=200),
    run=run,
    study=STUDY,
    needs="boundary elements",
)
