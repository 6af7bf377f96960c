"""The foundation of independent springs: each has stiffness E* dx and knows nothing of its neighbours."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import FloatArray, doubles, finite_array, held, positive, stiffness_of_springs
from mdr.diagnostics import diagnose_heights, diagnose_load, warn
from mdr.results import ReadOnlyArrays, line, span

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Value = TypeVar("Value", float, FloatArray)


@dataclass(frozen=True)
class LoadPoint(ReadOnlyArrays, Generic[Value]):
    """State of a load curve, or an array of states.

    Attributes
    ----------
    approach : float or ndarray
        Rigid approach d [m].
    force : float or ndarray
        Normal force F, shape of ``approach`` [N].
    stiffness : float or ndarray
        dF/dd = E* dx times the number of springs in contact, shape of ``approach`` [N/m].

    Examples
    --------
    >>> point = mdr.load_curve(np.zeros(100), length=1e-3, modulus=1e9).at_approach(1e-6)
    >>> print(f"{point.force:.4g} N, {point.stiffness:.4g} N/m")
    1 N, 1e+06 N/m
    """

    approach: Value
    force: Value
    stiffness: Value

    def __repr__(self) -> str:
        load = f"approach={span(self.approach, 'm')}, force={span(self.force, 'N')}"
        return line(f"LoadPoint({load}, stiffness={span(self.stiffness, 'N/m')})")


@dataclass(frozen=True, eq=False)
class LoadCurve(ReadOnlyArrays):
    """Load curve of a rigid rough profile on springs, exact at every approach. Made by `load_curve`.

    Attributes
    ----------
    approach, force, stiffness : ndarray, shape (points,)
        State at each first touch of a spring, d = -h_i, ascending [m, N, N/m]. The stiffness counts the springs that
        carry load: entry i has i of them, and the first entry is the first touch.
    spring : float
        Stiffness of one spring, E* dx [N/m].

    Notes
    -----
    F(d) = E* dx sum_i max(d + h_i, 0): linear between d = -h_i and the next [1]_.

    References
    ----------
    .. [1] Popov and Hess, Method of Dimensionality Reduction in Contact Mechanics and Friction, chapter 10.

    Examples
    --------
    >>> curve = mdr.load_curve([-1e-6, -2e-6, -3e-6], length=3e-3, modulus=1e9)
    >>> curve.approach * 1e6, curve.force
    (array([1., 2., 3.]), array([0., 1., 3.]))
    """

    approach: FloatArray
    force: FloatArray
    stiffness: FloatArray
    spring: float

    def __repr__(self) -> str:
        springs = f"{self.approach.size} springs of {span(self.spring, 'N/m')}"
        return line(f"LoadCurve({springs}, approach={span(self.approach, 'm')}, force={span(self.force, 'N')})")

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the force as a function of the approach from the first touch, exact between all points.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw on, by default those of a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            The axes, approach [m] along x and force [N] along y. Several curves may share them.

        Raises
        ------
        TypeError
            If ``ax`` is no Axes.
        """
        # imported where a figure is asked for: springs need none
        import matplotlib.pyplot as plt
        from matplotlib.axes import Axes
        from matplotlib.ticker import EngFormatter

        if ax is None:
            ax = plt.subplots(layout="constrained")[1]
        if not isinstance(ax, Axes):
            raise TypeError(f"ax must be an Axes of matplotlib, or None for a new figure, got {type(ax).__name__}")
        ax.plot(self.approach, self.force)
        ax.xaxis.set_major_formatter(EngFormatter("m"))
        ax.yaxis.set_major_formatter(EngFormatter("N"))
        ax.set(xlabel="approach", ylabel="force")
        return ax

    @overload
    def at_approach(self, approach: float) -> LoadPoint[float]: ...
    @overload
    def at_approach(self, approach: FloatArray) -> LoadPoint[FloatArray]: ...
    def at_approach(self, approach: float | FloatArray) -> LoadPoint[float] | LoadPoint[FloatArray]:
        """State at a rigid approach.

        Parameters
        ----------
        approach : float or array_like
            Of any sign, counted from the plane of height zero [m]. Below the first touch the force is zero.

        Returns
        -------
        LoadPoint
            Numbers, or arrays of the shape of ``approach``.

        Raises
        ------
        ValueError
            If an approach is not finite, or its force is not a number that a double can hold.

        Warns
        -----
        SpringResolutionWarning
            If fewer than 16 springs are in contact, and these are not all springs.

        Examples
        --------
        >>> curve = mdr.load_curve(np.zeros(100), length=1e-3, modulus=1e9)
        >>> curve.at_approach(np.array([-1e-6, 1e-6])).force
        array([0., 1.])
        """
        d = finite_array("approach", approach)
        deepest = float(np.max(d, initial=-math.inf))
        pressed = np.searchsorted(self.approach, d, side="left")
        warn(diagnose_load(np.asarray(pressed), self.approach.size))
        last = np.maximum(pressed - 1, 0)
        stiffness = self.spring * pressed.astype(np.float64)
        with doubles(approach=deepest):
            force = self.force[last] + stiffness * (d - self.approach[last])
            held(force)
            held(np.where(pressed > 0, force, 1.0), positive=True)
        return _point(d, force, stiffness)

    @overload
    def at_force(self, force: float) -> LoadPoint[float]: ...
    @overload
    def at_force(self, force: FloatArray) -> LoadPoint[FloatArray]: ...
    def at_force(self, force: float | FloatArray) -> LoadPoint[float] | LoadPoint[FloatArray]:
        """State under a normal force.

        Parameters
        ----------
        force : float or array_like
            Zero or positive [N]. At zero force the state is the first touch.

        Returns
        -------
        LoadPoint
            Numbers, or arrays of the shape of ``force``.

        Raises
        ------
        ValueError
            If a force is negative or not finite.

        Warns
        -----
        SpringResolutionWarning
            If fewer than 16 springs are in contact, and these are not all springs.

        Examples
        --------
        >>> curve = mdr.load_curve(np.zeros(100), length=1e-3, modulus=1e9)
        >>> print(f"{curve.at_force(2.0).approach:.4g} m")
        2e-06 m
        """
        given = finite_array("force", force)
        if (given < 0).any():
            raise ValueError(f"force must be zero or positive, got {given.min()}")
        pressed = np.searchsorted(self.force, given, side="left")
        warn(diagnose_load(np.asarray(pressed), self.approach.size))
        last = np.maximum(pressed - 1, 0)
        stiffness = self.spring * pressed.astype(np.float64)
        with doubles(force=float(np.max(given, initial=0.0))):
            d = self.approach[last] + (given - self.force[last]) / np.maximum(stiffness, self.spring)
            held(d)
        return _point(d, given, stiffness)


def load_curve(height: ArrayLike, *, length: float, modulus: float) -> LoadCurve:
    """Load curve of a rough profile, from one sort of its heights.

    Parameters
    ----------
    height : array_like, shape (points,)
        Heights h_i of the rigid profile, positive towards the springs [m].
    length : float
        Length L of the profile [m].
    modulus : float
        Contact modulus E* [Pa].

    Returns
    -------
    LoadCurve
        Force and stiffness at every approach. The approach is zero where the plane of height zero touches, so contact
        begins at ``-max(height)``.

    Raises
    ------
    ValueError
        If ``height`` is empty or not finite, or ``length`` or ``modulus`` is not positive.
    TypeError
        If an argument is not a real number.

    Warns
    -----
    SpringUnitsWarning
        If the profile is higher than long and half of its springs have a slope above 10, as of heights in nm on a
        length in m; or if its heights lie within 1e-9 of the length.

    Notes
    -----
    F(d) = E* dx sum_i max(d + h_i, 0), dx = L / points [1]_. With i springs in contact dF/dd = i E* dx.

    References
    ----------
    .. [1] Popov and Hess, Method of Dimensionality Reduction in Contact Mechanics and Friction, chapter 10.

    Examples
    --------
    A parabola x^2 / R stands for a sphere of radius R. Hertz has F = 4/3 E* sqrt(R) d^(3/2) = 0.2667 N:

    >>> x = (np.arange(2000) - 999.5) * 1e-6
    >>> curve = mdr.load_curve(-mdr.sphere_profile(x, radius=0.04), length=2e-3, modulus=1e9)
    >>> print(f"{curve.at_approach(1e-6).force:.4f} N")
    0.2667 N
    """
    heights = finite_array("height", height, ndim=1)
    spring = _spring(modulus, length, heights.size)
    approach = np.sort(-heights)
    stiffness = spring * np.searchsorted(approach, approach, side="left").astype(np.float64)
    with doubles(height=float(np.abs(heights).max()), length=length, modulus=modulus):
        steps = spring * np.arange(1, heights.size) * np.diff(approach)
        force = np.concatenate([[0.0], np.cumsum(steps)])
        held(force, stiffness)
    warn(diagnose_heights(heights, length, modulus))
    return LoadCurve(approach, force, stiffness, spring)


def stiffness_under(force: float, height: ArrayLike, *, length: float, modulus: float) -> FloatArray:
    """Stiffness of many rough profiles under one force.

    Parameters
    ----------
    force : float
        Normal force, positive [N].
    height : array_like, shape (profiles, points)
        Heights of rigid profiles, positive towards the springs [m].
    length : float
        Length L of each profile [m].
    modulus : float
        Contact modulus E* [Pa].

    Returns
    -------
    ndarray, shape (profiles,)
        dF/dd of each profile [N/m]: ``load_curve(height[i], ...).at_force(force).stiffness``.

    Raises
    ------
    ValueError
        If a value is not finite or out of range.

    Warns
    -----
    SpringUnitsWarning
        As `load_curve`.

    Notes
    -----
    Spring i, in descending order of heights, touches at the force F_i = E* dx sum_{j <= i} (h_j - h_i), so the
    springs in contact are those with F_i < F: one sort of each profile, no iteration.

    Examples
    --------
    >>> rng = np.random.default_rng(1)
    >>> k = mdr.stiffness_under(1.0, 1e-6 * rng.standard_normal((2, 100)), length=1e-3, modulus=1e9)
    >>> k / 1e4  # E* dx = 1e4 N/m
    array([85., 81.])
    """
    heights = finite_array("height", height, ndim=2)
    points = heights.shape[1]
    spring = _spring(modulus, length, points)
    descending = -np.sort(-heights, axis=1)
    with doubles(force=force, length=length, modulus=modulus):
        wanted = positive("force", force) / spring
        held(wanted, positive=True)
        steps = np.arange(1, points) * -np.diff(descending, axis=1)
        stiffness = np.asarray(spring * (1 + np.count_nonzero(np.cumsum(steps, axis=1) < wanted, axis=1)))
    warn(diagnose_heights(heights, length, modulus))
    return stiffness


def _spring(modulus: float, length: float, points: int) -> float:
    """Stiffness of one of so many springs [N/m]."""
    return stiffness_of_springs("length", positive("modulus", modulus), positive("length", length), points)


def _point(approach: FloatArray, force: FloatArray, stiffness: FloatArray) -> LoadPoint[float] | LoadPoint[FloatArray]:
    if approach.ndim:
        return LoadPoint(approach, force, stiffness)
    return LoadPoint(float(approach), float(force), float(stiffness))
