"""Positions and steps a second of a wheel by our own methods, beside the floor of what they add up."""

import itertools
import math
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

import bem3d
from validation.benchmarks.isolation import timed
from validation.benchmarks.work_precision.dynamic_wheel import CountedSprings
from validation.benchmarks.work_precision.rolling import moving_window
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import FloatArray, Outcome
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.simulation.contact_laws import SpringsLaw
from validation.simulation.motion import simulate
from validation.simulation.rolling_strip import RoughStrip, Strip, crop_to_reach
from validation.simulation.track_spectrum import PiecewisePowerLaw
from validation.simulation.wheel_on_springs import WheelEnsemble

WARM = 40
"""Positions before the clock runs: a cold start, frames that find their size, plans."""
WARM_SOLVES, APPLICATIONS = 60, 100
"""Of which the mean is taken."""


@dataclass(frozen=True, kw_only=True)
class RollingThroughput:
    """A wheel over rough strips, each in a process of its own with one thread.

    heights: h_rms / d; cells: to a contact radius, four to the shortest wave; tolerance: residual; positions: timed.
    """

    heights: tuple[float, ...] = (0.01, 0.3)
    cells: int = 32
    tolerance: float = 1e-4
    positions: int = 400
    seed: int = 145

    def rolls(self) -> list["RolledStrip"]:
        spectrum = PiecewisePowerLaw(edges=(1.0, np.pi / 2 * self.cells), exponents=(3.4,))
        rough = partial(RoughStrip, spectrum=spectrum, length=32.0, width=16.0, seed=self.seed)
        strips = (rough(height=height).strips(self.cells, self.tolerance, 1)[0] for height in self.heights)
        return [RolledStrip(strip=strip, positions=self.positions) for strip in strips]


@dataclass(frozen=True, kw_only=True)
class RolledStrip:
    """Some positions along one strip."""

    strip: Strip
    positions: int

    def measure(self) -> Outcome:
        """Of a wheel that already rolls; the floor: as many operator applications on a fixed window, or warm solves."""
        (seconds, applications), (warm, one) = self._rolled().values(), self._warm_solves()
        told = {
            "positions a second": 1 / seconds,
            "applications a position": applications,
            "one on 3a x 3a [s]": one,
            "time over applications on 3a x 3a": seconds / (applications * one),
            "by warm solves on 3a x 3a": 1 / warm,
        }
        return {name: np.array(value) for name, value in told.items()}

    def _rolled(self) -> dict[str, float]:
        """Seconds and applications a position."""
        strip = self.strip
        height = crop_to_reach(strip.surface(), 1 / strip.cells)
        track = bem3d.Track(height=height, spacing=1 / strip.cells, radius=1.0, modulus=1.0)
        wheel = bem3d.RollingContact(track, tolerance=strip.tolerance)
        before = [wheel.press(position, 1.0) for position in range(WARM)]
        after, seconds = timed(lambda: [wheel.press(i, 1.0) for i in range(WARM, self.positions)])
        if lost := sum(not contact.converged for contact in (*before, *after)):
            raise NotConvergedError(f"{lost} positions at h/d = {strip.scene.height:g} did not converge")
        # plans were made meanwhile, as many as there are sizes of frames: the faster of two looks counts
        again = bem3d.RollingContact(track, tolerance=strip.tolerance)
        again.press(0, 1.0)
        _, repeated = timed(lambda: [again.press(i, 1.0) for i in range(1, self.positions)])
        return {
            "seconds": min(seconds / len(after), repeated / (self.positions - 1)),
            "applications": float(np.mean([contact.operator_applications for contact in after])),
        }

    def _warm_solves(self) -> tuple[float, float]:
        """Seconds of a `solve` from the last pressure, moved with the ground, on one window; of an application."""
        strip = self.strip
        half_space, gap = moving_window(strip.surface(), strip.cells)

        def solve(position: int, start: FloatArray | None = None) -> bem3d.Contact:
            return bem3d.solve(half_space, gap(position), approach=1.0, start=start, tolerance=strip.tolerance)

        contact, total = solve(0), 0.0
        count = min(self.positions, WARM_SOLVES)
        for position in range(1, 1 + count):
            moved = np.zeros_like(contact.pressure)
            moved[:-1] = contact.pressure[1:]
            contact, seconds = timed(lambda p=position, s=moved: solve(p, s))  # type: ignore[misc]
            total += seconds
        _, application = timed(lambda: [half_space.apply(contact.pressure) for _ in range(APPLICATIONS)])
        return total / count, application / APPLICATIONS


TABLE = load_wheel_scene("table_14_1")
STEPS, PLAIN = "steps of one wheel a second", "the same by plain sums over all springs"


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
        reach = math.ceil(math.sqrt(scene.radius * (motion.highest.max() + heights.max())) / scene.spacing)
        springs = np.arange(-reach, reach + 1)
        profile = ((springs * scene.spacing) ** 2 / scene.radius)[:, np.newaxis]

        def plain(place: int) -> FloatArray:
            """F = E* dx sum_j max(d - x_j^2 / R + h_j, 0) over all springs that some wheel may reach, every time."""
            near = heights.take(springs + place, axis=0, mode="wrap")
            summed = np.maximum(motion.approach - profile + near, 0.0).sum(axis=0)
            return np.asarray(scene.modulus * scene.spacing * summed)

        few = range(max(self.steps // 20, 1))
        _, slow = timed(lambda: [plain(n) for n in few])
        off = max(float(np.abs(plain(n) - law.force(n, motion.approach)).max()) for n in few)
        return {
            STEPS: np.array(self.steps * self.wheels / seconds),
            PLAIN: np.array(len(few) * self.wheels / slow),
            "springs examined": np.array(float(np.mean(counted.examined))),
            "difference to the plain sum, over the load": np.array(off / scene.load),
        }
