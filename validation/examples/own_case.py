"""A case of one's own: settings, independent solves with their seeds, and a number with a reference and a verdict."""

from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from scipy import optimize, stats

import mdr
from validation.analysis.evidence import Number
from validation.engine.engine import Engine
from validation.engine.random_numbers import random_generator

LOAD = 1.0  # F / (E* h L)


@dataclass(frozen=True)
class PressedProfile:
    """One profile, by its number, under the load."""

    number: int
    points: int = 1024


def press(problem: PressedProfile) -> dict[str, np.ndarray]:
    """Its stiffness over that of the flat punch, E* L: the share of the springs that carry."""
    rough = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi * 8, q_max=2 * np.pi * 64, rms=1.0)
    rng = random_generator(7, problem.number)  # the same for any number of workers
    height = mdr.rough_profile(rough.c1d, length=1.0, points=problem.points, rng=rng, rms=1.0)
    return {"share": mdr.stiffness_under(LOAD, height[np.newaxis], length=1.0, modulus=1.0)}


outcomes = Engine(workers=1).map(press, [PressedProfile(i) for i in range(100)])
share = np.concatenate([outcome["share"] for outcome in outcomes])

# Gaussian heights on independent springs: mean of (z - c)+ is the load, and the share is P(z > c)
c = optimize.brentq(lambda c: stats.norm.pdf(c) - c * stats.norm.sf(c) - LOAD, -5.0, 5.0)
number = Number(
    quantity="share of springs that carry",
    value=float(share.mean()),
    reference=float(stats.norm.sf(c)),
    source="Gaussian heights",
    tolerance=0.02,
    reason="fixed amplitudes are not quite Gaussian",
    sample=float(2 * share.std(ddof=1) / np.sqrt(share.size)),
)
print(number.sentence)
assert number.verdict == "agree"

figure = Figure(layout="constrained")
axes = figure.subplots()
axes.hist(share, bins=20)
axes.axvline(number.reference, color="k")
axes.set(xlabel=number.quantity, ylabel="profiles")
figure.savefig("own_case.png")
