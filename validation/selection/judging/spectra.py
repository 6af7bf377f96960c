"""A spectrum of the rolling force of others beside boundary elements: levels of octaves over q a and h' a/d, variance.

Wheels here have a contact radius of 2 mm; all is compared over the force of Hertz, so that no scale matters.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import mdr
from validation.analysis.judgement import FAILED, REFUSED, JudgedPoint, compared, compared_levels, not_compared
from validation.analysis.series import Estimates
from validation.analysis.spectra import Bands
from validation.analysis.statistics import POWER_DECIBEL, Estimate, FloatArray
from validation.engine.offered import Caller, Failed
from validation.selection.judging.references import Place, about, curve
from validation.simulation.rolling_strip import HERTZ, over_bands
from validation.simulation.track_spectrum import PiecewisePowerLaw, self_affine
from validation.theory.rolling import force_variance

LEVEL, RMS, MEAN = "force level", "rms force", "mean force"
HEIGHT, SLOPE, Q = "h/d", "h' a/d", "q a"
RADIUS, CONTACT, MODULUS = 0.5, 2e-3, 1.15e11
APPROACH = CONTACT**2 / RADIUS
FORCE = 4 / 3 * MODULUS * CONTACT * APPROACH
SMOOTH_WHEEL = {"radius": RADIUS, "modulus": MODULUS, "approach": APPROACH, "load": FORCE}
FINE = 800
"""Of the midpoint rule from zero to the end of the roughness."""
NOTHING = 1e-30
"""Power that has a logarithm."""

Density = Callable[[FloatArray, mdr.SelfAffine], FloatArray | Failed]
"""Two-sided C_F(q, roughness) of the force [N^2 m]."""
Levels = Mapping[str, Sequence[Estimate]]
"""Of octaves and of the whole force [dB over F_Hertz^2 (h/d)^2], and its mean [F_Hertz]."""


def judged(model: Caller, tolerance: float) -> Iterator[JudgedPoint]:
    """Octaves of the force along the track, and its variance."""

    def density(q: FloatArray, ground: mdr.SelfAffine) -> FloatArray | Failed:
        return model.call(q=q, roughness=ground, contact_radius=CONTACT, **SMOOTH_WHEEL)

    yield from judged_density(density, tolerance)


def judged_density(density: Density, tolerance: float) -> Iterator[JudgedPoint]:
    for height in heights():
        yield from beside((LEVEL, RMS), height, _of_density(density, height), tolerance)


def spectrum_of(settings: Mapping[str, Any]) -> PiecewisePowerLaw:
    """The roughness of the case, of unit height and contact radius."""
    return self_affine(settings["hurst"], settings["first"], settings["last"])


def bands_of(settings: Mapping[str, Any]) -> Bands:
    return Bands.around(math.pi, settings["lowest"], settings["last"]).on(settings["length"])


def variance_of(spectrum: PiecewisePowerLaw) -> float:
    """Of linear theory, over F_Hertz^2 (h/d)^2; Geike's rule keeps it."""
    return force_variance(spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0) / HERTZ**2


def heights() -> list[float]:
    """h/d of the case."""
    return list(dict.fromkeys(float(one.where[HEIGHT]) for one in curve(LEVEL)))


def octaves(thirds: FloatArray) -> FloatArray:
    """Of levels in thirds of octaves, (..., bands), those of the octaves that are known."""
    bands, centres = bands_of(about(LEVEL)["settings"]), dict.fromkeys(float(one.where[Q]) for one in curve(LEVEL))
    middle = [int(np.argmin(np.abs(np.log(bands.centres / q)))) for q in centres]
    return np.stack([thirds[..., i - 1 : i + 2].sum(axis=-1) for i in middle], axis=-1)


def _of_density(density: Density, height: float) -> Levels | Failed:
    """By quadrature in each third of an octave, and over all q for the variance."""
    settings = about(LEVEL)["settings"]
    first, last = settings["first"], settings["last"]
    ground = mdr.SelfAffine(hurst=settings["hurst"], q_min=first / CONTACT, q_max=last / CONTACT, rms=height * APPROACH)
    asked: list[FloatArray] = []

    def noted(q: FloatArray) -> FloatArray:
        asked.append(q)
        return q

    over_bands(noted, bands_of(settings))
    whole = (np.arange(FINE) + 0.5) * last / FINE
    found = density(np.concatenate([asked[0].ravel(), whole]) / CONTACT, ground)
    if isinstance(found, Failed):
        return found
    of_bands, rest = np.split(found / CONTACT / (FORCE * height) ** 2, [asked[0].size])
    thirds = over_bands(lambda q: of_bands.reshape(q.shape), bands_of(settings))
    variance = 2 * rest.sum() * last / FINE
    return {LEVEL: Estimates.exact(_decibel(octaves(thirds))), RMS: Estimates.exact(_decibel(variance))}


def _decibel(power: ArrayLike) -> FloatArray:
    """Less than nothing is as nothing."""
    return np.asarray(POWER_DECIBEL * np.log(np.maximum(power, NOTHING)))


def unanswered(
    quantity: str, where: Mapping[str, Place], failed: Failed, reference: float, unit: str = "-"
) -> JudgedPoint:
    """Where a model refuses, or fails."""
    verdict = REFUSED if failed.refused else FAILED
    return not_compared(quantity, where, verdict, failed.reason, reference=reference, unit=unit)


def beside(quantities: Sequence[str], height: float, found: Levels | Failed, tolerance: float) -> Iterator[JudgedPoint]:
    """Octaves, rms and mean at one height."""
    for quantity in quantities:
        of_mean = quantity == MEAN
        for i, known in enumerate(one for one in curve(quantity) if one.where[HEIGHT] == height):
            where = {name: place for name, place in known.where.items() if name != HEIGHT}
            if isinstance(found, Failed):
                unit = "-" if of_mean else "dB"
                yield unanswered(quantity, where, found, known.value, unit)
                continue
            mine, judge = found[quantity][i], compared if of_mean else compared_levels
            half = mine.half_width / abs(mine.value) if of_mean else mine.half_width
            both = known.grid + math.hypot(known.sample, half)
            yield judge(quantity, where, mine.value, known.value, both, tolerance)
