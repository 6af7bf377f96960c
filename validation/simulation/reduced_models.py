"""Reduced models of a wheel that rolls over a rough strip, beside boundary elements on the same strip.

Units: a = d = E* = 1 of the smooth wheel, so R = 1; heights over d, (along, across), periodic along the track. Forces
are over that of Hertz. Work counts springs, cells read, and cells of every application of an operator.
"""

import math
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

import bem3d
import mdr
from validation.analysis.spectra import Bands, levels, waves
from validation.engine.engine import FloatArray, Outcome
from validation.simulation.rolling_strip import HERTZ, SMOOTH, Strip, crop_to_reach
from validation.simulation.surface import middle_of
from validation.simulation.track_spectrum import PiecewisePowerLaw
from validation.theory.rolling import linear_force

REACH = 1.5
"""Radii from the middle within which springs of the bed may touch."""
TOLERANCE = 1e-4
"""Residual of boundary elements, over the rms height."""


@dataclass(frozen=True, eq=False)
class Rolled:
    """force, and of boundary elements the area over that of the smooth wheel, at each row; work of the whole strip."""

    force: FloatArray
    work: float
    area: FloatArray | None = None


def springs_on_a_line(strip: FloatArray, dx: float) -> Rolled:
    """MDR on the middle line of the strip."""
    rolling = mdr.roll(strip[:, strip.shape[1] // 2], spacing=dx, **SMOOTH)
    return Rolled(rolling.force / HERTZ, float(rolling.examined.sum()))


def linear_theory(strip: FloatArray, dx: float) -> Rolled:
    """Linear theory of the half-space, a contact that keeps its radius."""
    return Rolled(linear_force(strip, spacing=dx, **SMOOTH) / HERTZ, float(strip.size))


def springs_that_read(strip: FloatArray, dx: float) -> Rolled:
    """MDR springs, each of which reads the surface on its circle, within 1.1 radii of the middle."""
    rolling = mdr.roll_surface(middle_of(strip, 1.1, dx, more=0), spacing=dx, **SMOOTH)
    return Rolled(rolling.force / HERTZ, float(rolling.examined.sum()) + math.pi / 2 * len(strip) / dx**2)


def one_sided_bed(strip: FloatArray, dx: float) -> Rolled:
    """DPRS: equal springs under a parabola, with the load, the stiffness and the patch of Hertz.

    k2 pi R' delta^2 = F and 2 F / delta = k; with F = 4/3, k = 2 and a patch of radius one, delta = 4/3, R' = 3/8,
    k2 = 2 / pi.
    """
    y, force = (np.arange(strip.shape[1]) - (strip.shape[1] - 1) / 2) * dx, np.zeros(len(strip))
    near, reach = np.abs(y) < REACH, math.floor(REACH / dx)
    for j in range(-reach, reach + 1):
        pressed = np.maximum(4 / 3 - 4 / 3 * ((j * dx) ** 2 + y[near] ** 2) + strip[:, near], 0.0).sum(axis=1)
        force += 2 / math.pi * np.roll(pressed, -j) * dx**2
    return Rolled(force / HERTZ, len(strip) * (2 * REACH / dx) ** 2)


def boundary_elements(strip: FloatArray, dx: float) -> Rolled:
    """work: of windows three radii wide, doubled in free space; a position that does not converge has no force."""
    rolling = bem3d.roll(
        crop_to_reach(strip, dx),
        spacing=dx,
        tolerance=TOLERANCE * float(strip.std()),
        raise_on_failure=False,
        **SMOOTH,
    )
    work = float(rolling.operator_applications.sum()) * (2 * 3 / dx) ** 2
    return Rolled(rolling.force / HERTZ, work, rolling.area / math.pi)


Solve = Callable[[FloatArray, float], Rolled]

JUDGE, LINE, LINEAR = "boundary elements", "springs on a line", "linear theory, 3D"
READ, BED = "springs that read the surface", "one-sided bed (DPRS)"
COARSE, COARSEST = "boundary elements, 1/2 of the cells", "boundary elements, 1/3 of the cells"
MODELS: Mapping[str, tuple[Solve, int]] = {
    JUDGE: (boundary_elements, 1),
    LINE: (springs_on_a_line, 1),
    LINEAR: (linear_theory, 1),
    READ: (springs_that_read, 1),
    BED: (one_sided_bed, 1),
    COARSE: (boundary_elements, 2),
    COARSEST: (boundary_elements, 3),
}
"""With the cells to a contact radius, of which it has one in so many."""


def bands_of(spectrum: PiecewisePowerLaw) -> Bands:
    """Octaves from the longest wave on."""
    first, last = spectrum.edges[0], spectrum.edges[-1]
    return Bands(tuple(first * 2**k for k in range(math.floor(math.log2(last / first) + 1e-9) + 1)))


def roll_by_all(strip: Strip) -> Outcome:
    """Models in the order of `MODELS`: level in each octave (models, octaves), and work of the whole strip (models,).

    kept: area of contact on boundary elements over that of a smooth wheel under the same force, which is as its power
    2/3; failed: models with a position that did not converge, which have no level.
    """
    rolled = {name: _roll_model(strip, solve, coarser) for name, (solve, coarser) in MODELS.items()}
    spacings = [coarser / strip.cells for _, coarser in MODELS.values()]
    bands = bands_of(strip.scene.spectrum)
    pairs = zip(rolled.values(), spacings, strict=True)
    judge = rolled[JUDGE]
    assert judge.area is not None
    return {
        "level": np.array([levels(waves(result.force, spacing=spacing), bands) for result, spacing in pairs]),
        "work": np.array([result.work for result in rolled.values()]),
        "kept": np.array(judge.area.mean() / (np.maximum(judge.force, 0.0) ** (2 / 3)).mean()),
        "failed": np.array(float(sum(np.isnan(result.force).any() for result in rolled.values()))),
    }


def _roll_model(strip: Strip, solve: Solve, coarser: int) -> Rolled:
    """One model on the strip with fewer cells: one to each `coarser` of them along and across."""
    cells = strip.cells // coarser
    with warnings.catch_warnings():
        # what fewer cells change is compared, or small beside what the models leave
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        return solve(replace(strip, cells=cells).surface(), 1 / cells)
