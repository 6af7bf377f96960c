"""Warnings of a converged contact: too few cells, a spike, or a grid that ends too early."""

import math
import warnings

import numpy as np

from bem3d.checks import FloatArray

FEWEST_CELLS = 32
FEWEST_CELLS_TO_JUDGE = 6
FEWEST_CELLS_A_WAVE = 4.0
MOST_ALONE = 0.5
HIGHEST_PRESSURE = 0.1
"""Over E*: no solid bears it elastically. A modulus of exactly 1 is the unit of pressure and is not checked."""
STEEPEST_SLOPE = 10.0
"""Of the median cell, 84 degrees: the roughest surfaces have an rms slope about 1, a half-space needs less."""
FLATTEST_SLOPE, LIGHTEST_PRESSURE = 1e-6, 1e-7
"""Of an optical flat, 1 nm over 1 mm; over E*, 20 kPa of steel. A contact that has less of both is in another unit."""
ROUNDING = 1e-12
"""Over the largest height: what differs by less is equal but for rounding."""
MOST_LINES = 64
"""Rows, and columns, of which the slope is taken."""


class ContactWarning(UserWarning):
    """A contact may not be the one that was meant.

    The base class of the warnings of `bem3d`: the problem was solved as it was given. The text has no numbers of the
    solve, so that Python shows it once for each line of a script, however often that runs.

    Attributes
    ----------
    detail : str
        The same with its numbers. `Contact.warnings` has them of all solves.

    Examples
    --------
    >>> issubclass(bem3d.EdgeWarning, bem3d.ContactWarning)
    True
    """

    def __init__(self, text: str = "", detail: str = ""):
        super().__init__(text)
        self.detail = detail or text


class ResolutionWarning(ContactWarning):
    """Too few cells: in the contact, in the part of it that counts, or to the shortest wave.

    A flat punch of N < 32 cells is too soft by about 0.3 / sqrt(N).

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(9, 9), spacing=1e-4, modulus=1e11)
    >>> gap = np.ones((9, 9))
    >>> gap[4, 4] = 0.0
    >>> contact = bem3d.solve_polonsky_keer(body, gap, force=1.0)
    >>> contact.diagnostics[0][0].__name__
    'ResolutionWarning'
    """


class EdgeWarning(ContactWarning):
    """The contact reaches the edge of a grid in free space.

    A punch that ends there says so by ``indenter_ends_at_edge=True``, and is not warned of.

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(8, 8), spacing=1e-4, modulus=1e11)
    >>> contact = bem3d.solve_polonsky_keer(body, np.zeros((8, 8)), force=1.0)
    >>> contact.diagnostics[0][0].__name__
    'EdgeWarning'
    """


class UnitsWarning(ContactWarning):
    """A pressure, an approach or slopes that no elastic body has: the units are probably wrong.

    As where a modulus in GPa is given for one in Pa, or heights in nm on a grid in m.

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(8, 8), spacing=1e-4, modulus=100.0, periodic=True)
    >>> contact = bem3d.solve_polonsky_keer(body, np.zeros((8, 8)), force=1.0)
    >>> contact.diagnostics[0][0].__name__
    'UnitsWarning'
    """


def diagnose_pressure(pressure: FloatArray, *, edge: bool) -> tuple[ContactWarning, ...]:
    """Diagnostics of a pressure and its contact set; edge: whether the surface goes on there, out of the grid.

    A flat punch of N < 32 cells is too soft by about 0.3 / sqrt(N), measured on squares: that
    error remains where the cells in contact are the right ones. For a handful of cells even that is unknown.
    """
    contact = pressure > 0
    cells = int(np.count_nonzero(contact))
    found: list[ContactWarning] = list(_diagnose_spike(pressure) if cells >= FEWEST_CELLS else ())
    if 0 < cells < FEWEST_CELLS:
        found.append(
            ResolutionWarning(
                f"fewer than {FEWEST_CELLS} cells in contact: refine the grid",
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
    if edge and cells > inner:
        found.append(
            EdgeWarning(
                "the contact reaches the edge of the grid, beyond which nothing carries: widen the grid, or give "
                "indenter_ends_at_edge=True if the indenter ends there",
                f"{cells - inner} of {cells} contact cells lie on the edge of the grid, beyond which nothing carries: "
                "widen the grid, or give indenter_ends_at_edge=True if the indenter ends there",
            )
        )
    return tuple(found)


def _diagnose_spike(pressure: FloatArray) -> tuple[ContactWarning, ...]:
    """The cell of the highest pressure, if it touches alone, open all around, and carries half of the force.

    An asperity of one cell is as stiff as the cell, whatever the surface is there: 0.891 E* dx, by Love. What it
    carries at an approach it takes from the cells around, so that the force feels little of it before it carries most.
    """
    (nx, ny), highest = pressure.shape, int(pressure.argmax())
    i, j = divmod(highest, ny)
    around = pressure[np.ix_(sorted({(i - 1) % nx, i, (i + 1) % nx}), sorted({(j - 1) % ny, j, (j + 1) % ny}))]
    if not math.isfinite(pressure[i, j]):
        return ()  # a pressure that has overflowed is not converged
    part = 1 / float((pressure / pressure[i, j]).sum())
    if np.count_nonzero(around) > 1 or not part > MOST_ALONE:
        return ()
    return (
        ResolutionWarning(
            "one cell that touches alone carries most of the force: check its height, or refine the grid",
            f"cell ({i}, {j}), which touches alone, carries {part:.0%} of the force: the answer is that of the grid; "
            f"check its height, or refine the grid (up to {MOST_ALONE:.0%} is not warned of)",
        ),
    )


def typical_slope(height: FloatArray, steps: tuple[float, float]) -> float:
    """The median of abs(dh)/dx of neighbouring cells, along the axis where it is larger.

    Neither a spike nor a step, as at the edge of a punch in a wider grid, changes a median. Grids of more than 64 rows
    or columns are read on some of them, evenly apart.
    """
    slopes, rounding = [], ROUNDING * float(np.abs(height).max())
    for lines, step in ((height.T, steps[0]), (height, steps[1])):
        if lines.shape[1] > 1:
            some = lines[:: -(-len(lines) // MOST_LINES)]
            with np.errstate(over="ignore"):
                typical = float(np.median(np.abs(np.diff(some, axis=1))))
            slopes.append(typical / step if typical > rounding else 0.0)
    return max(slopes, default=0.0)


def diagnose_units(
    *, pressure: float, modulus: float, approach: float, side: float, slope: float = 0.0
) -> tuple[ContactWarning, ...]:
    """Diagnostics of a mean pressure under an E* [Pa], an approach from the first touch on a grid [m], and a slope."""
    causes, found = [], []
    steep, flat = f"{STEEPEST_SLOPE:g}", f"{FLATTEST_SLOPE:g}"
    # where the modulus is the unit of pressure heights may have a unit of their own
    if modulus != 1 and pressure > 0 and slope > STEEPEST_SLOPE:
        causes.append(f"half of the cells have a slope above {steep}")
        found.append(f"half of the cells have a slope above {slope:.2g} (up to {steep} is not asked about)")
    if modulus != 1 and 0 < pressure < LIGHTEST_PRESSURE * modulus and 0 < slope < FLATTEST_SLOPE:
        light = f"{LIGHTEST_PRESSURE:g} E*"
        causes.append(f"half of the cells have a slope below {flat}, under a mean pressure below {light}")
        found.append(
            f"half of the cells have a slope below {slope:.2g}, under a mean pressure of {pressure / modulus:.2g} E* "
            f"(from {flat} or {light} on is not asked about)"
        )
    if modulus != 1 and pressure > HIGHEST_PRESSURE * modulus:
        causes.append(f"the mean pressure is above {HIGHEST_PRESSURE:g} E*")
        found.append(
            f"the mean pressure is {pressure / modulus:.2g} E* (up to {HIGHEST_PRESSURE:g} E* is not asked about)"
        )
    if approach > side:
        causes.append("the approach beyond the first touch is more than the side of the grid")
        found.append(
            f"the approach beyond the first touch, {approach:.3g} m, is more than the side of the grid, {side:.3g} m"
        )
    if not found:
        return ()
    return (UnitsWarning(*(f"{', and '.join(said)}: are the units right?" for said in (causes, found))),)


def diagnose_sphere(cells: float) -> tuple[ContactWarning, ...]:
    """Diagnostics of a sphere whose smooth contact has so many cells, whatever roughness makes of it."""
    if cells >= FEWEST_CELLS:
        return ()
    return (
        ResolutionWarning(
            f"the contact of the smooth sphere has fewer than {FEWEST_CELLS} cells: refine the grid",
            f"the contact of the smooth sphere has only {cells:.2g} cells: refine the grid "
            f"({FEWEST_CELLS} cells or more are not warned of)",
        ),
    )


def diagnose_waves(values: FloatArray, q: FloatArray, steps: tuple[float, float]) -> tuple[ContactWarning, ...]:
    """Diagnostics of a spectrum on a grid: values at the wavenumbers q, cells of these sides."""
    cells = 2 * math.pi / (float(q[values > 0].max(initial=0.0)) * max(steps)) if (values > 0).any() else math.inf
    if cells > FEWEST_CELLS_A_WAVE * (1 - 1e-9):
        return ()
    return (
        ResolutionWarning(
            f"the shortest wave of the spectrum has fewer than {FEWEST_CELLS_A_WAVE:.0f} cells: "
            "lower q_max or refine the grid",
            f"the shortest wave of the spectrum has {cells:.2g} cells, fewer than {FEWEST_CELLS_A_WAVE:.0f}: "
            "lower q_max or refine the grid",
        ),
    )


def warn(diagnostics: tuple[ContactWarning, ...], *, level: int = 3) -> None:
    """Issue them as warnings of the caller of the public function that found them. level: frames from here to it."""
    for diagnostic in diagnostics:
        warnings.warn(diagnostic, stacklevel=level)
