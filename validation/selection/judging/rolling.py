"""A rolling model of others beside boundary elements: levels, variance and mean of the force, and each position."""

import math
from collections.abc import Iterator
from functools import cache

import numpy as np

from validation.analysis.judgement import JudgedPoint, compared
from validation.analysis.series import Estimates
from validation.analysis.spectra import levels, waves
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, mean_estimate
from validation.engine.offered import Caller, Failed
from validation.selection.judging.references import about, curve
from validation.selection.judging.spectra import (
    APPROACH,
    CONTACT,
    FORCE,
    HEIGHT,
    LEVEL,
    MEAN,
    NOTHING,
    RMS,
    SMOOTH_WHEEL,
    Levels,
    bands_of,
    beside,
    heights,
    octaves,
    spectrum_of,
    unanswered,
    variance_of,
)
from validation.simulation.rolling_strip import HERTZ, SMOOTH, RoughStrip, crop_to_reach, level_3d
from validation.simulation.track_spectrum import self_affine
from validation.theory.rolling import linear_force

EACH, LIFT = "force at a position", "approach at a position"
APART, OF_APART = "{}, position by position", "rms of the fluctuation, and that with the rms of the difference on top"
STRIPS, LENGTH, WIDTH, CELLS = 6, 64.0, 16.0, 16
"""On which levels are taken, as ratios to linear theory on the same strips."""
HEIGHTS, GRIDS, ALONG, ACROSS, SEED = (0.03, 0.1, 0.3), (8, 24), 32.0, 16.0, 351
"""Of the strips for each position: h/d; cells to a contact radius, an odd ratio, so that centres meet; sides over a."""


def strip_of(height: float) -> RoughStrip:
    """For each position, of rms height h/d."""
    return RoughStrip(spectrum=self_affine(0.7, 1.0, 10.0), height=height, length=ALONG, width=ACROSS, seed=SEED)


def judged(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """Position by position on short strips; at a given approach levels, variance and mean on strips of the case too."""
    for height in HEIGHTS:
        yield _position_by_position(model, height, tolerance)
    if "approach" in model.asks:
        for height in heights():
            yield from beside((LEVEL, RMS, MEAN), height, _of_strips(model, height), tolerance)


def _position_by_position(model: Caller, height: float, tolerance: float) -> JudgedPoint:
    """The rms of what boundary elements fluctuate beside the same with the rms of what is apart added."""
    under_load, cells = "approach" not in model.asks, GRIDS[1]
    rows = [one for one in curve(LIFT if under_load else EACH) if one.where[HEIGHT] == height]
    known = np.array([one.value for one in rows])
    grid, fluctuation = known * [one.grid for one in rows], float(known.std())
    quantity, where = APART.format("approach" if under_load else "force"), {HEIGHT: height}
    found = _rolled(model, strip_of(height).surface(cells, 0), cells)
    if isinstance(found, Failed):
        return unanswered(quantity, where, found, fluctuation)
    times = cells // GRIDS[0]
    apart, left = (
        math.sqrt(float(np.mean(one**2)))
        for one in (found[times // 2 :: times] / (APPROACH if under_load else FORCE) - known, grid)
    )
    value = fluctuation + apart
    return compared(quantity, where, value, fluctuation, left / value, tolerance, reason=OF_APART)


def _of_strips(model: Caller, height: float) -> Levels | Failed:
    """Over linear theory on the half-space on the same strips, so that most of the scatter drops out."""
    settings, rows = about(LEVEL)["settings"], []
    spectrum, bands = spectrum_of(settings), bands_of(settings)
    for surface, linear in _strips():
        found = _rolled(model, height * surface, CELLS)
        if isinstance(found, Failed):
            return found
        both = np.stack([found / FORCE, height * linear])
        thirds = levels(waves(both, spacing=1 / CELLS), bands)
        rows.append(np.column_stack([octaves(thirds), both.var(axis=1), both.mean(axis=1)]))
    mine, of_linear = np.maximum(np.moveaxis(np.array(rows), 1, 0), NOTHING)
    exact = [*octaves(level_3d(spectrum, bands)), variance_of(spectrum)]
    over = Estimates.ratios(mine[:, :-1], of_linear[:, :-1])
    # over (h/d)^2, as linear theory is
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


def _rolled(model: Caller, surface: FloatArray, cells: int) -> FloatArray | Failed:
    """What a model makes of a strip in units of a and d, in metres."""
    spacing = CONTACT / cells
    given = {
        "height": APPROACH * crop_to_reach(surface, 1 / cells),
        "line": APPROACH * middle_line(surface),
        "spacing": (spacing, spacing),
    }
    return model.call(**given, **SMOOTH_WHEEL)


def middle_line(surface: FloatArray) -> FloatArray:
    """Of a periodic surface, along the middle of axis 1, which may lie between cells."""
    ny = surface.shape[1]
    turn = np.exp(2j * np.pi * np.fft.fftfreq(ny) * (ny - 1) / 2)
    return np.asarray((np.fft.fft(surface, axis=1) @ turn / ny).real)
