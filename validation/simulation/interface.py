"""A rough interface without edges: a periodic half-space pressed by a mean pressure."""

import warnings

import numpy as np

import bem3d
from validation.engine.engine import Outcome
from validation.simulation.rough_punch import LOST, STIFFNESS_TOLERANCE, Surface


def press_interface(surface: Surface) -> Outcome:
    """Boundary elements: K L / E*, true contact area / L^2 and mean gap / L at each mean pressure F / L^2.

    The displacement has a mean of zero, so that the approach is that of the mean planes, less their distance at zero
    load: the mean gap is its negative, and K = dp / d(approach) belongs to the interface alone. K is infinite in full
    contact. Each contact starts from the last. residual: of each; highest: the largest height / L; applications: of the
    operator, by the contacts and by their frozen ones; failed: loads that did not converge, whose values are NaN.
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
            values = (contact.stiffness(), contact.area, -contact.approach) if converged else LOST[:3]
            applications = contact.operator_applications, frozen.operator_applications if frozen is not None else 0
            rows.append((*values, contact.residual, *applications))
    names = "stiffness", "area", "gap", "residual", "applications", "frozen applications"
    columns = dict(zip(names, np.array(rows).T, strict=True))
    lost = np.array(float(np.isnan(columns["stiffness"]).sum()))
    return {**columns, "highest": np.array(height.max()), "failed": lost}
