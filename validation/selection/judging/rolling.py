"""A force spectrum and a rolling model of others beside boundary elements: levels, variance, mean, each position.

Wheels here have a contact radius of 2 mm; all is compared over the force of Hertz, so that no scale matters.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import mdr
from validation.analysis.judgement import FAILED, JudgedPoint, compared, compared_levels, not_compared
from validation.analysis.series import Estimates
from validation.analysis.spectra import Bands, levels, waves
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, mean_estimate
from validation.engine.offered import Caller, Failed
from validation.selection.judging.references import about, curve
from validation.simulation.rolling_strip import HERTZ, SMOOTH, RoughStrip, crop_to_reach, level_3d, over_bands
from validation.simulation.track_spectrum import PiecewisePowerLaw, self_affine
from validation.theory.rolling import force_variance, linear_force

LEVEL, RMS, MEAN = "force level", "rms force", "mean force"
EACH, LIFT = "force at a position", "approach at a position"
APART, OF_APART = "{}, position by position", "one plus the rms of the difference over the rms of the fluctuation"
HEIGHT, SLOPE, Q = "h/d", "h' a/d", "q a"
RADIUS, CONTACT, MODULUS = 0.5, 2e-3, 1.15e11
APPROACH = CONTACT**2 / RADIUS
FORCE = 4 / 3 * MODULUS * CONTACT * APPROACH
SMOOTH_WHEEL = {"radius": RADIUS, "modulus": MODULUS, "approach": APPROACH, "load": FORCE}
NOTHING = 1e-30
FINE = 800
"""Of the midpoint rule from zero to the end of the roughness."""
STRIPS, LENGTH, WIDTH, CELLS = 6, 64.0, 16.0, 16
"""On which levels of a rolling model are taken, as ratios to linear theory on the same strips."""
HEIGHTS, GRIDS, ALONG, ACROSS, SEED = (0.03, 0.1, 0.3), (8, 24), 32.0, 16.0, 351
"""Of the strips for each position: h/d; cells to a contact radius, an odd ratio, so that centres meet; sides over a."""


def spectrum_of(settings: Mapping[str, Any]) -> PiecewisePowerLaw:
    return self_affine(settings["hurst"], settings["first"], settings["last"])


def bands_of(settings: Mapping[str, Any]) -> Bands:
    return Bands.around(math.pi, settings["lowest"], settings["last"]).on(settings["length"])


def strip_of(height: float) -> RoughStrip:
    """For each position, of rms height h/d."""
    return RoughStrip(spectrum=self_affine(0.7, 1.0, 10.0), height=height, length=ALONG, width=ACROSS, seed=SEED)


Density = Callable[[FloatArray, mdr.SelfAffine], FloatArray | Failed]
"""Two-sided C_F(q, roughness) of the force [N^2 m]."""
Levels = Mapping[str, Sequence[Estimate]]
"""Of octaves and of the whole force [dB over F_Hertz^2 (h/d)^2], and its mean [F_Hertz]."""


def judged_spectrum(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """Octaves of the force along the track over q a and h' a/d, and its variance."""

    def density(q: FloatArray, ground: mdr.SelfAffine) -> FloatArray | Failed:
        return model.call(q=q, roughness=ground, contact_radius=CONTACT, **SMOOTH_WHEEL)

    yield from judged_density(density, tolerance)


def judged_density(density: Density, tolerance: float) -> Iterator[JudgedPoint]:
    for height in _heights():
        yield from _beside(height, _of_density(density, height), tolerance)


def _heights() -> list[float]:
    return list(dict.fromkeys(float(one.where[HEIGHT]) for one in curve(LEVEL)))


def _of_density(density: Density, height: float) -> Levels | Failed:
    """By quadrature in each third of an octave, and over all q for the variance."""
    settings = about(LEVEL)["settings"]
    bands, last = bands_of(settings), settings["last"]
    first = {"q_min": settings["first"] / CONTACT, "q_max": last / CONTACT, "hurst": settings["hurst"]}
    asked: list[FloatArray] = []
    over_bands(lambda q: asked.append(q) or q, bands)
    whole = (np.arange(FINE) + 0.5) * last / FINE
    q = np.concatenate([asked[0].ravel(), whole])
    found = density(q / CONTACT, mdr.SelfAffine(**first, rms=height * APPROACH))
    if isinstance(found, Failed):
        return found
    of_bands, rest = np.split(found / CONTACT / (FORCE * height) ** 2, [asked[0].size])
    thirds = over_bands(lambda q: of_bands.reshape(q.shape), bands)
    power = [*_octaves(thirds), 2 * rest.sum() * last / FINE]
    return {LEVEL: Estimates.exact(_decibel(power[:-1])), RMS: Estimates.exact(_decibel(power[-1:]))}


def _octaves(thirds: FloatArray) -> FloatArray:
    """Of levels in thirds of octaves, (..., bands), those of the octaves that are known."""
    bands = bands_of(about(LEVEL)["settings"])
    middle = [
        int(np.argmin(np.abs(np.log(bands.centres / q)))) for q in dict.fromkeys(one.where[Q] for one in curve(LEVEL))
    ]
    return np.stack([thirds[..., i - 1 : i + 2].sum(axis=-1) for i in middle], axis=-1)


def _decibel(power: ArrayLike) -> FloatArray:
    """Of less than nothing, which a quadrature of noise may give, as of nothing."""
    return np.asarray(POWER_DECIBEL * np.log(np.maximum(power, NOTHING)))


def _beside(height: float, found: Levels | Failed, tolerance: float) -> Iterator[JudgedPoint]:
    """Octaves, rms and mean."""
    for quantity in (LEVEL, RMS, MEAN) if isinstance(found, Failed) else found:
        for i, known in enumerate(one for one in curve(quantity) if one.where[HEIGHT] == height):
            where, unit = (
                {n: place for n, place in known.where.items() if n != HEIGHT},
                "-" if quantity == MEAN else "dB",
            )
            if isinstance(found, Failed):
                yield not_compared(
                    quantity, where, FAILED, found.reason, reference=known.value, unit="-" if quantity == MEAN else "dB"
                )
                continue
            mine, beside = found[quantity][i], compared if quantity == MEAN else compared_levels
            half = mine.half_width / (mine.value if quantity == MEAN else 1.0)
            yield beside(
                quantity, where, mine.value, known.value, known.grid + math.hypot(known.sample, half), tolerance
            )


def judged_model(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """Position by position on short strips; at a given approach levels, variance and mean on strips of the case too."""
    for height in HEIGHTS:
        yield _position_by_position(model, height, tolerance)
    if "approach" in model.asks:
        for height in _heights():
            yield from _beside(height, _of_strips(model, height), tolerance)


def _position_by_position(model: Caller, height: float, tolerance: float) -> JudgedPoint:
    """One plus the rms of what is apart, over the rms of what boundary elements fluctuate."""
    under_load, cells = "approach" not in model.asks, GRIDS[1]
    rows = [one for one in curve(LIFT if under_load else EACH) if one.where[HEIGHT] == height]
    known, grid = (
        np.array(values) for values in zip(*((one.value, one.value * one.grid) for one in rows), strict=True)
    )
    quantity, where = APART.format("approach" if under_load else "force"), {HEIGHT: height}
    found = _rolled(model, strip_of(height).surface(cells, 0), cells)
    if isinstance(found, Failed):
        return not_compared(quantity, where, FAILED, found.reason, reference=1.0)
    times = cells // GRIDS[0]
    apart = found[times // 2 :: times] / (APPROACH if under_load else FORCE) - known
    ratio, left = (_rms(one) / float(known.std()) for one in (apart, grid))
    return compared(quantity, where, 1 + ratio, 1.0, left / (1 + ratio), tolerance, reason=OF_APART)


def _rms(values: FloatArray) -> float:
    return math.sqrt(float(np.mean(values**2)))


def _of_strips(model: Caller, height: float) -> Levels | Failed:
    """Over linear theory on the half-space on the same strips, so that most of the scatter drops out."""
    settings = about(LEVEL)["settings"]
    spectrum, bands, rows = spectrum_of(settings), bands_of(settings), []
    for surface, linear in _strips():
        found = _rolled(model, height * surface, CELLS)
        if isinstance(found, Failed):
            return found
        both = np.stack([found / FORCE, height * linear])
        thirds = levels(waves(both, spacing=1 / CELLS), bands)
        rows.append(np.column_stack([_octaves(thirds), both.var(axis=1), both.mean(axis=1)]))
    mine, of_linear = np.maximum(np.moveaxis(np.array(rows), 1, 0), NOTHING)
    exact = [*_octaves(level_3d(spectrum, bands)), variance_of(spectrum)]
    over = Estimates.ratios(mine[:, :-1], of_linear[:, :-1])
    in_decibels = [
        Estimate(POWER_DECIBEL * (one.value + math.log(of)), POWER_DECIBEL * one.error, one.samples)
        for one, of in zip(over, exact, strict=True)
    ]
    return {LEVEL: in_decibels[:-1], RMS: in_decibels[-1:], MEAN: [mean_estimate(mine[:, -1])]}


@cache
def _strips() -> list[tuple[FloatArray, FloatArray]]:
    """Surfaces of unit height, over d, and what linear theory adds to the force of Hertz there."""
    settings = about(LEVEL)["settings"]
    unit = RoughStrip(spectrum=spectrum_of(settings), height=1.0, length=LENGTH, width=WIDTH, seed=settings["seed"])
    surfaces = [unit.surface(CELLS, realisation) for realisation in range(STRIPS)]
    return [(one, linear_force(one, spacing=1 / CELLS, **SMOOTH) / HERTZ - 1) for one in surfaces]


def variance_of(spectrum: PiecewisePowerLaw) -> float:
    """Of linear theory, over F_Hertz^2 (h/d)^2; Geike's rule keeps it."""
    return force_variance(spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0) / HERTZ**2


def _rolled(model: Caller, surface: FloatArray, cells: int) -> FloatArray | Failed:
    """What a model makes of a strip in units of a and d, in metres."""
    seen, spacing = crop_to_reach(surface, 1 / cells), CONTACT / cells
    given = {"height": APPROACH * seen, "line": APPROACH * middle_line(surface), "spacing": (spacing, spacing)}
    return model.call(**given, **SMOOTH_WHEEL)


def middle_line(surface: FloatArray) -> FloatArray:
    """Of a periodic surface, along the middle of axis 1, which may lie between cells."""
    ny = surface.shape[1]
    turn = np.exp(2j * np.pi * np.fft.fftfreq(ny) * (ny - 1) / 2)
    return np.asarray((np.fft.fft(surface, axis=1) @ turn / ny).real)
