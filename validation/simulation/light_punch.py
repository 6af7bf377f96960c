"""Rough punches on fine grids: light loads on the few cells that touch, heavier ones on windows of the grid."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

import bem3d
from validation.engine.engine import FloatArray, Outcome
from validation.simulation.rough_punch import Surface, press_surface
from validation.simulation.surface import refined

CELLS_A_WAVE = 4
"""Of the shortest wave on the grid that a surface is drawn on; a finer one has the same waves."""
OVERLAPPING = 4
"""Times the cells on a side: when more overlap, an application by transforms costs less than one by a matrix."""
TOUCHING = 1
"""Times the cells on a side: a load under which more will touch is not tried on a matrix. Half as many cost more."""


def press_lightly(surface: Surface) -> Outcome:
    """`press_surface` by stiffness, area and approach, in a small part of its time where few cells touch.

    residual: of each; applications: of the operator, by the contacts and by their fixed contact areas, or as many as
    have the floating-point operations of the products with influence coefficients; failed: loads that did not
    converge, whose values are NaN.
    """
    cells = surface.cells
    half_space = bem3d.HalfSpace(shape=(cells, cells), spacing=1 / cells, modulus=1.0)
    forces = surface.roughness.height * np.array(surface.forces)
    found: list[tuple[float, ...]] = []
    # two real transforms of a padded grid take 5/2 n log2(n) operations each, a product two
    points = (2 * cells) ** 2
    products = 2.5 * points * math.log2(points)
    try:
        contacts = bem3d.indent_few_cells(
            half_space, -_height(surface), forces=forces, max_cells=OVERLAPPING * cells, tolerance=surface.tolerance
        )
        for contact in _while_few(contacts, forces, TOUCHING * cells):
            work = np.array([contact.products, contact.stiffness_products]) / products
            found.append((contact.stiffness, contact.area, contact.approach, contact.residual, *work))
    except (bem3d.TooManyCellsError, bem3d.ConvergenceError):
        pass
    names = "stiffness", "area", "approach", "residual", "applications", "frozen applications"
    columns = np.array(found).reshape(-1, len(names)).T
    outcome = dict(zip(names, columns, strict=True))
    if len(found) < len(forces):
        rest = press_surface(replace(surface, forces=surface.forces[len(found) :]))
        outcome = {name: np.append(values, rest[name]) for name, values in outcome.items()}
    return {**outcome, "failed": np.array(float(np.isnan(outcome["stiffness"]).sum()))}


def _while_few(
    contacts: Iterable[bem3d.FewCellsContact], forces: FloatArray, most: float
) -> Iterator[bem3d.FewCellsContact]:
    """The contacts up to the load after which more cells will touch: their number goes with the force, nearly."""
    for contact, following in zip(contacts, [*forces[1:], 0.0], strict=False):
        yield contact
        if len(contact.cells) * following > most * contact.force:
            return


def _height(surface: Surface) -> FloatArray:
    """Heights of the realisation on the grid, drawn on a coarser one where that has all its waves."""
    _, last = surface.roughness.waves
    drawn = min(surface.cells, CELLS_A_WAVE * last)
    return refined(surface.roughness.surface(drawn, surface.realisation), surface.cells)
