"""Warnings of springs: too few of them, or a linear contact beyond its range."""

import math
import warnings

import numpy as np
from numpy.typing import NDArray

from mdr.checks import FloatArray

FEWEST_SPRINGS = 16
FEWEST_SPRINGS_A_WAVE = 4.0
LARGEST_PART = 0.1
STEEPEST_SLOPE = 10.0
"""Of the median spring, 84 degrees: the roughest surfaces have an rms slope about 1, a half-space needs less."""
FLATTEST_PROFILE, ROUNDING = 1e-9, 1e-12
"""Its range over its length, 1 nm over 1 m; over its largest height, where heights are equal but for rounding."""
MOST_LINES = 64
"""Profiles, and rows of a surface, of which the slope is taken."""


class SpringContactWarning(UserWarning):
    """A result of springs may not be the one that was meant.

    The base class of the warnings of `mdr`: the problem was solved as it was given. The text has no numbers of the
    call, so that Python shows it once for each line of a script, however often that runs. ``mdr.ContactWarning`` in
    0.1.

    Attributes
    ----------
    detail : str
        The same with its numbers.

    Examples
    --------
    >>> issubclass(mdr.LinearityWarning, mdr.SpringContactWarning)
    True
    """

    def __init__(self, text: str = "", detail: str = ""):
        super().__init__(text)
        self.detail = detail or text


class SpringResolutionWarning(SpringContactWarning):
    """Too few springs: in the contact, or to the shortest wave.

    With n springs in a stretch of contact its stiffness is wrong by up to 1 / n. With n springs to a wave the force
    of the wave is wrong by a factor (pi / n) / sin(pi / n). ``mdr.ResolutionWarning`` in 0.1.

    Examples
    --------
    >>> import warnings
    >>> curve = mdr.load_curve(-np.linspace(-1e-3, 1e-3, 101) ** 2 / 0.5, length=2e-3, modulus=2e11)
    >>> with warnings.catch_warnings(record=True) as found:
    ...     warnings.simplefilter("always")
    ...     few = curve.at_approach(1e-8)
    >>> found[0].category.__name__
    'SpringResolutionWarning'
    """


class LinearityWarning(SpringContactWarning):
    """A contact of constant length, under roughness that would change its length.

    Given by `mdr.roll` with ``contact="linear"`` or ``"full"`` where the ends of the contact move so far that, to
    second order, more than a tenth of the fluctuation of the force is left out. ``contact="one-sided"`` has no such
    limit.

    Examples
    --------
    >>> import warnings
    >>> track = 3e-6 * np.sin(2 * np.pi * np.arange(512) / 32)
    >>> with warnings.catch_warnings(record=True) as found:
    ...     warnings.simplefilter("always")
    ...     rolled = mdr.roll(track, spacing=1e-4, radius=0.5, modulus=2e11, approach=2e-6, contact="linear")
    >>> found[0].category.__name__
    'LinearityWarning'
    """


class SpringUnitsWarning(SpringContactWarning):
    """A contact larger than its sphere, or heights that no surface has: units are probably wrong.

    As where a modulus in GPa is given for one in Pa, or heights in nm on a length in m. ``mdr.UnitsWarning`` in 0.1.

    Examples
    --------
    >>> import warnings
    >>> with warnings.catch_warnings(record=True) as found:
    ...     warnings.simplefilter("always")
    ...     contact = mdr.press_sphere(radius=0.01, modulus=200, force=100.0)
    >>> found[0].message.detail
    'the radius of contact is 15.5 times that of the sphere: are the units right?'
    """


def diagnose_load(pressed: NDArray[np.integer], springs: int) -> tuple[SpringContactWarning, ...]:
    """Diagnostics of loads that press so many of all springs.

    A stretch of contact of length l holds l / dx springs, rounded up or down: of n springs in one stretch the stiffness
    is wrong by up to 1 / n, by 1 / (sqrt(6) n) in the root mean square. Where all springs are in contact nothing is
    rounded.
    """
    few = (pressed > 0) & (pressed < min(FEWEST_SPRINGS, springs))
    if not few.any():
        return ()
    fewest = int(pressed[few].min())
    where = f" at {np.count_nonzero(few)} of {few.size} loads, at the lightest" if few.size > 1 else ""
    error = "the answer is that of the spacing, not of the profile" if fewest == 1 else f"k may be {1 / fewest:.0%} off"
    return (
        SpringResolutionWarning(
            f"fewer than {FEWEST_SPRINGS} springs in contact: take more springs",
            f"only {fewest} spring{'s' * (fewest != 1)} in contact{where}: {error}; take more springs "
            f"({FEWEST_SPRINGS} or more in contact are not warned of)",
        ),
    )


def diagnose_wheel(springs: float) -> tuple[SpringContactWarning, ...]:
    """Diagnostics of a wheel whose smooth contact 2 a is so many springs long."""
    if springs >= FEWEST_SPRINGS * (1 - 1e-9):
        return ()
    return (
        SpringResolutionWarning(
            f"the contact of the smooth wheel has fewer than {FEWEST_SPRINGS} springs: take more",
            f"the contact of the smooth wheel has only {springs:.2g} springs: take more "
            f"({FEWEST_SPRINGS} or more are not warned of)",
        ),
    )


def diagnose_units(*, approach: float, radius: float) -> tuple[SpringContactWarning, ...]:
    """Diagnostics of a smooth sphere: a contact, a = sqrt(R d), of a radius above its own."""
    if approach <= radius:
        return ()
    part = math.sqrt(approach) / math.sqrt(radius)
    return (
        SpringUnitsWarning(
            "the radius of contact is above that of the sphere: are the units right?",
            f"the radius of contact is {part:.3g} times that of the sphere: are the units right?",
        ),
    )


def typical_slope(height: FloatArray, spacing: float) -> float:
    """The median of abs(dh)/dx of neighbouring springs along the last axis, which no spike and no step changes.

    Of more than 64 profiles it is that of some of them, evenly apart.
    """
    if height.shape[-1] < 2:
        return 0.0
    some = height if height.ndim == 1 else height[:: -(-len(height) // MOST_LINES)]
    with np.errstate(over="ignore"):
        return float(np.median(np.abs(np.diff(some)))) / spacing


def diagnose_slope(height: FloatArray, spacing: float, modulus: float) -> tuple[SpringContactWarning, ...]:
    """Diagnostics of heights along the last axis, springs a spacing apart.

    Where the modulus is exactly 1, the unit of pressure, heights may have a unit of their own.
    """
    slope = typical_slope(height, spacing)
    if modulus == 1 or slope <= STEEPEST_SLOPE:
        return ()
    return (
        SpringUnitsWarning(
            f"half of the springs have a slope above {STEEPEST_SLOPE:g}: are the units right?",
            f"half of the springs have a slope above {slope:.2g} (up to {STEEPEST_SLOPE:g} is not asked about): are "
            "the units right?",
        ),
    )


def diagnose_heights(height: FloatArray, length: float, modulus: float) -> tuple[SpringContactWarning, ...]:
    """Diagnostics of profiles of a length, along the last axis, whose heights may stand in any order.

    A random order has a slope that means nothing: they are asked about where they are higher than long, too.
    """
    with np.errstate(over="ignore"):
        span = float(height.max() - height.min())
    part = span / length
    if part > 1:
        return diagnose_slope(height, length / height.shape[-1], modulus)
    if modulus == 1 or part >= FLATTEST_PROFILE or span <= ROUNDING * float(np.abs(height).max()):
        return ()
    return (
        SpringUnitsWarning(
            f"the heights lie within {FLATTEST_PROFILE:g} of the length of the profile: are the units right?",
            f"the heights lie within {part:.2g} of the length of the profile (from {FLATTEST_PROFILE:g} on is not "
            "asked about): are the units right?",
        ),
    )


def diagnose_waves(values: FloatArray, q: FloatArray, spacing: float) -> tuple[SpringContactWarning, ...]:
    """Diagnostics of a spectrum on springs: values at the wavenumbers q.

    Springs a part 1 / n of a wave apart sum its force with an error of (pi / n) / sin(pi / n), 0.9 dB where n = 4.
    """
    highest = float(q[values > 0].max(initial=0.0))
    springs = 2 * math.pi / (highest * spacing) if highest > 0 else math.inf
    if springs >= FEWEST_SPRINGS_A_WAVE * (1 - 1e-9):
        return ()
    return (
        SpringResolutionWarning(
            f"the shortest wave of the spectrum has fewer than {FEWEST_SPRINGS_A_WAVE:.0f} springs: "
            "lower q_max or take more points",
            f"the shortest wave of the spectrum has {springs:.2g} springs, fewer than {FEWEST_SPRINGS_A_WAVE:.0f}: "
            "lower q_max or take more points",
        ),
    )


def diagnose_linearity(
    height: FloatArray, change: FloatArray, *, approach: float, reach: int
) -> tuple[SpringContactWarning, ...]:
    """Diagnostics of a contact that keeps its length 2 a under roughness.

    Roughness h at an end of the contact moves it by h R / (2 a): one-sided springs bear E* R h^2 / (4 a) more there, to
    second order, a h^2 / (4 d) over E*. Over the fluctuation of the linear force this is the part that it leaves out.

    height: along the track [m]; change: of the linear force over E* a, alike [m]; approach: d [m]; reach: springs to a.
    """
    fluctuation = float(change.std())
    if not fluctuation > 0:
        return ()
    left_out = (np.roll(height, reach) ** 2 + np.roll(height, -reach) ** 2) / (4 * approach)
    part = float(left_out.std()) / fluctuation
    if not part > LARGEST_PART:
        return ()
    return (
        LinearityWarning(
            "roughness moves the ends of the contact, which a linear one does not know: roll one-sided springs",
            f"roughness of h_rms / d = {float(height.std()) / approach:.2g} moves the ends of the contact, which a "
            f"linear one does not know: to second order {part:.0%} of the fluctuation of its force; roll one-sided "
            f"springs ({LARGEST_PART:.0%} or less are not warned of)",
        ),
    )


def warn(diagnostics: tuple[SpringContactWarning, ...]) -> None:
    """Issue them as warnings of the caller of the public function that found them."""
    for diagnostic in diagnostics:
        warnings.warn(diagnostic, stacklevel=3)
