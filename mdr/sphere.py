"""A smooth sphere on the continuous foundation."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import FloatArray, doubles, finite, finite_array, held, not_negative, positive
from mdr.diagnostics import diagnose_units, warn
from mdr.results import line, span


def sphere_profile(x: ArrayLike, *, radius: float) -> FloatArray:
    """Profile in one dimension that stands for a sphere: x^2 / R, not x^2 / (2 R).

    Parameters
    ----------
    x : array_like
        Distance from the centre of the contact [m].
    radius : float
        Radius R of the sphere [m].

    Returns
    -------
    ndarray
        x^2 / R, the gap between sphere and springs, shape of ``x`` [m]. As a height it is negative.

    Raises
    ------
    ValueError
        If ``x`` is not finite or ``radius`` is not positive.

    Notes
    -----
    Source: Popov and Hess, Method of Dimensionality Reduction in Contact Mechanics and Friction, (14.2).

    Examples
    --------
    >>> mdr.sphere_profile([0.0, 1e-3, 2e-3], radius=0.5) * 1e6
    array([0., 2., 8.])
    """
    given, radius = finite_array("x", x), positive("radius", radius)
    with doubles(x=float(np.abs(given).max(initial=0.0)), radius=radius):
        profile: FloatArray = given**2 / radius
        held(profile)
    return profile


@dataclass(frozen=True)
class SphereContact:
    """Smooth sphere on the foundation. Made by `press_sphere`.

    Attributes
    ----------
    approach : float
        Rigid approach d [m].
    force : float
        Normal force F [N].
    stiffness : float
        k = dF/dd [N/m].
    contact_radius : float
        Radius of contact a [m].

    Examples
    --------
    >>> contact = mdr.press_sphere(radius=0.01, modulus=1e11, approach=-1e-6)
    >>> contact.force, contact.contact_radius
    (0.0, 0.0)
    """

    approach: float
    force: float
    stiffness: float
    contact_radius: float

    def __repr__(self) -> str:
        load = f"approach={span(self.approach, 'm')}, force={span(self.force, 'N')}"
        stiffness, radius = span(self.stiffness, "N/m"), span(self.contact_radius, "m")
        return line(f"SphereContact({load}, stiffness={stiffness}, contact_radius={radius})")


def press_sphere(
    *, radius: float, modulus: float, approach: float | None = None, force: float | None = None
) -> SphereContact:
    """Press a smooth sphere on the continuous foundation, by approach or by force.

    Parameters
    ----------
    radius, modulus : float
        Radius R of the sphere [m], contact modulus E* [Pa].
    approach : float, optional
        Rigid approach d [m]. Zero or less is no contact. Give either ``approach`` or ``force``.
    force : float, optional
        Normal force F, zero or positive [N].

    Returns
    -------
    SphereContact
        Approach, force, stiffness and contact radius.

    Raises
    ------
    ValueError, TypeError
        If both or neither of ``approach`` and ``force`` are given, or an argument is out of range.

    Warns
    -----
    SpringUnitsWarning
        If the radius of contact is larger than the sphere.

    Notes
    -----
    F = E* int_{-a}^{a} (d - x^2 / R) dx = 4/3 E* sqrt(R) d^(3/2), a = sqrt(R d), k = 2 E* a [1]_. All three are equal
    to those of Hertz in three dimensions.

    References
    ----------
    .. [1] Popov and Hess, Method of Dimensionality Reduction in Contact Mechanics and Friction, (14.2), (14.4),
       (14.5).

    Examples
    --------
    >>> contact = mdr.press_sphere(radius=0.01, modulus=1e11, force=10.0)
    >>> print(f"d = {contact.approach:.4g} m, a = {contact.contact_radius:.4g} m")
    d = 8.255e-07 m, a = 9.086e-05 m
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
