"""Both methods past their limits: probes, each swept along a parameter.

A probe hands over the error at each value, and what the software says there. Boundary elements press spheres,
a = d = R = 1 and E* = 1, and periodic waves; springs are pressed, roll on rough tracks, and carry a mass in time.
"""

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial, wraps
from typing import TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike

import bem3d
import mdr
from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import random_generator
from validation.simulation.contact_laws import HertzLaw
from validation.simulation.free_vibration import SCHEMES, WHEEL, Vibrations, vibrate
from validation.simulation.integrators import VELOCITY_VERLET
from validation.simulation.motion import simulate
from validation.simulation.rolling_strip import RoughStrip, Strip, roll_strip
from validation.simulation.rough_punch import Profiles, PunchRoughness, Surface, press_profiles, press_surface
from validation.simulation.spring_tracks import FINE, STRIDES, LiftOff, RoughTrack, coarsen, filtered, lift_off
from validation.simulation.track_spectrum import PiecewisePowerLaw, TrackSpectrum, self_affine
from validation.theory.rolling import force_spectrum_1d, force_spectrum_3d, force_variance, response

Values = tuple[float, ...]
Point = tuple[float, str]
"""The error at one value, infinite where there is no answer, and the message of the software, empty without one."""
T = TypeVar("T")
REFUSALS = (ValueError, ArithmeticError, bem3d.ConvergenceError)


def swept(
    values: ArrayLike, error: ArrayLike, messages: Sequence[str], *, measured: ArrayLike = 1.0, **also: ArrayLike
) -> Outcome:
    """The outcome of a sweep through a limit, sorted by ascending values. error: of one limit, or a row for each of
    several; measured: what predicted thresholds take from the solve; also: further columns, or numbers."""
    x = np.asarray(values, dtype=np.float64)
    order = np.argsort(x)
    return {
        "values": x[order],
        "error": np.atleast_2d(np.asarray(error, dtype=np.float64))[:, order],
        "measured": np.atleast_1d(np.asarray(measured, dtype=np.float64)),
        # a stored outcome keeps words as well as numbers
        "messages": cast(FloatArray, np.asarray(messages, dtype=np.str_)[order]),
        **{name: np.asarray(value, dtype=np.float64) for name, value in also.items()},
    }


def along(point: Callable[..., tuple[float, float, str]]) -> Callable[..., Outcome]:
    """A probe by that of one value, which gives the value to be shown, the error, and the message."""

    @wraps(point)
    def probe(values: Sequence[float], **settings: int) -> Outcome:
        return swept(*zip(*(point(value, **settings) for value in values), strict=True))

    return probe


def recorded(call: Callable[[], T]) -> tuple[T | None, str]:
    """The answer of a call, None where it refuses, and its message: its warnings, or the reason of its refusal.

    Warnings about units are left out: sweeps of spikes and pits give them on either side of a threshold.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            answer = call()
        except REFUSALS as error:
            return None, f"{type(error).__name__}: {error}"
    relevant = [w for w in caught if not issubclass(w.category, (mdr.SpringUnitsWarning, bem3d.UnitsWarning))]
    return answer, "; ".join(f"{w.category.__name__}: {getattr(w.message, 'detail', w.message)}" for w in relevant)


def answered(call: Callable[[], T]) -> tuple[T, str]:
    """Answer and message of a call that must not refuse, as of `recorded`. ArithmeticError has the reason."""
    answer, message = recorded(call)
    if answer is None:
        raise ArithmeticError(message)
    return answer, message


def message_of(call: Callable[[], object]) -> str:
    """Warnings or refusal of a call, as of `recorded`; empty without any."""
    return recorded(call)[1]


HURST = 0.7
GEIKE_TRACK, UNIT_TRACK = 1, 2
"""Spawn keys of a track of Geike's spectrum, and of one of unit height."""
UNIT = {"contact_radius": 1.0, "modulus": 1.0}


def rough_punches(
    forces: Values, *, cells: int, surfaces: int, profiles: int, seed: int, points: int = 1024
) -> Outcome:
    """Contact fraction and mean gap of springs against boundary elements, means over punches of Fig. 14.1; measured:
    the rms gradient over h."""
    r = PunchRoughness(hurst=HURST, waves=(1, cells // 4), seed=seed)
    punch = partial(Surface, roughness=r, cells=cells, forces=forces, tolerance=1e-4)
    pressed = [press_surface(punch(realisation=i)) for i in range(surfaces)]
    springs = press_profiles(Profiles(roughness=r, realisations=profiles, points=points, length=1.0, forces=forces))
    area, gap = (np.mean([s[name] for s in pressed], axis=0) for name in ("area", "gap"))
    errors = np.abs(springs["area"].mean(axis=0) / area - 1), np.abs(springs["gap"].mean(axis=0) - gap) / r.height
    curve = mdr.load_curve(r.profile(points, 0), length=1.0, modulus=1.0)
    messages = [message_of(partial(curve.at_force, r.height * f)) for f in forces]
    gradient, failed = np.mean([s["gradient"] for s in pressed]) / r.height, sum(float(s["failed"]) for s in pressed)
    return swept(forces, errors, messages, measured=[gradient, gradient], failed=failed)


def last_asperities(forces: Values, *, profiles: int, seed: int, points: int = 256, finer: int = 32) -> Outcome:
    """Stiffness of rough profiles under very low forces against finer springs, rms over them, by springs in contact.

    Messages are those of the profile whose number of springs in contact is nearest to the mean.
    """
    r = PunchRoughness(hurst=HURST, waves=(1, 16), seed=seed)
    coarse, fine = (
        press_profiles(Profiles(roughness=r, realisations=profiles, points=n, length=1.0, forces=forces))["stiffness"]
        for n in (points, finer * points)
    )
    springs, messages = coarse * points, []
    for force, count in zip(r.height * np.array(forces), springs.T, strict=True):
        typical = int(np.argmin(np.abs(count - count.mean())))
        curve = mdr.load_curve(r.profile(points, typical), length=1.0, modulus=1.0)
        messages.append(message_of(partial(curve.at_force, float(force))))
    return swept(springs.mean(axis=0), np.sqrt(np.mean((coarse / fine - 1) ** 2, axis=0)), messages)


def octaves(centres: Values, *, seed: int, lines: int = 48) -> Outcome:
    """Level of springs with Geike's spectrum over the half-space [dB], in octaves about q a, far from both ends of its
    band."""
    spectrum = self_affine(HURST, 0.005, 200.0)

    def error(centre: float) -> float:
        q = centre * 2 ** ((np.arange(lines) + 0.5) / lines - 0.5)
        # over the power law, whose fall would leave but the first part of a turn of sin^2
        level = 1 / (spectrum.c2d(q) / q)
        true = np.sum(level * force_spectrum_3d(q, spectrum.c2d, edges=spectrum.edges, **UNIT))
        springs = np.sum(level * force_spectrum_1d(q, TrackSpectrum(spectrum, "geike"), **UNIT))
        return abs(10 * math.log10(springs / true))

    # springs have a spectrum and no surface: one track, with the waves about the contact, gives their only message
    message = message_of(partial(_roll_track, self_affine(HURST, 0.25, 8.0), seed))
    return swept(centres, list(map(error, centres)), [message] * len(centres))


@along
def anisotropy(ratio: float, seed: int) -> tuple[float, float, str]:
    """rms force of springs that take a cut along the track for isotropic, over that of the half-space.

    The roughness is isotropic between two wavenumbers, then stretched along the track and shrunk across, keeping areas:
    waves (k_x, k_y) are (k_x / sqrt(ratio), k_y sqrt(ratio)) of the isotropic ones. The cut along x is that of
    isotropic roughness stretched both ways: C_2D'(q) = ratio C_2D(sqrt(ratio) q). For q a >> 1 the half-space feels
    1 / |k|^2, whose mean over all directions does not depend on the ratio.
    """
    spectrum = self_affine(HURST, 20.0, 200.0)
    edges = tuple(edge / math.sqrt(ratio) for edge in spectrum.edges)
    cut = PiecewisePowerLaw(edges=edges, exponents=spectrum.exponents)
    springs = force_variance(cut.c2d, edges=cut.edges, **UNIT)
    error = abs(math.sqrt(springs / stretched_variance(spectrum, ratio)) - 1)
    return ratio - 1, error, message_of(partial(_roll_track, cut, seed))


def stretched_variance(spectrum: PiecewisePowerLaw, ratio: float, lines: int = 1500, angles: int = 180) -> float:
    """<dF^2> over (E* a)^2 = int G(|k|) C_2D(kappa) d2kappa, k = (kappa_x / sqrt(ratio), kappa_y sqrt(ratio))."""
    edge = np.geomspace(spectrum.edges[0], spectrum.edges[-1], lines + 1)
    kappa = np.sqrt(edge[1:] * edge[:-1])[:, np.newaxis]
    phi = (np.arange(angles) + 0.5) * np.pi / (2 * angles)
    k = kappa * np.hypot(np.cos(phi) / math.sqrt(ratio), np.sin(phi) * math.sqrt(ratio))
    weight = spectrum.c2d(kappa) * kappa * np.diff(edge)[:, np.newaxis] * 2 * np.pi / angles
    return float(np.sum(weight * response(k, **UNIT) ** 2))


def _roll_track(spectrum: PiecewisePowerLaw, seed: int) -> FloatArray:
    """Force on a track of Geike's rule, of little roughness and on enough springs, at each of its places."""
    length = 8 * 2 * math.pi / spectrum.edges[0]
    points = math.ceil(length * max(16.0, 8 * spectrum.edges[-1] / (2 * math.pi)))
    rng = random_generator(seed, GEIKE_TRACK)
    track = mdr.rough_profile(TrackSpectrum(spectrum, "geike"), length=length, points=points, rng=rng, rms=1e-3)
    return mdr.rolling_force(track, spacing=length / points, radius=1.0, modulus=1.0, approach=1.0)


def rough_tracks(heights: Values, *, track: float, seed: int, springs: int = 32) -> Outcome:
    """The linear filter against one-sided springs: difference about its mean, over the fluctuation.

    One track of unit height, in units of a wheel with a = d = E* = 1, is made higher and higher; measured: c, the rms
    force of linear theory over E* a h.
    """
    spectrum = self_affine(HURST, 1.0, 8.0)
    points, rng = round(track * springs), random_generator(seed, UNIT_TRACK)
    unit = mdr.rough_profile(TrackSpectrum(spectrum, "geike"), length=track, points=points, rng=rng, rms=1.0)

    def point(height: float) -> Point:
        roll = partial(mdr.roll, height * unit, spacing=1 / springs, radius=1.0, modulus=1.0, approach=1.0)
        linear, message = answered(partial(roll, contact="linear"))
        return float(np.std(linear.force - roll().force) / np.std(linear.force)), message

    c = math.sqrt(force_variance(spectrum.c2d, edges=spectrum.edges, **UNIT))
    return swept(heights, *zip(*map(point, heights), strict=True), measured=c)


def rough_strips(heights: Values, *, length: float, strip_cells: int, seed: int, width: float = 12.0) -> Outcome:
    """By height h: rms of the difference of linear theory from boundary elements, over that of linear theory.

    Along one strip, each at the same positions. measured: rms gradient of the strip over h; failed: positions that did
    not converge.
    """
    spectrum, failed = self_affine(HURST, 1.0, 8.0), []

    def point(height: float) -> Point:
        scene = RoughStrip(spectrum=spectrum, height=height, length=length, width=width, seed=seed)
        strip = Strip(scene=scene, realisation=0, cells=strip_cells, tolerance=1e-4)
        outcome, message = answered(partial(roll_strip, strip))
        failed.append(float(outcome["failed"]))
        return float(np.nanstd(outcome["force"] - outcome["linear"]) / np.std(outcome["linear"])), message

    points = list(map(point, heights))
    return swept(heights, *zip(*points, strict=True), measured=spectrum.gradient, failed=sum(failed))


def coarser_springs(strides: tuple[int, ...], *, seed: int) -> Outcome:
    """The last one-third octave on coarser springs, by springs to the shortest wave; messages are those of drawing
    such a track. The solve of the case `wheel_stability`, which has these strides."""
    track = RoughTrack(rms=1e-3 * WHEEL.approach, seed=seed, waves=9, per_wave=FINE)
    levels = dict(zip(STRIDES, coarsen(track)["level"].tolist(), strict=True))
    errors = [abs(10 * math.log10(levels[n])) if levels[n] > 0 else math.inf for n in strides]
    messages = [message_of(partial(track.heights, 1, track.points // n)) for n in strides]
    return swept(FINE / np.array(strides), errors, messages)


def time_steps(steps: Values, *, scheme: str, turns: int = 3) -> Outcome:
    """Free linear vibration in steps x = omega_eigen dt: growth of a step, less one, by Verlet, else the change of the
    energy in a turn. Messages are those of beginning a motion; a scheme may take several cells of the track in a step.
    """
    integrator = SCHEMES[scheme]
    outcome = vibrate(Vibrations(scheme=scheme, steps=steps, natural_periods=turns))
    error = np.maximum(outcome["growth"] - 1, 0.0) if integrator is VELOCITY_VERLET else outcome["change"]
    begin = partial(simulate, WHEEL, HertzLaw(WHEEL), steps=1, integrator=integrator)
    dt = np.array(steps) / WHEEL.eigenfrequency / integrator.cells
    return swept(steps, error, [message_of(partial(begin, time_step=seconds)) for seconds in dt.tolist()])


def higher_tracks(heights: Values, *, wheels: int, seed: int, waves: int = 6) -> Outcome:
    """Part of the time in the air, of wheels of Table 14.1 over rough tracks, by h_rms / d_N; measured: h / d at which
    the largest tension of linear theory is the load; imbalance: largest error of the balance of momentum, over F_N T.
    """

    def roll(height: float) -> tuple[Outcome, str]:
        track = RoughTrack(rms=height * WHEEL.approach, seed=seed, waves=waves)
        # a linear contact in motion has its force from the filter, which is what warns
        message = message_of(partial(filtered, track, track.heights(1)[:, 0]))
        return lift_off(LiftOff(track=track, wheels=wheels)), message

    outcomes, messages = zip(*map(roll, heights), strict=True)
    imbalance = [float(np.abs(outcome["imbalance"]).max()) for outcome in outcomes]
    airborne = [float(outcome["airborne"].mean()) for outcome in outcomes]
    return swept(heights, airborne, messages, measured=heights[0] / outcomes[0]["pull"].max(), imbalance=imbalance)


HERTZ = 4 / 3
LATTICE = 3.900265
"""-4 zeta(1/2) beta(1/2): the sum of 1 / |n| over a square lattice but for its origin, less its mean; Borwein et al.,
Lattice Sums Then and Now, chapter 1."""
LONE_CELL = math.pi / (4 * math.asinh(1.0))
"""k / (E* dx) of one square cell, by Love."""
RESIDUAL = 1e-6
"""The default of `bem3d.solve`."""


def sphere(cells: int, spacing: float, place: float = 0.0) -> FloatArray:
    """Gap of the sphere over a grid, so many cells aside of its middle along both axes."""
    x = (np.arange(cells) - (cells - 1) / 2 - place) * spacing
    return np.asarray((x[:, np.newaxis] ** 2 + x**2) / 2)


def half_space(cells: int, spacing: float, *, periodic: bool = False) -> bem3d.HalfSpace:
    """A half-space of cells x cells, E* = 1."""
    return bem3d.HalfSpace(shape=(cells, cells), spacing=spacing, modulus=1.0, periodic=periodic)


@along
def few_cells(cells: float, places: int = 8) -> tuple[float, float, str]:
    """Stiffness on a / dx cells against Hertz, rms over places on a cell along its diagonal; messages of the first."""
    side, at = 2 * math.ceil(1.3 * cells) + 4, (np.arange(places) + 0.5) / (2 * places)
    gaps = [sphere(side, 1 / cells, float(place)) for place in at]
    solved = [answered(partial(bem3d.solve, half_space(side, 1 / cells), gap, approach=1.0)) for gap in gaps]
    error = math.sqrt(sum((contact.stiffness() / 2 - 1) ** 2 / places for contact, _ in solved))
    return math.pi * cells**2, error, solved[0][1]


@along
def images(period: int, fine: int = 4) -> tuple[float, float, str]:
    """Approach under the force of Hertz in a period L / a, against the same cells in free space."""
    cells, dx = period * fine, 1 / fine
    press = partial(bem3d.solve, gap=sphere(cells, dx), force=HERTZ)
    imaged, message = answered(partial(press, half_space(cells, dx, periodic=True)))
    return period, abs(imaged.approach / press(half_space(cells, dx)).approach - 1), message


@along
def grid_sides(side: int, finer: int = 8) -> tuple[float, float, str]:
    """Force on grids of fewer and fewer cells a side, against a wide grid."""
    # an odd grid has a cell below the middle of the sphere, an even one has none
    dx, wide = 1 / finer, 4 * finer + side % 2
    true = bem3d.solve(half_space(wide, dx), sphere(wide, dx), approach=1.0).force
    contact, message = answered(partial(bem3d.solve, half_space(side, dx), sphere(side, dx), approach=1.0))
    return side * dx / 2, abs(contact.force / true - 1), message


@along
def strip_widths(width: int, finer: int = 8) -> tuple[float, float, str]:
    """Force on smooth strips as wide as those grids, rolled over for two cells."""
    dx, length = 1 / finer, 4 * finer

    def roll(columns: int) -> float:
        flat = np.zeros((length, columns))
        rolled = bem3d.roll(flat, spacing=dx, radius=1.0, modulus=1.0, approach=1.0, positions=2)
        return float(rolled.force[-1])

    true, (force, message) = roll(length), recorded(partial(roll, width))
    return width * dx / 2, math.inf if force is None else abs(force / true - 1), message


def spikes(heights: Values, *, finer: int = 8) -> Outcome:
    """Force with a cell in the middle that is so many d too high; measured: E* / k of that cell alone, over d."""
    dx, side = 1 / finer, 2 * math.ceil(1.5 * finer) + 1
    body, gap, middle = half_space(side, dx), sphere(side, dx), side // 2
    true = bem3d.solve(body, gap, approach=1.0).force

    def point(height: float) -> Point:
        spiked = gap.copy()
        spiked[middle, middle] -= height
        contact, message = answered(partial(bem3d.solve, body, spiked, approach=1.0, tolerance=RESIDUAL))
        return abs(contact.force / true - 1), message

    return swept(heights, *zip(*map(point, heights), strict=True), measured=1 / (LONE_CELL * dx))


def rough_grids(cells: tuple[int, ...], *, resolved: int, seed: int, finest: int = 512, force: float = 1.5) -> Outcome:
    """Contact area of periodic rough surfaces under Fbar = F / (E* h L) against the finest grid, by cells to the
    shortest wave; messages are those of drawing the surface."""
    r, surfaces = PunchRoughness(hurst=0.7, waves=(1, 8), seed=seed), range(resolved)
    true = [_area(r, finest, i, force) for i in surfaces]

    def point(n: int) -> Point:
        draw = partial(bem3d.rough_surface, r.spectrum.c2d, shape=(n, n), spacing=1 / n, rms=r.height)
        message = message_of(partial(draw, rng=random_generator(r.seed)))
        squares = sum((_area(r, n, i, force) / true[i] - 1) ** 2 for i in surfaces)
        return math.sqrt(squares / len(true)), message

    return swept(np.array(cells) / r.waves[1], *zip(*map(point, cells), strict=True))


def _area(roughness: PunchRoughness, cells: int, realisation: int, force: float) -> float:
    """True contact area under the force; infinitely wrong where the grid cannot carry the surface."""
    height, _ = recorded(partial(roughness.surface, cells, realisation))
    if height is None:
        return math.inf
    press = partial(bem3d.solve, half_space(cells, 1 / cells, periodic=True), -height)
    return answered(partial(press, force=force * roughness.height, tolerance=1e-5))[0].area


def _wave(cells: int) -> tuple[bem3d.HalfSpace, FloatArray, FloatArray]:
    """A cosine wave of unit length and amplitude in line contact: half-space, gap and x."""
    x = (np.arange(cells) + 0.5) / cells - 0.5
    body = bem3d.HalfSpace(shape=(cells, 1), spacing=1 / cells, modulus=1.0, periodic=True)
    return body, 2 * np.sin(np.pi * x[:, np.newaxis]) ** 2, x


@along
def full_contact(load: float, cells: int = 128) -> tuple[float, float, str]:
    """Force at the approach that a mean pressure over p* has; from full contact on that is the mean gap."""
    body, gap, x = _wave(cells)
    force = load * math.pi * body.cell_area * x.size
    reference, _ = answered(partial(bem3d.solve, body, gap, force=force, tolerance=1e-9))
    approach = reference.approach if load < 1 else float(gap.mean())
    contact, message = recorded(partial(bem3d.solve, body, gap, approach=approach, tolerance=RESIDUAL))
    return load, math.inf if contact is None else abs(contact.force / force - 1), message


@along
def huge_forces(load: float, cells: int = 128) -> tuple[float, float, str]:
    """Waves of the pressure in full contact under a mean pressure over p*, rms over p*."""
    body, gap, x = _wave(cells)
    press = partial(bem3d.solve, body, gap, force=load * math.pi * body.cell_area * x.size, tolerance=RESIDUAL)
    contact, _ = answered(partial(press, raise_on_failure=False))
    waves = contact.pressure[:, 0] / math.pi - load - np.cos(2 * np.pi * x)
    return load, float(np.sqrt(np.mean(waves**2))), message_of(press)


@dataclass(frozen=True, kw_only=True)
class SweepProblem:
    """probe: a function of this module; values: of its parameter; settings: of it."""

    probe: str
    values: tuple[float, ...]
    settings: tuple[tuple[str, float | str], ...] = ()


def sweep(problem: SweepProblem) -> Outcome:
    """What the probe finds at each value, as `swept` has it."""
    outcome: Outcome = globals()[problem.probe](problem.values, **dict(problem.settings))
    return outcome
