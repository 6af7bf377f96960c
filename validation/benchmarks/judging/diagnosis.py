"""What the pressure of a wrong solver is the answer of, where that can be told."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from validation.benchmarks.judging.discrete import ContactProblem, KnownContact, problems
from validation.benchmarks.judging.properties import apart
from validation.engine.offered import FloatArray

NEAR, HELD, SHORT = 0.02, 1e-3, 5e-3
"""In L2; a residual; of a force."""


def diagnosed(known: KnownContact, p: FloatArray, residual: float) -> str:
    """The first cause that fits, in words; residual: that the solver names."""
    return next(_causes(known, p, residual), "not the answer of any half-space that is known")


def _causes(known: KnownContact, p: FloatArray, residual: float) -> Iterator[str]:
    answer = known.pressure
    if p.min() < -residual * np.abs(p).max():
        yield f"tension, {p.min() / p.max():.2g} of the largest pressure"
    if apart(p, answer) < NEAR and abs(known.force_of(p) / known.force - 1) < SHORT:
        yield "near the answer: a stop too early, rounding, or an operator that is a little off"
    if abs((c := _factor(known, p)) - 1) > NEAR:
        yield f"the answer for {1 / c:.4g} times the modulus, or an operator with a factor of {c:.3g}"
    yield from _other_contacts(known, p)
    for axis in (0, 1):
        cells = np.arange(p.shape[axis])
        mine, right = (float((q.sum(axis=1 - axis) * cells).sum() / q.sum()) for q in (p, answer))
        if 0.1 < abs(mine - right) < 2:
            yield f"shifted by {mine - right:.2g} cells along axis {axis}"
    if p[answer == 0].sum() > 0.01 * p.sum():
        yield "more than 1 % of the force is outside of the contact"


def _other_contacts(known: KnownContact, p: FloatArray) -> Iterator[str]:
    """Under its own force, so that an answer under another load is no sign of another half-space."""
    factor, here = _part(p, known), _left(known, p)
    scaled = apart(p, factor * known.pressure)
    if scaled > HELD > here:
        yield "the answer under another load"
    if scaled < NEAR:
        yield f"{factor:.3g} times the answer"
    image = "the answer of a free half-space" if known.periodic else "the answer with periodic images: no padding"
    if _left(replace(known, periodic=not known.periodic), p) < 0.2 * here:
        yield image
    dx, dy = known.spacing
    if dx != dy and _left(replace(known, spacing=(dy, dx)), p) < 0.2 * here:
        yield "the answer with dx and dy exchanged"
    for other in problems():
        if other.gap.shape == p.shape and apart(p, _part(p, other) * other.pressure) < NEAR:
            yield f"the answer of another problem: {other.name}"


def _part(p: FloatArray, known: KnownContact) -> float:
    return float((p * known.pressure).sum() / (known.pressure**2).sum())


def _left(problem: ContactProblem, p: FloatArray) -> float:
    """The most that is left under the force of the pressure, without tension; infinite where no body overlaps."""
    p = np.maximum(p, 0)
    return float(np.nan_to_num(replace(problem, force=problem.force_of(p)).worst(p, True), nan=np.inf))


def _factor(known: KnownContact, p: FloatArray) -> float:
    """c in gap + c u = approach on the contact, one for the right half-space, also where no c holds."""
    touching = p > 1e-3 * p.max()
    u, gap = known.half_space.displacement(p)[touching], known.gap[touching]
    unit = np.abs(u).max()
    (approach, c), *_ = np.linalg.lstsq(np.stack([np.ones(u.size), -u / unit], axis=1), gap, rcond=None)
    holds = u.size > 8 and np.abs(gap + c * u / unit - approach).max() < NEAR * np.ptp(gap)
    return float(c / unit) if holds else 1.0
