"""Stiffness along a track at constant load, by both methods, beside that of the punches of Fig. 14.1."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import Number
from validation.analysis.margins import THREE_DECIBELS
from validation.analysis.series import Estimates, Margin, Series
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL, Estimate, extrapolated, jackknife_error, log_ratio_of_means
from validation.analysis.study import Outcomes, Study
from validation.engine.convergence import FEWEST, NotConvergedError, require_realisations
from validation.engine.engine import SERIAL, Engine, FloatArray, Outcome
from validation.simulation import rolling_strip, rough_punch
from validation.simulation.rolling_strip import HERTZ, RoughStrip, Strip, Tracks
from validation.simulation.track_spectrum import INPUT_SPECTRA, InputSpectrum, PiecewisePowerLaw, self_affine

ROUNDING = 1e-9
"""A relative deviation below is none: all springs touch."""


@dataclass(frozen=True, kw_only=True)
class TrackStiffness:
    """A wheel under the force F of a smooth one with the approach d, over the roughness of the punches of Fig. 14.1.

    forces: Fbar = F / (E* h L) with L = 2 a, which is 2 / 3 over h/d; hurst; waves: the shortest on L, of which the
    longest is one; length, width: of a surface over a; cells: to a contact radius; strips, refined: surfaces, and how
    many are rolled again on cells half as wide; tracks, springs: realisations, and springs to a radius; surfaces,
    profiles: of punches; seed.
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
    surfaces: int = 30
    profiles: int = 400
    seed: int = 153

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips, refined=self.refined, surfaces=self.surfaces)

    @property
    def spectrum(self) -> PiecewisePowerLaw:
        return self_affine(self.hurst, math.pi, self.waves * math.pi)

    @property
    def bands(self) -> Bands:
        """One-third octaves below the roughness and in it."""
        return Bands.around(math.pi, 0.5 * math.pi, self.waves * math.pi).on(self.length)

    @property
    def punch(self) -> rough_punch.PunchRoughness:
        return rough_punch.PunchRoughness(hurst=self.hurst, waves=(1, self.waves), seed=self.seed)

    @property
    def faces(self) -> list[rough_punch.Surface]:
        """Of punches, pressed at Fbar / 3 first: each contact starts from the last."""
        return [
            rough_punch.Surface(
                roughness=self.punch, realisation=i, cells=8 * self.waves, forces=(force / 3, force), tolerance=1e-4
            )
            for force in self.forces
            for i in range(self.surfaces)
        ]

    @property
    def faces_of_springs(self) -> rough_punch.Profiles:
        points = 8 * self.springs
        return rough_punch.Profiles(
            roughness=self.punch, realisations=self.profiles, points=points, length=1.0, forces=self.forces
        )

    def height(self, force: float) -> float:
        """h/d."""
        return HERTZ / 2 / force

    def rough_strip(self, force: float) -> RoughStrip:
        return RoughStrip(
            spectrum=self.spectrum, height=self.height(force), length=self.length, width=self.width, seed=self.seed
        )

    def strips_of(self, force: float, cells: int) -> list[Strip]:
        return self.rough_strip(force).strips(cells, 3e-5, self.strips if cells == self.cells else self.refined)

    def tracks_of(self, force: float, rule: InputSpectrum) -> Tracks:
        return Tracks(
            scene=self.rough_strip(force),
            input_spectrum=rule,
            realisations=self.tracks,
            springs=self.springs,
            bands=self.bands,
        )


def run(case: TrackStiffness, engine: Engine = SERIAL) -> Outcomes:
    """Roll and press. Raises NotConvergedError where fewer than three strips or punches converge at a force."""
    cells = {WHEEL: case.cells, REFINED: 2 * case.cells}
    groups = {(name, force): case.strips_of(force, n) for force in case.forces for name, n in cells.items()}
    strips = engine.map_groups(rolling_strip.roll_loaded_strip, groups)
    lost = tuple(
        f"strip {i}, Fbar = {force:g}, {cells[name]} cells to a radius: {int(one['failed'])} positions"
        for (name, force), found in strips.items()
        for i, one in enumerate(found)
        if one["failed"]
    )
    for key, found in strips.items():
        if sum(not one["failed"] for one in found) < FEWEST:
            raise NotConvergedError(f"fewer than {FEWEST} strips of {key} converged", lost)
    rows = {
        key: [rolling_strip.stiffness_moments(one["stiffness"], 1 / cells[key[0]], case.bands) for one in found]
        for key, found in strips.items()
    }
    along = {key: {name: np.array([one[name] for one in found]) for name in found[0]} for key, found in rows.items()}
    tracks = {(rule, force): case.tracks_of(force, rule) for force in case.forces for rule in INPUT_SPECTRA}
    rolled = engine.map(rolling_strip.roll_loaded_tracks, list(tracks.values()))
    pressed = engine.map(rough_punch.press_surface, case.faces)
    failures = rough_punch.describe_failures(case.faces, pressed)
    rough_punch.require_converged([rough_punch.stacked(pressed)], failures)
    punches = np.array([one["stiffness"][-1] for one in pressed]).reshape(len(case.forces), -1)
    results: dict[tuple[str, float], Outcome | FloatArray] = {**along, **dict(zip(tracks, rolled, strict=True))}
    for force, bem, springs in zip(
        case.forces, punches, rough_punch.press_profiles(case.faces_of_springs)["stiffness"].T, strict=True
    ):
        results |= {(PUNCH, force): bem, (PROFILE, force): springs}
    return Outcomes(case, results, (*lost, *failures))


WHEEL, REFINED, PUNCH, PROFILE = "wheel, bem3d", "wheel, bem3d, half of the cell", "punch, bem3d", "punch, springs"
SPRINGS: dict[InputSpectrum, str] = {
    "geike": "springs with Geike's spectrum",
    "line": "springs with line trace",
    "rolling": "springs with rolling-equivalent spectrum",
}
OVER = {rule: f"{springs} over bem3d" for rule, springs in SPRINGS.items()}
PUNCH_OVER_WHEEL = "punch over wheel, bem3d"
MEAN, DEVIATION = "mean stiffness", "relative deviation of stiffness"
LEVEL, OWN_LEVEL = "level of stiffness in a one-third octave", "own level of stiffness in a one-third octave"
FORCE, Q = "Fbar", "q a"
SHOWN = {MEAN: "mean stiffness of each model", DEVIATION: "relative deviation of each model"}
ROWS = {MEAN: np.array([0.0, 1.0]), DEVIATION: np.array([0.5, -1.0])}
"""Weights of ln of the mean variance and of ln of the mean."""
SOURCE = "bem3d along the track, extrapolated"
TEN_PER_CENT = Margin(0.1, "10 %: the margin of Fig. 14.1", source=SOURCE)
IN_BANDS = THREE_DECIBELS.beside(SOURCE)


def series(result: Outcomes) -> list[Series]:
    """Moments along the track and from punch to punch, and levels in one-third octaves, force by force."""
    return [
        one
        for force in result.case.forces
        for some in (*(_moments(result, quantity, force) for quantity in ROWS), _levels(result, force))
        for one in some
    ]


def _moments(result: Outcomes, quantity: str, force: float) -> Iterator[Series]:
    """Each model's own, and springs over boundary elements along the track; of deviations that of punches too."""
    case, together = result.case, len(result.case.forces) * len(INPUT_SPECTRA)
    bem, grid = of_bem(result, quantity, force)
    found = {WHEEL: bem}
    found |= {springs: of_tracks(quantity, result[rule, force]) for rule, springs in SPRINGS.items()}
    found |= {model: of_punches(result[model, force], quantity) for model in (PUNCH, PROFILE)}
    for model, log in found.items():
        left = math.exp(log.value) * grid if model == WHEEL else 0.0
        where = {FORCE: force, "h/d": case.height(force)}
        yield Series(SHOWN[quantity], model, (exponential(log),), where=where, grid=left)
    pairs = {OVER[rule]: found[springs] for rule, springs in SPRINGS.items()}
    for model, log in (pairs | ({PUNCH_OVER_WHEEL: found[PUNCH]} if quantity == DEVIATION else {})).items():
        apart = log.minus(bem)
        yield Series(
            quantity,
            model,
            (exponential(apart, less=1.0),),
            where={FORCE: force},
            grid=math.exp(apart.value) * grid,
            margin=TEN_PER_CENT,
            family=together,
        )


def _levels(result: Outcomes, force: float) -> Iterator[Series]:
    """Springs over boundary elements on cells of no size; intervals hold at once for all forces."""
    coarse, fine = (result[grid, force]["level"] for grid in (WHEEL, REFINED))
    finer, alone = Estimates.ratios(fine, coarse[: len(fine)]), np.ones(coarse.shape[1])
    bem = Estimates.ratios(coarse, alone).on_no_size(finer)
    in_bands = partial(Series, along=Q, at=result.case.bands.centres, scale=POWER_DECIBEL, unit="dB")
    where, family = {FORCE: force}, 2 * len(result.case.forces)
    yield in_bands(OWN_LEVEL, WHEEL, bem, where=where, grid=finer)
    for rule, name in SPRINGS.items():
        springs = Estimates.ratios(result[rule, force]["level"], alone)
        yield in_bands(OWN_LEVEL, name, springs, where=where)
        yield in_bands(LEVEL, OVER[rule], springs - bem, where=where, grid=finer, margin=IN_BANDS, family=family)


def of_bem(result: Outcomes, quantity: str, force: float) -> tuple[Estimate, float]:
    """ln of the mean stiffness, or of its relative deviation, on cells of no size; half-width that the grid leaves."""
    coarse, fine = result[WHEEL, force], result[REFINED, force]
    same = {name: values[: len(fine["mean"])] for name, values in coarse.items()}
    return extrapolated(of_tracks(quantity, coarse), of_tracks(quantity, fine, same))


def of_tracks(quantity: str, outcome: Outcome, other: Outcome | None = None) -> Estimate:
    """The same along tracks, or over another's."""
    mine, reference = (np.stack([one["variance"], one["mean"]], axis=1) for one in (outcome, other or outcome))
    return log_ratio_of_means(mine, reference if other else np.ones(2), ROWS[quantity])


def of_punches(stiffness: FloatArray, quantity: str) -> Estimate:
    """The same over punches, with its jackknife error."""
    known = stiffness[np.isfinite(stiffness)]
    without = np.array([np.delete(known, i) for i in range(known.size)])

    def log(values: FloatArray) -> FloatArray:
        mean = values.mean(axis=-1)
        value = mean if quantity == MEAN else np.maximum(values.std(axis=-1, ddof=1) / mean, ROUNDING)
        return np.asarray(np.log(value))

    return Estimate(float(log(known)), float(jackknife_error(log(without))), known.size)


def exponential(log: Estimate, less: float = 0.0) -> Estimate:
    """exp(x) - less of an estimate of x, to first order in its error."""
    ratio = math.exp(log.value)
    return Estimate(ratio - less, ratio * log.error, log.samples)


def percent(number: Number) -> str:
    return f"{100 * number.value:+.0f} ± {100 * number.uncertainty:.0f} %"


def _over_force(quantity: str) -> Panel:
    curves = (
        Curve(SHOWN[quantity], (WHEEL, *SPRINGS.values()), by=("model",), bars=True),
        Curve(SHOWN[quantity], (PUNCH, PROFILE), "open", by=("model",), bars=True),
    )
    return Panel(FORCE, quantity, ylim=(0, None), ticked=True).of(*curves)


in_per_cent = partial(Claim, printed=percent)
ALONG = "Along a track under constant load, springs with Geike's spectrum"
STUDY = Study(
    title="Stiffness along a track at constant load: from Fig. 14.1 to rolling",
    method=(
        "A wheel rolls under a constant force over {c.strips} isotropic surfaces, H = {c.hurst:g}, whose longest wave "
        "is the diameter L = 2 a of the smooth contact and whose shortest is L / {c.waves}, as on the punches of Fig. "
        "14.1. At each position the stiffness is dF/dd of boundary elements at a constant contact area, {c.cells} "
        "cells to a radius, {c.refined} surfaces again with twice as many; and that of the springs in contact, "
        "{c.tracks} tracks with each of three input spectra. Beside them: {c.surfaces} punches of side L with the same "
        "roughness, eight cells to its shortest wave, and {c.profiles} profiles, at the same Fbar = F / (E* h L)."
    ),
    series=series,
    claims=(
        in_per_cent(quantity=DEVIATION, model=OVER["geike"]).saying(
            f"{ALONG} have the fluctuation of stiffness of boundary elements.",
            short="Fluctuation of stiffness along a track, springs beside boundary elements",
        ),
        in_per_cent(quantity=MEAN, model=OVER["geike"]).saying(
            f"{ALONG} have the mean stiffness of boundary elements.", short="its mean"
        ),
        Claim(quantity=(LEVEL, "rms of " + LEVEL), model=OVER["geike"]).saying(
            "Springs with Geike's spectrum have the level of the stiffness in each one-third octave."
        ),
        in_per_cent(quantity=DEVIATION, model=(OVER["line"], OVER["rolling"])).saying(
            "The line trace or the rolling-equivalent spectrum mends the fluctuation of stiffness."
        ),
        in_per_cent(quantity=DEVIATION, model=PUNCH_OVER_WHEEL).saying(
            "The fluctuation of stiffness along a track is that from punch to punch of Fig. 14.1 at the same Fbar."
        ),
    ),
    charts=(
        Chart("track_stiffness", claims=(0, 1), height=4.4).of(
            "(a) Mean stiffness over 2 E* a of a wheel, and over E* L of punches, over Fbar = F / (E* h L). (b) "
            "Relative deviation, along the track and, open, from punch to punch; 95 %. (c) Level of the stiffness, "
            "springs of Geike's spectrum over boundary elements, dark to light: Fbar; shaded: within 3 dB.",
            _over_force(MEAN),
            _over_force(DEVIATION),
            Panel(Q, "springs over boundary elements [dB]", shade=(-3, 3), ylim=(-25, 25)).of(
                Curve(LEVEL, OVER["geike"], by=(FORCE,), bars=True)
            ),
        ),
    ),
    matrices=tuple(
        Matrix(name=quantity, quantity=quantity, rows=("model",), columns=FORCE, printed=percent) for quantity in ROWS
    ),
)
CASE = Case(
    name="track_stiffness",
    chapter=Chapter.ROLLING,
    place=6,
    answers="Fluctuation of stiffness along a track: the link from Fig. 14.1 to rolling",
    quick=TrackStiffness(cells=6, strips=4, tracks=20),
    full=TrackStiffness(
        forces=(0.3, 1.0, 3.0, 10.0), length=32, width=12, strips=8, refined=6, tracks=60, surfaces=100, profiles=2000
    ),
    run=run,
    study=STUDY,
    needs="boundary elements",
)
