"""Measured heights of an object that has them, and as they were asked for: cropped, filled in."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.checks import positive
from validation.scenes.height_edits import edited, real_numbers
from validation.scenes.measured import MeasuredHeights, check_grid
from validation.scenes.printable import shortened
from validation.scenes.units import UNITS

FloatArray = NDArray[np.float64]

SMALL = {"Å": Fraction(1, 10**10), "A": Fraction(1, 10**10), "pm": Fraction(1, 10**12)}
"""Units of the atomic force microscope, over a metre; A is how SurfaceTopography writes Å in ASCII."""
LENGTHS = UNITS["length"] | SMALL


def measured(surface: Any, *, unit: str | None = None, crop: bool = False, fill: bool = False) -> MeasuredHeights:
    """Measured heights of any object with heights and a size, as the `Topography` of SurfaceTopography.

    Parameters
    ----------
    surface : object
        With ``heights``, an array of shape (nx, ny) or a method that returns one, and ``physical_sizes``, (Lx, Ly).
        Both are in the unit that ``surface.unit`` or ``surface.info["unit"]`` names, or in the given one.
    unit : str or None, optional
        Of an object that names none: "m", "mm", "um", "nm" or another length. None: the object names it.
    crop : bool, optional
        Whether to cut out the central square, as the face of a punch needs it.
    fill : bool, optional
        Whether to fill in points without data, NaN or masked, where they are fewer than 1 %: by harmonic interpolation
        from their neighbours.

    Returns
    -------
    MeasuredHeights
        Heights about their mean plane, for the ``ground`` of a scene. Its notes and the description of the scene say
        what was cropped and filled in.

    Raises
    ------
    TypeError
        If the object has no heights or no size, or ``crop`` or ``fill`` are no bool.
    ValueError
        If points have no data and are not to be filled in or are too many, heights are infinite, there is no square to
        crop, sizes are not valid, or there is no unit, or more than one.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> heights = np.random.default_rng(1).standard_normal((64, 64))
    >>> face = validation.measured(SimpleNamespace(heights=heights, physical_sizes=(1000, 1000), unit="um"))
    >>> print(f"rms height {face.rms:.3g} m on {face.sides[0]:.3g} m")
    rms height 1e-06 m on 0.001 m
    """
    if not (hasattr(surface, "heights") and hasattr(surface, "physical_sizes")):
        raise TypeError(f"surface must have heights and physical_sizes, got {type(surface).__name__}")
    for name, wish in (("crop", crop), ("fill", fill)):
        if not isinstance(wish, bool):
            raise TypeError(f"{name} must be True or False, got {shortened(wish)}")
    height = real_numbers(surface.heights() if callable(surface.heights) else surface.heights)
    sizes = surface.physical_sizes
    if not isinstance(sizes, (Sequence, np.ndarray)) or height.ndim != 2 or len(sizes) != 2:
        raise ValueError(
            f"heights must be two-dimensional with two physical_sizes, got shape {height.shape} and {shortened(sizes)}"
            ": an object is right that has an array of shape (nx, ny) and physical_sizes=(Lx, Ly)"
        )
    lengths = [positive(f"physical_sizes[{i}]", size) for i, size in enumerate(sizes)]
    metres = _metres(surface, unit)
    sides = [length * metres for length in lengths]
    spacing = sides[0] / max(height.shape[0], 1), sides[1] / max(height.shape[1], 1)
    return as_asked(height * metres, spacing, crop=crop, fill=fill, asked_by="fill=True")


def as_asked(
    height: FloatArray,
    spacing: tuple[float, float],
    *,
    crop: bool,
    fill: bool,
    asked_by: str,
    told: tuple[str, ...] = (),
) -> MeasuredHeights:
    """Heights in metres, NaN where there are no data, after the edits that were asked for.

    asked_by: how fill is asked for; told: what was assumed of their file. Raises ValueError as `edited` and
    `MeasuredHeights`.
    """
    check_grid(height)
    part, done = edited(height, spacing, crop=crop, fill=fill, asked_by=asked_by)
    return MeasuredHeights(height=part, spacing=spacing, edits=replace(done, told=told))


def _metres(surface: Any, given: str | None) -> float:
    """The unit of a surface, as it names it or as it is given. Raises ValueError for none, and for two."""
    info = getattr(surface, "info", None)
    unit = getattr(surface, "unit", None)
    noted = info.get("unit") if isinstance(info, Mapping) else None
    named = {"unit": unit, "info": noted, "unit=": given}
    factors = {metres_of("unit of the surface", one) for one in named.values() if one}
    if not factors:
        raise ValueError(
            'unit of the surface must be known, got an object that names none: measured(surface, unit="m") says it'
        )
    if len(factors) > 1:
        shown = " and ".join(f"{name} {shortened(one)}" for name, one in named.items() if one)
        raise ValueError(f"unit of the surface must be one, got {shown}")
    return factors.pop()


def metres_of(name: str, unit: object) -> float:
    """How many metres a unit of heights is. Raises ValueError that begins with the name."""
    # the micro sign and the Greek letter look the same, as do the letter and the sign of an angstrom
    found = LENGTHS.get(str(unit).strip().replace("\N{GREEK SMALL LETTER MU}", "µ").replace("\N{ANGSTROM SIGN}", "Å"))
    if found is None:
        raise ValueError(f"{name} must be one of {', '.join(LENGTHS)}, got {shortened(unit)}")
    return float(found)
