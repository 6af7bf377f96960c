"""Models of the wheel and boundary elements on the same strips: how far each follows, and at what work."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np

from validation.analysis.claims import Matrix
from validation.analysis.evidence import Place
from validation.analysis.number_text import decibels_rms
from validation.analysis.series import REPEATABLE, Margin
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, jackknifed, mean_estimate
from validation.case import SERIAL, Case, Chapter, Chart, Claim, Curve, Engine, Outcomes, Panel, Quantity, Series, Study
from validation.cases.rolling.force_spectrum import HEIGHT, SLOPE, SLOPE_COUNTS, Q
from validation.engine.realisations import require_realisations
from validation.scenes.description import slope_ratio
from validation.scenes.load import load_scene_with_track
from validation.simulation import reduced_models
from validation.simulation.model_names import FILTER_3D as LINEAR
from validation.simulation.reduced_models import BED, COARSE, COARSEST, JUDGE, LINE, MODELS, READ, TOLERANCE
from validation.simulation.rolling_strip import RoughStrip, Strip
from validation.simulation.track_spectrum import self_affine

__all__ = ["CASE", "COARSEST", "JUDGE", "LINEAR", "OFF", "READ", "WORK", "ReducedModels", "run"]

Spectrum = tuple[float, float, float]
"""Hurst exponent, q a of the longest and of the shortest wave."""
Key = tuple[float, Spectrum]
"""h' a/d, and the spectrum."""


CELLS = 12
"""To a contact radius, of all sizes of the case."""


@dataclass(frozen=True, kw_only=True)
class ReducedModels:
    """A wheel at the approach d, contact radius a, over strips of all spectra at the same slopes.

    spectra: Hurst exponent, q a of the longest and of the shortest wave; slopes: h' a/d, ascending, h' along the track,
    of all waves; strips: realisations; waves: of the longest on a strip at least; length: over a at least; width: over
    a, in waves at least one; cells: to a contact radius, divisible by six; seed: zero or positive.
    """

    spectra: tuple[Spectrum, ...] = ((0.7, 1.0, 10.0), (0.4, 2.0, 10.0))
    slopes: tuple[float, ...] = (0.2, 1.0)
    strips: int = 6
    waves: int = 4
    length: int = 16
    width: int = 8
    cells: int = CELLS
    seed: int = 20

    def __post_init__(self) -> None:
        require_realisations(strips=self.strips)
        if self.cells % 6:
            raise ValueError(f"cells must be a multiple of 6, got {self.cells}")

    @property
    def coarsest(self) -> int:
        return self.cells // 3

    def strips_of(self, slope: float, spectrum: Spectrum) -> list[Strip]:
        longest, height = 2 * math.pi / spectrum[1], height_at(slope, spectrum)
        scene = RoughStrip(
            spectrum=self_affine(*spectrum),
            height=height,
            length=max(self.length, math.ceil(self.waves * longest)),
            width=max(self.width, math.ceil(longest)),
            seed=self.seed,
        )
        return scene.strips(self.cells, TOLERANCE * height, self.strips)


def height_at(slope: float, spectrum: Spectrum) -> float:
    """h/d of a spectrum at an h' a/d."""
    return slope / self_affine(*spectrum).slope_along


def run(case: ReducedModels, engine: Engine = SERIAL) -> Outcomes:
    groups = {key: case.strips_of(*key) for key in product(case.slopes, case.spectra)}
    strips = engine.map_groups(reduced_models.roll_by_all, groups)
    unconverged = tuple(
        f"strip {i}, h' a/d = {key[0]:g}: {int(outcome['failed'])} models with a contact that did not converge"
        for key, outcomes in strips.items()
        for i, outcome in enumerate(outcomes)
        if outcome["failed"]
    )
    return Outcomes(case, strips, unconverged)


OFF = Quantity("rms_over_octaves_of_the_level_over_boundary_elements")
LARGEST = Quantity("largest_rms_over_octaves_of_all_strips_as_smooth")
KEPT, OWN_KEPT = Quantity("share_of_contact_kept"), Quantity("share_of_contact_kept_by_each_spectrum")
WORK, AT_WORK = Quantity("work_over_springs_on_a_line"), Quantity("rms_over_octaves_beside_work")
TABLE_14_1 = Quantity("wheel_of_Table_14.1")
GRID = 1 / 3
"""Error of a grid over its change to half of the cells, of second order."""
BESIDE = REPEATABLE.with_source("boundary elements on the same strips, all cells")
TENTH = Margin(0.1, "0.1: a tenth of the contact", source="the first spectrum at the same h' a/d")


def series(result: Outcomes) -> list[Series]:
    """Of each model over all strips, the smoothest first; over its work where these are roughest."""
    case, numbers = result.case, []
    for model in MODELS:
        largest = [max(off(result, key, model).value for key in result.by_key if key[0] <= s) for s in case.slopes]
        numbers.append(Series(LARGEST, _label(model), np.array(largest), along=SLOPE, at=case.slopes))
        numbers += [s for key in result.by_key for s in _of_strips(result, key, model)]
    numbers += [s for key in result.by_key for s in _contact(result, key)]
    scene = load_scene_with_track("table_14_1")
    numbers.append(Series(TABLE_14_1, HEIGHT, (scene.rms / scene.approach,)))
    return [*numbers, Series(TABLE_14_1, SLOPE, (slope_ratio(scene.slope_along, scene),))]


def _where(key: Key) -> dict[str, Place]:
    slope, (hurst, *ends) = key
    return {"H": hurst, Q: (ends[0], ends[1]), SLOPE: slope, HEIGHT: float(f"{height_at(*key):.3g}")}


def _label(model: str) -> str:
    """As `compare` has it."""
    return LINEAR if model == reduced_models.LINEAR else model


def _of_strips(result: Outcomes, key: Key, model: str) -> Iterator[Series]:
    name, judge = _label(model), model == JUDGE
    single = partial(Series, where=_where(key))
    grid, error = GRID * off(result, key, COARSE).value, off(result, key, model)
    yield single(OFF, name, (error,), grid=grid, unit="dB", margin=None if judge else BESIDE)
    yield single(WORK, name, (work(result, key, model),))
    if not judge and key[0] == result.case.slopes[-1]:
        yield Series(AT_WORK, name, (error,), where=_where(key), along=WORK, at=(work(result, key, model),), unit="dB")


def _contact(result: Outcomes, key: Key) -> Iterator[Series]:
    """Beside what the first spectrum keeps at the same h' a/d; intervals hold at once for all."""
    slope, spectra = key[0], result.case.spectra
    share, first = (
        mean_estimate(np.array([float(outcome["kept"]) for outcome in result[slope, s]])) for s in (key[1], spectra[0])
    )
    yield Series(OWN_KEPT, JUDGE, (share,), where=_where(key))
    if key[1] != spectra[0]:
        family = (len(spectra) - 1) * len(result.case.slopes)
        yield Series(KEPT, JUDGE, (share,), where=_where(key), reference=(first,), margin=TENTH, family=family)


def off(result: Outcomes, key: Key, model: str) -> Estimate:
    """Root mean square over octaves of the mean level over that of boundary elements [dB], with its jackknife."""
    names = list(MODELS)
    pairs = np.array([outcome["level"][[names.index(model), names.index(JUDGE)]] for outcome in result[key]])

    def rms(levels: FloatArray) -> FloatArray:
        level, reference = levels.mean(axis=0)
        return np.asarray(np.sqrt(np.mean((POWER_DECIBEL * np.log(level / reference)) ** 2)))

    return jackknifed(rms, pairs)[0]


def work(result: Outcomes, key: Key, model: str) -> float:
    mean, names = np.mean([outcome["work"] for outcome in result[key]], axis=0), list(MODELS)
    return float(mean[names.index(model)] / mean[names.index(LINE)])


SHOWN = (LINE, LINEAR, READ, BED)
ON_CELLS = "boundary elements, {:g} cells per contact radius"
PRINTED = {COARSE: ON_CELLS.format(CELLS / 2), COARSEST: ON_CELLS.format(CELLS / 3)}
"""Labels count the cells of a side by parts of those to a contact radius; a quarter and a ninth of all cells."""
BY_MODEL = partial(Curve, by=("model",))
BY_SPECTRUM = partial(Curve, OWN_KEPT, by=("H", Q), bars=True)
in_octaves = partial(Claim, quantity=OFF, along=SLOPE, printed=decibels_rms)
STUDY = Study(
    title="Models of the wheel on a rough surface, beside boundary elements",
    method=(
        "A wheel rolls at a fixed approach over {c.strips} strips of each spectrum and slope, {c.waves} of the longest "
        "waves and {c.length:g} radii long at least, {c.cells} cells to a contact radius. Each model rolls over the "
        "same strips, on all cells but where its name says otherwise. Levels of the force are taken in octaves from "
        f"the longest wave on, over those of boundary elements. {SLOPE_COUNTS}. Errors of the sample are by the "
        "jackknife, and those of the grid a third of what half of the cells change. The share of contact kept is the "
        "mean area over that of a smooth wheel under the same force; cells at its edge may make it a little more than "
        "one. Work counts springs, cells read, and cells of every application of an operator, over that of springs on "
        "a line; it is not a time."
    ),
    series=series,
    claims=(
        in_octaves(model=LINEAR).saying(
            "Linear theory in three dimensions has the levels of boundary elements in octaves.",
            short="Linear theory in 3D agrees with boundary elements",
            key="linear-theory",
        ),
        in_octaves(model=COARSEST).saying(
            "Boundary elements on {c.coarsest} cells to a contact radius have the levels of those on {c.cells}.",
            short=f"Boundary elements on {CELLS // 3} cells per contact radius agree with those on {CELLS}",
            key="coarse-grid",
        ),
        Claim(quantity=KEPT, along=SLOPE).saying(
            "At one h' a/d the same part of the contact is lost, whatever h/d, the band and the Hurst exponent.",
            short="The share of contact kept at one h' a/d agrees with that of other spectra",
            key="lost-contact",
        ),
    ),
    charts=(
        Chart("reduced_models-map", claims=(0, 1)).of(
            "Root mean square over octaves of the level of the force over boundary elements, over h' a/d. Points: "
            "strips of all spectra, with 95 % intervals; lines: the largest up to there. Shaded: within 1 dB.",
            Panel(SLOPE, "rms over octaves [dB]", log="xy", shade=(1e-9, 1), ylim=(0.01, 20)).of(
                BY_MODEL(OFF, SHOWN, "marks", bars=True),
                Curve(OFF, COARSEST, "marks", PRINTED[COARSEST], bars=True),
                BY_MODEL(LARGEST, (*SHOWN, COARSEST), "lines", "_"),
            ),
        ),
        Chart("reduced_models", claims=(2,)).of(
            "Share of contact kept on boundary elements, by Hurst exponent and q a of the roughness, 95 %: (a) over "
            "h/d; (b) over h' a/d, where curves that lie on each other show that it decides. (c) Root mean square over "
            "octaves at the largest h' a/d, over counted work; line: 1 dB.",
            Panel(HEIGHT, KEPT, ylim=(0.4, 1.1)).of(BY_SPECTRUM()),
            Panel(SLOPE, KEPT, ylim=(0.4, 1.1)).of(BY_SPECTRUM(label="_")),
            Panel(WORK, "rms over octaves [dB]", title="error over work", log="xy", lines=(1.0,)).of(
                BY_MODEL(AT_WORK, SHOWN, "marks"),
                *(Curve(AT_WORK, model, "marks", label) for model, label in PRINTED.items()),
            ),
        ),
    ),
    matrices=(
        Matrix(
            name=OFF, quantity=OFF, rows=(SLOPE, "H", Q, HEIGHT), columns="model", printed=decibels_rms, named=PRINTED
        ),
        Matrix(name=KEPT, quantity=KEPT, rows=("H", Q), columns=SLOPE),
    ),
    printed=(TABLE_14_1,),
)
CASE = Case(
    name="reduced_models",
    chapter=Chapter.ROLLING,
    place=3,
    answers="How far models of the rolling wheel follow boundary elements: h' a/d decides, not h/d",
    quick=ReducedModels(strips=3),
    full=ReducedModels(
        spectra=((0.7, 1.0, 10.0), (0.4, 1.0, 10.0), (1.0, 1.0, 10.0), (0.7, 0.3, 5.0), (0.7, 2.0, 10.0)),
        slopes=(0.1, 0.2, 0.3, 0.5, 1.0),
        strips=10,
        waves=6,
        length=48,
        width=12,
    ),
    run=run,
    study=STUDY,
    needs="boundary elements",
)
