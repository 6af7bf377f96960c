"""What is pressed, by either method: one sort of springs, or one solve of boundary elements on a grid."""

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from validation.engine.engine import FloatArray
from validation.simulation.mean_contact import RADII, GapLaw, MeanContact, mean_contact
from validation.simulation.method import Prepared, Resolution, Result, Solve, Values
from validation.simulation.surface import middle_of

MOST_ITERATIONS = 5000
"""Most iterations of Polonsky and Keer's method."""
FIXED_AREA_RESIDUAL = 1e-4
"""Residual of a fixed contact area, whose stiffness is good to some tens of times its square."""


class PressedScene(Protocol):
    """A body that is pressed onto a half-space on a grid, with an image on springs, E* = 1."""

    def load(self, cells: int) -> dict[str, float]:
        """The force or the approach that is prescribed, by its name."""

    def half_space(self, cells: int) -> bem3d.HalfSpace: ...

    def gap(self, cells: int, realisation: int) -> FloatArray:
        """The gap between the undeformed bodies at each cell of `half_space`."""

    def finish(self, contact: bem3d.Contact) -> bem3d.FixedContactArea | None:
        """The contact area that is pressed as a flat punch for its stiffness; None of a scene that needs no stiffness.

        Its seconds count as those of the solve.
        """

    def read(self, contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> Values: ...

    def profile(self, springs: float, realisation: int) -> tuple[FloatArray, float]:
        """Heights and length of the foundation. Raises ValueError where there is no image in one dimension."""

    def read_springs(self, point: mdr.LoadPoint[float]) -> Values: ...


def press_on_springs(scene: PressedScene, resolution: Resolution) -> Prepared:
    """The foundation: one sort. Raises ValueError for waves that springs do not resolve."""
    scene.profile(resolution.size, 0)

    def draw(realisation: int) -> Solve:
        height, length = scene.profile(resolution.size, realisation)

        def run() -> mdr.LoadPoint[float]:
            """The state of the springs under the force or at the approach that the scene prescribes."""
            curve = mdr.load_curve(height, length=length, modulus=1.0)
            load = scene.load(height.size)
            return curve.at_force(load["force"]) if "force" in load else curve.at_approach(load["approach"])

        return Solve(run, lambda point: Result(scene.read_springs(point), height.size))

    return draw


def press_on_grid(
    scene: PressedScene, resolution: Resolution, solver: Callable[..., bem3d.Contact] = bem3d.solve
) -> Prepared:
    """Boundary elements, from a cold start; a first solve makes plans, coarser grids and windows."""
    cells = round(resolution.size)
    half_space = scene.half_space(cells)

    def draw(realisation: int) -> Solve:
        gap = scene.gap(cells, realisation)

        def run() -> tuple[bem3d.Contact, bem3d.FixedContactArea | None]:
            contact = solver(half_space, gap, **scene.load(cells), tolerance=resolution.residual)
            return contact, scene.finish(contact)

        return Solve(run, lambda contacts: Result(scene.read(*contacts), cell_applications(*contacts)))

    draw(0).run()
    return draw


def cell_applications(contact: bem3d.Contact, fixed: bem3d.FixedContactArea | None) -> float:
    """Cells times operator applications, as if each were on the whole of its grid."""
    applications = contact.operator_applications + (fixed.operator_applications if fixed else 0)
    coarse = sum(math.prod(shape) * count for shape, count in contact.coarse_applications)
    return float(contact.pressure.size * applications + coarse)


ComplexArray = NDArray[np.complex128]

HERTZ = 4 / 3
PRESSURES = np.geomspace(0.004, 1.0, 9)
"""Mean pressures under which a layer is known [E* d / a]; the largest of Hertz is 2 / pi."""
TRIALS = (-3.0, -1.8, -1.0, -0.45, 0.0, 0.45, 1.0, 1.8, 3.0)
"""Approaches of trials about that of the wheel, over the rms height."""
TOLERANCE = 1e-2
"""Residual of the layers."""
ACROSS, ALONG = 3.0, 2.5
"""Half-widths of the strip that is pressed and of the contact, over a."""


@dataclass(frozen=True, eq=False)
class Reduced:
    """force: over that of Hertz, at each row; work: springs, cells read and cell applications, of the whole strip."""

    force: FloatArray
    work: float


@dataclass(frozen=True, eq=False)
class Layers:
    """Waves along the strip of deformed heights and of pressures, (pressures, waves, across); the law of gaps."""

    height: ComplexArray
    pressure: ComplexArray
    law: GapLaw
    points: int
    work: float


def roll_on_layer(surface: FloatArray, spacing: float) -> Reduced:
    """Roll along the middle of a strip, periodic along axis 0, heights over d; spacing over a.

    Raises ValueError where it is shorter than twice the contact that is looked at, bem3d.ConvergenceError where a layer
    does not converge.
    """
    if len(surface) * spacing < 2 * ALONG:
        raise ValueError(f"surface must be longer than {2 * ALONG:g} radii, got {len(surface) * spacing:g}")
    strip = middle_of(surface, ACROSS, spacing, more=0)
    mean, rms = float(strip.mean()), float(strip.std())
    layers = press(strip - mean, spacing)
    trials = [1 + mean + rms * t for t in TRIALS] if rms > 0 else [1 + mean]
    forces, steps = zip(*(_trial(layers, strip.shape[1], spacing, approach) for approach in trials), strict=True)
    return Reduced(_where_no_step_is_left(np.array(forces), np.array(steps), 1 + mean) / HERTZ, layers.work)


def press(strip: FloatArray, spacing: float) -> Layers:
    """A strip of mean height zero under each of the `PRESSURES`, ascending, each solved from the start.

    A layer has the Fourier coefficients along the track of the deformed height less its mean, and of the pressure less
    its mean; the means of the deformed height are the `law` of the gap. Raises bem3d.ConvergenceError.
    """
    half_space = bem3d.HalfSpace(shape=strip.shape, spacing=spacing, modulus=1.0, periodic=True)
    heights, pressures, gaps, work = [], [], [], 0
    for mean in PRESSURES:
        with warnings.catch_warnings():
            # how much of it touches is what a layer is for
            warnings.simplefilter("ignore", bem3d.ResolutionWarning)
            contact = bem3d.solve(half_space, -strip, force=mean * strip.size * spacing**2, tolerance=TOLERANCE)
        deformed = half_space.displacement(contact.pressure) - contact.approach
        gaps.append(deformed.mean())
        heights.append(np.fft.rfft(deformed - gaps[-1], axis=0))
        pressures.append(np.fft.rfft(contact.pressure - mean, axis=0))
        work += contact.operator_applications * strip.size
    # a trial correlates three fields of weights with the layers, each of which costs an application at most
    work += 3 * len(TRIALS) * len(PRESSURES) * strip.size
    return Layers(np.array(heights), np.array(pressures), GapLaw(PRESSURES, np.array(gaps)), len(strip), work)


def _trial(layers: Layers, across: int, spacing: float, approach: float) -> tuple[FloatArray, FloatArray]:
    """Force of the trial at each row, and the approach for which no step is left."""
    contact = mean_contact(layers.law, approach)
    p, tangent, displaced, share = _contact_fields(contact, across, spacing)
    # under less than the lowest pressure, the same asperities carry in proportion
    carried = share * np.minimum(p / PRESSURES[0], 1.0)

    def correlate(weights: FloatArray, fields: ComplexArray) -> FloatArray:
        padded = np.zeros((*weights.shape[:1], layers.points, across))
        reach = weights.shape[1] // 2
        padded[:, : 2 * reach + 1] = weights
        waves = np.conj(np.fft.rfft(np.roll(padded, -reach, axis=1), axis=1))
        return np.asarray(np.fft.irfft(np.sum(waves * fields, axis=(0, 2)), layers.points) * spacing**2)

    force = contact.force + correlate(carried, layers.pressure)
    step = correlate(share * tangent, layers.height) - correlate(carried * displaced, layers.pressure)
    return force, approach - step / max(contact.stiffness, 1e-9)


def _contact_fields(
    contact: MeanContact, across: int, spacing: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """p, P, K P on the cells of the contact, (along, across), and the share of each layer there, layers first [-]."""
    reach = math.floor(ALONG / spacing)
    x, y = np.arange(-reach, reach + 1)[:, np.newaxis] * spacing, (np.arange(across) - (across - 1) / 2) * spacing
    p, tangent, displaced = (
        np.interp(np.hypot(x, y), RADII, field) for field in (contact.pressure, contact.tangent, contact.displaced)
    )
    place = np.interp(np.log(np.maximum(p, 1e-300)), np.log(PRESSURES), np.arange(len(PRESSURES)))
    share = np.maximum(1 - np.abs(place - np.arange(len(PRESSURES))[:, np.newaxis, np.newaxis]), 0.0)
    return p, tangent, displaced, share


def _where_no_step_is_left(forces: FloatArray, steps: FloatArray, approach: float) -> FloatArray:
    """Between trials, (trials, rows), of ascending approach."""
    rising = np.maximum.accumulate(steps, axis=0)
    return np.array([np.interp(approach, *column) for column in zip(rising.T, forces.T, strict=True)])
