"""What each model makes of a rough strip: the equivalent displacement of the wheel, and the contact filter.

The equivalent displacement at constant load is -(approach - mean): by how much the roughness lifts the wheel. Its band
power over that of the line roughness is the contact filter A3. A model of one-sided contact has a linear twin, whose
filter is known without a sample: only what the model is over its twin is found on strips.
"""

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from mdr.approach_by_sorting import borne_by
from validation.analysis.spectra import Bands, levels, waves
from validation.analysis.statistics import Estimate, jackknifed
from validation.engine.engine import Outcome
from validation.simulation.model_names import (
    BED,
    BEM,
    LINE,
    LINEAR,
    LINEAR_ON_LINE,
    LINEAR_ON_MEAN,
    ONE_SIDED_BED,
    SPRINGS_ON_LINE,
    SPRINGS_ON_MEAN,
    SPRINGS_THAT_READ,
)
from validation.simulation.rail_strip import RailStrip, Transfer
from validation.theory.contact_filters import half_space_filter, row_of_means_filter, spring_bed_filter
from validation.theory.elliptic_contact import EllipticContact

__all__ = ["BED", "BEM", "LINE", "LINEAR", "LINEAR_ON_LINE", "LINEAR_ON_MEAN", "ONE_SIDED_BED"]
__all__ += ["SPRINGS_ON_LINE", "SPRINGS_ON_MEAN", "SPRINGS_THAT_READ"]
"""Names of models, for cases that compare the filters of this module."""
FloatArray = NDArray[np.float64]

AREA = "area in contact"
FINER = 3
"""Springs to a cell, an odd number. The ends of a contact lie between springs: near its zeros the filter of few springs
moves to and fro by up to a decibel, where boundary elements with as few cells stay."""
MOST_NUMBERS = 2**21
"""Springs of a bed times positions that are sorted at once."""


def _axes(contact: EllipticContact) -> tuple[float, float]:
    return contact.along, contact.across


LINEAR_MODELS: Mapping[str, Callable[[EllipticContact], Transfer]] = {
    LINE: lambda contact: lambda along, across: np.ones_like(along + across),
    LINEAR: lambda contact: lambda along, across: half_space_filter(along, across, semi_axes=_axes(contact)),
    BED: lambda contact: lambda along, across: spring_bed_filter(along, across, semi_axes=_axes(contact)),
    LINEAR_ON_LINE: lambda contact: lambda along, across: np.sinc((along + 0 * across) * contact.along / np.pi),
    LINEAR_ON_MEAN: lambda contact: lambda along, across: row_of_means_filter(along, across, semi_axes=_axes(contact)),
}
"""From the smooth contact to H(k_x, k_y)."""


def roll_boundary_elements(strip: RailStrip, tolerance: float) -> bem3d.Rolling:
    """Force, approach and area along the strip, NaN where it has not converged."""
    return bem3d.roll(
        strip.surface,
        spacing=strip.spacing,
        radius=strip.radii,
        modulus=strip.modulus,
        force=strip.force,
        tolerance=tolerance,
        raise_on_failure=False,
    )


def springs_that_read(strip: RailStrip) -> FloatArray:
    """Springs that read the surface across the contact."""
    return _on_springs(strip, mdr.roll_surface, lambda fine: fine.surface)


def springs_on_line(strip: RailStrip) -> FloatArray:
    """Springs under the middle line."""
    return _on_springs(strip, mdr.roll, lambda fine: fine.along_middle(LINEAR_MODELS[LINE](fine.contact)))


def springs_on_mean(strip: RailStrip) -> FloatArray:
    """Springs under the mean of the heights across the contact, |y| < a_y."""
    b = strip.contact.across
    return _on_springs(strip, mdr.roll, lambda fine: fine.along_middle(lambda x, y: np.sinc((0 * x + y) * b / np.pi)))


def _on_springs(
    strip: RailStrip, roll: Callable[..., mdr.RollingTrack], height: Callable[[RailStrip], FloatArray]
) -> FloatArray:
    """At the centres of the cells, with more springs than cells under the same waves."""
    fine = replace(strip, spacing=strip.spacing / FINER)
    with warnings.catch_warnings():
        # what few springs leave is measured on two grids
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        found = roll(height(fine), spacing=fine.spacing, radius=fine.radii, modulus=fine.modulus, force=fine.force)
    return lifted(found.approach[FINER // 2 :: FINER])


def one_sided_bed(strip: RailStrip) -> FloatArray:
    """Springs, a patch of them, that do not pull: the sum of kappa max(d - g + h, 0) dA over the cells is the force.

    Patch, force and stiffness of the smooth wheel are those of Hertz: kappa = k / (pi a b), d = 2 F / k, and
    g = d (x^2 / a^2 + y^2 / b^2).
    """
    contact, surface, step = strip.contact, strip.surface, strip.spacing
    depth, (nx, ny) = 2 * contact.force / contact.stiffness, surface.shape
    share = math.sqrt(1 + float(np.ptp(surface)) / depth)
    reach = math.ceil(share * contact.along / step)
    rows, y = np.arange(-reach, reach + 1), (np.arange(ny) - (ny - 1) / 2) * step
    near = np.abs(y) <= share * contact.across
    gap = depth * ((rows * step / contact.along)[:, np.newaxis] ** 2 + (y[near] / contact.across) ** 2)
    wanted = contact.force * math.pi * contact.along * contact.across / contact.stiffness / step**2

    def approach(positions: NDArray[np.int64]) -> FloatArray:
        level = surface[(positions[:, np.newaxis] + rows) % nx][:, :, near] - gap
        return borne_by(level.reshape(positions.size, -1), wanted).approach

    blocks = np.array_split(np.arange(nx), 1 + nx * gap.size // MOST_NUMBERS)
    return lifted(np.concatenate([approach(block) for block in blocks]))


def lifted(approach: FloatArray) -> FloatArray:
    """-(approach - mean)."""
    return np.asarray(np.mean(approach) - approach)


ONE_SIDED: Mapping[str, Callable[[RailStrip], FloatArray]] = {
    SPRINGS_THAT_READ: springs_that_read,
    SPRINGS_ON_LINE: springs_on_line,
    SPRINGS_ON_MEAN: springs_on_mean,
    ONE_SIDED_BED: one_sided_bed,
}
"""Displacements along a strip, beside those of boundary elements."""


@dataclass(frozen=True, kw_only=True)
class RolledRail:
    """A strip, models of `ONE_SIDED` or boundary elements that roll over it, and the residual of these."""

    strip: RailStrip
    models: tuple[str, ...]
    tolerance: float = 3e-6

    def __post_init__(self) -> None:
        known = (BEM, *ONE_SIDED)
        if unknown := [name for name in self.models if name not in known]:
            raise ValueError(f"models must be of {', '.join(known)}, got {', '.join(unknown)}")


def roll_rail(problem: RolledRail) -> Outcome:
    """Equivalent displacement along the strip of each model and of all linear ones, by their names [m].

    area in contact: of boundary elements, over that of the smooth wheel; failed: positions at which they did not
    converge: the displacement counts from its mean, which then is not known.
    """
    strip, contact = problem.strip, problem.strip.contact
    linear = {name: strip.along_middle(transfer(contact)) for name, transfer in LINEAR_MODELS.items()}
    found = {name: ONE_SIDED[name](strip) for name in problem.models if name != BEM}
    failed = 0
    if BEM in problem.models:
        rolled = roll_boundary_elements(strip, problem.tolerance)
        found |= {BEM: lifted(rolled.approach), AREA: rolled.area / (math.pi * contact.along * contact.across)}
        failed = int(np.count_nonzero(~rolled.converged))
    return {**linear, **found, "failed": np.array(float(failed))}


def band_powers(outcomes: Sequence[Outcome], name: str, spacing: float, bands: Bands) -> FloatArray:
    """Of the tracks with a name, (strips, bands); NaN in strips that failed [m^2]."""
    return levels(waves(np.array([outcome[name] for outcome in outcomes]), spacing=spacing), bands)


def log_over(model: str, other: str, outcomes: Sequence[Outcome], spacing: float, bands: Bands) -> list[Estimate]:
    """ln of the band power of a model over that of another on the same strips, by the jackknife over strips."""
    both = np.stack([band_powers(outcomes, name, spacing, bands) for name in (model, other)], axis=1)

    def ratio(rows: FloatArray) -> FloatArray:
        mine, reference = rows.sum(axis=0)
        return np.asarray(np.log(mine / reference))

    return jackknifed(ratio, both)
