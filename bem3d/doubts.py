"""What a converged answer may still be wrong about: too few cells, or a grid that ends where the contact goes on."""

import math
import warnings

import numpy as np

from bem3d.border import BoolArray, FloatArray

FEWEST_CELLS = 32
FEWEST_CELLS_TO_JUDGE = 6
FEWEST_CELLS_A_WAVE = 4.0


class ContactWarning(UserWarning):
    """A contact problem was solved as it was put, but it may not be the one that was meant."""


class ResolutionWarning(ContactWarning):
    """Too few cells: in the contact, or to the shortest wave."""


class EdgeWarning(ContactWarning):
    """The contact reaches the edge of a grid in free space. No cause for doubt under a punch that ends there."""


Doubt = tuple[type[ContactWarning], str]


def doubts_of(contact: BoolArray, *, periodic: bool) -> tuple[Doubt, ...]:
    """What to doubt about a contact set.

    A flat punch of N < 32 cells is too soft by about 0.3 / sqrt(N), measured on squares: so much is
    wrong even where the cells in contact are the right ones. Of a handful nobody can say whether they are.
    """
    cells = int(np.count_nonzero(contact))
    found: list[Doubt] = []
    if 0 < cells < FEWEST_CELLS:
        found.append(
            (
                ResolutionWarning,
                f"only {cells} cell{'s' * (cells != 1)} in contact: "
                + (
                    "the answer is that of the grid, not of the surface"
                    if cells < FEWEST_CELLS_TO_JUDGE
                    else f"a flat punch of so few is {0.3 / math.sqrt(cells):.0%} too soft, its area is rougher still"
                )
                + f"; refine the grid ({FEWEST_CELLS} cells or more are not warned of)",
            )
        )
    inner = int(np.count_nonzero(contact[1:-1, 1:-1]))
    if not periodic and cells > inner:
        found.append(
            (
                EdgeWarning,
                f"{cells - inner} of {cells} contact cells lie on the edge of the grid, beyond which nothing carries: "
                "widen the grid, unless the indenter ends there",
            )
        )
    return tuple(found)


def doubts_of_sphere(cells: float) -> tuple[Doubt, ...]:
    """What to doubt about a sphere whose smooth contact has so many cells, whatever roughness makes of it."""
    if cells >= FEWEST_CELLS:
        return ()
    return (
        (
            ResolutionWarning,
            f"the contact of the smooth sphere has only {cells:.2g} cells: refine the grid "
            f"({FEWEST_CELLS} cells or more are not warned of)",
        ),
    )


def doubt_waves(values: FloatArray, q: FloatArray, steps: tuple[float, float]) -> tuple[Doubt, ...]:
    """What to doubt about a spectrum on a grid: values at the wavenumbers q, cells of these sides."""
    cells = 2 * math.pi / (float(q[values > 0].max(initial=0.0)) * max(steps)) if (values > 0).any() else math.inf
    if cells > FEWEST_CELLS_A_WAVE * (1 - 1e-9):
        return ()
    return (
        (
            ResolutionWarning,
            f"the shortest wave of the spectrum has {cells:.2g} cells, fewer than {FEWEST_CELLS_A_WAVE:.0f}: "
            "lower q_max or refine the grid",
        ),
    )


def warn(doubts: tuple[Doubt, ...]) -> None:
    """Hand them to Python's warnings, as of the caller of the public function that found them."""
    for category, sentence in doubts:
        warnings.warn(sentence, category, stacklevel=3)
