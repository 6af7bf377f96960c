"""What a wrong pressure may be the answer of: each cause with the part of the error that it explains on one problem."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from scipy import ndimage

from validation.benchmarks.judging.discrete import ContactProblem, pressed
from validation.benchmarks.judging.properties import OF_ANSWER, apart
from validation.benchmarks.judging.wrong_operators import dense, operators
from validation.engine.offered import FloatArray

TOUCHING, ENOUGH_CELLS, DENSE, ALIKE = 1e-3, 12, 900, 10.0
"""Part of the largest pressure; cells to which three numbers may be fitted; cells of a matrix; residuals of two answers
that are one."""


@dataclass(frozen=True, eq=False)
class JudgedContact:
    """A problem with the pressure of a solver, and what the error of that may come from.

    residual: that the solver names; earlier: problems that it was asked before, with their pressures.
    """

    problem: ContactProblem
    pressure: FloatArray
    by_force: bool
    residual: float
    earlier: Sequence[tuple[ContactProblem, FloatArray]] = field(default=(), repr=False)

    def under(
        self,
        problem: ContactProblem | None = None,
        pressure: FloatArray | None = None,
        displacement: FloatArray | None = None,
    ) -> float:
        """What is left of the conditions of another problem, of another pressure, or by another operator."""
        p = self.pressure if pressure is None else pressure
        with np.errstate(all="ignore"):
            worst = (problem or self.problem).worst(p, self.by_force, displacement)
        return math.inf if math.isnan(worst) else worst

    @cached_property
    def left(self) -> float:
        return self.under()

    @property
    def is_right(self) -> bool:
        return self.left <= self.residual

    def explained(self, left: float) -> float:
        """The part of the error that a cause explains under which so much is left: all, where it is the residual.

        Of a right answer: one where it is right under the cause, too.
        """
        if self.is_right:
            return float(left <= ALIKE * self.residual)
        over = max(left - self.residual, 0.0)
        return max(1 - over / (self.left - self.residual), 0.0) if over < self.left - self.residual else 0.0

    def explained_by(self, pressure: FloatArray) -> float:
        """The part of the distance to the answer that another pressure leaves out; of a right answer as `explained`."""
        if self.is_right:
            return float(apart(self.pressure, pressure) <= ALIKE * OF_ANSWER * self.residual)
        with np.errstate(all="ignore"):
            found = 1 - apart(self.pressure, pressure) / apart(self.pressure, self.answer)
        return max(float(found), 0.0) if math.isfinite(found) else 0.0

    @cached_property
    def answer(self) -> FloatArray:
        """By our solver; NaN where it has none."""
        load = {"force": self.problem.force} if self.by_force else {"approach": self.problem.approach}
        try:
            return pressed(self.problem, 1e-9, **load).pressure
        except (ValueError, RuntimeError):
            return np.full_like(self.pressure, math.nan)

    @property
    def off(self) -> float:
        """Of the pressure, in L2 over the answer."""
        return apart(self.pressure, self.answer)

    @cached_property
    def touching(self) -> FloatArray:
        return np.asarray(self.pressure > TOUCHING * self.pressure.max())


Explained = Iterator[tuple[str, float]]
"""Names of causes, each with the part of the error that it explains."""


def causes(contact: JudgedContact) -> Explained:
    """All that have no number of their own, the more specific first."""
    yield from _tension(contact)
    for name, operator in operators(contact.problem):
        with np.errstate(all="ignore"):
            yield name, contact.explained(contact.under(displacement=operator(contact.problem, contact.pressure)))
    yield from _of_earlier_calls(contact)
    for name, problem in _other_problems(contact.problem):
        yield name, contact.explained(contact.under(problem))
    for name, pressure in _other_pressures(contact):
        if pressure.shape == contact.pressure.shape:
            yield name, contact.explained(contact.under(pressure=pressure))
    for name, pressure in _spoiled_answers(contact):
        yield name, contact.explained_by(pressure)
    yield from _fits(contact)


def _tension(contact: JudgedContact) -> Explained:
    p = contact.pressure
    if contact.is_right or p.min() < -contact.residual * np.abs(p).max():
        # where nothing but the sign is wrong, all conditions but that hold
        rest = {name: left for name, left in contact.problem.left(p, contact.by_force)[0].items() if name != "tension"}
        yield "negative pressures: p >= 0 is not held", contact.explained(max(rest.values()))


def _of_earlier_calls(contact: JudgedContact) -> Explained:
    problem = contact.problem
    for other, pressure in contact.earlier:
        if pressure.shape == contact.pressure.shape and other is not problem:
            norm = float((pressure**2).sum())
            scaled = float((pressure * contact.pressure).sum()) / norm * pressure if norm else pressure
            if apart(contact.pressure, scaled) < 1e-6 < apart(contact.answer, scaled):
                yield f"the answer of another problem: {other.name}", 1.0
                return
    kept = {
        (other.spacing, other.modulus, other.periodic)
        for other, pressure in contact.earlier
        if pressure.shape == contact.pressure.shape
    } - {(problem.spacing, problem.modulus, problem.periodic)}
    found = [
        contact.explained(contact.under(replace(problem, spacing=spacing, modulus=modulus, periodic=periodic)))
        for spacing, modulus, periodic in kept
    ]
    yield "an operator that is kept from an earlier call on as many cells", max(found, default=0.0)


def _other_problems(problem: ContactProblem) -> Iterator[tuple[str, ContactProblem]]:
    gap, (n, m) = problem.gap, problem.gap.shape
    yield "the sign of the gap: heights for gaps", replace(problem, gap=-gap)
    far = gap.max() + 1e3 * (np.ptp(gap) + abs(problem.approach if math.isfinite(problem.approach) else 0.0))
    if min(n, m) > 2:
        for name, inner in {
            "cells of the boundary excluded": (slice(1, -1), slice(1, -1)),
            "cells of the boundary of axis 0 excluded": (slice(1, -1), slice(None)),
            "cells of the boundary of axis 1 excluded": (slice(None), slice(1, -1)),
            "the last row and column excluded": (slice(None, -1), slice(None, -1)),
            "the last row excluded": (slice(None, -1), slice(None)),
            "the last column excluded": (slice(None), slice(None, -1)),
            "the first row and column excluded": (slice(1, None), slice(1, None)),
        }.items():
            left = np.full_like(gap, far)
            left[inner] = gap[inner]
            yield name, replace(problem, gap=left)
    if m > 1 and n > 1:
        yield "the first row for the whole gap", replace(problem, gap=np.broadcast_to(gap[:1], gap.shape))
        yield "the first column for the whole gap", replace(problem, gap=np.broadcast_to(gap[:, :1], gap.shape))
        yield "the middle row for the whole gap", replace(problem, gap=np.broadcast_to(gap[n // 2], gap.shape))
    yield "the gap smoothed", replace(problem, gap=smoothed(gap, problem.periodic))


def smoothed(values: FloatArray, periodic: bool) -> FloatArray:
    """By 1 2 1 along each axis."""
    for axis in (0, 1):
        values = ndimage.convolve1d(values, [0.25, 0.5, 0.25], axis, mode="wrap" if periodic else "nearest")
    return np.asarray(values)


def _other_pressures(contact: JudgedContact) -> Iterator[tuple[str, FloatArray]]:
    """What would be right were the returned pressure so put back."""
    p, (n, m) = contact.pressure, contact.pressure.shape
    yield "transposed", p.T
    yield "rows and columns exchanged in memory", p.ravel().reshape((n, m), order="F")
    yield "rows and columns exchanged in memory", p.ravel(order="F").reshape((n, m))
    yield "flipped along axis 0", p[::-1]
    yield "flipped along axis 1", p[:, ::-1]
    yield "flipped along both axes", p[::-1, ::-1]
    yield "turned by a quarter", np.rot90(p)
    yield "turned by a quarter", np.rot90(p, -1)
    for cells in (1, -1, 2, -2):
        for where, axes in {"along axis 0": (0,), "along axis 1": (1,), "along both axes": (0, 1)}.items():
            moved = np.roll(p, [-cells] * len(axes), axes)
            yield f"shifted by {cells} cell{'s' if abs(cells) > 1 else ''} {where}", moved
    yield "shifted by half of the grid: fftshift", np.fft.ifftshift(p)
    yield "shifted by half of the grid: fftshift", np.fft.fftshift(p)


def _spoiled_answers(contact: JudgedContact) -> Iterator[tuple[str, FloatArray]]:
    p, answer, problem = contact.pressure, contact.answer, contact.problem
    if not np.isfinite(answer).all():
        return
    lost = answer[(p <= 0) & (answer > 0)]
    if lost.size and lost.max() < 0.25 * answer.max():
        cut = np.where(p > 0, answer, 0)
        yield "small pressures are clipped to zero and the force is not restored", cut
        yield "small pressures are clipped to zero and all others are scaled to the force", _to_force(cut, p)
    yield "pressures are cut at a largest value", np.minimum(answer, p.max())
    if answer.size <= DENSE and not problem.periodic:
        linear = bilateral(problem, contact.by_force)
        yield "negative pressures are clipped once and the force is not restored", np.maximum(linear, 0)
        yield "negative pressures are clipped once and all others are scaled to the force", _to_force(linear.clip(0), p)
    for axis in (0, 1):
        for cells in (1, -1):
            half = (answer + np.roll(answer, cells, axis)) / 2
            yield f"shifted by {cells / 2:g} cells along axis {axis}, or smoothed along it", half
    mode = "wrap" if problem.periodic else "constant"
    for size in (3, 5):
        yield "smoothed pressures", ndimage.uniform_filter(answer, size, mode=mode)
    for weights in ([0.25, 0.5, 0.25], [0.1, 0.8, 0.1]):
        both = ndimage.convolve1d(ndimage.convolve1d(answer, weights, 0, mode=mode), weights, 1, mode=mode)
        yield "smoothed pressures", both
        yield "smoothed pressures, scaled to the force", _to_force(both, p)
    for sigma in (0.5, 1.0, 2.0):
        yield "smoothed pressures", ndimage.gaussian_filter(answer, sigma, mode=mode)


def bilateral(problem: ContactProblem, by_force: bool) -> FloatArray:
    """The pressure without p >= 0, of a free half-space [Pa]."""
    inverse = np.linalg.solve(dense(problem), np.stack([np.ones(problem.gap.size), problem.gap.ravel()], axis=1))
    held = (problem.force / math.prod(problem.spacing) + inverse[:, 1].sum()) / inverse[:, 0].sum()
    approach = held if by_force else problem.approach
    return np.asarray((approach * inverse[:, 0] - inverse[:, 1]).reshape(problem.gap.shape))


def _to_force(pressure: FloatArray, like: FloatArray) -> FloatArray:
    return np.asarray(pressure * (like.sum() / pressure.sum()))


def _fits(contact: JudgedContact) -> Explained:
    """Pressures that are linear in the gap, in the contact."""
    p, c = contact.pressure, contact.touching
    if np.count_nonzero(c) < ENOUGH_CELLS or np.ptp(contact.problem.gap) == 0:
        return
    even = contact.problem.half_space.displacement(np.full_like(p, p.mean()))
    if np.ptp(p) <= 1e-6 * p.max():
        yield "the same pressure in all cells", 1.0
    bases = {
        "each cell by itself: springs without a half-space": [contact.problem.gap],
        "one iteration from an even pressure": [contact.problem.gap, even],
    }
    for name, basis in bases.items():
        columns = np.stack([np.ones(np.count_nonzero(c)), *(one[c] / np.ptp(one) for one in basis)], axis=1)
        numbers, *_ = np.linalg.lstsq(columns, p[c], rcond=None)
        fitted = np.where(c, 0.0, p)
        fitted[c] = columns @ numbers
        yield name, contact.explained_by(fitted)
