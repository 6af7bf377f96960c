"""The input spectrum of springs for rolling: Geike's, the line trace, or the rolling-equivalent one."""

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from functools import partial
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix
from validation.analysis.margins import THREE_DECIBELS
from validation.analysis.series import Estimates, Margin, Series, only
from validation.analysis.statistics import POWER_DECIBEL, Estimate, nearest
from validation.analysis.study import Outcomes, Study
from validation.cases.rolling.settings import HEIGHT, Q, RollingSettings
from validation.engine.engine import SERIAL, Engine, Outcome
from validation.simulation import rough_punch
from validation.simulation.rolling_strip import ROUNDING, level_1d, level_3d, roll_strips, roll_tracks, strip_levels
from validation.simulation.track_spectrum import (
    INPUT_NAMES,
    INPUT_SPECTRA,
    InputSpectrum,
    PiecewisePowerLaw,
    self_affine,
)


@dataclass(frozen=True, kw_only=True)
class RollingInput(RollingSettings):
    """Linear theory of springs by input spectrum, over many surfaces; springs and boundary elements over some of them.

    punch_cells, surfaces, profiles: of the punches of Fig. 14.1, H = 0.7. The narrow band ends before `last`.
    """

    heights: tuple[float, ...] = (0.03, 0.3)
    strips: int = 4
    tracks: int = 40
    punch_cells: int = 64
    surfaces: int = 12
    profiles: int = 200

    @property
    def derived_for(self) -> dict[str, PiecewisePowerLaw]:
        """Power laws, for which the rolling-equivalent spectrum is Geike's times a factor far from both ends."""
        return {f"H = {hurst:g}": self_affine(hurst, 1.0, self.last) for hurst in (0.4, 0.7, 1.0)}

    @property
    def others(self) -> dict[str, PiecewisePowerLaw]:
        return {
            "roll-off": PiecewisePowerLaw(edges=(0.25, 2.0, self.last), exponents=(0.0, 3.4)),
            "two power laws": PiecewisePowerLaw(edges=(1.0, 4.0, self.last), exponents=(2.4, 4.0)),
            "narrow band": PiecewisePowerLaw(edges=(4.0, 6.0), exponents=(0.0,)),
        }

    @property
    def spectra(self) -> dict[str, PiecewisePowerLaw]:
        return {**self.derived_for, **self.others}

    @property
    def rolled(self) -> dict[str, PiecewisePowerLaw]:
        return {"H = 0.7": self.derived_for["H = 0.7"], **self.others}

    @property
    def forces(self) -> tuple[float, ...]:
        return (0.03, 0.1, 0.3)

    @property
    def punch(self) -> rough_punch.PunchRoughness:
        return rough_punch.PunchRoughness(hurst=0.7, waves=(1, self.punch_cells // 4), seed=self.seed)

    def profiles_of(self, rule: InputSpectrum) -> rough_punch.InputRoughness:
        return rough_punch.InputRoughness(**asdict(self.punch), input_spectrum=rule)

    def below_the_end(self, spectrum: PiecewisePowerLaw) -> slice:
        """One-third octaves that begin below the end of a spectrum."""
        return slice(np.count_nonzero(np.array(self.bands.edges[:-1]) < spectrum.edges[-1] * 0.999))

    def inside(self, spectrum: PiecewisePowerLaw) -> NDArray[np.bool_]:
        """Which of them lie in its band."""
        return np.array(self.bands.edges[1:])[self.below_the_end(spectrum)] > spectrum.edges[0] * 1.001


def run(case: RollingInput, engine: Engine = SERIAL) -> Outcomes:
    """Roll over the spectra by both methods; press the punches.

    Raises NotConvergedError where fewer than three strips of a spectrum and height, or surfaces at a force, converge.
    """
    scenes = {(name, h): case.rough_strip(spectrum, h) for name, spectrum in case.rolled.items() for h in case.heights}
    groups = {
        (name, h): scene.strips(case.cells, min(1e-5, 1e-4 * h), case.strips) for (name, h), scene in scenes.items()
    }
    strips, unconverged = roll_strips(groups, engine)
    tracks = {(rule, *key): case.tracks_on(scene, rule) for key, scene in scenes.items() for rule in INPUT_SPECTRA}
    on_springs = engine.map(roll_tracks, list(tracks.values()))
    surfaces = [
        rough_punch.Surface(
            roughness=case.punch, realisation=i, cells=case.punch_cells, forces=case.forces, tolerance=1e-4
        )
        for i in range(case.surfaces)
    ]
    pressed = engine.map(rough_punch.press_surface, surfaces)
    profiles = partial(
        rough_punch.Profiles, realisations=case.profiles, points=16 * case.punch_cells, length=1.0, forces=case.forces
    )
    on_profiles = engine.map(
        rough_punch.press_profiles, [profiles(roughness=case.profiles_of(rule)) for rule in INPUT_SPECTRA]
    )
    failures, punches = rough_punch.describe_failures(surfaces, pressed), rough_punch.stacked(pressed)
    rough_punch.require_converged([punches], failures)
    found: dict[Any, Outcome] = {
        **{("bem3d", *key): strip_levels(group, 1 / case.cells, case.bands) for key, group in strips.items()},
        **dict(zip(tracks, on_springs, strict=True)),
        **dict(zip(INPUT_SPECTRA, on_profiles, strict=True)),
        "punches": punches,
    }
    return Outcomes(case, found, (*unconverged, *failures))


LEVEL, LINEAR, ONE_SIDED = "level of a one-third octave", "linear springs over linear 3D", "springs over bem3d"
STIFFNESS, OVER_BEM = "mean stiffness of punches", "mean stiffness of punches over that of boundary elements"
PROFILE_HEIGHT = "rms height of the profiles of punches over that of the surfaces"
SPECTRUM, INPUT, FORCE = "spectrum", "input", "Fbar"
BESIDE_LINEAR = THREE_DECIBELS.beside("linear theory in 3D, by quadrature")
BESIDE_BEM = THREE_DECIBELS.beside("bem3d, relative to linear theory on the same surfaces")


def series(result: Outcomes) -> list[Series]:
    """Linear errors band by band; springs beside boundary elements; the punches of Fig. 14.1."""
    return [*_linear(result.case), *_rolled(result), *punches_of(result)]


def levels_of(case: RollingInput, spectrum: PiecewisePowerLaw) -> partial[Series]:
    """Over all bands below the end of a spectrum, judged in those inside."""
    at = case.bands.centres[case.below_the_end(spectrum)]
    inside = only(at, case.inside(spectrum))
    return partial(Series, LEVEL, along=Q, at=at, scale=POWER_DECIBEL, unit="dB", ranges=inside)


def _linear(case: RollingInput) -> Iterator[Series]:
    """(14.12) over linear theory in 3D."""
    for name, spectrum in case.spectra.items():
        below, exact = case.below_the_end(spectrum), level_3d(spectrum, case.bands)
        for rule in INPUT_SPECTRA:
            with np.errstate(divide="ignore"):
                over = np.log(level_1d(spectrum, rule, case.bands) / exact)[below]
            where = {SPECTRUM: name, INPUT: INPUT_NAMES[rule]}
            yield levels_of(case, spectrum)(LINEAR, over, where=where, margin=BESIDE_LINEAR)


def _rolled(result: Outcomes) -> Iterator[Series]:
    """One-sided springs over boundary elements; intervals of the worst bands hold at once for all spectra, heights."""
    case = result.case
    for height, (name, spectrum) in product(case.heights, case.rolled.items()):
        below = case.below_the_end(spectrum)
        exact = height**2 * level_3d(spectrum, case.bands)[below]
        bem = result["bem3d", name, height]
        bem_over_linear = Estimates.ratios(bem["level"][:, below], bem["linear level"][:, below])
        for rule in INPUT_SPECTRA:
            springs = np.maximum(result[rule, name, height]["level"][:, below], ROUNDING)
            yield levels_of(case, spectrum)(
                ONE_SIDED,
                Estimates.ratios(springs, exact) - bem_over_linear,
                where={SPECTRUM: name, HEIGHT: height, INPUT: INPUT_NAMES[rule]},
                margin=BESIDE_BEM,
                family=len(case.heights) * len(case.rolled),
                rms_family=1,
            )


def punches_of(result: Outcomes) -> Iterator[Series]:
    """Springs over boundary elements at each force, and at Fbar = 0.1 as a part."""
    case, ones = result.case, np.ones(len(result.case.forces))
    margin = Margin(0.1, "10 %: grid error of Fig. 14.1 at this force", source=f"bem3d on {case.punch_cells}² cells")
    bem = Estimates.ratios(result["punches"]["stiffness"], ones)
    for rule in INPUT_SPECTRA:
        of, mine = {INPUT: INPUT_NAMES[rule]}, result[rule]
        over = Estimates.ratios(mine["stiffness"], ones) - bem
        yield Series(OVER_BEM, ONE_SIDED, over, where=of, along=FORCE, at=case.forces, shown=math.exp)
        one = over[nearest(case.forces, 0.1)]
        part = Estimate(math.expm1(one.value), math.exp(one.value) * one.error, one.samples)
        yield Series(STIFFNESS, ONE_SIDED, (part,), where={FORCE: 0.1, **of}, margin=margin)
        yield Series(PROFILE_HEIGHT, "springs", (case.profiles_of(rule).profile_height,), where=of)


SPRINGS_ON = (
    (INPUT_NAMES["rolling"], "Springs with the rolling-equivalent spectrum", ""),
    (INPUT_NAMES["line"], "Springs on the trace of a line", " (Ford and Thompson 2006)"),
    (INPUT_NAMES["geike"], "Springs with Geike's spectrum", ""),
)
IN_BANDS = partial(Panel, Q, ylim=(-11.0, 11.0), shade=(-3.0, 3.0), lines=(0.0,))
STUDY = Study(
    title="The input spectrum of springs for rolling",
    method=(
        "Three input spectra of springs for one isotropic surface: Geike's spectrum; the line trace; and the "
        "rolling-equivalent spectrum C_1D(q) = ∫ (1 + q²a²) / (1 + s²a²) C_2D(s) dk, s² = q² + k². A wave s that "
        "crosses the track at an angle changes the force as a wave s does, and appears along the track as q. First, "
        "linear theory: (14.12) beside the spectrum in 3D, both by quadrature, in one-third octaves of q a, for power "
        "laws and for spectra of other shapes. Second, one-sided springs beside boundary elements ({c.strips} "
        "surfaces, {c.cells} cells to a radius, {c.tracks} tracks) at h_rms / d = {c.heights:g}, on one grid; the case "
        "rolling has the error of the grid. Third, the punches of Fig. 14.1 with each input spectrum: a punch needs "
        "the height of all waves that meet at one place, whatever their direction. The bands of a spectrum are judged "
        "by the worst of them, within 3 dB, and by their root mean square, within 1 dB."
    ),
    series=series,
    claims=(
        *(
            Claim(quantity=LEVEL, where={INPUT: name}).saying(
                f"{what} are within 3 dB of 3D in each one-third octave{source}.",
                short=f"{what}, beside 3D in one-third octaves",
            )
            for name, what, source in SPRINGS_ON
        ),
        Claim(quantity=STIFFNESS, where={INPUT: INPUT_NAMES["rolling"]}).saying(
            "The rolling-equivalent spectrum serves punches too: their mean stiffness is that of boundary elements.",
            short="Mean stiffness of punches on the rolling-equivalent spectrum, over boundary elements as a part",
        ),
    ),
    charts=(
        Chart("rolling_input", columns=3, sharey=True, width=9.0, height=5.6).of(
            "Level of (14.12) with each input spectrum over that of linear theory in 3D, in one-third octaves; shaded: "
            "within 3 dB.",
            IN_BANDS("(14.12) over linear theory in 3D [dB]", (Curve(LEVEL, LINEAR, by=(INPUT,)),), facet=SPECTRUM),
        ),
        Chart("rolling_input-springs", columns=4, sharey=True, height=5.8).of(
            "One-sided springs over boundary elements, by input spectrum, in one-third octaves, 95 % of the sample. "
            "Shaded: within 3 dB.",
            IN_BANDS(
                "springs over boundary\nelements [dB]",
                (Curve(LEVEL, ONE_SIDED, by=(INPUT,), bars=True),),
                facet=(HEIGHT, SPECTRUM),
            ),
        ),
        Chart("rolling_input-punch", claims=(3,), width=5.4, height=3.6).of(
            "Mean stiffness of punches, H = 0.7, MDR over boundary elements, by input spectrum, at three forces, 95 %; "
            "shaded: within 10 %.",
            Panel(
                FORCE,
                "mean stiffness, MDR over boundary elements",
                title="force Fbar = F / (E* h L)",
                shade=(0.9, 1.1),
                legend="best",
            ).of(Curve(OVER_BEM, by=(INPUT,), bars=True)),
        ),
    ),
    matrices=tuple(
        Matrix(name=f"worst band, {name}", quantity=LEVEL, model=model, rows=rows, columns=INPUT)
        for name, model, rows in (
            ("linear springs over linear 3D", LINEAR, (SPECTRUM,)),
            ("springs over boundary elements", ONE_SIDED, (SPECTRUM, HEIGHT)),
        )
    ),
    printed=(PROFILE_HEIGHT,),
)
CASE = Case(
    name="rolling_input",
    chapter=Chapter.ROLLING,
    place=3,
    answers="The input spectrum of MDR for rolling, and one-third octaves within 3 dB (Ford and Thompson 2006)",
    quick=RollingInput(cells=6, last=8.0, lowest=0.6, length=44.0, strips=3, tracks=20, surfaces=8, profiles=100),
    full=RollingInput(
        last=20.0,
        lowest=0.22,
        length=256.0,
        width=32.0,
        cells=16,
        strips=6,
        tracks=250,
        punch_cells=128,
        surfaces=60,
        profiles=500,
    ),
    run=run,
    study=STUDY,
    needs="linear filter, 3D",
)
