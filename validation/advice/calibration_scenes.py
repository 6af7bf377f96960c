"""Scenes on which cheap models are measured, drawn evenly from ranges, and the answers of fine boundary elements."""

import hashlib
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import astuple, dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from validation.engine.engine import FloatArray, Outcome
from validation.engine.realisations import random_generator
from validation.scenes.indentation import IndentationScene
from validation.scenes.rolling import RollingScene
from validation.scenes.roughness import Roughness
from validation.scenes.scene import MOVING, PRESSED, ROLLING, Scene
from validation.simulation.model import GridModel, Model, Target, models_serving
from validation.theory.closed_forms import hertz_force

MODEL_TOLERANCE = 0.05
"""Of the models that are measured: their samples leave a fifth of it or less."""
OTHER_SEED = 1_000_003
"""Added to the seed of a scene: the reference has surfaces of its own."""
RADIUS, APPROACH = 1.0, 1e-4
"""Of spheres and wheels: no error depends on units."""
HEIGHT = 1e-3
"""Of the roughness of punches, over their side."""
QUANTITIES = {
    kind: tuple(map(str, quantities))
    for kind, quantities in {"punch": PRESSED, "sphere": PRESSED, "rolling": ROLLING, "wheel": MOVING[::-1]}.items()
}
DESIGNS: Mapping[str, tuple[tuple[float, float], ...]] = {
    "punch": ((-2.2, 2.0), (0.0, math.log10(5.4)), (math.log10(3), math.log10(48)), (0.2, 1.2)),
    "sphere": ((-2.5, 0.0), (math.log10(0.3), math.log10(2)), (math.log10(2), math.log10(12)), (0.2, 1.2)),
    "rolling": ((-2.5, 0.0), (math.log10(0.5), math.log10(2)), (math.log10(2), math.log10(12)), (0.2, 1.2)),
    "wheel": ((-2.5, -0.5), (math.log10(0.5), math.log10(2)), (math.log10(2), math.log10(12)), (0.2, 1.2)),
}
"""Ranges of lg Fbar or lg h/d; of lg of the longest waves on a side, or of q a of the longest wave; of lg of the
longest over the shortest wave; and of the Hurst exponent."""
SHORTEST = {"punch": 48, "sphere": 16, "rolling": 12, "wheel": 12}
"""Of the shortest wave: as many on a side at the most, and q a."""
RESONANCES, IN_BAND = (math.log10(1.2), math.log10(6)), 3.5
"""lg of the frequency of the longest wave over the resonance of a dynamic wheel; of the shortest, at the least."""


@dataclass(frozen=True, kw_only=True)
class CalibrationScene:
    """A point of the design: the first of a kind are the same, however many there are."""

    kind: str
    number: int
    quantity: str
    seed: int

    @property
    def scene(self) -> Scene:
        """Drawn evenly from the ranges."""
        low, high = np.array(DESIGNS[self.kind]).T
        rng = random_generator(self.seed, list(DESIGNS).index(self.kind), self.number)
        power, first, ratio, hurst = rng.uniform(low, high).tolist()
        common: dict[str, Any] = {"name": f"{self.kind} {self.number}", "modulus": 1.0}
        if self.kind == "punch":
            waves = round(10**first)
            last = max(min(round(waves * 10**ratio), SHORTEST[self.kind]), 3 * waves)
            ground = Roughness(rms=HEIGHT, hurst=hurst, longest=1 / waves, shortest=1 / last)
            return IndentationScene(shape="punch", size=1.0, load=10**power * HEIGHT, ground=ground, **common)
        d = APPROACH * RADIUS
        a, common["load"] = math.sqrt(RADIUS * d), hertz_force(radius=RADIUS, modulus=1.0, approach=d)
        longest, shortest = 10**first, min(10 ** (first + ratio), SHORTEST[self.kind])
        ground = Roughness(
            rms=10**power * d, hurst=hurst, longest=2 * math.pi * a / longest, shortest=2 * math.pi * a / shortest
        )
        if self.kind == "sphere":
            return IndentationScene(shape="sphere", size=RADIUS, ground=ground, **common)
        if self.kind == "wheel":
            over = max(10 ** rng.uniform(*RESONANCES), IN_BAND * ground.q_min / ground.q_max)
            common |= {"mass": 1.0, "speed": over * math.sqrt(2 * a) / ground.q_min}
        return RollingScene(radius=RADIUS, ground=ground, **common)

    def target(self, tolerance: float = MODEL_TOLERANCE, seed: int = 0) -> Target:
        """seed: added to that of the design."""
        return Target(self.scene, self.quantity, tolerance, self.seed + self.number + seed)

    @property
    def cheap(self) -> tuple[Model, ...]:
        """The models that are measured."""
        return cheap_models(self.target())


@dataclass(frozen=True, kw_only=True)
class CalibrationRun:
    """How many scenes of each kind; each of a wheel is solved for both of its quantities."""

    punches: int = 200
    spheres: int = 120
    rolling: int = 60
    wheels: int = 70
    seed: int = 19

    @property
    def points(self) -> list[CalibrationScene]:
        """All of them; what takes longest first."""
        counts = {"wheel": self.wheels, "rolling": self.rolling, "punch": self.punches, "sphere": self.spheres}
        return [
            CalibrationScene(kind=kind, number=number, quantity=quantity, seed=self.seed)
            for kind, count in counts.items()
            for quantity in QUANTITIES[kind]
            for number in range(count)
        ]


def cheap_models(target: Target) -> tuple[Model, ...]:
    """Those that claim errors, and are selected among."""
    return tuple(model for model in models_serving(target.scene, target.quantity) if not isinstance(model, GridModel))


ANSWERS = Path(__file__).with_name("calibration_answers.npz")
ABOUT = "about"
Group = tuple[str, str]
"""Kind of scene, quantity."""


@dataclass(frozen=True, eq=False)
class Answers:
    """Of one kind of scene and quantity, scenes without an answer left out.

    number: of the scenes; reference: relative error that each answer leaves; size: numbers of it, as bands; count:
    realisations that it is the mean of; value: all answers, one behind the other; each: their realisations, as
    well; about: date, command, seed, digest of the code.
    """

    number: NDArray[np.int64]
    reference: FloatArray
    size: NDArray[np.int64]
    count: NDArray[np.int64]
    value: FloatArray
    each: FloatArray
    about: Mapping[str, str]

    @classmethod
    def of(cls, outcomes: Sequence[tuple[CalibrationScene, Outcome]], about: Mapping[str, str]) -> "Answers":
        answered = [(point.number, outcome) for point, outcome in outcomes if not outcome["failed"]]
        each = [outcome["each"] for _, outcome in answered]
        return cls(
            number=np.array([number for number, _ in answered], dtype=np.int64),
            reference=np.array([float(outcome["reference"]) for _, outcome in answered]),
            size=np.array([outcome["value"].size for _, outcome in answered], dtype=np.int64),
            count=np.array([len(rows) for rows in each], dtype=np.int64),
            value=np.concatenate([np.empty(0), *(outcome["value"] for _, outcome in answered)]),
            each=np.concatenate([np.empty(0), *(rows.ravel() for rows in each)]),
            about=about,
        )

    def scenes(self, group: Group) -> Iterator[tuple[CalibrationScene, FloatArray, FloatArray]]:
        """Each with its value and its realisations (count, size)."""
        values = np.split(self.value, np.cumsum(self.size)[:-1])
        each = np.split(self.each, np.cumsum(self.size * self.count)[:-1])
        for number, value, rows in zip(self.number.tolist(), values, each, strict=bool(self.number.size)):
            point = CalibrationScene(kind=group[0], number=number, quantity=group[1], seed=self.seed)
            yield point, value, rows.reshape(-1, value.size)

    @property
    def seed(self) -> int:
        """Of the scenes."""
        return int(self.about["command"].rsplit(" ", 1)[1])

    @cached_property
    def digest(self) -> str:
        """Of all numbers."""
        return hashlib.sha256(b"".join(array.tobytes() for array in astuple(self)[:-1])).hexdigest()[:16]


@cache
def answers_in(path: Path = ANSWERS) -> Mapping[Group, Answers]:
    """All that are there; none without a file."""
    if not path.exists():
        return {}
    with np.load(path, allow_pickle=False) as entries:
        arrays = {name: entries[name] for name in entries.files}
    groups: dict[Group, dict[str, NDArray[np.generic]]] = {}
    for name, array in arrays.items():
        kind, quantity, field = name.split(" ")
        groups.setdefault((kind, quantity), {})[field] = array
    return {group: Answers(**{**entry, ABOUT: json.loads(str(entry[ABOUT]))}) for group, entry in groups.items()}
