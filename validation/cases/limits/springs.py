"""Sweeps through the limits of springs that are pressed or rolled: one solve of each."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

import mdr
from validation.cases.limits.sweep import Limit, call_and_record_warnings, swept
from validation.engine.engine import Outcome, random_generator
from validation.simulation.free_vibration import WHEEL
from validation.simulation.rolling_strip import Strip, roll_strip
from validation.simulation.rough_punch import Profiles, PunchRoughness, Surface, press_profiles, press_surface
from validation.simulation.spring_tracks import FINE, STRIDES, RoughTrack, Spacings, coarsen
from validation.simulation.track_spectrum import PiecewisePowerLaw, TrackSpectrum, self_affine
from validation.theory.rolling import force_spectrum_1d, force_spectrum_3d, force_variance, response

FloatArray = NDArray[np.float64]

FULL, HALF = 1.1631 / math.sqrt(2), 0.4769 / math.sqrt(2)
"""p over E* h' at which Persson's contact fraction erf(sqrt(2) p / (E* h')) is 0.9, and one half."""

AREA = Limit(
    name="area",
    method="MDR",
    title="true contact area",
    knob="force F / (E* h L)",
    error="contact fraction, over that of 3D, less one",
    against="boundary elements, rough punches",
    condition="nothing but full contact: p = 0.82 E* h', where Persson's contact fraction is 0.9",
    failing="below",
    tolerance=0.1,
    factor=3.0,
)
GAP = Limit(
    name="gap",
    method="MDR",
    title="mean gap",
    knob="force F / (E* h L)",
    error="difference of the mean gaps [h]",
    against="boundary elements, rough punches",
    condition="nothing but closed gaps: p = 0.34 E* h', where Persson's contact fraction is a half",
    failing="below",
    tolerance=0.1,
    factor=3.0,
)
LEVEL = Limit(
    name="level",
    method="MDR, linear filter",
    title="level along the track",
    knob="wavenumber q a",
    error="level over that of 3D [dB]",
    against="linear theory of the half-space, octaves",
    condition="q a = 1: shorter waves than the contact are Γ(H+3/2) / (√π Γ(H+2)) lower on the half-space",
    failing="above",
    tolerance=3.0,
    factor=2.5,
)
ANISOTROPY = Limit(
    name="anisotropy",
    method="MDR, linear filter",
    title="anisotropic surface",
    knob="aspect ratio of the waves, less one",
    error="rms force, over that of 3D, less one",
    against="linear theory of the half-space, quadrature",
    condition="√ratio = 1 + tolerance: a cut along long waves, taken for isotropic, where q a >> 1",
    failing="above",
    tolerance=0.2,
    factor=2.0,
    derived=True,
)
LINEAR = Limit(
    name="linear",
    method="MDR, linear filter",
    title="rough track",
    knob="height h_rms / d",
    error="force, over its fluctuation",
    against="one-sided springs on the same track",
    condition="h / d = 2 c tolerance, c = rms dF / (E* a h): the ends of contact move, to second order",
    failing="above",
    tolerance=0.1,
    factor=2.0,
    derived=True,
    warned=True,
)
FILTER_3D = Limit(
    name="linear in 3D",
    method="linear theory, 3D",
    title="rough strip",
    knob="height h_rms / d",
    error="force, over its fluctuation",
    against="boundary elements on the same strip",
    condition="√(π/8) h' a / d = tolerance: where Persson has contact lost, weighted as the flat punch presses",
    failing="above",
    tolerance=0.2,
    factor=3.0,
)
SPACING = Limit(
    name="spacing",
    method="MDR",
    title="springs too far apart",
    knob="springs to the shortest wave",
    error="last one-third octave [dB]",
    against=f"{FINE} springs to the shortest wave",
    condition="4 springs: z / sin z = 0.91 dB at z = π/4",
    failing="below",
    tolerance=1.0,
    factor=1.75,
    derived=True,
    warned=True,
)
ASPERITY = Limit(
    name="asperity",
    method="MDR",
    title="the last asperity",
    knob="springs in contact",
    error="stiffness, rms over profiles",
    against="many more springs on the same profile",
    condition="1 / (√6 tolerance): springs rounded up or down in one stretch of contact",
    failing="below",
    tolerance=0.05,
    factor=2.5,
    derived=True,
    warned=True,
)
LIMITS = (AREA, GAP, LEVEL, ANISOTROPY, LINEAR, FILTER_3D, SPACING, ASPERITY)


@dataclass(frozen=True, kw_only=True)
class Punches:
    """Rough punches of Fig. 14.1, from few contacts to full contact, by both methods."""

    roughness: PunchRoughness
    cells: int
    surfaces: int
    profiles: int
    points: int
    forces: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class Octaves:
    """The force over isotropic roughness in octaves about q a, far from both ends of its band."""

    hurst: float
    first: float
    last: float
    centres: tuple[float, ...]
    seed: int
    lines: int = 48


@dataclass(frozen=True, kw_only=True)
class Stretched:
    """Isotropic roughness between two wavenumbers, stretched along the track, and shrunk across, keeping areas."""

    hurst: float
    first: float
    last: float
    ratios: tuple[float, ...]
    seed: int


@dataclass(frozen=True, kw_only=True)
class Heights:
    """One track of unit height, in units of a wheel with a = d = E* = 1, made higher and higher."""

    hurst: float
    last: float
    heights: tuple[float, ...]
    length: float
    springs: int
    seed: int


@dataclass(frozen=True, kw_only=True)
class Strips:
    """One strip, alike."""

    hurst: float
    last: float
    heights: tuple[float, ...]
    length: float
    width: float
    cells: int
    seed: int


@dataclass(frozen=True, kw_only=True)
class Coarser:
    """Springs of many spacings on one track of little roughness: the solve of the case `wheel_stability`."""

    seed: int


@dataclass(frozen=True, kw_only=True)
class Asperities:
    """Rough profiles under very low forces, on so many points and on finer ones."""

    roughness: PunchRoughness
    profiles: int
    points: int
    finer: int
    forces: tuple[float, ...]


def press_punches(problem: Punches) -> Outcome:
    """Contact fraction and mean gap of springs beside boundary elements, means over the draws."""
    r, force = problem.roughness, np.array(problem.forces)
    surfaces = [
        press_surface(Surface(roughness=r, realisation=i, cells=problem.cells, forces=problem.forces, tolerance=1e-4))
        for i in range(problem.surfaces)
    ]
    springs = press_profiles(
        Profiles(roughness=r, realisations=problem.profiles, points=problem.points, length=1.0, forces=problem.forces)
    )
    area, gap = (np.mean([s[name] for s in surfaces], axis=0) for name in ("area", "gap"))
    curve = mdr.load_curve(r.profile(problem.points, 0), length=1.0, modulus=1.0)
    said = [call_and_record_warnings(partial(curve.at_force, r.height * f))[1] for f in problem.forces]
    slope = float(np.mean([s["gradient"] for s in surfaces])) / r.height
    apart = np.abs(springs["gap"].mean(axis=0) - gap) / r.height
    return {
        **swept("area", force, np.abs(springs["area"].mean(axis=0) / area - 1), FULL * slope, said),
        **swept("gap", force, apart, HALF * slope, said),
        "failed": np.array(sum(float(s["failed"]) for s in surfaces)),
    }


def compare_octaves(problem: Octaves) -> Outcome:
    """Level of the springs of Geike's spectrum, and of those that are fed for rolling, over the half-space [dB]."""
    spectrum = self_affine(problem.hurst, problem.first, problem.last)
    apart = np.array([_apart(spectrum, centre, problem.lines) for centre in problem.centres])
    # springs know a spectrum and no surface: they are asked once, over the waves about the contact
    _, words = call_and_record_warnings(partial(_rolled, self_affine(problem.hurst, 0.25, 8.0), problem.seed))
    geike, rolling = np.abs(apart).T
    said = [words] * len(problem.centres)
    return {**swept("level", problem.centres, geike, 1.0, said), "level, fed for rolling": rolling}


def _apart(spectrum: PiecewisePowerLaw, centre: float, lines: int) -> tuple[float, float]:
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


def decibel(ratio: float) -> float:
    """Of a ratio of powers."""
    return 10 * math.log10(ratio)


def _rolled(spectrum: PiecewisePowerLaw, seed: int) -> FloatArray:
    """What a user of Geike's rule does: a track of little roughness on enough springs, rolled over."""
    length = 8 * 2 * math.pi / spectrum.edges[0]
    points = math.ceil(length * max(16.0, 8 * spectrum.edges[-1] / (2 * math.pi)))
    track = mdr.rough_profile(
        TrackSpectrum(spectrum, "geike"), length=length, points=points, rng=random_generator(seed, 1), rms=1e-3
    )
    return mdr.rolling_force(track, spacing=length / points, radius=1.0, modulus=1.0, approach=1.0)


def stretch(problem: Stretched) -> Outcome:
    """rms force of springs that take a cut along the track for isotropic, over that of the half-space.

    Waves (k_x, k_y) of the stretched surface are (k_x / sqrt(ratio), k_y sqrt(ratio)) of the isotropic one, and its cut
    along x is that of isotropic roughness stretched both ways: C_2D'(q) = ratio C_2D(sqrt(ratio) q). For q a >> 1 the
    half-space feels 1 / |k|^2, whose mean over all directions does not depend on the ratio.
    """
    spectrum = self_affine(problem.hurst, problem.first, problem.last)
    errors, said = [], []
    for ratio in problem.ratios:
        cut = cut_along(spectrum, ratio)
        springs = force_variance(cut.c2d, edges=cut.edges, contact_radius=1.0, modulus=1.0)
        errors.append(abs(math.sqrt(springs / stretched_variance(spectrum, ratio)) - 1))
        said.append(call_and_record_warnings(partial(_rolled, cut, problem.seed))[1])
    border = (1 + ANISOTROPY.tolerance) ** 2 - 1
    return swept("anisotropy", np.array(problem.ratios) - 1, errors, border, said)


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


def make_higher(problem: Heights) -> Outcome:
    """The linear filter against one-sided springs: difference about its mean, over the fluctuation."""
    spectrum, spacing = self_affine(problem.hurst, 1.0, problem.last), 1 / problem.springs
    unit = mdr.rough_profile(
        TrackSpectrum(spectrum, "geike"),
        length=problem.length,
        points=round(problem.length * problem.springs),
        rng=random_generator(problem.seed, 2),
        rms=1.0,
    )
    errors, said = [], []
    for height in problem.heights:
        roll = partial(mdr.roll, height * unit, spacing=spacing, radius=1.0, modulus=1.0, approach=1.0)
        linear, words = call_and_record_warnings(partial(roll, contact="linear"))
        assert linear is not None
        true = roll().force
        errors.append(np.std(linear.force - true) / np.std(linear.force))
        said.append(words)
    c = math.sqrt(force_variance(spectrum.c2d, edges=spectrum.edges, contact_radius=1.0, modulus=1.0))
    return swept("linear", problem.heights, errors, 2 * c * LINEAR.tolerance, said)


def make_strips_higher(problem: Strips) -> Outcome:
    """Linear theory of the half-space against boundary elements, alike; failed: positions that did not converge."""
    spectrum, errors, said, failed = self_affine(problem.hurst, 1.0, problem.last), [], [], 0.0
    for height in problem.heights:
        strip = Strip(
            spectrum=spectrum,
            height=height,
            realisation=0,
            length=problem.length,
            width=problem.width,
            cells=problem.cells,
            tolerance=1e-4,
            seed=problem.seed,
        )
        found, words = call_and_record_warnings(partial(roll_strip, strip))
        assert found is not None
        force, linear = found["force"], found["linear"]
        errors.append(np.nanstd(force - linear) / np.std(linear))
        said.append(words)
        failed += float(found["failed"])
    slope = rms_slope(spectrum)
    border = FILTER_3D.tolerance / (math.sqrt(math.pi / 8) * slope)
    return {**swept("linear in 3D", problem.heights, errors, border, said), "failed": np.array(failed)}


def rms_slope(spectrum: PiecewisePowerLaw) -> float:
    """h' of unit height: the root of 2 pi int q^3 C_2D dq."""
    q = np.geomspace(spectrum.edges[0], spectrum.edges[-1], 4001)
    return math.sqrt(float(np.trapezoid(2 * np.pi * q**4 * spectrum.c2d(q), np.log(q))))


def space_out(problem: Coarser) -> Outcome:
    """The last one-third octave on coarser springs; what is said is said as such a track is drawn."""
    track = RoughTrack(rms=1e-3 * WHEEL.approach, seed=problem.seed, waves=9, per_wave=FINE)
    level = coarsen(Spacings(track=track))["level"]
    error = [abs(decibel(one)) if one > 0 else math.inf for one in level]
    said = [call_and_record_warnings(partial(_drawn_on, track, track.points // n))[1] for n in STRIDES]
    return swept("spacing", FINE / np.array(STRIDES), error, 4.0, said)


def _drawn_on(track: RoughTrack, points: int) -> FloatArray:
    q_min, q_max = 2 * np.pi / track.longest, 2 * np.pi / track.shortest
    spectrum = mdr.SelfAffine(hurst=track.hurst, q_min=q_min, q_max=q_max, rms=track.rms)
    return mdr.rough_profile(
        spectrum.c1d, length=track.waves * track.longest, points=points, rng=random_generator(track.seed), rms=track.rms
    )


def press_asperities(problem: Asperities) -> Outcome:
    """Stiffness against finer springs on the same profiles, rms at each force; who speaks has the mean number."""
    r, force = problem.roughness, problem.roughness.height * np.array(problem.forces)
    coarse, fine = (
        press_profiles(
            Profiles(roughness=r, realisations=problem.profiles, points=n, length=1.0, forces=problem.forces)
        )["stiffness"]
        for n in (problem.points, problem.finer * problem.points)
    )
    springs = coarse * problem.points
    said = []
    for f, count in zip(force.tolist(), springs.T, strict=True):
        typical = int(np.argmin(np.abs(count - count.mean())))
        curve = mdr.load_curve(r.profile(problem.points, typical), length=1.0, modulus=1.0)
        said.append(call_and_record_warnings(partial(curve.at_force, f))[1])
    error = np.sqrt(np.mean((coarse / fine - 1) ** 2, axis=0))
    return swept("asperity", springs.mean(axis=0), error, 1 / (math.sqrt(6) * ASPERITY.tolerance), said)
