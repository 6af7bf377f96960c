"""Limits of Geike's spectrum under a wheel: waves shorter than the contact, and roughness that is not isotropic."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

import mdr
from validation.cases.limits.sweep import FloatArray, Limit, Point, call_and_record_warnings, swept
from validation.engine.engine import Outcome
from validation.engine.random_numbers import random_generator
from validation.simulation.track_spectrum import PiecewisePowerLaw, TrackSpectrum, self_affine
from validation.theory.rolling import force_spectrum_1d, force_spectrum_3d, force_variance, response

HURST = 0.7
GEIKE_TRACK = 1
"""The spawn key of a track of Geike's spectrum."""

LEVEL = Limit(
    name="level",
    method="MDR, linear filter",
    title="level along the track",
    parameter="wavenumber q a",
    error="level over that of 3D [dB]",
    reference="linear theory of the half-space, octaves",
    condition="q a = 1: waves shorter than the contact are lower by Γ(H+3/2) / (√π Γ(H+2)) on the half-space",
    failing_side="above",
    tolerance=3.0,
    factor=2.5,
)
ANISOTROPY = Limit(
    name="anisotropy",
    method="MDR, linear filter",
    title="anisotropic surface",
    parameter="aspect ratio of the waves, less one",
    error="rms force, over that of 3D, less one",
    reference="linear theory of the half-space, quadrature",
    condition=(
        "√ratio = 1 + tolerance, for q a >> 1: a line along the long waves is taken for one of an isotropic surface"
    ),
    failing_side="above",
    tolerance=0.2,
    factor=2.0,
    derived=True,
)


@dataclass(frozen=True, kw_only=True)
class Octaves:
    """The force over isotropic roughness in octaves about q a, far from both ends of its band."""

    seed: int
    hurst: float = HURST
    first: float = 0.005
    last: float = 200.0
    centres: tuple[float, ...] = (0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 8.0, 16.0)
    lines: int = 48

    def sweep(self) -> Outcome:
        """Level of springs over the half-space [dB], with Geike's spectrum and with the rolling-equivalent one."""
        spectrum = self_affine(self.hurst, self.first, self.last)
        differences = np.array([_octave(spectrum, centre, self.lines) for centre in self.centres])
        geike, rolling = np.abs(differences).T
        # springs have a spectrum and no surface: one track, with the waves about the contact, gives their only message
        _, message = call_and_record_warnings(partial(_rolled, self_affine(self.hurst, 0.25, 8.0), self.seed))
        points = [(float(error), message) for error in geike]
        return {**swept(LEVEL, self.centres, points, 1.0), "level, rolling-equivalent spectrum": rolling}


@dataclass(frozen=True, kw_only=True)
class Anisotropy:
    """Isotropic roughness between two wavenumbers, stretched along the track and shrunk across, keeping areas."""

    seed: int
    hurst: float = HURST
    first: float = 20.0
    last: float = 200.0
    ratios: tuple[float, ...] = (1.05, 1.1, 1.2, 1.3, 1.45, 1.65, 2.0, 3.0, 5.0, 9.0)

    def sweep(self) -> Outcome:
        """rms force of springs that take a cut along the track for isotropic, over that of the half-space.

        Waves (k_x, k_y) of the stretched surface are (k_x / sqrt(ratio), k_y sqrt(ratio)) of the isotropic one, and its
        cut along x is that of isotropic roughness stretched both ways: C_2D'(q) = ratio C_2D(sqrt(ratio) q). For
        q a >> 1 the half-space feels 1 / |k|^2, whose mean over all directions does not depend on the ratio.
        """
        spectrum = self_affine(self.hurst, self.first, self.last)

        def point(ratio: float) -> Point:
            cut = cut_along(spectrum, ratio)
            springs = force_variance(cut.c2d, edges=cut.edges, contact_radius=1.0, modulus=1.0)
            error = abs(math.sqrt(springs / stretched_variance(spectrum, ratio)) - 1)
            return error, call_and_record_warnings(partial(_rolled, cut, self.seed))[1]

        threshold = (1 + ANISOTROPY.tolerance) ** 2 - 1
        return swept(ANISOTROPY, np.array(self.ratios) - 1, [point(ratio) for ratio in self.ratios], threshold)


def decibel(ratio: float) -> float:
    return 10 * math.log10(ratio)


def _octave(spectrum: PiecewisePowerLaw, centre: float, lines: int) -> tuple[float, float]:
    """Springs over the half-space in an octave, by Geike's rule and by that for rolling [dB]."""
    q = centre * 2 ** ((np.arange(lines) + 0.5) / lines - 0.5)
    # over the power law, whose fall would leave but the first part of a turn of sin^2
    level = 1 / (spectrum.c2d(q) / q)
    true = np.sum(level * force_spectrum_3d(q, spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0))
    geike, rolling = (
        float(np.sum(level * force_spectrum_1d(q, c1d, contact_radius=1.0, modulus=1.0)) / true)
        for c1d in (TrackSpectrum(spectrum, "geike"), TrackSpectrum(spectrum, "rolling"))
    )
    return decibel(geike), decibel(rolling)


def _rolled(spectrum: PiecewisePowerLaw, seed: int) -> FloatArray:
    """What a user of Geike's rule does: a track of little roughness on enough springs, rolled over."""
    length = 8 * 2 * math.pi / spectrum.edges[0]
    points = math.ceil(length * max(16.0, 8 * spectrum.edges[-1] / (2 * math.pi)))
    rng = random_generator(seed, GEIKE_TRACK)
    track = mdr.rough_profile(TrackSpectrum(spectrum, "geike"), length=length, points=points, rng=rng, rms=1e-3)
    return mdr.rolling_force(track, spacing=length / points, radius=1.0, modulus=1.0, approach=1.0)


def cut_along(spectrum: PiecewisePowerLaw, ratio: float) -> PiecewisePowerLaw:
    """The isotropic spectrum of unit height whose cut is that of the stretched surface along its long waves."""
    edges = tuple(edge / math.sqrt(ratio) for edge in spectrum.edges)
    return PiecewisePowerLaw(edges=edges, exponents=spectrum.exponents)


def stretched_variance(spectrum: PiecewisePowerLaw, ratio: float, lines: int = 1500, angles: int = 180) -> float:
    """<dF^2> over (E* a)^2 = int G(|k|) C_2D(kappa) d2kappa, k = (kappa_x / sqrt(ratio), kappa_y sqrt(ratio))."""
    edge = np.geomspace(spectrum.edges[0], spectrum.edges[-1], lines + 1)
    kappa = np.sqrt(edge[1:] * edge[:-1])[:, np.newaxis]
    phi = (np.arange(angles) + 0.5) * np.pi / (2 * angles)
    k = kappa * np.hypot(np.cos(phi) / math.sqrt(ratio), np.sin(phi) * math.sqrt(ratio))
    weight = spectrum.c2d(kappa) * kappa * np.diff(edge)[:, np.newaxis] * 2 * np.pi / angles
    return float(np.sum(weight * response(k, contact_radius=1.0, modulus=1.0) ** 2))
