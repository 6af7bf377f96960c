"""A contact solver of one's own is judged: is it right, and how fast is it beside `bem3d`?

Conjugate gradients on Love's half-space, under a force. Also for CI:
`pytest --pyargs validation.conformance --mdr-solver own_solver.py:solve`.
"""

import math

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.fft import fftfreq, irfft2, rfft2

from validation import contact_solver, judge

FloatArray = NDArray[np.float64]


def corner(x: FloatArray, y: FloatArray) -> FloatArray:
    """The double integral of 1/r."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.nan_to_num(x * np.arcsinh(y / abs(x))) + np.nan_to_num(y * np.arcsinh(x / abs(y))))


@contact_solver("conjugate gradients", residual=1e-4)
def solve(gap: FloatArray, spacing: tuple[float, float], modulus: float, force: float, tolerance: float) -> FloatArray:
    """p >= 0, w = gap + u - approach >= 0, p w = 0, after Polonsky and Keer, Wear 231 (1999) 206."""
    (n, m), (dx, dy), padded = gap.shape, spacing, (2 * gap.shape[0], 2 * gap.shape[1])
    x, y = fftfreq(2 * n, 1 / (2 * n))[:, None] * dx, fftfreq(2 * m, 1 / (2 * m)) * dy
    love = sum(s * t * corner(x + s * dx / 2, y + t * dy / 2) for s in (1, -1) for t in (1, -1))
    transfer = rfft2(love / (math.pi * modulus))

    def displacement(p: FloatArray) -> FloatArray:
        return np.asarray(irfft2(rfft2(p, padded) * transfer, padded)[:n, :m])

    p = np.full(gap.shape, force / (gap.size * dx * dy))
    direction, before = np.zeros(gap.shape), 1.0
    for _ in range(10_000):
        w, inside = gap + displacement(p), p > 0
        approach = (p * w).sum() / p.sum()
        left = max((p * abs(w - approach)).sum() / p.sum(), (approach - w).max())
        if left < tolerance / 2 * (approach - gap.min()):
            return p
        slope = w - w[inside].mean()
        square = (slope[inside] ** 2).sum()
        direction = np.where(inside, slope + square / before * direction, 0)
        curved = displacement(direction)
        curved -= curved[inside].mean()
        step = (slope * direction)[inside].sum() / (curved * direction)[inside].sum()
        p, before = np.maximum(p - step * direction, 0), square
        overlapping = (p == 0) & (slope < 0)
        if overlapping.any():
            p, before = p - step * slope * overlapping, math.inf
        p *= force / (p.sum() * dx * dy)
    raise RuntimeError("no answer in 10,000 iterations")


if __name__ == "__main__":  # `mdr-validation judge own_solver.py` does not come here
    judgement = judge(solve)
    print(judgement.summary())

    cells, mine, ours = np.array([(time.cells, time.seconds, time.bem3d) for time in judgement.times]).T
    figure = Figure(figsize=(5, 3.5), layout="constrained")
    axes = figure.subplots()
    axes.loglog(cells, mine, "o-", label="conjugate gradients")
    axes.loglog(cells, ours, "s-", label="bem3d")
    axes.set(xlabel="cells on a side", ylabel="seconds, one thread")
    axes.legend()
    figure.savefig("own_solver.png")

    assert judgement.answered and not judgement.wrong
