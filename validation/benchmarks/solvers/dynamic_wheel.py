"""What a step of a dynamic wheel costs: on springs, beside the plain sum over all of them, and on boundary elements."""

import itertools
import math
import warnings
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

import bem3d
from validation.analysis.evidence import Table, table_of
from validation.benchmarks.isolation import one_thread, own_process, timed
from validation.engine.engine import Engine, Outcome, random_generator
from validation.scenes.dynamic_wheel import WheelScene, load_wheel_scene
from validation.simulation.contact_laws import BoundaryElementsLaw, SpringsLaw
from validation.simulation.motion import simulate
from validation.simulation.wheel_on_half_space import crop_to_reach
from validation.simulation.wheel_on_springs import WheelEnsemble

FloatArray = NDArray[np.float64]

TABLE = load_wheel_scene("table_14_1")


@dataclass(frozen=True, kw_only=True)
class SteppingThroughput:
    """All that is timed, each in a process of its own with one thread.

    springs: to a contact radius; heights: h_0 / d; wheels: in step; steps: timed of each; scene: that has the goals;
    goal: wheel-steps a second on springs of the scene, bem_goal: on boundary elements with `cells` to a contact radius
    and four to the shortest wave, on windows that would be 3 a wide, to the residual `tolerance`; bem_steps: timed of
    these.
    """

    springs: tuple[int, ...] = (25, 100, 400)
    heights: tuple[float, ...] = (0.01, 0.3)
    wheels: int = 300
    steps: int = 2000
    scene: WheelScene = TABLE
    goal: float = 5e6
    bem_goal: float = 400.0
    cells: int = 32
    tolerance: float = 1e-4
    bem_steps: int = 200
    seed: int = 149


@dataclass(frozen=True, kw_only=True)
class SpringWheels:
    """Some steps of many wheels."""

    scene: WheelScene
    wheels: int
    steps: int
    seed: int


@dataclass(frozen=True, kw_only=True)
class OnHalfSpace:
    """Some steps of one wheel on boundary elements."""

    scene: WheelScene
    cells: int
    tolerance: float
    steps: int
    seed: int


def measure_wheels(steps: SteppingThroughput, engine: Engine) -> list[Table]:
    """Wheel-steps a second by springs and height; the scene that has goals, with the cost of a simulated metre."""
    sweep = [
        SpringWheels(
            scene=_rough(steps.scene, springs, height), wheels=steps.wheels, steps=steps.steps, seed=steps.seed
        )
        for height, springs in itertools.product(steps.heights, steps.springs)
    ]
    scene = SpringWheels(scene=steps.scene, wheels=steps.wheels, steps=steps.steps, seed=steps.seed)
    on_springs = engine.map(measure_springs, [*sweep, scene])
    rough = steps.scene.rail
    if rough is None:
        raise ValueError("scene must have a rough rail")
    resolved = replace(rough, shortest=4 * steps.scene.contact_radius / steps.cells)
    solved = OnHalfSpace(
        scene=replace(steps.scene, rail=resolved),
        cells=steps.cells,
        tolerance=steps.tolerance,
        steps=steps.bem_steps,
        seed=steps.seed,
    )
    return [_sweep(sweep, on_springs), _goals(steps, on_springs[-1], engine.map(measure_half_space, [solved])[0])]


def _rough(scene: WheelScene, springs: int, height: float) -> WheelScene:
    """The scene with so many springs to a radius, and waves that they carry."""
    rough = scene.rail
    if rough is None:
        raise ValueError("scene must have a rough rail")
    shortest = max(rough.shortest, 4 * scene.contact_radius / springs)
    return replace(scene, springs=springs, rail=replace(rough, rms=height * scene.approach, shortest=shortest))


def measure_springs(problem: SpringWheels) -> Outcome:
    """Wheel-steps a second of the simulation; of the plain sum over all springs within reach; their difference."""
    with one_thread(), own_process() as lane:
        return lane.submit(_measure_springs, problem).result()


def _measure_springs(problem: SpringWheels) -> Outcome:
    scene, wheel = problem.scene, problem.scene.body
    heights = WheelEnsemble(scene=scene, count=problem.wheels, seed=problem.seed).heights()
    law, examined = SpringsLaw(wheel, heights, scene.spacing), []

    class CountingLaw:
        """The same law, which counts what it looks at."""

        def force(self, place: int, approach: FloatArray) -> FloatArray:
            found = law.force(place, approach)
            examined.append(law.foundation.examined)
            return found

        def at_rest(self, place: int) -> FloatArray:
            return law.at_rest(place)

    settings = {"time_step": scene.time_step, "steps": problem.steps}
    simulate(wheel, CountingLaw(), **settings)  # type: ignore[arg-type]
    times = [timed(lambda: simulate(wheel, law, **settings)) for _ in range(3)]  # type: ignore[arg-type]
    motion, seconds = min(times, key=lambda time: time[1])
    plain = _Plain(scene, heights, float(motion.highest.max()))
    few = max(problem.steps // 20, 1)
    _, slow = timed(lambda: [plain.force(n, motion.approach) for n in range(few)])
    off = max(float(np.abs(plain.force(n, motion.approach) - law.force(n, motion.approach)).max()) for n in range(few))
    return {
        "rate": np.array(problem.steps * problem.wheels / seconds),
        "plain": np.array(few * problem.wheels / slow),
        "examined": np.array(float(np.mean(examined))),
        "difference": np.array(off / scene.load),
    }


class _Plain:
    """F = E* dx sum_j max(d - x_j^2 / R + h_j, 0) over all springs that some wheel may reach, every time."""

    def __init__(self, scene: WheelScene, heights: FloatArray, deepest: float):
        self.heights, self.spring = heights, scene.modulus * scene.spacing
        reach = math.ceil(math.sqrt(scene.radius * (deepest + heights.max())) / scene.spacing)
        self.springs = np.arange(-reach, reach + 1)
        self.profile = ((self.springs * scene.spacing) ** 2 / scene.radius)[:, np.newaxis]

    def force(self, place: int, approach: FloatArray) -> FloatArray:
        near = self.heights.take(self.springs + place, axis=0, mode="wrap")
        return np.asarray(self.spring * np.maximum(approach - self.profile + near, 0.0).sum(axis=0))


def measure_half_space(problem: OnHalfSpace) -> Outcome:
    """Steps a second of a wheel that already rolls, and operator applications a step."""
    with one_thread(), own_process() as lane:
        return lane.submit(_measure_half_space, problem).result()


def _measure_half_space(problem: OnHalfSpace) -> Outcome:
    scene, wheel = problem.scene, problem.scene.body
    rough, spacing = scene.rail, scene.contact_radius / problem.cells
    if rough is None:
        raise ValueError("scene must have a rough rail")
    with warnings.catch_warnings():
        # four cells to the shortest wave, as the goal has it
        warnings.simplefilter("ignore", bem3d.ResolutionWarning)
        surface = bem3d.rough_surface(
            rough.spectrum.c2d,
            shape=(max(problem.steps, 16 * problem.cells), 16 * problem.cells),
            spacing=spacing,
            rng=random_generator(problem.seed),
            rms=rough.rms,
        )
    law = BoundaryElementsLaw(wheel, [crop_to_reach(surface, spacing, wheel)], spacing, tolerance=problem.tolerance)
    time_step = spacing / scene.speed

    def roll() -> int:
        before = law.operator_applications
        simulate(wheel, law, time_step=time_step, steps=problem.steps)
        return law.operator_applications - before

    roll()
    applications, seconds = min((timed(roll) for _ in range(2)), key=lambda time: time[1])
    return {
        "rate": np.array(problem.steps / seconds),
        "applications": np.array(applications / problem.steps),
        "metre": np.array(seconds / (problem.steps * spacing)),
    }


def _sweep(problems: list[SpringWheels], outcomes: list[Outcome]) -> Table:
    rows: list[dict[str, object]] = [
        {
            "h0/d": problem.scene.rms / problem.scene.approach,
            "a/dx": problem.scene.springs,
            "wheel-steps a second": float(outcome["rate"]),
            "plain sums a second": float(outcome["plain"]),
            "springs examined": float(outcome["examined"]),
            "difference to the plain sum": float(outcome["difference"]),
        }
        for problem, outcome in zip(problems, outcomes, strict=False)
    ]
    return table_of("wheel", rows)


def _goals(steps: SteppingThroughput, springs: Outcome, half_space: Outcome) -> Table:
    scene = steps.scene
    rate, solved = float(springs["rate"]), float(half_space["rate"])
    return table_of(
        "The dynamic wheel of Table 14.1, one core",
        [
            {
                "contact": f"{scene.springs} springs to a radius, {steps.wheels} wheels in step",
                "steps a second": f"{rate:.3g}",
                "goal": f"{steps.goal:.3g}",
                "seconds a simulated metre": f"{1 / (rate * scene.spacing):.3g}",
                "beside": f"plain sums over all springs {float(springs['plain']):.3g} a second, force equal to "
                f"{float(springs['difference']):.1g}",
            },
            {
                "contact": f"boundary elements, {steps.cells} cells to a radius, residual {steps.tolerance:g}",
                "steps a second": f"{solved:.3g}",
                "goal": f"{steps.bem_goal:.3g}",
                "seconds a simulated metre": f"{float(half_space['metre']):.3g}",
                "beside": f"{float(half_space['applications']):.2f} operator applications a step",
            },
        ],
    )
