"""Reduced models of a wheel that rolls over a rough strip: force over that of Hertz at each row, and counted work.

Units: a = d = E* = 1 of the smooth wheel, so R = 1; heights over d, (along, across), periodic along the track.
Most of them are trials, which no scene is solved with: a case reports what each of them does.
"""

import math

import numpy as np
from scipy import special

import bem3d
import mdr
from mdr.rolling_surface import weights_across
from validation.engine.engine import FloatArray
from validation.simulation.pressed_layer import ACROSS, PRESSURES, Reduced, press
from validation.simulation.rolling_strip import HERTZ, SMOOTH, crop_to_reach
from validation.simulation.surface import middle_of
from validation.theory.rolling import linear_force

SPLIT = 2.0
"""q a between the long and the short waves of two scales."""
REACH = 1.5
"""Radii from the middle within which springs may touch."""
FROZEN = 0.5
"""Radii between positions whose contact gives the weights of those around them."""
TOLERANCE = 1e-4
"""Residual of boundary elements, over the rms height."""


def springs_on_a_line(strip: FloatArray, dx: float) -> Reduced:
    found = mdr.roll(strip[:, strip.shape[1] // 2], spacing=dx, **SMOOTH)
    return Reduced(found.force / HERTZ, float(found.examined.sum()))


def linear_theory(strip: FloatArray, dx: float) -> Reduced:
    return Reduced(linear_force(strip, spacing=dx, **SMOOTH) / HERTZ, float(strip.size))


def springs_that_read(strip: FloatArray, dx: float) -> Reduced:
    found = mdr.roll_surface(middle_of(strip, 1.1, dx, more=0), spacing=dx, **SMOOTH)
    return Reduced(found.force / HERTZ, float(found.examined.sum()) + math.pi / 2 * len(strip) / dx**2)


def radius_by_the_mean_force(strip: FloatArray, dx: float) -> Reduced:
    """Springs that read with the contact radius of their mean force, as its power 1/3."""
    first = springs_that_read(strip, dx)
    weights = punch_weights(strip.shape[1], dx, max(float(first.force.mean()), 0.0) ** (1 / 3))
    return Reduced(on_springs(strip @ weights, dx), 2 * first.work)


def one_sided_in_two_dimensions(strip: FloatArray, dx: float) -> Reduced:
    """max(d - x^2 + h, 0) of each cell, by the weights of the flat punch across."""
    weights, force = punch_weights(strip.shape[1], dx), np.zeros(len(strip))
    for j in range(-math.floor(1 / dx), math.floor(1 / dx) + 1):
        pressed = np.maximum(1 - (j * dx) ** 2 + strip, 0.0) @ weights[:, abs(j)]
        force += np.roll(pressed, -j) * dx
    return Reduced(force / HERTZ, math.pi * len(strip) / dx**2)


def one_sided_bed(strip: FloatArray, dx: float) -> Reduced:
    """DPRS: equal springs under a parabola, with the load, the stiffness and the patch of Hertz.

    k2 pi R' delta^2 = F and 2 F / delta = k; with F = 4/3, k = 2 and a patch of radius one, delta = 4/3, R' = 3/8,
    k2 = 2 / pi.
    """
    y, force = _across(strip.shape[1], dx), np.zeros(len(strip))
    near, reach = np.abs(y) < REACH, math.floor(REACH / dx)
    for j in range(-reach, reach + 1):
        pressed = np.maximum(4 / 3 - 4 / 3 * ((j * dx) ** 2 + y[near] ** 2) + strip[:, near], 0.0).sum(axis=1)
        force += 2 / math.pi * np.roll(pressed, -j) * dx**2
    return Reduced(force / HERTZ, len(strip) * (2 * REACH / dx) ** 2)


def two_scales_by_persson(strip: FloatArray, dx: float) -> Reduced:
    """Short waves weigh what touches, erf(sqrt(2) p / (E* g)) at the pressure of Hertz, weights of each spring one."""
    long, short = split(strip, dx)
    weights = punch_weights(strip.shape[1], dx)
    touching = weights * special.erf(math.sqrt(2) * _hertz(strip.shape[1], dx) / _gradient(short, dx))
    weighed = touching / np.maximum(touching.sum(axis=0), 1e-300)
    return Reduced(on_springs(long @ weights + short @ weighed, dx), 2 * springs_that_read(strip, dx).work)


def two_scales_pressed(strip: FloatArray, dx: float) -> Reduced:
    """Short waves as the periodic half-space deforms them under the pressure of Hertz."""
    long, short = (middle_of(one, ACROSS, dx, more=0) for one in split(strip, dx))
    layers, weights = press(short, dx), punch_weights(long.shape[1], dx)
    place = np.interp(
        np.log(np.maximum(_hertz(long.shape[1], dx), 1e-300)), np.log(PRESSURES), np.arange(len(PRESSURES))
    )
    gaps, _ = layers.law(np.log(PRESSURES))
    columns = long @ weights
    for k, gap in enumerate(gaps):
        share = weights * np.maximum(1 - np.abs(place - k), 0.0)
        columns += (np.fft.irfft(layers.height[k], len(strip), axis=0) + gap) @ share
    return Reduced(on_springs(columns, dx), layers.work)


def frozen_weights(strip: FloatArray, dx: float) -> Reduced:
    """Boundary elements at some positions; between them, their contact weighs the heights as a flat punch."""
    near = crop_to_reach(strip, dx)
    y, step = _across(near.shape[1], dx), round(FROZEN / dx)
    x = np.arange(-len(y) // 2, len(y) // 2 + 1)
    body = bem3d.HalfSpace(shape=(x.size, y.size), spacing=dx, modulus=1.0)
    wheel = ((x * dx)[:, np.newaxis] ** 2 + y**2) / 2
    total, share, work = np.zeros(len(strip)), np.zeros(len(strip)), 0
    for centre in range(0, len(strip), step):
        here = near[(centre + x) % len(strip)]
        found = bem3d.solve(body, wheel - here, approach=1.0, tolerance=1e-3)
        frozen = bem3d.solve_fixed_area(body, found.pressure > 0)
        work += (found.operator_applications + frozen.operator_applications) * 4 * x.size * y.size
        for shift in range(1 - step, step):
            changed = near[(centre + shift + x) % len(strip)] - here
            row, weight = (centre + shift) % len(strip), 1 - abs(shift) / step
            total[row] += weight * (found.force + float(np.sum(frozen.pressure * changed)) * dx**2)
            share[row] += weight
    return Reduced(total / share / HERTZ, float(work + 2 * len(strip) * x.size * y.size))


def boundary_elements(strip: FloatArray, dx: float) -> Reduced:
    """work: of windows three radii wide, doubled in free space."""
    found = bem3d.roll(crop_to_reach(strip, dx), spacing=dx, tolerance=TOLERANCE * float(strip.std()), **SMOOTH)
    cells = (2 * 3 / dx) ** 2
    return Reduced(found.force / HERTZ, float(found.operator_applications.sum()) * cells)


def split(strip: FloatArray, dx: float) -> tuple[FloatArray, FloatArray]:
    """Waves up to `SPLIT`, and those above."""
    waves = np.fft.fft2(strip)
    long = np.fft.ifft2(np.where(_wavenumbers(strip.shape, dx) <= SPLIT, waves, 0.0)).real
    return long, strip - long


def punch_weights(across: int, dx: float, radius: float = 1.0) -> FloatArray:
    """Of the springs from the middle on, by the flat punch of this radius: (across, springs)."""
    x = np.arange(math.floor(REACH / dx) + 1) * dx
    return weights_across(np.sqrt(np.maximum(radius**2 - x**2, 0.0)), across, dx)


def on_springs(read: FloatArray, dx: float) -> FloatArray:
    """dx sum max(d - x^2 + H, 0) over what the springs read, (along, springs from the middle on)."""
    force = np.zeros(len(read))
    for j in range(1 - read.shape[1], read.shape[1]):
        force += np.roll(np.maximum(1 - (j * dx) ** 2 + read[:, abs(j)], 0.0), -j) * dx
    return force / HERTZ


def _gradient(height: FloatArray, dx: float) -> float:
    """g, the root mean square of |grad h| over a period, times a / d."""
    power = (np.abs(np.fft.fft2(height, norm="forward")) * _wavenumbers(height.shape, dx)) ** 2
    return math.sqrt(float(np.sum(power)))


def _hertz(across: int, dx: float) -> FloatArray:
    """Pressure of the smooth wheel, (across, springs)."""
    x = np.arange(math.floor(REACH / dx) + 1) * dx
    return 2 / np.pi * np.sqrt(np.maximum(1 - x**2 - _across(across, dx)[:, np.newaxis] ** 2, 0.0))


def _across(points: int, dx: float) -> FloatArray:
    return np.asarray((np.arange(points) - (points - 1) / 2) * dx)


def _wavenumbers(shape: tuple[int, ...], dx: float) -> FloatArray:
    along, across = (2 * np.pi * np.fft.fftfreq(n, dx) for n in shape)
    return np.asarray(np.hypot(along[:, np.newaxis], across))
