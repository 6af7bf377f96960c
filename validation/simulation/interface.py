"""A rough interface without edges: a periodic half-space pressed by a mean pressure."""

import warnings
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

import bem3d
from validation.engine.engine import FloatArray, Outcome
from validation.simulation.model_names import SPRINGS
from validation.simulation.rough_punch import (
    LOST,
    STIFFNESS_TOLERANCE,
    Profiles,
    PunchRoughness,
    Surface,
    press_profiles,
)
from validation.theory.interface import full_contact_pressure


def press_interface(surface: Surface) -> Outcome:
    """Boundary elements: K L / E*, contact area / L^2, as counted and corrected, mean gap / L at each pressure F / L^2.

    The displacement has a mean of zero, so that the approach is that of the mean planes, less their distance at zero
    load: the mean gap is its negative, and K = dp / d(approach) belongs to the interface alone. K is infinite in full
    contact. Each contact starts from the last. corrected: the area as `bem3d.Contact.corrected_area` has it; residual:
    of each; highest: the largest height / L; full: the pressure of full contact / E*; applications: of the operator, by
    the contacts and by their frozen ones; failed: loads that did not converge, whose values are NaN.
    """
    cells = surface.cells
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0, periodic=True)
    height = surface.roughness.surface(cells, surface.realisation)
    path = bem3d.indent(
        half_space,
        -height,
        forces=surface.roughness.height * np.array(surface.forces),
        stiffness=True,
        stiffness_tolerance=STIFFNESS_TOLERANCE,
        tolerance=surface.tolerance,
        raise_on_failure=False,
    )
    rows = []
    with warnings.catch_warnings():
        # the lightest loads stand on few cells, which finer grids measure
        warnings.simplefilter("ignore", bem3d.ContactWarning)
        for contact in path:
            frozen = contact.frozen
            converged = contact.converged and frozen is not None and frozen.converged
            areas = contact.area, contact.corrected_area
            values = (contact.stiffness(), *areas, contact.mean_gap) if converged else LOST
            applications = contact.operator_applications, frozen.operator_applications if frozen is not None else 0
            rows.append((*values, contact.residual, *applications))
    names = "stiffness", "area", "corrected", "gap", "residual", "applications", "frozen applications"
    columns = dict(zip(names, np.array(rows).T, strict=True))
    lost = np.array(float(np.isnan(columns["stiffness"]).sum()))
    full = full_contact_pressure(height, spacing=1 / cells, modulus=1.0)
    return {**columns, "highest": np.array(height.max()), "full": np.array(full), "failed": lost}


@dataclass(frozen=True, kw_only=True)
class MdrInterface:
    """MDR of the interface: springs have a stiffness and, having no neighbours, neither a contact area nor a gap.

    A rough line of length L_1D under a flat punch has the stiffness k at the force p L^2. A rigid flat on springs is
    stiff with E* L_1D, and what the roughness adds is in series with it: 1 / (K L^2) = 1 / k - 1 / (E* L_1D). K is
    infinite where all springs touch. In units of L = L_1D = E* = 1.

    roughness: of the profiles by Geike's rule; realisations: of them, K is that of their mean k; points: springs.
    """

    roughness: PunchRoughness
    realisations: int
    points: int
    name: str = SPRINGS

    def profiles(self, pressure: ArrayLike) -> Profiles:
        """The problem that `press_profiles` solves, at ascending mean pressures over E*."""
        forces = tuple((np.atleast_1d(pressure) / self.roughness.height).tolist())
        return Profiles(
            roughness=self.roughness, realisations=self.realisations, points=self.points, length=1.0, forces=forces
        )

    def stiffness(self, pressure: ArrayLike) -> FloatArray:
        """K L / E* at ascending mean pressures p / E*."""
        k = press_profiles(self.profiles(pressure))["stiffness"].mean(axis=0)
        return without_flat_punch(k).reshape(np.shape(pressure))


def without_flat_punch(stiffness: FloatArray) -> FloatArray:
    """K L / E* of the interface from k / (E* L_1D) of springs that also have their flat punch: see `MdrInterface`."""
    with np.errstate(divide="ignore"):
        return np.asarray(1 / np.maximum(1 / stiffness - 1, 0.0))
