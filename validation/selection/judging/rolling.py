"""The force of a wheel that rolls, of others, beside boundary elements: its spectrum, or its value at each position.

Wheels here have a contact radius of 2 mm; all is compared over the force of Hertz, so that no scale matters.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np

import mdr
from validation.analysis.judgement import LEVEL as DECIBELS
from validation.analysis.judgement import RATIO
from validation.analysis.series import Estimates
from validation.analysis.spectra import Bands, levels, waves
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray, mean_estimate
from validation.engine.offered import Caller, Failed
from validation.selection.judging.judge import Finding, ModelAnswer, asked, attempted, beside
from validation.selection.judging.references import Reference, about, known
from validation.simulation.rolling_strip import HERTZ, SMOOTH, RoughStrip, crop_to_reach, level_3d, over_bands
from validation.simulation.track_spectrum import PiecewisePowerLaw, self_affine
from validation.theory.rolling import force_variance, linear_force

LEVEL, RMS, MEAN = "force level", "rms force", "mean force"
HEIGHT, SLOPE, Q = "h/d", "h' a/d", "q a"
RADIUS, CONTACT, MODULUS = 0.5, 2e-3, 1.15e11
APPROACH = CONTACT**2 / RADIUS
FORCE = 4 / 3 * MODULUS * CONTACT * APPROACH
SMOOTH_WHEEL = {"radius": RADIUS, "modulus": MODULUS, "approach": APPROACH, "load": FORCE}
FINE = 800
"""Of the midpoint rule from zero to the end of the roughness."""
NOTHING = 1e-30
"""Power that has a logarithm; less than nothing is as nothing."""
EACH, LIFT = "force at a position", "approach at a position"
APART, OF_APART = "{}, position by position", "rms of the fluctuation, and that with the rms of the difference on top"
STRIPS, LENGTH, WIDTH, CELLS = 6, 64.0, 16.0, 16
"""On which levels are taken, as ratios to linear theory on the same strips."""
HEIGHTS, GRIDS, ALONG, ACROSS, SEED = (0.03, 0.1, 0.3), (8, 24), 32.0, 16.0, 351
"""Of the strips for each position: h/d; cells to a contact radius, an odd ratio, so that centres meet; sides over a."""

Density = Callable[[FloatArray, mdr.SelfAffine], FloatArray]
"""Two-sided C_F(q, roughness) of the force [N^2 m]."""


def judged(model: Caller) -> Iterator[Finding]:
    """Position by position on short strips; at a given approach levels, variance and mean on strips of the case too."""
    for height in HEIGHTS:
        yield _position_by_position(model, height)
    if "approach" in model.asks:
        yield from _at_heights((LEVEL, RMS, MEAN), partial(_of_strips, model))


def judged_spectrum(model: Caller) -> Iterator[Finding]:
    """Octaves of the force along the track, and its variance."""
    return of_density(lambda q, ground: asked(model, q=q, roughness=ground, contact_radius=CONTACT, **SMOOTH_WHEEL))


def of_density(density: Density) -> Iterator[Finding]:
    return _at_heights((LEVEL, RMS), partial(_of_density, density))


def _at_heights(quantities: Sequence[str], find: Callable[[float], Iterable[ModelAnswer | float]]) -> Iterator[Finding]:
    """At each h/d of the case all that is known of each quantity, in the order of what is found."""
    for height in dict.fromkeys(row[HEIGHT] for row in known(LEVEL)):
        rows = known(*quantities, where={HEIGHT: height})
        there = [replace(row, where={n: place for n, place in row.where.items() if n != HEIGHT}) for row in rows]
        yield from beside(there, attempted(find, height))


def spectrum_of(settings: Mapping[str, Any]) -> PiecewisePowerLaw:
    """The roughness of the case, of unit height and contact radius."""
    return self_affine(settings["hurst"], settings["first"], settings["last"])


def bands_of(settings: Mapping[str, Any]) -> Bands:
    return Bands.around(math.pi, settings["lowest"], settings["last"]).on(settings["length"])


def variance_of(spectrum: PiecewisePowerLaw) -> float:
    """Of linear theory, over F_Hertz^2 (h/d)^2; Geike's rule keeps it."""
    return force_variance(spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0) / HERTZ**2


def octave(thirds: FloatArray, bands: Bands, q: float) -> FloatArray:
    """Of levels in thirds of octaves, (..., bands), the octave about q."""
    i = int(np.argmin(np.abs(np.log(bands.centres / q))))
    return np.asarray(thirds[..., i - 1 : i + 2].sum(axis=-1))


def _octaves(thirds: FloatArray) -> FloatArray:
    """Those that are known."""
    bands = bands_of(about(LEVEL)["settings"])
    return np.stack([octave(thirds, bands, q) for q in dict.fromkeys(row[Q] for row in known(LEVEL))], axis=-1)


def _of_density(density: Density, height: float) -> FloatArray:
    """Octaves and variance by quadrature [dB over F_Hertz^2 (h/d)^2]."""
    settings = about(LEVEL)["settings"]
    first, last = settings["first"], settings["last"]
    ground = mdr.SelfAffine(hurst=settings["hurst"], q_min=first / CONTACT, q_max=last / CONTACT, rms=height * APPROACH)

    def power(q: FloatArray) -> FloatArray:
        return density(q.ravel() / CONTACT, ground).reshape(q.shape) / CONTACT / (FORCE * height) ** 2

    octaves = _octaves(over_bands(power, bands_of(settings)))
    variance = 2 * power((np.arange(FINE) + 0.5) * last / FINE).sum() * last / FINE
    return np.asarray(POWER_DECIBEL * np.log(np.maximum([*octaves, variance], NOTHING)))


def _of_strips(model: Caller, height: float) -> list[ModelAnswer]:
    """Octaves and variance over linear theory on the same strips, so that most of the scatter drops out; the mean."""
    settings, rows = about(LEVEL)["settings"], []
    spectrum, bands = spectrum_of(settings), bands_of(settings)
    for surface, linear in _strips():
        both = np.stack([_rolled(model, height * surface, CELLS) / FORCE, height * linear])
        thirds = levels(waves(both, spacing=1 / CELLS), bands)
        rows.append(np.column_stack([_octaves(thirds), both.var(axis=1), both.mean(axis=1)]))
    mine, of_linear = np.maximum(np.moveaxis(np.array(rows), 1, 0), NOTHING)
    # over (h/d)^2, as linear theory is
    exact = Estimates.exact(np.log([*_octaves(level_3d(spectrum, bands)), variance_of(spectrum)]))
    over = Estimates.ratios(mine[:, :-1], of_linear[:, :-1]) + exact
    decibels = (Estimate(POWER_DECIBEL * one.value, POWER_DECIBEL * one.error, one.samples) for one in over)
    return [*(ModelAnswer.of(one, DECIBELS) for one in decibels), ModelAnswer.of(mean_estimate(mine[:, -1]), RATIO)]


@cache
def _strips() -> list[tuple[FloatArray, FloatArray]]:
    """Surfaces of unit height, over d, and what linear theory adds to the force of Hertz there."""
    settings = about(LEVEL)["settings"]
    unit = RoughStrip(spectrum=spectrum_of(settings), height=1.0, length=LENGTH, width=WIDTH, seed=settings["seed"])
    surfaces = [unit.surface(CELLS, realisation) for realisation in range(STRIPS)]
    return [(one, linear_force(one, spacing=1 / CELLS, **SMOOTH) / HERTZ - 1) for one in surfaces]


def strip_of(height: float) -> RoughStrip:
    """For each position, of rms height h/d."""
    return RoughStrip(spectrum=self_affine(0.7, 1.0, 10.0), height=height, length=ALONG, width=ACROSS, seed=SEED)


def _position_by_position(model: Caller, height: float) -> Finding:
    """The rms of what boundary elements fluctuate beside the same with the rms of what is apart added."""
    quantity, unit, name = (EACH, FORCE, "force") if "approach" in model.asks else (LIFT, APPROACH, "approach")
    rows = known(quantity, where={HEIGHT: height})
    values, grid = np.array([(row.value, row.value * row.grid) for row in rows]).T
    cells, times = GRIDS[1], GRIDS[1] // GRIDS[0]
    found = attempted(_rolled, model, strip_of(height).surface(cells, 0), cells)
    fluctuation = Reference({HEIGHT: height}, float(values.std()), quantity=APART.format(name))
    if isinstance(found, Failed):
        return Finding(fluctuation, found)
    apart = found[times // 2 :: times] / unit - values
    value = fluctuation.value + math.sqrt(np.mean(apart**2))
    left = math.sqrt(np.mean(grid**2)) / value
    return Finding(replace(fluctuation, grid=left), ModelAnswer(value, reason=OF_APART))


def _rolled(model: Caller, surface: FloatArray, cells: int) -> FloatArray:
    """What a model makes of a strip in units of a and d, in metres."""
    height, line = APPROACH * crop_to_reach(surface, 1 / cells), APPROACH * middle_line(surface)
    return asked(model, height=height, line=line, spacing=(CONTACT / cells,) * 2, **SMOOTH_WHEEL)


def middle_line(surface: FloatArray) -> FloatArray:
    """Of a periodic surface, along the middle of axis 1, which may lie between cells."""
    ny = surface.shape[1]
    turn = np.exp(2j * np.pi * np.fft.fftfreq(ny) * (ny - 1) / 2)
    return np.asarray((np.fft.fft(surface, axis=1) @ turn / ny).real)
