"""Steps a second of a dynamic wheel on springs, beside the plain sum over all of them."""

import itertools
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from validation.analysis.evidence import Table, table_of
from validation.benchmarks.isolation import measure_alone, timed
from validation.benchmarks.work_precision.dynamic_wheel import CountedSprings
from validation.engine.engine import Engine, Outcome
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.simulation.contact_laws import SpringsLaw
from validation.simulation.method import FloatArray
from validation.simulation.motion import simulate
from validation.simulation.wheel_on_springs import WheelEnsemble

TABLE = load_wheel_scene("table_14_1")


@dataclass(frozen=True, kw_only=True)
class SteppingThroughput:
    """Wheels of a scene on springs, each measurement in a process of its own with one thread.

    springs: to a contact radius; heights: h_0 / d; wheels: in a batch; steps: timed of each; scene: with a rough rail.
    """

    springs: tuple[int, ...] = (25, 100, 400)
    heights: tuple[float, ...] = (0.01, 0.3)
    wheels: int = 300
    steps: int = 2000
    scene: WheelScene = TABLE
    seed: int = 149

    def problems(self) -> list["SpringWheels"]:
        """Each height with so many springs to a radius, and waves that they carry."""
        rough = self.scene.rail
        if rough is None:
            raise ValueError("scene must have a rough rail")
        found = []
        for height, springs in itertools.product(self.heights, self.springs):
            shortest = max(rough.shortest, 4 * self.scene.contact_radius / springs)
            rail = replace(rough, rms=height * self.scene.approach, shortest=shortest)
            scene = replace(self.scene, springs=springs, rail=rail)
            found.append(SpringWheels(scene=scene, wheels=self.wheels, steps=self.steps, seed=self.seed))
        return found


def stepping_throughput(stepping: SteppingThroughput, engine: Engine) -> Table:
    """Wheel-steps a second by springs and height; the floor: plain sums over all springs, and their difference."""
    problems = stepping.problems()
    rows: list[dict[str, object]] = [
        {
            "h0/d": problem.scene.rms / problem.scene.approach,
            "a/dx": problem.scene.springs,
            "wheel-steps a second": float(outcome["rate"]),
            "plain sums a second": float(outcome["plain"]),
            "springs examined": float(outcome["examined"]),
            "difference to the plain sum": float(outcome["difference"]),
        }
        for problem, outcome in zip(problems, engine.map(measure_alone, problems), strict=True)
    ]
    return table_of("wheel", rows)


@dataclass(frozen=True, kw_only=True)
class SpringWheels:
    """Some steps of many wheels."""

    scene: WheelScene
    wheels: int
    steps: int
    seed: int

    def measure(self) -> Outcome:
        """Wheel-steps a second of the simulation; of the plain sum over all springs within reach; their difference."""
        scene, wheel = self.scene, self.scene.body
        heights = WheelEnsemble(scene=scene, count=self.wheels, seed=self.seed).heights()
        law, counted = SpringsLaw(wheel, heights, scene.spacing), CountedSprings(wheel, heights, scene.spacing)
        settings: dict[str, Any] = {"time_step": scene.time_step, "steps": self.steps}
        simulate(wheel, counted, **settings)
        times = [timed(lambda: simulate(wheel, law, **settings)) for _ in range(3)]
        motion, seconds = min(times, key=lambda time: time[1])
        plain = PlainSum(scene, heights, float(motion.highest.max()))
        few = range(max(self.steps // 20, 1))
        _, slow = timed(lambda: [plain.force(n, motion.approach) for n in few])
        off = max(float(np.abs(plain.force(n, motion.approach) - law.force(n, motion.approach)).max()) for n in few)
        return {
            "rate": np.array(self.steps * self.wheels / seconds),
            "plain": np.array(len(few) * self.wheels / slow),
            "examined": np.array(float(np.mean(counted.examined))),
            "difference": np.array(off / scene.load),
        }


class PlainSum:
    """F = E* dx sum_j max(d - x_j^2 / R + h_j, 0) over all springs that some wheel may reach, every time."""

    def __init__(self, scene: WheelScene, heights: FloatArray, deepest: float):
        self.heights, self.spring = heights, scene.modulus * scene.spacing
        reach = math.ceil(math.sqrt(scene.radius * (deepest + heights.max())) / scene.spacing)
        self.springs = np.arange(-reach, reach + 1)
        self.profile = ((self.springs * scene.spacing) ** 2 / scene.radius)[:, np.newaxis]

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        near = self.heights.take(self.springs + place, axis=0, mode="wrap")
        return np.asarray(self.spring * np.maximum(approach - self.profile + near, 0.0).sum(axis=0))
