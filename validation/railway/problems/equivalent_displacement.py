"""What each model makes of a rough strip of rail: the equivalent displacement of the wheel, and the contact filter.

The equivalent displacement at constant load is -(approach - mean): by how much the roughness lifts the wheel. Its band
power over that of the line roughness is the contact filter A3. A model of one-sided contact has a linear twin, whose
filter is known without a sample: only what the model is over its twin is found on strips.

An input spectrum of springs is one of levels and has no places: a measured line, or lines, give its density and not
where the wheel is lifted. On a drawn strip the heights across are known, so each track here keeps the phases of its
surface: models on the same strip may be compared wave by wave.
"""

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

import bem3d
import mdr
from mdr.approach_by_sorting import borne_by
from validation.analysis.spectra import Bands, levels, waves
from validation.analysis.statistics import Estimate, jackknifed
from validation.engine.engine import FloatArray, Outcome
from validation.railway.problems.rail_strip import RailStrip, Transfer
from validation.railway.scenes.transverse_profile import TransverseProfile
from validation.railway.theory.contact_filters import (
    geike_over_line,
    half_space_filter,
    rolling_input_filter,
    row_of_means_filter,
    spring_bed_filter,
)
from validation.railway.theory.transverse_structure import IsotropicGround, LineSpectrum, Ridges
from validation.simulation import model_names as named
from validation.simulation.model_names import BEM, LINE, twin_of
from validation.theory.half_space import EllipticContact, elliptic_contact

LONG_ENOUGH, WIDE_ENOUGH = 3.2, 1.3
"""Length of a corrugated strip and half of its width, over the semi-axes."""
FINER = 3
"""Springs to a cell, an odd number. The ends of a contact lie between springs: near its zeros the filter of few springs
moves to and fro by up to a decibel, where boundary elements with as few cells stay."""
MOST_NUMBERS = 2**21
"""Springs of a bed times positions that are sorted at once."""


def springs_along(along: FloatArray, across: FloatArray, *, semi_axes: tuple[float, float]) -> FloatArray:
    """sin(k_x a) / (k_x a), (14.11) of springs along the track: the filter of a wave whatever its k_y.

    along, across: wavenumbers k_x and k_y [rad/m], of shapes that broadcast; a: the first of the semi-axes [m].
    """
    return np.sinc((along + 0 * across) * semi_axes[0] / np.pi)


LINEAR_MODELS: Mapping[str, Callable[..., FloatArray]] = {
    LINE: lambda along, across, **axes: np.ones_like(along + across),
    named.LINEAR: half_space_filter,
    named.BED: spring_bed_filter,
    named.LINEAR_ON_LINE: springs_along,
    named.LINEAR_ON_MEAN: row_of_means_filter,
    named.LINEAR_ROLLING: lambda *waves, **axes: rolling_input_filter(*waves, **axes) * springs_along(*waves, **axes),
}
"""H(k_x, k_y) of the smooth contact with these semi-axes."""


def transfer_of(model: str, contact: EllipticContact) -> Transfer:
    """Of one of `LINEAR_MODELS`."""
    return partial(LINEAR_MODELS[model], semi_axes=contact.semi_axes)


def geike_power(line: LineSpectrum, contact: EllipticContact, edges: FloatArray) -> FloatArray:
    """Band powers of linear springs on Geike's spectrum of the isotropic ground of a line, over those of the line [-].

    int sin^2(q a_x) / (q a_x)^2 pi q C_2D dq over int C_line dq, between ascending wavenumbers [rad/m]. Raises
    ValueError where no isotropic surface has such a line.
    """
    springs, ground = transfer_of(named.LINEAR_ON_LINE, contact), IsotropicGround(line)
    return Ridges().band_power(
        line,
        lambda along, across: np.sqrt(geike_over_line(along, ground)) * springs(along, across),
        edges=edges,
        semi_axes=contact.semi_axes,
    )


def geike_track(strip: RailStrip, line: str = LINE) -> FloatArray:
    """The middle line of an isotropic surface with each of its waves scaled to C_1D = pi |k| C_2D(|k|) of Geike's rule.

    The waves keep their phases, and the scatter of their amplitudes. line: by which of `LINEAR_MODELS`.
    """
    track = strip.along_middle(transfer_of(line, strip.contact))
    k = np.abs(2 * np.pi * np.fft.fftfreq(track.size, strip.spacing))
    of_line = strip.variance.sum(axis=1) * strip.width / (2 * math.pi)
    mapped = math.pi * k * strip.variance[:, 0] * (strip.width / (2 * math.pi)) ** 2
    ratio = np.divide(mapped, of_line, out=np.zeros_like(k), where=of_line > 0)
    return np.asarray(np.fft.ifft(np.sqrt(ratio) * np.fft.fft(track)).real)


def rolling_track(strip: RailStrip) -> FloatArray:
    """A line that has the rolling spectrum of the surface."""
    return strip.along_middle(partial(rolling_input_filter, semi_axes=strip.contact.semi_axes))


def linear_displacement(strip: RailStrip, model: str) -> FloatArray:
    """Of a model that is linear: the surface by its filter, along the middle, less its mean."""
    if model == named.LINEAR_GEIKE:
        return geike_track(strip, named.LINEAR_ON_LINE)
    return strip.along_middle(transfer_of(model, strip.contact))


def roll_boundary_elements(
    strip: RailStrip, tolerance: float, profile: TransverseProfile | None = None, first: int = 0, **settings: Any
) -> bem3d.Rolling:
    """Force, approach and area along the strip from its row `first` on, NaN where it has not converged.

    Under the load of the strip, unless settings, others of `bem3d.roll`, say another. profile: of the rail across, in
    place of its radius. Raises ValueError where the contact reaches the end of the profile.
    """
    shape: dict[str, Any] = {"radius": strip.radii}
    columns, surface = slice(None), np.roll(strip.surface, -first, axis=0)
    if profile is not None:
        columns, across = heights_across(strip, profile)
        shape = {"radius": strip.radii[0], "transverse_profile": across}
    load = {} if "approach" in settings else {"force": strip.force}
    options = {"raise_on_failure": False, **shape, **load, **settings}
    return bem3d.roll(surface[:, columns], spacing=strip.spacing, modulus=strip.modulus, tolerance=tolerance, **options)


def heights_across(strip: RailStrip, profile: TransverseProfile) -> tuple[slice, FloatArray]:
    """The columns of a strip that have the profile, and the heights there, zero at the highest [m].

    There are as many to both sides of the middle. The highest point of the profile, y = 0, is the middle of axis 1,
    over which the wheel rolls.
    """
    ny = strip.shape[1]
    y = (np.arange(ny) - (ny - 1) / 2) * strip.spacing
    inside = np.flatnonzero(np.abs(y) <= profile.reach)
    columns = slice(int(inside[0]), int(inside[-1]) + 1)
    z = profile(y[columns])
    # columns miss a top; what they miss is a constant approach
    return columns, z - z.max()


def roll_springs(
    strip: RailStrip, height: FloatArray, roll: Callable[..., mdr.RollingTrack] = mdr.roll
) -> mdr.RollingTrack:
    """One-sided springs under the load of the strip, on a line or a surface, as `roll` reads it."""
    with warnings.catch_warnings():
        # what few springs leave is measured on two grids
        warnings.simplefilter("ignore", mdr.SpringResolutionWarning)
        return roll(height, spacing=strip.spacing, radius=strip.radii, modulus=strip.modulus, force=strip.force)


def on_finer_springs(
    strip: RailStrip, height: Callable[[RailStrip], FloatArray], roll: Callable[..., mdr.RollingTrack] = mdr.roll
) -> FloatArray:
    """At the centres of the cells, with more springs than cells under the same waves."""
    fine = replace(strip, spacing=strip.spacing / FINER)
    return lifted(roll_springs(fine, height(fine), roll).approach[FINER // 2 :: FINER])


def mean_across(strip: RailStrip) -> FloatArray:
    """Of the heights across the contact, |y| < a_y."""
    return strip.along_middle(lambda x, y: np.sinc((0 * x + y) * strip.contact.across / np.pi))


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
    total_overlap = contact.force * math.pi * contact.along * contact.across / contact.stiffness / step**2

    def approach(positions: NDArray[np.int64]) -> FloatArray:
        level = surface[(positions[:, np.newaxis] + rows) % nx][:, :, near] - gap
        return borne_by(level.reshape(positions.size, -1), total_overlap).approach

    blocks = np.array_split(np.arange(nx), 1 + nx * gap.size // MOST_NUMBERS)
    return lifted(np.concatenate([approach(block) for block in blocks]))


def lifted(approach: FloatArray) -> FloatArray:
    """-(approach - mean)."""
    return np.asarray(np.mean(approach) - approach)


ONE_SIDED: Mapping[str, Callable[[RailStrip], FloatArray]] = {
    named.SPRINGS_THAT_READ: lambda strip: on_finer_springs(strip, lambda fine: fine.surface, mdr.roll_surface),
    named.SPRINGS_ON_LINE: lambda strip: on_finer_springs(strip, lambda fine: linear_displacement(fine, LINE)),
    named.SPRINGS_ON_MEAN: lambda strip: on_finer_springs(strip, mean_across),
    named.ONE_SIDED_BED: one_sided_bed,
    named.SPRINGS_ROLLING: lambda strip: lifted(roll_springs(strip, rolling_track(strip)).approach),
    named.SPRINGS_GEIKE: lambda strip: lifted(roll_springs(strip, geike_track(strip)).approach),
}
"""Displacements along a strip, beside those of boundary elements; Geike's rule is for isotropic ground alone."""


@dataclass(frozen=True, kw_only=True)
class RolledRail:
    """A strip, models of `ONE_SIDED` or boundary elements that roll over it, and the residual of these.

    profile: of the rail across, which boundary elements alone know; None for the radius of the strip.
    """

    strip: RailStrip
    models: tuple[str, ...]
    tolerance: float = 3e-6
    profile: TransverseProfile | None = None

    def __post_init__(self) -> None:
        choices = (BEM, *ONE_SIDED)
        if unknown := [name for name in self.models if name not in choices]:
            raise ValueError(f"models must be of {', '.join(choices)}, got {', '.join(unknown)}")


def roll_rail(problem: RolledRail) -> Outcome:
    """Equivalent displacement along the strip of each model and of its linear twin, by their names [m].

    failed: positions at which boundary elements did not converge: the displacement counts from its mean, which then is
    not known.
    """
    strip = problem.strip
    displacements = {twin: linear_displacement(strip, twin) for twin in map(twin_of, problem.models)}
    displacements |= {name: ONE_SIDED[name](strip) for name in problem.models if name != BEM}
    failed = 0
    if BEM in problem.models:
        rolled = roll_boundary_elements(strip, problem.tolerance, problem.profile)
        displacements[BEM] = lifted(rolled.approach)
        failed = int(np.count_nonzero(~rolled.converged))
    return {**displacements, "failed": np.array(float(failed))}


@dataclass(frozen=True, kw_only=True)
class Corrugation:
    """A ridge A cos(k x) under a wheel at constant load, a = d = 1 of the smooth contact.

    phase: k a along the track; height: A / d; crown: radius across over that along; cells: to the semi-axis along.
    """

    phase: float
    height: float
    cells: int
    crown: float = 1.0


def roll_corrugation(problem: Corrugation) -> Outcome:
    """Amplitudes of cos(k x) and cos(2 k x) of the equivalent displacement: first over A, second over A^2 / d.

    NaN where a position has not converged.
    """
    contact = elliptic_contact((1.0, problem.crown), modulus=1.0, force=1.0)
    a, d = contact.along, contact.approach
    wave = 2 * math.pi / problem.phase
    points = round(wave * problem.cells)
    waves = math.ceil(LONG_ENOUGH / wave)
    spacing, across = wave / points * a, 2 * math.ceil(WIDE_ENOUGH * contact.across / a * problem.cells) + 1
    height = problem.height * d * np.cos(2 * np.pi * np.arange(points * waves) / points)
    rolled = bem3d.roll(
        np.repeat(height[:, np.newaxis], across, axis=1),
        spacing=spacing,
        radius=(1.0, problem.crown),
        modulus=1.0,
        force=1.0,
        tolerance=1e-7,
        raise_on_failure=False,
    )
    approach = np.where(rolled.converged, rolled.approach, np.nan)
    amplitudes = 2 * np.fft.rfft(lifted(approach), norm="forward").real / (problem.height * d)
    return {
        "first": np.array(amplitudes[waves]),
        "second": np.array(amplitudes[2 * waves] / problem.height),
        "failed": np.array(float(np.count_nonzero(~rolled.converged))),
    }


def log_over(model: str, other: str, outcomes: Sequence[Outcome], spacing: float, bands: Bands) -> list[Estimate]:
    """ln of the band power of a model over that of another on the same strips, by the jackknife over strips."""
    both = [[levels(waves(outcome[name], spacing=spacing), bands) for name in (model, other)] for outcome in outcomes]

    def ratio(rows: FloatArray) -> FloatArray:
        power, reference = rows.sum(axis=0)
        return np.asarray(np.log(power / reference))

    return jackknifed(ratio, np.array(both))
