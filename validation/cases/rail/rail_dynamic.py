"""A wheel with a mass on a rough rail: does the contact filter of constant load hold when the wheel moves?"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix
from validation.analysis.margins import REPEATABLE
from validation.analysis.nominal_bands import NominalBands
from validation.analysis.series import Estimates, Series, Where, masked, only
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL, FloatArray
from validation.analysis.study import Outcomes, Study
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.scenes.level_files import curve
from validation.simulation.rail_strip import RailGround, RailStrip
from validation.simulation.wheel_on_rail import BEM, SPRINGS, WheelOnRail, roll_and_move
from validation.theory.elliptic_contact import EllipticContact, elliptic_contact

MODELS = (BEM, SPRINGS)
FINE, COARSE = "fine", "coarse"
Key = tuple[float, str, str]
"""Offset of the levels, model, grid."""
Track = tuple[str, str]
"""Model, and what lifts its wheel."""

OFFSET, FREQUENCY, A3 = "dB over the curve", "f [Hz]", "contact filter A3"
MOVING, INFERRED, BESIDE = "filter in motion", "filter inferred from the force", "filter in motion, of two models"
AIRBORNE, PLACES, LAST = "time in the air", "places in frequency", "last band that is judged"
RMS = "rms of "
NEAR, ABOVE = "near the resonance", "above the resonance"
LOUD, WIDEST = -15.0, 1.5
"""Level of the filter [dB] down to which its bands are judged; bands near the resonance are within this factor."""
RMS_REPEATABLE = replace(
    REPEATABLE, source="at constant load, same strips", worst=False, rms=(REPEATABLE.tolerance, REPEATABLE.reason)
)


@dataclass(frozen=True, kw_only=True)
class RailDynamic:
    """Wheels of a mass over isotropic rails of a level curve, and the same contacts at constant load.

    curve: of a line; offsets: of its levels [dB]; radii: along and across [m]; load [N]; modulus: E* [Pa]; mass [kg];
    speed [m/s]; longest, shortest: nominal wavelengths of the bands [m]; periods: whole natural periods of a strip,
    before a half, so that no wave has the resonance; width: of the strips over the longest wave; cells, coarse: to the
    semi-axis along; strips; compared: of them on the coarse grid too; tolerance: of each contact.
    """

    curve: str = "iso3095-2013"
    offsets: tuple[float, ...] = (0.0, 10.0)
    radii: tuple[float, float] = (0.46, 0.3)
    load: float = 5e4
    modulus: float = 210e9 / (2 * (1 - 0.3**2))
    mass: float = 500.0
    speed: float = 80 / 3.6
    longest: float = 0.125
    shortest: float = 0.005
    periods: int = 6
    width: float = 1.0
    cells: int = 6
    coarse: int = 5
    strips: int = 7
    compared: int = 2
    tolerance: float = 1e-4
    seed: int = 20

    def __post_init__(self) -> None:
        try:
            Bands(tuple(self.bands.edges.tolist())).on(self.length)
        except ValueError:
            raise ValueError(
                f"periods must be so many that each band of the track has a wave, got {self.periods}, which are "
                f"{self.length:.3g} m, for waves of up to {self.longest:g} m"
            ) from None

    @cached_property
    def contact(self) -> EllipticContact:
        """At rest on the smooth rail."""
        return elliptic_contact(self.radii, modulus=self.modulus, force=self.load)

    @cached_property
    def bands(self) -> NominalBands:
        return NominalBands().within(self.longest, self.shortest)

    @property
    def frequencies(self) -> FloatArray:
        """f = v / lambda of the bands [Hz]."""
        return np.asarray(self.speed / self.bands.wavelengths)

    @property
    def resonance(self) -> float:
        """sqrt(k / M) / 2 pi [Hz]."""
        return math.sqrt(self.contact.stiffness / self.mass) / (2 * math.pi)

    @property
    def length(self) -> float:
        """Of a track [m]: whole semi-axes, about `periods` of the resonance and a half."""
        unit = self.contact.along
        return unit * round((self.periods + 0.5) * self.speed / self.resonance / unit)

    def problem(self, key: Key, realisation: int) -> WheelOnRail:
        offset, model, grid = key
        unit, cells = self.contact.along, self.cells if grid == FINE else self.coarse
        line = curve(self.curve).raised(offset).c_line
        first, last = float(self.bands.edges[0]), float(self.bands.edges[-1])
        strip = RailStrip(
            ground=RailGround(line=line, across="isotropic", first=first, last=last),
            radii=self.radii,
            force=self.load,
            modulus=self.modulus,
            length=self.length,
            width=unit * round(self.width * self.longest / unit),
            spacing=unit / cells,
            realisation=realisation,
            seed=self.seed,
        )
        return WheelOnRail(strip=strip, mass=self.mass, speed=self.speed, model=model, tolerance=self.tolerance)

    @property
    def keys(self) -> dict[Key, int]:
        counts = {FINE: self.strips, COARSE: self.compared}
        return {(offset, model, grid): n for offset in self.offsets for model in MODELS for grid, n in counts.items()}


@dataclass(frozen=True)
class RailDynamicResult(Outcomes):
    """Outcomes of the strips, by offset, model and grid."""

    case: RailDynamic

    def powers(self, key: Key, name: str) -> FloatArray:
        """Mean square in each band of what lifts the wheel, (strips, bands), through Hann's window.

        name: "constant", "moving", "linear" or "line"; or "inferred", the force over the linear dynamic stiffness.
        Free vibration does not end where it began: without a window it would leak.
        """
        spacing = self.case.problem(key, 0).strip.spacing
        tracks = [self._track(key, outcome, name) for outcome in self[key]]
        return np.array([self.case.bands.powers_of_track(track, spacing=spacing) for track in tracks])

    def _track(self, key: Key, outcome: Outcome, name: str) -> FloatArray:
        values = outcome["force" if name == "inferred" else name]
        seen = hann(values.size) * (values - values.mean())
        return over_dynamic_stiffness(self.case.problem(key, 0), seen) if name == "inferred" else seen

    def filter(self, key: Key, name: str) -> FloatArray:
        """ln of the band powers over those of the line roughness."""
        mine, line = (self.powers(key, track).mean(axis=0) for track in (name, "line"))
        return np.asarray(np.log(mine / line))

    @cached_property
    def judged(self) -> np.ndarray:
        """Bands before the first zero of the filter, at lambda = 2 a, and not below -15 dB."""
        before = self.case.bands.wavelengths > 2.5 * self.case.contact.along
        linear = self.filter((self.case.offsets[0], SPRINGS, FINE), "linear")
        return np.asarray(before & (POWER_DECIBEL * linear > LOUD))

    def over(self, offset: float, mine: Track, other: Track) -> tuple[Estimates, FloatArray]:
        """ln of the band powers of one track over another on the same strips, and what the grid leaves of it."""
        case, some = self.case, slice(self.case.compared)

        def ratios(grid: str, strips: slice) -> Estimates:
            found, reference = (self.powers((offset, model, grid), name)[strips] for model, name in (mine, other))
            return Estimates.ratios(found, reference)

        change = ratios(FINE, some).values - ratios(COARSE, some).values
        return ratios(FINE, slice(None)), np.abs(change) / (case.cells / case.coarse - 1)


def over_dynamic_stiffness(problem: WheelOnRail, force: FloatArray) -> FloatArray:
    """F (1 / k - 1 / (M omega^2)), omega that of leapfrog: what lifts a wheel on a linear contact."""
    dt = problem.time_step
    stepped = (2 * np.sin(math.pi * np.fft.rfftfreq(force.size, dt)[1:] * dt) / dt) ** 2
    waves = np.fft.rfft(force)
    waves[0] = 0.0
    waves[1:] *= 1 / problem.wheel.stiffness - 1 / (problem.mass * stepped)
    return np.fft.irfft(waves, force.size)


def hann(points: int) -> FloatArray:
    """Hann's window, of mean square one."""
    return np.asarray(np.sin(np.pi * (np.arange(points) + 0.5) / points) ** 2 * math.sqrt(8 / 3))


def run(case: RailDynamic, engine: Engine = SERIAL) -> RailDynamicResult:
    """All strips, on both grids. Raises NotConvergedError where one is lost: the models are compared strip by strip."""
    problems = {key: [case.problem(key, i) for i in range(count)] for key, count in case.keys.items()}
    outcomes = engine.map_groups(roll_and_move, problems)
    failed = {key: sum(bool(one["failed"]) for one in some) for key, some in outcomes.items()}
    if lost := [f"{key[1]} at +{key[0]:g} dB, {key[2]} grid: {n} strips" for key, n in failed.items() if n]:
        raise NotConvergedError("models are compared strip by strip, and some are lost", lost)
    return RailDynamicResult(case, outcomes)


def series(result: RailDynamicResult) -> list[Series]:
    """Filters and ratios by offset, the time in the air, and places on the axis of frequencies."""
    case, last = result.case, result.case.frequencies[result.judged].max() * 10**0.05
    places = {NEAR: (case.resonance / WIDEST, case.resonance * WIDEST), LAST: (last,)}
    flying = [100 * float(np.mean([one["force"] <= 0 for one in result[o, BEM, FINE]])) for o in case.offsets]
    return [
        *(one for offset in case.offsets for one in (*_filters(result, offset), *_ratios(result, offset))),
        Series(AIRBORNE, BEM, flying, along=OFFSET, at=case.offsets, unit="%"),
        *(Series(PLACES, name, ends, along=FREQUENCY, at=ends, unit="Hz") for name, ends in places.items()),
    ]


def _filters(result: RailDynamicResult, offset: float) -> Iterator[Series]:
    in_bands = partial(Series, along=FREQUENCY, at=result.case.frequencies, scale=POWER_DECIBEL, unit="dB")
    for model in MODELS:
        for lift in ("constant", "moving", "inferred"):
            found = result.filter((offset, model, FINE), lift)
            yield in_bands(A3, model, found, where={OFFSET: offset, "lift": lift})
    first = result.filter((result.case.offsets[0], SPRINGS, FINE), "linear")
    yield in_bands(A3, "linear theory", first, where={OFFSET: offset, "lift": "constant"})


def _ratios(result: RailDynamicResult, offset: float) -> Iterator[Series]:
    """In motion and from the force over constant load; the intervals hold at once for all numbers of a claim."""
    case, f = result.case, result.case.frequencies
    near = (f > case.resonance / WIDEST) & (f < WIDEST * case.resonance)
    above, every = f >= WIDEST * case.resonance, np.ones(f.size, dtype=bool)
    in_bands = partial(
        Series, along=FREQUENCY, at=f, scale=POWER_DECIBEL, unit="dB", family=len(MODELS) * len(case.offsets)
    )
    compared = [
        *((MOVING, model, "all bands", every, (model, "moving"), (model, "constant")) for model in MODELS),
        (BESIDE, f"{SPRINGS} over {BEM}", "all bands", every, (SPRINGS, "moving"), (BEM, "moving")),
        (INFERRED, BEM, ABOVE, above, (BEM, "inferred"), (BEM, "constant")),
        (INFERRED, BEM, NEAR, near, (BEM, "inferred"), (BEM, "constant")),
    ]
    for quantity, model, bands, inside, mine, other in compared:
        margin = RMS_REPEATABLE.beside("boundary elements, same strips") if quantity == BESIDE else RMS_REPEATABLE
        found, grid = result.over(offset, mine, other)
        where: Where = {OFFSET: offset, "bands": bands}
        ranges = only(f, result.judged & inside)
        yield in_bands(quantity, model, masked(found, inside), where=where, grid=grid, margin=margin, ranges=ranges)


PLACED = (Curve(PLACES, NEAR, "guide", "_", upright=True), Curve(PLACES, LAST, "dashed", "_", upright=True))
STUDY = Study(
    title="The wheel that moves on a rail: does the contact filter of constant load hold?",
    method=(
        "A rigid wheel, M = {c.mass:g} kg, {c.load:g} N, {c.speed:.3g} m/s, radii {c.radii:g} m, over {c.strips} "
        "isotropic surfaces whose lines have the levels of {c.curve}, raised by {c.offsets:g} dB. M z'' = F - F_N "
        "by velocity Verlet, the contact solved in each step by boundary elements, {c.cells} cells to the "
        "semi-axis along, or by springs that read the surface; it begins in the steady state of linear theory. The "
        "lift in motion is d_Hertz(F) - d, the approach of the smooth wheel under this force less the true one: a "
        "vibration on a smooth rail has none, however large. At constant load it is the contact filter's equivalent "
        "displacement. The force over the linear dynamic stiffness, F (1/k - 1/(M ω²)), is what a measured "
        "force would tell; a large vibration has a second harmonic, which it takes for roughness. Nothing damps the "
        "resonance, {c.resonance:.0f} Hz: its vibration grows with the length of the strip, {c.periods} natural "
        "periods and a half. All through Hann's window. Judged are the root mean squares over bands before the first "
        f"zero of the filter and above {LOUD:g} dB. The roughness has waves of "
        "{c.bands.span}; in the last two bands oblique waves are missing. Grid: from {c.coarse} cells on {c.compared} "
        "surfaces, to first order."
    ),
    series=series,
    claims=(
        Claim(quantity=RMS + MOVING, along=OFFSET).saying(
            "The contact filter of constant load holds when the wheel moves.",
            short="In motion over constant load, rms over bands",
        ),
        Claim(quantity=RMS + BESIDE, along=OFFSET).saying(
            "Springs that read the surface lift a wheel that moves as boundary elements do.",
            short="springs that read the surface over boundary elements in motion",
        ),
        *(
            Claim(quantity=RMS + INFERRED, where={"bands": bands}, along=OFFSET).saying(
                f"The force over the linear dynamic stiffness tells what lifts the wheel {bands}."
            )
            for bands in (ABOVE, NEAR)
        ),
    ),
    charts=(
        Chart("rail_dynamic").of(
            "(a) A3 at {c.speed:.3g} m/s and the lowest level. (b), (c) In motion over at constant load, 95 %, a curve "
            "for each level; shaded: within 1 dB. Between the dotted lines: near the resonance. Right of the dashed "
            "line: not judged.",
            Panel(FREQUENCY, "contact filter A3 [dB]", ylim=(-30, 10), legend="lower left").of(
                Curve(A3, "linear theory", "thick", "linear theory", of={OFFSET: "first"}),
                Curve(A3, BEM, "exact", "bem3d, constant load", of={OFFSET: "first", "lift": "constant"}),
                Curve(A3, BEM, "bem", "bem3d, in motion", of={OFFSET: "first", "lift": "moving"}),
                Curve(A3, SPRINGS, "mdr", "springs, in motion", of={OFFSET: "first", "lift": "moving"}),
                Curve(A3, BEM, "crosses", "from the force", of={OFFSET: "first", "lift": "inferred"}),
                *PLACED,
            ),
            *(
                Panel(
                    FREQUENCY,
                    "in motion over constant load [dB]",
                    title=model,
                    shade=(-1, 1),
                    ylim=(-15, 20),
                    legend="lower left",
                ).of(Curve(MOVING, model, by=(OFFSET,), bars=True), *PLACED)
                for model in MODELS
            ),
        ),
    ),
    matrices=(Matrix(name="rms over bands", quantity="", rows=("quantity", "model", "bands"), columns=OFFSET),),
    printed=(AIRBORNE,),
)
CASE = Case(
    name="rail_dynamic",
    chapter=Chapter.RAIL,
    place=5,
    answers="A contact filter is measured and computed at constant load; the wheel of rolling noise moves",
    quick=RailDynamic(strips=3),
    full=RailDynamic(
        offsets=(-10.0, 0.0, 10.0),
        longest=0.4,
        shortest=0.0025,
        periods=12,
        width=0.6,
        cells=12,
        coarse=8,
        strips=14,
        compared=4,
    ),
    run=run,
    study=STUDY,
    needs="boundary elements in the time loop",
)
