"""What the pressure of a wrong solver is the answer of, where that can be told."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from validation.benchmarks.judging.discrete import KnownContact
from validation.benchmarks.judging.properties import apart
from validation.engine.offered import FloatArray

NEAR = 0.02
"""In L2."""


def diagnosed(known: KnownContact, p: FloatArray) -> str:
    """The first cause that fits, in words."""
    return next(_causes(known, p), "not the answer of any half-space that is known")


def _causes(known: KnownContact, p: FloatArray) -> Iterator[str]:
    answer = known.pressure
    if p.min() < -1e-3 * p.max():
        yield f"tension, {p.min() / p.max():.2g} of the largest pressure"
    if apart(p, answer) < NEAR:
        yield "near the answer: a stop too early, rounding, or an operator that is a little off"
    if abs((c := _factor(known, p)) - 1) > NEAR:
        yield f"the answer for {1 / c:.4g} times the modulus, or an operator with a factor of {c:.4g}"
    image = "the answer of a free half-space" if known.periodic else "the answer with periodic images: no padding"
    others = {image: replace(known, periodic=not known.periodic)}
    others["the answer with dx and dy exchanged"] = replace(known, spacing=known.spacing[::-1])
    here = np.nan_to_num(known.worst(np.maximum(p, 0), True), nan=np.inf)
    for name, other in others.items():
        force = other.force_of(np.maximum(p, 0))
        if replace(other, force=force).worst(np.maximum(p, 0), True) < 0.2 * here:
            yield name
    factor = float((p * answer).sum() / (answer**2).sum())
    if apart(p, factor * answer) < NEAR:
        yield f"{factor:.4g} times the answer"
    for axis in (0, 1):
        cells = np.arange(p.shape[axis])
        mine, right = (float((q.sum(axis=1 - axis) * cells).sum() / q.sum()) for q in (p, answer))
        if 0.1 < abs(mine - right) < 2:
            yield f"shifted by {mine - right:.2g} cells along axis {axis}"
    if (outside := float(p[answer == 0].sum() / p.sum())) > 0.01:
        yield f"{outside:.0%} of the force is outside of the contact"


def _factor(known: KnownContact, p: FloatArray) -> float:
    """c in gap + c u = approach on the contact, one for the right half-space, also where no c holds."""
    touching = p > 1e-3 * p.max()
    u, gap = known.half_space.displacement(p)[touching], known.gap[touching]
    unit = np.abs(u).max()
    (approach, c), *_ = np.linalg.lstsq(np.stack([np.ones(u.size), -u / unit], axis=1), gap, rcond=None)
    holds = u.size > 8 and np.abs(gap + c * u / unit - approach).max() < NEAR * np.ptp(gap)
    return float(c / unit) if holds else 1.0
