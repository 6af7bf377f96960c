"""Springs under a wheel on a strip of rail whose track has an input spectrum: that for rolling, or Geike's.

A spectrum is one of levels and has no places: a measured line, or lines, give its density and not where the wheel is
lifted. On a drawn strip the heights across are known, so each track here keeps the phases of its surface: models on
the same strip may be compared wave by wave.
"""

import math
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import mdr
from validation.engine.engine import Outcome
from validation.simulation.equivalent_displacement import LINEAR_MODELS, lifted
from validation.simulation.model_names import (
    LINE,
    LINEAR_GEIKE,
    LINEAR_ON_LINE,
    LINEAR_ROLLING,
    SPRINGS_GEIKE,
    SPRINGS_ROLLING,
    twin_of,
)
from validation.simulation.rail_strip import RailStrip, Transfer
from validation.theory.elliptic_contact import EllipticContact
from validation.theory.line_spectrum import LineSpectrum
from validation.theory.spring_input import geike_over_line, rolling_input_filter
from validation.theory.transverse_structure import IsotropicGround, Ridges

__all__ = ["LINEAR_GEIKE", "LINEAR_ROLLING", "SPRINGS_GEIKE", "SPRINGS_ROLLING", "twin_of"]
"""Names of models, for cases that compare the filters of this module."""
FloatArray = NDArray[np.float64]


def rolling_track(strip: RailStrip) -> FloatArray:
    """A line whose spectrum is the rolling spectrum of the strip, less its mean, shape (nx,) [m]."""
    contact = strip.contact
    return strip.along_middle(lambda x, y: rolling_input_filter(x, y, semi_axes=(contact.along, contact.across)))


def geike_track(strip: RailStrip) -> FloatArray:
    """The middle line of an isotropic surface with each of its waves scaled to C_1D = pi |k| C_2D(|k|) of Geike's rule.

    The waves keep their phases, and the scatter of their amplitudes.
    """
    line = strip.along_middle(LINEAR_MODELS[LINE](strip.contact))
    k = np.abs(2 * np.pi * np.fft.fftfreq(line.size, strip.spacing))
    of_line = strip.variance.sum(axis=1) * strip.width / (2 * math.pi)
    mapped = math.pi * k * strip.variance[:, 0] * (strip.width / (2 * math.pi)) ** 2
    ratio = np.divide(mapped, of_line, out=np.zeros_like(k), where=of_line > 0)
    return np.asarray(np.fft.ifft(np.sqrt(ratio) * np.fft.fft(line)).real)


SPECTRAL_SPRINGS: Mapping[str, Callable[[RailStrip], FloatArray]] = {
    SPRINGS_ROLLING: rolling_track,
    SPRINGS_GEIKE: geike_track,
}
"""Heights under the springs on a strip [m], by the name of the model; Geike's rule is for isotropic ground alone."""


@dataclass(frozen=True, kw_only=True)
class SpectralRail:
    """A strip, and the models of `SPECTRAL_SPRINGS` that roll over it. Raises ValueError for any other model."""

    strip: RailStrip
    models: tuple[str, ...]

    def __post_init__(self) -> None:
        if unknown := [name for name in self.models if name not in SPECTRAL_SPRINGS]:
            raise ValueError(f"models must be of {', '.join(SPECTRAL_SPRINGS)}, got {', '.join(unknown)}")


def roll_spectral_springs(problem: SpectralRail) -> Outcome:
    """Equivalent displacement along the strip of each model and of its linear twin, by their names, (nx,) [m].

    One-sided springs at the load of the strip; the twin is the track filtered by sin(k_x a_x) / (k_x a_x), (14.11).
    failed: none.
    """
    strip, found = problem.strip, dict[str, FloatArray]()
    for name in problem.models:
        track = SPECTRAL_SPRINGS[name](strip)
        with warnings.catch_warnings():
            # what few springs leave is measured on two grids
            warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
            rolled = mdr.roll(
                track, spacing=strip.spacing, radius=strip.radii, modulus=strip.modulus, force=strip.force
            )
        found |= {name: lifted(rolled.approach), twin_of(name): _linear(strip, track)}
    return {**found, "failed": np.array(0.0)}


def _linear(strip: RailStrip, track: FloatArray) -> FloatArray:
    """The displacement of springs that all touch: the track by its waves times (14.11), less its mean."""
    k = 2 * np.pi * np.fft.rfftfreq(track.size, strip.spacing)
    passed = np.fft.irfft(np.fft.rfft(track) * np.sinc(k * strip.contact.along / np.pi), track.size)
    return np.asarray(passed - passed.mean())


def rolling_transfer(contact: EllipticContact) -> Transfer:
    """H(k_x, k_y) of linear springs on the rolling spectrum: `rolling_input_filter` times (14.11)."""
    springs = LINEAR_MODELS[LINEAR_ON_LINE](contact)
    axes = contact.along, contact.across
    return lambda along, across: rolling_input_filter(along, across, semi_axes=axes) * springs(along, across)


def geike_power(line: LineSpectrum, contact: EllipticContact, edges: FloatArray) -> FloatArray:
    """Band powers of linear springs on Geike's spectrum of the isotropic ground of a line, over those of the line [-].

    int sin^2(q a_x) / (q a_x)^2 pi q C_2D dq over int C_line dq, between ascending wavenumbers [rad/m]. Raises
    ValueError where no isotropic surface has such a line.
    """
    springs, ground = LINEAR_MODELS[LINEAR_ON_LINE](contact), IsotropicGround(line)
    return Ridges().band_power(
        line,
        lambda along, across: np.sqrt(geike_over_line(along, ground)) * springs(along, across),
        edges=edges,
        semi_axes=(contact.along, contact.across),
    )
