"""What the pressure of a wrong solver is the answer of, where that can be told."""

import math
from dataclasses import replace

import numpy as np

from validation.benchmarks.judging.discrete import KnownContact
from validation.benchmarks.judging.properties import apart
from validation.engine.offered import FloatArray

NEAR = 0.02
"""In L2."""


def diagnosed(known: KnownContact, p: FloatArray) -> str:
    """The first that fits, in words."""
    return next(filter(None, (fits(known, p) for fits in CAUSES)), "not the answer of any half-space that is known")


def _tension(known: KnownContact, p: FloatArray) -> str:
    return f"tension, {p.min() / p.max():.2g} of the largest pressure" if p.min() < -1e-3 * p.max() else ""


def _few_cells(known: KnownContact, p: FloatArray) -> str:
    off = np.argwhere(np.abs(p - known.pressure) > 1e-3 * known.pressure.max())
    return (
        f"right but for {len(off)} of {p.size} cells, the first {tuple(off[0].tolist())}"
        if 0 < len(off) < 4 < p.size
        else ""
    )


def _near(known: KnownContact, p: FloatArray) -> str:
    return (
        "near the answer: a stop too early, rounding, or an operator that is a little off"
        if apart(p, known.pressure) < NEAR
        else ""
    )


def _another_modulus(known: KnownContact, p: FloatArray) -> str:
    """gap + c u = approach on the contact: c is one for the right half-space."""
    touching = p > 1e-3 * p.max()
    u, gap = known.half_space.displacement(p)[touching], known.gap[touching]
    if u.size < 8 or np.ptp(u) == 0:
        return ""
    unit = np.abs(u).max()
    (approach, c), *_ = np.linalg.lstsq(np.stack([np.ones(u.size), -u / unit], axis=1), gap, rcond=None)
    if not np.abs(gap + c * u / unit - approach).max() < 0.02 * np.ptp(gap) or abs(c / unit - 1) < 0.02:
        return ""
    return f"the answer for {unit / c:.4g} times the modulus, or an operator with a factor of {c / unit:.4g}"


def _another_half_space(known: KnownContact, p: FloatArray) -> str:
    right = known.half_space
    others = {
        "of a free half-space" if known.periodic else "with periodic images: no padding": replace(
            right, periodic=not right.periodic
        ),
        "with dx and dy exchanged": replace(right, spacing=right.spacing[::-1]),
    }
    here, *there = (one.residual(known.gap, np.maximum(p, 0)).worst for one in (right, *others.values()))
    worse = here if math.isfinite(here) else math.inf
    return next((f"the answer {name}" for name, left in zip(others, there, strict=True) if left < 0.2 * worse), "")


def _multiple(known: KnownContact, p: FloatArray) -> str:
    factor = float((p * known.pressure).sum() / (known.pressure**2).sum())
    return f"{factor:.4g} times the answer" if apart(p, factor * known.pressure) < NEAR else ""


def _shifted(known: KnownContact, p: FloatArray) -> str:
    for axis in (0, 1):
        cells = np.arange(p.shape[axis])
        mine, right = (float((q.sum(axis=1 - axis) * cells).sum() / q.sum()) for q in (p, known.pressure))
        if 0.1 < abs(mine - right) < 2:
            return f"shifted by {mine - right:.2g} cells along axis {axis}"
    return ""


def _told_otherwise(known: KnownContact, p: FloatArray) -> str:
    answer = known.pressure
    others = {
        "transposed": answer.T,
        "mirrored along axis 0": answer[::-1],
        "mirrored along axis 1": answer[:, ::-1],
        "with its cells in another order": answer.ravel(order="F").reshape(answer.shape),
    }
    near = {name for name, one in others.items() if one.shape == p.shape and apart(p, one) < 0.2 * apart(p, answer)}
    return f"the answer {min(near)}" if near else ""


def _outside(known: KnownContact, p: FloatArray) -> str:
    part = float(p[known.pressure == 0].sum() / p.sum())
    return f"{part:.0%} of the force is outside of the contact" if part > 0.01 else ""


CAUSES = (
    *(_tension, _few_cells, _near, _another_modulus, _another_half_space, _multiple),
    *(_told_otherwise, _shifted, _outside),
)
