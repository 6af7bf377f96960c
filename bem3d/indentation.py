"""A load path: contacts one after the other, each from those before."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from bem3d.checks import FloatArray, Loads, count, finite, fraction, not_negative
from bem3d.contact import Contact
from bem3d.convergence import ConvergenceError
from bem3d.diagnostics import ContactWarning, warn
from bem3d.halfspace import HalfSpace
from bem3d.problem import Problem
from bem3d.progress import Progress, steps
from bem3d.results import kept, span
from bem3d.solver import raise_if_failed, solve_checked
from bem3d.tangent_stiffness import FixedContactArea, solve_fixed_area
from bem3d.window_solve import InitialGuess

STIFFNESS_TOLERANCE = 1e-4
"""Relative residual of the frozen contacts, unless another is given."""


Solved = tuple[Contact, tuple[ContactWarning, ...]]
"""A contact, and what no load before has warned of."""


class LoadPath(Iterator[Contact]):
    """Contacts along a load path, each solved when it is taken, none kept. Made by `indent`.

    Its arrays solve the loads that are left, whose contacts cannot be taken then.

    Parameters
    ----------
    contacts : iterator
        Contacts, each with what it warns of, solved when it is taken.
    loads : ndarray, shape (loads,)
        Prescribed approaches [m] or forces [N].
    has_stiffness : bool
        Whether each contact stores its ``frozen`` contact area.

    Attributes
    ----------
    loads : ndarray, shape (loads,)
        Prescribed approaches [m] or forces [N]; no solve.
    approach, force : ndarray, shape (loads,)
        Of each contact [m], [N].
    stiffness : ndarray, shape (loads,)
        dF/dd [N/m], NaN of a contact that has not converged. ValueError without ``stiffness=True`` of `indent`.

    Raises
    ------
    ConvergenceError
        If a contact does not reach the tolerance, at each later use again.

    Examples
    --------
    >>> body = bem3d.HalfSpace(shape=(8, 8), spacing=1e-4, modulus=1e11)
    >>> path = bem3d.indent(body, np.zeros((8, 8)), approaches=[1e-7, 2e-7], indenter_ends_at_edge=True)
    >>> bool(np.allclose(path.force[1], 2 * path.force[0])), path.loads * 1e7
    (True, array([1., 2.]))
    """

    def __init__(self, contacts: Iterator[Solved], loads: FloatArray, *, has_stiffness: bool) -> None:
        self.loads = kept(loads)
        self._contacts, self._has_stiffness = contacts, has_stiffness
        self._numbers: list[tuple[float, float, float]] = []
        self._failure: ConvergenceError | None = None

    def __repr__(self) -> str:
        return f"LoadPath({self.loads.size} loads, {span(self.loads, 'm or N')}, {len(self._numbers)} solved)"

    def __iter__(self) -> LoadPath:
        return self

    def __next__(self) -> Contact:
        return self._take(level=4)

    def _take(self, *, level: int) -> Contact:
        """The next contact; StopIteration behind the last. level: frames from `warn` to the line of the user."""
        if self._failure is not None:
            raise self._failure
        try:
            contact, warnings = next(self._contacts)
        except ConvergenceError as failure:
            self._failure = failure
            raise
        warn(warnings, level=level)
        stiffness = math.nan if contact.frozen is None else contact.frozen.stiffness
        self._numbers.append((contact.approach, contact.force, stiffness))
        return contact

    @property
    def approach(self) -> FloatArray:
        """Of each contact [m]."""
        return self._column(0)

    @property
    def force(self) -> FloatArray:
        """Of each contact [N]."""
        return self._column(1)

    @property
    def stiffness(self) -> FloatArray:
        """Incremental stiffness of each contact [N/m]."""
        if not self._has_stiffness:
            raise ValueError("stiffness of a path needs stiffness=True of indent, got False")
        return self._column(2)

    def _column(self, number: int) -> FloatArray:
        while len(self._numbers) < self.loads.size:
            self._take(level=5)
        return kept(np.array([row[number] for row in self._numbers]))


def indent(
    half_space: HalfSpace,
    gap: ArrayLike,
    *,
    approaches: Loads | None = None,
    forces: Loads | None = None,
    stiffness: bool = False,
    stiffness_tolerance: float = STIFFNESS_TOLERANCE,
    indenter_ends_at_edge: bool = False,
    tolerance: float = 1e-6,
    max_iterations: int = 500,
    raise_on_failure: bool = True,
    progress: Progress = False,
) -> LoadPath:
    """Press along a path of approaches or forces, loading or unloading, one contact each.

    Parameters
    ----------
    half_space, gap
        As in `solve`.
    approaches, forces : sequence of float, optional
        Either approaches [m] or forces [N], in the order of the path.
    stiffness : bool, optional
        Whether each contact stores its ``frozen`` contact area, for half as many applications as the contact takes.
    stiffness_tolerance : float, optional
        Residual of the frozen contact areas, in (0, 1). A stiffness is off by some tens of times its square.
    indenter_ends_at_edge, tolerance, max_iterations, raise_on_failure
        As in `solve`.
    progress : bool or callable, optional
        True shows "3 of 40" on the standard error stream after each load. A function is called with both numbers.

    Returns
    -------
    LoadPath
        A `Contact` at each load, solved when it is taken; begun along the tangent p + f dd, or the secant through two.

    Raises
    ------
    ValueError, TypeError, ConvergenceError
        If an argument is out of range, before the first contact; if a contact does not reach the tolerance.

    Warns
    -----
    ResolutionWarning, EdgeWarning, UnitsWarning
        As `solve`, once of a kind and cause, at the first load that gives it. ``Contact.warnings`` has them for each.

    Examples
    --------
    >>> x = (np.arange(65) - 32) * 5e-5
    >>> body = bem3d.HalfSpace(shape=(65, 65), spacing=5e-5, modulus=1e11)
    >>> contacts = bem3d.indent(body, (x[:, None] ** 2 + x**2) / (2 * 0.1), approaches=[2e-6, 4e-6], stiffness=True)
    >>> [f"{contact.stiffness():.3g} N/m" for contact in contacts]
    ['9.01e+07 N/m', '1.26e+08 N/m']
    """
    problems = _problems(half_space, gap, approaches, forces, indenter_ends_at_edge)
    tolerance, max_iterations = fraction("tolerance", tolerance), count("max_iterations", max_iterations)
    frozen = fraction("stiffness_tolerance", stiffness_tolerance) if stiffness else None
    contacts = _path(problems, frozen, tolerance, max_iterations, raise_on_failure, steps(progress, len(problems)))
    return LoadPath(contacts, np.array(list(map(_prescribed, problems))), has_stiffness=stiffness)


def _problems(
    half_space: HalfSpace,
    gap: ArrayLike,
    approaches: Loads | None,
    forces: Loads | None,
    indenter_ends_at_edge: bool,
) -> list[Problem]:
    """One a load, checked before the first is solved."""
    if (approaches is None) == (forces is None):
        raise ValueError(f"give either approaches or forces, got approaches={approaches} and forces={forces}")
    name, path = ("approaches", approaches) if forces is None else ("forces", forces)
    values = np.asarray(path)
    if values.ndim != 1 or values.size == 0:
        raise ValueError(f"{name} must be a flat sequence of numbers, one at least, got {path!r}")
    accepted = finite if forces is None else not_negative
    first, *others = [accepted(f"{name}[{i}]", value) for i, value in enumerate(values.tolist())]
    prescribed = {"approach": first} if forces is None else {"force": first}
    begin = Problem(
        half_space=half_space, gap=cast(FloatArray, gap), indenter_ends_at_edge=indenter_ends_at_edge, **prescribed
    )
    return [begin, *(begin.under(value) for value in others)]


def _path(
    problems: list[Problem],
    stiffness_tolerance: float | None,
    tolerance: float,
    max_iterations: int,
    raise_on_failure: bool,
    solved: Callable[[], object],
) -> Iterator[Solved]:
    past: tuple[Contact, ...] = ()
    warned: set[str] = set()
    frozen: FixedContactArea | None = None
    for problem in problems:
        contact = solve_checked(problem, _predicted(problem, past), tolerance, max_iterations)
        if raise_on_failure:
            raise_if_failed(contact)
        if stiffness_tolerance is not None and contact.converged:
            frozen = solve_fixed_area(
                problem.half_space,
                contact.pressure > 0,
                start=None if frozen is None else frozen.pressure,
                tolerance=stiffness_tolerance,
                max_iterations=max_iterations,
                raise_on_failure=raise_on_failure,
            )
            contact = replace(contact, frozen=frozen)
        found = contact.diagnose()
        new = tuple(warning for warning in found if str(warning) not in warned)
        warned |= {str(warning) for warning in found}
        past = (*past[-1:], contact) if contact.converged else ()
        solved()
        yield contact, new


def _predicted(problem: Problem, past: tuple[Contact, ...]) -> InitialGuess | None:
    """Along the tangent or the secant; None, a cold start, where there is nothing to start from."""
    if not past or not past[-1].pressure.any():
        return None
    last = past[-1]
    change = _prescribed(problem) - _prescribed(last.problem)
    if last.frozen is not None and np.isfinite(last.frozen.stiffness):
        approach = change if problem.force is None else change / last.frozen.stiffness
        return _start(problem, last.pressure + approach * last.frozen.pressure, last.approach + approach)
    if len(past) == 1 or not past[0].pressure.any() or _prescribed(last.problem) == _prescribed(past[0].problem):
        return _start(problem, last.pressure, last.approach)
    part = change / (_prescribed(last.problem) - _prescribed(past[0].problem))
    pressure = last.pressure + part * (last.pressure - past[0].pressure)
    return _start(problem, pressure, last.approach + part * (last.approach - past[0].approach))


def _start(problem: Problem, pressure: FloatArray, approach: float) -> InitialGuess | None:
    """The part of a predicted pressure that presses."""
    pressure = np.maximum(pressure, 0.0)
    overlap = approach - problem.first_touch
    return InitialGuess(pressure, overlap if overlap > 0 else None) if pressure.any() else None


def _prescribed(problem: Problem) -> float:
    value = problem.force if problem.approach is None else problem.approach
    return cast(float, value)
