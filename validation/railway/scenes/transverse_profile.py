"""A measured profile across the track, of a rail, a wheel or both together: heights over y in place of a radius."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from mdr.checks import finite
from validation.analysis.escapes import printable
from validation.analysis.statistics import FloatArray
from validation.scenes.number_table import NumberTable
from validation.scenes.reader import Reader, errors_of, table, values, yes_or_no
from validation.scenes.table_files import FORM, heights_of_columns, read_scene_table, sentence_about
from validation.scenes.units import LENGTHS, in_unit, unit_of
from validation.theory.half_space import elliptic_contact

FEWEST, MOST = 7, 100_000
"""Points of a profile."""
IN_CONTACT = 5
"""Points of a profile in the contact, at the least: with fewer its shape there is not known."""
REACH = 2.0
"""Semi-axes across that a profile has on both sides of its highest point, at the least."""
STRAIGHT = 100.0
"""Radius across over that along, at the most: straighter is no contact of an ellipse."""
STEPS, CLOSE = 60, 1e-9
"""Widths over which a radius is fitted at first, from wide to narrow; relative error of the one at last."""
DENSE = 20_001
"""Places at which the highest point of two bodies is looked for, and a second contact."""
SAME_PLACE = 1e-6
"""How close points of two profiles are one [m]."""
STEEPEST = math.radians(15)
"""Inclination of the bodies in contact, at the most: there the normal load is 4 % more than the wheel's."""


@dataclass(frozen=True, kw_only=True)
class TransverseProfile:
    """Heights over the places across, a cubic spline between them.

    y: places across the track, ascending [m]; height: of the body there, positive towards the other body [m]; source:
    where they come from; of both bodies together, at: where y = 0 is on the rail [m], inclination: of the bodies there
    [rad]. Raises ValueError or TypeError for fewer than seven points, places that do not ascend, and values that are no
    finite numbers.
    """

    y: tuple[float, ...]
    height: tuple[float, ...]
    source: str = "given"
    at: float = 0.0
    inclination: float = 0.0

    def __post_init__(self) -> None:
        for name in ("y", "height"):
            values = [finite(f"{name}[{i}]", value) for i, value in enumerate(getattr(self, name))]
            object.__setattr__(self, name, tuple(values))
        if not FEWEST <= len(self.y) <= MOST or len(self.height) != len(self.y):
            raise ValueError(
                f"profile must have {FEWEST} to {MOST} points, a y and a height each, got {len(self.y)} and "
                f"{len(self.height)}"
            )
        if not (np.diff(self.y) > 0).all():
            at = int(np.argmax(np.diff(self.y) <= 0))
            raise ValueError(f"y must ascend, got {self.y[at + 1]:g} m behind {self.y[at]:g} m")

    def __call__(self, y: ArrayLike) -> FloatArray:
        """Heights at places across, of any shape [m]; NaN beyond both ends."""
        return np.asarray(self._spline(np.asarray(y, dtype=np.float64)))

    def moved(self, offset: float) -> "TransverseProfile":
        """The same, its y = 0 at another place across the track [m]."""
        return replace(self, y=tuple(place + offset for place in self.y))

    def within(self, half_width: float) -> "TransverseProfile":
        """The part with abs(y) up to a half width [m]."""
        kept = [i for i, place in enumerate(self.y) if abs(place) <= half_width]
        return replace(self, y=tuple(self.y[i] for i in kept), height=tuple(self.height[i] for i in kept))

    def slope(self, y: float) -> float:
        """dz/dy at a place [-]."""
        return float(self._spline(y, 1))

    @property
    def reach(self) -> float:
        """How far it goes from y = 0 to the nearer end [m]."""
        return min(-self.y[0], self.y[-1])

    @cached_property
    def _spline(self) -> "scipy.interpolate.CubicSpline":
        return scipy.interpolate.CubicSpline(self.y, self.height, extrapolate=False)

    def radius_within(self, half_width: float) -> float:
        """R of the parabola c_0 + c_1 y - y^2 / (2 R) of least squares over abs(y) < half_width [m].

        half_width: positive, within the reach [m]. Infinite where the profile does not fall from its middle.
        """
        t = np.linspace(-1, 1, 101)
        curvature = -2 * float(np.polyfit(t, self(t * half_width), 2)[0]) / half_width**2
        return 1 / curvature if curvature > 0 else math.inf


def both_together(bodies: Sequence[TransverseProfile], curvature: float, centre: float = 0.0) -> TransverseProfile:
    """Wheel and rail as one profile over a plane: their heights added, zero at the highest point, which is y = 0.

    There the gap of both is smallest, and the smooth bodies touch first. bodies: with a profile, one or two, their y of
    the same place across the track; curvature: of the one without, zero where it is straight [1/m]; centre: where that
    one is highest [m]. Raises ValueError where two have no common width, are highest at an end of it, or touch on a
    flank steeper than `STEEPEST`.
    """
    first, last = max(body.y[0] for body in bodies), min(body.y[-1] for body in bodies)
    if not first < last:
        raise ValueError(
            f"profile of wheel and rail must have places in common, got one from {1e3 * first:.4g} mm on and one up to "
            f"{1e3 * last:.4g} mm: wheel.offset moves the wheel"
        )

    def height(at: FloatArray) -> FloatArray:
        return np.asarray(sum((body(at) for body in bodies), -curvature * (at - centre) ** 2 / 2))

    dense = np.linspace(first, last, DENSE)
    at = int(np.argmax(height(dense)))
    if not 0 < at < DENSE - 1:
        raise ValueError(
            f"profile of wheel and rail together must be highest between its ends, {1e3 * first:.4g} and "
            f"{1e3 * last:.4g} mm, got its highest point at {1e3 * dense[at]:.4g} mm: heights must be positive towards "
            "the other body (flip = true turns them), and y of both must have the flange on one side (wheel.offset)"
        )
    top = float(dense[at])
    inclination = math.atan(abs(bodies[0].slope(top)))
    if inclination > STEEPEST:
        raise ValueError(
            f"profile of wheel and rail must touch where both are level, to {math.degrees(STEEPEST):.3g} degrees, got "
            f"contact at {1e3 * top:.4g} mm on a flank of {math.degrees(inclination):.3g} degrees: see wheel.offset"
        )
    own = np.unique(np.concatenate([body.y for body in bodies]))
    y = own[(own >= first) & (own <= last)]
    # the same place in both files, but for rounding, is one
    y = y[np.append(True, np.diff(y) > SAME_PLACE)]
    heights = height(y) - height(np.array([top]))
    return TransverseProfile(
        y=tuple((y - top).tolist()),
        height=tuple(heights.tolist()),
        source=" and ".join(body.source for body in bodies),
        at=top,
        inclination=inclination,
    )


def fitted_radius(profile: TransverseProfile, *, along: float, modulus: float, load: float) -> float:
    """The radius across that a profile has by least squares over the ellipse of contact of that same radius [m].

    Hertz's contact with (along, R) has the semi-axis a_y; R is that of the parabola over abs(y) < a_y. profile: highest
    at y = 0; along: the radius along the track [m]; modulus: E* [Pa]; load [N]. Raises ValueError for a profile that is
    narrower than twice the contact, has fewer than five points in it, does not fall from its highest point, or touches
    in a second place.
    """

    def wider(half_width: float) -> float:
        """By how much the contact is wider than what a radius was fitted over, of its logarithm."""
        radius = min(profile.radius_within(half_width), STRAIGHT * along)
        return math.log(elliptic_contact((along, radius), modulus=modulus, force=load).across / half_width)

    least, most = float(np.sort(np.abs(profile.y))[IN_CONTACT - 1]), profile.reach / REACH
    if not least < most or wider(most) > 0:
        raise ValueError(
            f"profile must reach to twice the contact and have {IN_CONTACT} points in it at the least, got "
            f"{1e3 * profile.reach:.4g} mm to the nearer end, and a contact of more than {1e3 * most:.4g} mm to a side"
        )
    # from wide to narrow: over a few points a radius is that of noise
    half_widths = np.geomspace(most, least, STEPS)
    narrower = next((half for half in half_widths[1:] if wider(half) >= 0), None)
    if narrower is None:
        raise ValueError(
            f"profile must have {IN_CONTACT} points in the contact at the least, got so many within "
            f"{1e3 * least:.3g} mm of its highest point, and a contact that is narrower"
        )
    least, most = narrower, float(half_widths[np.searchsorted(-half_widths, -narrower) - 1])
    half_width = float(scipy.optimize.brentq(wider, least, most, rtol=CLOSE))
    radius = profile.radius_within(half_width)
    _check_alone(
        profile, half_width, elliptic_contact((along, radius), modulus=modulus, force=load).approach, load / modulus
    )
    return radius


def _check_alone(profile: TransverseProfile, half_width: float, approach: float, force: float) -> None:
    """Raises ValueError where the bodies touch in a second place, such as a flange.

    Away from the contact the gap is that of the profile and F / (pi E* r), by which the surfaces give way there, less
    the approach. force: over E* [m^2].
    """
    y = np.linspace(profile.y[0], profile.y[-1], DENSE)
    y = y[np.abs(y) > REACH * half_width]
    gap = force / (math.pi * np.abs(y)) - profile(y) - approach
    if y.size and gap.min() < 0:
        second = float(y[int(gap.argmin())])
        raise ValueError(
            f"profile must have one contact under the load, got a second one {1e3 * second:+.3g} mm beside that at "
            f"{1e3 * profile.at:.4g} mm of the rail, where both bodies overlap by {-1e6 * gap.min():.3g} um: "
            "wheel.offset moves the wheel"
        )


# Of a file in a scene


COLUMNS = "y [mm],height [mm]"
"""The header of a file, in other units of length too."""
BACK, HIDDEN, FLANK = 1e-4, 1e-3, 2e-3
"""How far points of a flank may turn back, lie below the profile, where the other body never comes, and beyond [m]."""
APART = 1e-6
"""How far apart points are, at the least [m]: between closer ones a spline would follow their noise."""
KNOTS, TO_A_KNOT = 1e-3, 6
"""Distance of the knots of the spline that smooths a profile [m], with so many points to each or more."""


def profile_in(name: str, value: object, *, folder: Path, notes: list[str]) -> TransverseProfile:
    """Of a file beside a scene: its name, or a table that has it and says how to read it. y runs in either order.

    notes: takes what was assumed. Raises OSError for a file that cannot be read, ValueError for one that holds none.
    """
    readers: dict[str, Reader] = {**values("file"), "unit": unit_of, "flip": yes_or_no, **FORM}
    entries = table(readers, tuple(readers)[1:], name, {"file": value} if isinstance(value, str) else value)
    key = name if isinstance(value, str) else f"{name}.file"
    path, numbers = read_scene_table(name, entries, folder, key=key)
    with errors_of(f"{key} {printable(path)}: "):
        y, height = _in_metres(numbers, entries.get("unit"))
        has_both = np.isfinite(y) & np.isfinite(height)
        y, height, of_ends = _ascending(y[has_both], height[has_both] * (-1 if entries.get("flip") else 1))
        smooth, of_noise = _smoothed(y, height)
        profile = TransverseProfile(y=tuple(y.tolist()), height=tuple(smooth.tolist()), source=path.name)
    missing = int((~has_both).sum())
    of_missing = (f"{missing} of its points have no data and are left out",) if missing else ()
    notes += sentence_about(path, (*numbers.notes, *of_missing, *of_ends, *of_noise))
    return profile


def _in_metres(table: NumberTable, metre: float | None) -> tuple[FloatArray, FloatArray]:
    """Places and heights [m]. Raises ValueError."""
    lengths = [i for i, column in enumerate(table.columns) if column.unit in LENGTHS]
    if len(lengths) == 2:
        table = table.chosen([i + 1 for i in lengths])
    columns = table.columns
    if len(columns) != 2:
        raise ValueError(
            f"a profile must have two columns, as {COLUMNS!r}, got {table.names(range(len(columns)))}: say which to "
            f"read, as: columns = [{len(columns) - 1}, {len(columns)}]"
        )
    if metre is None and not (table.unit or all(column.unit for column in columns)):
        raise ValueError(
            f'the columns must be named as {COLUMNS!r}, with their units, got {table.names([0, 1])}: or as: unit = "mm"'
        )
    of_y = 1 if columns[1].name.lower() == "y" and columns[0].name.lower() != "y" else 0
    return heights_of_columns(table, [of_y], metre)[:, 0], heights_of_columns(table, [1 - of_y], metre)[:, 0]


def _ascending(y: FloatArray, height: FloatArray) -> tuple[FloatArray, FloatArray, tuple[str, ...]]:
    """From the highest point to both sides, as far as places ascend. Beyond, flanks turn back under the profile.

    Raises ValueError where points that are left out would be seen by the other body.
    """
    if y.size < 2:
        return y, height, ()
    top = int(np.argmax(height))
    if y[max(top - 1, 0)] > y[min(top + 1, y.size - 1)]:
        y, height, top = y[::-1], height[::-1], y.size - 1 - top
    kept = np.concatenate([top - _onward(-y[top::-1])[:0:-1], top + _onward(y[top:])])
    run, of_run = y[kept], height[kept]
    if run.size < 2:
        raise ValueError(f"y must ascend, got {y[0]:g} m first and {y[-1]:g} m last, and nowhere two in a row")
    rest = np.setdiff1d(np.arange(y.size), kept)
    below = height[rest] < np.interp(y[rest], run, of_run) - HIDDEN
    next_to = np.searchsorted(run, y[rest]).clip(1, run.size - 1)
    near = np.minimum(np.abs(run[next_to] - y[rest]), np.abs(run[next_to - 1] - y[rest])) <= BACK
    beyond = (y[rest] < run[0] - FLANK) | (y[rest] > run[-1] + FLANK)
    if ((~below & ~near) | beyond).any():
        at = int(np.argmax(np.diff(y) <= 0))
        raise ValueError(f"y must ascend, got {y[at + 1]:g} m behind {y[at]:g} m")
    span = [in_unit(end, "length") for end in (run[0], run[-1])]
    note = f"it goes from {span[0]} to {span[1]} across: {rest.size} points that turn back are left out"
    return run, of_run, (note,) if rest.size else ()


def _onward(y: FloatArray) -> NDArray[np.intp]:
    """Those that go on upwards, up to where places turn back by more than a flank scatters."""
    most = np.maximum.accumulate(y)
    turned = np.flatnonzero(most - y > BACK)
    return np.flatnonzero(np.append(True, y[1:] > most[:-1] + APART)[: turned[0] if turned.size else y.size])


def _smoothed(y: FloatArray, height: FloatArray) -> tuple[FloatArray, tuple[str, ...]]:
    """A cubic spline of least squares through many points: what is shorter than its knots is noise, or roughness."""
    if y.size < 2 * TO_A_KNOT:
        return height, ()
    each = round(KNOTS / float(np.median(np.diff(y))))
    if not TO_A_KNOT <= each < y.size / TO_A_KNOT:
        return height, ()
    knots = np.concatenate([y[[0] * 4], y[each:-each:each], y[[-1] * 4]])
    smooth = np.asarray(scipy.interpolate.make_lsq_spline(y, height, knots)(y))
    off = in_unit(float(np.sqrt(np.mean((smooth - height) ** 2))), "length", digits=2)
    return smooth, (
        f"a spline with a knot every {in_unit(KNOTS, 'length')} smooths its points, which are {off} rms off it",
    )
