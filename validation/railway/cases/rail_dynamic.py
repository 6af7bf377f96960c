"""A wheel with a mass on a rough rail: does the contact filter of constant load hold when the wheel moves?"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import product

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
from validation.scenes.rail_impedance import FreeBeam
from validation.simulation.model_names import BEM, LINEAR, SPRINGS_THAT_READ
from validation.theory.rolling import contact_resonance

FINE, COARSE = "fine", "coarse"
Key = tuple[float, str, str, str]
"""Offset of the levels, rail, model, grid."""
Track = tuple[str, str]
"""Model, and a track of it."""
FREQUENCY, RAIL, RIGID, BEAM = "f [Hz]", "rail", "rigid", "free beam"
MOVING, INFERRED = Quantity("filter_in_motion"), Quantity("filter_inferred_from_the_force")
FORCE = Quantity("force_in_motion")
BESIDE = Quantity("filter_in_motion_of_two_models", "filter in motion, of two models")
FILTERED = "Hertz spring, filtered roughness"
RAIL_60 = FreeBeam(bending_stiffness=6.38e6, mass_per_length=60.2)
"""60E1, upright."""
AIRBORNE = Quantity("time_without_contact")
RMS = "rms of "
CURVE = 0.0
"""The offset at which grids are compared: above it motions on two grids part in flight."""
SPRINGS_OVER_BEM = f"{SPRINGS_THAT_READ} over {BEM}"
IN_RMS = replace(REPEATABLE, worst=False, rms=(REPEATABLE.tolerance, REPEATABLE.reason))


@dataclass(frozen=True, kw_only=True)
class RailDynamic:
    """Wheels with a mass over isotropic rails of a level curve, and the same contacts at constant load.

    offsets: of the levels, 0 dB among them; mass [kg]; speed [m/s]; damping: ratio zeta on the rigid rail, more than
    the 0.1 % that a half-space of steel radiates; beam: the other rail, of 60 kg/m, on which nothing else damps;
    longest, shortest: nominal wavelengths [m]; periods: whole natural periods of a strip, before a half,
    so that no wave has the resonance; width: of strips over the longest wave; rounds: of a strip, that are not kept and
    that are; cells, coarse: to the semi-axis along; strips; compared: of them on the coarse grid too, at 0 dB;
    tolerance: of each contact.
    """

    offsets: tuple[float, ...] = (0.0, 10.0)
    mass: float = 500.0
    speed: float = 80 / 3.6
    damping: float = 0.02
    beam: FreeBeam = RAIL_60
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
    def resonance_on_beam(self) -> float:
        """Of wheel and beam on the contact spring [Hz]."""
        wheel = {"stiffness": self.rail.contact.stiffness, "mass": self.mass}
        return contact_resonance(impedance=self.beam.impedance, **wheel) / (2 * math.pi)

    @property
    def impedance(self) -> float:
        """abs(Z) of the beam there [N s/m]."""
        return float(abs(self.beam.impedance(2 * math.pi * self.resonance_on_beam)))

    @property
    def length(self) -> float:
        """Of a track [m]: whole semi-axes, about `periods` of the resonance and a half."""
        unit = self.rail.contact.along
        return unit * round((self.periods + 0.5) * self.speed / self.resonance / unit)

    def problem(self, key: Key, realisation: int) -> WheelOnRail:
        offset, under, model, grid = key
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
        return WheelOnRail(
            strip=strip,
            mass=self.mass,
            speed=self.speed,
            damping=self.damping if under == RIGID else 0.0,
            rail=self.beam if under == BEAM else None,
            model=model,
            tolerance=self.tolerance,
            rounds=self.rounds,
        )

    @property
    def keys(self) -> dict[Key, int]:
        """Strips of each."""
        pairs = list(product((RIGID, BEAM), (BEM, SPRINGS_THAT_READ)))
        return {
            **{(offset, *pair, FINE): self.strips for offset in self.offsets for pair in pairs},
            **{(CURVE, *pair, COARSE): self.compared for pair in pairs},
        }


@dataclass(frozen=True)
class RailDynamicResult(Outcomes):
    """Outcomes of the strips, by offset, rail, model and grid."""

    case: RailDynamic

    def powers(self, key: Key, track: str) -> FloatArray:
        """Mean square in each band of a track of `roll_and_move`, (strips, bands)."""
        tracks, spacing = [outcome[track] for outcome in self[key]], self.case.problem(key, 0).strip.spacing
        return self.case.bands.powers_of_track(tracks, spacing=spacing)

    @cached_property
    def judged(self) -> NDArray[np.bool_]:
        """Bands down to the first in which A3 of linear theory is below -15 dB."""
        return counted(linear_filter(self.case.rail, LINEAR, "isotropic"))

    def over(
        self, at: tuple[float, str], track: Track, other: Track, strips: int | None = None, grid: str = FINE
    ) -> Estimates:
        """ln of the band powers of one track over another on the same strips; at: offset and rail."""
        powers, reference = (self.powers((*at, model, grid), name) for model, name in (track, other))
        return Estimates.ratios(powers[:strips], reference[:strips])

    def left_by_grid(self, under: str, track: Track, other: Track) -> FloatArray:
        """Of the same, to first order, from the strips on both grids."""
        case = self.case
        fine, coarse = (self.over((CURVE, under), track, other, case.compared, grid).values for grid in (FINE, COARSE))
        return np.asarray(np.abs(fine - coarse) / (case.cells / case.coarse - 1))


def run(case: RailDynamic, engine: Engine = SERIAL) -> RailDynamicResult:
    """All strips, on both grids. Raises NotConvergedError where one is lost: the models are compared strip by strip."""
    problems = {key: [case.problem(key, i) for i in range(count)] for key, count in case.keys.items()}
    outcomes = engine.map_groups(roll_and_move, problems)
    failed = {key: sum(bool(outcome["failed"]) for outcome in strips) for key, strips in outcomes.items()}
    if lost := [
        f"{key[2]} at {key[0]:+g} dB, {key[1]} rail, {key[3]} grid: {n} strips" for key, n in failed.items() if n
    ]:
        raise NotConvergedError("models are compared strip by strip, and some are lost", lost)
    return RailDynamicResult(case, outcomes)


def series(result: RailDynamicResult) -> list[Series]:
    """Ratios of filters and forces by rail and offset, and the time without contact by rail."""
    case = result.case
    ratios = (ratio for under in (RIGID, BEAM) for offset in case.offsets for ratio in _ratios(result, offset, under))
    airborne = [
        Series(
            AIRBORNE,
            model,
            [
                mean_estimate(np.array([100 * float(outcome[share]) for outcome in result[offset, under, BEM, FINE]]))
                for offset in case.offsets
            ],
            where={RAIL: under},
            along=OFFSET,
            at=case.offsets,
            unit="%",
        )
        for under in (RIGID, BEAM)
        for model, share in ((BEM, "airborne"), (FILTERED, "airborne_filtered"))
    ]
    return [*ratios, *airborne]


def _ratios(result: RailDynamicResult, offset: float, under: str) -> Iterator[Series]:
    """Of boundary elements in motion, and from their force, over constant load; their force over that of the smooth
    wheel on the filtered roughness; of springs over boundary elements in motion."""
    case = result.case
    f, family = case.speed / case.bands.wavelengths, 2 * len(case.offsets)
    in_bands = partial(Series, along=FREQUENCY, at=f, scale=POWER_DECIBEL, unit="dB", family=family)
    moving, constant, still = (BEM, "moving"), (BEM, "constant"), "at constant load, same strips"
    for quantity, model, track, other, source in (
        (MOVING, BEM, moving, constant, still),
        (FORCE, BEM, (BEM, "force"), (BEM, "filtered"), f"{FILTERED}, same strips"),
        (INFERRED, BEM, (BEM, "inferred"), constant, still),
        (BESIDE, SPRINGS_OVER_BEM, (SPRINGS_THAT_READ, "moving"), moving, "boundary elements, same strips"),
    ):
        ratio = masked(result.over((offset, under), track, other), result.judged)
        grid, margin = result.left_by_grid(under, track, other), IN_RMS.with_source(source)
        yield in_bands(quantity, model, ratio, where={RAIL: under, OFFSET: offset}, grid=grid, margin=margin)


STUDY = Study(
    title="The wheel that moves on a rail: does the contact filter of constant load hold?",
    method=(
        "A rigid wheel, M = {c.mass:g} kg, {c.rail.name}, {c.speed:.3g} m/s, on a crown of 0.3 m, over {c.strips} "
        "isotropic surfaces whose lines have the levels of ISO 3095:2013, raised by {c.offsets:g} dB. M z'' = F - F_N "
        "- c z' by velocity Verlet. Of two rails one is rigid: a dashpot of {c.damping:.0%} of critical between the "
        "wheel and the inertial frame damps the resonance at {c.resonance:.0f} Hz. The other is {c.beam.description}, "
        "Z = 2 ρA c_B (1 + i), without a foundation: abs(Z) = {c.impedance:.3g} N s/m at its contact resonance, "
        "{c.resonance_on_beam:.0f} Hz. In the time loop it is eight masses with dashpots in series, whose mobility is "
        "that of the beam within 1 % from 20 Hz to 5 kHz; nothing else damps the wheel there. In each step boundary "
        "elements, {c.cells} cells to the semi-axis along, solve the contact, or springs that read the surface. A "
        "strip is {c.periods} natural periods and a half long; of its rounds {c.rounds[0]} is left out and "
        "{c.rounds[1]} kept. The lift in motion is d_Hertz(F) - d, the approach of the smooth wheel under this force "
        "less the true one: a vibration on a smooth rail has none. In flight there is no lift: the difference to the "
        "lift at constant load, which is the equivalent displacement of the contact filter, is of the steps in "
        "contact alone, over their share. The force in motion is compared with that of a smooth wheel, M on a Hertz "
        "spring, that moves over the lift at constant load of the same strip: for this wheel the filter holds exactly. "
        "The force over the linear dynamic stiffness, F (1/k - 1/(M ω² - i c ω) + 1/(i ω Z)), is what a measured force "
        "would tell. All through Hann's window. Judged are root mean squares over bands, down to the first in which A3 "
        f"of linear theory is below {COUNTED:g} dB. The roughness has waves of {{c.bands.span}}; in the last two bands "
        "oblique waves are missing. Grid: from {c.coarse} cells on {c.compared} surfaces at 0 dB, to first order; "
        "above it motions on two grids part in flight as those on two surfaces do, which is in the scatter."
    ),
    series=series,
    claims=(
        Claim(
            quantity=(RMS + MOVING, RMS + FORCE),
            where={RAIL: BEAM},
            whose=Whose.LITERATURE,
            along=OFFSET,
            printed=decibels_rms,
        ).saying(
            "The contact filter of constant load holds for a wheel in motion on a rail that gives way.",
            short="The contact filter in motion agrees with that of constant load, rms over bands",
            key="motion",
        ),
        Claim(quantity=RMS + FORCE, where={RAIL: RIGID}, along=OFFSET, printed=decibels_rms).saying(
            "On a rigid rail, flights included, the force is that of a Hertz spring over the filtered roughness.",
            short="The force on a rigid rail agrees with a Hertz spring over the filtered roughness, rms over bands",
            key="force_on_a_rigid_rail",
        ),
        Claim(quantity=RMS + MOVING, where={RAIL: RIGID}, along=OFFSET, printed=decibels_rms).saying(
            "On a rigid rail, too, where the wheel bounces, the lift while there is contact is that of constant load.",
            short="The lift in contact on a rigid rail agrees with that of constant load, rms over bands",
            key="lift_on_a_rigid_rail",
        ),
    ),
    charts=(
        Chart("rail_dynamic").of(
            "(a, b) In motion over at constant load while there is contact, 95 %, a curve for each level, on a rigid "
            "rail and on a free beam; shaded: within 1 dB. (c) On the rigid rail, the force over that of a Hertz "
            "spring on the filtered roughness. (d) Time without contact, 95 %; dashed: of that Hertz spring.",
            *(
                Panel(FREQUENCY, f"{quantity} [dB]", shade=(-1, 1), ylim=(-4, 4), title=title).of(
                    Curve(quantity, BEM, by=(OFFSET,), of={RAIL: under}, bars=True)
                )
                for quantity, under, title in (
                    (MOVING, RIGID, "rigid rail"),
                    (MOVING, BEAM, "free beam"),
                    (FORCE, RIGID, "rigid rail, force"),
                )
            ),
            Panel(OFFSET, f"{AIRBORNE} [%]", log="", title="time without contact", ticked=True).of(
                Curve(AIRBORNE, BEM, by=(RAIL,), bars=True),
                Curve(AIRBORNE, FILTERED, "dashed", "Hertz spring, rigid", of={RAIL: RIGID}),
            ),
        ),
    ),
    matrices=(Matrix(name="rms over bands", quantity="", rows=("quantity", "model", RAIL), columns=OFFSET),),
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
