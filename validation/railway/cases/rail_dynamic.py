"""A wheel with a mass on a rough rail: does the contact filter of constant load hold when the wheel moves?"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from validation.analysis.claims import Matrix
from validation.analysis.evidence import Whose
from validation.analysis.number_text import decibels_rms
from validation.analysis.series import REPEATABLE, Estimates, masked
from validation.analysis.spectra import NominalBands
from validation.analysis.statistics import POWER_DECIBEL, FloatArray, mean_estimate
from validation.case import SERIAL, Case, Chapter, Chart, Claim, Curve, Engine, Outcomes, Panel, Quantity, Series, Study
from validation.engine.realisations import NotConvergedError
from validation.railway.cases.filters import COUNTED, OFFSET, RailWheel, counted, linear_filter, scene_of
from validation.railway.problems.rail_strip import RailGround, RailStrip, line_of
from validation.railway.problems.wheel_on_rail import WheelOnRail, roll_and_move
from validation.railway.scenes.rail import RailScene
from validation.scenes.wheel_body import in_per_cent
from validation.simulation.model_names import BEM, LINEAR, SPRINGS_THAT_READ

FINE, COARSE = "fine", "coarse"
Key = tuple[float, float, str, str]
"""Offset of the levels, damping, model, grid."""
Track = tuple[str, str]
"""Model, and what lifts its wheel."""
FREQUENCY, DAMPING = "f [Hz]", "damping"
MOVING, INFERRED = Quantity("filter_in_motion"), Quantity("filter_inferred_from_the_force")
BESIDE = Quantity("filter_in_motion_of_two_models", "filter in motion, of two models")
AIRBORNE = Quantity("time_without_contact")
RMS = "rms of "
CURVE = 0.0
"""The offset at which grids are compared: above it motions on two grids part in flight."""
SPRINGS_OVER_BEM = f"{SPRINGS_THAT_READ} over {BEM}"
IN_RMS = replace(REPEATABLE, worst=False, rms=(REPEATABLE.tolerance, REPEATABLE.reason))


@dataclass(frozen=True, kw_only=True)
class RailDynamic:
    """Wheels with a mass over isotropic rails of a level curve, and the same contacts at constant load.

    offsets: of the levels, 0 dB among them; mass [kg]; speed [m/s]; damping: ratio zeta, more than the 0.1 % that a
    half-space of steel radiates, less than a track that bends takes; others: beside it, of boundary elements at the
    last offset; longest, shortest: nominal wavelengths [m]; periods: whole natural periods of a strip, before a half,
    so that no wave has the resonance; width: of strips over the longest wave; rounds: of a strip, that are not kept and
    that are; cells, coarse: to the semi-axis along; strips; compared: of them on the coarse grid too, at 0 dB;
    tolerance: of each contact.
    """

    offsets: tuple[float, ...] = (0.0, 10.0)
    mass: float = 500.0
    speed: float = 80 / 3.6
    damping: float = 0.02
    others: tuple[float, ...] = (0.0,)
    longest: float = 0.125
    shortest: float = 0.005
    periods: int = 6
    width: float = 1.0
    rounds: tuple[int, int] = (1, 1)
    cells: int = 6
    coarse: int = 5
    strips: int = 3
    compared: int = 2
    tolerance: float = 1e-4
    seed: int = 20

    @cached_property
    def rail(self) -> RailScene:
        """A conical wheel on a crown of 0.3 m, with the levels of ISO 3095:2013 in these bands."""
        scene = scene_of(RailWheel(50, 920))
        return replace(scene, roughness=scene.levels.within(self.longest, self.shortest))

    @property
    def bands(self) -> NominalBands:
        return self.rail.levels.bands

    @property
    def resonance(self) -> float:
        """sqrt(k / M) / 2 pi [Hz]."""
        return math.sqrt(self.rail.contact.stiffness / self.mass) / (2 * math.pi)

    @property
    def length(self) -> float:
        """Of a track [m]: whole semi-axes, about `periods` of the resonance and a half."""
        unit = self.rail.contact.along
        return unit * round((self.periods + 0.5) * self.speed / self.resonance / unit)

    def problem(self, key: Key, realisation: int) -> WheelOnRail:
        offset, damping, model, grid = key
        rough = replace(self.rail, roughness=self.rail.levels.raised(offset))
        (first, *_, last), unit = self.bands.edges.tolist(), rough.contact.along
        strip = RailStrip(
            ground=RailGround(line=line_of(rough), across="isotropic", first=first, last=last),
            radii=rough.radii,
            force=rough.load,
            modulus=rough.modulus,
            length=self.length,
            width=unit * round(self.width * self.longest / unit),
            spacing=unit / (self.cells if grid == FINE else self.coarse),
            realisation=realisation,
            seed=self.seed,
        )
        moving = {"mass": self.mass, "speed": self.speed, "damping": damping}
        return WheelOnRail(strip=strip, model=model, tolerance=self.tolerance, rounds=self.rounds, **moving)

    @property
    def keys(self) -> dict[Key, int]:
        """Strips of each."""
        models, last = (BEM, SPRINGS_THAT_READ), self.offsets[-1]
        return {
            **{(offset, self.damping, model, FINE): self.strips for offset in self.offsets for model in models},
            **{(CURVE, self.damping, model, COARSE): self.compared for model in models},
            **{(last, damping, BEM, FINE): self.strips for damping in self.others},
        }


@dataclass(frozen=True)
class RailDynamicResult(Outcomes):
    """Outcomes of the strips, by offset, damping, model and grid."""

    case: RailDynamic

    def powers(self, key: Key, track: str) -> FloatArray:
        """Mean square in each band of what lifts the wheel, a track of `roll_and_move`, (strips, bands)."""
        tracks, spacing = [outcome[track] for outcome in self[key]], self.case.problem(key, 0).strip.spacing
        return self.case.bands.powers_of_track(tracks, spacing=spacing)

    @cached_property
    def judged(self) -> NDArray[np.bool_]:
        """Bands down to the first in which A3 of linear theory is below -15 dB."""
        return counted(linear_filter(self.case.rail, LINEAR, "isotropic"))

    def over(self, offset: float, track: Track, other: Track, strips: int | None = None, grid: str = FINE) -> Estimates:
        """ln of the band powers of one track over another on the same strips."""
        powers, reference = (
            self.powers((offset, self.case.damping, model, grid), name) for model, name in (track, other)
        )
        return Estimates.ratios(powers[:strips], reference[:strips])

    def left_by_grid(self, track: Track, other: Track) -> FloatArray:
        """Of the same, to first order, from the strips on both grids."""
        case = self.case
        fine, coarse = (self.over(CURVE, track, other, case.compared, grid).values for grid in (FINE, COARSE))
        return np.asarray(np.abs(fine - coarse) / (case.cells / case.coarse - 1))


def run(case: RailDynamic, engine: Engine = SERIAL) -> RailDynamicResult:
    """All strips, on both grids. Raises NotConvergedError where one is lost: the models are compared strip by strip."""
    problems = {key: [case.problem(key, i) for i in range(count)] for key, count in case.keys.items()}
    outcomes = engine.map_groups(roll_and_move, problems)
    failed = {key: sum(bool(outcome["failed"]) for outcome in strips) for key, strips in outcomes.items()}
    if lost := [f"{key[2]} at +{key[0]:g} dB, {key[3]} grid: {n} strips" for key, n in failed.items() if n]:
        raise NotConvergedError("models are compared strip by strip, and some are lost", lost)
    return RailDynamicResult(case, outcomes)


def series(result: RailDynamicResult) -> list[Series]:
    """Ratios of filters by offset, and the time without contact by damping."""
    case, airborne = result.case, []
    for damping in sorted((case.damping, *case.others)):
        at = [offset for offset, *key in result.by_key if key == [damping, BEM, FINE]]
        shares = [np.array([100 * float(outcome["airborne"]) for outcome in result[o, damping, BEM, FINE]]) for o in at]
        where = {DAMPING: in_per_cent(damping) if damping else "none"}
        estimates = [mean_estimate(share) for share in shares]
        airborne.append(Series(AIRBORNE, BEM, estimates, where=where, along=OFFSET, at=at, unit="%"))
    return [*(ratio for offset in case.offsets for ratio in _ratios(result, offset)), *airborne]


def _ratios(result: RailDynamicResult, offset: float) -> Iterator[Series]:
    """Of boundary elements in motion, and from their force, over constant load; of springs over them in motion."""
    f, family = result.case.speed / result.case.bands.wavelengths, len(result.case.offsets)
    in_bands = partial(Series, along=FREQUENCY, at=f, scale=POWER_DECIBEL, unit="dB", family=family)
    moving, constant = (BEM, "moving"), (BEM, "constant")
    for quantity, model, track, other, source in (
        (MOVING, BEM, moving, constant, "at constant load, same strips"),
        (INFERRED, BEM, (BEM, "inferred"), constant, "at constant load, same strips"),
        (BESIDE, SPRINGS_OVER_BEM, (SPRINGS_THAT_READ, "moving"), moving, "boundary elements, same strips"),
    ):
        ratio, grid = masked(result.over(offset, track, other), result.judged), result.left_by_grid(track, other)
        yield in_bands(quantity, model, ratio, where={OFFSET: offset}, grid=grid, margin=IN_RMS.with_source(source))


STUDY = Study(
    title="The wheel that moves on a rail: does the contact filter of constant load hold?",
    method=(
        "A rigid wheel, M = {c.mass:g} kg, {c.rail.name}, {c.speed:.3g} m/s, on a crown of 0.3 m, over {c.strips} "
        "isotropic surfaces whose lines have the levels of ISO 3095:2013, raised by {c.offsets:g} dB. M z'' = F - F_N "
        "- c z' by velocity Verlet; a dashpot of {c.damping:.0%} of critical stands between the wheel and the inertial "
        "frame. It damps the resonance at {c.resonance:.0f} Hz; a rail that bends, which is not in the model, would "
        "take more. In each step boundary elements, {c.cells} cells to the semi-axis along, solve the contact, or "
        "springs that read the surface. A strip is {c.periods} natural periods and a half long; of its rounds "
        "{c.rounds[0]} is left out and {c.rounds[1]} kept. The lift in motion is d_Hertz(F) - d, the approach of the "
        "smooth wheel under this force less the true one: a vibration on a smooth rail has none. At constant load it "
        "is the equivalent displacement of the contact filter. The force over the linear dynamic stiffness, F (1/k - "
        "1/(M ω² - i c ω)), is what a measured force would tell. All through Hann's window. Judged are root mean "
        f"squares over bands, down to the first in which A3 of linear theory is below {COUNTED:g} dB. The roughness "
        "has waves of {c.bands.span}; in the last two bands oblique waves are missing. Grid: from {c.coarse} cells on "
        "{c.compared} surfaces at 0 dB, to first order; above it motions on two grids part in flight as those on two "
        "surfaces do, which is in the scatter."
    ),
    series=series,
    claims=(
        Claim(quantity=RMS + MOVING, whose=Whose.LITERATURE, along=OFFSET, printed=decibels_rms).saying(
            "The contact filter of constant load holds for a wheel in motion.",
            short="The contact filter in motion agrees with that of constant load, rms over bands",
            key="motion",
        ),
    ),
    charts=(
        Chart("rail_dynamic").of(
            "(a) In motion over at constant load, 95 %, a curve for each level; shaded: within 1 dB. (b) The same from "
            "the force over the linear dynamic stiffness. (c) Time without contact, 95 %, open marks.",
            *(
                Panel(FREQUENCY, f"{quantity} [dB]", shade=(-1, 1), ylim=(-10, 18)).of(
                    Curve(quantity, BEM, by=(OFFSET,), bars=True)
                )
                for quantity in (MOVING, INFERRED)
            ),
            Panel(OFFSET, f"{AIRBORNE} [%]", log="", title="by the damping ratio", ticked=True).of(
                Curve(AIRBORNE, BEM, "open", by=(DAMPING,), bars=True)
            ),
        ),
    ),
    matrices=(Matrix(name="rms over bands", quantity="", rows=("quantity", "model"), columns=OFFSET),),
    printed=(AIRBORNE,),
)
CASE = Case(
    name="rail_dynamic",
    chapter=Chapter.RAIL,
    place=5,
    answers="A contact filter is measured and computed at constant load; the wheel of rolling noise moves",
    quick=RailDynamic(),
    full=RailDynamic(
        offsets=(-5.0, 0.0, 5.0, 10.0),
        others=(0.0, 0.1),
        longest=0.4,
        shortest=0.0025,
        periods=12,
        width=0.6,
        rounds=(1, 2),
        cells=8,
        coarse=6,
        strips=16,
        compared=4,
    ),
    run=run,
    study=STUDY,
    needs="boundary elements in the time loop",
)
