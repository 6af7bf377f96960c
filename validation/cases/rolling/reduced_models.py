"""Reduced models of the wheel and boundary elements on the same strips: which one follows, and what it costs."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np

from validation.analysis.case import Case, Chapter
from validation.analysis.chart import Chart, Curve, Panel
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import Number, Place
from validation.analysis.margins import REPEATABLE
from validation.analysis.series import Series
from validation.analysis.statistics import Estimate, FloatArray, jackknifed
from validation.analysis.study import Outcomes, Study
from validation.cases.rolling.settings import SLOPE, Q, decibels, rms_decibels
from validation.engine.engine import SERIAL, Engine
from validation.simulation import reduced_strip
from validation.simulation.reduced_models import TOLERANCE
from validation.simulation.reduced_strip import COARSE_LAYER, JUDGE, LAYER, LINE, LINEAR, MODELS, READ
from validation.simulation.rolling_strip import RoughStrip, Strip
from validation.simulation.track_spectrum import self_affine
from validation.theory.rolling import slope_in_one_direction

__all__ = ["CASE", "COARSE_LAYER", "JUDGE", "LAYER", "OFF", "READ", "SLOPE", "WORK", "Q"]


@dataclass(frozen=True, kw_only=True)
class ReducedModels:
    """A wheel at the approach d, contact radius a, over strips of several spectra and heights.

    spectra: Hurst exponent, q a of the longest and of the shortest wave; heights: rms over d, ascending; strips:
    realisations; waves: of the longest on the length of a strip; width: over a, in waves at least one; cells: to a
    contact radius, divisible by six; seed: zero or positive.
    """

    spectra: tuple[tuple[float, float, float], ...] = ((0.7, 1.0, 10.0),)
    heights: tuple[float, ...] = (0.1, 0.3)
    strips: int = 6
    waves: int = 4
    width: int = 8
    cells: int = 12
    seed: int = 20

    def __post_init__(self) -> None:
        slope = self_affine(*self.spectra[0]).slope_along
        low, high = (height * slope for height in (self.heights[0], self.heights[-1]))
        if low > 0.21 or not high > 0.35:
            raise ValueError(f"heights must reach from h' a/d = 0.21 to 0.35 at the least, got {low:.3g} to {high:.3g}")
        if self.cells % 6:
            raise ValueError(f"cells must be a multiple of 6, got {self.cells}")

    def strips_of(self, spectrum: tuple[float, float, float], height: float) -> list[Strip]:
        longest = 2 * math.pi / spectrum[1]
        scene = RoughStrip(
            spectrum=self_affine(*spectrum),
            height=height,
            length=math.ceil(self.waves * longest),
            width=max(self.width, math.ceil(longest)),
            seed=self.seed,
        )
        return scene.strips(self.cells, TOLERANCE * height, self.strips)


Key = tuple[tuple[float, float, float], float]
"""Spectrum, and h/d."""


def run(case: ReducedModels, engine: Engine = SERIAL) -> Outcomes:
    groups = {key: case.strips_of(*key) for key in product(case.spectra, case.heights)}
    found = engine.map_groups(reduced_strip.roll_by_all, groups)
    unconverged = tuple(
        f"strip {i}, h/d = {key[1]:g}: {int(outcome['failed'])} models with a contact that did not converge"
        for key, outcomes in found.items()
        for i, outcome in enumerate(outcomes)
        if outcome["failed"]
    )
    return Outcomes(case, found, unconverged)


OFF = "rms over octaves of the level over boundary elements"
LARGEST = "largest rms over octaves of all strips as smooth"
OCTAVES, LEVEL = "level of octaves over boundary elements", "level of one-third octaves over boundary elements"
COHERENCE, SHARED = "coherence", "coherence, mean of one-third octaves"
FORCE, WORK, AT_WORK = "mean force over bem3d", "work over springs on a line", "rms over octaves beside work"
LIMIT, LIMIT_OF_READ = slope_in_one_direction(1.0), slope_in_one_direction(0.3)
"""h' a/d up to which two models are claimed to follow, where the rms gradient g a/d is 1 and 0.3."""
SLACK = 1.15
"""By which h' a/d may lie above a limit."""
GRID = 1 / 3
"""Error of a grid over its change to half of the cells, of second order."""


def series(result: Outcomes) -> list[Series]:
    """Of each model over all strips, the smoothest first; in bands and over its work where h' a/d is nearest LIMIT."""
    keys = sorted(result.found, key=slope_of)
    nearest = min(keys, key=lambda key: abs(math.log(slope_of(key) / LIMIT)))
    found: list[Series] = []
    for model in MODELS:
        for key in keys:
            found += _of_strips(result, key, model)
        rms = np.maximum.accumulate([off(result, key, model).value for key in keys])
        found.append(Series(LARGEST, model, rms, along=SLOPE, at=list(map(slope_of, keys))))
        found += _in_bands(result, nearest, model)
    return found


def _of_strips(result: Outcomes, key: Key, model: str) -> Iterator[Series]:
    (hurst, *ends), height = key
    where: dict[str, Place] = {"H": hurst, Q: (ends[0], ends[1]), "h/d": height, SLOPE: float(f"{slope_of(key):.3g}")}
    in_octaves = decibels(octaves(_pairs(result, key, model)))
    single = partial(Series, model=model, where=where)
    yield single(
        OFF,
        found=(off(result, key, model),),
        grid=GRID * off(result, key, reduced_strip.COARSE).value,
        unit="dB",
        margin=REPEATABLE.beside("boundary elements on the same strips") if model != JUDGE else None,
    )
    yield single(OCTAVES, found=in_octaves, along=Q, at=[ends[0] * 2 ** (k + 0.5) for k in range(in_octaves.size)])
    yield single(SHARED, found=(coherence(result, key, model).mean(),))
    yield single(FORCE, found=(_mean_over(result, key, "mean", model, JUDGE),))
    yield single(WORK, found=(_mean_over(result, key, "work", model, LINE),))


def _in_bands(result: Outcomes, key: Key, model: str) -> Iterator[Series]:
    where = {SLOPE: slope_of(key)}
    along_q = partial(Series, where=where, along=Q, at=reduced_strip.bands_of(self_affine(*key[0])).centres)
    yield along_q(LEVEL, model, jackknifed(decibels, _pairs(result, key, model)), unit="dB")
    yield along_q(COHERENCE, model, coherence(result, key, model))
    if model != JUDGE:
        work = _mean_over(result, key, "work", model, LINE)
        yield Series(AT_WORK, model, (off(result, key, model),), where=where, along=WORK, at=(work,), unit="dB")


def slope_of(key: Key) -> float:
    """h' a/d, along the track, of all waves."""
    spectrum, height = key
    return height * self_affine(*spectrum).slope_along


def octaves(level: FloatArray) -> FloatArray:
    return np.asarray(level.reshape(*level.shape[:-1], -1, 3).sum(axis=-1))


def off(result: Outcomes, key: Key, model: str) -> Estimate:
    return rms_decibels(octaves(_pairs(result, key, model)))


def _pairs(result: Outcomes, key: Key, model: str) -> FloatArray:
    """Levels in one-third octaves of a model and of boundary elements, (strips, 2, bands)."""
    names = list(MODELS)
    return np.array([one["level"][[names.index(model), names.index(JUDGE)]] for one in result[key]])


def coherence(result: Outcomes, key: Key, model: str) -> FloatArray:
    """|sum of cross levels|^2 over both levels, of all strips, in one-third octaves."""
    place = list(MODELS).index(model)
    real, imaginary = np.sum([one["cross"][:, place] for one in result[key]], axis=0)
    mine, other = _pairs(result, key, model).sum(axis=0)
    return np.asarray((real**2 + imaginary**2) / (mine * other))


def _mean_over(result: Outcomes, key: Key, name: str, model: str, other: str) -> float:
    mean, names = np.mean([one[name] for one in result[key]], axis=0), list(MODELS)
    return float(mean[names.index(model)] / mean[names.index(other)])


class AtTheLimit(Claim):
    """Of all strips about as rough as the roughest up to the limit: no strip is chosen."""

    def numbers(self, numbers: Sequence[Number]) -> list[Number]:
        mine = super().numbers(numbers)
        slopes = [float(str(number.where[SLOPE])) for number in mine]
        return [number for number, slope in zip(mine, slopes, strict=True) if slope >= max(slopes) / SLACK]


def _up_to(limit: float) -> dict[str, object]:
    return {SLOPE: lambda slope: slope <= SLACK * limit}


SHOWN = (LINE, LINEAR, READ, reduced_strip.BED, LAYER, reduced_strip.COARSEST)
"""As curves; all models have a point over their work."""
TRIALS = tuple(model for model in MODELS if model not in (*SHOWN, JUDGE))
BY_MODEL = partial(Curve, by=("model",))
in_octaves = partial(Claim, quantity=OFF)
STUDY = Study(
    title="Reduced models of the wheel on a rough surface, beside boundary elements",
    method=(
        "A wheel rolls at a fixed approach over {c.strips} strips of each spectrum and height, {c.waves} of the "
        "longest waves long, {c.cells} cells to a contact radius. Each model rolls over the same strips. Levels of the "
        "force are taken in octaves from the longest wave on, over those of boundary elements. h' is the rms slope "
        "along the track, in one direction, of all waves. Errors of the sample are by the jackknife, and those of the "
        "grid a third of what half of the cells change. Work counts springs, cells read, and cells of every "
        "application of an operator, over that of springs on a line; it is not a time."
    ),
    series=series,
    claims=(
        in_octaves(model=LAYER, where=_up_to(LIMIT)).saying(
            "In octaves a rough layer that is pressed flat beforehand follows boundary elements within 1 dB up to "
            f"h' a/d of {LIMIT:.2g}.",
            short=f"Pressed layer beside boundary elements up to h' a/d = {LIMIT:.2g}",
        ),
        in_octaves(model=READ, where=_up_to(LIMIT_OF_READ)).saying(
            "In octaves springs that read the surface follow boundary elements within 1 dB up to h' a/d of "
            f"{LIMIT_OF_READ:.2g}.",
            short=f"springs that read the surface up to {LIMIT_OF_READ:.2g}",
        ),
        AtTheLimit(
            quantity=OFF, model=(LINEAR, LINE, READ, reduced_strip.BED), where=_up_to(LIMIT), differ=True
        ).saying(
            f"At h' a/d of {LIMIT:.2g}, linear theory, springs and the bed of the field are more than 1 dB off "
            "boundary elements in octaves.",
            short=f"linear theory, springs and the bed at {LIMIT:.2g}",
        ),
        in_octaves(model=reduced_strip.COARSEST, where=_up_to(LIMIT)).saying(
            "In octaves boundary elements on a third of the cells follow those on all within 1 dB up to h' a/d of "
            f"{LIMIT:.2g}."
        ),
    ),
    charts=(
        Chart("reduced_models-map", claims=(0, 1, 2), width=9.0, height=4.6).of(
            "Root mean square over octaves of the level of the force over boundary elements, over h' a/d. Points: "
            "strips of all spectra, with 95 % intervals; lines: the largest up to there. Shaded: within 1 dB.",
            Panel(SLOPE, "rms over octaves [dB]", log="xy", shade=(1e-9, 1), ylim=(0.01, 20)).of(
                BY_MODEL(OFF, SHOWN, "marks", bars=True), BY_MODEL(LARGEST, SHOWN, "lines", "_")
            ),
        ),
        Chart("reduced_models", claims=(0, 1), height=4.6).of(
            f"At the h' a/d nearest to {LIMIT:.2g}: (a) level over boundary elements in one-third octaves, 95 %; (b) "
            "coherence; (c) root mean square over octaves, over counted work; line: 1 dB; open: trials.",
            Panel(Q, "level over boundary elements [dB]", title="in one-third octaves", lines=(0.0,)).of(
                BY_MODEL(LEVEL, SHOWN, bars=True)
            ),
            Panel(Q, COHERENCE, title="position by position", ylim=(0, 1.02)).of(BY_MODEL(COHERENCE, SHOWN)),
            Panel(WORK, "rms over octaves [dB]", title="error over work", log="xy", lines=(1.0,)).of(
                BY_MODEL(AT_WORK, SHOWN, "marks"), BY_MODEL(AT_WORK, TRIALS, "open marks")
            ),
        ),
    ),
    matrices=(Matrix(name=OFF, quantity=OFF, rows=("H", Q, "h/d", SLOPE), columns="model"),),
)
CASE = Case(
    name="reduced_models",
    chapter=Chapter.ROLLING,
    place=7,
    answers="Reduced models of the rolling wheel: which one follows boundary elements as contact is lost",
    quick=ReducedModels(strips=3),
    full=ReducedModels(
        spectra=((0.7, 1.0, 10.0), (0.4, 1.0, 10.0), (0.7, 0.3, 5.0), (0.4, 0.3, 5.0)),
        heights=(0.03, 0.1, 0.3, 1.0),
        width=12,
    ),
    run=run,
    study=STUDY,
    needs="boundary elements",
)
