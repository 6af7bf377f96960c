"""Comparisons of the bundled scenes with answers that are made up: all kinds of text and files, without a solve."""

import math
from dataclasses import dataclass
from functools import cache
from itertools import cycle

import numpy as np

import validation
from validation.advice.compare import Comparison
from validation.advice.hierarchy import Candidate, Selection, select_model
from validation.advice.models_of_scene import models_of, quantity_of
from validation.advice.scene_model import Answer
from validation.advice.tolerance import tolerance_of
from validation.railway.scenes.rail import RailScene
from validation.scenes.indentation import IndentationScene
from validation.scenes.rolling import RollingQuantity, RollingScene
from validation.scenes.roughness import Roughness
from validation.simulation.model import Cost, ErrorEstimate

PARTS = (0.1, 0.02, 0.003)
"""Errors of a model, a grid and a sample."""
REASON = "a reason " * 20
NAMES = ("model", "grid", "sample")


def planted(name, quantity, tolerance="10%", *, statuses=("not needed", "accepted", "out of range"), error=0.0512):
    """All models were solved, with statuses in turn; those out of range without an error."""
    scene, wanted, candidates = validation.load_scene(name), tolerance_of(tolerance), []
    values = _values(scene, quantity)
    for i, (model, estimate, cost) in enumerate(models_with_estimates(name, quantity)):
        status = next(found for j, found in enumerate(cycle(statuses)) if j == i)
        left = np.inf if status == "out of range" else error
        bands = {part: np.full(values.size, left) for part in NAMES} if isinstance(scene, RailScene) else {}
        answer = Answer(value=values * 1.1**i, cost=cost, model=left, reason=REASON, band_errors=bands)
        candidates.append(Candidate(model, status, REASON, estimate, answer))
    return Comparison(scene, quantity, Selection(wanted.relative, tuple(candidates)), wanted.in_decibels)


@cache
def models_with_estimates(name, quantity):
    """Those of a wheel on a rail compute filters for each."""
    models = models_of(validation.load_scene(name), quantity, 0.1, 0)
    return [(model, model.estimate(), model.cost()) for model in models]


def _values(scene, quantity):
    if not quantity_of(scene, quantity).in_bands:
        return np.array([5.4e7])
    rail = isinstance(scene, RailScene)
    bands = scene.bands(quantity) if rail else RollingQuantity(scene, quantity).bands.centres
    # from long waves to short ones a filter falls, so that bands count down to the first below its limit
    return np.logspace(3, -3, bands.size) if rail else np.logspace(-3, 3, bands.size)


@dataclass(frozen=True)
class Fake:
    """A model that claims and finds what it is told."""

    name: str = "fake"
    kind: str = "fake"
    claimed: float = 0.0
    left: float = 0.0
    seconds: float = 1.0
    failed: str = ""
    is_mdr: bool = False
    is_sampled: bool = False

    def cost(self):
        return Cost(work=1, seconds=self.seconds)

    def estimate(self):
        return ErrorEstimate(model=self.claimed, reason=f"claims {self.claimed}")

    def solve(self):
        return Answer(
            value=np.array([1.0]), cost=self.cost(), model=self.left, reason=f"leaves {self.left}", failed=self.failed
        )


@dataclass(frozen=True)
class Finding(Fake):
    """Another, whose answer and its cost are told."""

    kind: str = "springs"
    value: tuple[float, ...] = (1.0,)
    parts: tuple[float, float, float] = (0.0, 0.0, 0.0)
    spent: float = 1.0

    def solve(self):
        model, grid, sample = self.parts
        cost = Cost(work=1, seconds=self.spent)
        return Answer(value=np.array(self.value), cost=cost, model=model, grid=grid, sample=sample)


def waves(first=1, last=8, rms=1e-3, hurst=0.7):
    """So many on a length of one, from the longest to the shortest."""
    return Roughness(rms=rms, hurst=hurst, longest=1 / first, shortest=1 / last)


ROUGH = waves()


def punch(load=0.1, ground=ROUGH, **changes):
    height = ground.rms if ground else 1.0
    settings = {"name": "punch", "shape": "punch", "size": 1.0, "load": load * height, "modulus": 1.0, "ground": ground}
    return IndentationScene(**{**settings, **changes})


def wheel(height=0.03, first=1.0, last=4.0, hurst=0.7, **changes):
    """With a = d = 1. height: over d; first, last: q a."""
    ground = waves(first / (2 * math.pi), last / (2 * math.pi), height, hurst)
    settings = {"name": "wheel", "radius": 1.0, "load": 4 / 3, "modulus": 1.0, "ground": ground}
    return RollingScene(**{**settings, **changes})


def ball(height, first, last):
    """A sphere with a = 1, R = 10, d = 0.1."""
    ground = waves(first / (2 * math.pi), last / (2 * math.pi), 0.1 * height)
    return IndentationScene(name="sphere", shape="sphere", size=10.0, load=4 / 3 * 0.1, modulus=1.0, ground=ground)


def compared(*models, tolerance="20%", scene=None, quantity="stiffness", **settings):
    """Models that find what they are told, on a punch."""
    wanted = tolerance_of(tolerance)
    selection = select_model(models, wanted.relative, **settings)
    return Comparison(scene or punch(load=1.0), quantity, selection, wanted.in_decibels)
