"""The foundation of independent springs: each has stiffness E* dx and knows nothing of its neighbours."""

import math
from dataclasses import dataclass
from typing import Generic, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import FloatArray, doubles, finite, finite_array, held, not_negative, positive, stiffness_of_springs
from mdr.diagnostics import diagnose_load, diagnose_units, warn
from mdr.read_only import ReadOnlyArrays

Value = TypeVar("Value", float, FloatArray)


@dataclass(frozen=True)
class LoadPoint(ReadOnlyArrays, Generic[Value]):
    """One state of a load curve (or an array of states): approach [m], force [N], stiffness dF/dd [N/m]."""

    approach: Value
    force: Value
    stiffness: Value


@dataclass(frozen=True, eq=False)
class LoadCurve(ReadOnlyArrays):
    """Force of a rigid rough profile on the spring foundation, exact at every approach.

    F(d) = E* dx sum_i max(d + h_i, 0): linear between the breakpoints d = -h_i, where one more spring is met.
    approach, force, stiffness: at the breakpoints, ascending, shape (points,) [m, N, N/m]; stiffness counts the
    springs that carry load, so entry i has i of them and the first entry is the first touch.
    A state of few springs in contact is warned of (ResolutionWarning), unless these are all.
    """

    approach: FloatArray
    force: FloatArray
    stiffness: FloatArray
    spring: float

    @overload
    def at_approach(self, approach: float) -> LoadPoint[float]: ...
    @overload
    def at_approach(self, approach: FloatArray) -> LoadPoint[FloatArray]: ...
    def at_approach(self, approach: float | FloatArray) -> LoadPoint[float] | LoadPoint[FloatArray]:
        """The state at a rigid approach [m], a number or an array; zero force before the first touch."""
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
        """The state under a normal force >= 0 [N], a number or an array; zero force is the first touch."""
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
    """The whole load curve of a rough profile from one sort.

    With i springs in contact k = i E* dx, dx = length / points; F grows by k from breakpoint to breakpoint.

    height: shape (points,), positive towards the other body [m]; length: of the profile [m]; modulus: E* [Pa].
    The approach is zero where the plane height = 0 is met, so the first touch is at -max(height).
    Raises ValueError for an empty or non-finite profile, a length or modulus that is not positive.
    Source: Popov and Hess, chapter 10: rough profiles on the foundation.
    """
    heights = finite_array("height", height, ndim=1)
    spring = _spring(modulus, length, heights.size)
    approach = np.sort(-heights)
    stiffness = spring * np.searchsorted(approach, approach, side="left").astype(np.float64)
    with doubles(height=float(np.abs(heights).max()), length=length, modulus=modulus):
        steps = spring * np.arange(1, heights.size) * np.diff(approach)
        force = np.concatenate([[0.0], np.cumsum(steps)])
        held(force, stiffness)
    return LoadCurve(approach, force, stiffness, spring)


def stiffness_under(force: float, height: ArrayLike, *, length: float, modulus: float) -> FloatArray:
    """dF/dd of many rough profiles under one force, shape (profiles,) [N/m]: what `load_curve` has of each.

    Springs are in contact whose breakpoints lie below the force, F_i = E* dx sum_{j<=i} (h_j - h_i), descending.

    force: positive [N]; height: shape (profiles, points) [m]; length: of a profile [m]; modulus: E* [Pa].
    Raises ValueError for what is not finite or out of range.
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
        held(stiffness)
    return stiffness


@dataclass(frozen=True)
class SphereContact:
    """A smooth sphere on the foundation: approach [m], force [N], stiffness [N/m], contact_radius [m]."""

    approach: float
    force: float
    stiffness: float
    contact_radius: float


def press_sphere(
    *, radius: float, modulus: float, approach: float | None = None, force: float | None = None
) -> SphereContact:
    """A smooth sphere on the continuous foundation, by approach or by force.

    F = E* int_{-a}^{a} (d - x^2/R) dx = 4/3 E* sqrt(R) d^(3/2),  a = sqrt(R d),  k = 2 E* a.

    radius: R [m]; modulus: E* [Pa]; exactly one of approach (zero or less: no contact) [m] and force (>= 0) [N].
    Raises ValueError if both or neither are given, or one is out of range.
    Asks whether the units are right (UnitsWarning) where the radius of contact is above that of the sphere.
    Source: Popov and Hess, (14.2), (14.4) and (14.5) without roughness; equal to Hertz.
    """
    radius, modulus = positive("radius", radius), positive("modulus", modulus)
    if (approach is None) == (force is None):
        raise ValueError(f"give either approach or force, got approach={approach} and force={force}")
    load = not_negative("force", force) if approach is None else finite("approach", approach)
    with doubles(radius=radius, modulus=modulus, **{"force" if approach is None else "approach": load}):
        d = math.cbrt(0.75 * load / modulus) ** 2 / math.cbrt(radius) if approach is None else load
        a = math.sqrt(radius * max(d, 0.0))
        contact = SphereContact(d, 4 / 3 * modulus * a * max(d, 0.0), 2 * modulus * a, a)
        held(d)
        held(contact.force, contact.stiffness, a, positive=load > 0)
    warn(diagnose_units(approach=d, radius=radius))
    return contact


def _spring(modulus: float, length: float, points: int) -> float:
    """Stiffness of one of so many springs [N/m]."""
    return stiffness_of_springs("length", positive("modulus", modulus), positive("length", length), points)


def _point(approach: FloatArray, force: FloatArray, stiffness: FloatArray) -> LoadPoint[float] | LoadPoint[FloatArray]:
    if approach.ndim:
        return LoadPoint(approach, force, stiffness)
    return LoadPoint(float(approach), float(force), float(stiffness))
