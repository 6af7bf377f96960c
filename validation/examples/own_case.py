"""A case of one's own: independent solves with their seeds, and a number with a reference and a verdict."""

import numpy as np
from matplotlib.figure import Figure
from scipy import stats

import mdr
from validation.analysis.evidence import Number
from validation.engine.engine import Engine
from validation.engine.realisations import random_generator

CUT = -0.9  # Gaussian heights z of rms 1 carry above it: the mean of (z - CUT)+ is the load F / (E* h L)
LOAD = stats.norm.pdf(CUT) - CUT * stats.norm.sf(CUT)
ROUGH = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi * 8, q_max=2 * np.pi * 64, rms=1.0)


def press(profile: int) -> dict[str, np.ndarray]:
    """Stiffness over that of the flat punch, E* L: the share of the springs that carry. profile: its number."""
    rng = random_generator(7, profile)  # the same for any number of workers
    height = mdr.rough_profile(ROUGH.c1d, length=1.0, points=1024, rng=rng, rms=1.0)
    return {"share": mdr.stiffness_under(LOAD, height[np.newaxis], length=1.0, modulus=1.0)}


share = np.concatenate([outcome["share"] for outcome in Engine(workers=1).map(press, range(100))])
number = Number(
    quantity="share of springs that carry",
    value=float(share.mean()),
    reference=float(stats.norm.sf(CUT)),
    source="Gaussian heights",
    tolerance=0.02,
    reason="fixed amplitudes are not quite Gaussian",
    sample=float(2 * share.std(ddof=1) / np.sqrt(share.size)),
)
print(number.sentence)
assert number.verdict == "within tolerance"
figure = Figure()
axes = figure.subplots(subplot_kw={"xlabel": number.quantity, "ylabel": "profiles"})
axes.hist(share, bins=20)
figure.savefig("own_case.png")
