"""What a wrong pressure may be the answer of: each cause with the part of the error that it explains on one problem."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache, partial

import numpy as np
from numpy.typing import NDArray
from scipy import fft, ndimage, optimize

from validation.benchmarks.discrete import ContactProblem, KnownContact, pressed
from validation.judging.registry import FloatArray
from validation.judging.solvers.properties import OF_ANSWER, Way, relative_deviation
from validation.theory.half_space import love

Spacing = tuple[float, float]
Operator = Callable[[ContactProblem, FloatArray], FloatArray]
"""u [m] (n, m) of a problem under a pressure [Pa] (n, m)."""


@lru_cache(maxsize=64)
def _symbol(shape: tuple[int, int], padded: tuple[int, int], spacing: Spacing, kind: str) -> NDArray[np.complex128]:
    """Of E* = 1; padded: cells of the period of each axis; kind: of the kernel."""
    if kind == "waves":
        q = (
            2
            * math.pi
            * np.hypot(fft.fftfreq(padded[0], spacing[0])[:, np.newaxis], fft.rfftfreq(padded[1], spacing[1]))
        )
        return np.asarray(np.divide(2.0, q, out=np.zeros_like(q), where=q > 0), dtype=np.complex128)
    (dx, dy), (x, y) = spacing, (fft.fftfreq(n, 1 / n) * d for n, d in zip(padded, spacing, strict=True))
    x = x[:, np.newaxis]
    if kind == "points":
        r = np.hypot(x, y)
        return np.asarray(fft.rfft2(np.divide(dx * dy / math.pi, r, out=np.zeros_like(r), where=r > 0)))
    shift = {"half a cell along axis 0": (0.5, 0.0), "half a cell along axis 1": (0.0, 0.5), "half a cell": (0.5, 0.5)}
    i, j = shift.get(kind, (0.0, 0.0))
    return np.asarray(fft.rfft2(love(x + i * dx, y + j * dy, dx, dy) / math.pi))


def displaced(
    problem: ContactProblem,
    pressure: FloatArray,
    kind: str = "love",
    *,
    spacing: Spacing | None = None,
    padded: tuple[bool, bool] = (True, True),
) -> FloatArray:
    """By circular convolution over the grid, along a padded axis over twice its cells."""
    n, m = problem.gap.shape
    period = n * (1 + padded[0]), m * (1 + padded[1])
    symbol = _symbol((n, m), period, spacing or problem.spacing, kind)
    return np.asarray(fft.irfft2(fft.rfft2(pressure, period) * symbol, period)[:n, :m] / problem.modulus)


def of_half_space(periodic: bool, spacing: Callable[[Spacing], Spacing] = lambda d: d) -> Operator:
    """The right operator of this half-space, on cells of another spacing."""

    def operator(problem: ContactProblem, pressure: FloatArray) -> FloatArray:
        if periodic:
            return displaced(problem, pressure, "waves", spacing=spacing(problem.spacing), padded=(False, False))
        return displaced(problem, pressure, spacing=spacing(problem.spacing))

    return operator


def _kernel(kind: str = "love", padded: tuple[bool, bool] = (True, True)) -> Operator:
    return lambda problem, pressure: displaced(problem, pressure, kind, padded=padded)


def point_loads(problem: ContactProblem, pressure: FloatArray) -> FloatArray:
    """Between cells; the displacement of a cell under its own pressure is what fits the contact best."""
    u, own = displaced(problem, pressure, "points"), pressure / problem.modulus * math.sqrt(math.prod(problem.spacing))
    touching = pressure > 1e-3 * pressure.max()
    columns = np.stack([np.ones(np.count_nonzero(touching)), -own[touching]], axis=1)
    (_, factor), *_ = np.linalg.lstsq(columns, (problem.gap + u)[touching], rcond=None)
    return np.asarray(u + factor * own)


def operators(problem: ContactProblem) -> Iterator[tuple[str, Operator]]:
    """Those that differ from the right one of a problem, each with its name, the more specific first."""
    dx, dy = problem.spacing
    if problem.periodic:
        yield "the answer of a free half-space", of_half_space(False)
        yield "periodic images of Love's kernel within one period alone", _kernel(padded=(False, False))
    else:
        yield "the answer of a periodic half-space: no padding", of_half_space(True)
        yield "no padding", _kernel(padded=(False, False))
        yield "no padding along axis 0", _kernel(padded=(False, True))
        yield "no padding along axis 1", _kernel(padded=(True, False))
        yield "the waves of a periodic half-space on a padded grid", _kernel("waves")
        yield "no padding along axis 0, by the waves of a periodic half-space", _kernel("waves", (False, True))
        yield "no padding along axis 1, by the waves of a periodic half-space", _kernel("waves", (True, False))
        yield "point loads instead of Love's rectangles", point_loads
        for half in ("half a cell along axis 0", "half a cell along axis 1", "half a cell"):
            yield f"a kernel that is off by {half}", _kernel(half)
    if dx != dy:
        yield "the answer with dx and dy exchanged", of_half_space(problem.periodic, lambda d: d[::-1])
        yield "the answer with dx for dy", of_half_space(problem.periodic, lambda d: (d[0], d[0]))
        yield "the answer with dy for dx", of_half_space(problem.periodic, lambda d: (d[1], d[1]))


def dense(problem: ContactProblem) -> FloatArray:
    """The operator of a free half-space as a matrix, of all cells [m/Pa]."""
    (n, m), (dx, dy) = problem.gap.shape, problem.spacing
    x, y = (np.arange(count, dtype=np.float64) * d for count, d in ((n, dx), (m, dy)))
    table = love(x[:, np.newaxis], y, dx, dy) / (math.pi * problem.modulus)
    i, j = (index.ravel() for index in np.indices((n, m)))
    return np.asarray(table[np.abs(i[:, np.newaxis] - i), np.abs(j[:, np.newaxis] - j)])


SAME, SMALL = 1e-6, 0.25
"""In L2: pressures that are one; of the largest pressure: what may have been clipped."""
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
            return float(relative_deviation(self.pressure, pressure) <= ALIKE * OF_ANSWER * self.residual)
        with np.errstate(all="ignore"):
            share = 1 - relative_deviation(self.pressure, pressure) / relative_deviation(self.pressure, self.answer)
        return max(float(share), 0.0) if math.isfinite(share) else 0.0

    @cached_property
    def answer(self) -> FloatArray:
        """By our solver, where the pressure is not right itself; NaN where it has none."""
        if self.is_right:
            return self.pressure
        if isinstance(self.problem, KnownContact):
            return self.problem.pressure
        load = {"force": self.problem.force} if self.by_force else {"approach": self.problem.approach}
        try:
            return pressed(self.problem, 1e-9, **load).pressure
        except (ValueError, RuntimeError):
            return np.full_like(self.pressure, math.nan)

    @property
    def off(self) -> float:
        """Of the pressure, in L2 over the answer."""
        return relative_deviation(self.pressure, self.answer)

    @cached_property
    def touching(self) -> NDArray[np.bool_]:
        return np.asarray(self.pressure > TOUCHING * self.pressure.max())


Explaining = Callable[[], float]
Causes = Iterator[tuple[str, Explaining]]
"""Names of causes, each with what finds the part of the error that it explains."""


def causes(contact: JudgedContact) -> Causes:
    """All that have no number of their own, the more specific first; nothing is computed before it is asked for."""
    yield "negative pressures: p >= 0 is not held", partial(_by_tension, contact)
    yield "all of the force in one cell", partial(_by_single_cell, contact)
    for name, operator in operators(contact.problem):
        yield name, partial(_by_operator, contact, operator)
    for other, pressure in contact.earlier:
        if pressure.shape == contact.pressure.shape and not is_same(other, contact.problem):
            yield "the answer of another problem", partial(_by_earlier, contact, pressure)
    yield "an operator that is kept from an earlier call on as many cells", partial(_by_kept_operator, contact)
    for name, problem in _other_problems(contact.problem):
        yield name, partial(_by_problem, contact, problem)
    for name, put_back in _other_pressures(contact.pressure.shape):
        yield name, partial(_by_pressure, contact, put_back)
    for name, spoil in _spoiled_answers(contact):
        yield name, partial(_by_spoiled, contact, spoil)
    yield "the same pressure in all cells", partial(_by_evenness, contact)
    yield "each cell by itself: springs without a half-space", partial(_by_fit, contact, iterations=0)
    yield "one iteration from an even pressure", partial(_by_fit, contact, iterations=1)


def is_same(problem: ContactProblem, other: ContactProblem) -> bool:
    """Whether two are one, told twice; an approach may be NaN in both."""
    values, other_values = (
        (*stated.spacing, stated.modulus, stated.force, stated.approach, stated.periodic) for stated in (problem, other)
    )
    return bool(np.array_equal(problem.gap, other.gap) and np.array_equal(values, other_values, equal_nan=True))


def _by_single_cell(contact: JudgedContact) -> float:
    """Where the contact has more cells, or the cell is another one; its force is held."""
    p = contact.pressure
    if contact.is_right:
        return float(np.count_nonzero(contact.answer) == 1)
    held = abs(contact.problem.force_of(p) / contact.problem.force - 1) <= contact.residual or not contact.by_force
    return float(held and np.count_nonzero(p) == 1)


def _by_tension(contact: JudgedContact) -> float:
    """Where nothing but the sign is wrong, all other conditions hold, or all without the negative pressures."""
    left, p = contact.problem.residuals_and_approach(contact.pressure, contact.by_force)[0], contact.pressure
    if contact.is_right or p.min() >= -contact.residual * np.abs(p).max():
        return float(contact.is_right)
    rest = max(value for name, value in left.items() if name != "tension")
    part = contact.explained(rest) if math.isfinite(rest) else 0.0
    return max(part, contact.explained(contact.under(pressure=p.clip(0))))


def _by_operator(contact: JudgedContact, operator: Operator) -> float:
    with np.errstate(all="ignore"):
        return contact.explained(contact.under(displacement=operator(contact.problem, contact.pressure)))


def _by_earlier(contact: JudgedContact, pressure: FloatArray) -> float:
    """The very pressure that was returned before, or that times a number."""
    if contact.is_right:
        return 1.0
    scaled = float((pressure * contact.pressure).sum()) / float((pressure**2).sum()) * pressure
    return float(relative_deviation(contact.pressure, scaled) < SAME < relative_deviation(contact.answer, scaled))


def _by_kept_operator(contact: JudgedContact) -> float:
    problem = contact.problem
    kept = {
        (other.spacing, other.modulus, other.periodic)
        for other, pressure in contact.earlier
        if pressure.shape == contact.pressure.shape
    } - {(problem.spacing, problem.modulus, problem.periodic)}
    substitutes = [
        replace(problem, spacing=spacing, modulus=modulus, periodic=periodic) for spacing, modulus, periodic in kept
    ]
    # with its cells, by its kernel alone, and by that for the right modulus
    parts = [_by_problem(contact, other) for other in substitutes]
    for other in (*substitutes, *(replace(other, modulus=problem.modulus) for other in substitutes)):
        parts.append(contact.explained(contact.under(displacement=other.half_space.displacement(contact.pressure))))
    return max(parts, default=float(contact.is_right))


def _by_problem(contact: JudgedContact, problem: ContactProblem) -> float:
    return contact.explained(contact.under(problem))


def _by_pressure(contact: JudgedContact, put_back: Way) -> float:
    pressure = put_back(contact.pressure)
    return contact.explained(contact.under(pressure=pressure)) if pressure.shape == contact.pressure.shape else 0.0


def _by_spoiled(contact: JudgedContact, spoil: Way) -> float:
    answer = contact.answer
    return contact.explained_by(spoil(answer)) if np.isfinite(answer).all() else 0.0


def _other_problems(problem: ContactProblem) -> Iterator[tuple[str, ContactProblem]]:
    gap, (n, m) = problem.gap, problem.gap.shape
    yield "the sign of the gap: heights for gaps", replace(problem, gap=-gap)
    far = gap.max() + 1e3 * (np.ptp(gap) + abs(problem.approach if math.isfinite(problem.approach) else 0.0))
    if min(n, m) > 2:
        for name, inner in {
            "cells of the boundary excluded": (slice(1, -1), slice(1, -1)),
            "cells of the boundary of axis 0 excluded": (slice(1, -1), slice(None)),
            "cells of the boundary of axis 1 excluded": (slice(None), slice(1, -1)),
            "two cells of the boundary excluded": (slice(2, -2), slice(2, -2)),
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
    dx, dy = problem.spacing
    if dx != dy:
        # by the kernel and by the area of a cell
        yield "square cells, dx for dy", replace(problem, spacing=(dx, dx))
        yield "square cells, dy for dx", replace(problem, spacing=(dy, dy))
    yield "the gap smoothed", replace(problem, gap=smoothed(gap, problem.periodic))


def smoothed(values: FloatArray, periodic: bool) -> FloatArray:
    """By 1 2 1 along each axis."""
    for axis in (0, 1):
        values = ndimage.convolve1d(values, [0.25, 0.5, 0.25], axis, mode="wrap" if periodic else "nearest")
    return np.asarray(values)


def _other_pressures(shape: tuple[int, ...]) -> Iterator[tuple[str, Way]]:
    """What would be right were the returned pressure so put back."""
    n, m = shape
    yield "transposed", lambda p: p.T
    yield "rows and columns exchanged in memory", lambda p: p.ravel().reshape((n, m), order="F")
    yield "rows and columns exchanged in memory", lambda p: p.ravel(order="F").reshape((n, m))
    yield "flipped along axis 0", lambda p: p[::-1]
    yield "flipped along axis 1", lambda p: p[:, ::-1]
    yield "flipped along both axes", lambda p: p[::-1, ::-1]
    yield "a pressure is added in all cells", lambda p: p - p.min() if np.ptp(p) else p
    yield "turned by a quarter", np.rot90
    yield "turned by a quarter", lambda p: np.rot90(p, -1)
    for cells in (1, -1, 2, -2):
        for where, axes in {"along axis 0": (0,), "along axis 1": (1,), "along both axes": (0, 1)}.items():
            name = f"shifted by {cells} cell{'s' if abs(cells) > 1 else ''} {where}"
            yield name, partial(np.roll, shift=[-cells] * len(axes), axis=axes)
    yield "shifted by half of the grid: fftshift", np.fft.ifftshift
    yield "shifted by half of the grid: fftshift", np.fft.fftshift


def _spoiled_answers(contact: JudgedContact) -> Iterator[tuple[str, Way]]:
    """What may have been done to the answer."""
    p, mode = contact.pressure, "wrap" if contact.problem.periodic else "constant"

    def to_force(pressure: FloatArray) -> FloatArray:
        return np.asarray(pressure * (p.sum() / pressure.sum()))

    def cut(answer: FloatArray) -> FloatArray:
        lost = answer[(p <= 0) & (answer > 0)]
        return np.where(p > 0, answer, 0) if lost.size and lost.max() < SMALL * answer.max() else math.nan * answer

    def clipped(_: FloatArray) -> FloatArray:
        small = p.size <= DENSE and not contact.problem.periodic
        return bilateral(contact.problem, contact.by_force).clip(0) if small else np.full_like(p, math.nan)

    def blurred(answer: FloatArray, weights: Sequence[float]) -> FloatArray:
        for axis in (0, 1):
            answer = ndimage.convolve1d(answer, weights, axis, mode=mode)
        return np.asarray(answer)

    restored = " and the force is not restored" if contact.by_force else ""
    yield f"small pressures are clipped to zero{restored}", cut
    yield "small pressures are clipped to zero and all others are scaled", lambda answer: to_force(cut(answer))
    yield "pressure outside of the contact", lambda answer: np.where(answer > 0, answer, p)
    yield "pressures are cut at a largest value", lambda answer: np.minimum(answer, p.max())
    yield f"negative pressures are clipped once{restored}", clipped
    yield "negative pressures are clipped once and all others are scaled", lambda answer: to_force(clipped(answer))
    for axis in (0, 1):
        for cells in (1, -1):
            half = f"shifted by {cells / 2:g} cells along axis {axis}, or smoothed along it"
            yield half, lambda answer, cells=cells, axis=axis: (answer + np.roll(answer, cells, axis)) / 2  # type: ignore[misc]
    for weights in ([0.25, 0.5, 0.25], [0.1, 0.8, 0.1], [1 / 3] * 3, [0.2] * 5):
        yield "smoothed pressures", partial(blurred, weights=weights)
        yield "smoothed pressures", lambda answer, weights=weights: to_force(blurred(answer, weights))  # type: ignore[misc]
    for edge in (mode, "reflect", "wrap"):
        yield "smoothed pressures", partial(most_alike, pressure=p, mode=edge)


def most_alike(answer: FloatArray, pressure: FloatArray, mode: str) -> FloatArray:
    """The answer smoothed by that Gaussian of 0.3 to 4 cells which brings it nearest to a pressure."""

    def smoothed_by(sigma: float) -> FloatArray:
        return np.asarray(ndimage.gaussian_filter(answer, sigma, mode=mode))

    best = optimize.minimize_scalar(
        lambda sigma: relative_deviation(smoothed_by(sigma), pressure),
        bounds=(0.3, 4.0),
        method="bounded",
        options={"xatol": 1e-3},
    )
    return smoothed_by(float(best.x))


def bilateral(problem: ContactProblem, by_force: bool) -> FloatArray:
    """The pressure without p >= 0, of a free half-space [Pa]."""
    inverse = np.linalg.solve(dense(problem), np.stack([np.ones(problem.gap.size), problem.gap.ravel()], axis=1))
    held = (problem.force / math.prod(problem.spacing) + inverse[:, 1].sum()) / inverse[:, 0].sum()
    approach = held if by_force else problem.approach
    return np.asarray((approach * inverse[:, 0] - inverse[:, 1]).reshape(problem.gap.shape))


def _by_evenness(contact: JudgedContact) -> float:
    return float(np.ptp(contact.pressure) <= SAME * contact.pressure.max())


def _by_fit(contact: JudgedContact, iterations: int) -> float:
    """By a pressure that is linear in the gap, and after an iteration in the displacement of an even one."""
    p, c, gap = contact.pressure, contact.touching, contact.problem.gap
    if contact.is_right or np.count_nonzero(c) < ENOUGH_CELLS or np.ptp(gap) == 0:
        return float(contact.is_right)
    even = contact.problem.half_space.displacement(np.full_like(p, p.mean()))
    # of a periodic half-space it is zero
    fields = [field for field in (gap, even)[: 1 + iterations] if np.ptp(field) > SAME * np.ptp(gap)]
    columns = np.stack([np.ones(np.count_nonzero(c)), *(field[c] / np.ptp(field) for field in fields)])
    numbers, *_ = np.linalg.lstsq(columns.T, p[c], rcond=None)
    fitted = np.where(c, 0.0, p)
    fitted[c] = numbers @ columns
    return contact.explained_by(fitted)
